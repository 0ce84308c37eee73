#include "scans.h"

int32_t brc_scan_blocks(int64_t n)
{
    return brc_blocks(n, BRC_SCAN_BLOCK);
}

brc_status brc_scan_kernels_find(brc_device *device, brc_scan_kernels *out)
{
    BRC_TRY(brc_kernel_find(device, "scan_sums", &out->sums));
    BRC_TRY(brc_kernel_find(device, "scan_tops", &out->tops));
    BRC_TRY(brc_kernel_find(device, "scan_fill", &out->fill));
    BRC_TRY(brc_kernel_find(device, "sort_count", &out->count));
    return brc_kernel_find(device, "sort_move", &out->move);
}

static int64_t first_total(brc_buffer *sums)
{
    return brc_buffer_bytes(sums) / (int64_t)sizeof(int32_t) - BRC_SCAN_TOTALS;
}

brc_status brc_scan_later(const brc_scan_kernels *k, brc_buffer *x, int64_t n, brc_buffer *sums, brc_buffer *start,
                          int at)
{
    const int32_t n_blocks = brc_scan_blocks(n);
    BRC_TRY(BRC_LAUNCH(k->sums, n_blocks, BRC_INT(n_blocks), BRC_INT(n), BRC_BUF(x), BRC_BUF(sums)));
    BRC_TRY(BRC_LAUNCH(k->tops, 1, BRC_INT(1), BRC_INT(n_blocks), BRC_INT(first_total(sums) + at), BRC_BUF(sums)));
    return BRC_LAUNCH(k->fill, n_blocks, BRC_INT(n_blocks), BRC_INT(n), BRC_BUF(x), BRC_BUF(sums), BRC_BUF(start));
}

brc_status brc_scan_totals(brc_buffer *sums, int n, int32_t *total)
{
    return brc_buffer_read(sums, first_total(sums) * (int64_t)sizeof *total, total, n * (int64_t)sizeof *total);
}

brc_status brc_scan(const brc_scan_kernels *k, brc_buffer *x, int64_t n, brc_buffer *sums, brc_buffer *start,
                    int64_t *total)
{
    int32_t sum;
    BRC_TRY(brc_scan_later(k, x, n, sums, start, 0));
    if (!total) return BRC_OK;
    BRC_TRY(brc_scan_totals(sums, 1, &sum));
    *total = sum;
    return BRC_OK;
}

brc_status brc_sort_count(const brc_scan_kernels *k, int32_t m, int32_t shift, brc_buffer *key, brc_buffer *count)
{
    const int32_t n_blocks = brc_scan_blocks(m);
    return BRC_LAUNCH(k->count, n_blocks, BRC_INT(n_blocks), BRC_INT(m), BRC_INT(shift), BRC_BUF(key), BRC_BUF(count));
}

brc_status brc_sort_move(const brc_scan_kernels *k, int32_t m, int32_t shift, brc_buffer *key, brc_buffer *row,
                         brc_buffer *digits, brc_buffer *to_key, brc_buffer *to_row)
{
    const int32_t n_blocks = brc_scan_blocks(m);
    return BRC_LAUNCH(k->move, n_blocks, BRC_INT(n_blocks), BRC_INT(m), BRC_INT(shift), BRC_BUF(key), BRC_BUF(row),
                      BRC_BUF(digits), BRC_BUF(to_key), BRC_BUF(to_row));
}
