/* Cells of a solid with mirrored walls, made and checked: they fill the solid, and no bond crosses what is outside
 * it. */
#ifndef BRC_PREPROCESS_CONFORM_H
#define BRC_PREPROCESS_CONFORM_H

#include "cells.h"

/* Walls of the seeds position [n][3], fit for cells: mirror images of seeds as deep as the cells need. fit: also on the
 * mean (mirror.h). */
brc_status brc_conform_walls(brc_context *context, const double *position, int64_t n, double spacing, bool fit,
                             int n_threads, brc_walls *walls);
/* All cells, with mirror images from deeper and deeper seeds until every cell is closed by walls that reach it.
 * BRC_BAD_INPUT when that does not end. As brc_cells_compute otherwise. */
brc_status brc_conform_cells(brc_context *context, const double *position, int64_t n, double spacing, int n_threads,
                             brc_together together, brc_walls *walls, brc_cells *cells);
/* Refuse a domain (before its pose) with bonds through places outside the solid, with the worst place and the cure.
 * Nothing to do for walls without mirror images. */
brc_status brc_conform_check(brc_context *context, const brc_walls *walls, double spacing, int n_threads,
                             const brc_domain *domain);

#endif
