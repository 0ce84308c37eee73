/* The surfaces of a solid near a point, and where they meet. */
#ifndef BRC_PREPROCESS_SOLID_NEAR_H
#define BRC_PREPROCESS_SOLID_NEAR_H

#include "solid_internal.h"

enum { BRC_NEAR_MOST = 128 }; /* surfaces near a point */

/* A surface near x, or its other side where it curves around x. */
typedef struct brc_near_surface {
    const brc_surface *surface;
    double height, normal[3], point[3];
    double probe[3]; /* across the surface at the point: the normal, but at a tip the axis */
    bool opposite;
    bool flat;           /* a plane */
    bool rim;            /* on a sharp edge of a mesh, where its patch ends */
    bool concave;        /* and that is concave, seen from the solid */
    double plane[3];     /* normal of a mesh's patch there */
    bool rough;          /* a wall of a rough mesh: */
    brc_rough_wall wall; /* normal from x outward */
} brc_near_surface;

/* out = x + length * direction. */
void brc_near_step(const double x[3], double length, const double direction[3], double out[3]);
/* Surfaces nearer to x than reach, in order; the opposite sides of curved ones too. mirror: rough meshes as mean
 * planes. */
int brc_near_gather(const brc_solid *solid, const double x[3], double reach, bool mirror, brc_near_surface *near);
/* Sides of a surface at y: is the solid there below it (bit 0), above it (bit 1)? */
int brc_near_sides(const brc_solid *solid, const double y[3], const double normal[3]);
/* Does the leaf itself end at y? */
bool brc_near_leaf_ends(const brc_solid *solid, const brc_near_surface *a);
/* Solve the small symmetric system of unit normals: find the combination of normals with the given heights along them.
 * n: 2 or 3; false when they are nearly parallel. */
bool brc_near_combine(int n, const double normal[3][3], const double value[3], double weight[3]);
/* The point nearest to x that lies on all n surfaces: tangent planes are cut until nothing moves. weight: x to the
 * point in terms of the normals there. False when the surfaces do not meet near x. */
bool brc_near_meet(const brc_solid *solid, const double x[3], int n, const brc_near_surface *const *a, double reach,
                   double y[3], double normal[3][3], double weight[3]);
/* Is the solid there in each of the 2^n sectors around a point where n surfaces meet? Bit s: sector where surface k is
 * above for each bit k of s. */
int brc_near_sectors(const brc_solid *solid, int n, const double y[3], const double normal[3][3]);
/* The only sector outside, -1 when there is none or another one. */
int brc_near_lone_outside(int n, int inside);

#endif
