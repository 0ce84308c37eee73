/* The only file that asks which compiler reads it: OpenCL C 1.2, C with OpenMP, or C with OpenMP target.
 *
 * The reader defines, equally named everywhere:
 *   BRC_PRECISION       0 double, 1 mixed, 2 single
 *   BRC_LANES           W: elements one work-item handles (1 on a GPU; 8 or 16 on a CPU)
 *   BRC_SLICE           C: elements a slice of the storage holds, a multiple of W (32 on a GPU; W on a CPU)
 *   BRC_MANY_MATERIALS  0: material constants are scalars; 1: they are gathered per element
 *   BRC_TARGET          defined for the OpenMP target reading of the C build
 *   BRC_EXACT           defined where a product and a sum must not be contracted into one rounding (OpenCL; C by flag)
 *
 * Vocabulary (docs/reference/portable.md): KERNEL, GLOBAL, OWN, GATHER, PUT, UPDATE, FLAG, SPREAD, SCATTER, LAW,
 * ROUTINE, FOR_EACH_ITEM, FOR_EACH_GROUP, FOR_LANES, coeff, state, lane, lane_state, lane_int, REAL. */
#ifndef BRC_KERNELS_PORTABLE_H
#define BRC_KERNELS_PORTABLE_H

#define W BRC_LANES
#define C BRC_SLICE
#define BRC_JOIN_(a, b) a##b
#define BRC_JOIN(a, b) BRC_JOIN_(a, b)

/* state: u, v, f, time and ledger; coeff: everything else (docs/reference/portable.md). */
#if BRC_PRECISION == 0
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
typedef double state;
typedef double coeff;
#define STATE_NAME double
#define COEFF_NAME double
#elif BRC_PRECISION == 1
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
typedef double state;
typedef float coeff;
#define STATE_NAME double
#define COEFF_NAME float
#else
typedef float state;
typedef float coeff;
#define STATE_NAME float
#define COEFF_NAME float
#endif
/* A literal: REAL(0.5) in coeff, STATE(0.5) in state. */
#define REAL(x) ((coeff)(x))
#define STATE(x) ((state)(x))
/* Rounding of a state [-]. */
#if BRC_PRECISION == 2
#define STATE_ROUNDING STATE(1.2e-7)
#else
#define STATE_ROUNDING STATE(2.3e-16)
#endif

#ifdef __OPENCL_VERSION__

#ifdef BRC_EXACT
#pragma OPENCL FP_CONTRACT OFF
#else
#pragma OPENCL FP_CONTRACT ON
#endif
#define KERNEL __kernel
#define GLOBAL __global
#define LAW static inline __attribute__((always_inline))
#define ROUTINE static inline
typedef ulong brc_size;
#define FOR_EACH_ITEM(i, n)                                                                                            \
    const int i = (int)get_global_id(0);                                                                               \
    if (i < (n))
#define FOR_EACH_ROW FOR_EACH_ITEM
#define FOR_EACH_GROUP FOR_EACH_ITEM
#define FOR_LANES(l) for (int l = 0; l < W; ++l)
#define FOR_LANES_ANY(l, any) FOR_LANES(l)
#if W == 1
typedef coeff lane;
typedef state lane_state;
typedef int lane_int;
#define LANE_FROM_STATE(x) ((coeff)(x))
#define STATE_FROM_LANE(x) ((state)(x))
#define LANE_DIFFERENT(a, b) ((coeff)((a) != (b)))
#define LANE_ABOVE(a, b) (-((a) > (b)))
#define LANE_ANY(x) ((x) != 0)
#define LANE_ANY_SHORT(a, b) (!((a) >= (b)))
#else
typedef BRC_JOIN(COEFF_NAME, BRC_LANES) lane;
typedef BRC_JOIN(STATE_NAME, BRC_LANES) lane_state;
typedef BRC_JOIN(int, BRC_LANES) lane_int;
#define LANE_FROM_STATE(x) BRC_JOIN(BRC_JOIN(convert_, COEFF_NAME), BRC_LANES)(x)
#define STATE_FROM_LANE(x) BRC_JOIN(BRC_JOIN(convert_, STATE_NAME), BRC_LANES)(x)
#define LANE_DIFFERENT(a, b) (-BRC_JOIN(BRC_JOIN(convert_, COEFF_NAME), BRC_LANES)((a) != (b)))
#define LANE_ABOVE(a, b) ((a) > (b))
#define LANE_ANY(x) any((x) != 0)
#define LANE_ANY_SHORT(a, b) any(!((a) >= (b)))
#define BRC_VLOAD BRC_JOIN(vload, BRC_LANES)
#define BRC_VSTORE BRC_JOIN(vstore, BRC_LANES)
#endif
#define STORE_SAME(place, value) (*(place) = (value))
#define LANE_LESSER(a, b) ((a) < (b) ? (a) : (b))
#define LANE_SQRT(x) sqrt(x)
#define SQRT(x) sqrt(x)
#define SQRT_STATE(x) sqrt(x)
#define LANE_MAKE_(type, items) ((type)items)
#define LANE_ZERO ((lane)(0))
#define LANE_ITEM_(x, hex) x.s##hex

