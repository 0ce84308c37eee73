/* Carrying out one run of a case. */
#include "../price/pace.h"
#include "operators.h"
#include "reproduce_fracture.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the hooks of a run are handed. */
typedef struct hooks {
    brc_context *context;
    brc_outcome *outcome;
    const brc_device_request *priced; /* NULL: the dynamics of the run is not priced */
    double begun_s, created_s;        /* processor time at the start and when the simulation was there */
} hooks;

static brc_status created(void *self, brc_simulation *simulation)
{
    hooks *h = self;
    (void)simulation;
    h->created_s = brc_processor_s();
    return BRC_OK;
}

static brc_status finished(void *self, brc_simulation *simulation)
{
    const hooks *h = self;
    if (h->priced) {
        brc_outcome_add(h->outcome, "build_processor_seconds", "s", h->created_s - h->begun_s, NAN);
        brc_outcome_add(h->outcome, "run_processor_seconds", "s", brc_processor_s() - h->created_s, NAN);
        brc_outcome_add(h->outcome, "host_bytes", "byte", (double)brc_memory_held(), NAN);
        BRC_TRY(brc_pace_values(h->context, simulation, h->priced, h->outcome));
    }
    if (h->outcome->run->keep) {
        const int64_t n = 3 * brc_simulation_domain(simulation)->n_elements;
        BRC_TRY(BRC_ALLOCATE(h->context, &h->outcome->displacement, n, "kept displacement"));
        BRC_TRY(brc_simulation_displacement(simulation, h->outcome->displacement));
    }
    const brc_static_report report = brc_simulation_static_report(simulation);
    brc_outcome_add(h->outcome, "iterations", "-", (double)report.iterations, NAN);
    brc_outcome_add(h->outcome, "residual", "-", report.residual, NAN);
    if (brc_simulation_has_fracture(simulation)) BRC_TRY(brc_fracture_values(h->context, simulation, h->outcome));
    const brc_operator *operator= h->outcome->run->operator;
    return operator->finished ? operator->finished(h->context, simulation, h->outcome) : BRC_OK;
}

/* stopped: the measures of a run that was stopped are of a state nobody should trust; its counts and times stand. */
static void take(brc_outcome *outcome, const brc_run_results *results, bool stopped)
{
    outcome->n_elements = results->n_elements;
    outcome->n_bonds = results->n_bonds;
    outcome->steps = results->steps;
    outcome->seconds = results->total_s;
    snprintf(outcome->device, sizeof outcome->device, "%s", results->device);
    for (int32_t k = 0; k < results->n_measures; ++k) {
        const brc_run_measure *measure = &results->measures[k];
        brc_outcome_add(outcome, measure->name, measure->unit, stopped ? NAN : measure->value,
                        measure->has_target ? measure->target : NAN);
        if (isnan(measure->value) && !stopped && !outcome->note[0])
            snprintf(outcome->note, sizeof outcome->note, "%s: %s", measure->name, measure->why_not);
    }
    brc_outcome_add(outcome, "stopped", "-", stopped, NAN);
    brc_outcome_add(outcome, "seconds", "s", results->total_s, NAN);
    brc_outcome_add(outcome, "build_seconds", "s", results->build_s, NAN);
    brc_outcome_add(outcome, "step_seconds", "s", results->steps_s, NAN);
    brc_outcome_add(outcome, "elements", "-", (double)results->n_elements, NAN);
    brc_outcome_add(outcome, "bonds", "-", (double)results->n_bonds, NAN);
    brc_outcome_add(outcome, "steps", "-", (double)results->steps, NAN);
    brc_outcome_add(outcome, "time_step", "s", results->time_step.value, NAN);
    brc_outcome_add(outcome, "critical_step", "s", results->time_step.critical, NAN);
    brc_outcome_add(outcome, "published_step", "s", results->time_step.published, NAN);
    brc_outcome_add(outcome, "closure", "-", results->ledger.closure, 0);
    /* No larger energy than what was put in, within the oscillation of the integrator: the plain test of stability. */
    const double given = fmax(results->ledger.peak_elastic, results->ledger.peak_kinetic);
    brc_outcome_add(outcome, "energy_left", "-", given > 0 ? results->ledger.total / given : NAN, NAN);
    if (results->n_elements > 0)
        brc_outcome_add(outcome, "bytes_per_element", "byte",
                        (double)results->device_bytes / (double)results->n_elements, NAN);
}

