/* Running the stages of a scene: one simulation, or one for each of its models with one clock. The first part keeps the
 * clock, is the one that is interrupted, and its observers hear of the whole. */
#include "lockstep.h"
#include "cut_sides.h"
#include "run_internal.h"

/* All parts take the shortest of their steps. */
static void share_time_step(int32_t n, brc_simulation *const *part)
{
    const brc_time_step *least = &part[0]->run->time_step;
    for (int32_t k = 1; k < n; ++k)
        if (part[k]->run->time_step.value < least->value) least = &part[k]->run->time_step;
    const brc_time_step shared = *least;
    for (int32_t k = 0; k < n; ++k) {
        brc_time_step *own = &part[k]->run->time_step;
        if (!(own->value > shared.value)) continue;
        own->value = shared.value;
        own->safety = shared.value / own->critical;
        own->governed_by = shared.governed_by;
    }
}

brc_status brc_lockstep_begin_stage(int32_t n, brc_simulation *const *part, int32_t stage)
{
    for (int32_t k = 0; k < n; ++k)
        BRC_TRY(brc_stage_enter(part[k], stage));
    if (brc_current_stage(part[0])->solver == BRC_SOLVER_DYNAMIC) share_time_step(n, part);
    for (int32_t k = 0; k < n; ++k)
        BRC_TRY(brc_stage_start(part[k]));
    return BRC_OK;
}

/* resumed: NULL where the stage begins. */
static brc_status run_stage(int32_t n, brc_simulation *const *part, brc_state_store *resumed)
{
    switch (brc_current_stage(part[0])->solver) {
    case BRC_SOLVER_STATIC: return brc_statics_run(n, part, resumed);
    case BRC_SOLVER_DYNAMIC: return brc_dynamics_run(n, part, resumed != NULL);
    case BRC_SOLVER_MODES: break;
    }
    for (int32_t k = 0; k < n; ++k)
        BRC_TRY(brc_modes_run(part[k]));
    return brc_notify_sample(part[0]);
}

static brc_status enter(int32_t n, brc_simulation *const *part, int32_t stage, bool frames)
{
    brc_simulation *first = part[0];
    BRC_TRY(brc_lockstep_begin_stage(n, part, stage));
    for (int k = 0; k < first->run->n_observers; ++k)
        if (first->run->observers[k].stage_begin)
            BRC_TRY(first->run->observers[k].stage_begin(first->run->observers[k].self, first, stage));
    return stage == 0 && frames ? brc_notify_frame(first) : BRC_OK;
}

/* All stages, or what is left of them. */
static brc_status run_stages(int32_t n, brc_simulation *const *part, brc_state_store *resumed)
{
    brc_simulation *first = part[0];
    const bool frames = first->scene->output.n_frames >= 0;
    const int32_t begin = resumed ? first->run->stage : 0;
    for (int32_t i = begin; i < first->scene->n_stages; ++i) {
        brc_state_store *own = i == begin ? resumed : NULL;
        if (!own) BRC_TRY(enter(n, part, i, frames));
        const double start = brc_clock_s();
        const brc_status status = run_stage(n, part, own);
        first->run->step_seconds += brc_clock_s() - start;
        BRC_TRY(status);
        for (int32_t k = 0; k < n; ++k)
            BRC_TRY(brc_cut_sides_tell(part[k]));
        if (frames) BRC_TRY(brc_notify_frame(first));
        for (int k = 0; k < first->run->n_observers; ++k)
            if (first->run->observers[k].stage_end)
                BRC_TRY(first->run->observers[k].stage_end(first->run->observers[k].self, first, i));
    }
    return BRC_OK;
}

static brc_status run(int32_t n, brc_simulation *const *part, brc_state_store *resumed)
{
    part[0]->run->others = part + 1;
    part[0]->run->n_others = n - 1;
    const brc_status status = run_stages(n, part, resumed);
    part[0]->run->n_others = 0;
    return status;
}

brc_status brc_lockstep_run(int32_t n, brc_simulation *const *part)
{
    return run(n, part, NULL);
}

brc_status brc_lockstep_save(int32_t n, brc_simulation *const *part, brc_state_store *store)
{
    for (int32_t k = 0; k < n; ++k) {
        store->part = k;
        BRC_TRY(brc_simulation_save_state(part[k], store));
    }
    return BRC_OK;
}

brc_status brc_lockstep_load(int32_t n, brc_simulation *const *part, brc_state_store *store)
{
    for (int32_t k = 0; k < n; ++k) {
        store->part = k;
        BRC_TRY(brc_simulation_load_state(part[k], store));
        if (part[k]->run->stage != part[0]->run->stage || part[k]->run->step != part[0]->run->step)
            return BRC_FAIL(part[0]->context, BRC_BAD_INPUT,
                            "states of different moments: stage %d, step %lld and stage %d, step %lld",
                            (int)part[0]->run->stage, (long long)part[0]->run->step, (int)part[k]->run->stage,
                            (long long)part[k]->run->step);
    }
    return BRC_OK;
}

brc_status brc_lockstep_continue(int32_t n, brc_simulation *const *part, brc_state_store *store)
{
    return run(n, part, store);
}

brc_status brc_simulation_run(brc_simulation *s)
{
    return brc_lockstep_run(1, &s);
}
