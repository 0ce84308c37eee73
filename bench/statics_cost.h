/* `breccia bench statics`: what an elastic equilibrium takes as the body grows, with multigrid and with diagonal
 * blocks. Two bodies of cells, noisy grids with five Lloyd sweeps: a cantilever of 10:1 that bends under a traction,
 * and a cube that is pulled between rollers; one row for each size, body and preconditioner. The sides of a ratio run
 * one after the other in one process; seconds are processor time of the solve, its setup included, on the cpu device
 * with one thread, else of the clock. */
#ifndef BRC_BENCH_STATICS_COST_H
#define BRC_BENCH_STATICS_COST_H

#include "../host/device/device.h"
#include "rows.h"
#include "statics_peer.h"

typedef struct brc_statics_cost_request {
    int64_t elements;       /* wanted, of each body */
    int64_t most_of_blocks; /* elements up to which diagonal blocks run too */
    bool cantilever, cube;  /* which bodies */
    double poisson;
    const char *device; /* selector */
    brc_precision precision;
    int n_threads;
    const brc_statics_peer *peer; /* solves the same bodies too; NULL: none */
    /* Called after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_statics_cost_request;

/* Adds the rows of one size. */
brc_status brc_statics_cost_measure(brc_context *context, const brc_statics_cost_request *request, brc_rows *rows);

#endif