#else /* C */

#include <stddef.h>
#define KERNEL static
#define GLOBAL
#define LAW static inline __attribute__((always_inline))
#define ROUTINE static inline
typedef size_t brc_size;
#define STORE_SAME(place, value) __atomic_store_n((place), (value), __ATOMIC_RELAXED)
#define BRC_PRAGMA(x) _Pragma(#x)
/* Single numbers of W things in arrays, where laws of single numbers (svec.h) are worth more than lanes of theirs. */
#define FOR_LANES(l) BRC_PRAGMA(omp simd) for (int l = 0; l < W; ++l)
#define FOR_LANES_ANY(l, any) BRC_PRAGMA(omp simd reduction(| : any)) for (int l = 0; l < W; ++l)
__attribute__((unused)) static int brc_first_item, brc_n_chosen, *brc_chosen; /* kernel_instance.h; NULL: all */
#ifdef BRC_TARGET
#define FOR_EACH_ITEM(i, n)                                                                                            \
    BRC_PRAGMA(omp target teams distribute parallel for defaultmap(firstprivate : pointer))                            \
    for (int i = 0; i < (n); ++i)
#define FOR_EACH_ROW FOR_EACH_ITEM
#define FOR_EACH_GROUP FOR_EACH_ITEM
#else
/* Numbers too small for their exponent cost a hundred times an ordinary one on a CPU, and tails ahead of waves are made
 * of them: each thread sets them to zero (as -cl-denorms-are-zero does in OpenCL) and puts its mode back. */
#if defined(__x86_64__)
#define BRC_FLOAT_MODE() __builtin_ia32_stmxcsr()
#define BRC_SET_FLOAT_MODE(mode) __builtin_ia32_ldmxcsr(mode)
#define BRC_FLUSHED(mode) ((mode) | 0x8040u) /* flush to zero, denormals are zero */
#else
#define BRC_FLOAT_MODE() 0u
#define BRC_SET_FLOAT_MODE(mode) ((void)(mode))
#define BRC_FLUSHED(mode) (mode)
#endif
#define BRC_FOR_EACH(i, from, to)                                                                                      \
    BRC_PRAGMA(omp parallel)                                                                                           \
    for (unsigned brc_mode = BRC_FLOAT_MODE(), brc_pass = 0; brc_pass < 2; ++brc_pass)                                 \
        if (BRC_SET_FLOAT_MODE(brc_pass ? brc_mode : BRC_FLUSHED(brc_mode)), !brc_pass)                                \
            BRC_PRAGMA(omp for schedule(static) nowait)                                                                \
    for (int i = from; i < (to); ++i)
#define FOR_EACH_ITEM(i, n) BRC_FOR_EACH(i, brc_first_item, n)
/* The same over groups of elements: all n, or those that the launch chooses (kernel_instance.h). */
#define BRC_CHOSEN(g, from, n)                                                                                         \
    BRC_FOR_EACH(brc_turn, from, brc_chosen ? brc_n_chosen : (n))                                                      \
    for (int g = brc_chosen ? brc_chosen[brc_turn] : brc_turn, brc_once = 1; brc_once; brc_once = 0)
