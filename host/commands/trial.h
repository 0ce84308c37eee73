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
    int32_t n_measures;
    double *measures;        /* [n_measures] of the scene; NAN unless every stage came to its end; owned */
    bool stopped;            /* the physics were stopped; reason: why */
    char reason[512];
} brc_trial;

/* Run the setup's simulations, which are used up by it. request: of their devices; seconds are those of brc_pace_clock_s. BRC_BAD_INPUT: what the run would refuse. */
brc_status brc_trial_run(brc_context *context, const brc_setup *setup, const brc_device_request *request, brc_trial *out);
void brc_trial_free(brc_trial *trial);
/* Of the whole run by counting alone, without samples and frames: where it decides only how coarse a body is looked at. */
double brc_trial_seconds(const brc_trial *trial);

/* A run of the same scene with fewer elements. */
typedef struct brc_coarse {
    double across;       /* its brc_setup_across; 0: there was none */
    int64_t *iterations; /* [n_stages] of static and modes stages; 0: not found; owned */
    double *measures;    /* [n_measures] NAN: not found; owned */
} brc_coarse;

/* share: its elements over those of the scene [-]; seed: added to those of the fills; whole: dynamic stages and events are run to their end too, and the measures are
 * wanted. No stage takes more than some seconds. A body that cannot be made coarser (its elements come from a file, parts get too thin, a set is empty): across = 0.
 * The scene is as it was when this returns. coarse.c */
brc_status brc_trial_coarse(brc_context *context, brc_scene *scene, const brc_device_request *request, double share, uint64_t seed, bool whole, brc_coarse *out);
void brc_coarse_free(brc_coarse *coarse);

#endif
