/* The error of a scene's own measures, from what becomes of them with fewer elements. */
#ifndef BRC_COMMANDS_PRICE_ERROR_H
#define BRC_COMMANDS_PRICE_ERROR_H

#include "trial.h"

typedef struct brc_price_error {
    double *error; /* [n_measures] relative; NAN: not found; owned */
    int32_t worst; /* measure with the largest; -1: none was found */
    double order;  /* that errors are taken to fall with, in the spacing: several materials in a body 1, modes 2.4, else 1.5 (those of the measured problems: docs/accuracy.md) */
    int64_t least_elements; /* about, of the coarsest body that was run */
} brc_price_error;

/* The scene runs to its end with a quarter of its elements (where the trial was cut: with as many as some three seconds run, and a quarter of these), twice with
 * different seeds; of the differences of each measure the larger one, d, leaves an error of d / (r^p - 1) with r times the elements across. Nothing is found of
 * scenes with fracture, of less than 200 elements, and where a coarser body cannot be made or run (brc_trial_coarse). seconds: predicted of the scene's run. */
brc_status brc_price_error_find(brc_context *context, brc_scene *scene, const brc_setup *setup, const brc_device_request *request, const brc_trial *trial, double seconds,
                                brc_price_error *out);
void brc_price_error_free(brc_price_error *error);

#endif
