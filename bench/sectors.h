/* `breccia bench sectors`: what gathers cost the memory of a GPU, counted from the neighbour lists of a noisy-grid cube
 * in the layout of a GPU. Memory comes in sectors of 32 bytes; a warp of 32 elements gathers a record of each one's
 * neighbour at once. For each kind of record (its numbers, their bytes) and each way of storing it: packed; padded to
 * whole sixteen bytes, which vector loads want; split, every number an array of its own. Then what each pass of a step
 * moves, and the step of 1e5 to 3e7 elements on a card (card.h). */
#ifndef BRC_BENCH_SECTORS_H
#define BRC_BENCH_SECTORS_H

#include "rows.h"

typedef struct brc_sectors_request {
    int64_t size; /* elements wanted */
    /* Called after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_sectors_request;

/* Adds the rows: sectors a gather of a warp (`sectors_per_gather`, of an element), bytes fetched over bytes wanted
 * where each slot of a warp is fetched for itself, and bytes a half-edge where a group of 128, 256, 512 or 1024
 * elements fetches each sector once (an L1 cache that holds all it gathers, the floor of what reaches L2). */
brc_status brc_sectors_measure(brc_context *context, const brc_sectors_request *request, brc_rows *rows);

#endif