#define FOR_EACH_GROUP(g, n) BRC_CHOSEN(g, brc_first_item, n)
/* The same over rows of elements, n and the first of which are multiples of W: the W rows of a group become vectors,
 * and no row rounds otherwise than another wherever threads and ranks part them. */
#define FOR_EACH_ROW(e, n)                                                                                             \
    BRC_CHOSEN(brc_group, brc_first_item / W, (n) / W)                                                                 \
    BRC_PRAGMA(omp simd) for (int e = brc_group * W; e < brc_group * W + W; ++e)
#endif
#if BRC_PRECISION == 0
#define SQRT(x) __builtin_sqrt(x)
#else
#define SQRT(x) __builtin_sqrtf(x)
#endif
#if BRC_PRECISION == 2
#define SQRT_STATE(x) __builtin_sqrtf(x)
#else
#define SQRT_STATE(x) __builtin_sqrt(x)
#endif
#if W == 1
typedef coeff lane;
typedef state lane_state;
typedef int lane_int;
#define LANE_FROM_STATE(x) ((coeff)(x))
#define STATE_FROM_LANE(x) ((state)(x))
#define LANE_SQRT(x) SQRT(x)
#define LANE_LESSER(a, b) ((a) < (b) ? (a) : (b))
#define LANE_DIFFERENT(a, b) ((coeff)((a) != (b)))
#define LANE_ABOVE(a, b) (-((a) > (b)))
#define LANE_ANY(x) ((x) != 0)
#define LANE_ANY_SHORT(a, b) (!((a) >= (b)))
#else
typedef coeff lane __attribute__((vector_size(W * sizeof(coeff))));
typedef state lane_state __attribute__((vector_size(W * sizeof(state))));
typedef int lane_int __attribute__((vector_size(W * sizeof(int))));
#define LANE_FROM_STATE(x) __builtin_convertvector((x), lane)
#define STATE_FROM_LANE(x) __builtin_convertvector((x), lane_state)
LAW lane brc_lane_sqrt(lane x)
{
    lane root;
    for (int l = 0; l < W; ++l) root[l] = SQRT(x[l]);
    return root;
}
#define LANE_SQRT(x) brc_lane_sqrt(x)
LAW lane brc_lane_lesser(lane a, lane b) /* a choice of bits: gcc has no ?: of vectors in C */
{
    const __typeof__(a < b) less = a < b;
    return (lane)((less & (__typeof__(a < b))a) | (~less & (__typeof__(a < b))b));
}
#define LANE_LESSER(a, b) brc_lane_lesser(a, b)
#define LANE_DIFFERENT(a, b) (-__builtin_convertvector((a) != (b), lane))
#define LANE_ABOVE(a, b) ((a) > (b))
LAW int brc_lane_any(lane_int x)
{
    int some = 0;
    for (int l = 0; l < W; ++l) some |= x[l];
    return some != 0;
}
LAW int brc_lane_any_short(lane a, lane b)
{
    int some = 0;
    for (int l = 0; l < W; ++l) some |= !(a[l] >= b[l]);
    return some;
}
#endif
#define BRC_LIST(...) __VA_ARGS__
#define LANE_MAKE_(type, items) ((type){BRC_LIST items})
#define LANE_ZERO ((lane){0})
#define LANE_ITEM_(x, hex) x[0x##hex]

#endif

