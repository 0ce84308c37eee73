#include "phases.h"
#include "core_internal.h"

const char *brc_phase_name(brc_step_phase phase)
{
    static const char *const names[BRC_N_PHASES] = {"none",  "motion",   "forces", "search",
                                                    "pairs", "fracture", "ledger", "output"};
    return names[phase];
}

brc_step_phase brc_phase_enter(brc_simulation *s, brc_step_phase phase)
{
    const brc_step_phase before = s->core->watch.phase;
    const double now = brc_clock_s();
    s->core->watch.seconds[before] += now - s->core->watch.since;
    s->core->watch.since = now;
    s->core->watch.phase = phase;
    return before;
}

brc_step_phase brc_phase_within(brc_simulation *s, brc_step_phase phase)
{
    return s->core->watch.phase == BRC_PHASE_NONE ? BRC_PHASE_NONE : brc_phase_enter(s, phase);
}
