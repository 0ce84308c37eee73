/* Explicit time stepping: velocity Verlet and Tchamwa-Wielgosz. */
#include "../core/awake.h"
#include "look.h"
#include "motion.h"
#include "run_internal.h"
#include "stage_end.h"
#include <math.h>
#include <stdio.h>

enum { SAMPLES = 500, BATCH = 256 };
/* Samples this far apart or further have a ledger each, a hundredth of the steps between them; nearer ones only where
 * something is judged by it. */
enum { LEDGER_APART = 128 };

static brc_status open_step(brc_simulation *s, double dt)
{
    return brc_hook_run(s, BRC_HOOK_OPEN_STEP,
                        &(brc_occasion){.t = s->run->time, .until = (double)(s->run->step + 1) * dt});
}

/* Positions and forces at the end of the step whose motion has just been done. */
static brc_status close_step(brc_simulation *s, double dt)
{
    s->run->step += 1;
    s->run->total_steps += 1;
    s->run->time = (double)s->run->step * dt;
    BRC_TRY(brc_hook_run(s, BRC_HOOK_PLACE, &(brc_occasion){.t = s->run->time}));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_MOVED, NULL));
    const brc_step_phase before = brc_phase_within(s, BRC_PHASE_FORCES);
    const bool outer = brc_awake_only(s, true);
    const brc_status status = brc_force_of_state(s, BRC_BOOK_WORK);
    brc_awake_only(s, outer);
    BRC_TRY(status);
    brc_phase_within(s, before);
    return BRC_OK;
}

static brc_status verlet_step(brc_simulation *s, double dt, double kick)
{
    BRC_TRY(open_step(s, dt));
    if (brc_hook_is_due(s, BRC_HOOK_DRAG)) { /* in the middle of the drift: second order */
        BRC_TRY(brc_motion(s, kick, 0.5 * dt));
        BRC_TRY(brc_hook_run(s, BRC_HOOK_DRAG, &(brc_occasion){.dt = dt}));
        BRC_TRY(brc_motion(s, 0, 0.5 * dt));
    } else {
        BRC_TRY(brc_motion(s, kick, dt));
    }
    BRC_TRY(close_step(s, dt));
    return brc_hook_run(s, BRC_HOOK_BREAK, &(brc_occasion){.half_kick = 0.5 * dt});
}

static brc_status tchamwa_step(brc_simulation *s, double phi, double dt)
{
    BRC_TRY(open_step(s, dt));
    BRC_TRY(brc_motion_tchamwa(s, phi, dt));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_DRAG, &(brc_occasion){.dt = dt}));
    BRC_TRY(close_step(s, dt));
    BRC_TRY(BRC_RUN(s->run->pass.numerical_close, s->layout->n_rows, {"lost", BRC_BUF(brc_lost_numerical_of(s))}));
    /* velocities are at whole steps already */
    return brc_hook_run(s, BRC_HOOK_BREAK, &(brc_occasion){.half_kick = 0});
}

static brc_status take_steps(brc_simulation *s, int64_t n_steps, bool close)
{
    const brc_stage *stage = brc_current_stage(s);
    const double dt = s->run->time_step.value;
    for (int64_t i = 0; i < n_steps; ++i) {
        if (stage->integrator == BRC_TCHAMWA_WIELGOSZ)
            BRC_TRY(tchamwa_step(s, stage->phi, dt));
        else {
            BRC_TRY(verlet_step(s, dt, s->run->open ? dt : 0.5 * dt));
            s->run->open = true;
            if ((close && i + 1 == n_steps) || brc_hook_is_due(s, BRC_HOOK_WHOLE)) BRC_TRY(brc_dynamics_close(s));
        }
        BRC_TRY(brc_hook_run(s, BRC_HOOK_WHOLE, NULL));
    }
    return BRC_OK;
}

/* close: velocities are at whole steps when it returns; else a later call goes on from the half step with the same
 * bits. */
static brc_status advance(brc_simulation *s, int64_t n_steps, bool close)
{
    if (n_steps <= 0) return BRC_OK;
    const brc_step_phase before = brc_phase_enter(s, BRC_PHASE_MOTION);
    const brc_effect_ahead *ahead = brc_effects_ahead(s);
    for (int64_t left = n_steps; left > 0;) {
        const int64_t stretch = ahead ? ahead->steps(s, left) : 0, n = stretch > 0 ? stretch : 1;
        bool stands = true;
        if (stretch > 0) BRC_TRY(ahead->begin(s));
        BRC_TRY(take_steps(s, n, close && n == left));
        if (stretch > 0) BRC_TRY(ahead->end(s, &stands));
        if (stands) left -= n;
    }
    brc_phase_enter(s, before);
    return BRC_OK;
}

brc_status brc_dynamics_advance(brc_simulation *s, int64_t n_steps)
{
    return advance(s, n_steps, true);
}

