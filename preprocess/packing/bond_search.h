/* Which pairs of spheres are the nearest, measured by d / (R_i + R_j): the search behind beams.h. */
#ifndef BRC_PREPROCESS_BOND_SEARCH_H
#define BRC_PREPROCESS_BOND_SEARCH_H

#include "../../host/base/status.h"
#include <stdint.h>

/* The n_pairs pairs with the smallest d / (R_i + R_j), ties by the smaller index, then the larger: *pair [n_pairs][2],
 * smaller index first, in an order that depends on the input alone; freed by brc_memory_free. *growth: the largest
 * ratio among them. 1 <= n_pairs <= n (n - 1) / 2; positions and radii finite, radii positive. BRC_BAD_INPUT: two
 * spheres in one place (nearer than 1e-6 of the sum of their radii). */
brc_status brc_bond_search(brc_context *context, const double *position, const double *radius, int64_t n,
                           int64_t n_pairs, int n_threads, int32_t (**pair)[2], double *growth);

#endif
