/* What of a device's arrays each rank (../base/ranks.h) computes. Every rank has arrays of all rows in the same
 * order, and runs the same program. A launch whose items are rows, groups, numbers or blocks of rows, and which
 * writes those alone, does the rank's own range; what it gathers from other ranks' rows comes before it does, from
 * those that compute them. Flags that it sets there go back. A launch over a list of ascending rows is right at own
 * ones: others need not be done. Any other launch, and what the host reads, is of arrays that are brought together
 * first, and is done by all alike. So every rank has the bits that one alone would have. Which rows a launch reads
 * and writes follows from its signature (kernel_signature.h): no model and no effect knows of ranks. */
#ifndef BRC_DEVICE_SHARES_H
#define BRC_DEVICE_SHARES_H

#include "device.h"

/* The rows, as in the layout of a simulation (solver/core/layout.h); slot_start is borrowed until the last launch. */
typedef struct brc_rows_of_device {
    int32_t n_rows, n_groups, n_slices, slice; /* n_groups of n_rows / n_groups rows; n_slices of `slice` rows */
    const int32_t *slot_start;                 /* [n_slices + 1] */
    const int32_t *neighbour;                  /* [slot_start[n_slices]][slice] row at the other end of each bond */
} brc_rows_of_device;

/* All; before the first launch. With one rank nothing happens. BRC_BAD_INPUT: devices that cannot. */
brc_status brc_device_share(brc_device *device, const brc_rows_of_device *rows);

/* How an array lies: of which things, `bytes` of each one after another. Arrays that nobody says this of are written by
 * all ranks alike. */
typedef enum brc_array_of {
    BRC_OF_NOTHING,
    BRC_OF_ROWS,
    BRC_OF_SLICES, /* numbers of the rows of a slice lie beside each other */
    BRC_OF_GROUPS,
    BRC_OF_SLOTS,
    BRC_OF_LOOSE,   /* of each rank alone: places of its rows in no order, lists of what it does */
    BRC_OF_NUMBERS, /* items alone: of rows, as many of each */
    BRC_OF_BLOCKS   /* sums and the like of blocks of such numbers */
} brc_array_of;
/* number: bytes of one of the numbers in it. */
void brc_buffer_is_of(brc_buffer *buffer, brc_array_of what, int64_t bytes, int64_t number);

/* Slices [n_slices] with rows that this rank gets of what all write to the array at once (brc_buffer_write): 0 where it
 * may have anything else. NULL: it gets all. */
const uint8_t *brc_buffer_slices_here(const brc_buffer *buffer);

/* Rows that launches keep to: arrays of rows are read and written at these alone. All ranks, with the same rows: n of
 * them, in any order, some more than once; those below 0 or too large are no rows. *out: NULL or an older set, which is
 * used again. One rank needs none: *out stays NULL. */
typedef struct brc_rows_among brc_rows_among;
brc_status brc_rows_among_make(brc_device *device, int32_t n, const int32_t *rows, brc_rows_among **out);
/* Accepts NULL and a pointer to NULL. */
void brc_rows_among_free(brc_rows_among **among);
/* Launches from now on keep to the set, which is borrowed; NULL: to none any more. Returns the set until now. */
brc_rows_among *brc_device_keep_among(brc_device *device, brc_rows_among *among);
/* Bytes held now: in arrays of rows, of which a rank touches its own part and what its bonds reach; and in those that
 * ranks of a machine have once. None on other devices than the cpu. */
void brc_device_bytes_in_parts(const brc_device *device, int64_t *of_rows, int64_t *once);
/* Where the rows of a rank begin in the set, as it stands there: ascending, each once. rank: up to their number. */
int32_t brc_rows_among_before(const brc_rows_among *among, int32_t rank);
/* Whether several ranks share the rows; those of a rank, and those of this one. */
bool brc_device_is_shared(const brc_device *device);
typedef struct brc_row_range {
    int32_t first, end;
} brc_row_range;
brc_row_range brc_device_rows_of(const brc_device *device, int32_t rank);
brc_row_range brc_device_rows_here(const brc_device *device);
/* All ranks: items [before[k], before[k + 1]) of an array of no rows, `bytes` each, come from rank k. place: where
 * those items are; NULL: one after another from the start. */
brc_status brc_buffer_bring_ranges(brc_buffer *buffer, int64_t bytes, const int64_t *before, const int32_t *place);

#endif
