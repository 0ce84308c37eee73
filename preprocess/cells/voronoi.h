/* Voronoi cells of points inside walls: Voro++ behind plain C. Arrays in, one convex polyhedron a call out; no C++ type
 * and no exception crosses this header. */
#ifndef BRC_PREPROCESS_VORONOI_H
#define BRC_PREPROCESS_VORONOI_H

#include "walls.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A convex cell relative to its seed. Corners are counter-clockwise seen from outside. */
typedef struct brc_polyhedron {
    int32_t n_vertices, n_faces;
    const double *vertex;       /* [n_vertices][3] relative to the seed [m] */
    const int32_t *face_start;  /* [n_faces + 1] */
    const int32_t *face_vertex; /* [face_start[n_faces]] indices into vertex */
    const int32_t
        *face_other; /* [n_faces] the neighbour's index; n + g: ghost g; below 0: -1 - side of the box, BRC_PLANE(k) */
} brc_polyhedron;

/* How a face on plane k of the walls is marked in face_other, and back. */
#define BRC_PLANE(k) (-7 - (k))

/* The points and the walls, sorted for the search: read only once created, shared by all workers. */
typedef struct brc_voronoi brc_voronoi;
/* What one thread needs to compute cells. */
typedef struct brc_voronoi_worker brc_voronoi_worker;

/* position: [n][3], borrowed, as are the walls with their ghosts, until brc_voronoi_free. spacing: typical distance of
 * points [m]. BRC_BAD_INPUT when a point is not finite, outside the walls or equal to another (Voro++ would lose it
 * silently), or when the points are so crowded that Voro++ would give up by ending the program; BRC_NO_MEMORY. */
brc_status brc_voronoi_create(brc_context *context, const double *position, int64_t n, const brc_walls *walls,
                              double spacing, brc_voronoi **out);
void brc_voronoi_free(brc_voronoi **voronoi);

/* NULL when memory is exhausted; may be called by several threads at once (uses no context). Free before `voronoi`. */
brc_voronoi_worker *brc_voronoi_worker_create(const brc_voronoi *voronoi);
void brc_voronoi_worker_free(brc_voronoi_worker **worker);
/* Cell of point e. *cell points into the worker and is valid until its next call. The result depends on the points and
 * walls alone, not on the worker. BRC_INTERNAL (no sentence is recorded: threads share no context): no cell came out;
 * BRC_NO_MEMORY. */
brc_status brc_voronoi_cell(brc_voronoi_worker *worker, int64_t e, brc_polyhedron *cell);

#ifdef __cplusplus
}
#endif

#endif
