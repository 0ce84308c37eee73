/* A list of cells about as wide as a sphere. Every pair is found by its larger sphere, so that a small one among large
 * ones looks no farther than its own size. Ratios are counted in bins first; only the bin in which the wanted number is
 * reached has to be sorted. */
#include "bond_search.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N_BINS = 4096, CHUNK = 1024 };
/* Ratios within rounding of the reach are looked at too; cells are chosen with room for it. */
#define ROUNDING 1e-12
#define SAME_PLACE 1e-6

/* Spheres in the order of their cells. */
typedef struct cell_list {
    int64_t n, dims[3];
    double low[3], side;
    int64_t *start; /* [cells + 1] where the spheres of each begin */
    double (*x)[4]; /* [n] centre and radius */
    int32_t *id;    /* [n] */
} cell_list;

typedef struct candidate {
    double ratio;
    int32_t i, j; /* i < j */
} candidate;

/* What a pass over all pairs within reach does. */
typedef struct pass {
    const cell_list *list;
    double reach;         /* largest ratio looked at */
    int64_t *bin;         /* [N_BINS] pairs counted by ratio over reach; NULL: not wanted */
    int last_bin;         /* pairs in bins below it are bonds; those in it are contested */
    int32_t *count;       /* [n] bonds found by each sphere, in the order of the list; NULL: not wanted */
    candidate *contested; /* NULL: not wanted */
    int64_t n_contested;
    const int64_t *place; /* [n] where the bonds found by each sphere begin in pair; NULL: not wanted */
    int32_t (*pair)[2];
    candidate nearest; /* of all pairs: kept with bin only */
} pass;

static int compare_candidates(const void *left, const void *right)
{
    const candidate *a = left, *b = right;
    if (a->ratio != b->ratio) return a->ratio < b->ratio ? -1 : 1;
    if (a->i != b->i) return a->i < b->i ? -1 : 1;
    return a->j < b->j ? -1 : a->j > b->j;
}

static int64_t cell_along(const cell_list *list, int axis, double x)
{
    const double at = floor((x - list->low[axis]) / list->side);
    return at < 0.0 ? 0 : at >= (double)list->dims[axis] ? list->dims[axis] - 1 : (int64_t)at;
}

/* Cells of the mean diameter, or wider where the spheres stand far apart: never more than four a sphere. */
static void plan_cells(const double *position, const double *radius, int64_t n, cell_list *list)
{
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, sum = 0.0;
    for (int c = 0; c < 3; ++c)
        list->low[c] = HUGE_VAL;
    for (int64_t e = 0; e < n; ++e) {
        sum += radius[e];
        for (int c = 0; c < 3; ++c) {
            list->low[c] = fmin(list->low[c], position[3 * e + c]);
            high[c] = fmax(high[c], position[3 * e + c]);
        }
    }
    for (list->side = 2.0 * sum / (double)n;; list->side *= 1.2) {
        double cells = 1.0;
        for (int c = 0; c < 3; ++c) {
            const double along = floor((high[c] - list->low[c]) / list->side) + 1.0;
            list->dims[c] = along < 1e9 ? (int64_t)along : (int64_t)1e9;
            cells *= along;
        }
        if (cells <= 4.0 * (double)n + 64.0) return;
    }
}

static void free_cells(cell_list *list)
{
    brc_memory_free(list->start);
    brc_memory_free(list->x);
    brc_memory_free(list->id);
}

static brc_status make_cells(brc_context *context, const double *position, const double *radius, int64_t n,
                             cell_list *list)
{
    list->n = n;
    plan_cells(position, radius, n, list);
    const int64_t cells = list->dims[0] * list->dims[1] * list->dims[2];
    int32_t *cell = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &cell, n, "cells of spheres"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &list->start, cells + 1, "cell list"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &list->x, n, "cell list"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &list->id, n, "cell list"));
    for (int64_t e = 0; e < n; ++e) {
        int64_t at = 0;
        for (int c = 0; c < 3; ++c)
            at = at * list->dims[c] + cell_along(list, c, position[3 * e + c]);
        cell[e] = (int32_t)at;
        list->start[at + 1]++;
    }
    for (int64_t k = 0; k < cells; ++k)
        list->start[k + 1] += list->start[k];
    for (int64_t e = n - 1; e >= 0; --e) { /* from the back: each start ends where its cell begins */
        const int64_t to = --list->start[cell[e] + 1];
        memcpy(list->x[to], position + 3 * e, 3 * sizeof *position);
        list->x[to][3] = radius[e];
        list->id[to] = (int32_t)e;
    }
    memmove(list->start, list->start + 1, (size_t)cells * sizeof *list->start);
    list->start[cells] = n;
cleanup:
    brc_memory_free(cell);
    return status;
}

static void take_pair(pass *p, int64_t s, double ratio, int32_t a, int32_t b, int64_t *own_bin, candidate *nearest,
                      int64_t *placed)
{
    const candidate found = {ratio, a < b ? a : b, a < b ? b : a};
    const int bin = (int)fmin(ratio / p->reach * N_BINS, N_BINS - 1);
    if (own_bin) {
        own_bin[bin]++;
        if (compare_candidates(&found, nearest) < 0) *nearest = found;
        return;
    }
    if (bin > p->last_bin) return;
    if (bin < p->last_bin) {
        if (p->count) p->count[s]++;
        if (p->place) {
            p->pair[*placed][0] = found.i;
            p->pair[(*placed)++][1] = found.j;
        }
    } else if (p->contested) {
        int64_t to;
#pragma omp atomic capture
        to = p->n_contested++;
        p->contested[to] = found; /* sorted afterwards: the order of threads leaves no trace */
    }
}

