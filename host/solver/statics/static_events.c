/* The order of failures of a body that is loaded so slowly that nothing moves. */
#include "static_events.h"
#include "settling.h"
#include "../effects/fracture/breaking.h"
#include "../effects/loads/loads.h"
#include "../run/look.h"
#include "../run/stage_end.h"
#include <math.h>
#include <stdio.h>

enum { MOST_SCALINGS = 60 };
static const double widest_margin = 1e-3;

typedef struct events {
    brc_context *context;
    const brc_stage *stage;
    int32_t n;
    brc_simulation *const *part;
    brc_static_run *run;
    brc_progress *progress;
    double margin;       /* elements within this of their limit fail together [-] */
    double nothing;      /* failure ratios below are those of a body that carries nothing: rounding, and pieces that the
                            linear law turned [-] */
    bool moves;          /* some motion is prescribed */
    double largest_load; /* so far [J] or [-] */
} events;

static bool is_motion(const brc_load *load)
{
    if (load->kind == BRC_LOAD_TRACTION || load->kind == BRC_LOAD_PRESSURE || load->kind == BRC_LOAD_ELEMENT_FORCE)
        return false;
    for (int i = 0; i < 3; ++i) {
        if (!load->component[i]) continue;
        if (load->value[i] != 0) return true;
        for (int j = 0; j < 3; ++j)
            if (load->gradient[i][j] != 0) return true;
    }
    return false;
}

static brc_status solve_all(events *v)
{
    for (int32_t k = 0; k < v->n; ++k)
        BRC_TRY(brc_statics_solve_at(v->part[k], &v->run[k], v->progress));
    return BRC_OK;
}

/* The state of all parts in proportion to the load; solved again where that is not the answer. */
static brc_status scale_all(events *v, double factor, bool solve)
{
    for (int32_t k = 0; k < v->n; ++k) {
        brc_simulation *s = v->part[k];
        BRC_TRY(brc_statics_scale(s, &v->run[k].vectors, factor));
        brc_clock_set_load(s, brc_loads_time(s) * factor);
        if (solve)
            BRC_TRY(brc_statics_solve_at(s, &v->run[k], v->progress));
        else {
            BRC_TRY(brc_loads_prescribe(s, brc_loads_time(s)));
            BRC_TRY(brc_force_of_state(s, BRC_BOOK_WORK));
        }
    }
    return BRC_OK;
}

/* To the load at which the worst element is past its limit by half the margin. carries: false where nothing is left
 * that a load could break. The ratio grows as the load, or as a power of it where pieces that hang on by little turn
 * far: the power is that of the last step. */
static brc_status go_to_next(events *v, bool *carries)
{
    /* A change this small is strain squared away from an equilibrium of the full law: less than any tolerance. */
    static const double small = 1e-7;
    const double target = 1 + 0.5 * v->margin;
    const double most = v->stage->finite_strain ? 3 : 1e3; /* the full law is followed in steps */
    double ratio, power = 1;
    BRC_TRY(brc_statics_failure(v->n, v->part, &ratio));
    *carries = ratio > v->nothing;
    for (int i = 0; *carries && i < MOST_SCALINGS && !(fabs(ratio - target) <= 0.5 * v->margin); ++i) {
        const double factor = fmin(fmax(pow(target / ratio, 1 / power), 1 / most), most), before = ratio;
        BRC_TRY(scale_all(v, factor, v->stage->finite_strain && fabs(factor - 1) > small));
        BRC_TRY(brc_statics_failure(v->n, v->part, &ratio));
        *carries = ratio > v->nothing;
        if (fabs(factor - 1) > small) power = fmin(fmax(log(ratio / before) / log(factor), 0.5), 4);
    }
    return isfinite(ratio)
               ? BRC_OK
               : BRC_FAIL(v->context, BRC_PHYSICS_STOPPED, "stage '%s': a failure ratio is not finite", v->stage->name);
}

static brc_status load_of(events *v, double *load)
{
    double energy = 0;
    *load = brc_loads_time(v->part[0]);
    if (!v->moves) return BRC_OK;
    for (int32_t k = 0; k < v->n; ++k) {
        brc_ledger ledger;
        BRC_TRY(brc_simulation_ledger(v->part[k], &ledger));
        energy += ledger.elastic + ledger.stabilisation;
    }
    *load = 2 * energy / *load;
    return BRC_OK;
}

static brc_status count_broken(const events *v, int64_t *out)
{
    *out = 0;
    for (int32_t k = 0; k < v->n; ++k) {
        int64_t one;
        BRC_TRY(brc_simulation_broken(v->part[k], &one));
        *out += one;
    }
    return BRC_OK;
}

