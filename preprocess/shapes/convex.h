/* Convex polyhedra as flat arrays, ready for a device (convex_overlap.h): the cells of a domain, and the pieces
 * of rigid shapes. */
#ifndef BRC_PREPROCESS_CONVEX_H
#define BRC_PREPROCESS_CONVEX_H

#include "../domain/build.h"

/* A polyhedron has at most so many faces and corners a face, if it is to meet any other such one safely: what the
 * kernel has room for is their sum (CONVEX_POLYGON). Rigid shapes may have more faces; their faces are cut into parts
 * of one plane with at most BRC_CONVEX_PART corners. */
enum { BRC_CONVEX_FACES = 64, BRC_CONVEX_CORNERS = 64, BRC_CONVEX_PART = 32 };

/* n polyhedra. Corners and planes are relative to the origin of each, which lies in it or near it. */
typedef struct brc_convex {
    int32_t n;
    int32_t *corner_start; /* [n + 1] */
    double *corner;        /* [corner_start[n]][3] [m] */
    int32_t *face_start;   /* [n + 1] */
    double *plane;         /* [face_start[n]][4] outward unit normal [-], height over the origin [m] */
    int32_t *loop_start;   /* [face_start[n] + 1] into loop */
    int32_t *loop;         /* corners of each face, counter-clockwise from outside, counted within the polyhedron */
    double *radius;        /* [n] of the sphere about the origin that holds all corners [m] */
} brc_convex;

/* Volume, mass centre and inertia tensor (about it, at unit density: xx yy zz yz xz xy, off-diagonal terms negative
 * products). */
typedef struct brc_rigid {
    double volume, centre[3], inertia[6]; /* [m^3], [m], [m^5] */
} brc_rigid;

/* The cells of a domain, in its order, origins at the positions. The faces of a cell: those it shares, in the order of
 * its half-edges, then its free ones. BRC_BAD_INPUT: spheres, a cell with more faces or corners a face than the limits;
 * BRC_INTERNAL: corners that do not outline a face, a cell that fails brc_convex_check; BRC_NO_MEMORY. Caller frees.
 * n_threads 0: as OpenMP decides; the result does not depend on it. */
brc_status brc_convex_of_domain(brc_context *context, const brc_domain *domain, int n_threads, brc_convex *out);

/* A rigid body of this shape as convex pieces, origins at its mass centre, which is given in the coordinates of the
 * shape. Boxes and convex meshes are themselves. Curved shapes have `facets` flat faces (8 or more) around a full turn:
 * cylinders and cones regular prisms and frusta, spheres the planes at the vertices of a halved icosahedron that has at
 * least nearly as many around (icosphere.h), rings as many straight pieces of as many faces, each so that the volume is
 * the shape's; their mass properties are those of the smooth shape, to rounding. Anything else (parts, meshes that are
 * not convex) is filled with convex cells, about `pieces` of them, and has the mass properties of these cells.
 * BRC_BAD_INPUT as brc_solid_create and brc_domain_build; BRC_NO_MEMORY. Caller frees *out. */
brc_status brc_convex_of_shape(brc_context *context, const brc_shape *shape, int32_t facets, int32_t pieces,
                               int n_threads, brc_convex *out, brc_rigid *rigid);

/* Every polyhedron is convex and closed, and its loops turn outward: each corner on or behind each plane, on those of
 * its faces, area vectors that sum to zero, to `tolerance` of its size (squared). BRC_INTERNAL names the polyhedron and
 * by how much it fails. */
brc_status brc_convex_check(brc_context *context, const brc_convex *convex, double tolerance);

/* Volume, centroid relative to the origin, and inertia of polyhedron p. */
void brc_convex_mass(const brc_convex *convex, int32_t p, brc_rigid *out);

void brc_convex_free(brc_convex *convex);

#endif
