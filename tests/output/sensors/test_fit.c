#include "../support.h"
#include "../../../host/base/random.h"
#include "../../../host/output/sensors/fit.h"
#include <math.h>

static void one_loaded_point_after_the_unloaded_state_gives_y_over_x(void **state)
{
    (void)state;
    const double x[] = {0, 2e-7}, y[] = {0, 4000};
    const brc_fit fit = brc_fit_polynomial(2, x, y);
    assert_true(fit.through_origin);
    assert_int_equal(fit.order, 1);
    assert_true(fabs(fit.coefficient[1] / 2e10 - 1) < 1e-15); /* one division */
}

/* Nominal stress of the law under uniaxial strain-free tension: E (1 + e)(e + e^2/2), a cubic. */
static void the_nonlinearity_of_the_law_does_not_bias_the_slope_at_zero(void **state)
{
    (void)state;
    const double E = 20e9;
    for (int n = 3; n <= 8; ++n) {
        double x[9], y[9];
        for (int k = 0; k <= n; ++k) {
            x[k] = 0.02 * k / n;
            y[k] = E * (1 + x[k]) * (x[k] + x[k] * x[k] / 2);
        }
        const brc_fit fit = brc_fit_polynomial(n + 1, x, y);
        assert_int_equal(fit.order, 3);
        assert_true(fabs(fit.coefficient[1] / E - 1) < 1e-9); /* eleven digits of the equations less two of the cubic */
        assert_true(fabs(fit.coefficient[2] / (1.5 * E) - 1) < 1e-6);
    }
}

static void two_loaded_points_give_the_parabola_through_the_origin(void **state)
{
    (void)state;
    const double x[] = {0, 1, 2}, y[] = {0, 3 + 0.5, 6 + 2};
    const brc_fit fit = brc_fit_polynomial(3, x, y);
    assert_int_equal(fit.order, 2);
    assert_true(fabs(fit.coefficient[1] - 3) < 1e-12 && fabs(fit.coefficient[2] - 0.5) < 1e-12);
}

static void data_that_start_under_load_are_not_forced_through_the_origin(void **state)
{
    (void)state;
    double x[10], y[10];
    for (int k = 0; k < 10; ++k) {
        x[k] = 1 + 0.1 * k;
        y[k] = 5 + 2 * x[k] + 0.25 * x[k] * x[k];
    }
    const brc_fit fit = brc_fit_polynomial(10, x, y);
    assert_false(fit.through_origin);
    assert_true(fabs(fit.coefficient[0] - 5) < 1e-8); /* extrapolated from 1..2 to 0 */
    assert_true(fabs(fit.coefficient[1] - 2) < 1e-8);
}

static void noise_is_not_fitted_by_higher_orders(void **state)
{
    (void)state;
    enum { N = 500 };
    static double x[N], y[N];
    for (int k = 0; k < N; ++k) {
        double r[4];
        brc_random_uniform4(1, BRC_RANDOM_TEST, (uint64_t)k, 0, r);
        x[k] = (double)k / N;
        y[k] = k ? 3 * x[k] + 0.02 * (r[0] - 0.5) : 0;
    }
    const brc_fit fit = brc_fit_polynomial(N, x, y);
    assert_int_equal(fit.order, 1);
    /* sigma of the slope: noise 0.0058 / sqrt(sum x^2) = 0.0058 / 12.9 = 4.5e-4; five of them */
    assert_true(fabs(fit.coefficient[1] - 3) < 2.3e-3);
    assert_true(fabs(fit.residual - 0.02 / sqrt(12)) < 1e-3);
}

static void an_odd_law_over_both_signs_is_followed(void **state)
{
    (void)state;
    double x[21], y[21];
    for (int k = 0; k < 21; ++k) {
        x[k] = (k - 10) * 0.1;
        y[k] = 2 * x[k] - 0.7 * pow(x[k], 3);
    }
    assert_true(fabs(brc_fit_polynomial(21, x, y).coefficient[1] - 2) < 1e-12);
}

static void what_does_not_vary_gives_no_fit(void **state)
{
    (void)state;
    const double zero[] = {0, 0, 0}, same[] = {1, 1, 1}, y[] = {1, 2, 3};
    assert_int_equal(brc_fit_polynomial(3, zero, y).order, 0);
    assert_int_equal(brc_fit_polynomial(3, same, y).order, 0);
    assert_int_equal(brc_fit_polynomial(0, zero, y).order, 0);
    assert_int_equal(brc_fit_polynomial(1, zero, zero).order, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_loaded_point_after_the_unloaded_state_gives_y_over_x),
        cmocka_unit_test(the_nonlinearity_of_the_law_does_not_bias_the_slope_at_zero),
        cmocka_unit_test(two_loaded_points_give_the_parabola_through_the_origin),
        cmocka_unit_test(data_that_start_under_load_are_not_forced_through_the_origin),
        cmocka_unit_test(noise_is_not_fitted_by_higher_orders),
        cmocka_unit_test(an_odd_law_over_both_signs_is_followed),
        cmocka_unit_test(what_does_not_vary_gives_no_fit),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
