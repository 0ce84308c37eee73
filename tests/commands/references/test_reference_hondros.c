#include "../support.h"
#include "../../../host/commands/references/reference_hondros.h"

static const double PI = 3.14159265358979323846;

/* Hertz: two point forces give the nominal stress across the whole loaded diameter and -3 of it along the diameter in
 * the centre. Arcs of finite angle change it by the square of the angle over the distance from the rim, times a few: 10
 * (1e-5 / 0.3)^2 = 1.1e-8, rounding 1e-16 / 1e-5. */
static void narrow_arcs_are_two_point_forces(void **state)
{
    (void)state;
    double s[2];
    for (int k = -7; k <= 7; ++k) {
        brc_reference_hondros(1e-5, 0.1 * k, s);
        assert_near(s[0], 1, 2e-8);
    }
    brc_reference_hondros(1e-5, 0, s);
    assert_near(s[1], -3, 2e-8);
}

/* Half of the disc: what the cut carries balances the pressure across it, 2 p R (1 - cos angle) for both arcs; p over
 * the nominal stress is pi / (2 sin angle). Midpoint rule on a smooth function with 1e5 points: 1e-8. */
static void the_cut_along_the_diameter_balances_the_pressure(void **state)
{
    (void)state;
    const int n = 100000;
    for (int degrees = 6; degrees <= 36; degrees += 6) {
        const double angle = degrees * PI / 180;
        double sum = 0, s[2];
        for (int k = 0; k < n; ++k) {
            brc_reference_hondros(angle, -1 + 2 * (k + 0.5) / n, s);
            sum += s[0] * 2 / n;
        }
        assert_near(sum, -2 * PI / (2 * sin(angle)) * (1 - cos(angle)), 1e-7);
    }
}

/* Under the arc the solid bears the pressure in both directions. */
static void the_rim_bears_the_pressure(void **state)
{
    (void)state;
    double s[2];
    const double angle = 12 * PI / 180, p = PI / (2 * sin(angle));
    brc_reference_hondros(angle, 1, s);
    assert_near(s[0], -p, 1e-13);
    assert_near(s[1], -p, 1e-13);
    brc_reference_hondros(angle, -1, s);
    assert_near(s[0], -p, 1e-13);
}

/* NAH19 eq. 28 as printed, its p the pressure. */
static void the_paper_prints_the_same(void **state)
{
    (void)state;
    const double angle = 12 * PI / 180, p = PI / (2 * sin(angle));
    for (int k = 0; k < 10; ++k) {
        const double rho = 0.1 * k, square = rho * rho;
        const double printed = 2 * p / PI *
                               (sin(2 * angle) / (1 - 2 * square * cos(2 * angle) + square * square) * (1 - square) -
                                atan(square * sin(2 * angle) / (1 - square * cos(2 * angle))) - angle);
        double s[2];
        brc_reference_hondros(angle, rho, s);
        assert_near(s[0], printed, 1e-13);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(narrow_arcs_are_two_point_forces),
        cmocka_unit_test(the_cut_along_the_diameter_balances_the_pressure),
        cmocka_unit_test(the_rim_bears_the_pressure),
        cmocka_unit_test(the_paper_prints_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
