/* A static stage: its increments, or its events. */
#include "statics_internal.h"
#include "../run/look.h"
#include "settling.h"
#include "static_events.h"
#include <math.h>
#include <string.h>

/* Start from the last move again, `share` times as far: exact when the answer is proportional to the load, so that a
 * stage of equal increments costs little more than one. v->before holds the displacement before the last move on entry,
 * before this one on return. share: 0: no move before. */
static brc_status predict(brc_simulation *s, brc_solve_vectors *v, double share)
{
    const int64_t bytes = 3 * (int64_t)s->layout->n_rows * v->state_bytes;
    const brc_unknowns state = {brc_displacement_of(s), NULL};
    if (v->kept) BRC_TRY(brc_buffer_copy(v->kept, brc_orientation_of(s), brc_buffer_bytes(v->kept)));
    if (!(share > 0) || brc_solves_rotations(s->model))
        return brc_buffer_copy(v->before, brc_displacement_of(s), bytes);
    BRC_TRY(brc_buffer_copy(v->z.move, brc_displacement_of(s), bytes)); /* u becomes u + share (u - before) */
    BRC_TRY(brc_unknowns_add(s, -1, (brc_unknowns){v->before, NULL}, state));
    BRC_TRY(brc_unknowns_scale_add(s, (brc_unknowns){v->z.move, NULL}, share, state));
    return brc_buffer_copy(v->before, v->z.move, bytes);
}

/* Back to the state that was predicted from. */
static brc_status go_back(brc_simulation *s, brc_solve_vectors *v)
{
    BRC_TRY(brc_buffer_copy(brc_displacement_of(s), v->before, brc_buffer_bytes(v->before)));
    return v->kept ? brc_buffer_copy(brc_orientation_of(s), v->kept, brc_buffer_bytes(v->kept)) : BRC_OK;
}

/* Equilibrium at the load factor `to`, from that at `from`. Where none is found though the tangent was asked, the way
 * is gone in parts, each half of one that failed, down to a 64th of it. An increment that took parts leaves no move to
 * go on from. */
static brc_status reach(brc_simulation *s, brc_static_run *run, double from, double to, bool moved,
                        brc_progress *progress)
{
    enum { MOST_PARTS = 64 };
    brc_solve_vectors *v = &run->vectors;
    double at = from, part = to - from, last = moved ? part : 0;
    bool in_parts = false;
    for (;;) {
        const bool is_last = at + 1.000001 * part >= to;
        const double reference = run->reference;
        brc_clock_set_load(s, is_last ? to : at + part);
        BRC_TRY(predict(s, v, last > 0 ? part / last : 0));
        const brc_status status = brc_statics_solve_at(s, run, progress);
        if (status == BRC_OK && (is_last || brc_simulation_stopped_early(s))) break;
        if (status == BRC_OK) {
            at += part, last = part;
            continue;
        }
        if (status != BRC_PHYSICS_STOPPED || !v->tangent || part * MOST_PARTS < 1.5 * (to - from)) return status;
        brc_context_clear(s->context);
        brc_log(s->context, BRC_LOG_INFO, "stage '%s': no equilibrium at load factor %.6g at once; in smaller parts",
                brc_current_stage(s)->name, is_last ? to : at + part);
        BRC_TRY(go_back(s, v));
        run->reference = reference;
        part /= 2, last = 0, in_parts = true;
    }
    return in_parts ? brc_buffer_copy(v->before, brc_displacement_of(s), brc_buffer_bytes(v->before)) : BRC_OK;
}

/* The first equilibrium of a stage, from what may be out of balance. */
static brc_status reach_first(brc_simulation *s, brc_static_run *run, double to, brc_progress *progress)
{
    BRC_ENDS_WITH(brc_settling_free) brc_settling settling = {0};
    BRC_TRY(brc_settling_begin(s, &run->vectors, &settling));
    BRC_TRY(reach(s, run, 0, to, false, progress));
    return brc_settling_end(s, &settling);
}

/* Times what load the ratio of failure comes to `asked`, by load and ratio now and before (0: none): in proportion; in
 * gravity, which is there whatever the load, along the line through both. */
static double scaling(bool weighs, double asked, const double before[2], const double now[2])
{
    if (!weighs || !(before[0] > 0)) return asked / now[1];
    return 1 + (asked - now[1]) * (1 - before[0] / now[0]) / (now[1] - before[1]);
}

