/* Kinds of shapes as a table: one row a kind, with all that is asked of it. Curved walls, bounds and names of walls are
 * those of the shape where it was described, before a pose turns or moves it. */
#ifndef BRC_PREPROCESS_SHAPE_TYPE_H
#define BRC_PREPROCESS_SHAPE_TYPE_H

#include "../domain/build.h"
#include "../mesh/mesh.h"

struct brc_solid;
struct brc_leaf;

typedef struct brc_shape_type {
    brc_status (*check)(brc_context *context, const brc_shape *shape); /* BRC_BAD_INPUT: sizes that no such shape has */
    /* In words, but for where it is; room for the path of a file and more. */
    void (*words)(const brc_shape *shape, char *out, size_t room);
    /* Volume [m^3] and area [m^2]; NULL: it has none of its own. mesh: of the kind that has one. */
    void (*measure)(const brc_shape *shape, const brc_mesh *mesh, double *volume, double *area);
    /* The least width [m]; NULL: it has none. */
    double (*width)(const brc_shape *shape, const brc_mesh *mesh);
    /* Bounds from the origin [m]; NULL: not known without its file, or endless. */
    void (*bounds)(const brc_shape *shape, double low[3], double high[3]);
    /* Planes that stand for its curved wall between cells of this size; NULL: none do (walls.h). */
    double (*planes)(const brc_shape *shape, double spacing);
    /* Its surfaces and walls, added to the solid's last leaf; and the largest x . u over the leaf, added to `along`. */
    void (*surfaces)(struct brc_solid *solid, const char *part, const brc_shape *shape);
    double (*support)(const struct brc_leaf *leaf, const double u[3], double along);
    const char *closed_wall; /* whose area vectors sum to zero; NULL: none */
    int curved;              /* directions in which a wall is curved: 0, 1, 2 */
} brc_shape_type;

/* NULL: no such kind. */
const brc_shape_type *brc_shape_type_of(brc_shape_kind kind);

#endif
