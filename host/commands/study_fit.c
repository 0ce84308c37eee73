/* Laws that measures of studies are held against, and how sure a mean is. */
#include "study.h"
#include <math.h>

double brc_study_student(int freedom)
{
    static const double table[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                   2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086};
    enum { N = sizeof table / sizeof *table };
    return freedom < 1 ? NAN : freedom <= N ? table[freedom - 1] : 1.96 + 2.4 / freedom;
}

static void add(brc_study_found *found, const char *name, double value, double error)
{
    found->parameter[found->n_parameters].name = name;
    found->parameter[found->n_parameters].value = value;
    found->parameter[found->n_parameters++].error = error;
}

/* Zero of this is the modulus: sum x^m ln x / sum x^m - 1/m - mean ln x, which grows with m. x over the largest, so
 * that powers stay finite. */
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

brc_study_found brc_study_fit_weibull(int n, const double *x)
{
    enum { HALVINGS = 200 };
    /* Standard errors over the root of n: of the modulus as a share of it, and of modulus times the logarithm of the
     * scale; the inverse of Fisher's information, sqrt(6) / pi and sqrt(1 + 6 (1 - gamma)^2 / pi^2). */
    static const double MODULUS_ERROR = 0.7796968, SCALE_ERROR = 1.0529316;
    brc_study_found found = {.n = n};
    double largest = 0, smallest = INFINITY, low = 1e-3, high = 1, powers = 0;
    for (int i = 0; i < n; ++i) {
        largest = fmax(largest, x[i]);
        smallest = fmin(smallest, x[i]);
    }
    if (n < 2 || !(smallest > 0) || !(largest > smallest) || !isfinite(largest)) return found;
    while (likelihood(n, x, largest, high) < 0 && high < 1e9)
        high *= 2;
    for (int i = 0; i < HALVINGS && high > low; ++i) {
        const double middle = 0.5 * (low + high);
        if (likelihood(n, x, largest, middle) < 0)
            low = middle;
        else
            high = middle;
    }
    const double modulus = 0.5 * (low + high);
    for (int i = 0; i < n; ++i)
        powers += pow(x[i] / largest, modulus);
    const double scale = largest * pow(powers / n, 1 / modulus);
    add(&found, "modulus", modulus, MODULUS_ERROR * modulus / sqrt(n));
    if (n > 2) add(&found, "unbiased_modulus", modulus * (n - 2) / (n - 0.68), NAN);
    add(&found, "scale", scale, SCALE_ERROR * scale / modulus / sqrt(n));
    return found;
}

brc_study_found brc_study_fit_power(int n, const double *x, const double *y)
{
    brc_study_found found = {.n = n};
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, left = 0;
    for (int i = 0; i < n; ++i) {
        if (!(x[i] > 0 && y[i] > 0)) return found;
        mean_x += log(x[i]) / n;
        mean_y += log(y[i]) / n;
    }
    for (int i = 0; i < n; ++i) {
        xx += (log(x[i]) - mean_x) * (log(x[i]) - mean_x);
        xy += (log(x[i]) - mean_x) * (log(y[i]) - mean_y);
    }
    if (n < 2 || !(xx > 1e-20)) return found;
    const double exponent = xy / xx, factor = exp(mean_y - exponent * mean_x);
    for (int i = 0; i < n; ++i) {
        const double off = log(y[i]) - mean_y - exponent * (log(x[i]) - mean_x);
        left += off * off;
    }
    const double square = n > 2 ? left / (n - 2) : NAN;
    add(&found, "exponent", exponent, sqrt(square / xx));
    add(&found, "factor", factor, factor * sqrt(square * (1.0 / n + mean_x * mean_x / xx)));
    return found;
}

/* Sum of the squares of ln y - ln strength + ln(1 + x / size) / 2 with the best strength. */
static double size_effect_left(int n, const double *x, const double *y, double size, double *strength)
{
    double mean = 0, left = 0;
    for (int i = 0; i < n; ++i)
        mean += (log(y[i]) + 0.5 * log1p(x[i] / size)) / n;
    for (int i = 0; i < n; ++i) {
        const double off = log(y[i]) + 0.5 * log1p(x[i] / size) - mean;
        left += off * off;
    }
    *strength = exp(mean);
    return left;
}

/* Standard errors from the derivatives of ln y by ln strength, 1, and by ln size, (x / size) / (1 + x / size) / 2. */
static void add_size_effect(brc_study_found *found, int n, const double *x, double left, double strength, double size)
{
    double mean = 0, spread = 0;
    for (int i = 0; i < n; ++i)
        mean += 0.5 * x[i] / (size + x[i]) / n;
    for (int i = 0; i < n; ++i)
        spread += (0.5 * x[i] / (size + x[i]) - mean) * (0.5 * x[i] / (size + x[i]) - mean);
    const double square = left / (n - 2);
    add(found, "strength", strength, strength * sqrt(square * (1.0 / n + mean * mean / spread)));
    add(found, "size", size, size * sqrt(square / spread));
}

brc_study_found brc_study_fit_size_effect(int n, const double *x, const double *y)
{
    enum { TRIALS = 400, NARROWINGS = 100 };
    static const double BEYOND = 1e4; /* a size that far from all x stands for a power law */
    brc_study_found found = {.n = n};
    double smallest = INFINITY, largest = 0, strength, least = INFINITY, best = 0;
    for (int i = 0; i < n; ++i) {
        if (!(x[i] > 0 && y[i] > 0)) return found;
        smallest = fmin(smallest, x[i]);
        largest = fmax(largest, x[i]);
    }
    bool third = false;
    for (int i = 0; i < n; ++i)
        third |= x[i] > smallest * (1 + 1e-9) && x[i] < largest * (1 - 1e-9);
    if (!third) return found;
    const double low = log(smallest / BEYOND), step = (log(largest * BEYOND) - low) / TRIALS;
    for (int k = 0; k <= TRIALS; ++k) {
        const double left = size_effect_left(n, x, y, exp(low + k * step), &strength);
        if (left < least) least = left, best = k;
    }
    if (best < 0.5 || best > TRIALS - 0.5) return found;
    double from = low + (best - 1) * step, to = low + (best + 1) * step;
    for (int k = 0; k < NARROWINGS; ++k) {
        const double a = from + (to - from) / 3, b = to - (to - from) / 3;
        if (size_effect_left(n, x, y, exp(a), &strength) < size_effect_left(n, x, y, exp(b), &strength))
            to = b;
        else
            from = a;
    }
    const double size = exp(0.5 * (from + to)), left = size_effect_left(n, x, y, size, &strength);
    add_size_effect(&found, n, x, left, strength, size);
    return found;
}
