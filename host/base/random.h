/* Counter-based random numbers (Philox 4x32-10 of Random123): a draw depends on its key and counter alone, not on the
 * order of draws, on threads or on the device. */
#ifndef BRC_BASE_RANDOM_H
#define BRC_BASE_RANDOM_H

#include <stdint.h>

/* What a draw is for: part of the key, so that two uses of one seed never share numbers. Append only. */
typedef enum brc_random_use {
    BRC_RANDOM_GRID_NOISE = 1,
    BRC_RANDOM_POWER_ITERATION = 2,
    BRC_RANDOM_MODES = 3,
    BRC_RANDOM_INITIAL_FIELD = 4,
    BRC_RANDOM_TEST = 5,
    BRC_RANDOM_PACKING_POSITION = 6,
    BRC_RANDOM_PACKING_RADIUS = 7,
    BRC_RANDOM_GRAIN = 8,
    BRC_RANDOM_GRAIN_PHASE = 9,
    BRC_RANDOM_EDGE_RING = 10,
    BRC_RANDOM_STRENGTH = 11,
    BRC_RANDOM_FEATURE = 12,
    BRC_RANDOM_SKIN = 13,
    BRC_RANDOM_STUDY = 14,
} brc_random_use;

/* Four doubles uniform in (0, 1), a function of (seed, use, a, b) alone. a, b: ids of the thing drawn for. */
void brc_random_uniform4(uint64_t seed, brc_random_use use, uint64_t a, uint64_t b, double out[4]);

#endif
