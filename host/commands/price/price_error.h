/* The error of a scene's own measures, from what becomes of them with fewer elements. */
#ifndef BRC_COMMANDS_PRICE_ERROR_H
#define BRC_COMMANDS_PRICE_ERROR_H

#include "trial.h"

typedef struct brc_price_error {
    double *error; /* [n_measures] relative; NAN: not found; owned */
    int32_t worst; /* measure with the largest; -1: none was found */
    double order;  /* that errors are taken to fall with, in the spacing: several materials in a body 1, else 1.5 (below
                      those of the measured problems: docs/notebook/accuracy.md) */
    double volumes;         /* part of each error: the volumes of the materials (material_volume.h) [-] */
    int64_t least_elements; /* about, of the coarsest body that was run */
    bool out_of_time;       /* a body was left off after brc_price_error_stage_s of a stage: then nothing was found */
} brc_price_error;

/* So much may a stage of these bodies take [s]: ten times and more what one is counted to take. */
extern const double brc_price_error_stage_s;

/* The scene (where its run is counted to be larger than some 4e7 bond updates: a body of a half, a quarter, ... of its
 * elements that is not; price_work.h) against bodies of a quarter of its elements, of three seeds; of the differences
 * of each measure the largest, d, leaves an error of d / (r^p - 1) with r times the elements across, and what the
 * volumes of its materials are off by comes on top. How many elements these bodies have is decided by counts alone, so
 * that the answer is the same on every machine, unless a stage takes longer than brc_price_error_stage_s. Nothing is
 * found of scenes with fracture, of less than 200 elements, and where a coarser body cannot be made or run
 * (brc_trial_coarse). */
brc_status brc_price_error_find(brc_context *context, brc_scene *scene, const brc_setup *setup,
                                const brc_device_request *request, const brc_trial *trial, brc_price_error *out);
void brc_price_error_free(brc_price_error *error);

#endif
