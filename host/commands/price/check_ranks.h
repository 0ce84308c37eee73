/* What a run costs on several ranks (host/base/ranks.h), from what a trial of one told and the cut of its rows. */
#ifndef BRC_COMMANDS_CHECK_RANKS_H
#define BRC_COMMANDS_CHECK_RANKS_H

#include "../setup.h"
#include "../../output/prediction.h"
#include <stdio.h>

enum { BRC_CHECK_MOST_RANKS = 4096 };

/* Begins as {.n_ranks = wanted}; 1: nothing is looked at and nothing told. Of the rank that has most. */
typedef struct brc_check_ranks {
    int32_t n_ranks;
    double share;           /* slots, over all [-] */
    int64_t rows_of_others; /* that it gathers */
    int32_t beside;         /* ranks that it has them of */
    double less_bytes;      /* of arrays of rows, on other ranks alone */
    double once_bytes;      /* once a machine: the domain and arrays of no rows */
    double domain_bytes;    /* of these, the domain */
    double exchange_s;      /* of a step */
} brc_check_ranks;

/* After the trial, while its simulations are there. BRC_BAD_INPUT: a device that computes on one rank alone. */
brc_status brc_check_ranks_look(brc_context *context, const brc_setup *setup, brc_precision precision,
                                brc_check_ranks *ranks);
void brc_check_ranks_tell(FILE *file, const brc_scene *scene, const brc_prediction_told *told,
                          const brc_check_ranks *ranks);

#endif
