/* `breccia bench contact`: what touching costs. Three rows a size of cells, one of spheres:
 *   nothing-near  a shaken cube with contact on and nothing that meets: its step over the same without contact
 *   dust          a ball whose cells all came off each other, met at random and fly apart, grown to twice its size: its
 *                 step over that of the intact ball, without contact and fracture. Growth alone breaks all bonds in the
 *                 first steps; the random velocities follow when the cells are apart, so that the burst itself is soon
 *                 over
 *   dense         the dust pressed together again: microseconds a step for each touching pair, beyond the step of the
 *                 intact ball
 * The two sides of a ratio run in turns, five rounds; ratios of processor time on the cpu device, of wall time on
 * others: rows say the median, least and most. */
#ifndef BRC_BENCH_CONTACT_COST_H
#define BRC_BENCH_CONTACT_COST_H

#include "../host/device/device.h"
#include "rows.h"

typedef struct brc_contact_cost_request {
    int64_t elements;               /* wanted, of each solid */
    bool cells, spheres;            /* which models: dlsm (all three rows), cbm (nothing-near) */
    bool nothing_near, dust, dense; /* which rows */
    const char *device;             /* selector */
    brc_precision precision;
    int n_threads;
    double sample_s; /* least time of a sample of the side without contact [s] */
    /* Called after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_contact_cost_request;

/* Adds the rows of one size. */
brc_status brc_contact_cost_measure(brc_context *context, const brc_contact_cost_request *request, brc_rows *rows);

#endif