/* Bonds of the elements at their limit; a margin that rounding hides is made wider. */
static brc_status break_next(events *v)
{
    int64_t before, after;
    bool carries;
    BRC_TRY(count_broken(v, &before));
    for (int32_t k = 0; k < v->n; ++k)
        BRC_TRY(brc_fracture_begin_event(v->part[k]));
    for (;; v->margin *= 10) {
        for (int32_t k = 0; k < v->n; ++k)
            BRC_TRY(brc_fracture_step(v->part[k], 0));
        BRC_TRY(count_broken(v, &after));
        if (after > before) return BRC_OK;
        if (v->margin > widest_margin)
            return BRC_FAIL(v->context, BRC_INTERNAL,
                            "stage '%s': no bond breaks at the load factor %.9g where one fails", v->stage->name,
                            brc_loads_time(v->part[0]));
        BRC_TRY(go_to_next(v, &carries));
    }
}

/* What the ledger's terms must keep: all but what relaxing sets free. */
static double balance(const brc_ledger *l)
{
    return l->total - l->work + l->damping + l->fracture;
}

static brc_status unload(events *v)
{
    brc_context_clear(v->context);
    for (int32_t k = 0; k < v->n; ++k) {
        brc_simulation *s = v->part[k];
        BRC_TRY(brc_statics_scale(s, &v->run[k].vectors, 0));
        brc_clock_set_load(s, 0);
        BRC_TRY(brc_loads_prescribe(s, 0));
        BRC_TRY(brc_force_of_state(s, BRC_BOOK_START));
    }
    return BRC_OK;
}

/* Pieces that nothing holds are far from balance; what is near it is a solve that does not get further. */
static brc_status come_apart(events *v)
{
    static const double stalled = 1e-6; /* residual over load */
    char reason[200] = "the body came apart: what is left has no equilibrium under load";
    double worst = 0;
    for (int32_t k = 0; k < v->n; ++k)
        worst = fmax(worst, v->part[k]->statics->report.residual);
    if (worst < stalled)
        snprintf(reason, sizeof reason,
                 "the solve of the next event stalls at a residual of %.3g of the load, asked %.3g: relax `tolerance`, "
                 "or hold what moves freely",
                 worst, brc_statics_tolerance(v->part[0]));
    BRC_TRY(unload(v));
    brc_simulation_end_stage(v->part[0], reason);
    return BRC_OK;
}

/* No equilibrium at the load of the last event: what is left may stand under a share of it. Where nothing holds a piece
 * that a dead load pulls away there is none under any load, and the pieces are left without. */
static brc_status start_again(events *v)
{
    static const double share = 0.1; /* far above `nothing` */
    const double load = brc_loads_time(v->part[0]);
    BRC_TRY(unload(v));
    for (int32_t k = 0; k < v->n; ++k)
        brc_clock_set_load(v->part[k], share * load);
    const brc_status solved = solve_all(v);
    return solved == BRC_PHYSICS_STOPPED ? come_apart(v) : solved;
}

/* The next bonds break, and what is left comes to rest at the same load. before: [n] room. */
static brc_status do_event(events *v, brc_ledger *before)
{
    for (int32_t k = 0; k < v->n; ++k)
        BRC_TRY(brc_simulation_ledger(v->part[k], &before[k]));
    BRC_TRY(break_next(v));
    for (int32_t k = 0; k < v->n; ++k) {
        brc_clock_set_step(v->part[k], brc_simulation_step(v->part[k]) + 1);
        v->run[k].vectors.preconditioner.bonds_broke = true;
        BRC_TRY(brc_statics_find_pieces(v->part[k], &v->run[k].vectors));
    }
    const brc_status solved = solve_all(v);
    if (solved == BRC_PHYSICS_STOPPED)
        BRC_TRY(start_again(v));
    else
        BRC_TRY(solved);
    for (int32_t k = 0; k < v->n; ++k) {
        brc_ledger after;
        BRC_TRY(brc_simulation_ledger(v->part[k], &after));
        v->part[k]->statics->released += balance(&before[k]) - balance(&after);
    }
    return BRC_OK;
}

/* What ends the stage at the load of the next event. */
static void judge(events *v, double load)
{
    brc_simulation *s = v->part[0];
    char reason[160] = "";
    v->largest_load = fmax(v->largest_load, load);
    if (load < v->stage->stop_load * v->largest_load)
        snprintf(reason, sizeof reason, "events: the load of the next one is %.3g %% of the largest, below %.4g %%",
                 100 * load / v->largest_load, 100 * v->stage->stop_load);
    if (reason[0]) brc_simulation_end_stage(s, reason);
}

