/* Philox 4x32-10: counter = (a, b), key = seed, its use mixed in by a first round of its own, so that neither 64-bit id
 * nor the 64-bit seed loses a bit. */
#include "random.h"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

/* A 32-bit word as a double strictly inside (0, 1): the middle of its cell, exact in double. */
static double to_unit(uint32_t word)
{
    return ((double)word + 0.5) * (1.0 / 4294967296.0);
}

void brc_random_uniform4(uint64_t seed, brc_random_use use, uint64_t a, uint64_t b, double out[4])
{
    const philox4x32_key_t seed_key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    const philox4x32_ctr_t use_counter = {{(uint32_t)use, 0, 0, 0}};
    const philox4x32_ctr_t stream = philox4x32(use_counter, seed_key);
    const philox4x32_key_t key = {{stream.v[0], stream.v[1]}};
    const philox4x32_ctr_t counter = {{(uint32_t)a, (uint32_t)(a >> 32), (uint32_t)b, (uint32_t)(b >> 32)}};
    const philox4x32_ctr_t draw = philox4x32(counter, key);
    for (int k = 0; k < 4; ++k)
        out[k] = to_unit(draw.v[k]);
}