int64_t brc_simulation_planned_steps(const brc_simulation *s, int32_t stage, double time_step)
{
    const brc_stage *plan = s->scene->stages + stage;
    if (plan->solver == BRC_SOLVER_STATIC) return plan->increments > 0 ? plan->increments : 1;
    if (plan->solver == BRC_SOLVER_MODES) return 1;
    if (plan->steps > 0) return plan->steps;
    return time_step > 0 ? (int64_t)ceil(plan->duration / time_step - 1e-9) : 0;
}

static int64_t next_multiple(int64_t step, int64_t every)
{
    return (step / every + 1) * every;
}

/* The same steps for every part, with the looks among them; devices that queue work at the same time. A stage that ends
 * at a look ends there. */
static brc_status advance_all(int32_t n, brc_simulation *const *part, int64_t n_steps)
{
    brc_simulation *s = part[0];
    for (const int64_t end = s->run->step + n_steps; s->run->step < end && !s->run->note[s->run->stage].ended;) {
        const int64_t from = s->run->step, look = brc_look_next(s), until = look < end ? look : end;
        for (int32_t k = 0; k < n; ++k)
            BRC_TRY(advance(part[k], until - from, until == end));
        if (look <= until) BRC_TRY(brc_look_within(n, part, from));
    }
    for (int32_t k = 0; k < n; ++k) {
        brc_phase_enter(part[k], BRC_PHASE_MOTION);
        BRC_TRY(brc_dynamics_close(part[k]));
        BRC_TRY(brc_device_wait(part[k]->device));
        brc_phase_enter(part[k], BRC_PHASE_NONE);
    }
    return BRC_OK;
}

/* Kinetic and elastic energy of all parts together [J] and their broken bonds. */
typedef struct moment {
    double kinetic, elastic;
    int64_t broken;
} moment;

static bool breaks(const brc_simulation *s)
{
    return brc_hook_is_due(s, BRC_HOOK_BROKEN);
}

static brc_status draw_up(int32_t n, brc_simulation *const *part, moment *now)
{
    *now = (moment){0};
    for (int32_t k = 0; k < n; ++k) {
        brc_ledger ledger;
        brc_phase_enter(part[k], BRC_PHASE_LEDGER);
        BRC_TRY(brc_simulation_ledger(part[k], &ledger));
        BRC_TRY(brc_hook_run(part[k], BRC_HOOK_READ, &(brc_occasion){.several = n > 1, .ledger = &ledger}));
        BRC_TRY(brc_hook_run(part[k], BRC_HOOK_BROKEN, &(brc_occasion){.count = &now->broken}));
        now->kinetic += ledger.kinetic;
        now->elastic += ledger.elastic;
        brc_phase_enter(part[k], BRC_PHASE_NONE);
    }
    if (breaks(part[0])) brc_regime_follow(&part[0]->run->regime, now->kinetic, now->elastic, now->broken > 0);
    return BRC_OK;
}

/* What was seen on the device. */
static brc_status read_all(int32_t n, brc_simulation *const *part)
{
    for (int32_t k = 0; k < n; ++k) {
        brc_phase_enter(part[k], BRC_PHASE_LEDGER);
        BRC_TRY(brc_hook_run(part[k], BRC_HOOK_READ, &(brc_occasion){.several = n > 1}));
        brc_phase_enter(part[k], BRC_PHASE_NONE);
    }
    return BRC_OK;
}

/* What the scene lets end the stage: too many broken bonds, or calm for 100 steps. */
static void judge(brc_simulation *s, const moment *now, double n_bonds, int64_t calm_steps)
{
    const brc_stage *stage = brc_current_stage(s);
    char reason[160];
    if (stage->stop_broken > 0 && (double)now->broken > stage->stop_broken * n_bonds) {
        snprintf(reason, sizeof reason, "stop_when_broken: %lld of %.0f bonds are broken, more than %.4g %%",
                 (long long)now->broken, n_bonds, 100 * stage->stop_broken);
        brc_simulation_end_stage(s, reason);
    }
    if (stage->stop_kinetic > 0 && calm_steps >= 100) {
        snprintf(reason, sizeof reason,
                 "stop_kinetic: the kinetic energy has been below %.4g of the elastic for %lld steps",
                 stage->stop_kinetic, (long long)calm_steps);
        brc_simulation_end_stage(s, reason);
    }
}

/* One line on how quick the fracture was, where this stage had some of it. */
static void tell_regime(const brc_simulation *s, const brc_regime *before)
{
    const brc_regime *r = &s->run->regime;
    if (!r->broke || (before->broke && before->peak_elastic == r->peak_elastic)) return;
    brc_log(s->context, BRC_LOG_INFO,
            "fracture is %s: kinetic energy %.3g %% of elastic at the first break, at most %.3g %% until the peak",
            brc_regime_name(r), 100 * r->at_first_break, 100 * fmax(r->until_peak, r->at_peak));
}

