/* Looks of observers at steps of their own choice. Between two batches of velocity Verlet velocities are half a step
 * behind; for a look they are brought to the whole step, and afterwards everything is put back, so that a run that was
 * looked at has the bits of one that was left alone. */
#ifndef BRC_SOLVER_LOOK_H
#define BRC_SOLVER_LOOK_H

#include "../simulation.h"

/* The first step of the current stage after the present one at which some observer looks; INT64_MAX: none. */
int64_t brc_look_next(const brc_simulation *s);
/* Those who wanted this step look: all parts stand at the end of a batch, an increment or an event. previous: the step
 * before which they were asked last. */
brc_status brc_look_here(brc_simulation *s, int64_t previous);
/* The same in the midst of a batch. Observers of part[0] hear, as everywhere. */
brc_status brc_look_within(int32_t n, brc_simulation *const *part, int64_t previous);
void brc_look_free(brc_simulation *s);

#endif
