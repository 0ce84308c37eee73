/* breccia calibrate: the campaigns of NAH19 section 3 and their laws. */
#include "calibrate/calibrate.h"
#include "command.h"
#include "calibrate/strength_campaign.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/version.h"
#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Seeds of the campaign begin here, so that samples of scenes (seeds 0, 1, 2 ...) are not those the laws were fitted
 * to. */
#define FIRST_SEED 1001

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of the results (default results/calibrate)"),
    {"what", 0, "elastic|fracture|all", false, "which tests (default all)"},
    {"resume", 'r', NULL, false, "go on with what is in the folder"},
    {"samples", 0, "N", false, "packings for each pair of coordination number and radius (default 4)"},
    {"elements", 0, "N", false, "spheres of a packing (default 10000)"},
    {"spread", 0, "PERCENT", false, "radii within this either side of their mean (default 12.5)"},
    {"coordination", 0, "LIST", false, "coordination numbers (default 5.5 to 13 by 0.5; fracture 6 to 13 by 1)"},
    {"radii", 0, "LIST", false, "r_m (default 0.2,0.4,0.6,0.8,1)"},
    {"fine", 0, NULL, false,
     "r_m from 0.1 in ten steps (fracture: 0.14 too, and cn 5.5), for the laws that breccia uses"},
    {"axes", 0, "N", false, "1: pulled along x, as in the paper (default); 3: along x, y and z"},
    {"full", 0, NULL, false, "all E_m and sigma_m of the paper too, though they scale out: 1600 and 6400 tests"},
    {"passages", 0, "N", false, "fracture: passages of a wave from no load to the expected strength (default 30)"},
    {"seed", 0, "N", false, "of the first sample (default 1001)"},
    {"threads", 't', "N", false, "solves at once (default: all)"},
};

static brc_status take_list(brc_context *context, const brc_arguments *arguments, const char *name, double low,
                            double high, int *n, double *out)
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
        if (end == pieces[k] || *end || errno == ERANGE || !(out[k] >= low && out[k] <= high) ||
            (k > 0 && out[k] <= out[k - 1]))
            *n = -1;
    }
    if (*n < 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia calibrate: --%s is '%s', expected at most %d numbers from %g to %g, ascending, with "
                        "commas between",
                        name, text, BRC_CALIBRATE_LIST, low, high);
    return BRC_OK;
}

static brc_status make_plan(brc_context *context, const brc_arguments *arguments, brc_calibration_plan *plan)
{
    static const double papers[] = {0.2, 0.4, 0.6, 0.8, 1.0},
                        fine[] = {0.1, 0.14, 0.2, 0.28, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0};
    const bool is_fine = brc_arguments_value(arguments, "fine") != NULL;
    const char *spread = brc_arguments_value(arguments, "spread");
    int64_t samples, axes, seed, threads;
    *plan = (brc_calibration_plan){
        .radius_spread = 0.125, .n_coordinations = 16, .n_radii = is_fine ? 10 : 5, .n_youngs = 1, .young = {1}};
    for (int k = 0; k < plan->n_coordinations; ++k)
        plan->coordination[k] = 5.5 + 0.5 * k;
    for (int k = 0; k < plan->n_radii; ++k)
        plan->radius[k] = is_fine ? fine[k] : papers[k];
    if (brc_arguments_value(arguments, "full"))
        for (plan->n_youngs = 0; plan->n_youngs < 5; ++plan->n_youngs)
            plan->young[plan->n_youngs] = 500e9 * (plan->n_youngs + 1);
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
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "breccia calibrate: --spread is '%s', expected percent from 0 to 90", spread);
        plan->radius_spread = value / 100;
    }
    return BRC_OK;
}

/* The same for fracture tests, where the paper's Table 3 differs from its Table 2. E_m and sigma_m that stand for all
 * of them are the pair of the smallest strain there, so that k is that of the linear limit. */
