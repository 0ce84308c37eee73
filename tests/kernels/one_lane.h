/* The kernels' headers read as plain C in double, one lane, and cmocka before them; include it before any header of
 * kernels/. */
#ifndef BRC_TESTS_ONE_LANE_H
#define BRC_TESTS_ONE_LANE_H

// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on
#include <math.h>
#define BRC_PRECISION 0
#define BRC_LANES 1
#define BRC_SLICE 1
#define BRC_MANY_MATERIALS 0
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include "../../host/base/random.h"

/* Number `which` of state `state`, uniform in (-1, 1): a function of seed, state and which alone. */
static inline double one_lane_uniform(uint64_t seed, int state, int which)
{
    double draws[4];
    brc_random_uniform4(seed, BRC_RANDOM_TEST, (uint64_t)state, (uint64_t)(which / 4), draws);
    return 2 * draws[which % 4] - 1;
}

#endif
