/* A shape made ready for questions: is this point inside, and where does the surface come near it? All kinds of shapes
 * answer the same questions, so that seeds, packings and cells of any shape are made by the same code. Coordinates are
 * those of the shape, before the body's pose. Every function but create and free only reads: threads may share a
 * solid. */
#ifndef BRC_PREPROCESS_SOLID_H
#define BRC_PREPROCESS_SOLID_H

#include "../domain/build.h"

typedef struct brc_solid brc_solid;

/* One place where the surface comes near a point x inside the solid. */
typedef struct brc_foot {
    double depth;     /* distance from x [m], > 0 */
    double normal[3]; /* unit vector from x to the foot: outward */
    int32_t wall;     /* index of the wall */
    bool plane;   /* the wall is flat there and its plane bounds the solid all around x: mirror images across it stay
                   * exact   even where the foot lies beyond an edge */
    double rough; /* a mean plane of a rough mesh: so far the surface stands off it [m]; else 0 */
    bool hull;    /* and it has the whole solid on one side (brc_solid_hull_plane) */
} brc_foot;

/* A straight edge around which the solid takes up more than 180 degrees. */
typedef struct brc_edge {
    double end[2][3];    /* [m] */
    double normal[2][3]; /* outward unit normals of the two walls that meet there */
} brc_edge;

/* Check and prepare. BRC_BAD_INPUT with what to change: sizes that are not finite and positive, a torus that meets
 * itself, parts that leave nothing, unreadable, open or self-intersecting meshes. Caller frees with brc_solid_free. */
brc_status brc_solid_create(brc_context *context, const brc_shape *shape, int n_threads, brc_solid **out);
void brc_solid_free(brc_solid **solid);

/* The shape it was made of (a copy; parts are owned by the solid). */
const brc_shape *brc_solid_shape(const brc_solid *solid);
/* Smallest and largest corner [m], tight. */
void brc_solid_bounds(const brc_solid *solid, double bounds[2][3]);
/* Volume [m^3]: exact for single shapes (a mesh: of the mesh); of parts by exact chords along a fine grid of rays, with
 * the relative error estimate *error (0 where exact; may be NULL). */
double brc_solid_volume(const brc_solid *solid, double *error);
/* Area of the surface [m^2], to a few percent (used for estimates). */
double brc_solid_surface(const brc_solid *solid);
int32_t brc_solid_n_walls(const brc_solid *solid);
/* Static for the solid's life. */
const char *brc_solid_wall_name(const brc_solid *solid, int32_t wall);
/* Is it an intersection of half-spaces (curved walls count as many)? */
bool brc_solid_is_convex(const brc_solid *solid);
/* Is x inside, at least `margin` >= 0 [m] away from the surface? */
bool brc_solid_inside(const brc_solid *solid, const double x[3], double margin);
/* The feet of x nearer than `reach` [m]: one per smooth piece of the surface (each wall of each part, each smooth patch
 * of a mesh), in a fixed order. At most `most` are written, the nearest ones; returns how many there are. A point
 * outside gives none. Where a mesh is so rough that dozens of patches come near, feet are its nearest points in
 * directions at least 45 degrees apart. On a concave edge the foot is the nearest point of the edge. */
int32_t brc_solid_feet(const brc_solid *solid, const double x[3], double reach, brc_foot *feet, int32_t most);
/* The same, and more planes across which images of x bound the cell of x (mirror.h): tangent planes whose foot lies
 * beyond an edge, and, where the solid is thinner than `reach` [m], tangent planes all around; there `depth` is the
 * distance of x to the plane. Rough meshes: mean planes over a quarter of the reach. */
int32_t brc_solid_mirrors(const brc_solid *solid, const double x[3], double reach, brc_foot *feet, int32_t most);
/* Distance of x to the surface [m]: positive inside, negative outside. */
double brc_solid_depth(const brc_solid *solid, const double x[3]);
/* Distance of x, inside or outside, to the surface, or `reach` [m] where it is not nearer. */
double brc_solid_distance(const brc_solid *solid, const double x[3], double reach);
/* Is x outside, at least `distance` [m] away from the solid? */
bool brc_solid_clear(const brc_solid *solid, const double x[3], double distance);
/* The straight concave edges: between planes of parts, and of a mesh that is added. */
int32_t brc_solid_n_edges(const brc_solid *solid);
const brc_edge *brc_solid_edge(const brc_solid *solid, int32_t edge);
/* Length of the straight way from a to b that is outside [m]. */
double brc_solid_outside(const brc_solid *solid, const double a[3], const double b[3]);
/* Is an edge nearer to x than `reach` [m] where two of the solid's walls meet from the inside of an angle beyond 180
 * degrees? */
bool brc_solid_concave_edge_near(const brc_solid *solid, const double x[3], double reach);
/* The planes with the whole solid on one side that are walls: x is on it or inside where normal . x <= offset [m]. */
int32_t brc_solid_n_hull_planes(const brc_solid *solid);
void brc_solid_hull_plane(const brc_solid *solid, int32_t plane, double normal[3], double *offset, int32_t *wall);

#endif