static brc_status make_strength_plan(brc_context *context, const brc_arguments *arguments,
                                     const brc_calibration_plan *elastic, brc_strength_plan *plan)
{
    static const double fine[] = {0.14, 0.2, 0.4, 0.6, 0.8, 1.0}, limits[] = {2, 4, 6, 8, 50, 100, 300, 500, 700, 1000};
    const bool is_fine = brc_arguments_value(arguments, "fine") != NULL,
               is_full = brc_arguments_value(arguments, "full") != NULL;
    int64_t passages;
    *plan = (brc_strength_plan){.samples = *elastic, .n_limits = 1, .limit = {2e6}};
    brc_calibration_plan *s = &plan->samples;
    s->n_youngs = 1;
    s->young[0] = 2000e9;
    if (is_full) {
        for (s->n_youngs = 0; s->n_youngs < 4; ++s->n_youngs)
            s->young[s->n_youngs] = 500e9 * (s->n_youngs + 1);
        for (plan->n_limits = 0; plan->n_limits < 10; ++plan->n_limits)
            plan->limit[plan->n_limits] = 1e6 * limits[plan->n_limits];
    }
    if (!brc_arguments_value(arguments, "coordination")) {
        s->n_coordinations = 0;
        if (is_fine) s->coordination[s->n_coordinations++] = 5.5;
        for (int k = 6; k <= 13; ++k)
            s->coordination[s->n_coordinations++] = k;
    }
    if (is_fine && !brc_arguments_value(arguments, "radii")) {
        s->n_radii = sizeof fine / sizeof *fine;
        memcpy(s->radius, fine, sizeof fine);
    }
    BRC_TRY(brc_arguments_integer(context, arguments, "passages", 1, 10000, 30, &passages));
    plan->passages = (double)passages;
    return BRC_OK;
}

static void print_quality(const brc_calibration_fit *fit)
{
    printf("%-14s %-6s %9s %10s %10s %14s %12s\n", "form", "", "R2", "worst", "rms", "worst of means", "rms of means");
    for (int form = 0; form < BRC_FORMS; ++form)
        for (int q = 0; fit->made[form] && q < BRC_QUANTITIES; ++q) {
            const brc_fit_quality *f = &fit->quality[form][q];
            printf("%-14s %-6s %9.6f %8.2f %% %8.2f %% %12.2f %% %10.2f %%\n", brc_calibration_form(form),
                   brc_calibration_quantity(q), f->r2, 100 * f->worst, 100 * f->rms, 100 * f->mean_worst,
                   100 * f->mean_rms);
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
    printf("samples and axes scatter (standard deviation over mean): nu %.2f %% on average, at most %.2f %%; E %.2f "
           "%%, at most %.2f %%\n",
           100 * mean[BRC_QUANTITY_NU], 100 * most[BRC_QUANTITY_NU], 100 * mean[BRC_QUANTITY_E],
           100 * most[BRC_QUANTITY_E]);
}

static brc_status run_elastic(brc_context *context, const brc_calibration_plan *plan, const char *folder, bool resume)
{
    brc_calibration_rows rows;
    brc_calibration_fit fit;
    brc_calibration_mean *means = NULL;
    int64_t n_means;
    brc_status status = BRC_OK;
    const double start = brc_clock_s();
    BRC_TRY(brc_calibrate_campaign(context, plan, folder, resume, &rows));
    const double solved = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_calibrate_fit(context, plan, &rows, &fit));
    BRC_TRY_OR(cleanup, brc_calibrate_report(context, plan, &rows, &fit, folder));
    BRC_TRY_OR(cleanup, brc_calibrate_figures(context, plan, &rows, &fit, folder));
    BRC_TRY_OR(cleanup, brc_calibration_means(context, &rows, &n_means, &means));
    print_quality(&fit);
    if (plan->n_samples * plan->n_axes > 1) print_scatter(means, n_means);
    if (!fit.made[BRC_FORM_TWO_STAGE])
        printf("eq. 17 to 20 of the paper need at least 4 radii and 5 coordination numbers: not fitted\n");
    printf("%lld solves in %.1f s, fits in %.1f s; %s/laws.json\n", (long long)rows.n, solved - start,
           brc_clock_s() - solved, folder);
cleanup:
    brc_memory_free(means);
    brc_calibration_rows_free(&rows);
    return status;
}

