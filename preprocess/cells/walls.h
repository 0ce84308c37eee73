/* The walls that cut the cells of a solid. Three kinds: sides of the box Voro++ works in, planes, and mirror images of
 * the seeds (mirror.h). A curved wall of a cylinder, cone or sphere is one fixed set of planes for the whole shape, so
 * that two neighbouring cells are cut by the same plane; planes that have all of a composed shape on one side cut as
 * they are; every other wall is made by mirror images. */
#ifndef BRC_PREPROCESS_WALLS_H
#define BRC_PREPROCESS_WALLS_H

#include "../shapes/solid.h"

/* Read only once the mirror images are made, so threads may share it. */
typedef struct brc_walls {
    const brc_solid *solid; /* borrowed */
    double box[2]
              [3]; /* where Voro++ works: the solid's own sides where they are walls, else a margin beyond them [m] */
    int32_t side_wall[6]; /* wall of the box side x- x+ y- y+ z- z+; -1: outside the solid, cuts nothing */
    bool flat_side[6];    /* is that side of the solid's bounds a flat wall? */

    brc_shape_kind round; /* whose curved wall stands as planes: cylinder, cone, sphere; box: none */
    int axis;             /* cylinder, cone */
    double slope;         /* cone: of its polygon's inner radius along the axis, seen from the tip; else 0 [-] */
    int32_t n_planes;     /* planes of the curved wall: normal . (x - centre) <= offset */
    double *normal;       /* [n_planes][3] outward unit vectors, owned */
    double offset;        /* the same for all planes [m]: it gives the polyhedron the exact volume of the shape */
    double centre[3];     /* of the curved wall; cone: its tip [m] */
    int32_t plane_wall;   /* wall of every plane */

    int32_t n_flats;    /* more planes: normal . x <= offset */
    double *flat;       /* [n_flats][4] outward unit normal, offset [m], owned */
    int32_t *flat_wall; /* [n_flats] owned */

    bool mirrored; /* the other walls are mirror images of the seeds near them: */
    double reach;  /* of seeds not farther from the wall [m] */
    int64_t n_ghosts;
    double *ghost;        /* [n_ghosts][3] [m], owned */
    int32_t *ghost_wall;  /* [n_ghosts] owned */
    int32_t *ghost_owner; /* [n_ghosts] seed it is the image of, ascending; owned */
    double *ghost_foot;   /* [n_ghosts][4] outward unit normal, depth of the seed below the foot [m]; owned */
    double *ghost_rough;  /* [n_ghosts] how far the surface stands off the mirror's plane, 0: it is smooth [m], owned */
    bool *ghost_flat;     /* [n_ghosts] the wall is plane there; owned */
} brc_walls;

/* Planes that stand for the curved wall: about as wide as a cell of size `spacing` [m], and never few. 0: not this way,
 * also for a cone that is narrower than a cell at one end. */
double brc_walls_n_planes(const brc_shape *shape, double spacing);

/* Walls fine against `spacing`, the size of a cell [m]; no mirror images yet. Caller frees with brc_walls_free. */
brc_status brc_walls_create(brc_context *context, const brc_solid *solid, double spacing, brc_walls *walls);
void brc_walls_free(brc_walls *walls);
/* Make the box hold mirror images of seeds not farther than `reach` [m] from the surface. */
void brc_walls_set_reach(brc_walls *walls, double reach);
/* The planes of the curved wall that may be nearer than `reach` [m] to x: *first .. *first + *count, indices modulo
 * n_planes. A superset: ask brc_walls_depth for each. */
void brc_walls_near(const brc_walls *walls, const double x[3], double reach, int64_t *first, int64_t *count);
/* Distance of x to plane k, positive inside [m]; the flat planes follow those of the curved wall. */
double brc_walls_depth(const brc_walls *walls, int32_t k, const double x[3]);
/* Outward unit normal and wall of plane k. */
const double *brc_walls_normal(const brc_walls *walls, int32_t k);
int32_t brc_walls_wall(const brc_walls *walls, int32_t k);
/* Move x, a point inside, away from mirrored walls until it is `distance` [m] from them. A seed nearer to its image
 * than that leaves corners as inexact as Voro++ compares. */
void brc_walls_keep_off(const brc_walls *walls, double distance, double x[3]);
/* Is x at least `margin` [m] inside every wall? */
bool brc_walls_inside(const brc_walls *walls, const double x[3], double margin);

#endif
