/* Sizes of the pieces a body broke into, over runs at several speeds. */
#include "operators.h"
#include "reproduce_fragments.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include "../../output/pictures/gnuplot.h"
#include "../../solver/effects/fracture/fracture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZES = 22 };
static const double least_cells = 2.5, most_share = 0.05; /* of the exponent: fragments of three cells and more; beyond,
                                                             few large ones stand for themselves */

static double size_at(int k)
{
    return pow(10, -k / 6.0);
}
static void size_name(char out[BRC_NAME], int k)
{
    snprintf(out, BRC_NAME, "heavier_%02d", k);
}

/* Mean and variance of x = ln(m / low) when m^-tau: the density of x is exp(a x) between 0 and L, a = 1 - tau. */
static double mean_log(double a, double L)
{
    const double z = a * L;
    if (fabs(z) < 1e-3) return L * (0.5 + z / 12);
    return L / -expm1(-z) - 1 / a;
}
static double variance_log(double a, double L)
{
    const double z = a * L;
    if (fabs(z) < 1e-2) return L * L / 12;
    const double s = 2 * sinh(0.5 * z);
    return 1 / (a * a) - L * L / (s * s);
}

double brc_fragments_exponent(int64_t n, const double *mass, double low, double high, int64_t *n_inside, double *error)
{
    const double L = log(high / low);
    double sum = 0, first = NAN;
    bool differ = false;
    *n_inside = 0;
    *error = NAN;
    for (int64_t k = 0; k < n; ++k) {
        if (!(mass[k] >= low && mass[k] <= high)) continue;
        if (*n_inside > 0 && mass[k] != first) differ = true;
        first = mass[k];
        sum += log(mass[k] / low);
        *n_inside += 1;
    }
    if (*n_inside < 2 || !differ) return NAN;
    const double mean = sum / (double)*n_inside;
    double least = -60 / L, most = 60 / L; /* the mean grows with a */
    for (int round = 0; round < 200; ++round) {
        const double a = 0.5 * (least + most);
        if (mean_log(a, L) < mean)
            least = a;
        else
            most = a;
    }
    const double a = 0.5 * (least + most);
    *error = 1 / sqrt((double)*n_inside * variance_log(a, L));
    return 1 - a;
}

static brc_status finished(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    const brc_domain *d = brc_simulation_domain(simulation);
    int32_t *fragment = NULL;
    double *volume = NULL, all = 0, error;
    int64_t n, n_inside, n_broken;
    brc_status status = BRC_OK;
    if (!brc_simulation_has_fracture(simulation))
        return BRC_FAIL(context, BRC_BAD_INPUT, "run %s: `with: fragments` expects a scene with `fracture`",
                        outcome->run->name);
    BRC_TRY(brc_simulation_broken(simulation, &n_broken));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &fragment, d->n_elements, "fragments"));
    BRC_TRY_OR(cleanup, brc_simulation_fragments(simulation, fragment, &n));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &volume, n, "fragments"));
    for (int64_t e = 0; e < d->n_elements; ++e) {
        volume[fragment[e]] += d->volume[e];
        all += d->volume[e];
    }
    const double tau = brc_fragments_exponent(n, volume, least_cells * all / (double)d->n_elements, most_share * all,
                                              &n_inside, &error);
    brc_outcome_add(outcome, "damage", "-", (double)n_broken / (double)d->n_bonds, NAN);
    brc_outcome_add(outcome, "mass_exponent", "-", tau, NAN);
    brc_outcome_add(outcome, "exponent_error", "-", error, NAN);
    brc_outcome_add(outcome, "pieces", "-", (double)n_inside, NAN);
    for (int k = 0; k < SIZES; ++k) {
        char name[BRC_NAME];
        int64_t heavier = 0;
        for (int64_t f = 0; f < n; ++f)
            heavier += volume[f] >= size_at(k) * all * (1 - 1e-12);
        size_name(name, k);
        brc_outcome_add(outcome, name, "-", (double)heavier, NAN);
    }
cleanup:
    brc_memory_free(fragment);
    brc_memory_free(volume);
    return status;
}

/* ---- the figure ---- */

static bool is_shown(const brc_outcome *outcome)
{
    return outcome->done && outcome->run->operator== & brc_operator_fragments;
}

/* A body that is whole has no distribution. */
static bool is_broken(const brc_outcome *outcome)
{
    const brc_case_value *largest = brc_outcome_find(outcome, "largest_fragment");
    return is_shown(outcome) && largest && largest->value < 0.9;
}

