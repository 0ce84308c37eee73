/* The price of a whole run by a trial of it: stage by stage, then seconds, memory and disk. */
#ifndef BRC_COMMANDS_PRICE_TRIAL_H
#define BRC_COMMANDS_PRICE_TRIAL_H

#include "trial.h"
#include "../../output/prediction.h"
#include <stdio.h>

/* Print a line or two a stage and the line `predicted:` to `details`. scene: the whole, unchanged when this returns
 * (solves that the trial cut are counted on a coarser body of it, what breaks and meets is looked at on one); setup:
 * its domains; before_s: seconds of building and setting up; *told: of the whole run, not known where the trial was
 * stopped. */
brc_status brc_price_tell_trial(brc_context *context, brc_scene *scene, const brc_setup *setup,
                                const brc_device_request *request, const brc_trial *trial, double before_s,
                                FILE *details, brc_prediction_told *told);

#endif