/* Steps until the next sample, frame, reading or the end, at most a batch: short batches keep the progress
 * line and signals alive. Where they end depends on the step alone, since every end costs the velocities a rounding: a
 * run that goes on from one of them later is the same run. */
static int64_t next_batch(const brc_simulation *s, int64_t every, int64_t frame_every, int64_t total)
{
    const int64_t step = s->run->step, look = brc_effects_next_reading(s, step);
    int64_t until = next_multiple(step, every);
    if (frame_every && next_multiple(step, frame_every) < until) until = next_multiple(step, frame_every);
    if (look < until) until = look;
    if (until > total) until = total;
    const int64_t most = s->run->budget ? s->run->budget->batch : BATCH;
    return until - step < most ? until - step : most;
}

/* Readings, samples and frames of this step, if it is one of theirs. */
static brc_status observe(int32_t n, brc_simulation *const *part, double n_bonds, int64_t every, int64_t frame_every,
                          int64_t total)
{
    brc_simulation *s = part[0];
    const brc_stage *stage = brc_current_stage(s);
    const bool sampled = s->run->step % every == 0 || s->run->step == total || s->run->note[s->run->stage].ended,
               judged = breaks(s) || stage->stop_kinetic > 0 || stage->stop_broken > 0;
    if (sampled && (judged || every >= LEDGER_APART || s->run->step == total || s->run->note[s->run->stage].ended)) {
        moment now;
        BRC_TRY(draw_up(n, part, &now));
        const bool calm = now.kinetic <= stage->stop_kinetic * now.elastic;
        s->run->calm_steps = calm ? s->run->calm_steps + (s->run->step - s->run->judged_step) : 0;
        s->run->judged_step = s->run->step;
        judge(s, &now, n_bonds, s->run->calm_steps);
    } else if (sampled || brc_effects_next_reading(s, s->run->step - 1) == s->run->step) {
        BRC_TRY(read_all(n, part));
    }
    if (sampled) BRC_TRY(brc_notify_sample(s));
    return frame_every && s->run->step % frame_every == 0 && s->run->step < total && !s->run->note[s->run->stage].ended
               ? brc_notify_frame(s)
               : BRC_OK;
}

brc_status brc_dynamics_run(int32_t n, brc_simulation *const *part, bool resumed)
{
    brc_simulation *s = part[0];
    const brc_stage *stage = brc_current_stage(s);
    const brc_output *output = &s->scene->output;
    const int64_t total = brc_simulation_planned_steps(s, s->run->stage, s->run->time_step.value), first = s->run->step;
    const double dt = s->run->time_step.value;
    int64_t every = output->history_every > 0 ? output->history_every : (total + SAMPLES - 1) / SAMPLES;
    if (every < 1) every = 1;
    int64_t frame_every = output->n_frames > 0         ? total / output->n_frames
                          : output->frame_interval > 0 ? (int64_t)llround(output->frame_interval / dt)
                                                       : 0;
    if (frame_every < 1 && (output->n_frames > 0 || output->frame_interval > 0)) frame_every = 1;
    BRC_ENDS_WITH(brc_progress_finish) brc_progress *progress = NULL;
    double n_bonds = 0;
    for (int32_t k = 0; k < n; ++k)
        n_bonds += (double)part[k]->domain->n_bonds;
    BRC_TRY(brc_progress_create(s->context, &progress, stage->name, total - first, "steps", n_bonds, "bond updates/s"));
    const brc_regime before = s->run->regime;
    for (int32_t k = 0; k < n; ++k)
        BRC_TRY(brc_hook_run(part[k], BRC_HOOK_STEPS, NULL));
    if (!resumed) {
        moment now;
        if (breaks(s)) BRC_TRY(draw_up(n, part, &now));
        BRC_TRY(brc_notify_sample(s));
    }
    while (s->run->step < total && !s->run->note[s->run->stage].ended) {
        BRC_TRY(advance_all(n, part, next_batch(s, every, frame_every, total)));
        brc_progress_update(progress, s->run->step - first);
        BRC_TRY(observe(n, part, n_bonds, every, frame_every, total));
        BRC_TRY(brc_notify_pause(s, brc_simulation_is_to_stop(s)        ? BRC_PAUSE_INTERRUPTED
                                    : s->run->note[s->run->stage].ended ? BRC_PAUSE_ENDED
                                    : s->run->step < total              ? BRC_PAUSE_GOING
                                                                        : BRC_PAUSE_DONE));
        if (brc_simulation_is_to_stop(s))
            return BRC_FAIL(s->context, BRC_INTERRUPTED, "stage '%s' was interrupted at step %lld of %lld", stage->name,
                            (long long)s->run->step, (long long)total);
    }
    tell_regime(s, &before);
    return BRC_OK;
}
