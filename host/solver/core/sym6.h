/* Symmetric matrices of displacements and rotations. */
#ifndef BRC_SOLVER_SYM6_H
#define BRC_SOLVER_SYM6_H

#include <stdbool.h>

/* a, of which what is below the diagonal is not looked at, becomes its inverse above it. False: not positive. In the
 * order of sums of the reference LAPACK (dpotrf, dpotri), and so with its bits. */
bool brc_sym6_invert(double a[6][6]);

#endif
