/* Cells that several ranks (host/base/ranks.h) compute, each a range of runs: who does which, and how all get all. */
#ifndef BRC_PREPROCESS_CELLS_RANKS_H
#define BRC_PREPROCESS_CELLS_RANKS_H

#include "cells.h"

/* Runs [first, end) of n_runs. */
typedef struct brc_run_range {
    int64_t first, end;
} brc_run_range;
/* What rank k of `count` computes. */
brc_run_range brc_runs_of_rank(int64_t n_runs, int32_t k, int32_t count);
/* What this rank computes: all of it where not together. */
brc_run_range brc_runs_here(int64_t n_runs, bool together);

/* All: rows of `bytes` each of n elements, of which each rank has those of its runs. */
brc_status brc_cells_bring_rows(brc_context *context, int64_t n, int64_t bytes, void *rows);
/* All: the cells of all ranks, of which each has its runs. */
brc_status brc_cells_bring(brc_context *context, brc_cells *cells);

#endif
