/* Laws that studies are held against, and how sure a mean is. */
#include "study.h"
#include <math.h>

double brc_study_student(int freedom)
{
    static const double table[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086};
    enum { N = sizeof table / sizeof *table };
    return freedom < 1 ? NAN : freedom <= N ? table[freedom - 1] : 1.96 + 2.4 / freedom;
}

/* Zero of this is the modulus: sum x^m ln x / sum x^m - 1/m - mean ln x, which grows with m. x over the largest, so that powers stay finite. */
static double likelihood(int n, const double *x, double largest, double m)
{
    double powers = 0, weighted = 0, logs = 0;
    for (int i = 0; i < n; ++i) {
        const double l = log(x[i] / largest), power = exp(m * l);
        powers += power;
        weighted += power * l;
        logs += l;
    }
    return weighted / powers - 1 / m - logs / n;
}

bool brc_study_weibull(int n, const double *x, double *modulus, double *scale)
{
    enum { HALVINGS = 200 };
    double largest = 0, smallest = INFINITY, low = 1e-3, high = 1, powers = 0;
    for (int i = 0; i < n; ++i) {
        largest = fmax(largest, x[i]);
        smallest = fmin(smallest, x[i]);
    }
    if (n < 2 || !(smallest > 0) || !(largest > smallest) || !isfinite(largest)) return false;
    while (likelihood(n, x, largest, high) < 0 && high < 1e9) high *= 2;
    for (int i = 0; i < HALVINGS && high > low; ++i) {
        const double middle = 0.5 * (low + high);
        if (likelihood(n, x, largest, middle) < 0) low = middle;
        else high = middle;
    }
    *modulus = 0.5 * (low + high);
    for (int i = 0; i < n; ++i) powers += pow(x[i] / largest, *modulus);
    *scale = largest * pow(powers / n, 1 / *modulus);
    return true;
}

bool brc_study_power(int n, const double *x, const double *y, double *a, double *b, double *error)
{
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, left = 0;
    for (int i = 0; i < n; ++i) {
        if (!(x[i] > 0 && y[i] > 0)) return false;
        mean_x += log(x[i]) / n;
        mean_y += log(y[i]) / n;
    }
    for (int i = 0; i < n; ++i) {
        xx += (log(x[i]) - mean_x) * (log(x[i]) - mean_x);
        xy += (log(x[i]) - mean_x) * (log(y[i]) - mean_y);
    }
    if (n < 2 || !(xx > 1e-20)) return false;
    *b = xy / xx;
    *a = exp(mean_y - *b * mean_x);
    for (int i = 0; i < n; ++i) {
        const double off = log(y[i]) - mean_y - *b * (log(x[i]) - mean_x);
        left += off * off;
    }
    *error = n > 2 ? sqrt(left / (n - 2) / xx) : NAN;
    return true;
}
