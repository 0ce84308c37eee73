/* What the files that make polyhedra share. */
#ifndef BRC_PREPROCESS_CONVEX_INTERNAL_H
#define BRC_PREPROCESS_CONVEX_INTERNAL_H

#include "convex.h"

/* Room for n polyhedra with so many corners and faces in all, but for loops. Refused: 2^31 of anything. On failure the
 * caller frees. */
brc_status brc_convex_allocate(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces, brc_convex *out);
/* Once loop_start[f + 1] holds the number of corners of face f: make rows of it, and room for the loops. */
brc_status brc_convex_allocate_loops(brc_context *context, brc_convex *convex);
/* 2^31 of anything is refused: BRC_BAD_INPUT. */
brc_status brc_convex_check_size(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces);
brc_status brc_convex_check_loops(brc_context *context, int64_t n_loops);
/* Where the faces of cell e begin among those of a domain. */
int64_t brc_convex_face_start(const brc_domain *domain, int64_t e);
/* Cells [first, end) of a domain into arrays that have room for all of them: first everything but loops, the number of
 * corners of face f at loop_start[f + 1]; once that is where they end, the loops. */
brc_status brc_convex_measure_cells(brc_context *context, const brc_domain *domain, int64_t first, int64_t end,
                                    int n_threads, brc_convex *out);
brc_status brc_convex_outline_cells(brc_context *context, const brc_domain *domain, int64_t first, int64_t end,
                                    int n_threads, brc_convex *out);
/* The smallest radius that holds all corners of polyhedron p. */
double brc_convex_reach(const brc_convex *convex, int32_t p);

#endif