static brc_status refuse_weight(brc_context *context, const brc_stage *stage, const double now[2])
{
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "stage '%s': to_failure scales the loads of the stage and not gravity: at %.4g times them the "
                    "worst element is at %.4g of its limit, and no load brings it to %.4g; use a smaller gravity, a "
                    "load that breaks the body, or a dynamic stage",
                    stage->name, now[0], now[1], stage->to_failure);
}

/* Scale the load so that the worst element of all parts is at the asked fraction of its limit: in proportion, and again
 * from where that led, since limits see strains of second order, which do not grow as the load. */
static brc_status go_to_failure(int32_t n, brc_simulation *const *part, brc_static_run *run, brc_progress *progress)
{
    enum { MOST_SCALINGS = 12 };
    static const double near = 1e-6, /* of the fraction asked for: below what any strength is known to */
        most_at_once = 1e3;          /* along a line: of loads that do not matter */
    brc_context *context = part[0]->context;
    const brc_stage *stage = brc_current_stage(part[0]);
    double ratio, before[2] = {0, 0};
    BRC_TRY(brc_statics_failure(n, part, &ratio));
    if (!(ratio > 0))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "stage '%s': under its load no element comes nearer to failure, so to_failure cannot scale it",
                        stage->name);
    for (int i = 0; i < MOST_SCALINGS && !(fabs(ratio / stage->to_failure - 1) <= near); ++i) {
        const double now[2] = {brc_loads_time(part[0]), ratio},
                     by = scaling(part[0]->scene->has_gravity, stage->to_failure, before, now);
        if (!(by > 0) || (before[0] > 0 && part[0]->scene->has_gravity && by > most_at_once))
            return refuse_weight(context, stage, now);
        memcpy(before, now, sizeof before);
        for (int32_t k = 0; k < n; ++k) {
            BRC_TRY(brc_statics_scale(part[k], &run[k].vectors, by));
            brc_clock_set_load(part[k], brc_loads_time(part[k]) * by);
            BRC_TRY(brc_statics_solve_at(part[k], &run[k], progress));
        }
        BRC_TRY(brc_statics_failure(n, part, &ratio));
        if (!(ratio > 0))
            return BRC_FAIL(context, BRC_PHYSICS_STOPPED, "stage '%s': the failure ratio is %g at %g times the load",
                            stage->name, ratio, brc_loads_time(part[0]));
    }
    for (int32_t k = 0; k < n; ++k)
        brc_clock_set_step(part[k], brc_simulation_step(part[k]) + 1);
    brc_log(context, BRC_LOG_INFO,
            "stage '%s': the load is scaled to %.6g, where the worst element is at %.6g of its limit", stage->name,
            brc_loads_time(part[0]), ratio);
    BRC_TRY(brc_look_here(part[0], brc_simulation_step(part[0]) - 1));
    return brc_notify_sample(part[0]);
}

/* What a resumed stage needs beside the state: the displacements before the last increment, for the guess of the
 * next, and how its solves go. */
brc_status brc_statics_store_stage(brc_simulation *s, brc_state_store *store)
{
    brc_static_run *run = s->statics->stage;
    if (!run) return BRC_OK;
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_solve_fields, .owner = &run->vectors}));
    BRC_TRY(brc_preconditioner_store(s, &run->vectors.preconditioner, store));
    BRC_TRY(brc_store_flag(store, "static.tangent", &run->vectors.tangent));
    return brc_store_double(store, "static.reference", &run->reference);
}

/* Vectors of the solver for every part; a stage that begins is at rest. */
static brc_status begin_runs(int32_t n, brc_simulation *const *part, brc_static_run *run, brc_state_store *resumed)
{
    for (int32_t k = 0; k < n; ++k) {
        brc_simulation *s = part[k];
        if (!resumed) {
            brc_ledger before;
            s->statics->report = (brc_static_report){0};
            BRC_TRY(brc_simulation_ledger(s, &before));
            s->statics->released += before.kinetic;
            BRC_TRY(brc_buffer_fill_zero(brc_velocity_of(s)));
            if (s->model->turns) BRC_TRY(brc_buffer_fill_zero(brc_spin_of(s)));
        }
        BRC_TRY(brc_solve_vectors_create(s, &run[k].vectors));
        s->statics->stage = &run[k];
        if (!resumed) continue;
        resumed->part = k;
        BRC_TRY(brc_statics_store_stage(s, resumed));
    }
    return BRC_OK;
}

