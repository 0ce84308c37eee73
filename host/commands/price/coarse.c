/* The same scene with fewer elements: how many iterations a solve takes, which grow as the elements across the body,
 * what becomes of its measures, how much breaks and what that does to a step and to the arrays. */
#include "trial.h"
#include "pace.h"
#include "../scratch.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../output/recorder.h"
#include "../../solver/effects/fracture/fracture.h"
#include "../../solver/run/lockstep.h"
#include "../../solver/core/trial_budget.h"
#include "../../solver/run/stage_end.h"
#include <math.h>

enum { BATCH = 64 };

typedef struct watch {
    const brc_device_request *request;
    const brc_setup *setup;
    brc_trial_budget budget;
    double begin;
    bool cut;
    const brc_coarse_request *asked;
    brc_coarse *out;
    double first, part; /* clock at the first pause of the stage, and once as large a part of its steps was done as in
                           the trial; 0: not yet */
    int64_t first_step, part_step;
    int64_t device_first, device_most; /* bytes */
    double broken_sum;                 /* of shares of bonds, over pauses */
    int64_t n_pauses;
} watch;

static brc_status stage_begin(void *self, brc_simulation *simulation, int32_t stage)
{
    watch *w = self;
    (void)simulation, (void)stage;
    w->begin = brc_pace_clock_s(w->request);
    w->first = w->part = 0;
    return BRC_OK;
}

static bool is_over(void *self)
{
    const watch *w = self;
    return brc_pace_clock_s(w->request) - w->begin > w->asked->stage_s;
}

/* Broken bonds over all. */
static brc_status broken_share(const brc_setup *setup, double *out)
{
    int64_t broken = 0;
    for (int32_t k = 0; k < setup->assembly.n; ++k) {
        int64_t n = 0;
        BRC_TRY(brc_simulation_broken(setup->assembly.part[k], &n));
        broken += n;
    }
    *out = (double)broken / (double)brc_setup_n_bonds(setup);
    return BRC_OK;
}

/* What grows as the body breaks and surfaces meet. */
static brc_status look(watch *w, brc_simulation *simulation)
{
    const int32_t stage = brc_simulation_stage(simulation);
    const int64_t step = brc_simulation_step(simulation), bytes = brc_assembly_device_bytes(&w->setup->assembly);
    const double now = brc_pace_clock_s(w->request);
    double broken;
    if (w->device_first == 0) w->device_first = bytes;
    if (bytes > w->device_most) w->device_most = bytes;
    if (w->first == 0) {
        w->first = now;
        w->first_step = step;
    } else if (w->part == 0 && (double)step * (double)w->asked->trial->stages[stage].planned >=
                                   (double)w->asked->trial->stages[stage].done *
                                       (double)brc_simulation_planned_steps(
                                           simulation, stage, brc_simulation_time_step(simulation).value)) {
        w->part = now;
        w->part_step = step;
    }
    BRC_TRY(broken_share(w->setup, &broken));
    w->broken_sum += broken;
    w->n_pauses += 1;
    return BRC_OK;
}

static brc_status paused(void *self, brc_simulation *simulation, brc_pause why)
{
    watch *w = self;
    if (w->asked->trial &&
        brc_simulation_scene(simulation)->stages[brc_simulation_stage(simulation)].solver == BRC_SOLVER_DYNAMIC)
        BRC_TRY(look(w, simulation));
    if (why != BRC_PAUSE_GOING || (w->asked->whole && !is_over(w))) return BRC_OK;
    w->cut = true;
    w->out->out_of_time |= w->asked->whole;
    brc_simulation_end_stage(simulation, "trial"); /* increments go on */
    return BRC_OK;
}

static brc_status stage_end(void *self, brc_simulation *simulation, int32_t stage)
{
    watch *w = self;
    const brc_assembly *all = &w->setup->assembly;
    bool stopped_early = false;
    const int64_t step = brc_simulation_step(simulation);
    if (w->part > w->first && step > w->part_step)
        w->out->slower[stage] = (brc_pace_clock_s(w->request) - w->first) / (double)(step - w->first_step) /
                                ((w->part - w->first) / (double)(w->part_step - w->first_step));
    w->out->iterations[stage] = 0;
    for (int32_t k = 0; k < all->n; ++k) {
        stopped_early |= brc_simulation_stopped_early(all->part[k]);
        w->out->iterations[stage] += brc_simulation_static_report(all->part[k]).iterations;
    }
    if (w->first > 0)
        w->out->done[stage] = (double)step / (double)brc_simulation_planned_steps(
                                                 simulation, stage, brc_simulation_time_step(simulation).value);
    if (stopped_early) w->out->iterations[stage] = 0;
    w->cut |= stopped_early;
    w->out->out_of_time |= stopped_early;
    return BRC_OK;
}

/* false: the elements are given one by one. */
static bool coarsen(brc_fill *fill, double share, uint64_t seed)
{
    const double longer = cbrt(1 / share);
    if (fill->kind == BRC_FILL_POINTS) return false;
    fill->n_elements = fill->n_elements > 0 ? (int64_t)fmax(20, round((double)fill->n_elements * share)) : 0;
    fill->spacing *= longer;
    fill->radius *= longer;
    fill->min_distance *= longer;
    fill->seed += seed;
    for (int d = 0; d < 3; ++d)
        if (fill->cells[d] > 0) fill->cells[d] = (int64_t)fmax(1, round((double)fill->cells[d] / longer));
    return true;
}

