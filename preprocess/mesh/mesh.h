/* Closed triangle meshes: read from STL, checked, and asked for the nearest surface. A search tree makes every question
 * logarithmic; all but reading and freeing are safe from any thread. */
#ifndef BRC_PREPROCESS_MESH_H
#define BRC_PREPROCESS_MESH_H

#include "../../host/base/status.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct brc_mesh brc_mesh;

/* A point of the surface near a point x. */
typedef struct brc_mesh_foot {
    double point[3];  /* nearest point of the patch to x [m] */
    double normal[3]; /* outward unit normal of the triangle it lies on; of the patch where that is flat */
    double distance;  /* |x - point| [m] */
    bool on_edge;     /* the nearest point lies on a sharp edge of its patch, or at its end */
    bool concave; /* and the solid's angle there is larger than 180 degrees (at a vertex: along any sharp edge of the
                     patch) */
    bool flat;    /* the patch is plane (to the rounding of the file) */
    int32_t patch;
} brc_mesh_foot;

/* Read a binary or ASCII STL file (told apart by content and length, not by its first word). Normals of the file are
 * not used.
 * - Equal vertices are welded (exactly equal, then within 1e-9 of the size). Triangles with two equal corners are
 *   dropped; those without
 *   height are mended by flipping their longest edge.
 * - Outside: neighbours that disagree are turned, the majority of each connected shell counts. Shells may lie side by
 *   side and within each
 *   other: the outermost bound solid, those in them cavities, and so on. An outermost shell that is inside out is
 *   turned round with all that lies in it; otherwise the orientation of the file stands and must alternate from shell
 *   to shell, as a file cannot say whether a shell within a shell that faces the same way is a cavity or an inclusion.
 * BRC_BAD_INPUT names path, what is wrong and the cure: unreadable, not STL, truncated (bytes found and expected;
 * ASCII: line and column), not finite, open (number of open edges and the first one's end points), an edge with more
 * than two triangles, a surface with one side, triangles that cut or touch others that are not their neighbours (how
 * many pairs, the first and where), shells that do not alternate, no volume. What the file's single precision cannot
 * tell apart (4 * 2^-24 of its largest coordinate) is no cut. `scale`: metres per unit of the file; `offset` [m] is
 * added. BRC_NO_MEMORY. n_threads 0: as OpenMP decides; the mesh does not depend on it. Caller frees *out. */
brc_status brc_mesh_read_stl(brc_context *context, const char *path, double scale, const double offset[3],
                             int n_threads, brc_mesh **out);
void brc_mesh_free(brc_mesh **mesh);

int64_t brc_mesh_n_triangles(const brc_mesh *mesh);
/* Its vertices [*n][3], and whether triangle t is more than a sliver: then its corners, counter-clockwise from
 * outside. */
const double (*brc_mesh_vertices(const brc_mesh *mesh, int32_t *n))[3];
bool brc_mesh_triangle(const brc_mesh *mesh, int64_t t, const int32_t **corners);
void brc_mesh_bounds(const brc_mesh *mesh, double bounds[2][3]);
/* Exact volume [m^3] and area [m^2] of the mesh. */
double brc_mesh_volume(const brc_mesh *mesh);
double brc_mesh_area(const brc_mesh *mesh);
/* Is it convex: one shell, concave at no edge by more than the rounding of the file, nor as a whole? */
bool brc_mesh_is_convex(const brc_mesh *mesh);
/* Is x inside or on the surface? As the sign of brc_mesh_depth, but cheaper far from the surface. */
bool brc_mesh_inside(const brc_mesh *mesh, const double x[3]);
/* Distance of x to the surface [m]: positive inside, negative outside. The sign is that of the nearest feature's
 * pseudonormal, weighted by angles at a vertex (J. A. Baerentzen & H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005)
 * 243). */
double brc_mesh_depth(const brc_mesh *mesh, const double x[3]);
/* Patches: pieces of the surface within which neighbouring triangles meet at less than 30 degrees. */
int32_t brc_mesh_n_patches(const brc_mesh *mesh);
/* An edge where the solid's angle is 210 degrees or more. */
typedef struct brc_mesh_edge {
    double end[2][3];    /* [m] */
    double normal[2][3]; /* outward unit normals of the two triangles; seen from outside the first triangle lies left of
                            the way from end 0 to end 1 */
} brc_mesh_edge;
/* The sharp concave edges, one entry an edge of the mesh, in the order of the mesh; at most `most` are written; returns
 * how many there are. */
int64_t brc_mesh_concave_edges(const brc_mesh *mesh, brc_mesh_edge *edges, int64_t most);
/* The nearest point of every patch nearer than `reach` [m], by ascending patch; returns how many there are. Where there
 * are more than `most`, the search stops, returns most + 1, and *feet holds nothing of use: ask brc_mesh_views. */
int32_t brc_mesh_feet(const brc_mesh *mesh, const double x[3], double reach, brc_mesh_foot *feet, int32_t most);
/* Of a surface with so many patches near x that they mean nothing, rough at the scale of `reach` [m]: the nearest point
 * of a triangle in each of BRC_MESH_VIEWS directions that has one nearer than that, nearest first; returns how many.
 * flat and on_edge are false; concave: the point lies on a sharp concave edge. */
enum { BRC_MESH_VIEWS = 384 };
int32_t brc_mesh_views(const brc_mesh *mesh, const double x[3], double reach, brc_mesh_foot feet[BRC_MESH_VIEWS]);
/* The mean plane of the surface around a point: of the triangles with centroids within `radius` [m] of it whose normals
 * are less than about 80 degrees from `normal`, which becomes that of their sum, unit and outward. *height: of the
 * plane along it [m], in the mesh's coordinates; *rough: how far corners stand off it, at most [m]. False: there are
 * none. */
bool brc_mesh_mean_plane(const brc_mesh *mesh, const double point[3], double radius, double normal[3], double *height,
                         double *rough);
/* Distance of x to the surface, or `reach` where it is not nearer [m]: without a side, and so faster than the depth. */
double brc_mesh_distance(const brc_mesh *mesh, const double x[3], double reach);
/* Where the line {x + t e_axis} enters and leaves the mesh: t ascending, in pairs, at most `most` written; returns how
 * many. Lines through an edge or vertex are counted consistently (a fixed symbolic shift), so the number is always
 * even. */
int32_t brc_mesh_crossings(const brc_mesh *mesh, const double x[3], int axis, double *t, int32_t most);
/* Where the line x + t u (u: unit) passes triangles with low < t < high, unordered, at most `most` written; returns how
 * many. At an edge both triangles may count, and one that is touched sideways: each piece between is to be asked for
 * its side. */
int32_t brc_mesh_passes(const brc_mesh *mesh, const double x[3], const double u[3], double low, double high, double *t,
                        int32_t most);

#endif