/* The run may be left and taken up again after any event. */
static brc_status tell_pause(const events *v)
{
    brc_simulation *s = v->part[0];
    s->statics->margin = v->margin;
    s->statics->largest_load = v->largest_load;
    BRC_TRY(brc_notify_pause(s, brc_simulation_is_to_stop(s) ? BRC_PAUSE_INTERRUPTED : BRC_PAUSE_GOING));
    if (!brc_simulation_is_to_stop(s)) return BRC_OK;
    return BRC_FAIL(v->context, BRC_INTERRUPTED, "stage '%s' was interrupted after event %lld of %d", v->stage->name,
                    (long long)brc_simulation_step(s), (int)v->stage->most_events);
}

/* All of the load at once, from what may be out of balance. */
static brc_status first_equilibrium(events *v)
{
    brc_settling *from = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(v->context, &from, v->n, "unbalanced forces"));
    for (int32_t k = 0; status == BRC_OK && k < v->n; ++k) {
        status = brc_settling_begin(v->part[k], &v->run[k].vectors, &from[k]);
        brc_clock_set_load(v->part[k], 1);
    }
    if (status == BRC_OK) status = solve_all(v);
    for (int32_t k = 0; k < v->n; ++k) {
        if (status == BRC_OK) status = brc_settling_end(v->part[k], &from[k]);
        brc_settling_free(&from[k]);
    }
    brc_memory_free(from);
    return status;
}

brc_status brc_static_events_run(int32_t n, brc_simulation *const *part, brc_static_run *run, brc_progress *progress)
{
    brc_simulation *s = part[0];
    const brc_stage *stage = brc_current_stage(s);
    const int32_t n_frames = s->scene->output.n_frames,
                  frame_every = n_frames > 0 ? (stage->most_events + n_frames - 1) / n_frames : 0;
    const bool is_double = brc_device_get_precision(s->device) == BRC_DOUBLE;
    events v = {.context = s->context, .stage = stage, .n = n, .part = part, .run = run, .progress = progress};
    brc_ledger *before = NULL;
    brc_status status = BRC_OK;
    bool carries;
    const int32_t first = (int32_t)brc_simulation_step(s); /* events that a resumed stage has behind it */
    v.margin = first > 0 ? s->statics->margin : is_double ? 1e-9 : 2e-6;
    v.largest_load = s->statics->largest_load;
    v.nothing = fmax(1e-3, 100 * brc_statics_tolerance(s));
    for (int32_t k = 0; k < n; ++k)
        for (int32_t l = 0; l < brc_current_stage(part[k])->n_loads; ++l)
            v.moves |= is_motion(&brc_current_stage(part[k])->loads[l]);
    BRC_TRY(BRC_ALLOCATE(s->context, &before, n, "events"));
    if (first == 0) BRC_TRY_OR(cleanup, first_equilibrium(&v));
    for (int32_t event = first; !brc_stage_has_ended(s); ++event) {
        double load;
        status = go_to_next(&v, &carries);
        if (status == BRC_PHYSICS_STOPPED && event > 0) { /* too far from the last state to follow it */
            BRC_TRY_OR(cleanup, start_again(&v));
            if (brc_stage_has_ended(s)) break;
            status = go_to_next(&v, &carries);
            if (status == BRC_PHYSICS_STOPPED) {
                status = come_apart(&v);
                break;
            }
        }
        BRC_TRY_OR(cleanup, status);
        if (!carries && event == 0) {
            status = BRC_FAIL(s->context, BRC_BAD_INPUT,
                              "stage '%s': under its load no element comes nearer to failure, so there is no event",
                              stage->name);
            goto cleanup;
        }
        if (!carries) {
            brc_simulation_end_stage(s, "what is left of the body carries no load");
            break;
        }
        BRC_TRY_OR(cleanup, load_of(&v, &load));
        judge(&v, load);
        BRC_TRY_OR(cleanup, brc_look_here(s, brc_simulation_step(s) - 1));
        BRC_TRY_OR(cleanup, brc_notify_sample(s));
        if (event == stage->most_events || brc_stage_has_ended(s)) break;
        BRC_TRY_OR(cleanup, do_event(&v, before));
        if (frame_every > 0 && (event + 1) % frame_every == 0 && event + 1 < stage->most_events)
            BRC_TRY_OR(cleanup, brc_notify_frame(s));
        BRC_TRY_OR(cleanup, tell_pause(&v));
    }
cleanup:
    brc_memory_free(before);
    return status;
}