static void print_strength(const brc_strength_fit *fit, const brc_strength_mean *means, int64_t n)
{
    double mean = 0, most = 0;
    printf("%-18s %6s %9s %10s %10s %14s %12s\n", "k, form", "tests", "R2", "worst", "rms", "worst of means",
           "rms of means");
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form) {
        const brc_fit_quality *f = &fit->quality[form];
        if (fit->made[form])
            printf("%-18s %6lld %9.6f %8.2f %% %8.2f %% %12.2f %% %10.2f %%\n", brc_strength_form(form),
                   (long long)f->n, f->r2, 100 * f->worst, 100 * f->rms, 100 * f->mean_worst, 100 * f->mean_rms);
    }
    for (int64_t k = 0; k < n; ++k) {
        mean += means[k].scatter / (double)n;
        most = fmax(most, means[k].scatter);
    }
    if (isfinite(mean))
        printf("samples scatter (standard deviation over mean): k %.2f %% on average, at most %.2f %%\n", 100 * mean,
               100 * most);
}

static brc_status run_fracture(brc_context *context, const brc_strength_plan *plan, const char *folder, bool resume)
{
    brc_strength_rows rows = {0};
    brc_strength_fit fit;
    brc_strength_mean *means = NULL;
    int64_t n_means;
    char *inside;
    brc_status status = BRC_OK;
    const double start = brc_clock_s();
    BRC_TRY(brc_file_join(context, folder, "strength", &inside));
    BRC_TRY_OR(cleanup, brc_strength_campaign(context, plan, inside, resume, &rows));
    const double tested = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_strength_fit_make(context, plan, &rows, &fit));
    BRC_TRY_OR(cleanup, brc_strength_report(context, plan, &rows, &fit, inside));
    BRC_TRY_OR(cleanup, brc_strength_figures(context, plan, &rows, &fit, inside));
    BRC_TRY_OR(cleanup, brc_strength_means(context, &fit, &rows, &n_means, &means));
    print_strength(&fit, means, n_means);
    printf("%lld tests in %.1f s, fits in %.1f s; %s/laws.json\n", (long long)rows.n, tested - start,
           brc_clock_s() - tested, inside);
cleanup:
    brc_memory_free(means);
    brc_memory_free(inside);
    brc_strength_rows_free(&rows);
    return status;
}

/* Laws say which commit made them; a program that does not know should be seen before hours of tests, not after. */
static void warn_of_unknown_commit(brc_context *context)
{
    const char *commit = brc_version_commit();
    if (strcmp(commit, "unknown") == 0 || strchr(commit, '-'))
        brc_log(context, BRC_LOG_WARNING,
                "calibrate: laws.json will name the commit '%s' as what made the laws; for laws that are kept, build "
                "from a clone of the repository without changes",
                commit);
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    const char *out = brc_arguments_value(arguments, "output"), *folder = out ? out : "results/calibrate",
               *given = brc_arguments_value(arguments, "what");
    const char *what = given ? given : "all";
    const bool resume = brc_arguments_value(arguments, "resume") != NULL, all = strcmp(what, "all") == 0;
    const bool elastic = all || strcmp(what, "elastic") == 0, fracture = all || strcmp(what, "fracture") == 0;
    brc_calibration_plan plan;
    brc_strength_plan strength;
    if (!elastic && !fracture)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia calibrate: --what is '%s', expected elastic, fracture or all",
                        what);
    BRC_TRY(make_plan(context, arguments, &plan));
    BRC_TRY(make_strength_plan(context, arguments, &plan, &strength));
    warn_of_unknown_commit(context);
    if (elastic) BRC_TRY(run_elastic(context, &plan, folder, resume));
    return fracture ? run_fracture(context, &strength, folder, resume) : BRC_OK;
}

const brc_command brc_command_calibrate = {
    .name = "calibrate",
    .operands = "",
    .least = 0,
    .most = 0,
    .summary = "elastic and fracture tests of beam samples and the laws fitted to them",
    .details = "The campaigns of Nguyen, Andre and Huger 2019: cubes of packed spheres pulled along x, elastic (Table "
               "2: 320 solves) and to failure\n"
               "(Table 3: 160 tests). Every result is kept at once in DIR/solves.csv and DIR/strength/tests.csv; "
               "--resume goes on after a\n"
               "stop. law.h and strength/law.h are the laws that breccia is built with.",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
