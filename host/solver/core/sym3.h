/* Vectors and symmetric 3 x 3 matrices on the host, packed xx yy zz yz xz xy. */
#ifndef BRC_SOLVER_SYM3_H
#define BRC_SOLVER_SYM3_H

#include <math.h>

static inline double brc_dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline double brc_norm3(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Eigenvalues ascending and, if vectors is not 0, unit eigenvectors in its rows (cyclic Jacobi, to rounding). */
void brc_sym3_eigen(const double a[6], double values[3], double vectors[3][3]);
/* Inverse over the directions whose eigenvalue exceeds `relative` of the largest; zero over the others. Returns the
 * number of directions kept (3: the plain inverse). */
int brc_sym3_pseudo_inverse(const double a[6], double relative, double out[6]);

#endif
