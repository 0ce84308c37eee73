/* Building a domain: shape -> seeds -> cells -> half-edges, sets and quality. Knows no scene and no device. */
#ifndef BRC_PREPROCESS_BUILD_H
#define BRC_PREPROCESS_BUILD_H

#include "domain.h"

/* Leaves are axis-aligned; a body's pose, or the pose of a part, turns them. Walls: box x- x+ y- y+ z- z+; cylinder and
 * cone along x: x- x+ side (a cone that ends in a tip has no wall there); sphere, torus, mesh: surface; half-space:
 * cut. In a shape of several parts the walls of a part with a name are "<name>_<wall>" (walls of equal name are one).
 * A disc is a short cylinder, a plate a flat box. */
typedef enum brc_shape_kind {
    BRC_SHAPE_BOX,
    BRC_SHAPE_CYLINDER,
    BRC_SHAPE_SPHERE,
    BRC_SHAPE_CONE,       /* a cone or frustum: radius at the first end, radius2 at the other; one of them may be 0 */
    BRC_SHAPE_TORUS,      /* radius: of the ring's centre line, radius2 < radius: of the tube; axis: of the ring */
    BRC_SHAPE_HALF_SPACE, /* only as a part: the points with (x - origin) . normal <= 0 */
    BRC_SHAPE_MESH,       /* a closed triangle mesh from an STL file */
    BRC_SHAPE_PARTS       /* unions, differences and intersections of the others */
} brc_shape_kind;

struct brc_shape_part;

typedef struct brc_shape {
    brc_shape_kind kind;
    double origin[3]; /* box: smallest corner; cylinder, cone: centre of the first end; sphere, torus: centre;
                       * half-space: a point of the plane; mesh: added to every vertex after scaling [m] */
    double size[3];   /* box: edge lengths [m] */
    double length;    /* cylinder, cone: along the axis [m] */
    double radius;    /* cylinder, sphere; cone: at the first end; torus: of the centre line [m] */
    double radius2;   /* cone: at the other end; torus: of the tube [m] */
    int axis;         /* cylinder, cone, torus: 0 x, 1 y, 2 z; end walls are named after it: "y-" "y+" */
    double normal[3]; /* half-space: outward, any length */
    char file[512];   /* mesh: path of an STL file, ASCII or binary */
    double scale;     /* mesh: metres per unit of the file [m] */
    int32_t n_parts;  /* parts, applied in order to what came before; the first is added */
    struct brc_shape_part *parts; /* [n_parts] borrowed here; owned by the scene where a scene holds the shape */
} brc_shape;

typedef enum brc_part_role {
    BRC_PART_ADD,    /* union */
    BRC_PART_REMOVE, /* difference */
    BRC_PART_KEEP    /* intersection */
} brc_part_role;

typedef struct brc_shape_part {
    brc_part_role role;
    char name[32];   /* "" : its walls keep their plain names */
    brc_shape shape; /* never BRC_SHAPE_PARTS */
    double translation[3],
        rotation[3]; /* as brc_build_request: about the origin of the part's shape, then moved [m], [rad] */
} brc_shape_part;

/* A point of a cumulative distribution of radii. */
typedef struct brc_radius {
    double radius;   /* only ratios count when the number of elements is given [m] */
    double fraction; /* of the elements (by number) that are smaller: 0 at the first point, 1 at the last, not falling
                        [-] */
} brc_radius;

typedef enum brc_fill_kind { BRC_FILL_NOISY_GRID, BRC_FILL_PACKING, BRC_FILL_POINTS } brc_fill_kind;

typedef struct brc_fill {
    brc_fill_kind kind;
    int64_t n_elements; /* grid, packing: wanted number of elements (grid: as nearly as it allows; packing: exactly); 0:
                         * grid: use spacing or cells; packing: by radius; points: all */
    double spacing;     /* grid: spacing [m]; 0: not given */
    int64_t cells[3];   /* grid: cells along x, y, z of the shape's bounding box; 0 0 0: not given */
    double spread;      /* grid: 0..1, width of the uniform noise over the grid cell (AGH19 section 7.1, d) */
    int32_t lloyd_sweeps; /* each moves every seed to its cell's centroid; cells only */
    double min_distance;  /* seeds nearer than this to an earlier one are dropped [m]; 0: 1e-6 of the spacing */
    uint64_t seed;
    /* packing */
    double radius;            /* mean radius [m] when n_elements is 0: the number follows from it */
    double radius_spread;     /* 0..0.9: radii uniform in mean * (1 -+ radius_spread); without a table */
    int32_t n_radii;          /* table of radii; 0: uniform */
    struct brc_radius *radii; /* [n_radii] ascending; linear between its points; owned as shape.parts */
    double coordination;      /* stop when 2 contacts / elements is this (walls not counted); 0: use volume_fraction */
    double volume_fraction;   /* stop at this; 0: use coordination */
    double tolerance;         /* on the coordination number, default 0.02 [-] */
    int32_t cut; /* 0: packed between the walls of the shape; 1: cut out of a larger packing, which has no layers along
                  * the walls; the number of elements is then met nearly */
    bool check_crystal; /* measure crystallisation and say so */
    /* points */
    char file[512]; /* CSV (x, y, z[, radius]) or LAMMPS data file; positions in units of `scale` metres */
    double scale;
} brc_fill;

