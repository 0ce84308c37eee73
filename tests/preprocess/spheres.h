/* Spheres of known places for the tests of sphere domains. */
#ifndef BRC_TEST_PREPROCESS_SPHERES_H
#define BRC_TEST_PREPROCESS_SPHERES_H

#include "../../preprocess/domain/build.h"

/* A box of (count[0], count[1], count[2]) metres at the origin with one sphere a cubic metre: radius 0.45 m -+ 10 %,
 * moved by up to 0.1 m from the middle; those of the outermost layers touch their walls exactly. Bonds of this
 * coordination number; walls, sets, quality, regions (0), body and provenance are there. The test fails with the
 * context's sentence. The caller frees it. */
brc_domain *test_spheres(brc_context *context, const int count[3], double coordination, int32_t body, int n_threads);

#endif
