/* Points and weights by Newton iteration on the polynomial. */
#include "reference_gauss.h"
#include <math.h>

void brc_reference_legendre(int n, double x, double *value, double *slope)
{
    double before = 1, now = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
    }
    *value = n == 0 ? 1 : now;
    *slope = n == 0 ? 0 : n * (before - x * now) / (1 - x * x);
}

void brc_reference_gauss(int n, double *x, double *w)
{
    for (int k = 0; k < n; ++k) {
        double z = cos(M_PI * (k + 0.75) / (n + 0.5)), value, slope;
        for (int round = 0; round < 100; ++round) {
            brc_reference_legendre(n, z, &value, &slope);
            z -= value / slope;
            if (fabs(value / slope) < 1e-15) break;
        }
        brc_reference_legendre(n, z, &value, &slope);
        x[k] = (1 + z) / 2;
        w[k] = 1 / ((1 - z * z) * slope * slope);
    }
}
