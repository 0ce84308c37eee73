/* `breccia bench rest`: what is gained where elements that nothing has reached are left out. A bar, twenty times as
 * long as wide, is struck at one end; seconds of its steps until a pressure wave has run along it once, of all elements
 * over those of the elements that are awake. Both runs are made anew each round and in turns, five rounds; rows say the
 * median, least and most, and BRC_INTERNAL ends where the two differ in a bit of a displacement. */
#ifndef BRC_BENCH_REST_COST_H
#define BRC_BENCH_REST_COST_H

#include "../host/device/device.h"
#include "../host/scene/model_kinds.h"
#include "rows.h"

typedef struct brc_rest_cost_request {
    int64_t elements; /* wanted */
    brc_model_kind model;
    const char *device; /* selector, borrowed */
    brc_precision precision;
    int n_threads;
    /* Called after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_rest_cost_request;

/* Adds the row of one size and model. */
brc_status brc_rest_cost_measure(brc_context *context, const brc_rest_cost_request *request, brc_rows *rows);

#endif
