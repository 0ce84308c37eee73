#include "../support.h"
#include "../../../host/commands/references/reference_vibration.h"

static const double pi = 3.14159265358979323846;

static void expect_modes(double poisson, int n, const double *expected, double tolerance)
{
    brc_context *context = brc_context_create();
    const brc_reference_solid cube = {{1, 1, 1}, 1, poisson, 1, BRC_REFERENCE_BOX};
    double omega[16];
    assert_int_equal(brc_reference_vibration(context, &cube, 14, n, omega), BRC_OK);
    for (int k = 0; k < n; ++k)
        assert_near(omega[k], expected[k], tolerance);
    brc_context_free(&context);
}

/* Values of an independent computation printed to four decimals: half a unit of the last. */
static void cube_agrees_with_the_tabled_values_at_nu_0_2(void **state)
{
    (void)state;
    expect_modes(0.2, 8, (const double[]){1.8433, 1.8433, 2.4637, 2.4637, 2.4637, 2.5192, 2.5192, 2.5192}, 6e-5);
}

static void cube_agrees_with_the_tabled_values_near_incompressibility(void **state)
{
    (void)state;
    expect_modes(0.49, 8, (const double[]){1.6549, 1.6549, 2.2517, 2.2517, 2.2517, 2.2724, 2.2724, 2.2724}, 6e-5);
}

static void cube_agrees_with_the_tabled_values_at_nu_minus_0_5(void **state)
{
    (void)state;
    expect_modes(-0.5, 8, (const double[]){2.3177, 2.3177, 2.3177, 2.3559, 2.8509, 2.8509, 2.9794, 2.9794}, 6e-5);
}

/* Printed to three decimals beyond the fourth mode. */
static void cube_agrees_with_the_tabled_values_at_nu_minus_0_95(void **state)
{
    (void)state;
    expect_modes(-0.95, 8, (const double[]){2.0221, 2.1408, 2.1408, 2.1408, 4.829, 4.829, 5.396, 5.396}, 6e-4);
}

/* At nu = 0 a longitudinal motion u_x(x) leaves all side faces free of traction, so pi sqrt(E/rho)/L is an exact mode
 * of every box. Polynomials of degree 14 give it to better than 1e-9. */
static void longitudinal_mode_of_a_bar_is_exact_at_nu_0(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const brc_reference_solid bar = {{2, 0.5, 0.5}, 72e9, 0, 2500, BRC_REFERENCE_BOX};
    double omega[24];
    assert_int_equal(brc_reference_vibration(context, &bar, 14, 24, omega), BRC_OK);
    const double exact = pi / 2 * sqrt(72e9 / 2500);
    double nearest = INFINITY;
    for (int k = 0; k < 24; ++k)
        nearest = fmin(nearest, fabs(omega[k] / exact - 1));
    assert_true(nearest < 1e-9);
    brc_context_free(&context);
}

/* Lame modes of a cube: frequency sqrt(2) pi sqrt(mu/rho)/L at any nu, exact solutions with free faces. The cosines of
 * half a wave over the edge are polynomials of degree 14 to 1e-8. */
static void lame_mode_of_a_cube_is_found_at_any_nu(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    for (int k = 0; k < 3; ++k) {
        const double nu = (const double[]){-0.3, 0.2, 0.45}[k];
        const brc_reference_solid cube = {{1, 1, 1}, 1, nu, 1, BRC_REFERENCE_BOX};
        double omega[40];
        assert_int_equal(brc_reference_vibration(context, &cube, 14, 40, omega), BRC_OK);
        const double exact = sqrt(2) * pi * sqrt(1 / (2 * (1 + nu)));
        double nearest = INFINITY;
        for (int m = 0; m < 40; ++m)
            nearest = fmin(nearest, fabs(omega[m] / exact - 1));
        assert_true(nearest < 1e-7);
    }
    brc_context_free(&context);
}

/* Rayleigh-Ritz approaches from above. */
static void more_functions_lower_every_frequency(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const brc_reference_solid box = {{1, 1.3, 0.8}, 1, 0.3, 1, BRC_REFERENCE_BOX};
    double coarse[8], fine[8];
    assert_int_equal(brc_reference_vibration(context, &box, 6, 8, coarse), BRC_OK);
    assert_int_equal(brc_reference_vibration(context, &box, 10, 8, fine), BRC_OK);
    for (int k = 0; k < 8; ++k)
        assert_true(fine[k] <= coarse[k] * (1 + 1e-12));
    brc_context_free(&context);
}

