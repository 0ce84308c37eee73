/* Areas, centroids, volume and inertia of one convex cell, from its corners. Everything is relative to the seed, so
 * that a cell far from the origin loses no digits. */
#ifndef BRC_PREPROCESS_POLYHEDRON_H
#define BRC_PREPROCESS_POLYHEDRON_H

#include "voronoi.h"

/* Face f: its area vector projected on the unit `normal` (outward) and its centroid moved onto the plane
 * normal . x = height, both of which the corners meet only to rounding. area [m^2] may be 0 for a degenerate face. */
void brc_polyhedron_face(const brc_polyhedron *cell, int32_t f, const double normal[3], double height, double *area,
                         double centroid[3]);
/* Volume [m^3], centroid relative to the seed [m] and inertia tensor about the centroid at unit density
 * (xx yy zz yz xz xy, off-diagonal terms negative products) [m^5]. */
void brc_polyhedron_mass(const brc_polyhedron *cell, double *volume, double centroid[3], double inertia[6]);

#endif
