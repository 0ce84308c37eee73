/* What a scene asks for and what it will cost: the work of `breccia check`, whoever asks. */
#ifndef BRC_COMMANDS_CHECK_SCENE_H
#define BRC_COMMANDS_CHECK_SCENE_H

#include "price_trial.h"
#include "../setup.h"
#include <stdio.h>

/* Begins as {0}; freed in any case. Each call needs the one before. */
typedef struct brc_check {
    brc_setup setup;
    brc_trial trial;
    brc_prediction_told told;
    double build_s, before_s, simulations_s; /* seconds of brc_pace_clock_s: domains; all until these; simulations */
    FILE *details;                           /* where the price is told in words; NULL: nowhere */
    void (*built)(FILE *details, const brc_setup *setup,
                  double build_s); /* NULL, or told as soon as the domains are there */
} brc_check;

/* Domains and simulations; start: brc_pace_clock_s when it began. scene is borrowed until free. What the run would
 * refuse is refused. */
brc_status brc_check_build(brc_context *context, brc_scene *scene, const brc_device_request *request, double start,
                           brc_check *check);
/* The trial; brief as in brc_trial_run. Its simulations are still there, used up. */
brc_status brc_check_try(brc_context *context, const brc_device_request *request, bool brief, brc_check *check);
/* What follows from it, told in words to check->details; the simulations go. */
brc_status brc_check_price(brc_context *context, brc_scene *scene, const brc_device_request *request, brc_check *check);
void brc_check_free(brc_check *check);

#endif
