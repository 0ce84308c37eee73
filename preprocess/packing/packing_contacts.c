/* Contacts between spheres, those of several at once. */
#include "packing_internal.h"

#include <math.h>

#define JOINED(name, lanes) name##_##lanes
#define JOIN(name, lanes) JOINED(name, lanes)
#define LANED(name) JOIN(name, LANES)

/* Four spheres are read as the rows of a table and become its columns: x, y, z, radius. */
#define LANED_FUNCTION BRC_PACK_INLINE
#define LANES 4
#define READ(sphere, index, l) (*(const brc_pack_quad_in_memory *)(sphere)[(index)[l]])
#define EVEN(a, b) __builtin_shufflevector(a, b, 0, 4, 2, 6)
#define ODD(a, b) __builtin_shufflevector(a, b, 1, 5, 3, 7)
#define LOW(a, b) __builtin_shufflevector(a, b, 0, 1, 4, 5)
#define HIGH(a, b) __builtin_shufflevector(a, b, 2, 3, 6, 7)
#include "packing_contacts.def"
#undef LANES
#undef READ
#undef EVEN
#undef ODD
#undef LOW
#undef HIGH

static void add_up_anywhere(const brc_pack *pack, int64_t g, brc_pack_contact_sums *out)
{
    add_up_4(pack, g, 0, out);
    add_up_4(pack, g, 4, out);
}

BRC_PACK_AVX2 static void add_up_avx2(const brc_pack *pack, int64_t g, brc_pack_contact_sums *out)
{
    add_up_4(pack, g, 0, out);
    add_up_4(pack, g, 4, out);
}

/* Two such tables side by side. */
#ifdef BRC_PACK_AVX512
#define LANES 8
#define READ(sphere, index, l)                                                                                         \
    __builtin_shufflevector(*(const brc_pack_quad_in_memory *)(sphere)[(index)[l]],                                    \
                            *(const brc_pack_quad_in_memory *)(sphere)[(index)[(l) + 4]], 0, 1, 2, 3, 4, 5, 6, 7)
#define EVEN(a, b) __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14)
#define ODD(a, b) __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15)
#define LOW(a, b) __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13)
#define HIGH(a, b) __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15)
#undef LANED_FUNCTION
#define LANED_FUNCTION BRC_PACK_AVX512 static inline
#include "packing_contacts.def"

BRC_PACK_AVX512 static void add_up_avx512(const brc_pack *pack, int64_t g, brc_pack_contact_sums *out)
{
    add_up_8(pack, g, 0, out);
}
#endif

brc_pack_add_contacts *brc_pack_contacts_of_group(void)
{
#ifdef BRC_PACK_AVX512
    if (brc_pack_has_avx512()) return add_up_avx512;
#endif
    return brc_pack_has_avx2() ? add_up_avx2 : add_up_anywhere;
}
