/* `breccia check` in some ten lines: what matters before a run. */
#ifndef BRC_COMMANDS_CHECK_BRIEF_H
#define BRC_COMMANDS_CHECK_BRIEF_H

#include "../setup.h"
#include "trial.h"
#include "../../output/prediction.h"
#include <stdio.h>

/* Elements, bonds, size of the elements; device and what is simulated (the setup has its simulations). */
void brc_check_brief_setup(FILE *file, const brc_scene *scene, const brc_setup *setup, brc_precision precision);
/* After the trial: a line a stage with its time step, memory and disk, seconds, and how fine the elements are for the
 * cracks of each material that breaks. */
void brc_check_brief_trial(FILE *file, const brc_scene *scene, const brc_setup *setup, const brc_trial *trial,
                           const brc_prediction_told *told);

#endif