/* Which lanes: LANE_LESS(a, b), and & | ~ of such. LANE_WHERE(which, a, b): a in these, b in the others. */
#if W == 1
typedef int lane_mask;
#define LANE_LESS(a, b) (-((a) < (b)))
#define LANE_WHERE(which, a, b) ((which) ? (a) : (b))
#define LANE_SOME(which) ((which) != 0)
#define LANE_ALL (-1)
#elif defined(__OPENCL_VERSION__)
#if BRC_PRECISION == 0
typedef BRC_JOIN(long, BRC_LANES) lane_mask;
#else
typedef BRC_JOIN(int, BRC_LANES) lane_mask;
#endif
#define LANE_LESS(a, b) ((a) < (b))
#define LANE_WHERE(which, a, b) select((b), (a), (which))
#define LANE_SOME(which) any(which)
#define LANE_ALL ((lane_mask)(-1))
#elif !defined(BRC_TARGET) && W == 8 && defined(__AVX512F__)
#include <immintrin.h>
typedef int lane_mask;
#if BRC_PRECISION == 0
#define LANE_LESS(a, b) ((int)_mm512_cmp_pd_mask((__m512d)(a), (__m512d)(b), _CMP_LT_OQ))
#define LANE_WHERE(which, a, b) ((lane)_mm512_mask_blend_pd((__mmask8)(which), (__m512d)(b), (__m512d)(a)))
#else
#define LANE_LESS(a, b) ((int)_mm256_cmp_ps_mask((__m256)(a), (__m256)(b), _CMP_LT_OQ))
#define LANE_WHERE(which, a, b) ((lane)_mm256_mask_blend_ps((__mmask8)(which), (__m256)(b), (__m256)(a)))
#endif
#define LANE_SOME(which) (((which)&0xff) != 0)
#define LANE_ALL 0xff
#else
#if BRC_PRECISION == 0
typedef long lane_mask __attribute__((vector_size(W * sizeof(coeff))));
#else
typedef int lane_mask __attribute__((vector_size(W * sizeof(coeff))));
#endif
LAW lane brc_lane_where(lane_mask which, lane a, lane b)
{
    return (lane)((which & (lane_mask)a) | (~which & (lane_mask)b));
}
#if !defined(BRC_TARGET) && defined(__AVX2__) && W == 4 && BRC_PRECISION == 0
#include <immintrin.h>
LAW int brc_lane_some(lane_mask which) { return _mm256_movemask_pd((__m256d)which); }
#elif !defined(BRC_TARGET) && defined(__AVX2__) && W == 8 && BRC_PRECISION != 0
#include <immintrin.h>
LAW int brc_lane_some(lane_mask which) { return _mm256_movemask_ps((__m256)which); }
#else
LAW int brc_lane_some(lane_mask which)
{
    int some = 0;
    for (int l = 0; l < W; ++l) some |= which[l] != 0;
    return some;
}
#endif
#define LANE_LESS(a, b) ((a) < (b))
#define LANE_WHERE(which, a, b) brc_lane_where((which), (a), (b))
#define LANE_SOME(which) brc_lane_some(which)
#define LANE_ALL (~(lane_mask){0})
#endif

/* How a kernel uses an array, by rows: those of the item's own elements, their slots, slices, faces and pairs, and all
 * others, as of neighbours. Read at its own; read at others too; written at its own; read and written at its own;
 * raised to one and the same number at others too, neighbours by bonds; the same, and read at its own; written, and
 * others read or written too; tests/kernels/test_kernel_markers.py checks all. */
#define OWN(type) GLOBAL const type *restrict
#define GATHER(type) GLOBAL const type *restrict
#define PUT(type) GLOBAL type *restrict
#define UPDATE(type) GLOBAL type *restrict
#define FLAG(type) GLOBAL type *restrict
#define SPREAD(type) GLOBAL type *restrict
#define SCATTER(type) GLOBAL type *restrict

/* Ask for a row entry `ahead` slots further on: rows are read once, in order, and the hardware's own prefetch stops at
 * every page of 4 KiB. What is used soon goes into every cache, what is used later into the second. */
#if !defined(__OPENCL_VERSION__) && W > 1
#define ROWS_AHEAD (256 / W)
#define RECORDS_AHEAD 512 /* rows; the host plans `ahead` with it (host/solver/core/layout.h) */
#define PREFETCH(p, at) __builtin_prefetch((p) + (at), 0, 3)
#define PREFETCH_LATER(p, at) __builtin_prefetch((p) + (at), 0, 2)
#else
#define PREFETCH(p, at) ((void)0)
#define PREFETCH_LATER(p, at) ((void)0)
#endif

/* Registers bound a GPU: loops over bonds that hold much are taken apart there, and what a loop only reads or only what
 * follows it needs is put aside, in the local memory of the group (ASIDE(name, n): room for n numbers of each
 * work-item, in front of the items of a kernel; `volatile`, or it stays in registers). BRC_GROUP: most of a group. */
