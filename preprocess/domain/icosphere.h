/* Directions spread evenly over the sphere: an icosahedron whose triangles are halved again and again, the new vertices
 * moved onto the sphere. The vertices stand for the directions nearest to them. */
#ifndef BRC_PREPROCESS_ICOSPHERE_H
#define BRC_PREPROCESS_ICOSPHERE_H

#include "../../host/base/status.h"
#include <stdint.h>

#define BRC_ICOSPHERE_LEVEL_MOST 6

/* x, y and z are two-fold axes of the icosahedron and one of its three-fold axes is (1, 1, 1), so the three axes of a
 * grid meet equal bins, and so do all eight octants' diagonals. With every vertex there is its opposite, exactly. */
typedef struct brc_icosphere {
    int32_t level;
    int32_t n_vertices;  /* 10 * 4^level + 2 */
    double *vertex;      /* [n_vertices][3] unit vectors, those of coarser levels first; owned */
    int32_t *opposite;   /* [n_vertices] the vertex at -vertex; owned */
    double *solid_angle; /* [n_vertices] [sr] of the directions nearest to each; they sum to 4 pi; owned */
    int32_t n_triangles; /* 20 * 4^level */
    int32_t *triangle;   /* [n_triangles][3] of the finest level, counter-clockwise from outside; points into `tree` */
    int32_t *tree;       /* [20 (4^(level + 1) - 1) / 3][3] triangles of all levels, the coarsest first; triangle t of a
                          * level has the children 4 t ... 4 t + 3 of the next, the last one in its middle; owned */
} brc_icosphere;

/* BRC_BAD_INPUT: level outside 0..BRC_ICOSPHERE_LEVEL_MOST. */
brc_status brc_icosphere_make(brc_context *context, int level, brc_icosphere *out);
void brc_icosphere_free(brc_icosphere *sphere);
/* The vertex with the largest scalar product with `direction` (any length above 0), the smallest index where several
 * have it. Safe from any thread. */
int32_t brc_icosphere_nearest(const brc_icosphere *sphere, const double direction[3]);

#endif