static double value_of(const brc_outcome *outcome, const char *name)
{
    const brc_case_value *value = brc_outcome_find(outcome, name);
    return value ? value->value : NAN;
}
static double scatter_of(const brc_outcome *outcome, const char *name)
{
    const brc_case_value *value = brc_outcome_find(outcome, name);
    return value && isfinite(value->scatter) ? value->scatter : 0;
}

/* $speeds: speed, damage, its scatter, largest fragment, its scatter; $sizeN: share of the whole, fragments at least as
 * heavy. */
static void add_data(const brc_campaign *campaign, brc_text *text)
{
    double before = -INFINITY;
    brc_text_add(text, "$speeds << END\n");
    for (int r = 0; r < campaign->what->n_runs; ++r) {
        const brc_outcome *outcome = &campaign->outcomes[r];
        const double speed = brc_outcome_label(outcome, "speed");
        if (!is_shown(outcome)) continue;
        brc_text_add(text, "%s%.8g %.8g %.8g %.8g %.8g\n", speed < before ? "\n" : "" /* another series */, speed,
                     value_of(outcome, "damage"), scatter_of(outcome, "damage"), value_of(outcome, "largest_fragment"),
                     scatter_of(outcome, "largest_fragment"));
        before = speed;
    }
    brc_text_add(text, "END\n");
    for (int r = 0; r < campaign->what->n_runs; ++r) {
        if (!is_broken(&campaign->outcomes[r])) continue;
        brc_text_add(text, "$size%d << END\n", r);
        for (int k = 0; k < SIZES; ++k) {
            char name[BRC_NAME];
            size_name(name, k);
            brc_text_add(text, "%.8g %.8g\n", size_at(k), value_of(&campaign->outcomes[r], name));
        }
        brc_text_add(text, "END\n");
    }
}

static void draw(const void *self, brc_text *text)
{
    const brc_campaign *campaign = self;
    const char *comma = "";
    add_data(campaign, text);
    brc_text_add(
        text,
        "set multiplot layout 1,2\nset xlabel 'speed [m/s]'\nset logscale x 2\nset yrange [0:1]\nset key top right\n"
        "plot $speeds using 1:2:3 with yerrorlines pointtype 7 linecolor rgb '#cc6677' title 'broken bonds', "
        "$speeds using 1:4:5 with yerrorlines pointtype 5 linecolor rgb '#4477aa' title 'largest fragment'\n"
        "set xlabel 'mass / mass of the whole'\nset ylabel 'fragments at least as heavy'\nunset logscale x\nset "
        "logscale xy 10\nset xrange [*:1]\nset yrange [0.3:*]\nset key bottom left\nplot ");
    for (int r = 0; r < campaign->what->n_runs; ++r) {
        if (!is_broken(&campaign->outcomes[r])) continue;
        brc_text_add(text, "%s$size%d using 1:2 with linespoints pointtype 7 pointsize 0.6 title '%s'", comma, r,
                     campaign->outcomes[r].run->name);
        comma = ", ";
    }
    brc_text_add(text, "\nunset multiplot\n");
}

static brc_status figure(brc_campaign *campaign)
{
    brc_context *context = campaign->session->context;
    int n = 0;
    for (int r = 0; r < campaign->what->n_runs; ++r)
        n += is_shown(&campaign->outcomes[r]);
    if (n == 0) return BRC_OK;
    brc_text data = {.context = context};
    char *path = NULL;
    bool made;
    brc_status status = BRC_OK;
    add_data(campaign, &data);
    BRC_TRY_OR(cleanup, brc_file_join(context, campaign->folder, "fragments.dat", &path));
    BRC_TRY_OR(cleanup, brc_text_write(&data, path));
    const brc_gnuplot_figure figure = {.folder = campaign->folder,
                                       .name = "fragments.png",
                                       .numbers = "fragments.dat",
                                       .width = 1200,
                                       .height = 520,
                                       .draw = draw,
                                       .self = campaign};
    status = brc_gnuplot_make(context, &figure, &made);
cleanup:
    brc_text_free(&data);
    brc_memory_free(path);
    return status;
}

/* The fragments operator, at the end of a run: damage (share of the bonds that broke), mass_exponent (tau where the
 * number of fragments of a mass m falls as m^-tau, most likely one between 2.5 mean cells and a twentieth of the
 * whole), exponent_error (standard error of that), pieces (fragments in that range), and heavier_KK, how many
 * fragments have at least 10^(-KK/6) of the whole. fragments.png and its numbers, fragments.dat, into the campaign's
 * folder, where such runs were made: damage and largest fragment against the label `speed`, and the distributions. */
const brc_operator brc_operator_fragments = {.name = "fragments", .finished = finished, .figure = figure};
