/* Ending a stage when a sensor has fallen from its peak (brc_stage.stop_sensor). */
#ifndef BRC_OUTPUT_STOP_H
#define BRC_OUTPUT_STOP_H

#include "history.h"

/* Judge the last sample of the history: has the sensor that its stage watches fallen below the asked share of its
 * largest magnitude in the stage? The reason is a sentence [room]. broke: some bond is broken, or none can; before, a
 * sensor that only swings ends nothing. */
bool brc_stop_after_peak(const brc_scene *scene, const brc_history *history, bool broke, char *reason, size_t room);

#endif
