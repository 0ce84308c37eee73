/* Polyhedra for the tests of the overlap, and the kernel's functions read as plain C in double, eight lanes as the
 * cpu's kernels have. */
#ifndef BRC_TESTS_CONVEX_CASE_H
#define BRC_TESTS_CONVEX_CASE_H

#ifndef BRC_PRECISION
#define BRC_PRECISION 0
#endif
#define BRC_LANES 8
#define BRC_SLICE 8
#define BRC_MANY_MATERIALS 0
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpsabi"
#include "../../kernels/effects/contact/convex_sphere.h"
#include "../../kernels/effects/contact/convex_wall.h"
#include <stdint.h>

enum { CONVEX_CASE_CORNERS = 256, CONVEX_CASE_FACES = 256, CONVEX_CASE_LOOPS = 2048 };

typedef struct convex_case {
    int n_corners, n_faces;
    state corner[3 * CONVEX_CASE_CORNERS], plane[4 * CONVEX_CASE_FACES], radius;
    int loop_start[CONVEX_CASE_FACES + 1], loop[CONVEX_CASE_LOOPS];
} convex_case;

convex_shape convex_case_shape(const convex_case *c);
/* Planes and radius from corners and loops. */
void convex_case_finish(convex_case *c);
/* A box with these edges about the origin. */
void convex_case_box(convex_case *c, double x, double y, double z);
/* What lies behind all n planes ([n][4]: unit normal, height), by the corners of all triples of planes: slow, and
 * nothing of the kernel's way. Its volume, 0: nothing; c may be NULL. No four planes of a polyhedron to be kept may
 * meet in a corner. */
double convex_case_cut(const double (*plane)[4], int n, convex_case *c);

typedef enum convex_kind { CONVEX_ROUND, CONVEX_NEEDLE, CONVEX_FLAT, CONVEX_SLIVER, CONVEX_KINDS } convex_kind;
/* A random polyhedron about the origin of about n faces, 4 or more, with radii near 1; stretched 8 times, flattened to
 * a tenth or a hundredth. random: the state of its random numbers, any number to begin with. */
void convex_case_random(convex_case *c, convex_kind kind, int n, uint64_t *random);
/* Uniform in -1 .. 1. */
double convex_case_number(uint64_t *random);
/* A random rotation; and one times a deformation of about `strain`. */
convex_map convex_case_rotation(uint64_t *random);
convex_map convex_case_map(double strain, uint64_t *random);
/* The volume that both share, by convex_case_cut. */
double convex_case_shared(const convex_case *a, convex_pose pose_a, const convex_case *b, convex_pose pose_b);

#endif
