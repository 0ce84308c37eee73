#include "ritz.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

/* Directions of the search space whose norm falls below this part of the largest are dropped. */
static const double dependent = 1e-13;

typedef struct ritz_pair {
    double value;
    int column;
} ritz_pair;
static int compare_pairs(const void *left, const void *right)
{
    const ritz_pair *a = left, *b = right;
    return a->value < b->value ? -1 : a->value > b->value;
}

/* Scratch of a problem of `count` columns. */
typedef struct ritz_room {
    double *basis, *spread, *reduced, *work, *imaginary; /* [count][count], [2][count], ... [count] */
    ritz_pair *pairs;
    int kept; /* well-conditioned directions, columns of work */
} ritz_room;

static brc_status allocate(brc_context *context, int count, ritz_room *t)
{
    BRC_TRY(BRC_ALLOCATE(context, &t->basis, count * count, "modes"));
    BRC_TRY(BRC_ALLOCATE(context, &t->spread, 2 * count, "modes"));
    BRC_TRY(BRC_ALLOCATE(context, &t->reduced, count * count, "modes"));
    BRC_TRY(BRC_ALLOCATE(context, &t->work, count * count, "modes"));
    BRC_TRY(BRC_ALLOCATE(context, &t->imaginary, count, "modes"));
    return BRC_ALLOCATE(context, &t->pairs, count, "modes");
}

/* Scale to unit diagonal, then keep the well-conditioned directions of the metric. */
static brc_status keep_directions(brc_context *context, int count, const double *g_small, ritz_room *t)
{
    double *scale = t->spread + count;
    for (int i = 0; i < count; ++i)
        scale[i] = g_small[i * count + i] > 0 ? 1 / sqrt(g_small[i * count + i]) : 0;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
            t->basis[i * count + j] = 0.5 * (g_small[i * count + j] + g_small[j * count + i]) * scale[i] * scale[j];
    if (LAPACKE_dsyevd(LAPACK_ROW_MAJOR, 'V', 'U', count, t->basis, count, t->spread) != 0)
        return BRC_FAIL(context, BRC_INTERNAL, "LAPACK could not diagonalise the metric of the modes");
    for (int j = 0; j < count; ++j) {
        if (t->spread[j] <= dependent * t->spread[count - 1]) continue;
        for (int i = 0; i < count; ++i)
            t->work[i * count + t->kept] = t->basis[i * count + j] * scale[i] / sqrt(t->spread[j]);
        ++t->kept;
    }
    return BRC_OK;
}

/* reduced = work^T K work. */
static void reduce(int count, const double *k_small, ritz_room *t)
{
    const int kept = t->kept;
    for (int a = 0; a < count; ++a)
        for (int j = 0; j < kept; ++j) {
            double sum = 0;
            for (int b = 0; b < count; ++b)
                sum += k_small[a * count + b] * t->work[b * count + j];
            t->basis[a * count + j] = sum;
        }
    for (int i = 0; i < kept; ++i)
        for (int j = 0; j < kept; ++j) {
            double sum = 0;
            for (int a = 0; a < count; ++a)
                sum += t->work[a * count + i] * t->basis[a * count + j];
            t->reduced[i * kept + j] = sum;
        }
}

/* Values into spread; *vectors: where vectors are. Whether LAPACK failed. */
static int diagonalise(bool symmetric, ritz_room *t, double **vectors)
{
    const int kept = t->kept;
    double *reduced = t->reduced;
    *vectors = symmetric ? reduced : t->basis;
    if (!symmetric)
        return LAPACKE_dgeev(LAPACK_ROW_MAJOR, 'N', 'V', kept, reduced, kept, t->spread, t->imaginary, NULL, kept,
                             *vectors, kept);
    for (int i = 0; i < kept; ++i)
        for (int j = 0; j < i; ++j)
            reduced[i * kept + j] = reduced[j * kept + i] = 0.5 * (reduced[i * kept + j] + reduced[j * kept + i]);
    return LAPACKE_dsyevd(LAPACK_ROW_MAJOR, 'V', 'U', kept, reduced, kept, t->spread);
}

brc_status brc_rayleigh_ritz(brc_context *context, bool symmetric, int m, int count, const double *k_small,
                             const double *g_small, double *values, double *coefficients)
{
    ritz_room t = {0};
    double *vectors;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, allocate(context, count, &t));
    BRC_TRY_OR(cleanup, keep_directions(context, count, g_small, &t));
    reduce(count, k_small, &t);
    if (diagonalise(symmetric, &t, &vectors) || t.kept < m) {
        status =
            BRC_FAIL(context, BRC_PHYSICS_STOPPED, "the search space of the modes collapsed to %d directions", t.kept);
        goto cleanup;
    }
    for (int j = 0; j < t.kept; ++j)
        t.pairs[j] = (ritz_pair){t.spread[j], j};
    qsort(t.pairs, (size_t)t.kept, sizeof *t.pairs, compare_pairs);
    for (int k = 0; k < m; ++k) {
        values[k] = t.pairs[k].value;
        for (int a = 0; a < count; ++a) {
            double sum = 0;
            for (int i = 0; i < t.kept; ++i)
                sum += t.work[a * count + i] * vectors[i * t.kept + t.pairs[k].column];
            coefficients[k * count + a] = sum;
        }
    }
cleanup:
    brc_memory_free(t.basis);
    brc_memory_free(t.spread);
    brc_memory_free(t.reduced);
    brc_memory_free(t.work);
    brc_memory_free(t.imaginary);
    brc_memory_free(t.pairs);
    return status;
}