#if defined(__OPENCL_VERSION__) && W == 1
#define SPLIT_LOOPS 1
typedef volatile __local coeff *aside;
#define ASIDE(name, n)                                                                                                 \
    __local coeff name##_of_group[(n)*BRC_GROUP];                                                                      \
    const aside name = name##_of_group + get_local_id(0)
#else
#define SPLIT_LOOPS 0
typedef int aside;
#define ASIDE(name, n) const aside name = 0
#endif

/* Blocks of numbers: on a GPU a group, the crew, does each (FOR_EACH_CREW; first parameter n_crews or n_crew_parts),
 * its CREW work-items every CREWth number, or of SCAN_BLOCK a part (CREW_BEGIN, CREW_END), or the first what all stage
 * in order (CREW_STAGE, CREW_STAGED). Of n columns each puts a row (CREW_PUT, CREW_WAIT), then sums CREW_SHARE(n) of
 * them (CREW_COLUMN), or FOR_CREW_COLUMNS. CREW_FIRST writes for all; CREW_SHARED: ints that the others are shown. */
#define SCAN_BLOCK 1024
#if defined(__OPENCL_VERSION__) && W == 1
#define CREW 32
typedef __local int *crew_room;
#define CREW_ROOM(name)                                                                                                \
    __local int name##_of_crew[CREW];                                                                                  \
    const crew_room name = name##_of_crew
#define CREW_DO(b, value, n)                                                                                           \
    const int b = (value);                                                                                             \
    if (b < (n))
#define FOR_EACH_CREW(b, n) CREW_DO(b, (int)get_global_id(0) / CREW, n)
#define FOR_CREW_COLUMNS(c, n) CREW_DO(c, CREW_PLACE, n)
#define CREW_PLACE ((int)get_local_id(0))
#define CREW_SHARED(array) ((volatile __global int *)(array))
#define CREW_STAGE(type, name) __local type name[SCAN_BLOCK]
#define CREW_STAGED(name, begin, end, i, value)                                                                        \
    for (int i = (begin) + CREW_PLACE; i < (end); i += CREW) name[i - (begin)] = (value);                              \
    CREW_WAIT()
#define CREW_NUMBER(name, at, value) name[at]
#define CREW_PUT(name, at, value) (name[at] = (value))
#define CREW_WAIT() barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)
#else
#define CREW_SHARED(array) array
#define FOR_CREW_COLUMNS(c, n) for (int c = 0; c < n; c += 1)
#define CREW 1
typedef int crew_room;
#define CREW_ROOM(name) const crew_room name = 0
#define FOR_EACH_CREW(b, n) FOR_EACH_ITEM(b, n)
#define CREW_PLACE 0
#define CREW_STAGE(type, name)
#define CREW_STAGED(name, begin, end, i, value)
#define CREW_NUMBER(name, at, value) (value)
#define CREW_PUT(name, at, value) ((void)0)
#define CREW_WAIT() ((void)0)
#endif
/* FOR_EACH_CREWS: blocks that one thread of a CPU sums side by side, each in its own order: ABREAST from b on. */
#if defined(__OPENCL_VERSION__) || defined(BRC_TARGET)
#define ABREAST 1
#define FOR_EACH_CREWS FOR_EACH_CREW
#else
#define ABREAST 8
#define FOR_EACH_CREWS(b, n)                                                                                           \
    BRC_FOR_EACH(brc_turn, 0, ((n)-brc_first_item + ABREAST - 1) / ABREAST)                                            \
    for (int b = brc_first_item + brc_turn * ABREAST, brc_once = 1; brc_once; brc_once = 0)
