/* What the files that make polyhedra share. */
#ifndef BRC_PREPROCESS_CONVEX_INTERNAL_H
#define BRC_PREPROCESS_CONVEX_INTERNAL_H

#include "convex.h"

/* Room for n polyhedra with so many corners and faces in all, but for loops. Refused: 2^31 of anything. On failure the
 * caller frees. */
brc_status brc_convex_allocate(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces, brc_convex *out);
/* Once loop_start[f + 1] holds the number of corners of face f: make rows of it, and room for the loops. */
brc_status brc_convex_allocate_loops(brc_context *context, brc_convex *convex);
/* The smallest radius that holds all corners of polyhedron p. */
double brc_convex_reach(const brc_convex *convex, int32_t p);

#endif
