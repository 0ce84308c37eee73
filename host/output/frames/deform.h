/* How cells are drawn deformed. */
#ifndef BRC_OUTPUT_DEFORM_H
#define BRC_OUTPUT_DEFORM_H

#include "../../../preprocess/domain/domain.h"

/* Displacement gradient of an element by least squares over its neighbours, weights S/L (docs/notebook/theory.md
 * T2): H = sum (u_j - u_i) (x) s A^-1, A = sum (L/S) s (x) s. Zero, so that the cell moves rigidly, where the
 * neighbours do not span space. whole: [n_half_edges] 1 where the bond is unbroken, only those count; NULL: all.
 * displacement: [n_elements][3] [m]; gradient: row i = d u_i / d x_j [-]. */
void brc_deform_gradient(const brc_domain *domain, const uint8_t *whole, const double *displacement, int64_t element,
                         double gradient[3][3]);
/* Displacement of point x [m] of the element: u_i + H (x - X_i). */
void brc_deform_point(const brc_domain *domain, const double *displacement, int64_t element,
                      const double gradient[3][3], const double x[3], double out[3]);
/* Mises stress [Pa] of xx yy zz yz xz xy. */
double brc_deform_von_mises(const double stress[6]);

#endif
