/* Laws of the sizes of fragments, of one run or of some together. Sizes are shares of the mass of a run, or their cube
 * roots, so that runs of bodies of any size can be put together. */
#include "study.h"
#include "calibrate/least_squares.h"
#include "../base/file.h"
#include "../base/memory.h"
#include "../output/csv_read.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { LEAST_IN_TAIL = 10, CUTS = 200, SIEVES = 128 };

/* ---- fragments of runs ---- */

static brc_status add_rows(brc_context *context, const brc_csv_read *csv, brc_study_pieces *pieces)
{
    const int frame = brc_csv_read_column(csv, "frame"), mass = brc_csv_read_column(csv, "mass");
    const int elements = brc_csv_read_column(csv, "elements");
    if (csv->n_rows == 0 || frame < 0 || mass < 0 || elements < 0) return BRC_OK;
    const double *last = csv->value + (csv->n_rows - 1) * csv->n_columns;
    int64_t n = 0;
    double total = 0, n_elements = 0;
    for (; n < csv->n_rows && (last - n * csv->n_columns)[frame] == last[frame]; ++n) {
        total += (last - n * csv->n_columns)[mass];
        n_elements += (last - n * csv->n_columns)[elements];
    }
    if (!(total > 0 && n_elements > 0) || pieces->n + n > INT32_MAX) return BRC_OK;
    BRC_TRY(brc_memory_resize(context, (void **)&pieces->share, pieces->n + n, sizeof *pieces->share, "fragments"));
    BRC_TRY(
        brc_memory_resize(context, (void **)&pieces->elements, pieces->n + n, sizeof *pieces->elements, "fragments"));
    for (int64_t k = 0; k < n; ++k, ++pieces->n) {
        pieces->share[pieces->n] = (last - k * csv->n_columns)[mass] / total;
        pieces->elements[pieces->n] = (int)(last - k * csv->n_columns)[elements];
    }
    pieces->element = (pieces->element * pieces->n_runs + 1 / n_elements) / (pieces->n_runs + 1);
    ++pieces->n_runs;
    return BRC_OK;
}

brc_status brc_study_pieces_add(brc_context *context, const char *folder, int run, brc_study_pieces *pieces)
{
    char number[16], *path = NULL;
    brc_csv_read csv = {0};
    snprintf(number, sizeof number, "%05d", run);
    brc_status status = brc_file_join(context, folder, number, &path);
    if (status == BRC_OK) status = brc_csv_read_open(context, path, "fragments.csv", &csv);
    if (status == BRC_OK) status = add_rows(context, &csv, pieces);
    brc_csv_read_free(&csv);
    brc_memory_free(path);
    return status;
}

typedef struct piece {
    double share;
    int elements;
} piece;

static int by_share(const void *a, const void *b)
{
    const piece *one = a, *other = b;
    if (one->share != other->share) return one->share < other->share ? -1 : 1;
    return (one->elements > other->elements) - (one->elements < other->elements);
}

brc_status brc_study_pieces_sort(brc_context *context, brc_study_pieces *pieces)
{
    piece *all = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &all, pieces->n + 1, "fragments"));
    for (int i = 0; i < pieces->n; ++i)
        all[i] = (piece){pieces->share[i], pieces->elements[i]};
    qsort(all, (size_t)pieces->n, sizeof *all, by_share);
    for (int i = 0; i < pieces->n; ++i)
        pieces->share[i] = all[i].share, pieces->elements[i] = all[i].elements;
    brc_memory_free(all);
    return BRC_OK;
}

void brc_study_pieces_free(brc_study_pieces *pieces)
{
    brc_memory_free(pieces->share);
    brc_memory_free(pieces->elements);
    *pieces = (brc_study_pieces){0};
}

static void add(brc_study_found *found, const char *name, double value, double error)
{
    found->parameter[found->n_parameters].name = name;
    found->parameter[found->n_parameters].value = value;
    found->parameter[found->n_parameters++].error = error;
}

/* ---- the power law n(m) ~ m^-tau of their number ---- */

/* The most likely a = 1 - tau of values whose logarithms over low have this mean, where they can be at most high: the
 * mean of ln x / low is length / (1 - exp(-a length)) - 1 / a with length = ln high / low, and -1 / a without a bound.
 * *spread: n times the square of the standard error. */
