/* What accuracy cost on problems with exact answers (bench/results/accuracy-curves.csv, inside the program), as curves
 * of error against elements, and what they say of a scene: its error class, and the resolution that an accuracy or a
 * budget asks for. */
#ifndef BRC_COMMANDS_PRICE_CURVES_H
#define BRC_COMMANDS_PRICE_CURVES_H

#include "../../base/status.h"
#include <stdbool.h>

#define BRC_CURVES_MOST 24

/* Points of one problem by least squares in logarithms: error = scale * elements^(-order / 3). */
typedef struct brc_price_curve {
    char problem[32];
    int n; /* points */
    double scale, order;
    double least, most; /* elements of its points */
    bool moves;         /* runs that were stepped through time */
    bool rings;         /* modes of free vibration */
} brc_price_curve;

/* Curves of a model ("dlsm", ...) in a precision ("double", ...): problems with points at two resolutions or more, in
 * the order of the text; of other preparations, fractions of the step and integrators than the first of each problem
 * nothing is taken. text: CSV with a header line. */
void brc_price_curves_read(const char *text, const char *model, const char *precision, int *n,
                           brc_price_curve out[BRC_CURVES_MOST]);
/* Relative error of `elements` elements [-]; elements that an error [-] asks for. */
double brc_price_curve_error(const brc_price_curve *curve, double elements);
double brc_price_curve_elements(const brc_price_curve *curve, double error);
/* Explicit dynamics on the same body: a step costs as its elements, and steps are as many as elements across. */
double brc_price_seconds_at(double seconds, double elements, double other_elements);
double brc_price_elements_for(double seconds, double elements, double other_seconds);

#endif
