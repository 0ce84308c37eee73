/* Four doubles at once, by the vectors of gcc and clang. Functions that have them are compiled for any processor and
 * for those that have wide registers, and chosen where they run: no product and sum are contracted, so the bits are the
 * same. */
#ifndef BRC_PREPROCESS_PACKING_LANES_H
#define BRC_PREPROCESS_PACKING_LANES_H

#include <stdbool.h>
#include <stdint.h>

typedef double brc_pack_quad __attribute__((vector_size(32)));
typedef int64_t brc_pack_quad_mask __attribute__((vector_size(32))); /* -1 where a comparison holds, else 0 */
/* The same, anywhere in memory. */
typedef double brc_pack_quad_in_memory __attribute__((vector_size(32), aligned(8)));
typedef int64_t brc_pack_quad_mask_in_memory __attribute__((vector_size(32), aligned(8)));

/* Of functions that are compiled several times. */
#define BRC_PACK_INLINE static inline __attribute__((always_inline))
/* Before the names of functions for processors that have these; the second is defined only where it can be compiled. */
#ifdef __x86_64__
#define BRC_PACK_AVX2 __attribute__((target("avx2")))
#ifdef __clang__
#define BRC_PACK_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl")))
#else
#define BRC_PACK_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
static inline bool brc_pack_has_avx2(void)
{
    return __builtin_cpu_supports("avx2");
}
static inline bool brc_pack_has_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}
#else
#define BRC_PACK_AVX2
static inline bool brc_pack_has_avx2(void)
{
    return false;
}
#endif

#endif
