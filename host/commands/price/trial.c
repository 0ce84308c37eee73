/* The run itself, cut short. Two observers stand around the recorder, so that what it does is timed apart from the
 * steps. */
#include "trial.h"
#include "../../solver/effects/rest.h"
#include "pace.h"
#include "planned_output.h"
#include "../scratch.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../output/checkpoint/checkpoint.h"
#include "../../solver/effects/fracture/fracture.h"
#include "../../solver/run/lockstep.h"
#include "../../solver/core/trial_budget.h"
#include "../../solver/run/stage_end.h"
#include <math.h>
#include <stdio.h>

/* A dynamic stage or one of events is cut after this long, but not before so many pauses; the solves of a static stage
 * after this long. Events have their own end: their solves are cut only where one alone would take far too long. */
static const double watched_s = 1, solve_s = 2, event_s = 40;
/* Where bonds break, surfaces meet or a condition ends the stage, a stage that has less than this before it by its pace
 * is run to its end, which says more than any coarser body; unless it got so much slower that it has taken so long. */
static const double finish_s = 5, finish_most_s = 15;
enum { LEAST_PAUSES = 4, FIRST_BATCH = 4, LARGEST_BATCH = 256 };
static const double short_batch_s = 0.05;

typedef struct watch {
    const brc_device_request *request;
    const brc_setup *setup;
    bool brief;
    brc_trial_budget budget;
    brc_trial_stage *stages;
    brc_trial_stage *now;
    double mark;  /* end of the last stage */
    double begin; /* of this one */
    double output_begin, output_s;
    double first, first_output_s; /* at the first pause */
    double last;                  /* pause */
    int64_t first_step;
    int pauses;
    double asked_first, asked_last; /* by solves */
    int64_t asked;
    double budget_s;
    int64_t state_bytes;             /* of a checkpoint where a stage was cut that would leave one at its end */
    int64_t device_first;            /* bytes at the first pause */
    brc_rest_account rest_first;     /* the same */
    brc_device_counts counted_first; /* at the first pause of the stage */
} watch;

bool brc_trial_may_end_early(const brc_stage *stage)
{
    return stage->stop_kinetic > 0 || stage->stop_broken > 0 || stage->stop_sensor[0];
}

/* Is counting steps not all there is to say of a stage? */
static bool is_open(const brc_scene *scene, const brc_stage *stage)
{
    return scene->has_fracture || scene->has_contact || brc_trial_may_end_early(stage);
}

/* After so long in the stage. */
static bool is_finishing(const brc_trial_stage *now, double since)
{
    return now->pace_s * (double)(now->planned - now->done) < finish_s && since < finish_most_s;
}

static double clock_of(const watch *w)
{
    return brc_pace_clock_s(w->request);
}

static brc_status stage_begin(void *self, brc_simulation *simulation, int32_t index)
{
    watch *w = self;
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_stage *stage = &scene->stages[index];
    brc_trial_stage *now = w->now = &w->stages[index];
    w->begin = clock_of(w);
    now->ran = true;
    now->enter_s = w->begin - w->mark;
    now->time_step = brc_assembly_time_step(&w->setup->assembly);
    now->planned = stage->most_events > 0 ? stage->most_events
                                          : brc_simulation_planned_steps(simulation, index, now->time_step.value);
    now->samples_planned = brc_planned_samples(scene, index, now->planned);
    now->frames_planned = brc_planned_frames(scene, index, now->planned, now->time_step.value) +
                          (index == 0 && scene->output.n_frames >= 0);
    w->output_s = 0;
    w->pauses = 0;
    w->asked = 0;
    w->budget_s = stage->most_events > 0 ? event_s : solve_s;
    w->budget.batch = FIRST_BATCH;
    return BRC_OK;
}

static brc_status before_output(void *self, brc_simulation *simulation)
{
    watch *w = self;
    (void)simulation;
    w->output_begin = clock_of(w);
    return BRC_OK;
}

static brc_status after_sample(void *self, brc_simulation *simulation)
{
    watch *w = self;
    const double took = clock_of(w) - w->output_begin;
    (void)simulation;
    w->output_s += took;
    w->now->samples += 1;
    w->now->sample_s += (took - w->now->sample_s) / (double)w->now->samples;
    return BRC_OK;
}

static brc_status after_frame(void *self, brc_simulation *simulation)
{
    watch *w = self;
    const double took = clock_of(w) - w->output_begin;
    (void)simulation;
    w->output_s += took;
    w->now->frames += 1;
    w->now->frame_s += (took - w->now->frame_s) / (double)w->now->frames;
    return BRC_OK;
}

/* Of all devices so far. */
static brc_device_counts counted(const watch *w)
{
    brc_device_counts sum = {0};
    for (int32_t k = 0; k < w->setup->n; ++k) {
        const brc_device_counts one = brc_device_counted(w->setup->device[k]);
        sum.launches += one.launches;
        sum.waits += one.waits;
    }
    return sum;
}

