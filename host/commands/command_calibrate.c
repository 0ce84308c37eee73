/* breccia calibrate: the campaign of NAH19 section 3 and its laws. */
#include "calibrate.h"
#include "command.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Seeds of the campaign begin here, so that samples of scenes (seeds 0, 1, 2 ...) are not those the laws were fitted to. */
#define FIRST_SEED 1001

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of the results (default results/calibrate)"),
    {"resume", 'r', NULL, false, "go on with what is in the folder"},
    {"samples", 0, "N", false, "packings for each pair of coordination number and radius (default 4)"},
    {"elements", 0, "N", false, "spheres of a packing (default 10000)"},
    {"spread", 0, "PERCENT", false, "radii within this either side of their mean (default 12.5)"},
    {"coordination", 0, "LIST", false, "coordination numbers (default 5.5 to 13 by 0.5)"},
    {"radii", 0, "LIST", false, "r_m (default 0.2,0.4,0.6,0.8,1)"},
    {"fine", 0, NULL, false, "r_m from 0.1 in ten steps, for the law that breccia uses"},
    {"axes", 0, "N", false, "1: pulled along x, as in the paper (default); 3: along x, y and z"},
    {"full", 0, NULL, false, "all five E_m of the paper too, though E_m scales out"},
    {"seed", 0, "N", false, "of the first sample (default 1001)"},
    {"threads", 't', "N", false, "solves at once (default: all)"},
};

static brc_status take_list(brc_context *context, const brc_arguments *arguments, const char *name, double low, double high, int *n, double *out)
{
    char copy[512];
    const char *pieces[BRC_CALIBRATE_LIST], *text = brc_arguments_value(arguments, name);
    if (!text) return BRC_OK;
    snprintf(copy, sizeof copy, "%s", text);
    *n = strlen(text) < sizeof copy ? brc_text_split(copy, BRC_CALIBRATE_LIST, pieces) : -1;
    for (int k = 0; k < *n; ++k) {
        char *end;
        errno = 0;
        out[k] = strtod(pieces[k], &end);
        if (end == pieces[k] || *end || errno == ERANGE || !(out[k] >= low && out[k] <= high) || (k > 0 && out[k] <= out[k - 1])) *n = -1;
    }
    if (*n < 1)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia calibrate: --%s is '%s', expected at most %d numbers from %g to %g, ascending, with commas between",
                        name, text, BRC_CALIBRATE_LIST, low, high);
    return BRC_OK;
}

static brc_status make_plan(brc_context *context, const brc_arguments *arguments, brc_calibration_plan *plan)
{
    static const double papers[] = {0.2, 0.4, 0.6, 0.8, 1.0}, fine[] = {0.1, 0.14, 0.2, 0.28, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0};
    const bool is_fine = brc_arguments_value(arguments, "fine") != NULL;
    const char *spread = brc_arguments_value(arguments, "spread");
    int64_t samples, axes, seed, threads;
    *plan = (brc_calibration_plan){.radius_spread = 0.125, .n_coordinations = 16, .n_radii = is_fine ? 10 : 5, .n_youngs = 1, .young = {1}};
    for (int k = 0; k < plan->n_coordinations; ++k) plan->coordination[k] = 5.5 + 0.5 * k;
    for (int k = 0; k < plan->n_radii; ++k) plan->radius[k] = is_fine ? fine[k] : papers[k];
    if (brc_arguments_value(arguments, "full"))
        for (plan->n_youngs = 0; plan->n_youngs < 5; ++plan->n_youngs) plan->young[plan->n_youngs] = 500e9 * (plan->n_youngs + 1);
    BRC_TRY(take_list(context, arguments, "coordination", 4, 20, &plan->n_coordinations, plan->coordination));
    BRC_TRY(take_list(context, arguments, "radii", 0.01, 2, &plan->n_radii, plan->radius));
    BRC_TRY(brc_arguments_integer(context, arguments, "samples", 1, 1000, 4, &samples));
    BRC_TRY(brc_arguments_integer(context, arguments, "axes", 1, 3, 1, &axes));
    BRC_TRY(brc_arguments_integer(context, arguments, "elements", 100, 10000000, 10000, &plan->n_elements));
    BRC_TRY(brc_arguments_integer(context, arguments, "seed", 0, INT64_MAX - 1000, FIRST_SEED, &seed));
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 1, 4096, omp_get_max_threads(), &threads));
    plan->n_samples = (int)samples;
    plan->n_axes = (int)axes;
    plan->seed = (uint64_t)seed;
    plan->n_threads = (int)threads;
    if (spread) {
        char *end;
        const double value = strtod(spread, &end);
        if (end == spread || *end || !(value >= 0 && value <= 90))
            return BRC_FAIL(context, BRC_BAD_INPUT, "breccia calibrate: --spread is '%s', expected percent from 0 to 90", spread);
        plan->radius_spread = value / 100;
    }
    return BRC_OK;
}

