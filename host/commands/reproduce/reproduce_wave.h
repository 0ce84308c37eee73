/* A wave in a bar against d'Alembert's solution, in time. */
#ifndef BRC_COMMANDS_REPRODUCE_WAVE_H
#define BRC_COMMANDS_REPRODUCE_WAVE_H

#include "reproduce.h"

/* The wave operator: a box whose end x- moves by the first load of the stage, u(t) = a(t) e, and whose end x+ is free. Its mean displacement, the scene's sensor
 * `end`, is held against 2 [a(t - T) - a(t - 3 T) + a(t - 5 T) - ...], T = length / speed, at every sample. The speed is that of plane waves in a bar of the body's
 * own mass, so the loads must keep the bar plane: sides that slide for a pressure wave (e along x), sides held in their normal's other directions for a shear wave
 * (e across x). */
typedef struct brc_wave brc_wave;
brc_status brc_wave_create(brc_context *context, brc_wave **out);
void brc_wave_free(brc_wave **wave);
brc_observer brc_wave_observer(brc_wave *wave);
/* wave_error: root of the mean square of the difference over that of the solution; wave_peak: largest displacement over the solution's. BRC_BAD_INPUT: no such scene. */
brc_status brc_wave_values(const brc_wave *wave, brc_outcome *outcome);

#endif
