/* Building a domain: shape -> seeds -> cells -> half-edges, sets and quality. Knows no scene and no device. */
#ifndef BRC_PREPROCESS_BUILD_H
#define BRC_PREPROCESS_BUILD_H

#include "domain.h"

/* Axis-aligned before `pose`. Walls: box x- x+ y- y+ z- z+; cylinder along x: x- x+ side; sphere: surface.
 * A disc is a short cylinder, a plate a flat box. Curved walls are one fixed polyhedron per shape (regular prism,
 * geodesic planes), fine against the cell size and with the exact volume of the curved shape, so that two
 * neighbouring cells are cut by the same planes. */
typedef enum brc_shape_kind { BRC_SHAPE_BOX, BRC_SHAPE_CYLINDER, BRC_SHAPE_SPHERE } brc_shape_kind;

typedef struct brc_shape {
    brc_shape_kind kind;
    double origin[3]; /* box: smallest corner; cylinder: centre of the x- end; sphere: centre [m] */
    double size[3];   /* box: edge lengths [m] */
    double length;    /* cylinder: along its axis [m] */
    double radius;    /* cylinder, sphere [m] */
    int axis;         /* cylinder: 0 x, 1 y, 2 z; its end walls are named after it: "y-" "y+" */
} brc_shape;

typedef enum brc_fill_kind { BRC_FILL_NOISY_GRID } brc_fill_kind;

typedef struct brc_fill {
    brc_fill_kind kind;
    int64_t n_elements;  /* wanted number of elements (met as nearly as the grid allows); 0: use spacing or cells */
    double spacing;      /* grid spacing [m]; 0: not given */
    int64_t cells[3];    /* grid cells along x, y, z of the shape's bounding box; 0 0 0: not given */
    double spread;       /* 0..1: width of the uniform noise over the grid cell (AGH19 section 7.1, d) */
    int32_t lloyd_sweeps; /* each moves every seed to its cell's centroid */
    double min_distance; /* seeds nearer than this to an earlier one are dropped [m]; 0: 1e-6 of the spacing */
    uint64_t seed;
} brc_fill;

/* Where: a predicate on a free face's centroid and outward normal, or on an element's position. All given parts must
 * hold. Tolerances are absolute [m]. */
typedef struct brc_predicate {
    bool has_wall;
    char wall[32]; /* name of the wall the face belongs to (faces); elements: those with a face on it */
    bool has_box;
    double box[2][3]; /* smallest and largest corner, inclusive [m] */
    bool has_sphere;
    double sphere_centre[3], sphere_radius; /* inside, inclusive [m] */
    bool has_cylinder;
    double cylinder_point[3], cylinder_axis[3], cylinder_radius; /* inside the endless cylinder, inclusive [m] */
    bool has_half_space;
    double half_space_point[3], half_space_normal[3]; /* (x - point).normal >= 0 */
    bool has_normal;
    double normal[3], normal_angle; /* faces: outward normal within this angle [rad] of the direction */
} brc_predicate;

typedef struct brc_set_request {
    char name[64];
    brc_set_kind kind;
    brc_predicate where;
} brc_set_request;

typedef struct brc_build_request {
    brc_shape shape;
    brc_fill fill;
    double translation[3]; /* [m] applied after the rotation */
    double rotation[3];    /* rotation vector (axis times angle) about the shape's origin [rad] */
    int32_t n_sets;
    const brc_set_request *sets; /* [n_sets] borrowed; predicates in posed coordinates */
    int32_t n_regions;
    const brc_predicate *regions; /* [n_regions] borrowed; element in region r + 1 if its position fits; the last wins */
    double tiny_face_threshold;   /* [-] of the mean face area; faces below it are dropped; 0: default 1e-12 */
    int32_t n_threads;            /* 0: as OpenMP decides. The result does not depend on it, bit for bit. */
    int32_t body;                 /* written into brc_domain.body */
} brc_build_request;

/* Build. BRC_BAD_INPUT (spread outside 0..1, an empty set, an unknown wall, fewer than 1 element, less than two cells
 * across the shape's thinnest direction, more elements than memory holds: each with what to change), BRC_NO_MEMORY.
 * On success *out is owned by the caller. Progress lines go to the context's log. */
brc_status brc_domain_build(brc_context *context, const brc_build_request *request, brc_domain **out);

/* Expected n_elements and bytes of the finished domain, without building. */
brc_status brc_domain_estimate(brc_context *context, const brc_build_request *request, int64_t *n_elements,
                               int64_t *bytes);

/* Join several bodies into one domain (no bonds between them); element, face and vertex indices follow the order of the
 * inputs; walls and sets of equal name are merged. Inputs stay with the caller. */
brc_status brc_domain_join(brc_context *context, int32_t n, const brc_domain *const *parts, brc_domain **out);

#endif
