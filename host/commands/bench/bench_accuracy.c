/* Runs of sweeps, one after another, each a point. */
#include "bench_accuracy.h"
#include "../price/pace.h"
#include "sweep.h"
#include "../../../bench/accuracy_report.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Wave crossings in the price of a run that is itself no dynamics. */
#define CROSSINGS 100

enum { PROBLEMS_MOST = 32 };

static double value_of(const brc_outcome *outcome, const char *name)
{
    const brc_case_value *value = brc_outcome_find(outcome, name);
    return value ? value->value : NAN;
}

/* The number of an axis; `otherwise` where the run has none. */
static double number_of(const brc_case_run *run, const char *axis, double otherwise)
{
    const char *text = brc_sweep_value(run, axis);
    return text ? strtod(text, NULL) : otherwise;
}

static const char *text_of(const brc_case_run *run, const char *axis, const char *otherwise)
{
    const char *text = brc_sweep_value(run, axis);
    return text ? text : otherwise;
}

/* Axes that are no columns of a point. */
static void add_variant(const brc_case_run *run, char *out, size_t size)
{
    static const char *const known[] = {"elements", "nu",          "model", "preparation", "precision", "coordination",
                                        "level",    "dt_fraction", "phi",   "integrator",  "seed"};
    for (int k = 0; k < run->n_labels; ++k) {
        size_t i = 0;
        while (i < sizeof known / sizeof *known && strcmp(known[i], run->labels[k].key) != 0)
            ++i;
        const size_t used = strlen(out);
        if (i == sizeof known / sizeof *known)
            snprintf(out + used, size - used, "%s%s %s", used ? "; " : "", run->labels[k].key, run->labels[k].value);
    }
}

/* The quantity of a run; a $ in it stands for its neighbour level. */
static void name_quantity(const brc_sweep *sweep, const brc_case_run *run, char *out, size_t size)
{
    const char *mark = strchr(sweep->quantity, '$');
    if (mark)
        snprintf(out, size, "%.*s%s%s", (int)(mark - sweep->quantity), sweep->quantity, text_of(run, "level", ""),
                 mark + 1);
    else
        snprintf(out, size, "%s", sweep->quantity);
}

