/* How many samples and frames a stage will write, by the scene's output keys and the steps it will take (dynamics.c,
 * statics.c and static_events.c decide them). */
#ifndef BRC_COMMANDS_PLANNED_OUTPUT_H
#define BRC_COMMANDS_PLANNED_OUTPUT_H

#include "../../scene/scene.h"

/* planned: steps, increments or events; time_step of a dynamic stage [s]. Frames: those within the stage and at its
 * end; the first stage has one more, at its start. */
int64_t brc_planned_samples(const brc_scene *scene, int32_t stage, int64_t planned);
int64_t brc_planned_frames(const brc_scene *scene, int32_t stage, int64_t planned, double time_step);

#endif
