/* Shapes before their pose: bounds, exact volume and the walls that cut the cells. A curved wall is one fixed set of
 * planes for the whole shape, so that two neighbouring cells are cut by the same plane. */
#ifndef BRC_PREPROCESS_SHAPE_H
#define BRC_PREPROCESS_SHAPE_H

#include "build.h"

/* The convex polyhedron that stands for a shape: the sides of a box, and planes for the curved part. Read only after
 * brc_walls_create, so threads may share it. */
typedef struct brc_walls {
    brc_shape shape;
    double box[2][3];     /* where Voro++ works: the shape's own sides, or a margin beyond the curved part [m] */
    int32_t side_wall[6]; /* wall of the box side x- x+ y- y+ z- z+; -1: outside the curved wall, cuts nothing */
    int32_t n_planes;     /* planes of the curved wall: normal . (x - centre) <= offset */
    double *normal;       /* [n_planes][3] outward unit vectors, owned */
    double offset;        /* the same for all planes [m]: it gives the polyhedron the exact volume of the shape */
    double centre[3];     /* of the curved wall [m] */
    int32_t plane_wall;   /* wall of every plane */
    int32_t n_walls;
    const char *wall_name[6];
} brc_walls;

/* Refuse a shape with sizes that are not finite and positive (BRC_BAD_INPUT with the size found). */
brc_status brc_shape_check(brc_context *context, const brc_shape *shape);
/* Smallest and largest corner [m]. */
void brc_shape_bounds(const brc_shape *shape, double bounds[2][3]);
/* Exact volume of the (curved) shape [m^3]. */
double brc_shape_volume(const brc_shape *shape);

/* Planes that stand for the curved wall: about as wide as a cell of size `spacing` [m], and never few. */
double brc_shape_planes(const brc_shape *shape, double spacing);

/* Walls fine against `spacing`, the size of a cell [m]. Caller frees with brc_walls_free. */
brc_status brc_walls_create(brc_context *context, const brc_shape *shape, double spacing, brc_walls *walls);
void brc_walls_free(brc_walls *walls);
/* The planes that may be nearer than `reach` [m] to x: *first .. *first + *count, indices modulo n_planes. A superset:
 * ask brc_walls_depth for each. */
void brc_walls_near(const brc_walls *walls, const double x[3], double reach, int64_t *first, int64_t *count);
/* Distance of x to plane k, positive inside [m]. */
double brc_walls_depth(const brc_walls *walls, int32_t k, const double x[3]);
/* Is x at least `margin` [m] inside every wall? */
bool brc_walls_inside(const brc_walls *walls, const double x[3], double margin);

#endif
