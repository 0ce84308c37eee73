/* `breccia bench throughput`: how fast the laws go, in bond updates per second and as a fraction of what the device's
 * memory gives. Noisy-grid cubes, or packings with ten beams an element, free faces, one material, undamped (the
 * published law with its own integrator). */
#ifndef BRC_BENCH_THROUGHPUT_H
#define BRC_BENCH_THROUGHPUT_H

#include "../host/device/device.h"
#include "../host/scene/scene.h"
#include "rows.h"

#define BRC_THROUGHPUT_LIST 16

/* Every combination is measured; threads only where the device is the cpu. */
typedef struct brc_throughput_request {
    int n_sizes, n_models, n_devices, n_precisions, n_threads;
    int64_t sizes[BRC_THROUGHPUT_LIST]; /* elements wanted */
    brc_model_kind models[BRC_THROUGHPUT_LIST];
    const char *devices[BRC_THROUGHPUT_LIST];
    brc_precision precisions[BRC_THROUGHPUT_LIST];
    int threads[BRC_THROUGHPUT_LIST];
    bool exact;              /* no contraction: brc_device_request */
    double sample_s;         /* least wall time of one of the five samples [s] */
    int64_t bandwidth_bytes; /* array of the copy that speeds are held against [byte] */
    /* Called after each row was added (the last one of `rows`); a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_throughput_request;

/* Adds a row for each combination. A device that is not there gives a row with a `note` and no figures. */
brc_status brc_throughput_measure(brc_context *context, const brc_throughput_request *request, brc_rows *rows);

#endif
