/* The cells of a domain as closed polyhedra that share their corners, for files and pictures. A domain keeps the
 * corners of each cell apart; here those of neighbours are one point wherever a face joins them, so that the points
 * come apart along a crack and nowhere else. */
#ifndef BRC_PREPROCESS_TESSELLATION_H
#define BRC_PREPROCESS_TESSELLATION_H

#include "../domain/domain.h"

/* Corners of a cell nearer to each other than this are one corner, and corners of two cells further apart than this are
 * not the same [of the cube root of the cell's volume]. Which corners of neighbours are one is asked of the face that
 * both share, never of space. */
#define BRC_TESSELLATION_NEAR 1e-6

typedef struct brc_tessellation {
    const brc_domain *domain; /* borrowed; of cells */
    /* faces of element e: outline_start[e] .. outline_start[e + 1], those it shares in the order of its half-edges, its
     * free ones, and those that were too small to be kept as faces (found from the edges they left open); without
     * corners where a face is of no use */
    int64_t *outline_start; /* [n_elements + 1] */
    int64_t *corner_start;  /* [n_outlines + 1] */
    int32_t *corner;        /* counter-clockwise from outside: indices into domain->vertex */
    int8_t *turn;   /* [n_bonds] corner k of the bond's face is corner (turn - k) mod n of the twin's; -1: look for the
                       nearest */
    int32_t *order; /* [n_elements] elements along a curve that keeps neighbours together */
    /* after brc_tessellation_join: points, numbered along that curve, so that those in one place, where bonds broke,
     * are near each other in files; of element e: their number, those of its faces, and those of the corners of its
     * faces are differences of the starts */
    int64_t n_points;
    bool plain; /* no corners of a cell are one point by way of its neighbours: the starts depend on the domain alone */
    int32_t *point;       /* [vertex_start[n_elements]] of each corner; -1: of no face, or nearly another of its cell */
    int32_t *first;       /* [n_points] the first corner that is the point: where it is */
    int64_t *point_start; /* [n_elements + 1] */
    int64_t *face_start;  /* [n_elements + 1] */
    int64_t *loop_start;  /* [n_elements + 1] */
} brc_tessellation;

/* n_threads 0: as OpenMP decides; the result does not depend on it. BRC_NO_MEMORY. Caller frees with
 * brc_tessellation_free; spheres give no outlines. */
brc_status brc_tessellation_create(brc_context *context, const brc_domain *domain, int n_threads,
                                   brc_tessellation *out);
/* Number the points. whole: [n_half_edges], 0 where the bond is broken and joins nothing; NULL: all are whole.
 * BRC_NO_MEMORY. */
brc_status brc_tessellation_join(brc_context *context, const uint8_t *whole, int n_threads, brc_tessellation *t);
/* Points of element e into out, each once. Returns their number. */
int64_t brc_tessellation_points(const brc_tessellation *t, int64_t e, int32_t *out);
/* Faces of element e: corners of each, and their points one after another, counter-clockwise from outside. Returns the
 * number of faces. */
int64_t brc_tessellation_faces(const brc_tessellation *t, int64_t e, int32_t *n_corners, int32_t *points);
/* The most points, faces, and corners of faces of any element. */
void brc_tessellation_most(const brc_tessellation *t, int64_t *points, int64_t *faces, int64_t *corners);
void brc_tessellation_free(brc_tessellation *t);

#endif
