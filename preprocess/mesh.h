/* Closed triangle meshes: read from STL, checked, and asked for the nearest surface. A search tree makes every question
 * logarithmic; all but reading and freeing are safe from any thread. */
#ifndef BRC_PREPROCESS_MESH_H
#define BRC_PREPROCESS_MESH_H

#include "../host/base/status.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct brc_mesh brc_mesh;

/* A point of the surface near a point x. */
typedef struct brc_mesh_foot {
    double point[3];  /* nearest point of the patch to x [m] */
    double normal[3]; /* outward unit normal of the triangle it lies on */
    double distance;  /* |x - point| [m] */
    bool on_edge;     /* the nearest point lies on the rim of its patch (a sharp edge) */
    bool concave;     /* and the solid's angle there is larger than 180 degrees */
    bool flat;        /* the patch is plane */
    int32_t patch;
} brc_mesh_foot;

/* Read a binary or ASCII STL file (told apart by content and length, not by its first word). Equal vertices are welded (exactly
 * equal, then within 1e-9 of the size); degenerate triangles are dropped; a mesh turned inside out is turned round. BRC_BAD_INPUT names path and
 * what is wrong: not STL, truncated (bytes found and expected; for ASCII the line), not finite, open (number of open edges and the first
 * one's end points), an edge with more than two triangles, orientation that disagrees, triangles that cut each other (the first pair and
 * where), no volume; each with the cure. `scale`: metres per unit of the file; `offset` [m] is added. BRC_FILE_FAILED: cannot be read. */
brc_status brc_mesh_read_stl(brc_context *context, const char *path, double scale, const double offset[3], int n_threads, brc_mesh **out);
void brc_mesh_free(brc_mesh **mesh);

int64_t brc_mesh_n_triangles(const brc_mesh *mesh);
void brc_mesh_bounds(const brc_mesh *mesh, double bounds[2][3]);
/* Exact volume [m^3] and area [m^2] of the mesh. */
double brc_mesh_volume(const brc_mesh *mesh);
double brc_mesh_area(const brc_mesh *mesh);
/* Is it convex (every vertex on or below every triangle's plane, to 1e-9 of its size)? */
bool brc_mesh_is_convex(const brc_mesh *mesh);
/* Is x inside? Robust at edges and vertices (generalised sign of the nearest feature, or a winding number). */
bool brc_mesh_inside(const brc_mesh *mesh, const double x[3]);
/* Distance of x to the surface [m]: positive inside, negative outside. */
double brc_mesh_depth(const brc_mesh *mesh, const double x[3]);
/* Patches: pieces of the surface within which neighbouring triangles meet at less than 30 degrees. */
int32_t brc_mesh_n_patches(const brc_mesh *mesh);
/* The nearest point of every patch nearer than `reach` [m], by ascending patch; at most `most` are written; returns how many there are. */
int32_t brc_mesh_feet(const brc_mesh *mesh, const double x[3], double reach, brc_mesh_foot *feet, int32_t most);
/* Where the line {x + t e_axis} enters and leaves the mesh: t ascending, in pairs, at most `most` written; returns how many. Lines through
 * an edge or vertex are counted consistently (a fixed symbolic shift), so the number is always even. */
int32_t brc_mesh_crossings(const brc_mesh *mesh, const double x[3], int axis, double *t, int32_t most);

#endif
