/* Only pairs with nearly the longest ratio are contested, on both sides of it; all shorter ones are bonds whatever t
 * is. The sum of length times harmonics over the bonds is the gradient of a convex function of the coefficients of t,
 * its slope nearly the same number for all harmonics: a scalar secant finds the zero. */
#include "bond_balance.h"

#include "../../host/base/memory.h"
#include "bond_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FEWEST_CONTESTED = 200, MOST_TRIALS = 40, FEET = 16 };
/* A mean harmonic of walls shorter than this share of its largest possible length counts as cancelled. */
#define WALLS_CANCEL 0.05
/* The largest |t|, in half the range of the contested and at most: then no pair outside that range comes to the other
 * side of the cut. */
#define RANGE_USED 0.4
#define MOST_RANGE 0.2
/* Contested on the far side of the longest bond: this over sqrt(n) of the bonds, since what chance leaves falls so. */
#define SHARE 12.0
/* What is left is as small as whole bonds allow: two of them; the parts of one have the length sqrt(14). */
#define NEAR_ENOUGH 8.0
/* Ratios nearer together than this [of themselves] are equal. */
#define NO_WIDTH 1e-9

static const int degree_start[3] = {0, 5, BRC_BALANCE_PARTS};

typedef struct contested {
    double ratio, length, part[BRC_BALANCE_PARTS];
    int32_t i, j; /* i < j */
} contested;

typedef struct place {
    double key; /* ratio / (1 + t) */
    int64_t index;
} place;

typedef struct work {
    const double *position, *radius, *walls;
    contested *list;
    place *order; /* [n] of the list by key: the first n_chosen are bonds */
    int64_t n, n_chosen;
    double mean_length;
    double fixed[BRC_BALANCE_PARTS]; /* of the pairs that are bonds in any case */
} work;

void brc_balance_harmonics(const double n[3], double out[BRC_BALANCE_PARTS])
{
    const double x = n[0], y = n[1], z = n[2], xx = x * x, yy = y * y, zz = z * z;
    const double parts[BRC_BALANCE_PARTS] = {sqrt(15.0) * x * y,
                                             sqrt(15.0) * y * z,
                                             sqrt(15.0) * x * z,
                                             sqrt(15.0) / 2 * (xx - yy),
                                             sqrt(5.0) / 2 * (3 * zz - 1),
                                             (35 * zz * zz - 30 * zz + 3) * 3 / 8,
                                             sqrt(10.0) * 3 / 4 * x * z * (7 * zz - 3),
                                             sqrt(10.0) * 3 / 4 * y * z * (7 * zz - 3),
                                             sqrt(5.0) * 3 / 4 * (xx - yy) * (7 * zz - 1),
                                             sqrt(5.0) * 3 / 2 * x * y * (7 * zz - 1),
                                             sqrt(70.0) * 3 / 4 * x * z * (xx - 3 * yy),
                                             sqrt(70.0) * 3 / 4 * y * z * (3 * xx - yy),
                                             sqrt(35.0) * 3 / 8 * (xx * xx - 6 * xx * yy + yy * yy),
                                             sqrt(35.0) * 3 / 2 * x * y * (xx - yy)};
    memcpy(out, parts, sizeof parts);
}

static double dot(const double *a, const double *b, int from, int to)
{
    double sum = 0;
    for (int k = from; k < to; ++k)
        sum += a[k] * b[k];
    return sum;
}

void brc_balance_of_walls(const brc_solid *solid, const double *position, const double *radius, int64_t n,
                          int n_threads, double out[BRC_BALANCE_PARTS])
{
    double sum[BRC_BALANCE_PARTS + 1] = {0};
#pragma omp parallel for ordered schedule(static, 256) num_threads(n_threads)
    for (int64_t e = 0; e < n; ++e) {
        brc_foot feet[FEET];
        const int32_t found = brc_solid_feet(solid, position + 3 * e, 2 * radius[e], feet, FEET);
#pragma omp ordered
        for (int32_t k = 0; k < found && k < FEET; ++k) {
            double part[BRC_BALANCE_PARTS];
            brc_balance_harmonics(feet[k].normal, part);
            for (int c = 0; c < BRC_BALANCE_PARTS; ++c)
                sum[c] += part[c];
            sum[BRC_BALANCE_PARTS] += 1;
        }
    }
    for (int c = 0; c < BRC_BALANCE_PARTS; ++c)
        out[c] = sum[c] / fmax(sum[BRC_BALANCE_PARTS], 1);
    for (int d = 0; d < 2; ++d) {
        const int from = degree_start[d], to = degree_start[d + 1];
        if (dot(out, out, from, to) < WALLS_CANCEL * WALLS_CANCEL * (to - from))
            memset(out + from, 0, (size_t)(to - from) * sizeof *out);
    }
}

