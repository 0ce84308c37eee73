/* The campaign that the laws of model cbm are fitted to (NAH19 section 3): which elastic tests, their results, the
 * fits, and what is written. Shared by calibrate_*.c and the command. */
#ifndef BRC_COMMANDS_CALIBRATE_H
#define BRC_COMMANDS_CALIBRATE_H

#include "../../solver/laws/beam_law.h"
#include "../../solver/laws/beam_sample.h"
#include <stdint.h>
#include <stdio.h>

#define BRC_CALIBRATE_LIST 32 /* most values of one parameter */

/* What is varied. Sample k is a cube packed with the seed `seed` + k. */
typedef struct brc_calibration_plan {
    int64_t n_elements;
    double radius_spread;
    int n_samples, n_coordinations, n_radii, n_youngs;
    int n_axes; /* 1: pulled along x, as in the paper; 3: along x, y and z, which are as good as samples of their own */
    uint64_t seed;
    double coordination[BRC_CALIBRATE_LIST], radius[BRC_CALIBRATE_LIST];
    double young[BRC_CALIBRATE_LIST]; /* E_m [Pa]; {1} where it is scaled out */
    int n_threads;
} brc_calibration_plan;

/* Result of one solve; a line of solves.csv. */
typedef struct brc_calibration_row {
    int64_t n_elements;
    double radius_spread;
    uint64_t seed;
    int axis; /* 0 x 1 y 2 z */
    double coordination, radius, beam_young;
    double young, poisson, lateral[2], inner; /* as in brc_beam_answer */
    int64_t n_bonds, n_loose, iterations;
    double seconds;
} brc_calibration_row;

typedef struct brc_calibration_rows {
    int64_t n, capacity;
    brc_calibration_row
        *rows; /* owned; sorted by coordination, radius, E_m, seed, axis when the campaign is complete */
} brc_calibration_rows;

/* Run what the plan asks and folder/solves.csv lacks; every result goes there at once, so that a campaign that was
 * stopped or killed goes on with `resume`. Without it a file that is there already is refused. Solves of other plans
 * stay in the file, *out has those of this one. */
brc_status brc_calibrate_campaign(brc_context *context, const brc_calibration_plan *plan, const char *folder,
                                  bool resume, brc_calibration_rows *out);
void brc_calibration_rows_free(brc_calibration_rows *rows);

/* How well a form holds. */
typedef struct brc_fit_quality {
    int64_t n;
    double r2;                   /* coefficient of determination over all solves [-] */
    double worst, rms;           /* relative error over all solves: largest, root mean square [-] */
    double mean_worst, mean_rms; /* the same against the mean over the samples and axes of each pair cn, r_m [-] */
} brc_fit_quality;

enum { BRC_FORM_CUBICS, BRC_FORM_TWO_STAGE, BRC_FORM_JOINT, BRC_FORM_SURFACE, BRC_FORMS }; /* see calibrate_fit.c */
enum { BRC_QUANTITY_NU, BRC_QUANTITY_E, BRC_QUANTITIES };

/* The fits: NAH19 eq. 17 and 18 for each coordination number, eq. 19 and 20 through their coefficients, all of these at
 * once on relative errors, and the law breccia uses (beam_law.h). The first three see only the radii of the paper's
 * Table 2 where the plan has more. */
typedef struct brc_calibration_fit {
    int n_coordinations;
    double coordination[BRC_CALIBRATE_LIST];
    double cubic[BRC_QUANTITIES][BRC_CALIBRATE_LIST][4]; /* a b c d of eq. 17, 18 for each coordination number */
    double cubic_r2[BRC_QUANTITIES][BRC_CALIBRATE_LIST];
    double stage_r2[BRC_QUANTITIES][4];     /* of eq. 19, 20 through a b c d */
    double two_stage[BRC_QUANTITIES][4][4]; /* rows a b c d, columns A B C D */
    double joint[BRC_QUANTITIES][4][4];
    brc_beam_law law;
    brc_fit_quality quality[BRC_FORMS][BRC_QUANTITIES];
    bool made[BRC_FORMS]; /* false: too few coordination numbers or radii */
} brc_calibration_fit;
brc_status brc_calibrate_fit(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_rows *rows,
                             brc_calibration_fit *out);
/* nu or E_M / E_m of a form. coordination: for BRC_FORM_CUBICS one of the fit's. */
double brc_calibration_value(const brc_calibration_fit *fit, int form, int quantity, double coordination,
                             double radius);
/* "per-cn cubics", "two-stage", "joint", "surface"; "nu", "E/E_m". */
const char *brc_calibration_form(int form);
const char *brc_calibration_quantity(int quantity);

/* A pair of coordination number and radius, over its samples and axes. */
typedef struct brc_calibration_mean {
    double coordination, radius;
    int n;
    double value[BRC_QUANTITIES],
        scatter[BRC_QUANTITIES]; /* mean, and standard deviation over it [-]; one sample: NAN */
} brc_calibration_mean;
/* *out [*n] ascending by coordination, then radius; freed by brc_memory_free. */
brc_status brc_calibration_means(brc_context *context, const brc_calibration_rows *rows, int64_t *n,
                                 brc_calibration_mean **out);

/* Into folder: laws.json, laws.csv (coefficients), errors.csv (the error map), rows.json and rows.csv (quality), law.h
 * (the law as C). */
brc_status brc_calibrate_report(brc_context *context, const brc_calibration_plan *plan,
                                const brc_calibration_rows *rows, const brc_calibration_fit *fit, const char *folder);
/* fig5a.png, fig5b.png, fig6.png, fig7.png as in NAH19, and errors.png; a warning where gnuplot is not installed. */
brc_status brc_calibrate_figures(brc_context *context, const brc_calibration_plan *plan,
                                 const brc_calibration_rows *rows, const brc_calibration_fit *fit, const char *folder);

#endif
