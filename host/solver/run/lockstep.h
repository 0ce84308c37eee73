/* Several simulations of one scene with one clock: bodies whose models differ (split.h) are moved by one simulation
 * each, which stand at the same stage, step and time whenever an observer looks. Of one simulation it is that
 * simulation alone. */
#ifndef BRC_SOLVER_LOCKSTEP_H
#define BRC_SOLVER_LOCKSTEP_H

#include "../core/state_store.h"

/* Enter the stage with all n parts; in a dynamic one they then share the shortest of their time steps. */
brc_status brc_lockstep_begin_stage(int32_t n, brc_simulation *const *part, int32_t stage);
/* As brc_simulation_run, for n >= 1 parts whose scenes have the same stages and output: dynamic stages step together,
 * the increments of static ones and modes are solved one part after the other. Observers of part[0] hear when all
 * have arrived, and brc_simulation_interrupt of part[0] stops all; those of the others are not called. A stage ends by
 * kinetic energy when that of all parts together is small. */
brc_status brc_lockstep_run(int32_t n, brc_simulation *const *part);

/* Leaving off and going on (state_store.h). Save at a pause that observers of part[0] hear of; load into new parts
 * of the same scene; continue what was loaded, from the same store: every later state, sample and frame is the one that
 * the run would have had, bit for bit, on the same device. */
brc_status brc_lockstep_save(int32_t n, brc_simulation *const *part, brc_state_store *store);
brc_status brc_lockstep_load(int32_t n, brc_simulation *const *part, brc_state_store *store);
brc_status brc_lockstep_continue(int32_t n, brc_simulation *const *part, brc_state_store *store);

#endif