/* Ratio, length and harmonics of a pair. */
static contested look_at(const work *w, const int32_t pair[2])
{
    const double *a = w->position + 3 * (int64_t)pair[0], *b = w->position + 3 * (int64_t)pair[1];
    double branch[3], square = 0;
    contested out = {.i = pair[0], .j = pair[1]};
    for (int c = 0; c < 3; ++c) {
        branch[c] = b[c] - a[c];
        square += branch[c] * branch[c];
    }
    out.length = sqrt(square);
    out.ratio = out.length / (w->radius[pair[0]] + w->radius[pair[1]]);
    for (int c = 0; c < 3; ++c)
        branch[c] /= out.length;
    brc_balance_harmonics(branch, out.part);
    return out;
}

static int compare(const void *left, const void *right)
{
    const place *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return a->index < b->index ? -1 : a->index > b->index;
}

/* Choose bonds by the coefficients of t; what is left of the sums. */
static double choose(work *w, const double tilt[BRC_BALANCE_PARTS], double left[BRC_BALANCE_PARTS])
{
    for (int64_t k = 0; k < w->n; ++k)
        w->order[k] = (place){w->list[k].ratio / (1 + dot(tilt, w->list[k].part, 0, BRC_BALANCE_PARTS)), k};
    qsort(w->order, (size_t)w->n, sizeof *w->order, compare);
    memcpy(left, w->fixed, sizeof w->fixed);
    for (int64_t k = 0; k < w->n_chosen; ++k) {
        const contested *one = &w->list[w->order[k].index];
        for (int c = 0; c < BRC_BALANCE_PARTS; ++c)
            left[c] += one->length * one->part[c];
    }
    for (int d = 0; d < 2 && w->walls; ++d) {
        const int from = degree_start[d], to = degree_start[d + 1];
        const double square = dot(w->walls, w->walls, from, to),
                     along = square > 0 ? dot(left, w->walls, from, to) / square : 0;
        for (int c = from; c < to; ++c)
            left[c] -= along * w->walls[c];
    }
    return sqrt(dot(left, left, 0, BRC_BALANCE_PARTS));
}

/* Keep t within the range. */
static void bound(const work *w, double range, double tilt[BRC_BALANCE_PARTS])
{
    double most = 0;
    for (int64_t k = 0; k < w->n; ++k)
        most = fmax(most, fabs(dot(tilt, w->list[k].part, 0, BRC_BALANCE_PARTS)));
    for (int c = 0; c < BRC_BALANCE_PARTS && most > range; ++c)
        tilt[c] *= range / most;
}

/* Find t and leave the list chosen by it. range: largest |t|; slope: of the sums against the coefficients, as a
 * guess. */
static void solve(work *w, double range, double slope)
{
    double tilt[BRC_BALANCE_PARTS] = {0}, best[BRC_BALANCE_PARTS] = {0}, left[BRC_BALANCE_PARTS],
           rest = choose(w, tilt, left), least = rest;
    for (int trial = 0; trial < MOST_TRIALS && least > NEAR_ENOUGH * w->mean_length; ++trial) {
        double next[BRC_BALANCE_PARTS], step[BRC_BALANCE_PARTS], then[BRC_BALANCE_PARTS], change[BRC_BALANCE_PARTS];
        for (int c = 0; c < BRC_BALANCE_PARTS; ++c)
            next[c] = tilt[c] - left[c] / slope;
        bound(w, range, next);
        rest = choose(w, next, then);
        for (int c = 0; c < BRC_BALANCE_PARTS; ++c) {
            step[c] = next[c] - tilt[c];
            change[c] = then[c] - left[c];
        }
        const double seen = dot(change, step, 0, BRC_BALANCE_PARTS) / dot(step, step, 0, BRC_BALANCE_PARTS);
        if (isfinite(seen)) slope = fmin(fmax(seen, slope / 2), 2 * slope);
        memcpy(tilt, next, sizeof tilt);
        memcpy(left, then, sizeof left);
        if (rest < least) {
            least = rest;
            memcpy(best, next, sizeof best);
        }
    }
    choose(w, best, left);
}

