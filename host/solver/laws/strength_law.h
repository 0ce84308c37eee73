/* From the strength of a solid to the limit of the virial stress of its elements: k = sigma_M / sigma_m (NAH19 eq. 21),
 * for the stress over an element and its direct neighbours, in tension. cn: mean coordination number; r_m: beam radius
 * over the mean radius of the packed spheres. The paper's form,
 *     k = m0 + n0 cn + p0 cn^2 + r_m (m1 + n1 cn + p1 cn^2 + q1 cn^3) + r_m^2 (m2 + n2 cn + p2 cn^2),          (22)
 * and breccia's, fitted to the fracture tests of `breccia calibrate`: Chebyshev polynomials T of s, which runs from -1
 * to 1 with the logarithm of r_m, and of t, likewise with cn,
 *     k = sum K_ij T_i(s) T_j(t). */
#ifndef BRC_SOLVER_STRENGTH_LAW_H
#define BRC_SOLVER_STRENGTH_LAW_H

#include "../../base/status.h"

/* Polynomials of the surface: T_0 to T_3 of s, T_0 to T_5 of t; coefficients of eq. 22. */
enum { BRC_STRENGTH_LAW_ROWS = 4, BRC_STRENGTH_LAW_COLUMNS = 6, BRC_STRENGTH_LAW_PAPER = 10 };

typedef struct brc_strength_law {
    const char *name;
    double coordination[2], radius[2];                               /* ranges of cn and r_m it was fitted in */
    bool is_paper;                                                   /* eq. 22 with `paper`; else the surface */
    double paper[BRC_STRENGTH_LAW_PAPER];                            /* m0 n0 p0 m1 n1 p1 q1 m2 n2 p2 */
    double surface[BRC_STRENGTH_LAW_ROWS][BRC_STRENGTH_LAW_COLUMNS]; /* K_ij */
} brc_strength_law;

/* What breccia divides strengths by: our surface; static storage. */
const brc_strength_law *brc_strength_law_default(void);
/* Eq. 22 as the paper prints it; static storage. */
const brc_strength_law *brc_strength_law_published(void);
/* k [-]. */
double brc_strength_law_ratio(const brc_strength_law *law, double coordination, double radius);
/* The same; BRC_BAD_INPUT with the cure where the law says nothing (a tenth beyond its ranges is let through). */
brc_status brc_strength_law_find(brc_context *context, const brc_strength_law *law, double coordination, double radius,
                                 double *ratio);
/* What a disc pressed across over arcs of 24 degrees reads (2 P / (pi t D), NAH19 eq. 27) over the strength in tension
 * of its packing [-]: a fit to discs of 20 000 spheres (laws/disc.h, docs/notebook/beams-tests.md), a polynomial of cn
 * and r_m. At each cn r_m was between that of alumina and that of glass: the nearer of them is taken outside, and a
 * warning says so; BRC_BAD_INPUT with the cure more than a tenth outside the ranges it was fitted in as a whole. */
enum { BRC_STRENGTH_LAW_DISC = 6, BRC_STRENGTH_LAW_DISC_BANDS = 8 };
typedef struct brc_disc_law {
    double coordination[2], radius[2]; /* ranges of cn and r_m it was fitted in [-] */
    double band[BRC_STRENGTH_LAW_DISC_BANDS]
               [2];                     /* least and largest r_m at whole cn, from coordination[0] on by one [-] */
    double term[BRC_STRENGTH_LAW_DISC]; /* of 1, x, x^2, x^3 with x = cn - 10, of r_m and of x r_m */
} brc_disc_law;
brc_status brc_strength_law_disc(brc_context *context, double coordination, double radius, double *ratio);
/* What a strength that either test may have given is divided by to be one in tension [-]: the root of `disc`, so that
 * bars bear as much more than the number as discs read less (or the other way round), and bars at most 3.7 % more or
 * less. */
double brc_strength_law_either(double disc);
/* What multiplies the coefficients of eq. 22, in their order: 1, cn, cn^2, r_m, ... */
void brc_strength_law_paper_terms(double coordination, double radius, double out[BRC_STRENGTH_LAW_PAPER]);
/* The products T_i(s) T_j(t) of a law's ranges, row i, column j. */
void brc_strength_law_terms(const brc_strength_law *law, double coordination, double radius,
                            double out[BRC_STRENGTH_LAW_ROWS][BRC_STRENGTH_LAW_COLUMNS]);

#endif
