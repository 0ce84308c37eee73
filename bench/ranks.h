/* `breccia bench ranks`: what several ranks (host/base/ranks.h) cost. Three kinds of rows, by `quantity`:
 *     surface   one process: noisy-grid cubes in storage order, cut into 2, 4, 8 ... ranges of whole sum blocks: rows
 *               of other ranks that a rank gathers (ghosts), ranks it has them of, rows that gather none, bytes a step
 *     exchange, gather, reduce, barrier   all ranks: seconds of one, and bytes a second each way with two neighbours
 *     step      all ranks: seconds of a step of the cube, messages and bytes sent, seconds waited and computed while
 *               messages fly, memory; of the slowest, or largest, rank */
#ifndef BRC_BENCH_RANKS_H
#define BRC_BENCH_RANKS_H

#include "../host/device/device.h"
#include "rows.h"
#include "throughput.h"

enum { BRC_RANKS_BLOCK = 1024 /* rows of a sum block */ };

typedef struct brc_ranks_request {
    int n_sizes;
    int64_t sizes[BRC_THROUGHPUT_LIST]; /* elements wanted */
    bool surface, exchange, step;       /* kinds of rows */
    brc_model_kind model;               /* of the steps */
    int64_t n_steps;                    /* of each sample */
    const char *device;
    brc_precision precision;
    int n_threads; /* 0: as OpenMP decides */
    /* Called on rank 0 after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_ranks_request;

/* All ranks, with the same request. Rows are those of rank 0. BRC_BAD_INPUT: surface on several ranks. */
brc_status brc_ranks_measure(brc_context *context, const brc_ranks_request *request, brc_rows *rows);

#endif
