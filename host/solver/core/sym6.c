#include "sym6.h"
#include <math.h>

/* Three rows from `first` on become those of U in U^T U. */
static bool factor3(double a[6][6], int first)
{
    for (int k = first; k < first + 3; ++k) {
        if (!(a[k][k] > 0)) return false;
        a[k][k] = sqrt(a[k][k]);
        for (int j = k + 1; j < first + 3; ++j)
            a[k][j] /= a[k][k];
        for (int j = k + 1; j < first + 3; ++j)
            for (int i = k + 1; i <= j; ++i)
                a[i][j] -= a[k][i] * a[k][j];
    }
    return true;
}

static bool factor(double a[6][6])
{
    if (!factor3(a, 0)) return false;
    for (int j = 3; j < 6; ++j) {
        a[0][j] /= a[0][0];
        a[1][j] = (a[1][j] - a[0][1] * a[0][j]) / a[1][1];
        a[2][j] = (a[2][j] - a[0][2] * a[0][j] - a[1][2] * a[1][j]) / a[2][2];
    }
    for (int j = 3; j < 6; ++j)
        for (int i = 3; i <= j; ++i)
            a[i][j] -= a[0][i] * a[0][j] + a[1][i] * a[1][j] + a[2][i] * a[2][j];
    return factor3(a, 3);
}

bool brc_sym6_invert(double a[6][6])
{
    if (!factor(a)) return false;
    for (int j = 0; j < 6; ++j) { /* U^-1 */
        a[j][j] = 1 / a[j][j];
        for (int k = 0; k < j; ++k) {
            for (int i = 0; i < k; ++i)
                a[i][j] += a[k][j] * a[i][k];
            a[k][j] *= a[k][k];
        }
        for (int i = 0; i < j; ++i)
            a[i][j] *= -a[j][j];
    }
    for (int i = 0; i < 6; ++i) { /* U^-1 U^-T */
        const double own = a[i][i];
        a[i][i] *= own;
        for (int k = i + 1; k < 6; ++k)
            a[i][i] += a[i][k] * a[i][k];
        for (int r = 0; r < i; ++r) {
            a[r][i] *= own;
            for (int k = i + 1; k < 6; ++k)
                a[r][i] += a[i][k] * a[r][k];
        }
    }
    return true;
}