/* The run may be left and taken up again after any increment; the one that scales the load to failure counts as one
 * more. */
static brc_status tell_pause(brc_simulation *s, int32_t increments)
{
    const brc_stage *stage = brc_current_stage(s);
    const bool done = brc_simulation_step(s) >= increments + (stage->to_failure > 0);
    const bool ended = brc_stage_has_ended(s);
    BRC_TRY(brc_notify_pause(s, brc_simulation_is_to_stop(s) ? BRC_PAUSE_INTERRUPTED
                                : ended                      ? BRC_PAUSE_ENDED
                                : done                       ? BRC_PAUSE_DONE
                                                             : BRC_PAUSE_GOING));
    if (!brc_simulation_is_to_stop(s)) return BRC_OK;
    return BRC_FAIL(s->context, BRC_INTERRUPTED, "stage '%s' was interrupted after increment %lld of %d", stage->name,
                    (long long)brc_simulation_step(s), (int)increments);
}

static brc_status run_increments(int32_t n, brc_simulation *const *part, brc_static_run *run, brc_progress *progress)
{
    const brc_stage *stage = brc_current_stage(part[0]);
    const int32_t increments = stage->increments > 0 ? stage->increments : 1;
    for (int32_t i = (int32_t)brc_simulation_step(part[0]) + 1; i <= increments && !brc_stage_has_ended(part[0]); ++i) {
        for (int32_t k = 0; k < n; ++k) { /* one after the other: they share the device's memory and threads */
            if (i == 1)
                BRC_TRY(reach_first(part[k], &run[k], 1.0 / increments, progress));
            else
                BRC_TRY(reach(part[k], &run[k], (double)(i - 1) / increments, (double)i / increments, true, progress));
            brc_clock_set_step(part[k], i);
        }
        BRC_TRY(brc_look_here(part[0], i - 1));
        BRC_TRY(brc_notify_sample(part[0]));
        BRC_TRY(tell_pause(part[0], increments));
    }
    if (!(stage->to_failure > 0) || brc_simulation_step(part[0]) > increments || brc_stage_has_ended(part[0]))
        return BRC_OK;
    BRC_TRY(go_to_failure(n, part, run, progress));
    return tell_pause(part[0], increments);
}

brc_status brc_statics_run(int32_t n, brc_simulation *const *part, brc_state_store *resumed)
{
    brc_context *context = part[0]->context;
    const brc_stage *stage = brc_current_stage(part[0]);
    brc_static_run *run = NULL;
    brc_progress *progress = NULL;
    brc_status status = BRC_OK;
    double n_bonds = 0;
    for (int32_t k = 0; k < n; ++k)
        if (!part[k]->model->statics)
            return BRC_FAIL(context, BRC_BAD_INPUT, "stage '%s': model %s has no static stages; use a dynamic one",
                            stage->name, brc_model_name(part[k]->scene->model.kind));
    if (stage->most_events > 0) BRC_TRY(brc_statics_refuse_unscalable(n, part, "events"));
    if (stage->to_failure > 0) BRC_TRY(brc_statics_refuse_unscalable(n, part, "to_failure"));
    for (int32_t k = 0; k < n; ++k)
        n_bonds += (double)part[k]->domain->n_bonds;
    BRC_TRY_OR(cleanup,
               brc_progress_create(context, &progress, stage->name, 0, "iterations", n_bonds / n, "bond updates/s"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &run, n, "static stage"));
    BRC_TRY_OR(cleanup, begin_runs(n, part, run, resumed));
    if (!resumed) BRC_TRY_OR(cleanup, brc_notify_sample(part[0]));
    status =
        stage->most_events > 0 ? brc_static_events_run(n, part, run, progress) : run_increments(n, part, run, progress);
cleanup:
    brc_progress_finish(&progress);
    for (int32_t k = 0; k < n; ++k)
        part[k]->statics->stage = NULL;
    for (int32_t k = 0; run && k < n; ++k)
        brc_solve_vectors_free(&run[k].vectors);
    brc_memory_free(run);
    return status;
}