static double floor_of(const brc_assembly *all)
{
    double sum = 0;
    for (int32_t k = 0; k < all->n; ++k)
        sum += brc_simulation_floor_bytes(all->part[k]);
    return sum;
}

static brc_status count_numbers(brc_state_store *store, const char *name, brc_stored_type type, int64_t rows,
                                int32_t columns, void *data)
{
    (void)name;
    (void)data;
    *(int64_t *)store->self += rows * columns * brc_stored_type_bytes(type);
    return BRC_OK;
}

static brc_status cut(watch *w, brc_simulation *simulation, const brc_stage *stage)
{
    const brc_assembly *all = &w->setup->assembly;
    w->now->cut = true;
    w->state_bytes = 0;
    if (brc_trial_may_end_early(stage)) {
        brc_state_store store = {.self = &w->state_bytes, .numbers = count_numbers};
        BRC_TRY(brc_lockstep_save(all->n, all->part, &store));
    }
    brc_simulation_end_stage(simulation, "trial");
    return BRC_OK;
}

static brc_status paused(void *self, brc_simulation *simulation, brc_pause why)
{
    watch *w = self;
    const double now = clock_of(w);
    const int64_t step = brc_simulation_step(simulation);
    const brc_stage *stage = &brc_simulation_scene(simulation)->stages[brc_simulation_stage(simulation)];
    w->now->done = step;
    if (stage->solver == BRC_SOLVER_DYNAMIC) w->now->floor_bytes = floor_of(&w->setup->assembly);
    if (w->device_first == 0 && stage->solver == BRC_SOLVER_DYNAMIC)
        w->device_first = brc_assembly_device_bytes(&w->setup->assembly);
    if (stage->solver == BRC_SOLVER_STATIC && stage->most_events == 0) return BRC_OK;
    if (w->pauses++ == 0) {
        w->first = now;
        w->first_step = step;
        w->counted_first = counted(w);
        w->rest_first = brc_simulation_at_rest(simulation);
        w->first_output_s = w->output_s;
        w->now->warm_s = now - w->begin - w->output_s;
    } else {
        const brc_device_counts all = counted(w);
        w->now->launches = (double)(all.launches - w->counted_first.launches) / (double)(step - w->first_step);
        w->now->waits = (double)(all.waits - w->counted_first.waits) / (double)(step - w->first_step);
        const double seen = (now - w->first - (w->output_s - w->first_output_s)) / (double)(step - w->first_step);
        w->now->pace_s = brc_rest_whole_pace(seen, w->rest_first, brc_simulation_at_rest(simulation));
        w->now->spared = brc_rest_spared(simulation, (double)(w->now->planned - step));
        if (now - w->last < short_batch_s && w->budget.batch < LARGEST_BATCH) w->budget.batch *= 2;
    }
    w->last = now;
    if (!w->brief && is_open(brc_simulation_scene(simulation), stage) && is_finishing(w->now, now - w->begin))
        return BRC_OK;
    if (why == BRC_PAUSE_GOING && w->pauses >= LEAST_PAUSES && now - w->begin > watched_s)
        return cut(w, simulation, stage);
    return BRC_OK;
}

static bool solve_is_over(void *self)
{
    watch *w = self;
    const double now = clock_of(w);
    if (w->asked++ == 0) w->asked_first = now;
    w->asked_last = now;
    return now - w->begin > w->budget_s;
}

static brc_status count_broken(const brc_assembly *all, int64_t *out)
{
    *out = 0;
    for (int32_t k = 0; k < all->n; ++k) {
        int64_t broken;
        BRC_TRY(brc_simulation_broken(all->part[k], &broken));
        *out += broken;
    }
    return BRC_OK;
}

static brc_status stage_end(void *self, brc_simulation *simulation, int32_t index)
{
    watch *w = self;
    const brc_stage *stage = &brc_simulation_scene(simulation)->stages[index];
    const brc_assembly *all = &w->setup->assembly;
    w->mark = clock_of(w);
    w->now->whole_s = w->mark - w->begin;
    BRC_TRY(count_broken(all, &w->now->broken));
    for (int32_t k = 0; k < index; ++k)
        w->now->broken -= w->stages[k].broken;
    if (stage->solver == BRC_SOLVER_MODES) w->now->done = 1;
    if (stage->solver == BRC_SOLVER_DYNAMIC || stage->most_events > 0) return BRC_OK;
    for (int32_t k = 0; k < all->n; ++k) {
        w->now->iterations += brc_simulation_static_report(all->part[k]).iterations;
        w->now->cut |= brc_simulation_stopped_early(all->part[k]);
    }
    w->now->pace_s = w->asked > 1 ? (w->asked_last - w->asked_first) / (double)(w->asked - 1) : 0;
    w->now->warm_s = w->now->whole_s - w->now->pace_s * (double)w->now->iterations;
    return BRC_OK;
}