/* Pairs longer than `shortest` into the list; the others, bonds in any case, to the front of the pairs: *n_fixed. */
static brc_status contest(brc_context *context, work *w, int32_t (*pair)[2], int64_t n, double shortest,
                          int64_t *n_fixed)
{
    int64_t n_longer = 0;
    for (int64_t k = 0; k < n; ++k)
        n_longer += look_at(w, pair[k]).ratio > shortest;
    BRC_TRY(BRC_ALLOCATE(context, &w->list, n_longer, "pairs near the longest bond"));
    BRC_TRY(BRC_ALLOCATE(context, &w->order, n_longer, "pairs near the longest bond"));
    *n_fixed = 0;
    for (int64_t k = 0; k < n; ++k) {
        const contested one = look_at(w, pair[k]);
        if (one.ratio > shortest) {
            w->list[w->n++] = one;
            continue;
        }
        for (int c = 0; c < BRC_BALANCE_PARTS; ++c)
            w->fixed[c] += one.length * one.part[c];
        memmove(pair[(*n_fixed)++], pair[k], sizeof *pair);
    }
    return BRC_OK;
}

brc_status brc_bond_balance(brc_context *context, const double *position, const double *radius, int64_t n,
                            int64_t n_pairs, const double walls[BRC_BALANCE_PARTS], int n_threads, int32_t (**pair)[2],
                            double *growth)
{
    work w = {.position = position, .radius = radius, .walls = walls};
    const double share = fmin(SHARE / sqrt((double)n), 0.5), all = 0.5 * (double)n * (double)(n - 1);
    const int64_t n_searched = n_pairs + (int64_t)fmin(share * (double)n_pairs, all - (double)n_pairs);
    double reach, weight = 0;
    int64_t fixed;
    brc_status status = BRC_OK;
    BRC_TRY(brc_bond_search(context, position, radius, n, n_pairs, n_threads, pair, growth));
    if (n_searched - n_pairs < FEWEST_CONTESTED) return BRC_OK;
    brc_memory_free(*pair);
    BRC_TRY(brc_bond_search(context, position, radius, n, n_searched, n_threads, pair, &reach));
    const double width = reach - *growth;
    if (!(width > NO_WIDTH * *growth)) { /* a lattice: nothing tells the pairs apart */
        brc_memory_free(*pair);
        return brc_bond_search(context, position, radius, n, n_pairs, n_threads, pair, growth);
    }
    BRC_TRY_OR(cleanup, contest(context, &w, *pair, n_searched, *growth - width, &fixed));
    w.n_chosen = n_pairs - fixed;
    for (int64_t k = 0; k < w.n; ++k)
        weight += w.list[k].length;
    w.mean_length = weight / (double)w.n;
    solve(&w, fmin(RANGE_USED * width / *growth, MOST_RANGE), weight * *growth / (2 * width));
    *growth = 0;
    for (int64_t k = 0; k < w.n_chosen; ++k) {
        const contested *one = &w.list[w.order[k].index];
        (*pair)[fixed + k][0] = one->i;
        (*pair)[fixed + k][1] = one->j;
        *growth = fmax(*growth, one->ratio);
    }
    status = brc_memory_resize(context, (void **)pair, 2 * n_pairs, sizeof(int32_t), "bonds");
cleanup:
    brc_memory_free(w.list);
    brc_memory_free(w.order);
    if (status != BRC_OK) {
        brc_memory_free(*pair);
        *pair = NULL;
    }
    return status;
}
