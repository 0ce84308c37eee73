/* Records [element][n]: gathered from the elements of all lanes, stored to W own elements side by side. A record is
 * read whole, in vectors, and the records of the lanes are transposed where the instruction set has shuffles for it;
 * numbers one by one otherwise. Where an element's record begins is taken from the row number as a scalar: a vector of
 * places would have to be taken apart again (measured: bench/results/notes/performance.md). */
#ifndef BRC_KERNELS_RECORDS_H
#define BRC_KERNELS_RECORDS_H

#include "vec.h"

/* Numbers from anywhere. */
LAW lane gather_component(GLOBAL const coeff *restrict p, lane_int at)
{
#ifdef LANE_GATHER
    return LANE_GATHER(p, at);
#else
#define ITEM(l) p[LANE_ITEM(at, l)]
    return LANE_MAKE(lane, ITEM);
#undef ITEM
#endif
}
/* Number c of the record of n of each lane. */
LAW lane gather_number(GLOBAL const coeff *restrict p, lane_int row, brc_size n, brc_size c)
{
#define ITEM(l) p[(brc_size)LANE_ITEM(row, l) * n + c]
    return LANE_MAKE(lane, ITEM);
#undef ITEM
}
LAW lane_state gather_state_number(GLOBAL const state *restrict p, lane_int row, brc_size n, brc_size c)
{
#define ITEM(l) p[(brc_size)LANE_ITEM(row, l) * n + c]
    return LANE_MAKE(lane_state, ITEM);
#undef ITEM
}

