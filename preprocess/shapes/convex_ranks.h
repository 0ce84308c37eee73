/* The polyhedra of a domain that all ranks (host/base/ranks.h) have, once a machine. */
#ifndef BRC_PREPROCESS_CONVEX_RANKS_H
#define BRC_PREPROCESS_CONVEX_RANKS_H

#include "../../host/base/machine_memory.h"
#include "convex.h"

enum {
    BRC_CONVEX_CORNER_START,
    BRC_CONVEX_CORNER,
    BRC_CONVEX_FACE_START,
    BRC_CONVEX_PLANE,
    BRC_CONVEX_LOOP_START,
    BRC_CONVEX_LOOP,
    BRC_CONVEX_RADIUS,
    BRC_CONVEX_ARRAYS
};

typedef struct brc_convex_common {
    brc_convex all;
    brc_common_memory memory[BRC_CONVEX_ARRAYS]; /* where its arrays are */
} brc_convex_common;

/* All ranks: the cells of the domain as by brc_convex_of_domain, then `more` (NULL: none). The ranks of a machine make
 * a part each. Spheres have places among all, but no corners. BRC_BAD_INPUT, BRC_INTERNAL, BRC_NO_MEMORY as there.
 * Caller frees. */
brc_status brc_convex_share(brc_context *context, const brc_domain *domain, const brc_convex *more, int n_threads,
                            brc_convex_common *out);
void brc_convex_common_free(brc_convex_common *convex);

#endif
