/* Rows that follow from several runs: means, orders of convergence, differences of states. */
#include "reproduce.h"
#include <math.h>
#include <string.h>

static const brc_outcome *outcome_of(const brc_campaign *campaign, const char *name)
{
    for (int k = 0; k < campaign->what->n_runs; ++k)
        if (strcmp(campaign->what->runs[k].name, name) == 0) return &campaign->outcomes[k];
    return NULL; /* brc_case_read has checked the names */
}

/* Slope of log y against log x by least squares. */
static double slope(int n, const double *x, const double *y)
{
    double mean_x = 0, mean_y = 0, above = 0, below = 0;
    for (int k = 0; k < n; ++k) {
        mean_x += log(x[k]) / n;
        mean_y += log(y[k]) / n;
    }
    for (int k = 0; k < n; ++k) {
        above += (log(x[k]) - mean_x) * (log(y[k]) - mean_y);
        below += (log(x[k]) - mean_x) * (log(x[k]) - mean_x);
    }
    return above / below;
}

/* Where y first passes zero along x, linear between neighbours in the order given. */
static double crossing(int n, const double *x, const double *y)
{
    for (int k = 0; k + 1 < n; ++k)
        if ((y[k] > 0) != (y[k + 1] > 0)) return x[k] + (x[k + 1] - x[k]) * y[k] / (y[k] - y[k + 1]);
    return NAN;
}

/* The mean of the first half of the values over that of the second, as magnitudes; NAN of an odd number of them. */
static double ratio(int n, const double *value)
{
    double first = 0, second = 0;
    for (int k = 0; k < n / 2; ++k) {
        first += value[k];
        second += value[n / 2 + k];
    }
    return n % 2 == 0 && second != 0 ? fabs(first / second) : NAN;
}

static double difference(const brc_outcome *a, const brc_outcome *b)
{
    if (!a->displacement || !b->displacement || a->n_elements != b->n_elements) return NAN;
    double largest = 0, apart = 0;
    for (int64_t k = 0; k < 3 * a->n_elements; ++k) {
        largest = fmax(largest, fabs(a->displacement[k]));
        apart = fmax(apart, fabs(a->displacement[k] - b->displacement[k]));
    }
    return largest > 0 ? apart / largest : NAN;
}

double brc_derived_value(const brc_campaign *campaign, const brc_case_derived *derived, char *note, size_t size)
{
    double x[BRC_CASE_LIST], y[BRC_CASE_LIST], above[BRC_CASE_LIST], sum = 0, worst = 0, low = INFINITY,
                                                                     high = -INFINITY;
    const brc_outcome *outcomes[BRC_CASE_LIST];
    note[0] = '\0';
    for (int k = 0; k < derived->n_runs; ++k) {
        const brc_outcome *outcome = outcomes[k] = outcome_of(campaign, derived->runs[k]);
        if (!outcome || !outcome->done) {
            snprintf(note, size, "%s%s", outcome && outcome->skipped ? "skipped: " : "",
                     outcome ? outcome->note : "no run");
            return NAN;
        }
        if (derived->formula == BRC_CASE_DIFFERENCE) continue;
        const brc_case_value *value = brc_outcome_find(outcome, derived->of);
        const brc_case_value *against = brc_outcome_find(outcome, derived->against);
        if (!value || isnan(value->value)) {
            snprintf(note, size, "run %s has no %s", derived->runs[k], derived->of);
            return NAN;
        }
        const double label = brc_outcome_label(outcome, derived->against);
        above[k] = value->value - derived->origin;
        y[k] = fabs(above[k]);
        x[k] = against ? against->value : !isnan(label) ? label : 1 / cbrt((double)outcome->n_elements);
        sum += value->value;
        worst = fmax(worst, fabs(value->value));
        low = fmin(low, value->value);
        high = fmax(high, value->value);
    }
    switch (derived->formula) {
    case BRC_CASE_MEAN: return sum / derived->n_runs; /* nine of ten are 0.9, not less */
    case BRC_CASE_WORST: return worst;
    case BRC_CASE_ORDER: return slope(derived->n_runs, x, y);
    case BRC_CASE_RANGE: return (high - low) / fabs(sum / derived->n_runs);
    case BRC_CASE_RATIO: return ratio(derived->n_runs, above);
    case BRC_CASE_CROSSING: return crossing(derived->n_runs, x, above);
    case BRC_CASE_DIFFERENCE: return derived->n_runs == 2 ? difference(outcomes[0], outcomes[1]) : NAN;
    }
    return NAN;
}