#if LANE_SHUFFLES == 8 || STATE_SHUFFLES == 8
/* Stages of the 8 x 8 transposition: numbers, pairs, quads of two vectors. */
#define LANE_ZIP_LOW(a, b) LANE_SHUFFLE(a, b, 0, 8, 2, 10, 4, 12, 6, 14)
#define LANE_ZIP_HIGH(a, b) LANE_SHUFFLE(a, b, 1, 9, 3, 11, 5, 13, 7, 15)
#define LANE_PAIRS_LOW(a, b) LANE_SHUFFLE(a, b, 0, 1, 8, 9, 4, 5, 12, 13)
#define LANE_PAIRS_HIGH(a, b) LANE_SHUFFLE(a, b, 2, 3, 10, 11, 6, 7, 14, 15)
#define LANE_PAIRS_EVEN(a, b) LANE_SHUFFLE(a, b, 0, 1, 4, 5, 8, 9, 12, 13)
#define LANE_PAIRS_ODD(a, b) LANE_SHUFFLE(a, b, 2, 3, 6, 7, 10, 11, 14, 15)
#define LANE_QUADS_LOW(a, b) LANE_SHUFFLE(a, b, 0, 1, 2, 3, 8, 9, 10, 11)
#define LANE_QUADS_HIGH(a, b) LANE_SHUFFLE(a, b, 4, 5, 6, 7, 12, 13, 14, 15)
#endif
#if LANE_SHUFFLES && !defined(__OPENCL_VERSION__)
typedef state state_quad __attribute__((vector_size(4 * sizeof(state))));
typedef state_quad quad_anywhere __attribute__((aligned(4), may_alias));
#define STORE_SHUFFLES (BRC_PRECISION < 2)
#else
#define STORE_SHUFFLES 0
#endif
#if STATE_SHUFFLES == 8
#ifdef __OPENCL_VERSION__
typedef BRC_JOIN(STATE_NAME, 4) state_quad;
LAW state_quad state_quad_load(GLOBAL const state *restrict p, brc_size at) { return vload4(0, p + at); }
#else
LAW state_quad state_quad_load(const state *restrict p, brc_size at) { return *(const quad_anywhere *)(p + at); }
#endif
/* p[a .. a + 3], p[b .. b + 3] */
LAW lane_state state_load_pair(GLOBAL const state *restrict p, brc_size a, brc_size b)
{
    const state_quad low = state_quad_load(p, a), high = state_quad_load(p, b);
    return LANE_SHUFFLE(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
/* Four numbers of each lane: two lanes' records in one vector, then transposed. Vectors of doubles have one cheap
 * shuffle that chooses pairs of two vectors; those of floats another, within each half. */
typedef struct {
    lane_state c0, c1, c2, c3;
} state_columns;
LAW state_columns state_gather_columns(GLOBAL const state *restrict p, lane_int row, brc_size n)
{
#define PAIR(k, l) state_load_pair(p, (brc_size)LANE_ITEM(row, k) * n, (brc_size)LANE_ITEM(row, l) * n)
#if BRC_PRECISION < 2
    const lane_state r02 = PAIR(0, 2), r13 = PAIR(1, 3), r46 = PAIR(4, 6), r57 = PAIR(5, 7);
    const lane_state a0 = LANE_ZIP_LOW(r02, r13), a1 = LANE_ZIP_HIGH(r02, r13);
    const lane_state a2 = LANE_ZIP_LOW(r46, r57), a3 = LANE_ZIP_HIGH(r46, r57);
    return (state_columns){LANE_PAIRS_EVEN(a0, a2), LANE_PAIRS_EVEN(a1, a3), LANE_PAIRS_ODD(a0, a2),
                           LANE_PAIRS_ODD(a1, a3)};
#else
    const lane_state r04 = PAIR(0, 4), r15 = PAIR(1, 5), r26 = PAIR(2, 6), r37 = PAIR(3, 7);
    const lane_state a0 = LANE_ZIP_LOW(r04, r15), a1 = LANE_ZIP_HIGH(r04, r15);
    const lane_state a2 = LANE_ZIP_LOW(r26, r37), a3 = LANE_ZIP_HIGH(r26, r37);
    return (state_columns){LANE_PAIRS_LOW(a0, a2), LANE_PAIRS_LOW(a1, a3), LANE_PAIRS_HIGH(a0, a2),
                           LANE_PAIRS_HIGH(a1, a3)};
#endif
#undef PAIR
}
#endif
#if LANE_SHUFFLES == 8
typedef struct {
    lane c0, c1, c2, c3, c4, c5, c6, c7;
} lane_columns;
LAW lane_columns lane_transpose(lane_columns r)
{
    const lane a0 = LANE_ZIP_LOW(r.c0, r.c1), a1 = LANE_ZIP_HIGH(r.c0, r.c1), a2 = LANE_ZIP_LOW(r.c2, r.c3),
               a3 = LANE_ZIP_HIGH(r.c2, r.c3);
    const lane a4 = LANE_ZIP_LOW(r.c4, r.c5), a5 = LANE_ZIP_HIGH(r.c4, r.c5), a6 = LANE_ZIP_LOW(r.c6, r.c7),
               a7 = LANE_ZIP_HIGH(r.c6, r.c7);
    const lane b0 = LANE_PAIRS_LOW(a0, a2), b1 = LANE_PAIRS_LOW(a1, a3), b2 = LANE_PAIRS_HIGH(a0, a2),
               b3 = LANE_PAIRS_HIGH(a1, a3);
    const lane b4 = LANE_PAIRS_LOW(a4, a6), b5 = LANE_PAIRS_LOW(a5, a7), b6 = LANE_PAIRS_HIGH(a4, a6),
               b7 = LANE_PAIRS_HIGH(a5, a7);
    return (lane_columns){LANE_QUADS_LOW(b0, b4),  LANE_QUADS_LOW(b1, b5),  LANE_QUADS_LOW(b2, b6),
                          LANE_QUADS_LOW(b3, b7),  LANE_QUADS_HIGH(b0, b4), LANE_QUADS_HIGH(b1, b5),
                          LANE_QUADS_HIGH(b2, b6), LANE_QUADS_HIGH(b3, b7)};
}
/* The first eight numbers of each lane's record of n; of a shorter record the next one's too: arrays end with spare
 * room (LANE_SPARE). */
LAW lane_columns lane_gather_columns(GLOBAL const coeff *restrict p, lane_int row, brc_size n)
{
#if BRC_PRECISION == 0
    /* As twice state_gather_columns, in the order that leaves the compiler the most registers. */
#define PAIR(k, l, c) state_load_pair(p, (brc_size)LANE_ITEM(row, k) * n + (c), (brc_size)LANE_ITEM(row, l) * n + (c))
    const lane r02 = PAIR(0, 2, 0), r13 = PAIR(1, 3, 0), r46 = PAIR(4, 6, 0), r57 = PAIR(5, 7, 0);
    const lane t02 = PAIR(0, 2, 4), t13 = PAIR(1, 3, 4), t46 = PAIR(4, 6, 4), t57 = PAIR(5, 7, 4);
#undef PAIR
    const lane a0 = LANE_ZIP_LOW(r02, r13), a1 = LANE_ZIP_HIGH(r02, r13), a2 = LANE_ZIP_LOW(r46, r57),
               a3 = LANE_ZIP_HIGH(r46, r57);
    const lane b0 = LANE_ZIP_LOW(t02, t13), b1 = LANE_ZIP_HIGH(t02, t13), b2 = LANE_ZIP_LOW(t46, t57),
               b3 = LANE_ZIP_HIGH(t46, t57);
    return (lane_columns){LANE_PAIRS_EVEN(a0, a2), LANE_PAIRS_EVEN(a1, a3), LANE_PAIRS_ODD(a0, a2),
                          LANE_PAIRS_ODD(a1, a3),  LANE_PAIRS_EVEN(b0, b2), LANE_PAIRS_EVEN(b1, b3),
                          LANE_PAIRS_ODD(b0, b2),  LANE_PAIRS_ODD(b1, b3)};
#else
#define RECORD(l) lane_load(p, (brc_size)LANE_ITEM(row, l) * n)
    return lane_transpose(
        (lane_columns){RECORD(0), RECORD(1), RECORD(2), RECORD(3), RECORD(4), RECORD(5), RECORD(6), RECORD(7)});
#undef RECORD
#endif
}
#elif LANE_SHUFFLES == 4
/* Two numbers of the records of four lanes: lanes 0 and 2, 1 and 3 in one vector, then zipped. */
typedef coeff coeff_pair __attribute__((vector_size(2 * sizeof(coeff))));
typedef coeff_pair pair_anywhere __attribute__((aligned(4), may_alias));
typedef struct {
    lane c0, c1;
} lane_two;
LAW lane_two lane_gather_two(const coeff *restrict p, lane_int row, brc_size n, brc_size c)
{
#define PAIR(l) (*(const pair_anywhere *)(p + (brc_size)LANE_ITEM(row, l) * n + c))
    const lane r02 = LANE_SHUFFLE(PAIR(0), PAIR(2), 0, 1, 2, 3), r13 = LANE_SHUFFLE(PAIR(1), PAIR(3), 0, 1, 2, 3);
#undef PAIR
    return (lane_two){LANE_SHUFFLE(r02, r13, 0, 4, 2, 6), LANE_SHUFFLE(r02, r13, 1, 5, 3, 7)};
}
LAW void lane_store_two(coeff *restrict q, brc_size n, lane a, lane b)
{
    const lane r02 = LANE_SHUFFLE(a, b, 0, 4, 2, 6), r13 = LANE_SHUFFLE(a, b, 1, 5, 3, 7);
    *(pair_anywhere *)q = LANE_SHUFFLE(r02, r02, 0, 1);
    *(pair_anywhere *)(q + n) = LANE_SHUFFLE(r13, r13, 0, 1);
    *(pair_anywhere *)(q + 2 * n) = LANE_SHUFFLE(r02, r02, 2, 3);
    *(pair_anywhere *)(q + 3 * n) = LANE_SHUFFLE(r13, r13, 2, 3);
}
#endif

/* One lane: a record in loads of 16 bytes, as many as reach it from the 16 bytes in which it begins; a GPU takes as
 * long for a load of each work-item's own, whatever its width. Up to LANE_SPARE numbers behind the last record are
 * read. */
#if defined(__OPENCL_VERSION__) && W == 1
#define WIDE_RECORDS 1
typedef BRC_JOIN(STATE_NAME, 2) state_pair;
typedef BRC_JOIN(STATE_NAME, 4) state_four;
typedef BRC_JOIN(COEFF_NAME, 4) coeff_four;
#if BRC_PRECISION == 2
LAW state_vec3 state_wide3(GLOBAL const state *restrict p, int row)
{
    const brc_size at = (brc_size)row * 3;
    return (state_vec3){p[at], p[at + 1], p[at + 2]};
}
LAW lane_quat state_wide4(GLOBAL const state *restrict p, int row)
{
    const state_four a = ((GLOBAL const state_four *)p)[row];
    return (lane_quat){a.x, a.y, a.z, a.w};
}
#else
LAW state_vec3 state_wide3(GLOBAL const state *restrict p, int row)
{
    GLOBAL const state *const q = p + (brc_size)row * 3;
    const state one = q[row & 1 ? 0 : 2]; /* before or behind a pair */
    const state_pair a = *(GLOBAL const state_pair *)(q + (row & 1));
    return (state_vec3){row & 1 ? one : a.x, row & 1 ? a.x : a.y, row & 1 ? a.y : one};
}
LAW lane_quat state_wide4(GLOBAL const state *restrict p, int row)
{
    GLOBAL const state_pair *const q = (GLOBAL const state_pair *)p + (brc_size)row * 2;
    const state_pair a = q[0], b = q[1];
    return (lane_quat){LANE_FROM_STATE(a.x), LANE_FROM_STATE(a.y), LANE_FROM_STATE(b.x), LANE_FROM_STATE(b.y)};
}
#endif
#if BRC_PRECISION == 0
LAW lane_mat3 lane_wide9_of(state_pair a, state_pair b, state_pair c, state_pair d, state_pair e, int odd)
{
    return (lane_mat3){odd ? a.y : a.x, odd ? b.x : a.y, odd ? b.y : b.x, odd ? c.x : b.y, odd ? c.y : c.x,
                       odd ? d.x : c.y, odd ? d.y : d.x, odd ? e.x : d.y, odd ? e.y : e.x};
}
#define LANE_WIDE9(kind, p, row)                                                                                       \
    kind *const q = (kind *)((p) + ((brc_size)(row)*9 - (brc_size)((row)&1)));                                         \
    return lane_wide9_of(q[0], q[1], q[2], q[3], q[4], (row)&1)
LAW lane_mat3 lane_wide9(GLOBAL const coeff *restrict p, int row) { LANE_WIDE9(GLOBAL const state_pair, p, row); }
LAW lane_mat3 lane_wide9_again(GLOBAL const coeff *restrict p, int row)
{
    LANE_WIDE9(GLOBAL const volatile state_pair, p, row);
}
LAW lane_sym3 lane_wide6(GLOBAL const coeff *restrict p, int row)
{
    GLOBAL const state_pair *const q = (GLOBAL const state_pair *)p + (brc_size)row * 3;
    const state_pair a = q[0], b = q[1], c = q[2];
    return (lane_sym3){a.x, a.y, b.x, b.y, c.x, c.y};
}
#else
LAW lane_mat3 lane_wide9_of(coeff_four a, coeff_four b, coeff_four c, int row)
{
    const int one = row & 1, two = row & 2; /* 9 row = row modulo 4 */
    const coeff t0 = one ? a.y : a.x, t1 = one ? a.z : a.y, t2 = one ? a.w : a.z, t3 = one ? b.x : a.w,
                t4 = one ? b.y : b.x, t5 = one ? b.z : b.y, t6 = one ? b.w : b.z, t7 = one ? c.x : b.w,
                t8 = one ? c.y : c.x, t9 = one ? c.z : c.y, t10 = one ? c.w : c.z;
    return (lane_mat3){two ? t2 : t0, two ? t3 : t1, two ? t4 : t2, two ? t5 : t3, two ? t6 : t4,
                       two ? t7 : t5, two ? t8 : t6, two ? t9 : t7, two ? t10 : t8};
}
#define LANE_WIDE9(kind, p, row)                                                                                       \
    kind *const q = (kind *)((p) + ((brc_size)(row)*9 - (brc_size)((row)&3)));                                         \
    return lane_wide9_of(q[0], q[1], q[2], row)
LAW lane_mat3 lane_wide9(GLOBAL const coeff *restrict p, int row) { LANE_WIDE9(GLOBAL const coeff_four, p, row); }
LAW lane_mat3 lane_wide9_again(GLOBAL const coeff *restrict p, int row)
{
    LANE_WIDE9(GLOBAL const volatile coeff_four, p, row);
}
LAW lane_sym3 lane_wide6(GLOBAL const coeff *restrict p, int row)
{
    const int odd = row & 1;
    GLOBAL const coeff_four *const q = (GLOBAL const coeff_four *)(p + ((brc_size)row * 6 - (brc_size)(2 * odd)));
    const coeff_four a = q[0], b = q[1];
    return (lane_sym3){odd ? a.z : a.x, odd ? a.w : a.y, odd ? b.x : a.z,
                       odd ? b.y : a.w, odd ? b.z : b.x, odd ? b.w : b.y};
}
#endif
#else
#define WIDE_RECORDS 0
#endif

LAW state_vec3 state_gather3(GLOBAL const state *restrict p, lane_int row)
{
#if WIDE_RECORDS
    return state_wide3(p, row);
#elif STATE_SHUFFLES == 8
    const state_columns c = state_gather_columns(p, row, 3);
    return (state_vec3){c.c0, c.c1, c.c2};
#elif STATE_SHUFFLES == 4
    const lane_two xy = lane_gather_two(p, row, 3, 0);
    return (state_vec3){xy.c0, xy.c1, gather_state_number(p, row, 3, 2)};
#else
    return (state_vec3){gather_state_number(p, row, 3, 0), gather_state_number(p, row, 3, 1),
                        gather_state_number(p, row, 3, 2)};
#endif
}
LAW lane_mat3 lane_gather9(GLOBAL const coeff *restrict p, lane_int row)
{
#if WIDE_RECORDS
    return lane_wide9(p, row);
#else
    const lane last = gather_number(p, row, 9, 8);
#if LANE_SHUFFLES == 8
    const lane_columns c = lane_gather_columns(p, row, 9);
    return (lane_mat3){c.c0, c.c1, c.c2, c.c3, c.c4, c.c5, c.c6, c.c7, last};
#elif LANE_SHUFFLES == 4
    const lane_two a = lane_gather_two(p, row, 9, 0), b = lane_gather_two(p, row, 9, 2),
                   c = lane_gather_two(p, row, 9, 4), d = lane_gather_two(p, row, 9, 6);
    return (lane_mat3){a.c0, a.c1, b.c0, b.c1, c.c0, c.c1, d.c0, d.c1, last};
#else
    return (lane_mat3){gather_number(p, row, 9, 0), gather_number(p, row, 9, 1), gather_number(p, row, 9, 2),
                       gather_number(p, row, 9, 3), gather_number(p, row, 9, 4), gather_number(p, row, 9, 5),
                       gather_number(p, row, 9, 6), gather_number(p, row, 9, 7), last};
#endif
#endif
}
/* The same of records that other work-items change meanwhile: no number beside one's own is read. */
LAW lane_mat3 lane_gather9_alone(GLOBAL const coeff *restrict p, lane_int row)
{
#if WIDE_RECORDS
    GLOBAL const coeff *const r = p + (brc_size)row * 9;
    return (lane_mat3){r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]};
#else
    return lane_gather9(p, row);
#endif
}
LAW lane_sym3 lane_gather6(GLOBAL const coeff *restrict p, lane_int row)
{
#if WIDE_RECORDS
    return lane_wide6(p, row);
#elif LANE_SHUFFLES == 8
    const lane_columns c = lane_gather_columns(p, row, 6);
    return (lane_sym3){c.c0, c.c1, c.c2, c.c3, c.c4, c.c5};
#elif LANE_SHUFFLES == 4
    const lane_two a = lane_gather_two(p, row, 6, 0), b = lane_gather_two(p, row, 6, 2),
                   c = lane_gather_two(p, row, 6, 4);
    return (lane_sym3){a.c0, a.c1, b.c0, b.c1, c.c0, c.c1};
#else
    return (lane_sym3){gather_number(p, row, 6, 0), gather_number(p, row, 6, 1), gather_number(p, row, 6, 2),
                       gather_number(p, row, 6, 3), gather_number(p, row, 6, 4), gather_number(p, row, 6, 5)};
#endif
}
LAW lane_quat lane_gather4(GLOBAL const state *restrict p, lane_int row)
{
#if WIDE_RECORDS
    return state_wide4(p, row);
#elif STATE_SHUFFLES == 8
    const state_columns c = state_gather_columns(p, row, 4);
    return (lane_quat){LANE_FROM_STATE(c.c0), LANE_FROM_STATE(c.c1), LANE_FROM_STATE(c.c2), LANE_FROM_STATE(c.c3)};
#elif STATE_SHUFFLES == 4
    const lane_two a = lane_gather_two(p, row, 4, 0), b = lane_gather_two(p, row, 4, 2);
    return (lane_quat){a.c0, a.c1, b.c0, b.c1};
#else
    return (lane_quat){
        LANE_FROM_STATE(gather_state_number(p, row, 4, 0)), LANE_FROM_STATE(gather_state_number(p, row, 4, 1)),
        LANE_FROM_STATE(gather_state_number(p, row, 4, 2)), LANE_FROM_STATE(gather_state_number(p, row, 4, 3))};
#endif
}
/* A record that was read before, not kept from then: the compiler may not know that it is the same. */
#if SPLIT_LOOPS
#define lane_gather9_again(p, row) lane_wide9_again(p, row)
LAW lane_sym3 lane_gather6_again(GLOBAL const coeff *restrict p, lane_int row)
{
    GLOBAL const volatile coeff *const r = (GLOBAL const volatile coeff *)(p + (brc_size)row * 6);
    return (lane_sym3){r[0], r[1], r[2], r[3], r[4], r[5]};
}
#else
#define lane_gather9_again(p, row) lane_gather9(p, row)
#endif

/* A matrix put aside (portable.h) as the numbers `at` and following, and taken back; where nothing is put aside the one
 * that was kept. */
LAW void aside_put9(aside room, int at, lane_mat3 a)
{
#if SPLIT_LOOPS
    const aside r = room + at * BRC_GROUP;
    r[0] = a.xx, r[BRC_GROUP] = a.xy, r[2 * BRC_GROUP] = a.xz;
    r[3 * BRC_GROUP] = a.yx, r[4 * BRC_GROUP] = a.yy, r[5 * BRC_GROUP] = a.yz;
    r[6 * BRC_GROUP] = a.zx, r[7 * BRC_GROUP] = a.zy, r[8 * BRC_GROUP] = a.zz;
#else
    (void)room, (void)at, (void)a;
#endif
}
LAW lane_mat3 aside_get9(aside room, int at, lane_mat3 kept)
{
#if SPLIT_LOOPS
    const aside r = room + at * BRC_GROUP;
    (void)kept;
    return (lane_mat3){r[0],
                       r[BRC_GROUP],
                       r[2 * BRC_GROUP],
                       r[3 * BRC_GROUP],
                       r[4 * BRC_GROUP],
                       r[5 * BRC_GROUP],
                       r[6 * BRC_GROUP],
                       r[7 * BRC_GROUP],
                       r[8 * BRC_GROUP]};
#else
    (void)room, (void)at;
    return kept;
#endif
}

/* Stores of the W own elements from first. */
LAW void lane_store9(GLOBAL coeff *restrict p, int first, lane_mat3 a)
{
    GLOBAL coeff *q = p + (brc_size)first * 9;
#if LANE_SHUFFLES == 8
    const lane_columns r = lane_transpose((lane_columns){a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy});
    lane_store(q, 0, r.c0), lane_store(q, 9, r.c1), lane_store(q, 18, r.c2), lane_store(q, 27, r.c3);
    lane_store(q, 36, r.c4), lane_store(q, 45, r.c5), lane_store(q, 54, r.c6), lane_store(q, 63, r.c7);
#define PUT_LANE(l) q[0x##l * 9 + 8] = LANE_ITEM(a.zz, l);
#elif LANE_SHUFFLES == 4
    lane_store_two(q, 9, a.xx, a.xy), lane_store_two(q + 2, 9, a.xz, a.yx);
    lane_store_two(q + 4, 9, a.yy, a.yz), lane_store_two(q + 6, 9, a.zx, a.zy);
#define PUT_LANE(l) q[0x##l * 9 + 8] = LANE_ITEM(a.zz, l);
#else
#define PUT_LANE(l)                                                                                                    \
    q[0x##l * 9] = LANE_ITEM(a.xx, l), q[0x##l * 9 + 1] = LANE_ITEM(a.xy, l), q[0x##l * 9 + 2] = LANE_ITEM(a.xz, l),   \
              q[0x##l * 9 + 3] = LANE_ITEM(a.yx, l), q[0x##l * 9 + 4] = LANE_ITEM(a.yy, l),                            \
              q[0x##l * 9 + 5] = LANE_ITEM(a.yz, l), q[0x##l * 9 + 6] = LANE_ITEM(a.zx, l),                            \
              q[0x##l * 9 + 7] = LANE_ITEM(a.zy, l), q[0x##l * 9 + 8] = LANE_ITEM(a.zz, l);
#endif
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
LAW void lane_store6(GLOBAL coeff *restrict p, int first, lane_sym3 a)
{
    GLOBAL coeff *q = p + (brc_size)first * 6;
#define PUT_LANE(l)                                                                                                    \
    q[0x##l * 6] = LANE_ITEM(a.xx, l), q[0x##l * 6 + 1] = LANE_ITEM(a.yy, l), q[0x##l * 6 + 2] = LANE_ITEM(a.zz, l),   \
              q[0x##l * 6 + 3] = LANE_ITEM(a.yz, l), q[0x##l * 6 + 4] = LANE_ITEM(a.xz, l),                            \
              q[0x##l * 6 + 5] = LANE_ITEM(a.xy, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
#if STORE_SHUFFLES
/* x y z of four rows, side by side. */
LAW void state_store_rows(state *restrict q, state_quad x, state_quad y, state_quad z)
{
    const state_quad xy = LANE_SHUFFLE(x, y, 0, 4, 2, 6), yz = LANE_SHUFFLE(y, z, 1, 5, 3, 7),
                     zx = LANE_SHUFFLE(z, x, 0, 5, 2, 7);
    *(quad_anywhere *)q = LANE_SHUFFLE(xy, zx, 0, 1, 4, 5);
    *(quad_anywhere *)(q + 4) = LANE_SHUFFLE(yz, xy, 0, 1, 6, 7);
    *(quad_anywhere *)(q + 8) = LANE_SHUFFLE(zx, yz, 2, 3, 6, 7);
}
#endif
LAW void state_store3(GLOBAL state *restrict p, int first, lane_vec3 a)
{
    GLOBAL state *q = p + (brc_size)first * 3;
#if STORE_SHUFFLES
#define QUAD(x, ...) __builtin_convertvector(LANE_SHUFFLE(x, x, __VA_ARGS__), state_quad)
#define ROWS(at, ...)                                                                                                  \
    state_store_rows(q + 3 * (at), QUAD(a.x, __VA_ARGS__), QUAD(a.y, __VA_ARGS__), QUAD(a.z, __VA_ARGS__))
    ROWS(0, 0, 1, 2, 3);
    if (W > 4) ROWS(W - 4, W - 4, W - 3, W - 2, W - 1);
#undef ROWS
#undef QUAD
#else
#define PUT_LANE(l)                                                                                                    \
    q[0x##l * 3] = (state)LANE_ITEM(a.x, l), q[0x##l * 3 + 1] = (state)LANE_ITEM(a.y, l),                              \
              q[0x##l * 3 + 2] = (state)LANE_ITEM(a.z, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
#endif
}
LAW void state_store1(GLOBAL state *restrict p, int first, lane a)
{
#define PUT_LANE(l) p[(brc_size)first + 0x##l] = (state)LANE_ITEM(a, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}

#endif
