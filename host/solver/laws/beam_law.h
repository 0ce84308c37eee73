/* From a material to the beams of model cbm: laws fitted to the elastic tests of `breccia calibrate` (NAH19 section 3).
 * With the mean coordination number cn and r_m, the beam radius over the mean radius of the packed spheres, they give
 * nu and E / E_m.
 *
 * Breccia uses a smooth surface: Chebyshev polynomials T of s, which runs from -1 to 1 with the logarithm of r_m, and
 * of t, likewise with cn,
 *     nu = sum P_ij T_i(s) T_j(t),    ln(E / E_m) = sum Y_ij T_i(s) T_j(t).
 * cn is that of the cubes of 10 000 spheres which the law was fitted to. A body of another size or shape has another
 * share of elements at its walls, which have fewer bonds; it is as stiff as the cube that has as many bonds inside
 * (brc_beam_law_coordination). The paper's form stands beside it, with our coefficients:
 *     nu = a1 + b1 r_m + c1 r_m^2 + d1 r_m^3,    a1 ... = A + B tanh(C (cn - 7) + D)          (17, 19)
 *     E / E_m = a2 + b2 r_m + c2 r_m^2 + d2 r_m^3,    a2 ... = A + B cn + C cn^2 + D cn^3     (18, 20) */
#ifndef BRC_SOLVER_BEAM_LAW_H
#define BRC_SOLVER_BEAM_LAW_H

#include "beam_body.h"

/* Polynomials of the surface: T_0 to T_5 of s, T_0 to T_8 of t. */
enum { BRC_BEAM_LAW_ROWS = 6, BRC_BEAM_LAW_COLUMNS = 9, BRC_BEAM_LAW_INNER = 5 };

typedef struct brc_beam_law {
    const char *name;                  /* of the packings it was fitted to */
    double radius_spread;              /* of these packings: radii within this either side of their mean [-] */
    double coordination[2], radius[2]; /* ranges of cn and r_m it was fitted in */
    double poisson[BRC_BEAM_LAW_ROWS][BRC_BEAM_LAW_COLUMNS]; /* P_ij */
    double young[BRC_BEAM_LAW_ROWS][BRC_BEAM_LAW_COLUMNS];   /* Y_ij */
    double paper_poisson[4][4];                              /* rows a1 b1 c1 d1, columns A B C D */
    double paper_young[4][4];                                /* rows a2 b2 c2 d2 */
    double inner[BRC_BEAM_LAW_INNER]; /* mean bonds of an element away from the walls over cn, in these packings: sum
                                         inner_j T_j(t) */
} brc_beam_law;

/* The built-in law whose packings' spread is nearest; static storage. */
const brc_beam_law *brc_beam_law_for(double radius_spread);
/* nu [-] and E / E_m [-] of a sample. */
double brc_beam_law_poisson(const brc_beam_law *law, double coordination, double radius);
double brc_beam_law_young(const brc_beam_law *law, double coordination, double radius);
/* The same by the paper's form: rows and columns as paper_poisson and paper_young. */
double brc_beam_law_paper_poisson(const double c[4][4], double coordination, double radius);
double brc_beam_law_paper_young(const double c[4][4], double coordination, double radius);
/* The products T_i(s) T_j(t) of a law's ranges, row i, column j. */
void brc_beam_law_terms(const brc_beam_law *law, double coordination, double radius,
                        double out[BRC_BEAM_LAW_ROWS][BRC_BEAM_LAW_COLUMNS]);
/* cn_in / cn of the fit's packings. */
double brc_beam_law_inner(const brc_beam_law *law, double coordination);
/* The cn of the fit's packings that has the body's bonds inside, within the range of the fit; the body's own where its
 * inside is not known, or the fit's. */
double brc_beam_law_coordination(const brc_beam_law *law, const brc_beam_body *body);
/* E by the bounding box of the body over that of the fit's packings with the same bonds inside (brc_beam_body.reading)
 * [-]; 1 where the body's is not known. */
double brc_beam_law_reading(const brc_beam_body *body);
/* r_m [-] and E_m [Pa] that give nu and young [Pa] in a body. BRC_BAD_INPUT: nu that beams cannot reach at its
 * coordination number (with the range they can), a coordination number outside the fit. *warning (may be NULL) becomes
 * true when r_m lies so near to an end of the fit's range that nu hardly depends on it there. */
brc_status brc_beam_law_invert(brc_context *context, const brc_beam_law *law, const brc_beam_body *body, double nu,
                               double young, double *radius, double *beam_young, bool *warning);

#endif