/* Where: a predicate on a free face's centroid and outward normal, or on an element's position. All given parts must
 * hold. Tolerances are absolute [m]. */
typedef struct brc_predicate {
    bool has_body;
    char body_name[64]; /* as the scene gives it; `body` decides */
    int32_t body;       /* brc_domain.body of the elements, or of those the faces belong to; -1: none */
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
    char place[BRC_PLACE_LENGTH]; /* in the scene file, of its errors; "": made in code */
} brc_set_request;

/* A crack that is there from the start: the bonds whose face it crosses are cut, the two sides become free faces of the
 * wall `name`. */
typedef enum brc_crack_kind {
    BRC_CRACK_DISC,     /* penny: centre, normal, radius */
    BRC_CRACK_RECTANGLE /* corner, two edges that span it (need not be at right angles) */
} brc_crack_kind;

typedef struct brc_crack {
    char name[32];
    brc_crack_kind kind;
    double point[3];   /* disc: centre; rectangle: corner [m], posed coordinates */
    double normal[3];  /* disc: any length */
    double radius;     /* disc [m] */
    double edge[2][3]; /* rectangle: the edges from the corner [m] */
    bool flat;         /* cells: seeds near it are mirrored, so that faces lie in its plane and end at straight sides */
} brc_crack;

/* Grains: a coarse Voronoi tessellation over the elements; an element belongs to the grain whose centre is nearest. */
typedef struct brc_grains {
    int64_t n;   /* number of grains; 0: by size */
    double size; /* cube root of the mean grain volume [m]; 0: by number. Both 0: no grains */
    uint64_t seed;
    int32_t n_phases;       /* 0: all grains keep the body's material */
    const double *fraction; /* [n_phases] share of the grains (by number), summing to at most 1; borrowed. Phase p gives
                             * its grains the region n_regions + 1 + p; the rest keep what they have */
} brc_grains;

/* What `quality` may refuse: a number of brc_quality or brc_isotropy by name. */
typedef struct brc_quality_limit {
    char number[64]; /* see quality.h */
    bool has_warn, has_refuse;
    double warn, refuse; /* beyond (above, or below for numbers where less is worse) */
} brc_quality_limit;

/* Which of several ranks (host/base/ranks.h) compute cells, and who has them then. */
typedef enum brc_together {
    BRC_ALONE,    /* this one computes all */
    BRC_TOGETHER, /* all, each a range of runs, and all get all of them */
    BRC_APART     /* all, and corners and shared faces of cells stay where they were computed (domain.h, here) */
} brc_together;

typedef struct brc_build_request {
    brc_shape shape;
    brc_fill fill;
    double beams;  /* spheres joined by beams in place of cells: mean coordination number of the bonds; 0: cells */
    bool balanced; /* beams: bonds alike in all directions (bond_balance.h) */
    double translation[3]; /* [m] applied after the rotation */
    double rotation[3];    /* rotation vector (axis times angle) about the shape's origin [rad] */
    int32_t n_cracks;
    const brc_crack *cracks; /* [n_cracks] borrowed */
    brc_grains grains;
    int32_t n_limits;
    const brc_quality_limit *limits; /* [n_limits] borrowed */
    int32_t n_sets;
    const brc_set_request *sets; /* [n_sets] borrowed; predicates in posed coordinates */
    int32_t n_regions;
    const brc_predicate
        *regions;               /* [n_regions] borrowed; element in region r + 1 if its position fits; the last wins */
    double tiny_face_threshold; /* [-] of the mean face area; faces below it are dropped; 0: default 1e-12 */
    int64_t n_points;           /* of a fill of points given here, which fill.file then only names; 0: read the file */
    const double *points;       /* [n_points][3] borrowed [m] */
    const double *radii;        /* [n_points] borrowed [m]; NULL: points without radii */
    int32_t n_threads;          /* 0: as OpenMP decides. The result does not depend on it, bit for bit. */
    brc_together together;
    int32_t body; /* written into brc_domain.body */
} brc_build_request;

/* Build. BRC_BAD_INPUT (spread outside 0..1, an empty set, an unknown wall, fewer than 1 element, less than two cells
 * across the shape's thinnest direction, more elements than memory holds: each with what to change), BRC_NO_MEMORY.
 * On success *out is owned by the caller. Progress lines go to the context's log. */
brc_status brc_domain_build(brc_context *context, const brc_build_request *request, brc_domain **out);

/* Expected n_elements and bytes of the finished domain, without building. */
brc_status brc_domain_estimate(brc_context *context, const brc_build_request *request, int64_t *n_elements,
                               int64_t *bytes);

/* Join several bodies into one domain (no bonds between them); element, face and vertex indices follow the order of the
 * inputs; walls and sets of equal name are merged. Inputs stay with the caller. name [n]: what sentences call the
 * bodies, NULL: by number, from 0. together: as the bodies were built; where BRC_APART all ranks call, which then have
 * cells between them, and what they have of a body at home moves. BRC_BAD_INPUT: no body, cells with spheres, bodies
 * that overlap (overlap.h), sets of two kinds under one name, more than 2^31 of anything; BRC_NO_MEMORY. */
brc_status brc_domain_join(brc_context *context, int32_t n, const brc_domain *const *parts, const char *const *name,
                           brc_together together, brc_domain **out);

#endif