/* All pairs of which the sphere at place s of the list is the larger (by index where equal). */
static void visit(pass *p, int64_t s, int64_t *own_bin, candidate *nearest)
{
    const cell_list *list = p->list;
    const double *x = list->x[s], reach = 2.0 * p->reach * x[3] * (1.0 + ROUNDING);
    const int32_t id = list->id[s];
    int64_t low[3], high[3], placed = p->place ? p->place[s] : 0;
    for (int c = 0; c < 3; ++c) {
        low[c] = cell_along(list, c, x[c] - reach);
        high[c] = cell_along(list, c, x[c] + reach);
    }
    for (int64_t i = low[0]; i <= high[0]; ++i)
        for (int64_t j = low[1]; j <= high[1]; ++j) {
            const int64_t row = (i * list->dims[1] + j) * list->dims[2];
            for (int64_t t = list->start[row + low[2]]; t < list->start[row + high[2] + 1]; ++t) {
                const double *y = list->x[t];
                const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]}, sum = x[3] + y[3], most = p->reach * sum;
                const double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
                if (square > most * most * (1.0 + ROUNDING)) continue; /* nearly all: no other test before it */
                if (y[3] > x[3] || (y[3] == x[3] && list->id[t] >= id)) continue;
                const double ratio = sqrt(square) / sum;
                if (ratio <= p->reach) take_pair(p, s, ratio, id, list->id[t], own_bin, nearest, &placed);
            }
        }
}

static void run_pass(pass *p, int n_threads)
{
    p->nearest = (candidate){HUGE_VAL, 0, 0};
    if (p->bin) memset(p->bin, 0, N_BINS * sizeof *p->bin);
#pragma omp parallel num_threads(n_threads)
    {
        int64_t own_bin[N_BINS] = {0};
        candidate nearest = {HUGE_VAL, 0, 0};
#pragma omp for schedule(dynamic, CHUNK)
        for (int64_t s = 0; s < p->list->n; ++s)
            visit(p, s, p->bin ? own_bin : NULL, &nearest);
        if (p->bin) {
#pragma omp critical(brc_bond_search_bins)
            {
                for (int b = 0; b < N_BINS; ++b)
                    p->bin[b] += own_bin[b];
                if (compare_candidates(&nearest, &p->nearest) < 0) p->nearest = nearest;
            }
        }
    }
}

/* Widen the reach until it holds at least n_pairs pairs, and find the bin in which they are reached. *below: pairs in
 * the bins before it. */
static void find_reach(pass *p, int64_t n_pairs, int n_threads, int64_t *below)
{
    const double mean = 2.0 * (double)n_pairs / (double)p->list->n;
    p->reach = 1.1 + 0.065 * fmax(0.0, fmin(mean, 40.0) - 6.0); /* a little above what dense packings need */
    for (;;) {
        int64_t total = 0;
        run_pass(p, n_threads);
        for (int b = 0; b < N_BINS; ++b)
            total += p->bin[b];
        if (total >= n_pairs) break;
        const double wanted = total > 0 ? cbrt(1.2 * (double)n_pairs / (double)total) : 2.0;
        p->reach *= fmax(1.1, fmin(wanted, 2.0));
    }
    *below = 0;
    for (p->last_bin = 0; *below + p->bin[p->last_bin] < n_pairs; ++p->last_bin)
        *below += p->bin[p->last_bin];
}

brc_status brc_bond_search(brc_context *context, const double *position, const double *radius, int64_t n,
                           int64_t n_pairs, int n_threads, int32_t (**pair)[2], double *growth)
{
    cell_list list = {.n = n};
    int64_t bin[N_BINS], below, *place = NULL;
    pass p = {.list = &list, .bin = bin};
    *pair = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, make_cells(context, position, radius, n, &list));
    find_reach(&p, n_pairs, n_threads, &below);
    if (p.nearest.ratio < SAME_PLACE) {
        const double *x = position + 3 * (int64_t)p.nearest.i;
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "spheres %d and %d (counted from 0) are in one place, (%g, %g, %g) m: a bond needs a length; "
                          "remove one of them",
                          p.nearest.i, p.nearest.j, x[0], x[1], x[2]);
        goto cleanup;
    }
    p.bin = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &p.contested, bin[p.last_bin], "pairs near the largest ratio"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &p.count, n, "numbers of bonds"));
    run_pass(&p, n_threads);
    qsort(p.contested, (size_t)p.n_contested, sizeof *p.contested, compare_candidates);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &place, n + 1, "places of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, pair, n_pairs, "bonds"));
    for (int64_t s = 0; s < n; ++s)
        place[s + 1] = place[s] + p.count[s];
    for (int64_t k = below; k < n_pairs; ++k) {
        (*pair)[k][0] = p.contested[k - below].i;
        (*pair)[k][1] = p.contested[k - below].j;
    }
    *growth = p.contested[n_pairs - below - 1].ratio;
    brc_memory_free(p.contested);
    brc_memory_free(p.count);
    p.contested = NULL;
    p.count = NULL;
    p.place = place;
    p.pair = *pair;
    run_pass(&p, n_threads);
cleanup:
    free_cells(&list);
    brc_memory_free(p.contested);
    brc_memory_free(p.count);
    brc_memory_free(place);
    return status;
}