static void a_degree_without_functions_is_refused(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const brc_reference_solid cube = {{1, 1, 1}, 1, 0.2, 1, BRC_REFERENCE_BOX};
    double omega[8];
    assert_int_equal(brc_reference_vibration(context, &cube, 21, 8, omega), BRC_BAD_INPUT);
    assert_int_equal(brc_reference_vibration(context, &cube, 1, 8, omega), BRC_BAD_INPUT);
    brc_context_free(&context);
}

/* The root of f between a and b. */
static double root(double (*f)(double), double a, double b)
{
    for (int k = 0; k < 100; ++k) {
        const double m = (a + b) / 2;
        if ((f(a) < 0) == (f(m) < 0))
            a = m;
        else
            b = m;
    }
    return a;
}

/* Torsion of a sphere (Lamb 1882), x = omega R / c_s: (n - 1) j_n(x) = x j_(n+1)(x); of order 2: j_2 = x j_3. */
static double torsion_of_order_2(double x)
{
    const double s = sin(x), c = cos(x);
    const double j2 = (3 / (x * x) - 1) * s / x - 3 * c / (x * x),
                 j3 = (15 / (x * x * x) - 6 / x) * s / x - (15 / (x * x) - 1) * c / x;
    return j2 - x * j3;
}

/* Breathing of a sphere, y = omega R / c_p at nu = 0.25, where c_p^2 = 3 c_s^2: tan y / y = 1 / (1 - y^2 / (4 c_s^2 /
 * c_p^2)). */
static double breathing(double y)
{
    return sin(y) * (1 - 0.75 * y * y) - y * cos(y);
}

/* Modes of the sphere in closed form by spherical Bessel functions: the lowest five are torsion of order 2, the
 * breathing mode is further up. Polynomials of degree 12 give the former to 1e-9 or better (the Taylor series of j_2 to
 * degree 11 in the radius, squared), the latter to 1e-6. */
static void sphere_twists_and_breathes_as_lamb_says(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const brc_reference_solid sphere = {{2, 2, 2}, 2.5, 0.25, 1, BRC_REFERENCE_SPHERE}; /* mu = 1: c_s = 1, R = 1 */
    double omega[60], nearest = INFINITY;
    assert_int_equal(brc_reference_vibration(context, &sphere, 12, 60, omega), BRC_OK);
    const double twist = root(torsion_of_order_2, 2, 3), breath = root(breathing, 2, 3) * sqrt(3);
    for (int k = 0; k < 5; ++k)
        assert_near(omega[k], twist, 1e-8);
    for (int k = 0; k < 60; ++k)
        nearest = fmin(nearest, fabs(omega[k] / breath - 1));
    assert_true(nearest < 1e-6);
    brc_context_free(&context);
}

/* A free round bar twists with half a wave along it at any nu: omega = pi c_s / L, an exact solution (its ends and its
 * side carry no traction). The sine is a polynomial of degree 11 to 1e-6, its frequency to the square of that. */
static void twist_of_a_round_bar_is_exact(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    for (int k = 0; k < 2; ++k) {
        const double nu = (const double[]){0.2, 0.45}[k];
        const brc_reference_solid bar = {{2, 1, 1}, 2 * (1 + nu), nu, 1, BRC_REFERENCE_CYLINDER};
        double omega[20], nearest = INFINITY;
        assert_int_equal(brc_reference_vibration(context, &bar, 12, 20, omega), BRC_OK);
        for (int m = 0; m < 20; ++m)
            nearest = fmin(nearest, fabs(omega[m] / (pi / 2) - 1));
        assert_true(nearest < 1e-9);
    }
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_agrees_with_the_tabled_values_at_nu_0_2),
        cmocka_unit_test(cube_agrees_with_the_tabled_values_near_incompressibility),
        cmocka_unit_test(cube_agrees_with_the_tabled_values_at_nu_minus_0_5),
        cmocka_unit_test(cube_agrees_with_the_tabled_values_at_nu_minus_0_95),
        cmocka_unit_test(longitudinal_mode_of_a_bar_is_exact_at_nu_0),
        cmocka_unit_test(lame_mode_of_a_cube_is_found_at_any_nu),
        cmocka_unit_test(more_functions_lower_every_frequency),
        cmocka_unit_test(sphere_twists_and_breathes_as_lamb_says),
        cmocka_unit_test(twist_of_a_round_bar_is_exact),
        cmocka_unit_test(a_degree_without_functions_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
