/* `breccia bench launches`: what a step asks of a device, counted: launches, times the host waits, bytes between host
 * and device; and what that is worth by a model of the device, seconds = launches x launch + waits x wait + least bytes
 * / bandwidth, whose constants are measured here, and for a card given in docs/notebook/devices.md. The bandwidth is
 * that of a copy of as many bytes as the step moves or, where arithmetic takes longer, as on a CPU, what the passes of
 * a small elastic body reach in cache. A GPU is asked for the next launches while it computes, and waits for memory
 * however few elements there are: there the longer of launches and passes counts, and passes are a latency and bytes,
 * by a small body and one that fills it. Constants and steps are measured by turns, and the turn in the middle counts.
 * One thread: processor seconds. Noisy-grid cubes and packings as of `bench throughput`: elastic, with fracture and
 * contact where nothing breaks and nothing is near. */
#ifndef BRC_BENCH_LAUNCHES_H
#define BRC_BENCH_LAUNCHES_H

#include "../host/device/device.h"
#include "../host/scene/scene.h"
#include "rows.h"

/* Seconds of the work of a step on a device. */
typedef struct brc_device_price {
    double launch_s, wait_s; /* of a launch with nothing to do, of a read of a number */
    double copy_bandwidth;   /* [byte/s] */
    double pass_bandwidth;   /* least bytes of elastic steps over the seconds of their passes [byte/s] */
    double latency_s;        /* of the passes of an elastic step of few elements */
    bool overlaps;           /* launches are made while the device computes: the longer of the two counts */
} brc_device_price;

typedef struct brc_launches_request {
    int n_models;
    const brc_model_kind *models;
    int64_t size; /* elements wanted */
    const char *device;
    brc_precision precision;
    int n_threads;
    int64_t n_steps;         /* that are counted */
    int64_t bandwidth_bytes; /* array of the copy that gives the bandwidth, at most [byte] */
    /* Called after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_launches_request;

/* Adds a row for each model and effect. */
brc_status brc_launches_measure(brc_context *context, const brc_launches_request *request, brc_rows *rows);

#endif
