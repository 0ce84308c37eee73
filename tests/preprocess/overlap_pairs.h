/* Overlaps of many pairs of polyhedra by the kernel's functions: with eight lanes in double and in single precision,
 * and with one lane in double. */
#ifndef BRC_TEST_PREPROCESS_OVERLAP_PAIRS_H
#define BRC_TEST_PREPROCESS_OVERLAP_PAIRS_H

#include "../../preprocess/shapes/convex.h"

/* Where polyhedra `of` stand: origins near each other, maps row by row. */
typedef struct overlap_pair {
    int32_t of[2];
    double origin[2][3], map[2][9];
} overlap_pair;

typedef struct overlap_found {
    double volume, area[3], moment[2][9], point[3];
    int failed;
} overlap_found;

/* Seconds of processor time for all pairs. n_threads >= 1. */
double overlap_pairs_double(const brc_convex *convex, int64_t n, const overlap_pair *pair, int n_threads,
                            overlap_found *out);
double overlap_pairs_single(const brc_convex *convex, int64_t n, const overlap_pair *pair, int n_threads,
                            overlap_found *out);
double overlap_pairs_one_lane(const brc_convex *convex, int64_t n, const overlap_pair *pair, int n_threads,
                              overlap_found *out);

#endif
