/* A coarse spectrum by a radix-2 FFT finds the peak, a golden section on the exact transform places it. */
#include "spectrum.h"
#include "../../base/memory.h"
#include <math.h>

/* In place, n a power of two, forward. */
static void transform(int64_t n, double *re, double *im)
{
    for (int64_t i = 1, j = 0; i < n; ++i) { /* bit reversal */
        int64_t bit = n >> 1;
        for (; j & bit; bit >>= 1)
            j ^= bit;
        j ^= bit;
        if (i >= j) continue;
        const double r = re[i], m = im[i];
        re[i] = re[j], im[i] = im[j];
        re[j] = r, im[j] = m;
    }
    for (int64_t length = 2; length <= n; length *= 2) {
        for (int64_t k = 0; k < length / 2; ++k) {
            const double angle = -2 * M_PI * (double)k / (double)length;
            const double c = cos(angle), s = sin(angle);
            for (int64_t i = k; i < n; i += length) {
                const int64_t j = i + length / 2;
                const double r = re[j] * c - im[j] * s, m = re[j] * s + im[j] * c;
                re[j] = re[i] - r, im[j] = im[i] - m;
                re[i] += r, im[i] += m;
            }
        }
    }
}

/* Power of the windowed record at `frequency` cycles per sample. */
static double power_at(int64_t n, const double *windowed, double frequency)
{
    double re = 0, im = 0;
    for (int64_t k = 0; k < n; ++k) {
        const double angle = 2 * M_PI * frequency * (double)k;
        re += windowed[k] * cos(angle);
        im += windowed[k] * sin(angle);
    }
    return re * re + im * im;
}

static double refine(int64_t n, const double *windowed, double low, double high)
{
    const double golden = (sqrt(5.0) - 1) / 2;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = power_at(n, windowed, a), at_b = power_at(n, windowed, b);
    for (int k = 0; k < 40; ++k) { /* 0.618^40 = 4e-9 of a bin */
        if (at_a < at_b) {
            low = a;
            a = b, at_a = at_b;
            b = low + golden * (high - low);
            at_b = power_at(n, windowed, b);
        } else {
            high = b;
            b = a, at_b = at_a;
            a = high - golden * (high - low);
            at_a = power_at(n, windowed, a);
        }
    }
    return (low + high) / 2;
}

/* windowed: [n] window times (signal minus its window-weighted mean). False where only rounding is left. */
static bool apply_window(int64_t n, const double *signal, double *windowed)
{
    double weighted = 0, weight = 0;
    for (int64_t k = 0; k < n; ++k) {
        windowed[k] = 0.5 - 0.5 * cos(2 * M_PI * ((double)k + 0.5) / (double)n);
        weighted += windowed[k] * signal[k];
        weight += windowed[k];
    }
    double most = 0, offset = 0;
    for (int64_t k = 0; k < n; ++k) {
        offset = fmax(offset, fabs(signal[k]));
        windowed[k] *= signal[k] - weighted / weight;
        most = fmax(most, fabs(windowed[k]));
    }
    return most > 1e-12 * offset;
}

brc_status brc_spectrum_peak(brc_context *context, int64_t n, const double *signal, double interval, double *out)
{
    double *windowed = NULL, *re = NULL, *im = NULL;
    brc_status status = BRC_OK;
    *out = NAN;
    if (n < 8) return BRC_OK;
    int64_t padded = 16;
    while (padded < 2 * n) /* half a bin of the record between points: no peak falls through */
        padded *= 2;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &windowed, n, "spectrum"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &re, padded, "spectrum"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &im, padded, "spectrum"));
    if (!apply_window(n, signal, windowed)) goto cleanup;
    for (int64_t k = 0; k < n; ++k)
        re[k] = windowed[k];
    transform(padded, re, im);
    for (int64_t k = 0; k <= padded / 2; ++k)
        re[k] = re[k] * re[k] + im[k] * im[k];
    int64_t best = 0;
    for (int64_t k = (padded + n - 1) / n; k < padded / 2; ++k) /* from one period in the record */
        if (re[k] >= re[k - 1] && re[k] >= re[k + 1] && re[k] > 0 && (best == 0 || re[k] > re[best])) best = k;
    if (best > 0)
        *out = refine(n, windowed, (double)(best - 1) / (double)padded, (double)(best + 1) / (double)padded) / interval;
cleanup:
    brc_memory_free(windowed);
    brc_memory_free(re);
    brc_memory_free(im);
    return status;
}
