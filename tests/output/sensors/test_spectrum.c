#include "../support.h"
#include "../../../host/output/sensors/spectrum.h"
#include <math.h>

enum { N = 2000 };

static double peak_of(int64_t n, const double *signal, double interval)
{
    double frequency;
    assert_int_equal(brc_spectrum_peak(test_context, n, signal, interval, &frequency), BRC_OK);
    return frequency;
}

/* The promise of the header: ten periods and more, any phase, any offset, any place between bins: 1e-4. */
static void ten_periods_give_four_digits_wherever_the_peak_lies(void **state)
{
    (void)state;
    static double signal[N];
    double worst = 0;
    for (int p = 0; p < 12; ++p)
        for (int b = 0; b < 7; ++b) {
            const double periods = 10 + b / 7.0, truth = 440.0, interval = periods / truth / N;
            for (int k = 0; k < N; ++k)
                signal[k] = 3 + 1e-6 * cos(2 * M_PI * truth * interval * k + p * M_PI / 6);
            worst = fmax(worst, fabs(peak_of(N, signal, interval) / truth - 1));
        }
    assert_true(worst < 1e-4);
}

/* 1 % of critical damping over 30 periods loses 85 % of the amplitude; the peak stays at the damped frequency. */
static void damping_does_not_move_the_peak(void **state)
{
    (void)state;
    static double signal[N];
    const double truth = 1105.0, periods = 30.4, interval = periods / truth / N;
    for (int k = 0; k < N; ++k) {
        const double t = interval * k;
        signal[k] = exp(-0.01 * 2 * M_PI * truth * t) * cos(2 * M_PI * truth * t + 0.3);
    }
    assert_true(fabs(peak_of(N, signal, interval) / truth - 1) < 1e-4);
}

static void the_largest_of_several_modes_is_found_and_not_pulled_by_the_others(void **state)
{
    (void)state;
    static double signal[N];
    const double truth = 700.0, interval = 12.3 / truth / N;
    for (int k = 0; k < N; ++k) {
        const double t = interval * k;
        signal[k] = cos(2 * M_PI * truth * t + 1) + 0.3 * cos(2 * M_PI * 2.31 * truth * t) +
                    0.1 * sin(2 * M_PI * 5.17 * truth * t);
    }
    assert_true(fabs(peak_of(N, signal, interval) / truth - 1) < 1e-4);
    for (int k = 0; k < N; ++k)
        signal[k] += 2 * cos(2 * M_PI * 2.31 * truth * interval * k); /* now the second one is the largest */
    assert_true(fabs(peak_of(N, signal, interval) / (2.31 * truth) - 1) < 1e-4);
}

static void any_number_of_samples_will_do(void **state)
{
    (void)state;
    static double signal[N];
    for (int n = 97; n < 1100; n += 83) {
        const double truth = 50.0, interval = 20.25 / truth / n;
        for (int k = 0; k < n; ++k)
            signal[k] = sin(2 * M_PI * truth * interval * k);
        assert_true(fabs(peak_of(n, signal, interval) / truth - 1) < 1e-4);
    }
}

static void what_does_not_vibrate_has_no_frequency(void **state)
{
    (void)state;
    double signal[64];
    for (int k = 0; k < 64; ++k)
        signal[k] = 7;
    assert_true(isnan(peak_of(64, signal, 1)));
    assert_true(isnan(peak_of(3, signal, 1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_periods_give_four_digits_wherever_the_peak_lies),
        cmocka_unit_test(damping_does_not_move_the_peak),
        cmocka_unit_test(the_largest_of_several_modes_is_found_and_not_pulled_by_the_others),
        cmocka_unit_test(any_number_of_samples_will_do),
        cmocka_unit_test(what_does_not_vibrate_has_no_frequency),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
