/* Stages that end before their plan is done: an observer that watches something may ask for it; conditions of the
 * solver use the same. What ends so is a success, and the stages after it run. */
#ifndef BRC_SOLVER_STAGE_END_H
#define BRC_SOLVER_STAGE_END_H

#include "../simulation.h"

/* End the current stage, dynamic or event by event, at this sample. For `sample` of an observer of a scene's first
 * simulation. reason: a sentence, copied. */
void brc_simulation_end_stage(brc_simulation *simulation, const char *reason);
/* Why the stage ended early; "" where it ran to its plan, runs, or has not begun. Borrowed. */
const char *brc_simulation_stage_reason(const brc_simulation *simulation, int32_t stage);

#endif
