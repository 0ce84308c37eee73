/* Chebyshev polynomials, of which the fitted laws of beams are made. */
#ifndef BRC_SOLVER_CHEBYSHEV_H
#define BRC_SOLVER_CHEBYSHEV_H

/* T_0(x) to T_(n-1)(x), n >= 2. */
static inline void brc_chebyshev(double x, int n, double *out)
{
    out[0] = 1;
    out[1] = x;
    for (int k = 2; k < n; ++k)
        out[k] = 2 * x * out[k - 1] - out[k - 2];
}

/* x in -1 to 1 of a value within a range. */
static inline double brc_chebyshev_place(const double range[2], double value)
{
    return (2 * value - range[0] - range[1]) / (range[1] - range[0]);
}

#endif