brc_status brc_outcome_simulate(brc_campaign *campaign, brc_outcome *outcome, const char *scene, const char *text,
                                size_t bytes, const char *folder)
{
    brc_context *context = campaign->session->context;
    const brc_case_run *run = outcome->run;
    const brc_device_request device = {.selector = run->device        ? run->device
                                                   : campaign->device ? campaign->device
                                                                      : "auto",
                                       .precision = outcome->precision,
                                       .n_threads = run->n_threads > 0 ? run->n_threads : campaign->n_threads,
                                       .exact = run->exact || campaign->exact};
    hooks h = {context, outcome, campaign->priced ? &device : NULL, brc_processor_s(), 0};
    const brc_operator *operator= run->operator;
    void *watching = NULL;
    brc_observer observer;
    brc_run_request request = {.path = scene,
                               .text = text,
                               .text_bytes = bytes,
                               .n_overrides = run->n_overrides,
                               .overrides = run->overrides,
                               .folder = folder,
                               .device = device.selector,
                               .precision = device.precision,
                               .n_threads = device.n_threads,
                               .exact = device.exact,
                               .created = created,
                               .finished = finished,
                               .self = &h,
                               .running = campaign->session->running};
    if (operator->create) {
        BRC_TRY(operator->create(context, &watching));
        observer = operator->observer(watching);
        request.observer = &observer;
    }
    brc_run_results results;
    brc_status status = brc_run_scene(context, &request, &results);
    take(outcome, &results, status == BRC_PHYSICS_STOPPED);
    if (watching && (status == BRC_OK || operator->stopped_too)) {
        const brc_status valued = operator->values(campaign, watching, outcome);
        if (status == BRC_OK) status = valued;
    }
    if (watching) operator->release(watching);
    brc_run_results_free(&results);
    return status;
}

/* Sums of a value over samples. */
typedef struct sums {
    double sum, square;
    int n;
} sums;

/* What a run draws anew with each seed, the scene's own in *seed; NULL: nothing. */
static const char *seed_key(const brc_scene *scene, uint64_t *seed)
{
    const brc_fill *fill = &scene->bodies[0].fill;
    *seed = fill->seed;
    if (scene->n_bodies == 1 && fill->kind == BRC_FILL_PACKING) return "bodies.0.fill.packing.seed";
    if (scene->n_bodies == 1 && fill->kind == BRC_FILL_NOISY_GRID && !scene->has_fracture)
        return "bodies.0.fill.noisy_grid.seed";
    *seed = (uint64_t)scene->fracture.seed;
    return scene->has_fracture ? "fracture.seed" : NULL;
}

/* The run once for each of its seeds, each in a folder of its own; values are means with their scatter, seconds and
 * steps those of all together. Samples that were stopped, where they may be, are in `stopped`, their share, and in no
 * other mean. */
static brc_status simulate_samples(brc_campaign *campaign, brc_outcome *outcome, const char *scene, const char *text,
                                   size_t bytes, const char *folder)
{
    brc_context *context = campaign->session->context;
    brc_case_run run = *outcome->run;
    brc_scene *read;
    sums all[BRC_CASE_VALUES] = {{0}};
    uint64_t seed;
    int n_whole = 0;
    if (run.keep || run.n_overrides == BRC_CASE_LIST || run.operator->one_run)
        return BRC_FAIL(context, BRC_BAD_INPUT, "run %s: no seeds together with keep, drift, vibration or %d overrides",
                        run.name, BRC_CASE_LIST);
    BRC_TRY(brc_scene_read_text(context, scene, text, bytes, run.n_overrides, run.overrides, &read));
    const char *key = seed_key(read, &seed);
    brc_scene_free(&read);
    if (!key)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "run %s: seeds expect one body of a packing or a noisy grid, or `fracture`, whose strengths are drawn anew",
            run.name);
    const int n = run.n_seeds;
    for (int k = 0; k < n; ++k) {
        char override[64], name[32], *one_folder;
        brc_outcome one = {.run = &run, .precision = outcome->precision};
        snprintf(override, sizeof override, "%s=%llu", key, (unsigned long long)seed + k);
        snprintf(name, sizeof name, "seed-%llu", (unsigned long long)seed + k);
        run.n_overrides = outcome->run->n_overrides + 1;
        run.overrides[run.n_overrides - 1] = override;
        BRC_TRY(brc_file_join(context, folder, name, &one_folder));
        const brc_status status = brc_outcome_simulate(campaign, &one, scene, text, bytes, one_folder);
        brc_memory_free(one_folder);
        outcome->seconds += one.seconds;
        outcome->steps += one.steps;
        outcome->n_elements = one.n_elements;
        outcome->n_bonds = one.n_bonds;
        memcpy(outcome->device, one.device, sizeof one.device);
        if (status == BRC_PHYSICS_STOPPED && run.may_stop) {
            brc_log(context, BRC_LOG_INFO, "run %s, %s: %s", run.name, override, brc_context_message(context));
            brc_context_clear(context);
            continue;
        }
        BRC_TRY(status);
        n_whole += 1;
        if (!outcome->note[0]) memcpy(outcome->note, one.note, sizeof one.note);
        for (int v = 0; v < one.n_values; ++v) { /* by name: a sample in which nothing broke has fewer */
            int to = 0;
            if (brc_outcome_find(&one, one.values[v].name) != &one.values[v]) continue; /* a measure goes first */
            while (to < outcome->n_values && strcmp(outcome->values[to].name, one.values[v].name) != 0)
                ++to;
            if (to == outcome->n_values)
                brc_outcome_add(outcome, one.values[v].name, one.values[v].unit, 0, one.values[v].reference);
            if (to == outcome->n_values) continue; /* no room */
            all[to].sum += one.values[v].value;
            all[to].square += one.values[v].value * one.values[v].value;
            all[to].n += 1;
        }
    }
    for (int v = 0; v < outcome->n_values; ++v) {
        const double mean =
            all[v].n == n_whole ? all[v].sum / n_whole : NAN; /* what not all of them have is no mean of them */
        outcome->values[v].value = mean;
        outcome->values[v].scatter = sqrt(fmax(all[v].square - n_whole * mean * mean, 0) / (n_whole - 1));
        if (strcmp(outcome->values[v].name, "stopped") == 0) outcome->values[v].value = (double)(n - n_whole) / n;
    }
    if (n_whole == 0) brc_outcome_add(outcome, "stopped", "-", 1, NAN);
    return BRC_OK;
}

