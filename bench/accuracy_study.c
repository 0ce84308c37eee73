/* Fronts and orders. */
#include "accuracy_study.h"
#include "../host/base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Seeds of one resolution differ by a few elements. */
#define SAME_SPACING 0.01
/* What a series is trusted to go on with: no law here is of more than second order, and a slope below a half is no
 * convergence to speak of. */
#define HIGHEST_ORDER 2.0
#define LEAST_ORDER 0.5

static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static bool same_question(const brc_accuracy_point *a, const brc_accuracy_point *b)
{
    return strcmp(a->problem, b->problem) == 0 && strcmp(a->quantity, b->quantity) == 0 && same_number(a->nu, b->nu);
}

static bool same_series(const brc_accuracy_point *a, const brc_accuracy_point *b)
{
    return same_question(a, b) && strcmp(a->model, b->model) == 0 && strcmp(a->preparation, b->preparation) == 0 &&
           strcmp(a->precision, b->precision) == 0 && strcmp(a->integrator, b->integrator) == 0 &&
           strcmp(a->variant, b->variant) == 0 && same_number(a->coordination, b->coordination) &&
           same_number(a->level, b->level) && same_number(a->dt_fraction, b->dt_fraction) &&
           same_number(a->phi, b->phi);
}

static bool usable(const brc_accuracy_point *p)
{
    return isfinite(p->error) && p->error >= 0 && isfinite(p->seconds) && p->seconds > 0;
}

static void add_point(brc_accuracy_study *s, const brc_accuracy_point *p)
{
    int32_t q = 0, r = 0;
    int64_t m = 0;
    while (q < s->n_questions && !same_question(s->questions[q].point, p))
        ++q;
    if (q == s->n_questions) s->questions[s->n_questions++].point = p;
    while (r < s->n_series && !same_series(s->series[r].point, p))
        ++r;
    if (r == s->n_series) s->series[s->n_series++] = (brc_accuracy_series){.point = p, .question = q, .order = NAN};
    while (m < s->n_means &&
           !(s->means[m].series == r && fabs(s->means[m].spacing / p->spacing_over_length - 1) < SAME_SPACING))
        ++m;
    if (m == s->n_means) {
        s->means[s->n_means++] = (brc_accuracy_mean){.point = p, .series = r, .spacing = p->spacing_over_length};
        ++s->series[r].n;
    }
    brc_accuracy_mean *mean = &s->means[m];
    ++mean->n;
    mean->error += p->error * p->error;
    mean->cost_s += p->seconds;
    mean->build_s += p->build_s;
    mean->run_s += p->run_s;
    mean->crossing_s += 1e-9 * p->ns_per_bond_update * (double)p->bonds * p->steps_per_crossing;
}

static int by_place(const void *a, const void *b)
{
    const brc_accuracy_mean *x = a, *y = b;
    if (x->series != y->series) return x->series < y->series ? -1 : 1;
    return (x->spacing < y->spacing) - (x->spacing > y->spacing);
}

static void find_order(const brc_accuracy_study *s, int32_t series, double *order)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int64_t m = 0; m < s->n_means; ++m) {
        if (s->means[m].series != series || !(s->means[m].error > 0)) continue;
        const double a = log(s->means[m].spacing), b = log(s->means[m].error);
        n += 1;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    *order = n >= 2 ? (n * xy - x * y) / (n * xx - x * x) : NAN;
}

static bool beaten(const brc_accuracy_mean *mean, const brc_accuracy_mean *other)
{
    return other->cost_s <= mean->cost_s && other->sure <= mean->sure &&
           (other->cost_s < mean->cost_s || other->sure < mean->sure);
}

