/* Gauss-Legendre quadrature, for exact references. */
#ifndef BRC_COMMANDS_REFERENCE_GAUSS_H
#define BRC_COMMANDS_REFERENCE_GAUSS_H

/* P_n(x) and its derivative; |x| < 1. */
void brc_reference_legendre(int n, double x, double *value, double *slope);
/* n points and weights on [0, 1]: exact to degree 2 n - 1. */
void brc_reference_gauss(int n, double *x, double *w);

#endif