static void print_quality(const brc_calibration_fit *fit)
{
    printf("%-14s %-6s %9s %10s %10s %14s %12s\n", "form", "", "R2", "worst", "rms", "worst of means", "rms of means");
    for (int form = 0; form < BRC_FORMS; ++form)
        for (int q = 0; fit->made[form] && q < BRC_QUANTITIES; ++q) {
            const brc_fit_quality *f = &fit->quality[form][q];
            printf("%-14s %-6s %9.6f %8.2f %% %8.2f %% %12.2f %% %10.2f %%\n", brc_calibration_form(form), brc_calibration_quantity(q), f->r2,
                   100 * f->worst, 100 * f->rms, 100 * f->mean_worst, 100 * f->mean_rms);
        }
}

static void print_scatter(const brc_calibration_mean *means, int64_t n)
{
    double mean[BRC_QUANTITIES] = {0}, most[BRC_QUANTITIES] = {0};
    for (int64_t k = 0; k < n; ++k)
        for (int q = 0; q < BRC_QUANTITIES; ++q) {
            mean[q] += means[k].scatter[q] / (double)n;
            most[q] = fmax(most[q], means[k].scatter[q]);
        }
    printf("samples and axes scatter (standard deviation over mean): nu %.2f %% on average, at most %.2f %%; E %.2f %%, at most %.2f %%\n",
           100 * mean[BRC_QUANTITY_NU], 100 * most[BRC_QUANTITY_NU], 100 * mean[BRC_QUANTITY_E], 100 * most[BRC_QUANTITY_E]);
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    const char *out = brc_arguments_value(arguments, "output"), *folder = out ? out : "results/calibrate";
    brc_calibration_plan plan;
    brc_calibration_rows rows;
    brc_calibration_fit fit;
    brc_calibration_mean *means = NULL;
    int64_t n_means;
    brc_status status = BRC_OK;
    const double start = brc_clock_s();
    BRC_TRY(make_plan(context, arguments, &plan));
    BRC_TRY(brc_calibrate_campaign(context, &plan, folder, brc_arguments_value(arguments, "resume") != NULL, &rows));
    const double solved = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_calibrate_fit(context, &plan, &rows, &fit));
    BRC_TRY_OR(cleanup, brc_calibrate_report(context, &plan, &rows, &fit, folder));
    BRC_TRY_OR(cleanup, brc_calibrate_figures(context, &plan, &rows, &fit, folder));
    BRC_TRY_OR(cleanup, brc_calibration_means(context, &rows, &n_means, &means));
    print_quality(&fit);
    if (plan.n_samples * plan.n_axes > 1) print_scatter(means, n_means);
    if (!fit.made[BRC_FORM_TWO_STAGE]) printf("eq. 17 to 20 of the paper need at least 4 radii and 5 coordination numbers: not fitted\n");
    printf("%lld solves in %.1f s, fits in %.1f s; %s/laws.json\n", (long long)rows.n, solved - start, brc_clock_s() - solved, folder);
cleanup:
    brc_memory_free(means);
    brc_calibration_rows_free(&rows);
    return status;
}

const brc_command brc_command_calibrate = {.name = "calibrate",
                                           .operands = "",
                                           .least = 0,
                                           .most = 0,
                                           .summary = "elastic tests of beam samples and the laws fitted to them",
                                           .details = "The campaign of Nguyen, Andre and Huger 2019, Table 2: cubes of packed spheres pulled along x. Every solve is kept at\n"
                                                      "once in DIR/solves.csv; --resume goes on after a stop. law.h is the law that breccia is built with.",
                                           .options = options,
                                           .n_options = sizeof options / sizeof *options,
                                           .run = run};
