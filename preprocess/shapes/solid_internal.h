/* What the files of a solid share. A solid is a list of leaves combined left to right; a leaf is what lies below all of
 * its surfaces, each a plane, an endless cylinder or cone, a sphere, a torus or a closed mesh, already turned and moved
 * by the pose of its part. */
#ifndef BRC_PREPROCESS_SOLID_INTERNAL_H
#define BRC_PREPROCESS_SOLID_INTERNAL_H

#include "../mesh/mesh.h"
#include "solid.h"

typedef enum brc_surface_kind {
    BRC_SURFACE_PLANE,
    BRC_SURFACE_CYLINDER, /* about an endless axis */
    BRC_SURFACE_SPHERE,
    BRC_SURFACE_CONE, /* one nappe, endless; `point` is its tip and `axis` points into it */
    BRC_SURFACE_TORUS,
    BRC_SURFACE_MESH
} brc_surface_kind;

typedef struct brc_surface {
    brc_surface_kind kind;
    int32_t leaf, wall;
    double point[3];        /* of the plane, on the axis, centre, tip [m] */
    double axis[3];         /* unit; plane: outward normal of the leaf */
    double radius, radius2; /* torus: of the centre line, of the tube [m] */
    double sine, cosine;    /* of the cone's half angle */
    double hull;            /* plane: 1 when the whole solid lies on its inner side, -1 on its outer side, else 0 */
} brc_surface;

typedef struct brc_leaf {
    brc_part_role role;
    brc_shape shape;
    int32_t first, n_surfaces;
    brc_mesh *mesh;
    bool posed;                /* turned or moved at all */
    double frame[3][3];        /* columns: axes of the part in the shape */
    double pivot[3], shift[3]; /* x = pivot + frame (X - pivot) + shift */
    double bounds[2][3];       /* of the turned leaf [m] */
} brc_leaf;

struct brc_solid {
    brc_shape shape;
    brc_shape_part *parts;
    int32_t n_leaves, n_surfaces, n_walls;
    brc_leaf *leaf;
    brc_surface *surface;
    char (*wall_name)[72];
    int32_t n_edges;
    brc_edge *edge; /* [n_edges] */
    double bounds[2][3];
    double volume, volume_error, area;
    double tiny; /* a step off a surface that tells its sides apart [m] */
    bool convex;
};

double brc_dot3(const double a[3], const double b[3]);
double brc_length3(const double a[3]);

/* solid_leaf.c: make the leaf of a shape (its walls too), and its support: the largest direction . x in it. */
brc_status brc_leaf_create(brc_context *context, brc_solid *solid, const brc_shape_part *part, int n_threads);
double brc_leaf_support(const brc_leaf *leaf, const double direction[3]);
bool brc_leaf_inside(const brc_solid *solid, const brc_leaf *leaf, const double x[3]);
/* From the shape's coordinates to those of the part, and directions both ways. */
void brc_leaf_to_part(const brc_leaf *leaf, const double x[3], double out[3]);
void brc_leaf_turn(const brc_leaf *leaf, const double direction[3], double out[3]);
void brc_leaf_from_part(const brc_leaf *leaf, const double x[3], double out[3]);

/* solid_surface.c: height of x above the surface (negative inside the leaf) and the unit normal at the nearest point,
 * which is x - height normal; normal may be NULL. */
double brc_surface_height(const brc_solid *solid, const brc_surface *surface, const double x[3], double normal[3]);
/* On a curved surface around x: the other place where the distance is stationary, opposite the nearest one. Same
 * meaning; false: none. */
bool brc_surface_opposite(const brc_surface *surface, const double x[3], double *height, double normal[3]);
/* On a surface like a tube around x: tangent plane k of BRC_TUBE_PLANES all around, k = 0 at the nearest point; height
 * of x above it. False: no tube. */
#define BRC_TUBE_PLANES 8
bool brc_surface_around(const brc_surface *surface, const double x[3], int k, double *height, double normal[3]);
/* Where the line x + t direction meets the surface, any order; at most 4 (not for meshes). Returns how many. */
int brc_surface_crossings(const brc_surface *surface, const double x[3], const double direction[3], double t[4]);

/* solid.c: is x in the combination of all leaves? */
bool brc_solid_member(const brc_solid *solid, const double x[3]);

/* solid_feet.c: do two surfaces with these normals make a concave edge at x, where they meet? outward: normals of its
 * two walls. */
bool brc_solid_concave_there(const brc_solid *solid, const double x[3], const double a[3], const double b[3],
                             double outward[2][3]);

/* solid_rough.c: the walls of a rough mesh near x, inside or outside it: nearer than `reach` [m], nearest first, at
 * most `most`. mean: as mean planes, which a bump does not tilt; else through the nearest points. Returns how many. */
typedef struct brc_rough_wall {
    brc_mesh_foot foot;
    double normal[3], depth; /* unit vector from x to the plane, its distance from x [m] */
    double rough;            /* how far the surface stands off the plane there; 0 when not a mean one [m] */
} brc_rough_wall;
int32_t brc_rough_walls(const brc_mesh *mesh, const double x[3], double reach, bool mean, brc_rough_wall *walls,
                        int32_t most);

/* solid_edges.c */
brc_status brc_solid_find_edges(brc_context *context, brc_solid *solid);

/* solid_volume.c: the piece of a line within a box (false: it misses), and values put in order. */
bool brc_pass_box(const double bounds[2][3], const double x[3], const double u[3], double *low, double *high);
void brc_sort(double *t, int n);

/* solid_volume.c: fill bounds, volume and area of a solid of several parts. */
brc_status brc_solid_measure(brc_context *context, brc_solid *solid, int n_threads);

#endif