/* Is a device of this name here and usable? */
static bool has_device(brc_context *context, const char *selector)
{
    brc_device_list *list;
    if (brc_device_list_create(context, &list) != BRC_OK) return false;
    bool found = false;
    for (int k = 0; k < list->n; ++k)
        found = found || (list->items[k].usable && strcmp(list->items[k].selector, selector) == 0);
    brc_device_list_free(&list);
    return found;
}

/* Put the files that the scene reads into the run's folder, where its relative paths begin. */
static brc_status put_files(brc_campaign *campaign, const brc_case_run *run, const char *folder)
{
    brc_context *context = campaign->session->context;
    if (run->n_files > 0) BRC_TRY(brc_file_make_folder(context, folder));
    for (int k = 0; k < run->n_files; ++k) {
        char *text = NULL, *path = NULL;
        size_t bytes;
        brc_status status =
            brc_case_text(context, campaign->what->folder, campaign->what->name, run->files[k], &text, &bytes);
        if (status == BRC_OK) status = brc_file_join(context, folder, run->files[k], &path);
        if (status == BRC_OK) status = brc_file_write_whole(context, path, text, bytes);
        brc_memory_free(path);
        brc_memory_free(text);
        BRC_TRY(status);
    }
    return BRC_OK;
}

brc_status brc_outcome_obtain(brc_campaign *campaign, brc_outcome *outcome)
{
    brc_context *context = campaign->session->context;
    const brc_case_run *run = outcome->run;
    outcome->precision = run->has_precision ? run->precision : campaign->precision;
    if (run->device && !has_device(context, run->device)) {
        outcome->skipped = true;
        snprintf(outcome->note, sizeof outcome->note, "skipped: no device %s here", run->device);
        return BRC_OK;
    }
    char *text, *runs, *folder, *path = NULL;
    size_t bytes;
    brc_status status = brc_case_text(context, campaign->what->folder, campaign->what->name, run->scene, &text, &bytes);
    if (status != BRC_OK) return status;
    BRC_TRY_OR(free_text, brc_file_join(context, campaign->folder, "runs", &runs));
    BRC_TRY_OR(free_runs, brc_file_join(context, runs, run->name, &folder));
    brc_log(context, BRC_LOG_INFO, "%s: run %s", campaign->what->name, run->name);
    status = brc_file_join(context, folder, run->scene, &path);
    if (status == BRC_OK) status = put_files(campaign, run, folder);
    if (status == BRC_OK)
        status = run->operator->obtain ? run->operator->obtain(campaign, outcome, path, text, bytes, folder)
                 : run->n_seeds> 1     ? simulate_samples(campaign, outcome, path, text, bytes, folder)
                                       : brc_outcome_simulate(campaign, outcome, path, text, bytes, folder);
    outcome->done = status == BRC_OK || (status == BRC_PHYSICS_STOPPED && run->may_stop);
    if (status != BRC_OK && status != BRC_INTERRUPTED && status != BRC_NO_MEMORY) {
        brc_log(context, outcome->done ? BRC_LOG_INFO : BRC_LOG_ERROR, "run %s: %s", run->name,
                brc_context_message(context));
        snprintf(outcome->note, sizeof outcome->note, "%s", brc_context_message(context));
        for (char *c = outcome->note; *c; ++c)
            if (*c == '\n') *c = ' ';
        brc_context_clear(context);
        status = BRC_OK;
    }
    brc_memory_free(path);
    brc_memory_free(folder);
free_runs:
    brc_memory_free(runs);
free_text:
    brc_memory_free(text);
    return status;
}
