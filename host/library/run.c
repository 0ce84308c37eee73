/* Runs: brc_run_scene with an observer of its own, which asks the caller's. */
#include "library_internal.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../solver/run/stage_end.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static breccia_status refuse(breccia_run *run, const char *what)
{
    return brc_public_status(BRC_FAIL(run->context, BRC_BAD_INPUT, "%s", what));
}

/* ---- making and freeing ---- */

static void pass_line(void *self, brc_log_level level, const char *line)
{
    const breccia_run *run = self;
    if (run->line) run->line(run->line_self, (int)level, line);
}

static char *copy_of(const char *text)
{
    return text ? strdup(text) : NULL;
}

breccia_run *breccia_run_create(const breccia_scene *scene, const breccia_options *options)
{
    const breccia_options none = {0}, *o = options ? options : &none;
    breccia_run *run = scene ? calloc(1, sizeof *run) : NULL;
    if (!run) return NULL;
    *run = (breccia_run){.context = brc_context_create(),
                         .scene = scene,
                         .device = copy_of(o->device),
                         .folder = copy_of(o->folder),
                         .threads = o->threads,
                         .exact = o->exact,
                         .resume = o->resume,
                         .told_stage = -1};
    snprintf(run->precision, sizeof run->precision, "%s", o->precision ? o->precision : "double");
    if (run->context && (run->device || !o->device) && (run->folder || !o->folder)) {
        brc_log_set_level(run->context, BRC_LOG_WARNING);
        brc_log_set_sink(run->context, pass_line, run);
        pthread_mutex_init(&run->hand.mutex, NULL);
        pthread_cond_init(&run->hand.changed, NULL);
        return run;
    }
    brc_context_free(&run->context);
    free(run->device);
    free(run->folder);
    free(run);
    return NULL;
}

void breccia_run_free(breccia_run *run)
{
    if (!run) return;
    brc_hand_close(run);
    pthread_mutex_destroy(&run->hand.mutex);
    pthread_cond_destroy(&run->hand.changed);
    brc_run_results_free(&run->results);
    brc_context_free(&run->context);
    free(run->device);
    free(run->folder);
    free(run);
}

breccia_status breccia_run_observe(breccia_run *run, const breccia_observer *observer)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (run->begun) return refuse(run, "the run has begun; observers come before");
    if (run->n_observers == BRC_LIBRARY_OBSERVERS)
        return refuse(run, "there are 32 observers already; let one of them do the work of several");
    if (!observer->look || observer->every_steps < 0 || !(observer->every_seconds >= 0))
        return refuse(run, "an observer needs `look`, and steps and seconds that are not below 0");
    run->observers[run->n_observers++] = *observer;
    return BRECCIA_OK;
}

breccia_status breccia_run_progress(breccia_run *run, double every,
                                    breccia_answer (*told)(void *self, const breccia_moment *moment), void *self)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (run->begun) return refuse(run, "the run has begun; ask for its progress before");
    run->told = told;
    run->told_self = self;
    run->told_every = every;
    return BRECCIA_OK;
}

breccia_status breccia_run_log(breccia_run *run, int level, void (*line)(void *self, int level, const char *text),
                               void *self)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (level < BRC_LOG_ERROR || level > BRC_LOG_DEBUG)
        return refuse(run, "levels of the log are 0 (errors) to 3 (all)");
    run->line = line;
    run->line_self = self;
    brc_log_set_level(run->context, (brc_log_level)level);
    return BRECCIA_OK;
}

void breccia_run_interrupt(breccia_run *run)
{
    if (run) run->asked_to_stop = true; /* heard at every pause and iteration */
}

const char *breccia_run_message(const breccia_run *run)
{
    return run ? brc_context_message(run->context) : "out of memory";
}

/* ---- where it stands ---- */

breccia_moment brc_library_moment(const breccia_run *run)
{
    const brc_simulation *s = run->assembly.part[0];
    const brc_scene *scene = run->assembly.scene;
    const int32_t at = brc_simulation_stage(s), stage = at < 0 ? 0 : at;
    const bool dynamic = scene->stages[stage].solver == BRC_SOLVER_DYNAMIC;
    const double dt = dynamic ? brc_simulation_time_step(s).value : 0, now = brc_clock_s();
    breccia_moment m = {.stage = stage,
                        .n_stages = scene->n_stages,
                        .stage_name = scene->stages[stage].name,
                        .step = brc_simulation_step(s),
                        .total_steps = brc_simulation_total_steps(s),
                        .time = brc_simulation_time(s),
                        .total_time = brc_simulation_total_time(s),
                        .time_step = dt,
                        .seconds = now - run->begin,
                        .seconds_left = NAN};
    m.planned = scene->stages[stage].most_events > 0 ? scene->stages[stage].most_events
                                                     : brc_simulation_planned_steps(s, stage, dt);
    const int64_t made = m.step - run->stage_first;
    if (made > 0) m.seconds_left = (now - run->stage_begin) * (double)(m.planned - m.step) / (double)made;
    return m;
}

