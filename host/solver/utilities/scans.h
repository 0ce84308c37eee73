/* Running sums and sorting on the device (scan.cl). */
#ifndef BRC_SOLVER_UTILITIES_SCANS_H
#define BRC_SOLVER_UTILITIES_SCANS_H

#include "../../device/device.h"

enum { BRC_SCAN_BLOCK = 1024, BRC_SORT_BINS = 256 }; /* as in portable.h and scan.cl */
/* Totals of scans that one read brings, at the end of their scratch. */
enum { BRC_SCAN_TOTALS = 4 };

typedef struct brc_scan_kernels {
    brc_kernel *sums, *tops, *fill, *count, *move;
} brc_scan_kernels;

/* Work-items that take `block` numbers each, for n; those of a scan. */
static inline int32_t brc_blocks(int64_t n, int32_t block)
{
    return (int32_t)((n + block - 1) / block);
}
int32_t brc_scan_blocks(int64_t n);
brc_status brc_scan_kernels_find(brc_device *device, brc_scan_kernels *out);
/* start [n + 1]: running sums of x [n]; *total, which may be NULL: that of all. sums: scratch [brc_scan_blocks(n) +
 * BRC_SCAN_TOTALS]. */
brc_status brc_scan(const brc_scan_kernels *k, brc_buffer *x, int64_t n, brc_buffer *sums, brc_buffer *start,
                    int64_t *total);
/* The same without waiting: sums keeps in number `at` what it came to, for brc_scan_totals, the first n. */
brc_status brc_scan_later(const brc_scan_kernels *k, brc_buffer *x, int64_t n, brc_buffer *sums, brc_buffer *start,
                          int at);
brc_status brc_scan_totals(brc_buffer *sums, int n, int32_t *total);
/* One digit of a sort of m keys, the eight bits from `shift` on: count [BRC_SORT_BINS][blocks], and with its running
 * sums `digits` keys and rows go to their places. */
brc_status brc_sort_count(const brc_scan_kernels *k, int32_t m, int32_t shift, brc_buffer *key, brc_buffer *count);
brc_status brc_sort_move(const brc_scan_kernels *k, int32_t m, int32_t shift, brc_buffer *key, brc_buffer *row,
                         brc_buffer *digits, brc_buffer *to_key, brc_buffer *to_row);

#endif
