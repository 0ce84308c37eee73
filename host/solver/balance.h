/* Forces that no support takes: only what does not move a body as a whole can be balanced by its elasticity. */
#ifndef BRC_SOLVER_BALANCE_H
#define BRC_SOLVER_BALANCE_H

#include <stdint.h>

/* Take a + b x r off the forces at places r [n][3] so that their sum, and their moment together with the torques (NULL: none) [n][3], are zero.
 * *rigid: size (root of the sum of squares) of what was taken off [N]. */
void brc_balance(int64_t n, const double *place, const double *torque, double *force, double *rigid);

#endif