breccia_status breccia_run_moment(const breccia_run *run, breccia_moment *out)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (run->assembly.n == 0) return BRECCIA_BAD_INPUT;
    *out = brc_library_moment(run);
    return BRECCIA_OK;
}

bool brc_library_tell(breccia_run *run)
{
    const double now = brc_clock_s();
    if (!run->told || run->assembly.n == 0 || now - run->told_at < run->told_every) return run->asked_to_stop;
    const breccia_moment moment = brc_library_moment(run);
    if (run->told(run->told_self, &moment) == BRECCIA_STOP) run->asked_to_stop = true;
    run->told_at = brc_clock_s(); /* what the caller takes for it is no time that passed */
    return run->asked_to_stop;
}

/* ---- the run's own observer ---- */

/* The first step after `step` at which one of the caller's observers looks. */
static int64_t next_of(const breccia_observer *o, double dt, int64_t step)
{
    int64_t next = INT64_MAX;
    if (o->every_steps > 0) next = step < 0 ? 0 : (step / o->every_steps + 1) * o->every_steps;
    if (o->every_seconds > 0 && dt > 0) {
        const double k = step < 0 ? 0 : floor((double)step * dt / o->every_seconds + 1e-9) + 1;
        int64_t at = (int64_t)ceil(k * o->every_seconds / dt - 1e-9);
        if (at <= step) at = step + 1;
        if (at < next) next = at;
    }
    return next;
}

static double step_of(const brc_simulation *s)
{
    const bool dynamic = brc_simulation_scene(s)->stages[brc_simulation_stage(s)].solver == BRC_SOLVER_DYNAMIC;
    return dynamic ? brc_simulation_time_step(s).value : 0;
}

static int64_t next_look(void *self, const brc_simulation *s, int64_t step)
{
    const breccia_run *run = self;
    int64_t next = brc_hand_next(run, step);
    const double dt = step_of(s);
    for (int k = 0; k < run->n_observers; ++k) {
        const int64_t one = next_of(&run->observers[k], dt, step);
        if (one < next) next = one;
    }
    return next;
}

static void obey(breccia_run *run, brc_simulation *s, breccia_answer answer)
{
    if (answer == BRECCIA_END_STAGE) brc_simulation_end_stage(s, "an observer ends it");
    if (answer == BRECCIA_STOP) run->asked_to_stop = true;
    if (run->asked_to_stop) brc_simulation_interrupt(s);
}

static bool looks_at(const breccia_observer *o, const brc_simulation *s, int64_t step)
{
    return next_of(o, step_of(s), step - 1) == step;
}

/* Those who wanted this step, unless they have looked at it; at_end: those who look at the end of a stage. */
static void ask_observers(breccia_run *run, brc_simulation *s, bool at_end)
{
    const int64_t step = brc_simulation_step(s);
    const int32_t stage = brc_simulation_stage(s);
    const bool told = run->told_stage == stage && run->told_step == step;
    const breccia_moment moment = brc_library_moment(run);
    for (int k = 0; k < run->n_observers; ++k) {
        const breccia_observer *o = &run->observers[k];
        const bool by_step = looks_at(o, s, step);
        if (at_end ? o->stage_ends && !(told && by_step) : by_step && !told)
            obey(run, s, o->look(o->self, run, &moment));
    }
    run->told_stage = stage;
    run->told_step = step;
}

static brc_status stage_begin(void *self, brc_simulation *s, int32_t stage)
{
    breccia_run *run = self;
    (void)stage;
    run->stage_begin = brc_clock_s();
    run->stage_first = brc_simulation_step(s);
    if (run->asked_to_stop) brc_simulation_interrupt(s);
    ask_observers(run, s, false);
    return brc_hand_stage_begin(run);
}

static brc_status look(void *self, brc_simulation *s)
{
    breccia_run *run = self;
    ask_observers(run, s, false);
    return brc_hand_look(run);
}

static brc_status pause(void *self, brc_simulation *s, brc_pause why)
{
    breccia_run *run = self;
    (void)why;
    if (run->hand.begun ? run->asked_to_stop : brc_library_tell(run)) brc_simulation_interrupt(s);
    return BRC_OK;
}

static brc_status stage_end(void *self, brc_simulation *s, int32_t stage)
{
    breccia_run *run = self;
    (void)stage;
    ask_observers(run, s, true);
    brc_hand_stage_end(run, brc_simulation_step(s));
    if (run->asked_to_stop)
        return BRC_FAIL(run->context, BRC_INTERRUPTED, "the run was asked to stop as stage '%s' ended",
                        brc_simulation_scene(s)->stages[stage].name);
    return BRC_OK;
}

/* Asked in every iteration of a solve; it never ends one as if it had converged. */
static bool hear_iteration(void *self)
{
    breccia_run *run = self;
    if ((run->hand.begun ? run->asked_to_stop : brc_library_tell(run)) && run->running)
        brc_simulation_interrupt(run->running);
    return false;
}

