/* Keys by Skilling's transposition; sorted by their bytes, which keeps points of equal keys in their order. */
#include "order.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { CURVE_BITS = 16, DIGIT_BITS = 12, N_DIGITS = 3 * CURVE_BITS / DIGIT_BITS };

typedef struct place {
    uint64_t key;
    int32_t point;
} place;

/* Place of a cell on the Hilbert curve of 2^CURVE_BITS cells a side (Skilling, AIP Conf. Proc. 707, 2004). */
static uint64_t hilbert_key(const uint32_t cell[3])
{
    uint32_t x[3] = {cell[0], cell[1], cell[2]};
    for (uint32_t q = 1u << (CURVE_BITS - 1); q > 1; q >>= 1) {
        const uint32_t p = q - 1;
        for (int i = 0; i < 3; ++i) {
            if (x[i] & q) {
                x[0] ^= p;
            } else {
                const uint32_t t = (x[0] ^ x[i]) & p;
                x[0] ^= t;
                x[i] ^= t;
            }
        }
    }
    for (int i = 1; i < 3; ++i)
        x[i] ^= x[i - 1];
    uint32_t t = 0;
    for (uint32_t q = 1u << (CURVE_BITS - 1); q > 1; q >>= 1)
        if (x[2] & q) t ^= q - 1;
    for (int i = 0; i < 3; ++i)
        x[i] ^= t;
    uint64_t key = 0;
    for (int bit = CURVE_BITS - 1; bit >= 0; --bit)
        for (int i = 0; i < 3; ++i)
            key = (key << 1) | ((x[i] >> bit) & 1u);
    return key;
}

static void bounds_of(const double *position, int64_t n, double bounds[2][3])
{
    for (int c = 0; c < 3; ++c) {
        bounds[0][c] = HUGE_VAL;
        bounds[1][c] = -HUGE_VAL;
    }
    for (int64_t p = 0; p < n; ++p)
        for (int c = 0; c < 3; ++c) {
            bounds[0][c] = fmin(bounds[0][c], position[3 * p + c]);
            bounds[1][c] = fmax(bounds[1][c], position[3 * p + c]);
        }
}

/* Least significant digit first; an even number of passes ends where it began. */
static void sort_places(place *from, place *to, int64_t n)
{
    int64_t start[(1 << DIGIT_BITS) + 1];
    for (int digit = 0; digit < N_DIGITS; ++digit) {
        const int shift = digit * DIGIT_BITS;
        const uint64_t mask = (1 << DIGIT_BITS) - 1;
        memset(start, 0, sizeof start);
        for (int64_t k = 0; k < n; ++k)
            start[((from[k].key >> shift) & mask) + 1]++;
        for (uint64_t v = 0; v < mask; ++v)
            start[v + 1] += start[v];
        for (int64_t k = 0; k < n; ++k)
            to[start[(from[k].key >> shift) & mask]++] = from[k];
        place *swap = from;
        from = to;
        to = swap;
    }
}
_Static_assert(N_DIGITS % 2 == 0 && N_DIGITS * DIGIT_BITS == 3 * CURVE_BITS,
               "the sorted places must end in the first array");

brc_status brc_order_hilbert(brc_context *context, const double *position, int64_t n, const double bounds[2][3],
                             int n_threads, int32_t *order)
{
    double own[2][3];
    if (!bounds) {
        bounds_of(position, n, own);
        bounds = (const double(*)[3])own;
    }
    double scale = 0;
    for (int c = 0; c < 3; ++c)
        scale = fmax(scale, bounds[1][c] - bounds[0][c]);
    const double per_cell = scale > 0 ? ((1u << CURVE_BITS) - 1) / scale : 0;
    place *places = NULL, *other = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &places, n, "order along the curve"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &other, n, "order along the curve"));
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t p = 0; p < n; ++p) {
        uint32_t cell[3];
        for (int c = 0; c < 3; ++c) {
            const double at = (position[3 * p + c] - bounds[0][c]) * per_cell, last = (1u << CURVE_BITS) - 1;
            cell[c] = at > 0 ? (uint32_t)fmin(at, last) : 0; /* nan: 0 */
        }
        places[p] = (place){hilbert_key(cell), (int32_t)p};
    }
    sort_places(places, other, n);
    for (int64_t k = 0; k < n; ++k)
        order[k] = places[k].point;
cleanup:
    brc_memory_free(places);
    brc_memory_free(other);
    return status;
}

static brc_status permute(brc_context *context, const int32_t *order, int64_t n, int width, double *data)
{
    double *sorted;
    BRC_TRY(BRC_ALLOCATE(context, &sorted, n * width, "sorted points"));
    for (int64_t k = 0; k < n; ++k)
        memcpy(sorted + width * k, data + width * (int64_t)order[k], (size_t)width * sizeof *data);
    memcpy(data, sorted, (size_t)(n * width) * sizeof *data);
    brc_memory_free(sorted);
    return BRC_OK;
}

brc_status brc_order_points(brc_context *context, double *position, double *radius, int64_t n, int n_threads)
{
    int32_t *order = NULL;
    brc_status status = BRC_OK;
    if (n > INT32_MAX)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%lld points, must be below 2^31; use fewer", (long long)n);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &order, n, "order of points"));
    BRC_TRY_OR(cleanup, brc_order_hilbert(context, position, n, NULL, n_threads, order));
    BRC_TRY_OR(cleanup, permute(context, order, n, 3, position));
    if (radius) status = permute(context, order, n, 1, radius);
cleanup:
    brc_memory_free(order);
    return status;
}
