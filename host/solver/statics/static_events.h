/* Quasi-static fracture, event by event: the load is scaled to where the next element fails, its bond breaks, and the
 * body is solved anew. */
#ifndef BRC_SOLVER_STATIC_EVENTS_H
#define BRC_SOLVER_STATIC_EVENTS_H

#include "statics_internal.h"

/* The events of a static stage, all parts together. Loads scale in proportion, so no gravity (BRC_BAD_INPUT) and no
 * tables. At every event:
 *
 *   1. load factor l at which the largest failure ratio is 1: by proportion, and where the law is the full one by
 *   solving again until it is met; 2. a sample there (step: number of the event that comes, time: l), the body whole
 *   but for what broke before; 3. every element within 1e-9 (lower precisions: their own rounding) of its limit loses
 *   its bond, as in a step (fracture.h); 4. equilibrium at the same l. What energy this sets free beyond that of the
 *   bonds themselves is lost to whatever brings a real body to rest, and
 *      is booked as damping.
 *
 * It ends after most_events of them, when the load falls below stop_load of its largest so far, when an observer says
 * so (stage_end.h) and when what is left carries less than a thousandth of what broke it. It leaves an equilibrium at
 * the load that would break the next bond; a body that came apart under forces that nothing holds is left without load.
 * Where the load of an event has no equilibrium any more, the next one is looked for from no load. The load that
 * stop_load compares is that of a testing machine: for prescribed motion the force that goes with it, 2 U / l with the
 * elastic energy U, else l itself. */
brc_status brc_static_events_run(int32_t n, brc_simulation *const *part, brc_static_run *run, brc_progress *progress);

#endif