static void fill_point(const brc_sweep *sweep, int k, const brc_outcome *outcome, const brc_device_request *device,
                       brc_accuracy_point *p)
{
    const brc_case_run *run = &sweep->what.runs[k];
    *p = brc_accuracy_point_empty();
    char quantity[BRC_NAME];
    name_quantity(sweep, run, quantity, sizeof quantity);
    const brc_case_value *value = brc_outcome_find(outcome, quantity);
    snprintf(p->quantity, sizeof p->quantity, "%s", sweep->quantity); /* levels answer one question */
    snprintf(p->problem, sizeof p->problem, "%s", sweep->problem);
    snprintf(p->run, sizeof p->run, "%s", run->name);
    snprintf(p->sweep, sizeof p->sweep, "%s", sweep->sweep_of[k]);
    snprintf(p->model, sizeof p->model, "%s", text_of(run, "model", "dlsm"));
    snprintf(p->preparation, sizeof p->preparation, "%s", text_of(run, "preparation", ""));
    snprintf(p->precision, sizeof p->precision, "%s", brc_precision_name(outcome->precision));
    snprintf(p->integrator, sizeof p->integrator, "%s", text_of(run, "integrator", ""));
    add_variant(run, p->variant, sizeof p->variant);
    snprintf(p->clock, sizeof p->clock, "%s", brc_pace_clock_name(device));
    snprintf(p->note, sizeof p->note, "%.*s", (int)sizeof p->note - 1, outcome->note);
    p->nu = number_of(run, "nu", NAN);
    p->coordination = number_of(run, "coordination", NAN);
    p->level = number_of(run, "level", NAN);
    p->dt_fraction = number_of(run, "dt_fraction", 0.8);
    p->phi = number_of(run, "phi", NAN);
    p->seed = (int64_t)number_of(run, "seed", 0);
    p->threads = device->n_threads;
    p->host_bytes = value_of(outcome, "host_bytes");
    p->elements = outcome->n_elements;
    p->bonds = outcome->n_bonds;
    p->steps = outcome->steps;
    p->iterations = (int64_t)fmax(value_of(outcome, "iterations"), 0);
    p->wall_s = outcome->seconds;
    const bool processor = strcmp(p->clock, "processor") == 0;
    p->build_s = value_of(outcome, processor ? "build_processor_seconds" : "build_seconds");
    p->run_s = processor ? value_of(outcome, "run_processor_seconds") : outcome->seconds - p->build_s;
    p->spacing_over_length = value_of(outcome, "pace_spacing");
    p->ns_per_bond_update = 1e9 * value_of(outcome, "pace_bond_update");
    p->bonds_per_element = outcome->n_elements > 0 ? (double)outcome->n_bonds / (double)outcome->n_elements : NAN;
    p->steps_per_crossing = value_of(outcome, "pace_crossing") / value_of(outcome, "pace_step");
    p->bytes_per_element = value_of(outcome, "bytes_per_element");
    p->closure = value_of(outcome, "closure");
    if (sweep->cost == BRC_SWEEP_COST_CROSSINGS) {
        snprintf(p->cost_of, sizeof p->cost_of, "building and %d crossings", CROSSINGS);
        p->seconds = p->build_s + CROSSINGS * 1e-9 * p->ns_per_bond_update * (double)p->bonds * p->steps_per_crossing;
    } else {
        snprintf(p->cost_of, sizeof p->cost_of, "building and running");
        p->seconds = p->build_s + p->run_s;
    }
    if (!outcome->done || !value || isnan(value->value)) {
        if (!p->note[0]) snprintf(p->note, sizeof p->note, "the run gives no %s", quantity);
        return;
    }
    p->reference = !isnan(sweep->reference_of[k]) ? sweep->reference_of[k] : value->reference;
    p->ours = value->value;
    p->error = p->reference == 0 ? fabs(p->ours) : fabs(p->ours / p->reference - 1);
}

static void print_point(const brc_accuracy_point *p)
{
    char what[256], nu[32] = "";
    if (!isnan(p->nu)) snprintf(nu, sizeof nu, "nu %g", p->nu);
    printf("%-12s %-8s %-60s ", p->problem, nu, brc_accuracy_describe(p, true, what, sizeof what));
    if (isnan(p->error))
        printf("%.80s\n", p->note);
    else
        printf("error %9.3e  build %8.3g s  run %8.3g s  cost %8.3g s  %6.1f M/s\n", p->error, p->build_s, p->run_s,
               p->seconds, 1e3 / p->ns_per_bond_update);
    fflush(stdout);
}

static brc_status in_folder(const brc_accuracy_points *points, const char *folder, const char *name,
                            brc_status (*use)(const brc_accuracy_points *, const char *))
{
    char *path;
    BRC_TRY(brc_file_join(points->context, folder, name, &path));
    const brc_status status = use(points, path);
    brc_memory_free(path);
    return status;
}

/* Every run of one problem that is wanted and not there yet. */
static brc_status carry_out(const brc_session *session, const brc_accuracy_request *request, const char *problem,
                            brc_accuracy_points *points)
{
    brc_context *context = session->context;
    brc_sweep *sweep;
    char *folder = NULL;
    BRC_TRY(brc_sweep_read(context, request->folder, problem, &sweep));
    brc_status status = brc_file_join(context, request->output, problem, &folder);
    brc_campaign campaign = {.session = session,
                             .what = &sweep->what,
                             .folder = folder,
                             .device = request->device,
                             .n_threads = request->n_threads,
                             .priced = true};
    for (int k = 0; status == BRC_OK && k < sweep->what.n_runs; ++k) {
        const brc_case_run *run = &sweep->what.runs[k];
        if ((request->quick && !run->quick) || brc_accuracy_points_find(points, problem, run->name)) continue;
        brc_outcome outcome = {.run = run};
        brc_accuracy_point point;
        const brc_device_request device = {.selector = request->device, .n_threads = request->n_threads};
        BRC_TRY_OR(cleanup, brc_outcome_obtain(&campaign, &outcome));
        fill_point(sweep, k, &outcome, &device, &point);
        print_point(&point);
        BRC_TRY_OR(cleanup, brc_accuracy_points_add(points, &point));
        BRC_TRY_OR(cleanup, in_folder(points, request->output, "curves.csv",
                                      brc_accuracy_points_write)); /* a bench that is stopped keeps its points */
    }
cleanup:
    brc_sample_store_free(&campaign.samples);
    brc_memory_free(folder);
    brc_sweep_free(&sweep);
    return status;
}

