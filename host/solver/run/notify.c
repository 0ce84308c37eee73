/* Telling observers, and asking whether a run is to stop. */
#include "../../base/ranks.h"
#include "../core/simulation_internal.h"

brc_status brc_notify_sample(brc_simulation *s)
{
    const brc_step_phase before = brc_phase_enter(s, BRC_PHASE_OUTPUT);
    for (int i = 0; i < s->n_observers; ++i)
        if (s->observers[i].sample) BRC_TRY(s->observers[i].sample(s->observers[i].self, s));
    brc_phase_enter(s, before);
    return BRC_OK;
}

brc_status brc_notify_frame(brc_simulation *s)
{
    const brc_step_phase before = brc_phase_enter(s, BRC_PHASE_OUTPUT);
    for (int i = 0; i < s->n_observers; ++i)
        if (s->observers[i].frame) BRC_TRY(s->observers[i].frame(s->observers[i].self, s));
    brc_phase_enter(s, before);
    return BRC_OK;
}

brc_status brc_notify_pause(brc_simulation *s, brc_pause why)
{
    const brc_step_phase before = brc_phase_enter(s, BRC_PHASE_OUTPUT);
    for (int i = 0; i < s->n_observers; ++i)
        if (s->observers[i].pause) BRC_TRY(s->observers[i].pause(s->observers[i].self, s, why));
    brc_phase_enter(s, before);
    return BRC_OK;
}

bool brc_simulation_is_to_stop(brc_simulation *s)
{
    int64_t asked = s->interrupted;
    if (brc_ranks_count() > 1 && brc_ranks_reduce(s->context, BRC_ANY_BIT, 1, &asked) == BRC_OK && asked)
        s->interrupted = 1;
    return asked != 0;
}

bool brc_leaves_off(brc_simulation *s)
{
    s->left_off |= s->patience && s->patience->over(s->patience->self);
    return s->left_off;
}