static double likeliest(double mean, double length, double *spread)
{
    enum { HALVINGS = 100, STEEPEST = 60 };
    static const double FLAT = 1e-4; /* a length below which the mean is expanded: length / 2 + a length^2 / 12 */
    if (isinf(length)) {
        *spread = 1 / (mean * mean);
        return -1 / mean;
    }
    double least = -STEEPEST / length, most = STEEPEST / length;
    for (int k = 0; k < HALVINGS; ++k) {
        const double a = 0.5 * (least + most), t = a * length;
        const double expected = fabs(t) < FLAT ? length * (0.5 + t / 12) : length / (1 - exp(-t)) - 1 / a;
        if (expected < mean)
            least = a;
        else
            most = a;
    }
    const double a = 0.5 * (least + most), t = a * length;
    const double bend = fabs(t) < FLAT ? t / 12 : 0; /* variance of ln x: length^2 / 12 where it is flat */
    const double variance =
        fabs(t) < FLAT ? length * length * (1 - bend * t) / 12 : 1 / (a * a) - pow(length / (2 * sinh(0.5 * t)), 2);
    *spread = 1 / variance;
    return a;
}

/* Share of the values below x. */
static double power_below(double a, double length, double log_x)
{
    if (isinf(length)) return -expm1(a * log_x);
    return fabs(a * length) < 1e-9 ? log_x / length : expm1(a * log_x) / expm1(a * length);
}

/* Kolmogorov and Smirnov's distance of n growing values from the law. */
static double distance(int n, const double *x, double low, double a, double length)
{
    double most = 0;
    for (int i = 0; i < n; ++i) {
        const double below = power_below(a, length, log(x[i] / low));
        most = fmax(most, fmax(below - (double)i / n, (double)(i + 1) / n - below));
    }
    return most;
}

typedef struct tail {
    double a, spread, distance;
} tail;

/* The tail of n values from low on, the sum of whose logarithms is known. */
static tail fit_tail(int n, const double *x, double logs, double low, double high)
{
    tail t;
    const double length = isinf(high) ? INFINITY : log(high / low);
    t.a = likeliest(logs / n - log(low), length, &t.spread);
    t.distance = distance(n, x, low, t.a, length);
    return t;
}

/* Clauset, Shalizi and Newman (SIAM Review 51, 2009, 661): the lower cut is the one whose tail is nearest to its own
 * most likely law. At most CUTS of them are tried. */
static brc_study_found fit_power(int n, const double *x, double above, double below)
{
    brc_study_found found = {0};
    const double high = below > 0 ? below : INFINITY;
    int first = 0, best = -1;
    double logs = 0, low = above;
    tail least = {0};
    while (first < n && x[first] < above)
        ++first;
    while (n > first && x[n - 1] > high)
        --n;
    if (n - first < LEAST_IN_TAIL) return found;
    const int cuts = above > 0 ? 1 : n - first - LEAST_IN_TAIL + 1, stride = (cuts + CUTS - 1) / CUTS;
    for (int i = first; i < n; ++i)
        logs += log(x[i]);
    for (int i = first; i < first + cuts; ++i) {
        if ((i - first) % stride == 0 && (i == first || x[i] > x[i - 1]) && x[n - 1] > x[i]) {
            const double cut = above > 0 ? above : x[i];
            const tail one = fit_tail(n - i, x + i, logs, cut, high);
            if (best < 0 || one.distance < least.distance) least = one, best = i, low = cut;
        }
        logs -= log(x[i]);
    }
    if (best < 0) return found;
    found.n = n - best;
    add(&found, "exponent", 1 - least.a, sqrt(least.spread / found.n));
    add(&found, "lower_cut", low, NAN);
    add(&found, "distance", least.distance, NAN);
    return found;
}

/* ---- laws of the mass in fragments that pass a sieve ---- */

typedef struct sieves {
    int n;
    /* cube root of a share of the mass; share of the mass in pieces that are not larger */
    double size[SIEVES], passing[SIEVES];
} sieves;

/* A sieve each root of two from the size of `elements` elements upward, below the largest piece. */
static sieves sift(const brc_study_pieces *pieces, int elements)
{
    sieves s = {0};
    double passed = 0;
    int i = 0;
    for (double size = cbrt(elements * pieces->element); s.n < SIEVES; size *= sqrt(2)) {
        for (; i < pieces->n && pieces->share[i] <= size * size * size; ++i)
            passed += pieces->share[i] / pieces->n_runs;
        if (i == pieces->n) break;
        if (passed <= 0) continue;
        s.size[s.n] = size;
        s.passing[s.n++] = passed;
    }
    return s;
}

/* Gates, Gaudin and Schuhmann: passing = (x / size)^exponent, by least squares of the logarithms of what lies below
 * 80 %. */
static brc_study_found fit_schuhmann(const sieves *s)
{
    static const double STRAIGHT = 0.8;
    int n = 0;
    while (n < s->n && s->passing[n] <= STRAIGHT)
        ++n;
    brc_study_found line = brc_study_fit_power(n, s->size, s->passing), found = {.n = n};
    if (n < 3 || line.n_parameters == 0) return found;
    const double exponent = line.parameter[0].value;
    add(&found, "exponent", exponent, line.parameter[0].error);
    add(&found, "size", pow(line.parameter[1].value, -1 / exponent), NAN);
    return found;
}

