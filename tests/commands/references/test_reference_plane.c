#include "../support.h"
#include "../../../host/commands/references/reference_hondros.h"
#include "../../../host/commands/references/reference_plane.h"

/* Hondros' closed form on the loaded diameter: another derivation. 64 Gauss points over an arc seen from inside 0.9 of
 * the radius: 1e-10. */
static void disc_agrees_with_hondros_on_the_loaded_diameter(void **state)
{
    (void)state;
    for (int k = 0; k < 3; ++k) {
        const double half_angle = (const double[]){0.1, 0.26, 0.7}[k];
        for (double rho = -0.85; rho < 0.9; rho += 0.17) {
            double stress[3], exact[2];
            brc_reference_disc(half_angle, 0, rho, stress);
            brc_reference_hondros(half_angle, rho, exact);
            assert_near(stress[0], exact[0], 1e-9);
            assert_near(stress[1], exact[1], 1e-9);
            assert_near(stress[2], 0, 1e-12);
        }
    }
}

/* Everywhere: div stress = 0, by central differences of step h, whose error is h^2 times third derivatives of order 10:
 * 1e-6. */
static void disc_is_in_equilibrium(void **state)
{
    (void)state;
    const double h = 1e-4;
    for (int k = 0; k < 5; ++k) {
        const double x = 0.1 + 0.12 * k, y = 0.5 - 0.2 * k;
        double east[3], west[3], north[3], south[3];
        brc_reference_disc(0.26, x + h, y, east);
        brc_reference_disc(0.26, x - h, y, west);
        brc_reference_disc(0.26, x, y + h, north);
        brc_reference_disc(0.26, x, y - h, south);
        assert_near((east[0] - west[0] + north[2] - south[2]) / (2 * h), 0, 1e-5);
        assert_near((east[2] - west[2] + north[1] - south[1]) / (2 * h), 0, 1e-5);
    }
}

/* Uniaxial tension far away (plane strain) and a ring a thousand times as wide as the hole: three times the stress
 * beside it, minus once along it (Kirsch). The ring's outside is (a/b)^2 = 1e-6 away from it. */
static void wide_ring_is_kirsch_plate(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const double nu = 0.25, e = 1e-3, far = 1 / (1 - nu * nu) * e;
    brc_reference_ring ring;
    double stress[3];
    assert_int_equal(brc_reference_ring_solve(context, 1, 1000, 1, nu, e, -nu / (1 - nu) * e, &ring), BRC_OK);
    brc_reference_ring_at(&ring, 0, 1, stress, NULL);
    assert_near(stress[0] / far, 3, 1e-5);
    brc_reference_ring_at(&ring, 1, 0, stress, NULL);
    assert_near(stress[1] / far, -1, 1e-5);
    brc_reference_ring_at(&ring, 0, 500, stress, NULL);
    assert_near(stress[0] / far, 1, 1e-5);
    brc_context_free(&context);
}

/* The stresses are those of the displacements (Hooke, plane strain; differences of step 1e-5 err by 1e-9 of the
 * strain), the hole is free, the outside as prescribed. */
static void ring_obeys_hooke_and_its_boundaries(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const double nu = 0.3, young = 2, mu = young / (2 * (1 + nu)), lambda = 2 * mu * nu / (1 - 2 * nu), h = 1e-5;
    brc_reference_ring ring;
    double stress[3], u[2], east[2], west[2], north[2], south[2], other[3];
    assert_int_equal(brc_reference_ring_solve(context, 1, 5, young, nu, 0.7, -0.2, &ring), BRC_OK);
    for (int k = 0; k < 6; ++k) {
        const double angle = 0.3 + k, r = 1.2 + 0.6 * k, x = r * cos(angle), y = r * sin(angle);
        brc_reference_ring_at(&ring, x, y, stress, u);
        brc_reference_ring_at(&ring, x + h, y, other, east);
        brc_reference_ring_at(&ring, x - h, y, other, west);
        brc_reference_ring_at(&ring, x, y + h, other, north);
        brc_reference_ring_at(&ring, x, y - h, other, south);
        const double xx = (east[0] - west[0]) / (2 * h), yy = (north[1] - south[1]) / (2 * h);
        const double xy = (north[0] - south[0] + east[1] - west[1]) / (4 * h);
        assert_near(stress[0], lambda * (xx + yy) + 2 * mu * xx, 1e-7);
        assert_near(stress[1], lambda * (xx + yy) + 2 * mu * yy, 1e-7);
        assert_near(stress[2], 2 * mu * xy, 1e-7);
        const double c = cos(angle), s = sin(angle);
        brc_reference_ring_at(&ring, c, s, stress, NULL); /* traction on the hole */
        assert_near(stress[0] * c + stress[2] * s, 0, 1e-12);
        assert_near(stress[2] * c + stress[1] * s, 0, 1e-12);
        brc_reference_ring_at(&ring, 5 * c, 5 * s, stress, u);
        assert_near(u[0], 0.7 * 5 * c, 1e-12);
        assert_near(u[1], -0.2 * 5 * s, 1e-12);
    }
    assert_int_equal(brc_reference_ring_solve(context, 2, 1, young, nu, 1, 0, &ring), BRC_BAD_INPUT);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(disc_agrees_with_hondros_on_the_loaded_diameter),
        cmocka_unit_test(disc_is_in_equilibrium),
        cmocka_unit_test(wide_ring_is_kirsch_plate),
        cmocka_unit_test(ring_obeys_hooke_and_its_boundaries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