/* Bytes of an element in a frame that refers to others for its points: a cell with its 6.4 corners, a sphere; and where
 * bonds break. */
static const double cell_in_frame = 152 + 6.4 * 12, sphere_in_frame = 152 + 12 + 32, broken_in_frame = 12;

/* Bytes on disk, and what of them grows with frames and samples. */
static void weigh_folder(brc_context *context, const char *folder, const brc_scene *scene, const brc_setup *setup,
                         brc_trial *out)
{
    char *path;
    for (int32_t k = 0; k < setup->n; ++k)
        out->full_frame_bytes +=
            (double)setup->domain[k]->n_elements *
            ((setup->domain[k]->element_kind == BRC_ELEMENT_SPHERE ? sphere_in_frame : cell_in_frame) +
             (scene->has_fracture ? broken_in_frame : 0));
    if (brc_file_join(context, folder, "frames", &path) != BRC_OK) return;
    out->frames_bytes = brc_scratch_bytes(context, path, NULL);
    out->first_frame_bytes = brc_scratch_bytes(context, path, "000000.vtkhdf");
    brc_memory_free(path);
    out->table_bytes = brc_scratch_bytes(context, folder, "histories.csv");
    out->disk_bytes = brc_scratch_bytes(context, folder, NULL);
    out->sample_bytes = (scene->n_sensors + 4) * (int64_t)sizeof(double);
}

/* Does the run write a checkpoint that nobody has to ask for with a signal? */
static bool keeps_state(const brc_scene *scene)
{
    bool keeps = scene->output.has_checkpoint;
    for (int32_t k = 0; k < scene->n_stages; ++k)
        keeps |= brc_trial_may_end_early(&scene->stages[k]);
    return keeps;
}

static brc_status run_in(brc_context *context, const char *folder, watch *w, brc_trial *out)
{
    const brc_setup *setup = w->setup;
    const brc_scene *scene = setup->split->scene;
    brc_assembly assembly = setup->assembly;
    brc_recorder *recorder = NULL;
    brc_checkpoints *checkpoints = NULL;
    brc_status status = BRC_OK;
    w->mark = clock_of(w);
    BRC_TRY_OR(cleanup, brc_recorder_create(context, folder, brc_clock_s(), &recorder));
    brc_recorder_set_scene(recorder, scene);
    brc_recorder_set_domains(recorder, setup->n, setup->domain, 0);
    brc_recorder_set_threads(recorder, w->request->n_threads);
    BRC_TRY_OR(cleanup,
               brc_simulation_observe(assembly.part[0],
                                      &(brc_observer){.self = w, .sample = before_output, .frame = before_output}));
    if (keeps_state(scene)) {
        BRC_TRY_OR(cleanup, brc_checkpoints_create(context, folder, scene, false, &checkpoints));
        BRC_TRY_OR(cleanup, brc_checkpoints_observe(checkpoints, &assembly, recorder));
    } else {
        BRC_TRY_OR(cleanup, brc_recorder_observe(recorder, &assembly));
    }
    BRC_TRY_OR(cleanup, brc_simulation_observe(assembly.part[0], &(brc_observer){.self = w,
                                                                                 .stage_begin = stage_begin,
                                                                                 .sample = after_sample,
                                                                                 .frame = after_frame,
                                                                                 .stage_end = stage_end,
                                                                                 .pause = paused}));
    for (int32_t k = 0; k < assembly.n; ++k)
        brc_simulation_set_trial_budget(assembly.part[k], &w->budget);
    status = checkpoints ? brc_checkpoints_run(checkpoints) : brc_lockstep_run(assembly.n, assembly.part);
    out->stepping_bytes = brc_memory_peak_since_mark();
    brc_memory_mark();
    const double begin = clock_of(w);
    if (status == BRC_PHYSICS_STOPPED) {
        out->stopped = true;
        snprintf(out->reason, sizeof out->reason, "%s", brc_context_message(context));
    }
    status = brc_recorder_finish(recorder, status);
    if (out->stopped) { /* told by the price; no failure of the check */
        brc_context_clear(context);
        status = BRC_OK;
    }
    out->end_s = clock_of(w) - begin;
    BRC_TRY_OR(cleanup, count_broken(&assembly, &out->n_broken));
    out->device_bytes[1] = brc_assembly_device_bytes(&assembly);
    out->device_bytes[0] = w->device_first > 0 ? w->device_first : out->device_bytes[1];
    weigh_folder(context, folder, scene, setup, out);
    if (checkpoints) {
        const brc_checkpoint_report report = brc_checkpoints_report(checkpoints);
        out->n_checkpoints = report.n_written;
        out->checkpoint_bytes = report.bytes;
        if (report.n_written == 0) out->disk_bytes += w->state_bytes;
    }
    out->n_measures = brc_recorder_measure_count(recorder);
    for (int32_t k = 0; k < out->n_measures; ++k)
        out->measures[k] = brc_trial_is_whole(out) ? brc_recorder_measures(recorder)[k].value : NAN;
cleanup:
    brc_checkpoints_free(&checkpoints);
    brc_recorder_free(&recorder);
    return status;
}