/* sum + a b, rounded as the compiler does for one block: once where it contracts (host/device/CMakeLists.txt). */
#if !defined(__FMA__)
#define STATE_ADD_PRODUCT(sum, a, b) ((sum) + (a) * (b))
#elif BRC_PRECISION == 2
#define STATE_ADD_PRODUCT(sum, a, b) __builtin_fmaf(a, b, sum)
#else
#define STATE_ADD_PRODUCT(sum, a, b) __builtin_fma(a, b, sum)
#endif
#endif
#define CREW_AT(row, column, n) ((row) * ((n) | 1) + (column)) /* odd: rows lie in different banks */
#define CREW_SHARE(n) (((n) + CREW - 1) / CREW)
#define CREW_COLUMN(i) ((i)*CREW + CREW_PLACE)
#define CREW_FIRST (CREW_PLACE == 0)
#define CREW_BEGIN(begin, end)                                                                                         \
    ((begin) + CREW_PLACE * (SCAN_BLOCK / CREW) < (end) ? (begin) + CREW_PLACE * (SCAN_BLOCK / CREW) : (end))
#define CREW_END(begin, end)                                                                                           \
    ((begin) + (CREW_PLACE + 1) * (SCAN_BLOCK / CREW) < (end) ? (begin) + (CREW_PLACE + 1) * (SCAN_BLOCK / CREW)       \
                                                              : (end))

/* Numbers of rows of three, one after the other: work-items of a group that lie side by side do numbers that do, which
 * a GPU reads and writes at once. */
#if defined(__OPENCL_VERSION__) && W == 1
#define FOR_EACH_COMPONENT(e, c, n)                                                                                    \
    for (int at_ = (int)get_local_id(0), base_ = (int)get_global_id(0) - at_; at_ < 3 * (int)get_local_size(0);        \
         at_ += (int)get_local_size(0))                                                                                \
        for (int e = base_ + at_ / 3, c = at_ % 3; e < (n); e = (n))
#else
#define FOR_EACH_COMPONENT(e, c, n)                                                                                    \
    FOR_EACH_ROW(e, n)                                                                                                 \
        for (int c = 0; c < 3; ++c)
#endif

/* Bonds whose gathers one work-item asks for before it waits for the first, where a GPU has the registers for two
 * (bench/results/2026-11-27-nvidia-h200); EACH_TURN: what is done for each. Sums are taken bond by bond, in the order
 * of the slots. */
#if defined(__OPENCL_VERSION__) && W == 1
#define TURNS 2
#define EACH_TURN(t) _Pragma("unroll") for (int t = 0; t < TURNS; ++t)
#else
#define TURNS 1
#define EACH_TURN(t) for (int t = 0; t < TURNS; ++t)
#endif

/* In front of a loop of many turns whose loads do not depend on each other: one work-item of a GPU asks for those of n
 * turns before it waits for the first. Sums are taken in the order written. */
#if defined(__OPENCL_VERSION__) && W == 1
#define BRC_TEXT(x) #x
#define LOADS_TOGETHER(n) _Pragma(BRC_TEXT(unroll n))
#else
#define LOADS_TOGETHER(n)
#endif

/* In front of a loop of n turns that is to be written out, so that small arrays stay in registers. */
#if defined(__OPENCL_VERSION__) || defined(__clang__)
#define WRITTEN_OUT(n) _Pragma("unroll")
#else
#define WRITTEN_OUT(n) BRC_PRAGMA(GCC unroll n)
#endif

/* LANE_MAKE(type, F) = (F(0), F(1), ... F(W-1)); LANE_ITEM(x, l) = component l, l a hex digit written out. */
#if W == 1
#define LANE_MAKE(type, F) F(0)
#define LANE_ITEM(x, l) (x)
#define LANE_EACH(F) F(0)
#elif W == 4
#define LANE_MAKE(type, F) LANE_MAKE_(type, (F(0), F(1), F(2), F(3)))
#define LANE_ITEM(x, l) LANE_ITEM_(x, l)
#define LANE_EACH(F) F(0) F(1) F(2) F(3)
#elif W == 8
#define LANE_MAKE(type, F) LANE_MAKE_(type, (F(0), F(1), F(2), F(3), F(4), F(5), F(6), F(7)))
#define LANE_ITEM(x, l) LANE_ITEM_(x, l)
#define LANE_EACH(F) F(0) F(1) F(2) F(3) F(4) F(5) F(6) F(7)
#elif W == 16
#define LANE_MAKE(type, F)                                                                                             \
    LANE_MAKE_(type, (F(0), F(1), F(2), F(3), F(4), F(5), F(6), F(7), F(8), F(9), F(a), F(b), F(c), F(d), F(e), F(f)))
