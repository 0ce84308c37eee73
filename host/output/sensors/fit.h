/* The slope of measured data at zero: a polynomial of low order by least squares. */
#ifndef BRC_OUTPUT_FIT_H
#define BRC_OUTPUT_FIT_H

#include <stdbool.h>
#include <stdint.h>

typedef struct brc_fit {
    int order;             /* 1..3; 0: no fit possible (fewer than two distinct x) */
    bool through_origin;   /* the data start unloaded, so that y(0) = 0 is known rather than fitted */
    double coefficient[4]; /* y = c0 + c1 x + c2 x^2 + c3 x^3, higher ones than `order` are 0 */
    double residual;       /* root mean square of y - fit, in the unit of y */
} brc_fit;

/* Fit n points. Through the origin where the first point is the unloaded state (|x|, |y| at most 1e-9 of their largest
 * values): then a single loaded point gives c1 = y / x exactly. A higher order is taken only while points suffice and
 * it at least halves the residual for each step in order, so that curvature is followed and noise is not. */
brc_fit brc_fit_polynomial(int64_t n, const double *x, const double *y);

#endif