/* With the recorder of a run, for the measures; in a folder that is removed. */
static brc_status run_recorded(brc_context *context, watch *w, const char *folder, brc_coarse *out)
{
    const brc_setup *setup = w->setup;
    brc_assembly assembly = setup->assembly;
    brc_recorder *recorder = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_recorder_create(context, folder, brc_clock_s(), &recorder));
    brc_recorder_set_scene(recorder, setup->split->scene);
    brc_recorder_set_domains(recorder, setup->n, setup->domain, 0);
    brc_recorder_set_threads(recorder, w->request->n_threads);
    BRC_TRY_OR(cleanup, brc_recorder_observe(recorder, &assembly));
    BRC_TRY_OR(cleanup, brc_recorder_finish(recorder, brc_lockstep_run(assembly.n, assembly.part)));
    for (int32_t k = 0; k < brc_recorder_measure_count(recorder) && !w->cut; ++k)
        out->measures[k] = brc_recorder_measures(recorder)[k].value;
cleanup:
    brc_recorder_free(&recorder);
    return status;
}

static brc_status run(brc_context *context, brc_scene *scene, const brc_device_request *request,
                      const brc_coarse_request *asked, brc_coarse *out)
{
    brc_setup setup = {0};
    brc_status status = BRC_OK;
    char folder[BRC_SCRATCH];
    watch w = {.request = request, .setup = &setup, .asked = asked, .out = out};
    w.budget = (brc_trial_budget){.self = &w, .over = is_over, .batch = asked->whole ? BATCH : 1};
    BRC_TRY_OR(cleanup, brc_setup_domains(context, scene, NULL, request->n_threads, &setup));
    BRC_TRY_OR(cleanup, brc_setup_polish(context, request->n_threads, &setup));
    BRC_TRY_OR(cleanup, brc_setup_simulations(context, request, &setup));
    const double across = brc_setup_across(&setup);
    out->n_elements = brc_setup_n_elements(&setup);
    BRC_TRY_OR(cleanup,
               brc_simulation_observe(
                   setup.simulation[0],
                   &(brc_observer){.self = &w, .stage_begin = stage_begin, .pause = paused, .stage_end = stage_end}));
    for (int32_t k = 0; k < setup.n; ++k)
        brc_simulation_set_trial_budget(setup.simulation[k], &w.budget);
    if (asked->whole) {
        BRC_TRY_OR(cleanup, brc_scratch_create(context, folder));
        status = run_recorded(context, &w, folder, out);
        brc_scratch_remove(context, folder);
    } else {
        status = brc_lockstep_run(setup.n, setup.simulation);
    }
    if (status == BRC_OK && asked->trial && !w.cut) {
        BRC_TRY_OR(cleanup, broken_share(&setup, &out->broken));
        out->broken_mean = w.n_pauses > 0 ? w.broken_sum / (double)w.n_pauses : out->broken;
        if (w.device_first > 0) out->grown = (double)w.device_most / (double)w.device_first;
    }
    if (status == BRC_OK) out->across = across;
cleanup:
    brc_setup_free(&setup);
    return status;
}

/* Every fill of the scene made coarser, unless one cannot be. */
static brc_status run_coarser(brc_context *context, brc_scene *scene, const brc_device_request *request,
                              const brc_coarse_request *asked, brc_coarse *out)
{
    brc_fill *kept = NULL;
    bool can = true;
    BRC_TRY(BRC_ALLOCATE(context, &kept, scene->n_bodies, "fills"));
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        kept[b] = scene->bodies[b].fill;
        can &= asked->share == 1 ||
               (!scene->bodies[b].domain_file[0] && coarsen(&scene->bodies[b].fill, asked->share, asked->seed));
    }
    /* What a coarser body cannot do is no failure: then there is nothing to learn from it. */
    if (can && run(context, scene, request, asked, out) != BRC_OK) brc_context_clear(context);
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        scene->bodies[b].fill = kept[b];
    brc_memory_free(kept);
    return BRC_OK;
}

brc_status brc_trial_coarse(brc_context *context, brc_scene *scene, const brc_device_request *request,
                            const brc_coarse_request *asked, brc_coarse *out)
{
    const brc_log_level level = brc_log_get_level(context);
    const brc_output output = scene->output;
    *out = (brc_coarse){.broken = NAN, .broken_mean = NAN, .grown = NAN};
    BRC_TRY(BRC_ALLOCATE(context, &out->slower, scene->n_stages, "pace"));
    BRC_TRY(BRC_ALLOCATE(context, &out->done, scene->n_stages, "pace"));
    for (int32_t k = 0; k < scene->n_stages; ++k)
        out->slower[k] = out->done[k] = NAN;
    BRC_TRY(BRC_ALLOCATE(context, &out->iterations, scene->n_stages, "iterations"));
    BRC_TRY(BRC_ALLOCATE(context, &out->measures, scene->n_measures, "measures"));
    for (int32_t k = 0; k < scene->n_measures; ++k)
        out->measures[k] = NAN;
    scene->output.n_frames = -1;
    scene->output.picture = false;
    scene->output.curve_x[0] = '\0';
    brc_log_set_level(context, BRC_LOG_ERROR);
    const brc_status status = run_coarser(context, scene, request, asked, out);
    brc_log_set_level(context, level);
    scene->output = output;
    return status;
}

void brc_coarse_free(brc_coarse *coarse)
{
    brc_memory_free(coarse->iterations);
    brc_memory_free(coarse->measures);
    brc_memory_free(coarse->slower);
    brc_memory_free(coarse->done);
    *coarse = (brc_coarse){0};
}