brc_status brc_accuracy_study_create(brc_context *context, const brc_accuracy_points *points, brc_accuracy_study **out)
{
    brc_accuracy_study *s = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &s, 1, "study of accuracy"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->questions, points->n, "study of accuracy"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->series, points->n, "study of accuracy"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->means, points->n, "study of accuracy"));
    for (int64_t k = 0; k < points->n; ++k)
        if (usable(&points->items[k])) add_point(s, &points->items[k]);
    for (int64_t m = 0; m < s->n_means; ++m) {
        brc_accuracy_mean *mean = &s->means[m];
        mean->error = sqrt(mean->error / mean->n);
        mean->cost_s /= mean->n;
        mean->build_s /= mean->n;
        mean->run_s /= mean->n;
        mean->crossing_s /= mean->n;
    }
    if (s->n_means > 0) qsort(s->means, (size_t)s->n_means, sizeof *s->means, by_place);
    for (int64_t m = s->n_means - 1; m >= 0; --m) { /* finer ones of a series come after it */
        const bool finer = m + 1 < s->n_means && s->means[m + 1].series == s->means[m].series;
        s->means[m].sure = finer ? fmax(s->means[m].error, s->means[m + 1].sure) : s->means[m].error;
    }
    for (int32_t r = 0; r < s->n_series; ++r)
        find_order(s, r, &s->series[r].order);
    for (int64_t m = 0; m < s->n_means; ++m) {
        s->means[m].front = true;
        for (int64_t o = 0; o < s->n_means && s->means[m].front; ++o)
            s->means[m].front = s->series[s->means[o].series].question != s->series[s->means[m].series].question ||
                                !beaten(&s->means[m], &s->means[o]);
    }
    *out = s;
    s = NULL;
cleanup:
    brc_accuracy_study_free(&s);
    return status;
}

void brc_accuracy_study_free(brc_accuracy_study **study)
{
    if (!study || !*study) return;
    brc_memory_free((*study)->questions);
    brc_memory_free((*study)->series);
    brc_memory_free((*study)->means);
    brc_memory_free(*study);
    *study = NULL;
}

static bool answers(const brc_accuracy_study *s, const brc_accuracy_mean *mean, int32_t question, const char *model)
{
    const brc_accuracy_series *series = &s->series[mean->series];
    return series->question == question && (!model || strcmp(series->point->model, model) == 0);
}

int64_t brc_accuracy_cheapest(const brc_accuracy_study *s, int32_t question, const char *model, double error)
{
    int64_t best = -1;
    for (int64_t m = 0; m < s->n_means; ++m)
        if (answers(s, &s->means[m], question, model) && s->means[m].sure <= error &&
            (best < 0 || s->means[m].cost_s < s->means[best].cost_s))
            best = m;
    return best;
}

/* The mean of a model's front that is next worse than `error`: the most wrong one cheaper than every mean within it. */
static int64_t next_worse(const brc_accuracy_study *s, int32_t question, const char *model, double error)
{
    int64_t best = -1;
    for (int64_t m = 0; m < s->n_means; ++m)
        if (answers(s, &s->means[m], question, model) && s->means[m].sure > error &&
            (best < 0 || s->means[m].sure < s->means[best].sure ||
             (s->means[m].sure == s->means[best].sure && s->means[m].cost_s < s->means[best].cost_s)))
            best = m;
    return best;
}

/* Cost at `error` on the straight line in logarithms through two means. */
static double on_line(const brc_accuracy_mean *a, const brc_accuracy_mean *b, double error)
{
    const double slope = log(b->cost_s / a->cost_s) / log(b->sure / a->sure);
    return a->cost_s * pow(error / a->sure, slope);
}

double brc_accuracy_cost(const brc_accuracy_study *s, int32_t question, const char *model, double error, int *beyond)
{
    const int64_t good = brc_accuracy_cheapest(s, question, model, error);
    *beyond = 0;
    if (good < 0) {
        *beyond = -1;
        return NAN;
    }
    /* Worse means that are cheaper; the best of them begins the stretch that ends at `good`. */
    int64_t worse = -1;
    for (int64_t m = 0; m < s->n_means; ++m)
        if (answers(s, &s->means[m], question, model) && s->means[m].sure > error &&
            s->means[m].cost_s < s->means[good].cost_s && (worse < 0 || s->means[m].sure < s->means[worse].sure))
            worse = m;
    if (worse < 0) {
        *beyond = next_worse(s, question, model, error) < 0 ? 1 : 0;
        return s->means[good].cost_s;
    }
    return s->means[good].sure > 0 ? on_line(&s->means[worse], &s->means[good], error) : s->means[good].cost_s;
}

double brc_accuracy_cost_beyond(const brc_accuracy_study *s, int32_t question, const char *model, double error)
{
    const int64_t best = next_worse(s, question, model, 0);
    if (best < 0 || error >= s->means[best].sure) return NAN;
    const double order = fmin(s->series[s->means[best].series].order, HIGHEST_ORDER);
    return order >= LEAST_ORDER ? s->means[best].cost_s * pow(s->means[best].sure / error, 4 / order)
                                : NAN; /* also where there is no order */
}
