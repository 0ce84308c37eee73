/* Seeds of the cells: a regular grid over the shape's bounding box with one seed a grid cell, moved by uniform noise
 * (AGH19 section 7.1); those outside the walls are dropped. */
#ifndef BRC_PREPROCESS_SEEDS_H
#define BRC_PREPROCESS_SEEDS_H

#include "walls.h"

/* The grid the seeds are drawn in; on a curved shape it may stand out of the bounding box. */
typedef struct brc_grid {
    double origin[3], spacing[3]; /* smallest corner, edges of a grid cell [m] */
    int64_t cells[3];
    int64_t n_requested; /* elements asked for (0: the fill named spacing or cells) */
    int64_t n_inside;    /* seeds inside the walls */
} brc_grid;

/* Refuse a fill that names none or several of n_elements, spacing and cells, or values out of range. */
brc_status brc_fill_check(brc_context *context, const brc_fill *fill);
/* Size of a cell the fill leads to [m], before any seed is drawn. */
double brc_fill_spacing(const brc_solid *solid, const brc_fill *fill);
/* Choose the grid. BRC_BAD_INPUT when it has fewer than two cells across the thinnest direction, or no seed inside. */
brc_status brc_grid_plan(brc_context *context, const brc_fill *fill, const brc_walls *walls, int n_threads,
                         brc_grid *grid);
/* Draw the seeds in order of the grid cells (x fastest); a seed nearer than the fill's minimal distance to an earlier
 * one is dropped and counted. *position: [*n][3], caller frees with brc_memory_free. */
brc_status brc_seeds_draw(brc_context *context, const brc_grid *grid, const brc_fill *fill, const brc_walls *walls,
                          double **position, int64_t *n, int64_t *n_duplicate);

#endif
