/* Coefficients of dlsm whose rounding does not turn a body (docs/notebook/theory.md T8). In a body turned by a large
 * angle the displacement gradient is of order 1, and forces of order E S cancel: (k (1 + tau)/q) (u_j - u_i) against
 * the bond part of B. What the rounding of the stored coefficients leaves of them turns with the body's angle, not with
 * the step: a torque of one sign, where the rounding of the arithmetic itself averages out. */
#ifndef BRC_SOLVER_MODELS_DLSM_CONSISTENT_H
#define BRC_SOLVER_MODELS_DLSM_CONSISTENT_H

#include "../../core/solver.h"

/* Area vector s [m^2] and ratio q = L/S [1/m] of a half-edge of an element as the device holds them, such that q s is
 * the branch to one rounding a component; s differs from the domain's area vector by rounding alone. */
void brc_consistent_bond(const brc_simulation *s, int64_t element, int64_t half_edge, double area[3], double *ratio);

/* A^-1 [m^-3] (xx yy zz yz xz xy) of an element whose neighbours span space, from the coefficients the device will
 * hold: in a turned body the sum over its bonds of R (x) force then vanishes, but for the rounding of the six
 * numbers. */
void brc_consistent_inverse(const brc_simulation *s, int64_t element, double out[6]);

#endif
