/* Telling observers, and asking whether a run is to stop. */
#include "../../base/ranks.h"
#include "run_internal.h"

/* Every observer that has the member, in the phase of output. */
#define NOTIFY(s, member, ...)                                                                                         \
    const brc_step_phase before = brc_phase_enter((s), BRC_PHASE_OUTPUT);                                              \
    for (const brc_observer *o = (s)->run->observers; o < (s)->run->observers + (s)->run->n_observers; ++o)            \
        if (o->member) BRC_TRY(o->member(o->self, __VA_ARGS__));                                                       \
    brc_phase_enter((s), before);                                                                                      \
    return BRC_OK

brc_status brc_notify_sample(brc_simulation *s)
{
    NOTIFY(s, sample, s);
}

brc_status brc_notify_frame(brc_simulation *s)
{
    NOTIFY(s, frame, s);
}

brc_status brc_notify_pause(brc_simulation *s, brc_pause why)
{
    NOTIFY(s, pause, s, why);
}

bool brc_simulation_is_to_stop(brc_simulation *s)
{
    int64_t asked = s->run->interrupted;
    if (brc_ranks_count() > 1 && brc_ranks_reduce(s->context, BRC_ANY_BIT, 1, &asked) == BRC_OK && asked)
        s->run->interrupted = 1;
    return asked != 0;
}

bool brc_trial_is_over(brc_simulation *s)
{
    s->run->stopped_early |= s->run->budget && s->run->budget->over(s->run->budget->self);
    return s->run->stopped_early;
}

void brc_simulation_interrupt(brc_simulation *s)
{
    s->run->interrupted = 1;
    for (int32_t k = 0; k < s->run->n_others; ++k)
        s->run->others[k]->run->interrupted = 1;
}

void brc_simulation_set_trial_budget(brc_simulation *s, const brc_trial_budget *budget)
{
    s->run->budget = budget;
}

BRC_READ(bool, brc_simulation_stopped_early, s->run->stopped_early)
