/* What two materials are to each other: stiffness, friction and damping of pairs, against their formulas by hand. */
#include "contact_case.h"
#include <math.h>

#define THREE                                                                                                          \
    "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}\n  steel: {E: 3 Pa, nu: 0.3, density: 1 kg/m^3}\n  mud: {E: 0.5 "  \
    "Pa, nu: 0.45, density: 1 kg/m^3}"
enum { STONE, STEEL, MUD };

static void expect_law(bench_case *c, int32_t i, int32_t j, const double wanted[BRC_CONTACT_LAW])
{
    const double *one = brc_contact_law_of(c->simulation, i, j), *other = brc_contact_law_of(c->simulation, j, i);
    for (int k = 0; k < BRC_CONTACT_LAW; ++k) {
        assert_true(one[k] == other[k]); /* action is reaction */
        if (!(fabs(one[k] - wanted[k]) <= 1e-12 * fabs(wanted[k])))
            fail_msg("materials %d and %d, number %d: %.15g for %.15g", i, j, k, one[k], wanted[k]);
    }
}

/* Hertz' modulus, the harmonic mean of both E, and Mindlin's tangential over normal stiffness: 4 G* / E*. */
static void fill_moduli(double e1, double nu1, double e2, double nu2, double out[BRC_CONTACT_LAW])
{
    const double g1 = e1 / (2 + 2 * nu1), g2 = e2 / (2 + 2 * nu2),
                 star = 1 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2);
    out[0] = star;
    out[1] = 2 / (1 / e1 + 1 / e2);
    out[2] = out[4] = out[5] = 0;
    out[3] = 4 / ((2 - nu1) / g1 + (2 - nu2) / g2) / star;
}

/* What `contact` says holds for every pair that has no law of its own; a pair's law takes its place whole, in either
 * order of the names, and the last of several wins. */
static void pairs_of_materials_have_laws_of_their_own(void **state)
{
    (void)state;
    bench_case c;
    double wanted[BRC_CONTACT_LAW];
    open_case(
        &c, (case_options){.materials = THREE,
                           .fill = "cells: [2, 2, 2]",
                           .n_threads = 1,
                           .sets = "interactions:\n  contact:\n    friction: 0.3\n    damping: 10 %\n    pairs:\n"
                                   "      - {first: steel, second: stone, friction: 0.7, stiffness: 2 N/m}\n"
                                   "      - {first: mud, second: mud, friction: 0.1, tangential: 0.5, restitution: 1}\n"
                                   "      - {first: stone, second: steel, friction: 0.6, damping: 40 %}\n"});
    fill_moduli(1, 0.2, 1, 0.2, wanted);
    assert_true(fabs(wanted[3] - 2 * 0.8 / 1.8) < 1e-12); /* of equal materials 2 (1 - nu) / (2 - nu) */
    wanted[4] = 0.3, wanted[5] = 0.1;
    expect_law(&c, STONE, STONE, wanted);
    fill_moduli(0.5, 0.45, 3, 0.3, wanted);
    wanted[4] = 0.3, wanted[5] = 0.1;
    expect_law(&c, MUD, STEEL, wanted);
    fill_moduli(1, 0.2, 3, 0.3, wanted);
    wanted[4] = 0.6, wanted[5] = 0.4; /* no stiffness of the first law is left */
    expect_law(&c, STONE, STEEL, wanted);
    fill_moduli(0.5, 0.45, 0.5, 0.45, wanted);
    wanted[3] = 0.5, wanted[4] = 0.1;
    expect_law(&c, MUD, MUD, wanted);
    close_case(&c);
}

/* e = exp(-b atan2(2 b s, 2 b^2 - 1) / s), s = sqrt(1 - b^2): the share of critical damping that a restitution asks for
 * gives it back, from nearly elastic to overdamped (there with asinh). */
static void a_restitution_asks_for_the_damping_that_gives_it(void **state)
{
    (void)state;
    static const double wanted[] = {0.999, 0.9, 0.5, 0.2, 0.05};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; ++k) {
        bench_case c;
        char keys[80];
        snprintf(keys, sizeof keys, "interactions: {contact: {restitution: %g}}\n", wanted[k]);
        open_case(&c, (case_options){.fill = "cells: [2, 2, 2]", .sets = keys, .n_threads = 1});
        const double b = brc_contact_law_of(c.simulation, 0, 0)[5], s = sqrt(fabs(1 - b * b));
        const double e = exp(-b * (b < 1 ? atan2(2 * b * s, 2 * b * b - 1) : asinh(2 * b * s)) / s);
        assert_true(fabs(e - wanted[k]) < 1e-9);
        close_case(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_of_materials_have_laws_of_their_own),
        cmocka_unit_test(a_restitution_asks_for_the_damping_that_gives_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
