/* From cells to half-edges: every shared face becomes a bond with two half-edges that know each other, with exactly
 * opposite area vectors and the same centroid. */
#ifndef BRC_PREPROCESS_HALFEDGE_H
#define BRC_PREPROCESS_HALFEDGE_H

#include "cells.h"

/* Fill the half-edges, bonds, free faces, corners and mass of `domain`, whose n_elements and position are set. Walls'
 * names are not touched. Faces below tiny_face_threshold of the mean face area, and faces only one side has, are
 * dropped and counted in domain->quality. `cells` is used up (freed run by run); after a failure free both.
 * BRC_NO_MEMORY; BRC_BAD_INPUT when there are more half-edges than 2^31 or a dropped one-sided face is not tiny. */
brc_status brc_half_edges_build(brc_context *context, brc_cells *cells, double tiny_face_threshold, int n_threads,
                                brc_domain *domain);

#endif