static brc_status assembled(void *self, const brc_assembly *assembly)
{
    enum { BATCH = 256 }; /* as host/solver/run/dynamics.c has without budget */
    breccia_run *run = self;
    run->assembly = *assembly;
    run->budget = (brc_trial_budget){.self = run, .over = hear_iteration, .batch = BATCH};
    for (int32_t k = 0; k < assembly->n; ++k)
        brc_simulation_set_trial_budget(assembly->part[k], &run->budget);
    return BRC_OK;
}

static brc_status finished(void *self, brc_simulation *simulation)
{
    (void)simulation;
    brc_hand_finished(self);
    return BRC_OK;
}

static brc_status created(void *self, brc_simulation *simulation)
{
    breccia_run *run = self;
    run->running = simulation;
    run->stage_begin = brc_clock_s();
    run->stage_first = brc_simulation_step(simulation);
    if (run->resume) BRC_TRY(brc_hand_stage_begin(run)); /* taken up within a stage */
    if (run->asked_to_stop) return BRC_FAIL(run->context, BRC_INTERRUPTED, "the run was asked to stop before it began");
    return BRC_OK;
}

static void released(void *self)
{
    breccia_run *run = self;
    brc_assembly_sensors_free(&run->sensors);
    for (int k = 0; k < run->n_copies; ++k)
        brc_memory_free(run->copies[k].data);
    run->n_copies = 0;
    pthread_mutex_lock(&run->hand.mutex); /* the caller may be looking where it stands */
    run->running = NULL;
    run->assembly.n = 0;
    pthread_mutex_unlock(&run->hand.mutex);
}

brc_status brc_library_run(breccia_run *run)
{
    const breccia_scene *scene = run->scene;
    const brc_observer own = {.self = run,
                              .stage_begin = stage_begin,
                              .stage_end = stage_end,
                              .pause = pause,
                              .next_look = next_look,
                              .look = look};
    brc_run_request request = {.path = scene->name,
                               .text = scene->text,
                               .text_bytes = scene->bytes,
                               .n_overrides = scene->n_set,
                               .overrides = (const char *const *)scene->set,
                               .folder = run->folder,
                               .device = run->device,
                               .n_threads = run->threads,
                               .exact = run->exact,
                               .resume = run->resume,
                               .observer = &own,
                               .assembled = assembled,
                               .created = created,
                               .finished = finished,
                               .released = released,
                               .self = run};
    run->begin = brc_clock_s();
    BRC_TRY(brc_library_precision(run->context, run->precision, &request.precision));
    return brc_run_scene(run->context, &request, &run->results);
}

breccia_status breccia_run_go(breccia_run *run)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (run->ended) return refuse(run, "the run has ended; create another one");
    if (run->begun && !run->hand.begun) return refuse(run, "the run goes on already");
    if (run->scene->status != BRC_OK) return refuse(run, "the scene has errors; see breccia_scene_problems");
    if (run->hand.begun) {
        int64_t done;
        const breccia_status status = breccia_run_step(run, INT64_MAX, &done);
        return status == BRECCIA_OK ? breccia_run_end(run) : status;
    }
    run->begun = true;
    const brc_status status = brc_library_run(run);
    run->ended = true;
    return brc_public_status(status);
}

/* ---- after the end ---- */

const char *breccia_run_file(const breccia_run *run, const char *name)
{
    for (int k = 0; run && k < BRC_RUN_FILES; ++k)
        if (strcmp(name, brc_run_file_name(k)) == 0) return run->results.file[k];
    return NULL;
}

int breccia_run_measure_count(const breccia_run *run)
{
    return run ? run->results.n_measures : 0;
}

breccia_status breccia_run_measure(const breccia_run *run, int k, breccia_measure *out)
{
    if (!run || k < 0 || k >= run->results.n_measures) return BRECCIA_BAD_INPUT;
    const brc_run_measure *m = &run->results.measures[k];
    *out = (breccia_measure){.name = m->name,
                             .unit = m->unit,
                             .why_not = m->why_not,
                             .value = m->value,
                             .has_target = m->has_target,
                             .target = m->target,
                             .error = m->error};
    return BRECCIA_OK;
}

breccia_status breccia_run_report(const breccia_run *run, breccia_report *out)
{
    if (!run || !run->ended) return BRECCIA_BAD_INPUT;
    const brc_run_results *r = &run->results;
    *out = (breccia_report){.n_elements = r->n_elements,
                            .n_bonds = r->n_bonds,
                            .steps = r->steps,
                            .device_bytes = r->device_bytes,
                            .build_seconds = r->build_s,
                            .setup_seconds = r->setup_s,
                            .steps_seconds = r->steps_s,
                            .output_seconds = r->output_s,
                            .total_seconds = r->total_s,
                            .device = r->device,
                            .device_name = r->device_name};
    return BRECCIA_OK;
}
