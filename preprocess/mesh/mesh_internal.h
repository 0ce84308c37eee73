/* What the files of a mesh share: its arrays, and the steps from facets of a file to a checked surface. Triangles are
 * stored in the order of the search tree, vertices in the order of their first use. */
#ifndef BRC_PREPROCESS_MESH_INTERNAL_H
#define BRC_PREPROCESS_MESH_INTERNAL_H

#include "mesh.h"
#include "vector3.h"

/* A node of the tree; the first child follows its node. Its box is for lines and overlaps; its disc, which lies along
 * the surface, holds the triangles of small nodes so tightly that few are opened where the surface is about equally
 * far. */
typedef struct brc_mesh_node {
    float low[3], high[3];      /* rounded outward [m] */
    float centre[3], normal[3]; /* of the disc: [m], unit */
    float half, radius;         /* half its thickness, its radius [m]; half < 0: none */
    int32_t next;               /* leaf: its first triangle; else the second child */
    int32_t count;              /* leaf: its triangles; else 0 */
    int32_t patch;              /* the patch of all triangles below; -1: several */
} brc_mesh_node;

enum {
    BRC_MESH_STACK = 128
}; /* deeper than any tree of 2^31 triangles whose nodes give at least a quarter to each child */

/* Bits of brc_mesh.flags: edge k of the triangle is sharp (30 degrees and more); sharp and concave; the triangle is
 * thinner than the rounding of the file, so that its own normal means nothing. */
#define BRC_MESH_SHARP(k) (1u << (k))
#define BRC_MESH_CONCAVE(k) (8u << (k))
#define BRC_MESH_SLIVER 64u

struct brc_mesh {
    int32_t n_triangles, n_vertices, n_nodes, n_patches, n_shells;
    double (*vertex)[3];  /* [n_vertices] [m] */
    int32_t (*corner)[3]; /* [n_triangles] counter-clockwise from outside */
    int32_t (*across)[3]; /* [n_triangles] half-edge 3 t + k on the other side of edge k (from corner k to k + 1) */
    uint8_t *flags;       /* [n_triangles] */
    double (*normal)[3];  /* [n_triangles] outward unit; slivers: their neighbour's; flat patches: the patch's */
    double (*vertex_normal)[3]; /* [n_vertices] weighted by the angles of the triangles (Baerentzen & Aanaes 2005), any
                                   length */
    int32_t *patch;             /* [n_triangles] */
    bool *patch_flat;           /* [n_patches] */
    brc_mesh_node *node;
    double bounds[2][3];
    double size;     /* diagonal of the bounds [m] */
    double rounding; /* what single precision cannot tell apart: 4 * 2^-24 of the largest coordinate of the file [m] */
    double volume, area;
    bool convex;
    /* only while a file is read: */
    int32_t *facet; /* [n_triangles] number of the triangle in the file, from 0 */
    int32_t *shell; /* [n_triangles] connected piece of the surface */
};

/* Where a mesh comes from: for sentences. */
typedef struct brc_mesh_source {
    const char *path;
    double scale, offset[3];
    int n_threads;
} brc_mesh_source;

enum { BRC_MESH_PLACE = 96 };
/* "(x, y, z)" in units of the file. Returns text. */
const char *brc_mesh_place(const brc_mesh_source *source, const double x[3], char text[BRC_MESH_PLACE]);

/* mesh_stl.c: corners of all facets as the file has them, finite; the caller frees with brc_memory_free. At most
 * 7e8. */
brc_status brc_mesh_read_facets(brc_context *context, const char *path, double (**corner)[3], int32_t *n_facets);
/* mesh_weld.c: takes the corners (now in metres) as vertices, joins equal ones, drops facets with two equal corners. */
brc_status brc_mesh_weld(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source, double (*corner)[3],
                         int32_t n_facets);
/* Fill bounds and size from the vertices. */
void brc_mesh_measure(brc_mesh *mesh);
/* mesh_edges.c: fill across; refuse open edges and edges of three and more triangles. */
brc_status brc_mesh_join_edges(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source);
/* Make neighbours agree about outside (the majority of a shell counts); fill shell and n_shells. */
brc_status brc_mesh_orient(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source);
/* mesh_mend.c: flip the longest edges of triangles without height; then give every fan of triangles at a vertex a
 * vertex of its own. */
brc_status brc_mesh_mend(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source);
brc_status brc_mesh_split_fans(brc_context *context, brc_mesh *mesh);
/* mesh_tree.c: build the tree and put triangles and vertices in its order. */
brc_status brc_mesh_plant(brc_context *context, brc_mesh *mesh);
/* mesh_cut.c: refuse triangles that cut or touch each other. */
brc_status brc_mesh_check_cuts(brc_context *context, const brc_mesh *mesh, const brc_mesh_source *source);
/* mesh_shells.c: turn shells that are inside out; refuse nested ones that do not alternate; fill volume and area. */
brc_status brc_mesh_nest(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source);
/* mesh_patch.c: normals, sharp edges, patches, convexity. */
brc_status brc_mesh_smooth(brc_context *context, brc_mesh *mesh);

/* Called for every triangle that the line x + t e_axis crosses, in the order of the tree. */
typedef void brc_mesh_hit(void *of, int32_t triangle, double t);
void brc_mesh_pierce(const brc_mesh *mesh, const double x[3], int axis, brc_mesh_hit *hit, void *of);

/* Feature of a triangle nearest to a point: its face, edge k, or corner k. */
enum { BRC_MESH_FACE = 0, BRC_MESH_EDGE = 1, BRC_MESH_CORNER = 4 };
/* Nearest point of triangle t to x; returns the feature it lies on (BRC_MESH_EDGE + k, ...). */
int brc_mesh_nearest_of(const brc_mesh *mesh, int32_t t, const double x[3], double point[3]);
/* The next corner 3 t + k around the same vertex, clockwise seen from outside. */
static inline int32_t brc_mesh_turn(const brc_mesh *mesh, int32_t corner)
{
    const int32_t h = mesh->across[corner / 3][corner % 3];
    return h % 3 == 2 ? h - 2 : h + 1;
}
/* Twice the area vector of triangle t; its height above its longest edge in *height, that edge in *longest. */
void brc_mesh_area_vector(const brc_mesh *mesh, int32_t t, double out[3]);
double brc_mesh_height(const brc_mesh *mesh, int32_t t, int *longest);
/* Reverse the marked triangles and their links. */
void brc_mesh_reverse(brc_mesh *mesh, const uint8_t *marked);

#endif
