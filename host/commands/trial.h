/* A trial: the run itself in a folder that is removed, each stage cut short after about a second, and what its parts cost. The price of the whole run
 * follows by counting: steps, increments, events, samples and frames that were planned over those that were made. */
#ifndef BRC_COMMANDS_TRIAL_H
#define BRC_COMMANDS_TRIAL_H

#include "setup.h"

typedef struct brc_trial_stage {
    bool ran, cut;              /* it was entered; it ended before its plan */
    brc_time_step time_step;    /* dynamic */
    int64_t planned, done;      /* steps, increments or events; modes: 1 */
    int64_t iterations;         /* static and modes: linear iterations, rounds */
    int64_t samples_planned, samples, frames_planned, frames;
    double enter_s;             /* from the end of the last stage to the first step of this one */
    double warm_s;              /* until the first pause: pages are touched, kernels built; static: all but the iterations */
    double pace_s;              /* of a step or event after that, without output; static and modes: of an iteration */
    double sample_s, frame_s;   /* of one of them */
    double whole_s;             /* of the stage as it was, output included */
} brc_trial_stage;

typedef struct brc_trial {
    int32_t n_stages;
    brc_trial_stage *stages; /* [n_stages] owned */
    double end_s;            /* results, measures and pictures at the end */
    int64_t host_bytes, resident_bytes; /* most so far */
    int64_t disk_bytes;      /* of the whole run */
    bool stopped;            /* the physics were stopped; reason: why */
    char reason[512];
} brc_trial;

/* Run the setup's simulations, which are used up by it. request: of their devices; seconds are those of brc_pace_clock_s. BRC_BAD_INPUT: what the run would refuse. */
brc_status brc_trial_run(brc_context *context, const brc_setup *setup, const brc_device_request *request, brc_trial *out);
void brc_trial_free(brc_trial *trial);

/* Iterations of the static and modes stages on a coarser body of the same scene [n_stages] (0: not found), in a few seconds a stage at most; *across: its
 * brc_setup_across. share: its elements over those of the scene [-]. A body that cannot be made coarser (its elements come from a file): all 0. The scene is as it was
 * when this returns. trial_coarse.c */
brc_status brc_trial_coarse(brc_context *context, brc_scene *scene, const brc_device_request *request, double share, int64_t *iterations, double *across);

#endif
