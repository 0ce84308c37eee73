/* Meshes for tests: lists of triangles of simple bodies, written as STL. */
#ifndef BRC_TEST_PREPROCESS_SUPPORT_MESH_H
#define BRC_TEST_PREPROCESS_SUPPORT_MESH_H

#include "../../preprocess/mesh/mesh.h"
#include <stdint.h>

/* Begin with {0}; free with test_mesh_free. */
typedef struct test_mesh {
    double (*corner)[3]; /* [3 n] */
    int64_t n, capacity; /* triangles */
} test_mesh;

void test_mesh_free(test_mesh *mesh);
void test_mesh_add(test_mesh *mesh, const double a[3], const double b[3], const double c[3]);
/* A box whose faces have n x n squares of two triangles; twelve triangles for n = 1. */
void test_mesh_box(test_mesh *mesh, const double low[3], const double high[3], int n);
/* An octahedron of 8 f^2 triangles pushed out to the sphere. */
void test_mesh_sphere(test_mesh *mesh, const double centre[3], double radius, int f);
/* About z, n around the axis, m around the tube. */
void test_mesh_torus(test_mesh *mesh, double radius, double tube, int n, int m);
/* (2 x 2) - (1 x 1) in x and y, from z = 0 to `height`; the concave edge is x = y = 1. 20 triangles. */
void test_mesh_l_profile(test_mesh *mesh, double height);
/* Move every vertex away from the centre, or towards it, by up to `amplitude`: a scan's noise, each vertex by itself
 * (wavelength 0), or bumps as long as `wavelength`. A surface all of which is seen from the centre does not cut itself
 * for that. */
void test_mesh_roughen(test_mesh *mesh, const double centre[3], double amplitude, double wavelength);
/* Reverse triangles first, first + step, ... */
void test_mesh_reverse(test_mesh *mesh, int64_t first, int64_t step);
/* Turn by the angle about (1, 2, 3), then move. */
void test_mesh_turn(test_mesh *mesh, double angle, const double shift[3]);
/* Write as binary STL (single precision) or ASCII (17 digits); fails the test when it cannot. */
void test_mesh_write_binary(const test_mesh *mesh, const char *path);
void test_mesh_write_ascii(const test_mesh *mesh, const char *path);
/* Write (ASCII), read with scale 1 and remove the file; NULL with the context's sentence when it is refused. */
brc_mesh *test_mesh_read(brc_context *context, const test_mesh *mesh, int n_threads, brc_status *status);

/* References without a tree. Winding number of the list around x (J. van Oosterom & J. Strackee, IEEE Trans. Biomed.
 * Eng. 30 (1983) 125), and the distance of x to it. */
double test_mesh_winding(const test_mesh *mesh, const double x[3]);
double test_mesh_distance(const test_mesh *mesh, const double x[3]);

#endif
