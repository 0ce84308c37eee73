/* Least squares by normal equations: with x scaled to [-1, 1] and at most four unknowns their condition is at most 1e5,
 * which leaves eleven digits. */
#include "fit.h"
#include <math.h>

#define MAX_ORDER 3
#define UNLOADED 1e-9 /* [-] of the largest value: rounding of a state that is zero */

static double largest(int64_t n, const double *v)
{
    double most = 0;
    for (int64_t k = 0; k < n; ++k)
        most = fmax(most, fabs(v[k]));
    return most;
}

/* Number of different x, counted up to `enough`; x = 0 does not count where the origin is known anyway. */
static int distinct(int64_t n, const double *x, double scale, bool without_zero, int enough)
{
    double seen[MAX_ORDER + 2];
    int n_seen = 0;
    for (int64_t k = 0; k < n && n_seen < enough; ++k) {
        bool fresh = !(without_zero && fabs(x[k]) <= UNLOADED * scale);
        for (int j = 0; j < n_seen && fresh; ++j)
            fresh = fabs(x[k] - seen[j]) > UNLOADED * scale;
        if (fresh) seen[n_seen++] = x[k];
    }
    return n_seen;
}

/* Cholesky in place; false where the matrix is not safely positive. */
static bool solve(int m, double a[MAX_ORDER + 1][MAX_ORDER + 1], double *b)
{
    for (int i = 0; i < m; ++i) {
        const double before = a[i][i];
        for (int j = 0; j <= i; ++j) {
            for (int k = 0; k < j; ++k)
                a[i][j] -= a[i][k] * a[j][k];
            if (j < i) a[i][j] /= a[j][j];
        }
        if (!(a[i][i] > 1e-13 * before)) return false;
        a[i][i] = sqrt(a[i][i]);
        for (int k = 0; k < i; ++k)
            b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (int i = m - 1; i >= 0; --i) {
        for (int k = i + 1; k < m; ++k)
            b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

/* Powers first..order of x / scale; c: [4]. */
static bool fit_order(int64_t n, const double *x, const double *y, double scale, int first, int order, double *c,
                      double *residual)
{
    const int m = order - first + 1;
    double a[MAX_ORDER + 1][MAX_ORDER + 1] = {{0}};
    double b[MAX_ORDER + 1] = {0};
    for (int64_t k = 0; k < n; ++k) {
        const double t = x[k] / scale;
        double power[MAX_ORDER + 1];
        power[0] = first ? t : 1;
        for (int i = 1; i < m; ++i)
            power[i] = power[i - 1] * t;
        for (int i = 0; i < m; ++i) {
            b[i] += power[i] * y[k];
            for (int j = 0; j <= i; ++j)
                a[i][j] += power[i] * power[j];
        }
    }
    if (!solve(m, a, b)) return false;
    for (int i = 0; i <= MAX_ORDER; ++i)
        c[i] = i >= first && i <= order ? b[i - first] : 0;
    double sum = 0;
    for (int64_t k = 0; k < n; ++k) {
        const double t = x[k] / scale;
        const double error = y[k] - (c[0] + t * (c[1] + t * (c[2] + t * c[3])));
        sum += error * error;
    }
    *residual = sqrt(sum / (double)n);
    for (int i = 1; i <= MAX_ORDER; ++i)
        c[i] /= pow(scale, i);
    return true;
}

brc_fit brc_fit_polynomial(int64_t n, const double *x, const double *y)
{
    brc_fit best = {0};
    const double x_scale = largest(n, x), y_scale = largest(n, y);
    if (n < 1 || !(x_scale > 0) || !isfinite(x_scale) || !isfinite(y_scale)) return best;
    best.through_origin = fabs(x[0]) <= UNLOADED * x_scale && fabs(y[0]) <= UNLOADED * y_scale;
    const int first = best.through_origin ? 1 : 0;
    const int points = distinct(n, x, x_scale, best.through_origin, MAX_ORDER + 1);
    for (int order = 1; order <= MAX_ORDER && order + 1 - first <= points; ++order) {
        double c[MAX_ORDER + 1], residual;
        if (!fit_order(n, x, y, x_scale, first, order, c, &residual)) break;
        if (best.order > 0 && !(residual < ldexp(best.residual, best.order - order))) continue;
        best.order = order;
        best.residual = residual;
        for (int i = 0; i <= MAX_ORDER; ++i)
            best.coefficient[i] = c[i];
    }
    return best;
}
