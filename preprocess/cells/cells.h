/* The Voronoi cells of all seeds, computed in parallel by runs of elements. A run has a fixed number of elements and
 * keeps its results apart, so nothing depends on which thread computed it. */
#ifndef BRC_PREPROCESS_CELLS_H
#define BRC_PREPROCESS_CELLS_H

#include "voronoi.h"

/* Elements of a run. */
#define BRC_RUN_LENGTH 1024

/* Faces and corners of the elements of a run, element after element. Positions are absolute. */
typedef struct brc_cell_run {
    /* shared faces, by ascending neighbour within an element */
    int64_t n_faces, room_faces;
    int32_t *neighbour; /* [n_faces] */
    double *area;       /* [n_faces] seen from this element [m^2] */
    double *centroid;   /* [n_faces][3] [m] */
    /* free faces, by ascending wall and plane within an element */
    int64_t n_free, room_free;
    int32_t *free_wall;    /* [n_free] */
    double *free_geometry; /* [n_free][6] area vector [m^2], centroid [m] */
    int32_t *free_corners; /* [n_free] number of corners of its polygon */
    int64_t n_polygon, room_polygon;
    int32_t *polygon; /* [n_polygon] indices of corners within their element */
    /* corners */
    int64_t n_vertices, room_vertices;
    double *vertex; /* [n_vertices][3] [m] */
} brc_cell_run;

typedef struct brc_cells {
    int64_t n_elements, n_runs;
    brc_together together;
    brc_cell_run *run;      /* [n_runs] run r holds the elements r * BRC_RUN_LENGTH .. */
    int32_t *n_faces;       /* [n_elements] shared faces */
    int32_t *n_free;        /* [n_elements] free faces */
    int32_t *n_corners;     /* [n_elements] */
    double *volume;         /* [n_elements] [m^3] */
    double *centroid;       /* [n_elements][3] [m] */
    double *inertia;        /* [n_elements][6] about the centroid at unit density [m^5] */
    double farthest_corner; /* of any cell from its seed [m]; HUGE_VAL where a cell reaches beyond mirrored walls */
} brc_cells;

/* Compute all cells. BRC_INTERNAL when a cell comes out wrong (with the element and its position), BRC_BAD_INPUT and
 * BRC_NO_MEMORY as brc_voronoi_create. Cells that reach beyond mirrored walls are no failure but have no place in a
 * domain: see farthest_corner. n_threads >= 1. Caller frees with brc_cells_free. */
brc_status brc_cells_compute(brc_context *context, const double *position, int64_t n, const brc_walls *walls,
                             double spacing, int n_threads, brc_together together, brc_cells *cells);
/* Free the shared faces of a run, one run, or everything; all accept what is already free. */
void brc_cell_run_free_faces(brc_cell_run *run);
void brc_cell_run_free(brc_cell_run *run);
void brc_cells_free(brc_cells *cells);

/* One Lloyd sweep: replace every seed by the centroid of its cell. together: all ranks do. */
brc_status brc_cells_relax(brc_context *context, double *position, int64_t n, const brc_walls *walls, double spacing,
                           int n_threads, bool together, const char *what);

#endif