static brc_status write_results(const brc_accuracy_request *request, const brc_accuracy_points *points)
{
    brc_context *context = points->context;
    brc_accuracy_study *study = NULL;
    brc_rows rows = {.context = context};
    brc_accuracy_points_rows(points, &rows);
    brc_status status = brc_rows_write(&rows, request->output);
    brc_rows_free(&rows);
    if (status == BRC_OK) status = brc_accuracy_study_create(context, points, &study);
    if (status == BRC_OK) status = brc_accuracy_report_write(context, study, request->output);
    brc_accuracy_study_free(&study);
    return status;
}

/* Points of an earlier bench in the same folder. */
static brc_status read_earlier(const brc_accuracy_request *request, brc_accuracy_points *points)
{
    char *path;
    brc_status status = BRC_OK;
    BRC_TRY(brc_file_join(points->context, request->output, "curves.csv", &path));
    if (brc_file_exists(path))
        status = request->resume
                     ? brc_accuracy_points_read(points, path)
                     : BRC_FAIL(points->context, BRC_BAD_INPUT,
                                "%s is there already; --resume goes on with it, or choose another folder", path);
    brc_memory_free(path);
    return status;
}

/* All problems of the program, or those asked for; names go into `names`. */
static int list_problems(const brc_accuracy_request *request, char names[PROBLEMS_MOST][64])
{
    int n = 0, length;
    const char *name;
    if (request->n_problems > 0) {
        for (; n < request->n_problems && n < PROBLEMS_MOST; ++n)
            snprintf(names[n], 64, "%s", request->problems[n]);
        return n;
    }
    for (; n < PROBLEMS_MOST && (name = brc_sweep_name(n, &length)); ++n)
        snprintf(names[n], 64, "%.*s", length, name);
    return n;
}

brc_status brc_bench_accuracy(const brc_session *session, const brc_accuracy_request *request)
{
    brc_context *context = session->context;
    char names[PROBLEMS_MOST][64];
    const int n = list_problems(request, names);
    brc_accuracy_points points = {.context = context};
    brc_status status = BRC_OK;
    if (!isatty(STDERR_FILENO)) brc_log_set_level(context, BRC_LOG_WARNING); /* the points tell how far it is */
    BRC_TRY(brc_file_make_folder(context, request->output));
    BRC_TRY_OR(cleanup, read_earlier(request, &points));
    for (int k = 0; k < n; ++k)
        BRC_TRY_OR(cleanup, carry_out(session, request, names[k], &points));
    status = write_results(request, &points);
    if (status == BRC_OK) printf("%lld points; %s/accuracy.md\n", (long long)points.n, request->output);
cleanup:
    brc_accuracy_points_free(&points);
    return status;
}

brc_status brc_bench_accuracy_list(brc_context *context, const char *folder)
{
    char names[PROBLEMS_MOST][64];
    const int n = list_problems(&(brc_accuracy_request){0}, names);
    for (int k = 0; k < n; ++k) {
        brc_sweep *sweep;
        int quick = 0;
        BRC_TRY(brc_sweep_read(context, folder, names[k], &sweep));
        for (int r = 0; r < sweep->what.n_runs; ++r)
            quick += sweep->what.runs[r].quick;
        printf("%-18s %s (%d runs, %d with --quick)\n", names[k], sweep->what.title, sweep->what.n_runs, quick);
        brc_sweep_free(&sweep);
    }
    return BRC_OK;
}