#define LANE_ITEM(x, l) LANE_ITEM_(x, l)
#define LANE_EACH(F) F(0) F(1) F(2) F(3) F(4) F(5) F(6) F(7) F(8) F(9) F(a) F(b) F(c) F(d) F(e) F(f)
#else
#error "BRC_LANES must be 1, 4, 8 or 16"
#endif

/* Records of neighbours are read whole and transposed (records.h): with eight lanes and AVX-512, with eight floats or
 * four doubles and AVX2, whose shuffles do as many. With eight doubles on AVX2 each shuffle would become several
 * (measured: a third slower), so there and elsewhere numbers are gathered one by one. A vector reaches up to LANE_SPARE
 * numbers beyond the last record, which the host allocates. */
#if W > 1 && defined(__AVX2__) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12))
#define LANE_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#if W == 8 && (defined(__AVX512F__) || (defined(__AVX2__) && BRC_PRECISION > 0 && !defined(__OPENCL_VERSION__)))
#define LANE_SHUFFLES 8
#elif W == 4 && BRC_PRECISION == 0 && defined(__AVX2__) && !defined(__OPENCL_VERSION__)
#define LANE_SHUFFLES 4
#endif
#if W == 8 && (defined(__AVX512F__) || (defined(__AVX2__) && BRC_PRECISION == 2 && !defined(__OPENCL_VERSION__)))
#define STATE_SHUFFLES 8
#elif defined(LANE_SHUFFLES) && LANE_SHUFFLES == 4
#define STATE_SHUFFLES 4
#endif
#endif
#ifndef LANE_SHUFFLES
#define LANE_SHUFFLES 0
#endif
#ifndef STATE_SHUFFLES
#define STATE_SHUFFLES 0
#endif
#define LANE_SPARE 8
/* Numbers from anywhere: one instruction in place of a load, a shuffle and the arithmetic of a place for each lane. */
#if !defined(__OPENCL_VERSION__) && !defined(BRC_TARGET) && W == 8 && defined(__AVX512F__)
#include <immintrin.h>
#define LANE_PACK(to, keep, x)                                                                                         \
    _mm256_mask_compressstoreu_epi32((to), _mm256_movepi32_mask((__m256i)(keep)), (__m256i)(x))
#define LANE_COUNT(keep) __builtin_popcount(_mm256_movepi32_mask((__m256i)(keep)))
#define LANE_RANK(keep)                                                                                                \
    ((lane_int)_mm256_maskz_expand_epi32(_mm256_movepi32_mask((__m256i)(keep)),                                        \
                                         _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)))
#if BRC_PRECISION == 0
#define LANE_GATHER(p, at) ((lane)_mm512_i32gather_pd((__m256i)(at), (p), 8))
#else
#define LANE_GATHER(p, at) ((lane)_mm256_i32gather_ps((p), (__m256i)(at), 4))
#endif
#endif
/* Whether any number is not 0, or any of a is not at least that of b: gcc compares one by one by itself. */
#if !defined(LANE_ANY) && defined(LANE_GATHER)
#define LANE_ANY(x) (!_mm256_testz_si256((__m256i)(x), (__m256i)(x)))
#if BRC_PRECISION == 0
#define LANE_ANY_SHORT(a, b) (_mm512_cmp_pd_mask((__m512d)(a), (__m512d)(b), _CMP_NGE_UQ) != 0)
#else
#define LANE_ANY_SHORT(a, b) (_mm256_cmp_ps_mask((__m256)(a), (__m256)(b), _CMP_NGE_UQ) != 0)
#endif
#elif !defined(LANE_ANY)
#define LANE_ANY(x) brc_lane_any(x)
#define LANE_ANY_SHORT(a, b) brc_lane_any_short(a, b)
#endif
/* Storage (SELL-C): element arrays of n components that are only read by their own element are blocked,
 * [slice][component][C]; those that neighbours gather are [element][components]. Rows are [slot][component][C]. */
#define SLICE_OF(group) ((group) / (C / W))
#define FIRST_LANE_OF(group) (((group) % (C / W)) * W)
#endif