brc_status brc_trial_run(brc_context *context, const brc_setup *setup, const brc_device_request *request, bool brief,
                         brc_trial *out)
{
    const brc_scene *scene = setup->split->scene;
    const brc_log_level level = brc_log_get_level(context);
    char folder[BRC_SCRATCH];
    *out = (brc_trial){.n_stages = scene->n_stages, .writes_checkpoints = scene->output.has_checkpoint};
    BRC_TRY(BRC_ALLOCATE(context, &out->stages, scene->n_stages, "trial"));
    BRC_TRY(BRC_ALLOCATE(context, &out->measures, scene->n_measures, "trial"));
    watch w = {.request = request, .setup = setup, .brief = brief, .stages = out->stages};
    w.budget = (brc_trial_budget){.self = &w, .over = solve_is_over, .batch = FIRST_BATCH};
    BRC_TRY(brc_scratch_create(context, folder));
    brc_log_set_level(context, BRC_LOG_ERROR);
    brc_memory_mark();
    const brc_status status = run_in(context, folder, &w, out);
    brc_log_set_level(context, level);
    brc_scratch_remove(context, folder);
    out->ending_bytes = brc_memory_peak_since_mark();
    int64_t to_come = 0; /* samples */
    for (int32_t k = 0; k < out->n_stages; ++k)
        if (out->stages[k].cut)
            to_come += (out->stages[k].samples_planned - out->stages[k].samples) * (scene->n_sensors + 4) *
                       (int64_t)sizeof(double);
    out->stepping_bytes += to_come;
    out->ending_bytes += to_come;
    out->host_bytes = brc_memory_peak();
    if (out->stepping_bytes > out->host_bytes) out->host_bytes = out->stepping_bytes;
    if (out->ending_bytes > out->host_bytes) out->host_bytes = out->ending_bytes;
    out->resident_bytes = brc_memory_resident();
    return status;
}

void brc_trial_free(brc_trial *trial)
{
    brc_memory_free(trial->stages);
    brc_memory_free(trial->measures);
    *trial = (brc_trial){0};
}

bool brc_trial_is_whole(const brc_trial *trial)
{
    for (int32_t k = 0; k < trial->n_stages; ++k)
        if (!trial->stages[k].ran || trial->stages[k].cut) return false;
    return !trial->stopped;
}

int64_t brc_trial_disk(const brc_trial *trial, const double *done)
{
    double frames = 0, frames_planned = 0, samples = 0, samples_planned = 0;
    for (int32_t k = 0; k < trial->n_stages; ++k) {
        const brc_trial_stage *stage = &trial->stages[k];
        const double part = done && !isnan(done[k]) ? done[k] : 1;
        frames += (double)stage->frames;
        samples += (double)stage->samples;
        frames_planned += fmax((double)stage->frames, stage->cut ? part * (double)stage->frames_planned : 0);
        samples_planned += fmax((double)stage->samples, stage->cut ? part * (double)stage->samples_planned : 0);
    }
    /* as those after the first, where there were any, but with everything moving */
    const double frame = fmax(trial->full_frame_bytes,
                              frames > 1 ? (double)(trial->frames_bytes - trial->first_frame_bytes) / (frames - 1) : 0);
    const double more_frames = frames > 0 ? frames_planned - frames : 0,
                 more_samples = samples > 0 ? samples_planned / samples - 1 : 0;
    /* two are kept, of runs that write more than one */
    const int64_t second = trial->n_checkpoints == 1 && trial->writes_checkpoints && !brc_trial_is_whole(trial)
                               ? trial->checkpoint_bytes
                               : 0;
    return trial->disk_bytes + second +
           (int64_t)(more_frames * frame + more_samples * (double)trial->table_bytes +
                     (samples_planned - samples) * (double)trial->sample_bytes);
}

double brc_trial_seconds(const brc_trial *trial)
{
    double sum = trial->end_s;
    for (int32_t k = 0; k < trial->n_stages; ++k) {
        const brc_trial_stage *stage = &trial->stages[k];
        sum += stage->enter_s + (stage->cut && stage->done > 0 ? stage->warm_s + stage->pace_s * (double)stage->planned
                                                               : stage->whole_s);
    }
    return sum;
}
