/* Cells that several ranks (host/base/ranks.h) compute, each a range of runs: who does which, and how all get all. */
#ifndef BRC_PREPROCESS_CELLS_RANKS_H
#define BRC_PREPROCESS_CELLS_RANKS_H

#include "../domain/domain.h"
#include "cells.h"

/* Runs [first, end) of n_runs. */
typedef struct brc_run_range {
    int64_t first, end;
} brc_run_range;
/* What rank k of `count` computes. */
brc_run_range brc_runs_of_rank(int64_t n_runs, int32_t k, int32_t count);
/* What this rank computes: all of it where not together. */
brc_run_range brc_runs_here(int64_t n_runs, bool together);

/* The elements of these runs, of n. */
brc_run_range brc_elements_of_rank(int64_t n, int32_t k, int32_t count);

/* All: rows of `bytes` each of n elements, of which each rank has those of its runs. */
brc_status brc_cells_bring_rows(brc_context *context, int64_t n, int64_t bytes, void *rows);
/* All: the cells of all ranks, of which each has its runs; what stays apart does not come. */
brc_status brc_cells_bring(brc_context *context, brc_cells *cells);

/* All, where cells stay apart: marks the elements that this rank has, and who has which (domain.h). */
brc_status brc_cells_mark_apart(brc_context *context, brc_domain *domain);
/* All, likewise: centroids of the faces that half-edges here share with smaller elements elsewhere, from there. */
brc_status brc_cells_bring_centroids(brc_context *context, brc_domain *domain);
/* All, likewise: places of the corners of free faces, once they are where they stay. */
brc_status brc_cells_bring_free_corners(brc_context *context, brc_domain *domain);

#endif
