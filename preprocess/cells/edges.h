/* Seeds around straight concave edges. Mirror images of random seeds round such an edge off; a ring of seeds at equal
 * angles around it is its own image across both walls, and so its faces lie in both walls up to the edge. */
#ifndef BRC_PREPROCESS_EDGES_H
#define BRC_PREPROCESS_EDGES_H

#include "walls.h"

/* Place rings of seeds along the straight concave edges of the walls' solid that are longer than two spacings, in place
 * of the seeds nearer to the edge than about the rings. Seeds position [*n][3] (a block of base/memory.h) keep their
 * order, rings follow; the result depends on them alone. Along an edge the rings lie at random as `spread` (0..1) says.
 * Nothing where walls are not mirrored. BRC_NO_MEMORY. */
brc_status brc_edges_place(brc_context *context, const brc_walls *walls, double spacing, double spread, uint64_t seed,
                           int n_threads, double **position, int64_t *n);

#endif