/* Rosin and Rammler: passing = 1 - exp(-(x / size)^exponent). */
static brc_study_found fit_rosin_rammler(const sieves *s)
{
    double flaws[SIEVES];
    for (int k = 0; k < s->n; ++k)
        flaws[k] = -log1p(-s->passing[k]);
    brc_study_found line = brc_study_fit_power(s->n, s->size, flaws), found = {.n = s->n};
    if (s->n < 3 || line.n_parameters == 0) return found;
    const double exponent = line.parameter[0].value;
    add(&found, "exponent", exponent, line.parameter[0].error);
    add(&found, "size", pow(line.parameter[1].value, -1 / exponent), NAN);
    return found;
}

/* Sum of squares of 1 - sum_k c_k x^k / Q with Q = -ln(1 - passing), k of the set `kinds` (bits). INFINITY: a c is
 * negative, or the equations do not determine them. */
static brc_status flaws_left(brc_context *context, const sieves *s, int kinds, double c[3], double *left)
{
    brc_equations e = {0};
    const int unknowns = (kinds & 1) + (kinds >> 1 & 1) + (kinds >> 2 & 1);
    bool sound = true;
    *left = INFINITY;
    brc_status status = brc_equations_create(context, s->n, unknowns, &e);
    for (int row = 0; status == BRC_OK && row < s->n; ++row) {
        const double flaws = -log1p(-s->passing[row]);
        for (int k = 0, column = 0; k < 3; ++k)
            if (kinds >> k & 1) e.a[row * unknowns + column++] = pow(s->size[row], k + 1) / flaws;
        e.b[row] = 1;
    }
    if (status == BRC_OK && brc_equations_solve(context, &e) != BRC_OK) {
        brc_context_clear(context);
        sound = false;
    }
    for (int k = 0, column = 0; status == BRC_OK && sound && k < 3; ++k) {
        c[k] = kinds >> k & 1 ? e.b[column++] : 0;
        sound = c[k] >= 0;
    }
    for (int row = 0; status == BRC_OK && sound && row < s->n; ++row) {
        const double x = s->size[row], flaws = c[0] * x + c[1] * x * x + c[2] * x * x * x;
        const double off = 1 - flaws / -log1p(-s->passing[row]);
        *left = (row ? *left : 0) + off * off;
    }
    brc_equations_free(&e);
    return status;
}

/* Gilvarry (J. Appl. Phys. 32, 1961, 391): passing = 1 - exp(-x / edge - (x / face)^2 - (x / volume)^3), from flaws
 * in edges, faces and volume; none of them negative. A kind of flaw that is absent has the size inf. */
static brc_status fit_gilvarry(brc_context *context, const sieves *s, brc_study_found *found)
{
    double least = INFINITY, best[3] = {0};
    found->n = s->n;
    for (int kinds = 1; s->n > 3 && kinds < 8; ++kinds) {
        double c[3] = {0}, left;
        BRC_TRY(flaws_left(context, s, kinds, c, &left));
        if (left < least) {
            least = left;
            for (int k = 0; k < 3; ++k)
                best[k] = c[k];
        }
    }
    if (isinf(least)) return BRC_OK;
    add(found, "edge", 1 / best[0], NAN);
    add(found, "face", 1 / sqrt(best[1]), NAN);
    add(found, "volume", 1 / cbrt(best[2]), NAN);
    return BRC_OK;
}

brc_status brc_study_fit_fragments(brc_context *context, const brc_study_pieces *pieces, const brc_study_fit *fit,
                                   brc_study_found *found)
{
    *found = (brc_study_found){0};
    if (pieces->n == 0) return BRC_OK;
    if (fit->law == BRC_STUDY_FRAGMENTS_POWER) {
        double *share = NULL;
        int n = 0;
        BRC_TRY(BRC_ALLOCATE(context, &share, pieces->n, "fragments"));
        for (int i = 0; i < pieces->n; ++i)
            if (pieces->elements[i] >= fit->elements) share[n++] = pieces->share[i];
        *found = fit_power(n, share, fit->above, fit->below);
        brc_memory_free(share);
        return BRC_OK;
    }
    const sieves s = sift(pieces, fit->elements);
    if (fit->law == BRC_STUDY_GILVARRY) return fit_gilvarry(context, &s, found);
    *found = fit->law == BRC_STUDY_SCHUHMANN ? fit_schuhmann(&s) : fit_rosin_rammler(&s);
    return BRC_OK;
}
