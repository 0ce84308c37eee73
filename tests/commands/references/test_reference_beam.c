#include "../support.h"
#include "../../../host/commands/references/reference_beam.h"

/* Timoshenko and Goodier, Theory of Elasticity, section 109: beta = J / (a b^3), printed to three or four digits. */
static void torsion_of_rectangles_agrees_with_the_textbook(void **state)
{
    (void)state;
    assert_near(brc_reference_torsion_rectangle(1, 1), 0.1406, 5e-5);
    assert_near(brc_reference_torsion_rectangle(2, 1) / 2, 0.229, 5e-4);
    assert_near(brc_reference_torsion_rectangle(10, 1) / 10, 0.312, 5e-4);
    assert_near(brc_reference_torsion_rectangle(1e6, 1) / 1e6, 1.0 / 3, 1e-5);
}

static void torsion_of_a_rectangle_does_not_depend_on_the_order_of_its_sides(void **state)
{
    (void)state;
    assert_near(brc_reference_torsion_rectangle(0.3, 2), brc_reference_torsion_rectangle(2, 0.3), 0);
}

/* J of a circle is its polar moment: that of the annulus r..r + dr integrated. Tolerance: the midpoint rule. */
static void torsion_of_a_circle_is_its_polar_moment(void **state)
{
    (void)state;
    double sum = 0;
    const int n = 2000;
    for (int k = 0; k < n; ++k) {
        const double r = 0.7 * (k + 0.5) / n;
        sum += 2 * 3.14159265358979323846 * r * r * r * 0.7 / n;
    }
    assert_near(brc_reference_torsion_circle(0.7) / sum, 1, 1e-6);
}

/* F = 1, E = 12, L = 2, 1 x 1, nu = 0: I = 1/12, bending 8/(3*12/12) = 8/3; kappa = 10/12, G = 6: shear 2/(5) = 0.4. */
static void cantilever_adds_shear_to_bending(void **state)
{
    (void)state;
    assert_near(brc_reference_cantilever(12, 0, 2, 1, 1, 1), 8.0 / 3 + 0.4, 1e-14);
    assert_near(brc_reference_shear_coefficient(0.3), 13.0 / 15.3, 1e-15);
}

/* AGH19 Table 4: 1118 Hz. Its torsion value of 668 Hz needs G = 7.14 GPa, that is nu = 0.4. */
static void bar_frequencies_are_those_of_the_paper(void **state)
{
    (void)state;
    assert_near(brc_reference_bar_frequency(20e9, 1000, 1), 1118, 0.05);
    assert_near(brc_reference_bar_frequency(20e9 / 2.8, 1000, 1), 668, 0.2);
}

static void energy_of_torsion_is_half_of_torque_times_twist(void **state)
{
    (void)state;
    assert_near(brc_reference_torsion_energy(3, 2, 4, 0.5), 0.5 * (3 * 2 * 0.5 / 4) * 0.5, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torsion_of_rectangles_agrees_with_the_textbook),
        cmocka_unit_test(torsion_of_a_rectangle_does_not_depend_on_the_order_of_its_sides),
        cmocka_unit_test(torsion_of_a_circle_is_its_polar_moment),
        cmocka_unit_test(cantilever_adds_shear_to_bending),
        cmocka_unit_test(bar_frequencies_are_those_of_the_paper),
        cmocka_unit_test(energy_of_torsion_is_half_of_torque_times_twist),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
