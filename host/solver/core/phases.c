#include "phases.h"
#include "simulation_internal.h"

const char *brc_phase_name(brc_step_phase phase)
{
    static const char *const names[BRC_N_PHASES] = {"none",  "motion",   "forces", "search",
                                                    "pairs", "fracture", "ledger", "output"};
    return names[phase];
}

brc_step_phase brc_phase_enter(brc_simulation *s, brc_step_phase phase)
{
    const brc_step_phase before = s->watch.phase;
    const double now = brc_clock_s();
    s->watch.seconds[before] += now - s->watch.since;
    s->watch.since = now;
    s->watch.phase = phase;
    return before;
}

brc_step_phase brc_phase_within(brc_simulation *s, brc_step_phase phase)
{
    return s->watch.phase == BRC_PHASE_NONE ? BRC_PHASE_NONE : brc_phase_enter(s, phase);
}
