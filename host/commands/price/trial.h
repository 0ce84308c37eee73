/* A trial: the run itself in a folder that is removed, each stage cut short after about a second, and what its parts
 * cost. The price of the whole run follows by counting: steps, increments, events, samples and frames that were planned
 * over those that were made. Where bonds break, surfaces meet or a condition may end a stage early counting does not
 * say all: such a stage is cut only where it has some seconds and more before it. */
#ifndef BRC_COMMANDS_TRIAL_H
#define BRC_COMMANDS_TRIAL_H

#include "../setup.h"

typedef struct brc_trial_stage {
    bool ran, cut;           /* it was entered; it ended before its plan */
    brc_time_step time_step; /* dynamic */
    int64_t planned, done;   /* steps, increments or events; modes: 1 */
    int64_t iterations;      /* static and modes: linear iterations, rounds */
    int64_t samples_planned, samples, frames_planned, frames;
    int64_t broken; /* bonds that broke in it */
    double enter_s; /* from the end of the last stage to the first step of this one */
    double warm_s;  /* until the first pause: pages are touched, kernels built; static: all but the iterations */
    double pace_s;  /* of a step or event after that, without output; static and modes: of an iteration */
    double spared;  /* dynamic: of the planned steps, as many are left out at rest as whole ones are worth (rest.h) */
    double sample_s, frame_s; /* of one of them */
    double launches, waits;   /* of a step or event, with what samples and frames ask of the devices */
    double floor_bytes;       /* dynamic: the least that a step moves, of all parts */
    double whole_s;           /* of the stage as it was, output included */
} brc_trial_stage;

typedef struct brc_trial {
    int32_t n_stages;
    brc_trial_stage *stages;            /* [n_stages] owned */
    double end_s;                       /* results, measures and pictures at the end */
    int64_t host_bytes, resident_bytes; /* most so far */
    int64_t stepping_bytes; /* of host_bytes, the most that was held while it ran, with the samples to come */
    int64_t ending_bytes;   /* the same at its end: results, measures, pictures */
    int64_t disk_bytes, frames_bytes, first_frame_bytes,
        table_bytes;         /* of its folder, of that the frames, the one of them that has what others refer to, and
                                histories.csv */
    bool writes_checkpoints; /* the scene asks for them */
    int64_t n_checkpoints,
        checkpoint_bytes;    /* written, and of the last one; none where only a signal would ask for one */
    double full_frame_bytes; /* of a frame in which everything moves: one that hardly anything does in is packed */
    int64_t sample_bytes;    /* of a sample in result.h5 */
    int64_t device_bytes[2]; /* on the devices at the first pause of dynamics (without: at the end), and at the end */
    int64_t n_broken;        /* bonds that broke, in all stages */
    int32_t n_measures;
    double *measures; /* [n_measures] of the scene; NAN unless every stage came to its end; owned */
    bool stopped;     /* the physics were stopped; reason: why */
    char reason[512];
} brc_trial;

/* Run the setup's simulations, which are used up by it. request: of their devices; seconds are those of
 * brc_pace_clock_s. brief: stages in which bonds break, surfaces meet or a condition may be met are cut as the others
 * are, also where the end is near. BRC_BAD_INPUT: what the run would refuse. */
brc_status brc_trial_run(brc_context *context, const brc_setup *setup, const brc_device_request *request, bool brief,
                         brc_trial *out);
void brc_trial_free(brc_trial *trial);
/* Is there a condition that ends it before its plan? */
bool brc_trial_may_end_early(const brc_stage *stage);
/* Did every stage come to its end? */
bool brc_trial_is_whole(const brc_trial *trial);
/* Of the whole run by counting alone, without samples and frames: where it decides only how coarse a body is looked
 * at. */
double brc_trial_seconds(const brc_trial *trial);

/* Bytes of the folder of the whole run. done: part of each stage's plan that is expected to be done [n_stages]; NULL,
 * or NAN: all of it. */
int64_t brc_trial_disk(const brc_trial *trial, const double *done);

/* What is wanted of a run of the same scene with fewer elements. */
typedef struct brc_coarse_request {
    const brc_trial *trial; /* of the whole scene, for `slower`; NULL: not wanted; borrowed */
    double share;           /* its elements over those of the scene [-]; 1: the scene as it is, seed not used */
    uint64_t seed;          /* added to those of the fills */
    bool whole;             /* dynamic stages and events are run to their end too, and the measures are wanted */
    double stage_s;         /* no stage takes longer [s] of brc_pace_clock_s */
} brc_coarse_request;

typedef struct brc_coarse {
    double across;       /* its brc_setup_across; 0: there was none */
    int64_t *iterations; /* [n_stages] of static and modes stages; 0: not found; owned */
    double *measures;    /* [n_measures] NAN: not found; owned */
    /* Of what breaks or meets; NAN: not found, or nothing can. */
    double *slower; /* [n_stages] time of a step of the whole dynamic stage over that of its first steps, as many as a
                       trial did; owned */
    double *done;   /* [n_stages] part of a dynamic stage's steps until it ended; owned */
    double broken, broken_mean; /* broken bonds over all, at the end and on average over its time */
    double grown;               /* bytes on the devices at most over those at the first pause */
    int64_t n_elements;
    bool out_of_time; /* a stage was left off after stage_s */
} brc_coarse;

/* A body that cannot be made coarser (its elements come from a file, parts get too thin, a set is empty): across = 0.
 * The scene is as it was when this returns. coarse.c */
brc_status brc_trial_coarse(brc_context *context, brc_scene *scene, const brc_device_request *request,
                            const brc_coarse_request *asked, brc_coarse *out);
void brc_coarse_free(brc_coarse *coarse);

#endif
