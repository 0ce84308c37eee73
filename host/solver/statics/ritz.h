/* Small dense eigenproblems of the modes, by LAPACK. */
#ifndef BRC_SOLVER_STATICS_RITZ_H
#define BRC_SOLVER_STATICS_RITZ_H

#include "../../base/status.h"
#include <stdbool.h>

/* Rayleigh-Ritz: the m lowest pairs of the projected problem, of smallest value where it is not symmetric. k_small,
 * g_small [count][count]; coefficients [m][count]. */
brc_status brc_rayleigh_ritz(brc_context *context, bool symmetric, int m, int count, const double *k_small,
                             const double *g_small, double *values, double *coefficients);

#endif
