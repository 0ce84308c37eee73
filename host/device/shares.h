/* What of a device's arrays each rank (../base/ranks.h) computes. Every rank holds arrays of all rows in the same
 * order, and runs the same program. A launch whose items are rows or groups of rows, and which writes those alone, does
 * the rank's own range; what it gathers from other ranks' rows comes before it does, from those that compute them. Any
 * other launch, and what the host reads, is of arrays that are brought together first, and is done by all alike. So
 * every rank has the bits that one alone would have. Which rows a launch reads and writes follows from its signature
 * (kernel_signature.h): no model and no effect knows of ranks. */
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
    BRC_OF_SLOTS
} brc_array_of;
void brc_buffer_is_of(brc_buffer *buffer, brc_array_of what, int64_t bytes);

#endif
