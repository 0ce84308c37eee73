/* What a run will cost, told while it runs: the pace of its first half second carried on to the end of each dynamic
 * stage, and the memory that was known before the first step. Nothing is run for it, and nothing of the run changes. */
#ifndef BRC_COMMANDS_PRICE_H
#define BRC_COMMANDS_PRICE_H

#include "../../output/prediction.h"
#include "price_curves.h"
#include "price_error.h"
#include "../setup.h"
#include "../../solver/effects/rest.h"
#include <stdio.h>

typedef struct brc_price {
    brc_context *context;
    brc_prediction prediction;
    double begin, first_s;                 /* of the stage: clock at its start, and at its first pause */
    brc_rest_account first_rest;           /* at the first pause */
    int64_t first_step;                    /* steps at the first pause; 0: there was none */
    double expected;                       /* seconds of the stage; 0: not predicted yet */
    double frame_begin, frame_s;           /* mean of the frames so far */
    double stage_frames_s, first_frames_s; /* of the stage's frames so far, and at its first pause */
    int64_t n_frames, stage_frames;
} brc_price;

/* Watch the parts of a setup whose simulations exist; *price is borrowed until the run has ended. The first before
 * those that write frames observe, the second after them, so that frames are timed apart. */
brc_status brc_price_watch_output(brc_context *context, const brc_setup *setup, brc_price *price);
brc_status brc_price_watch(const brc_setup *setup, brc_price *price);

/* A line of the log when the run is over: what it was told to take and what it took. */
void brc_price_compare(const brc_price *price);

/* The error class of a scene: 1, 3 or 10 of a power of ten, the nearest to an error [-]; at least 1e-4. */
double brc_price_class(double error);
/* What the class rests on: the scene's own worst measure (own: price_error.h) or, where nothing was found of them, the
 * worst of the measured curves of its model. */
typedef struct brc_price_judgement {
    bool known, is_own;
    brc_price_curve by; /* of own measures: a curve of order own->order through the error at the scene's elements */
    const char *taken;  /* precision of the curves */
    int n;
    brc_price_curve curve[BRC_CURVES_MOST];
} brc_price_judgement;
brc_status brc_price_judge(brc_context *context, const brc_scene *scene, const brc_setup *setup,
                           brc_precision precision, const brc_price_error *own, brc_price_judgement *out);

/* For `breccia check`: tell that, and where the scene asks for an accuracy or has a budget, the resolution for it and
 * its cost. seconds: predicted of the run as it stands; details: where the errors that the class rests on go, and what
 * was measured of breaking. */
brc_status brc_price_tell_accuracy(brc_context *context, const brc_scene *scene, const brc_setup *setup,
                                   brc_precision precision, double seconds, const brc_price_error *own, FILE *details);

#endif
