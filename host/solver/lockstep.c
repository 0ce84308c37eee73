/* Running the stages of a scene: one simulation, or one for each of its models with one clock. The first part keeps the clock, is the one that is
 * interrupted, and its observers hear of the whole. */
#include "lockstep.h"
#include "simulation_internal.h"

/* All parts take the shortest of their steps. */
static void share_time_step(int32_t n, brc_simulation *const *part)
{
    const brc_time_step *least = &part[0]->time_step;
    for (int32_t k = 1; k < n; ++k)
        if (part[k]->time_step.value < least->value) least = &part[k]->time_step;
    const brc_time_step shared = *least;
    for (int32_t k = 0; k < n; ++k) {
        brc_time_step *own = &part[k]->time_step;
        if (!(own->value > shared.value)) continue;
        own->value = shared.value;
        own->safety = shared.value / own->critical;
        own->governed_by = shared.governed_by;
    }
}

brc_status brc_lockstep_begin_stage(int32_t n, brc_simulation *const *part, int32_t stage)
{
    for (int32_t k = 0; k < n; ++k) BRC_TRY(brc_stage_enter(part[k], stage));
    if (brc_current_stage(part[0])->solver == BRC_SOLVER_DYNAMIC) share_time_step(n, part);
    for (int32_t k = 0; k < n; ++k) BRC_TRY(brc_stage_start(part[k]));
    return BRC_OK;
}

static brc_status run_stage(int32_t n, brc_simulation *const *part)
{
    switch (brc_current_stage(part[0])->solver) {
    case BRC_SOLVER_STATIC: return brc_statics_run(n, part);
    case BRC_SOLVER_DYNAMIC: return brc_dynamics_run(n, part);
    case BRC_SOLVER_MODES: break;
    }
    for (int32_t k = 0; k < n; ++k) BRC_TRY(brc_modes_run(part[k]));
    return brc_notify_sample(part[0]);
}

static brc_status run_stages(int32_t n, brc_simulation *const *part)
{
    brc_simulation *first = part[0];
    const bool frames = first->scene->output.n_frames >= 0;
    for (int32_t i = 0; i < first->scene->n_stages; ++i) {
        BRC_TRY(brc_lockstep_begin_stage(n, part, i));
        for (int k = 0; k < first->n_observers; ++k)
            if (first->observers[k].stage_begin) BRC_TRY(first->observers[k].stage_begin(first->observers[k].self, first, i));
        if (i == 0 && frames) BRC_TRY(brc_notify_frame(first));
        const double start = brc_clock_s();
        const brc_status status = run_stage(n, part);
        first->step_seconds += brc_clock_s() - start;
        BRC_TRY(status);
        if (frames) BRC_TRY(brc_notify_frame(first));
        for (int k = 0; k < first->n_observers; ++k)
            if (first->observers[k].stage_end) BRC_TRY(first->observers[k].stage_end(first->observers[k].self, first, i));
    }
    return BRC_OK;
}

brc_status brc_lockstep_run(int32_t n, brc_simulation *const *part)
{
    part[0]->others = part + 1;
    part[0]->n_others = n - 1;
    const brc_status status = run_stages(n, part);
    part[0]->n_others = 0;
    return status;
}

brc_status brc_simulation_run(brc_simulation *s) { return brc_lockstep_run(1, &s); }
