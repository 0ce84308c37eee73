/* `breccia bench effects`: what an effect costs, as a multiple of the elastic step of the same cube. Steps of all
 * variants alternate, so that what else the machine does meets all of them; medians of their ratios. */
#ifndef BRC_BENCH_EFFECTS_H
#define BRC_BENCH_EFFECTS_H

#include "../host/device/device.h"
#include "../host/scene/scene.h"
#include "rows.h"

typedef struct brc_effects_request {
    int64_t size; /* elements wanted */
    int n_models;
    const brc_model_kind *models;
    const char *device; /* selector */
    brc_precision precision;
    int n_threads;      /* of the cpu; 0: as many as there are */
    double sample_s;    /* time of one sample of the elastic step, about [s] */
    const char *folder; /* for a file of strengths, which is removed again; made where it is missing */
    /* Called after each row was added (the last one of `rows`); a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_effects_request;

/* Adds a row for each effect of each model. */
brc_status brc_effects_measure(brc_context *context, const brc_effects_request *request, brc_rows *rows);

#endif
