/* Neighbours in space near each other in memory: points along the Hilbert curve. */
#ifndef BRC_PREPROCESS_ORDER_H
#define BRC_PREPROCESS_ORDER_H

#include "../../host/base/status.h"
#include <stdint.h>

/* order[k] (k = 0 .. n - 1) is the point at place k along the Hilbert curve of 65536 cells a side over the cube at
 * bounds[0] that has the widest side of `bounds`; points of one cell follow their index. position [n][3] [m]; bounds
 * NULL: those of the points. n < 2^31. Points beyond the cube count as on its surface. The result does not depend on
 * n_threads (>= 1). BRC_NO_MEMORY (32 bytes a point while it runs). */
brc_status brc_order_hilbert(brc_context *context, const double *position, int64_t n, const double bounds[2][3],
                             int n_threads, int32_t *order);
/* Put points along the curve in place; radius [n] goes with them (may be NULL). For points drawn at random, before they
 * get ids: domains keep the order of their elements. BRC_BAD_INPUT: 2^31 points or more; BRC_NO_MEMORY. */
brc_status brc_order_points(brc_context *context, double *position, double *radius, int64_t n, int n_threads);

#endif
