/* The fracture campaign that the law of strength is fitted to (NAH19 section 3.2, Table 3): which tests, their results,
 * the fits, and what is written. E_m and sigma_m scale out: k = sigma_M / sigma_m is that of the smallest strains, and
 * one pair of them stands for all. */
#ifndef BRC_COMMANDS_STRENGTH_CAMPAIGN_H
#define BRC_COMMANDS_STRENGTH_CAMPAIGN_H

#include "../../../bench/rows.h"
#include "../../solver/laws/strength_law.h"
#include "calibrate.h"

typedef struct brc_strength_plan {
    brc_calibration_plan samples; /* packings, coordination numbers, r_m, E_m [Pa] */
    int n_limits;
    double limit[BRC_CALIBRATE_LIST]; /* sigma_m [Pa] */
    double passages;                  /* of a wave, from no load to the expected strength (strength_test.h) */
} brc_strength_plan;

/* Result of one test; a line of tests.csv. */
typedef struct brc_strength_row {
    int64_t n_elements;
    double radius_spread;
    uint64_t seed;
    int axis;
    double coordination, radius, beam_young, limit, passages;
    double ratio, first, strain; /* as in brc_strength_answer */
    int64_t n_bonds, n_loose, n_broken, n_steps;
    double seconds;
} brc_strength_row;

typedef struct brc_strength_rows {
    int64_t n, capacity;
    brc_strength_row
        *rows; /* owned; sorted by coordination, radius, E_m, sigma_m, seed, axis when the campaign is complete */
} brc_strength_rows;

/* Run what the plan asks and folder/tests.csv lacks, as brc_calibrate_campaign does. */
brc_status brc_strength_campaign(brc_context *context, const brc_strength_plan *plan, const char *folder, bool resume,
                                 brc_strength_rows *out);
void brc_strength_rows_free(brc_strength_rows *rows);

/* Eq. 22 as printed, eq. 22 fitted to our tests as the paper fits (least squares of k), and the law breccia uses
 * (strength_law.h, least squares of the relative error). Fitted to the tests of the smallest sigma_m / E_m; the first
 * two see only the radii from 0.2 on. */
enum { BRC_STRENGTH_PUBLISHED, BRC_STRENGTH_REFITTED, BRC_STRENGTH_SURFACE, BRC_STRENGTH_FORMS };
typedef struct brc_strength_fit {
    brc_strength_law law[BRC_STRENGTH_FORMS];
    brc_fit_quality quality[BRC_STRENGTH_FORMS];
    bool made[BRC_STRENGTH_FORMS]; /* false: too few coordination numbers or radii */
    double smallest;               /* sigma_m / E_m of the tests that were fitted */
} brc_strength_fit;
brc_status brc_strength_fit_make(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *rows,
                                 brc_strength_fit *out);
/* "eq. 22 as printed", "eq. 22 refitted", "surface". */
const char *brc_strength_form(int form);
/* Is the test one of those that were fitted? */
bool brc_strength_is_fitted(const brc_strength_fit *fit, const brc_strength_row *row);

/* A pair of coordination number and radius, over the samples and axes of its fitted tests. */
typedef struct brc_strength_mean {
    double coordination, radius;
    int n;
    double ratio, scatter; /* mean of k, and its standard deviation over it [-]; one test: NAN */
    double first;          /* mean of k at the first failure */
} brc_strength_mean;
/* *out [*n] ascending by coordination, then radius; freed by brc_memory_free. */
brc_status brc_strength_means(brc_context *context, const brc_strength_fit *fit, const brc_strength_rows *rows,
                              int64_t *n, brc_strength_mean **out);

/* Into folder: laws.json, laws.csv (coefficients), errors.csv (the error map), rows.json and rows.csv (quality), law.h
 * (the law as C). */
brc_status brc_strength_report(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *rows,
                               const brc_strength_fit *fit, const char *folder);
/* fig8a.png, fig8b.png, fig9.png as in NAH19, and errors.png; a warning where gnuplot is not installed. */
brc_status brc_strength_figures(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *rows,
                                const brc_strength_fit *fit, const char *folder);

#endif
