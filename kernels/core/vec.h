/* Vectors and 3 x 3 matrices of lanes: values in, values out. lane_mat3 is row major: xy is row x, column y.
 * Loads, gathers and stores know the two storages of portable.h and nothing else. */
#ifndef BRC_KERNELS_VEC_H
#define BRC_KERNELS_VEC_H

#include "portable.h"

typedef struct {
    lane x, y, z;
} lane_vec3;
typedef struct {
    lane xx, xy, xz, yx, yy, yz, zx, zy, zz;
} lane_mat3;
typedef struct {
    lane xx, yy, zz, yz, xz, xy;
} lane_sym3;
typedef struct {
    lane w, x, y, z;
} lane_quat;

/* ---- vectors ---- */
LAW lane_vec3 lane_vec3_add(lane_vec3 a, lane_vec3 b) { return (lane_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
LAW lane_vec3 lane_vec3_sub(lane_vec3 a, lane_vec3 b) { return (lane_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
LAW lane_vec3 lane_vec3_scale(lane k, lane_vec3 a) { return (lane_vec3){k * a.x, k * a.y, k * a.z}; }
/* a + k b */
LAW lane_vec3 lane_vec3_more(lane_vec3 a, lane k, lane_vec3 b)
{
    return (lane_vec3){a.x + k * b.x, a.y + k * b.y, a.z + k * b.z};
}
/* a - k b */
LAW lane_vec3 lane_vec3_less(lane_vec3 a, lane k, lane_vec3 b)
{
    return (lane_vec3){a.x - k * b.x, a.y - k * b.y, a.z - k * b.z};
}
LAW lane lane_vec3_dot(lane_vec3 a, lane_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW lane_vec3 lane_vec3_cross(lane_vec3 a, lane_vec3 b)
{
    return (lane_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* a - b x c */
LAW lane_vec3 lane_vec3_less_cross(lane_vec3 a, lane_vec3 b, lane_vec3 c)
{
    return (lane_vec3){a.x - b.y * c.z + b.z * c.y, a.y - b.z * c.x + b.x * c.z, a.z - b.x * c.y + b.y * c.x};
}

LAW lane_vec3 lane_vec3_zero(void) { return (lane_vec3){LANE_ZERO, LANE_ZERO, LANE_ZERO}; }
LAW lane lane_number(coeff x) { return LANE_ZERO + x; }
LAW lane_vec3 lane_vec3_where(lane_mask which, lane_vec3 a, lane_vec3 b)
{
    return (lane_vec3){LANE_WHERE(which, a.x, b.x), LANE_WHERE(which, a.y, b.y), LANE_WHERE(which, a.z, b.z)};
}

/* ---- matrices ---- */
LAW lane_mat3 lane_mat3_zero(void)
{
    const lane o = LANE_ZERO;
    return (lane_mat3){o, o, o, o, o, o, o, o, o};
}
LAW lane_mat3 lane_mat3_add(lane_mat3 a, lane_mat3 b)
{
    return (lane_mat3){a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
                       a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
LAW lane_mat3 lane_mat3_sub(lane_mat3 a, lane_mat3 b)
{
    return (lane_mat3){a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yx - b.yx, a.yy - b.yy,
                       a.yz - b.yz, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}
LAW lane_mat3 lane_mat3_scale(lane k, lane_mat3 a)
{
    return (lane_mat3){k * a.xx, k * a.xy, k * a.xz, k * a.yx, k * a.yy, k * a.yz, k * a.zx, k * a.zy, k * a.zz};
}
LAW lane_mat3 lane_mat3_transpose(lane_mat3 a)
{
    return (lane_mat3){a.xx, a.yx, a.zx, a.xy, a.yy, a.zy, a.xz, a.yz, a.zz};
}
/* a b */
LAW lane_mat3 lane_mat3_mul(lane_mat3 a, lane_mat3 b)
{
    return (lane_mat3){a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
                       a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
                       a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
                       a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
                       a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
/* a b with b symmetric */
LAW lane_mat3 lane_mat3_mul_sym(lane_mat3 a, lane_sym3 b)
{
    return lane_mat3_mul(a, (lane_mat3){b.xx, b.xy, b.xz, b.xy, b.yy, b.yz, b.xz, b.yz, b.zz});
}
/* a transposed times b */
LAW lane_mat3 lane_mat3_tmul(lane_mat3 a, lane_mat3 b) { return lane_mat3_mul(lane_mat3_transpose(a), b); }
LAW lane_vec3 lane_mat3_mul_vec(lane_mat3 a, lane_vec3 b)
{
    return (lane_vec3){a.xx * b.x + a.xy * b.y + a.xz * b.z, a.yx * b.x + a.yy * b.y + a.yz * b.z,
                       a.zx * b.x + a.zy * b.y + a.zz * b.z};
}
/* sum + a (x) b */
LAW lane_mat3 lane_add_outer(lane_mat3 sum, lane_vec3 a, lane_vec3 b)
{
    return (lane_mat3){sum.xx + a.x * b.x, sum.xy + a.x * b.y, sum.xz + a.x * b.z,
                       sum.yx + a.y * b.x, sum.yy + a.y * b.y, sum.yz + a.y * b.z,
                       sum.zx + a.z * b.x, sum.zy + a.z * b.y, sum.zz + a.z * b.z};
}
LAW lane_sym3 lane_mat3_sym(lane_mat3 a)
{
    return (lane_sym3){
        a.xx, a.yy, a.zz, REAL(0.5) * (a.yz + a.zy), REAL(0.5) * (a.xz + a.zx), REAL(0.5) * (a.xy + a.yx)};
}
LAW lane lane_sym3_trace(lane_sym3 a) { return a.xx + a.yy + a.zz; }
/* a : b */
LAW lane lane_sym3_dot(lane_sym3 a, lane_sym3 b)
{
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + REAL(2) * (a.yz * b.yz + a.xz * b.xz + a.xy * b.xy);
}
LAW lane_vec3 lane_sym3_mul_vec(lane_sym3 a, lane_vec3 b)
{
    return (lane_vec3){a.xx * b.x + a.xy * b.y + a.xz * b.z, a.xy * b.x + a.yy * b.y + a.yz * b.z,
                       a.xz * b.x + a.yz * b.y + a.zz * b.z};
}
LAW lane_sym3 lane_sym3_add(lane_sym3 a, lane_sym3 b)
{
    return (lane_sym3){a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
}
LAW lane_sym3 lane_sym3_sub(lane_sym3 a, lane_sym3 b)
{
    return (lane_sym3){a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.yz - b.yz, a.xz - b.xz, a.xy - b.xy};
}
/* k a + m I */
LAW lane_sym3 lane_sym3_scale_shift(lane k, lane_sym3 a, lane m)
{
    return (lane_sym3){k * a.xx + m, k * a.yy + m, k * a.zz + m, k * a.yz, k * a.xz, k * a.xy};
}

/* ---- loads and stores ---- */
#if W == 1
LAW lane lane_load(GLOBAL const coeff *restrict p, brc_size at) { return p[at]; }
LAW void lane_store(GLOBAL coeff *restrict p, brc_size at, lane a) { p[at] = a; }
LAW lane_state state_load(GLOBAL const state *restrict p, brc_size at) { return p[at]; }
LAW lane_int int_load(GLOBAL const int *restrict p, brc_size at) { return p[at]; }
LAW void int_store(GLOBAL int *restrict p, brc_size at, lane_int a) { p[at] = a; }
#elif defined(__OPENCL_VERSION__)
LAW lane lane_load(GLOBAL const coeff *restrict p, brc_size at) { return BRC_VLOAD(0, p + at); }
LAW void lane_store(GLOBAL coeff *restrict p, brc_size at, lane a) { BRC_VSTORE(a, 0, p + at); }
LAW lane_state state_load(GLOBAL const state *restrict p, brc_size at) { return BRC_VLOAD(0, p + at); }
LAW lane_int int_load(GLOBAL const int *restrict p, brc_size at) { return BRC_VLOAD(0, p + at); }
LAW void int_store(GLOBAL int *restrict p, brc_size at, lane_int a) { BRC_VSTORE(a, 0, p + at); }
#else
typedef lane lane_anywhere __attribute__((aligned(4), may_alias));
typedef lane_state state_anywhere __attribute__((aligned(4), may_alias));
typedef lane_int int_anywhere __attribute__((aligned(4), may_alias));
LAW lane lane_load(const coeff *restrict p, brc_size at) { return *(const lane_anywhere *)(p + at); }
LAW void lane_store(coeff *restrict p, brc_size at, lane a) { *(lane_anywhere *)(p + at) = a; }
LAW lane_state state_load(const state *restrict p, brc_size at) { return *(const state_anywhere *)(p + at); }
LAW lane_int int_load(const int *restrict p, brc_size at) { return *(const int_anywhere *)(p + at); }
LAW void int_store(int *restrict p, brc_size at, lane_int a) { *(int_anywhere *)(p + at) = a; }
#endif
/* W consecutive element numbers from first. */
LAW lane_int lane_own(int first)
{
#define OWN_ITEM(l) (first + 0x##l)
    return LANE_MAKE(lane_int, OWN_ITEM);
#undef OWN_ITEM
}

/* Of the lanes whose bits `keep` are all set (0 in the others): x side by side from `to` on, and nothing behind; how
 * many; how many before each of them, 0 or whatever in the others. */
LAW void lane_pack(GLOBAL int *restrict to, lane_int keep, lane_int x)
{
#ifdef LANE_PACK
    LANE_PACK(to, keep, x);
#else
    int n = 0;
    if (!LANE_ANY(keep)) return;
#define PUT_LANE(l)                                                                                                    \
    if (LANE_ITEM(keep, l)) to[n++] = LANE_ITEM(x, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
#endif
}
LAW int lane_count(lane_int keep)
{
#ifdef LANE_COUNT
    return LANE_COUNT(keep);
#else
    int n = 0;
#define ADD(l) n -= LANE_ITEM(keep, l);
    LANE_EACH(ADD)
#undef ADD
    return n;
#endif
}
LAW lane_int lane_rank(lane_int keep)
{
#ifdef LANE_RANK
    return LANE_RANK(keep);
#else
    int before = 0;
    lane_int rank = keep;
#define PUT_LANE(l) LANE_ITEM(rank, l) = before, before -= LANE_ITEM(keep, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
    return rank;
#endif
}

typedef struct {
    lane_state x, y, z;
} state_vec3;
/* b - a, taken in state and handed on as coeff. */
LAW lane_vec3 state_vec3_difference(state_vec3 b, state_vec3 a)
{
    return (lane_vec3){LANE_FROM_STATE(b.x - a.x), LANE_FROM_STATE(b.y - a.y), LANE_FROM_STATE(b.z - a.z)};
}
/* Blocked storage [block][n][C] and rows [slot][n][C]: lane is the first lane within the slice. */
LAW lane lane_block(GLOBAL const coeff *restrict p, int block, int n, int component, int first_lane)
{
    return lane_load(p, ((brc_size)block * (brc_size)n + (brc_size)component) * C + (brc_size)first_lane);
}
LAW lane_vec3 lane_block3(GLOBAL const coeff *restrict p, int block, int first_lane)
{
    return (lane_vec3){lane_block(p, block, 3, 0, first_lane), lane_block(p, block, 3, 1, first_lane),
                       lane_block(p, block, 3, 2, first_lane)};
}
LAW lane_sym3 lane_block6(GLOBAL const coeff *restrict p, int block, int first_lane)
{
    return (lane_sym3){lane_block(p, block, 6, 0, first_lane), lane_block(p, block, 6, 1, first_lane),
                       lane_block(p, block, 6, 2, first_lane), lane_block(p, block, 6, 3, first_lane),
                       lane_block(p, block, 6, 4, first_lane), lane_block(p, block, 6, 5, first_lane)};
}
LAW lane_mat3 lane_block9(GLOBAL const coeff *restrict p, int block, int first_lane)
{
    return (lane_mat3){lane_block(p, block, 9, 0, first_lane), lane_block(p, block, 9, 1, first_lane),
                       lane_block(p, block, 9, 2, first_lane), lane_block(p, block, 9, 3, first_lane),
                       lane_block(p, block, 9, 4, first_lane), lane_block(p, block, 9, 5, first_lane),
                       lane_block(p, block, 9, 6, first_lane), lane_block(p, block, 9, 7, first_lane),
                       lane_block(p, block, 9, 8, first_lane)};
}
LAW lane_int int_block(GLOBAL const int *restrict p, int block, int first_lane)
{
    return int_load(p, (brc_size)block * C + (brc_size)first_lane);
}

/* Smaller of two, component by component. */
LAW lane lane_min(lane a, lane b) { return LANE_LESSER(a, b); }

LAW lane lane_max(lane a, lane b) { return -lane_min(-a, -b); }

/* Prefetch of the rows that a loop reads: three-component and one-component. */
LAW void rows_ahead3(GLOBAL const coeff *restrict p, int slot)
{
#ifdef ROWS_AHEAD
    const brc_size at = (brc_size)(slot + ROWS_AHEAD) * 3 * C;
    PREFETCH_LATER(p, at);
    PREFETCH_LATER(p, at + C);
    PREFETCH_LATER(p, at + 2 * C);
#else
    (void)p, (void)slot;
#endif
}
LAW void rows_ahead1(GLOBAL const coeff *restrict p, int slot)
{
#ifdef ROWS_AHEAD
    PREFETCH_LATER(p, (brc_size)(slot + ROWS_AHEAD) * C);
#else
    (void)p, (void)slot;
#endif
}

/* Prefetch of the [element][9] records of the W elements after those from first on. */
LAW void records_ahead9(GLOBAL const coeff *restrict p, int first)
{
#ifdef ROWS_AHEAD
    for (int k = 0; k < 9; ++k) PREFETCH(p, ((brc_size)(first + W) * 9 + (brc_size)(k * W)));
#else
    (void)p, (void)first;
#endif
}

/* Prefetch of [element][width] records that a group of rows will gather: those RECORDS_AHEAD rows further on, which
 * most of the next groups gather from, and those that lie elsewhere and that no group has gathered lately: one for each
 * of the W rows from first on, chosen by the host (ahead [n], host/solver/core/layout.h). */
#ifdef ROWS_AHEAD
#define RECORDS_LATER(p, width, ahead, first)                                                                          \
    do {                                                                                                               \
        for (int k = 0; k < (width); ++k)                                                                              \
            PREFETCH_LATER(p, (brc_size)((first) + RECORDS_AHEAD) * (brc_size)(width) + (brc_size)(k * W));            \
        for (int l = 0; l < W; ++l) {                                                                                  \
            const brc_size at = (brc_size)(ahead)[(first) + l] * (brc_size)(width);                                    \
            PREFETCH_LATER(p, at);                                                                                     \
            PREFETCH_LATER(p, at + (brc_size)((width)-1));                                                             \
        }                                                                                                              \
    } while (0)
#else
#define RECORDS_LATER(p, width, ahead, first) ((void)(p), (void)(width), (void)(ahead), (void)(first))
#endif
LAW void records_later(GLOBAL const coeff *restrict p, int width, GLOBAL const int *restrict ahead, int first)
{
    RECORDS_LATER(p, width, ahead, first);
}
LAW void states_later(GLOBAL const state *restrict p, int width, GLOBAL const int *restrict ahead, int first)
{
    RECORDS_LATER(p, width, ahead, first);
}

/* ---- scalars, for kernels over short lists of faces or special elements ---- */
typedef struct {
    coeff x, y, z;
} vec3;
typedef struct {
    coeff xx, xy, xz, yx, yy, yz, zx, zy, zz;
} mat3;

LAW vec3 vec3_load(GLOBAL const coeff *restrict p, int i)
{
    return (vec3){p[(brc_size)i * 3], p[(brc_size)i * 3 + 1], p[(brc_size)i * 3 + 2]};
}
LAW mat3 mat3_load(GLOBAL const coeff *restrict p, int i)
{
    GLOBAL const coeff *q = p + (brc_size)i * 9;
    return (mat3){q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[8]};
}
LAW vec3 vec3_add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
LAW vec3 vec3_sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
LAW vec3 vec3_scale(coeff k, vec3 a) { return (vec3){k * a.x, k * a.y, k * a.z}; }
LAW coeff vec3_dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW vec3 mat3_mul_vec(mat3 a, vec3 b)
{
    return (vec3){a.xx * b.x + a.xy * b.y + a.xz * b.z, a.yx * b.x + a.yy * b.y + a.yz * b.z,
                  a.zx * b.x + a.zy * b.y + a.zz * b.z};
}
LAW mat3 mat3_add_outer(mat3 m, vec3 a, vec3 b)
{
    return (mat3){m.xx + a.x * b.x, m.xy + a.x * b.y, m.xz + a.x * b.z, m.yx + a.y * b.x, m.yy + a.y * b.y,
                  m.yz + a.y * b.z, m.zx + a.z * b.x, m.zy + a.z * b.y, m.zz + a.z * b.z};
}
/* Write m to one lane of a blocked [block][9][C] array. */
LAW void mat3_put_in_block(GLOBAL coeff *restrict p, int block, int lane_index, mat3 m)
{
    GLOBAL coeff *q = p + (brc_size)block * 9 * C + (brc_size)lane_index;
    q[0] = m.xx, q[C] = m.xy, q[2 * C] = m.xz, q[3 * C] = m.yx, q[4 * C] = m.yy, q[5 * C] = m.yz;
    q[6 * C] = m.zx, q[7 * C] = m.zy, q[8 * C] = m.zz;
}
/* The same, added. */
LAW void mat3_add_to_block(GLOBAL coeff *restrict p, int block, int lane_index, mat3 m)
{
    GLOBAL coeff *q = p + (brc_size)block * 9 * C + (brc_size)lane_index;
    q[0] += m.xx, q[C] += m.xy, q[2 * C] += m.xz, q[3 * C] += m.yx, q[4 * C] += m.yy, q[5 * C] += m.yz;
    q[6 * C] += m.zx, q[7 * C] += m.zy, q[8 * C] += m.zz;
}

#endif
