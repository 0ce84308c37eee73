/* The built-in laws: they invert, they are smooth and monotone, and they agree with what was measured elsewhere. */
#include "../../../host/solver/laws/beam_law.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>
#include "../../../host/base/log.h"

static brc_context *quiet(void)
{
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    return context;
}

static void the_nearest_spread_is_taken(void **state)
{
    (void)state;
    assert_true(brc_beam_law_for(0.0)->radius_spread == 0.125);
    assert_true(brc_beam_law_for(0.13)->radius_spread == 0.125);
    assert_true(brc_beam_law_for(0.3)->radius_spread == 0.25);
}

/* nu must fall with r_m, or the inversion would not be one; E must grow. Steps of 1 % of r_m, away from the last few
 * percent of the range. */
static void nu_falls_and_e_grows_with_r_m_everywhere(void **state)
{
    (void)state;
    static const double spreads[] = {0.125, 0.25};
    for (int s = 0; s < 2; ++s) {
        const brc_beam_law *law = brc_beam_law_for(spreads[s]);
        for (double cn = law->coordination[0]; cn <= law->coordination[1]; cn += 0.1)
            for (double r = law->radius[0]; r * 1.01 <= law->radius[1]; r *= 1.01) {
                assert_true(brc_beam_law_poisson(law, cn, r * 1.01) < brc_beam_law_poisson(law, cn, r));
                assert_true(brc_beam_law_young(law, cn, r * 1.01) > brc_beam_law_young(law, cn, r));
            }
    }
}

/* Bisection halves the range 60 times: to rounding. */
static void inversion_gives_what_was_asked(void **state)
{
    (void)state;
    brc_context *context = quiet();
    const brc_beam_law *law = brc_beam_law_for(0.125);
    for (double cn = 6; cn <= 13; ++cn)
        for (double nu = 0.15; nu < 0.235; nu += 0.02) {
            double r, e;
            bool warning;
            assert_int_equal(
                brc_beam_law_invert(context, law, &(brc_beam_body){.coordination = cn}, nu, 72e9, &r, &e, &warning),
                BRC_OK);
            assert_true(fabs(brc_beam_law_poisson(law, cn, r) - nu) < 1e-12);
            assert_true(fabs(brc_beam_law_young(law, cn, r) * e / 72e9 - 1) < 1e-12);
        }
    brc_context_free(&context);
}

/* NAH19 Tables 5 and 6: r_m, E_m put in and nu, E measured on the paper's own packings. The design found these
 * definitions to meet them within 3 % in nu and 2.7 % in E on packings of 62.6 %; ours have 63.1 %, which it puts
 * at 1.5 % of E, and samples scatter by 1 %: 4 % and 6 %. */
static void the_laws_give_what_the_paper_measured(void **state)
{
    (void)state;
    static const struct {
        double cn, radius, beam_young, nu, young;
    } rows[] = {
        {6, 0.506, 613.94, 0.231, 72.26},    {7, 0.461, 613.52, 0.230, 72.06},    {8, 0.417, 636.18, 0.230, 71.61},
        {9, 0.380, 655.58, 0.230, 72.44},    {10, 0.348, 677.94, 0.230, 71.74},   {11, 0.320, 705.07, 0.230, 71.36},
        {12, 0.298, 723.72, 0.230, 71.00},   {13, 0.283, 725.14, 0.230, 71.22},   {6, 0.478, 3378.29, 0.241, 341.37},
        {7, 0.431, 3439.53, 0.240, 340.29},  {8, 0.384, 3695.23, 0.240, 337.98},  {9, 0.338, 4058.51, 0.240, 341.88},
        {10, 0.294, 4646.18, 0.241, 337.70}, {11, 0.251, 5576.21, 0.241, 335.66}, {12, 0.215, 6820.35, 0.240, 336.62},
        {13, 0.189, 8187.01, 0.239, 345.80}};
    const brc_beam_law *law = brc_beam_law_for(0.125);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        assert_true(fabs(brc_beam_law_poisson(law, rows[k].cn, rows[k].radius) / rows[k].nu - 1) < 0.04);
        assert_true(fabs(brc_beam_law_young(law, rows[k].cn, rows[k].radius) * rows[k].beam_young / rows[k].young - 1) <
                    0.06);
    }
}

/* The paper's form with our coefficients stands beside: it is good to 7 % (docs/notebook/beams-calibration.md). */
static void the_papers_form_says_the_same_to_its_own_error(void **state)
{
    (void)state;
    static const double spreads[] = {0.125, 0.25};
    for (int s = 0; s < 2; ++s) {
        const brc_beam_law *law = brc_beam_law_for(spreads[s]);
        for (double cn = 5.5; cn <= 13; cn += 0.5)
            for (double r = 0.2; r <= 1.0 + 1e-9; r += 0.2) {
                assert_true(
                    fabs(brc_beam_law_paper_poisson(law->paper_poisson, cn, r) / brc_beam_law_poisson(law, cn, r) - 1) <
                    0.07);
                assert_true(fabs(brc_beam_law_paper_young(law->paper_young, cn, r) / brc_beam_law_young(law, cn, r) -
                                 1) < 0.07);
            }
    }
}

static void what_beams_cannot_give_is_refused_with_the_range(void **state)
{
    (void)state;
    brc_context *context = quiet();
    double r, e;
    bool warning;
    assert_int_equal(brc_beam_law_invert(context, brc_beam_law_for(0.125), &(brc_beam_body){.coordination = 10}, 0.35,
                                         72e9, &r, &e, NULL),
                     BRC_BAD_INPUT);
    assert_non_null(
        strstr(brc_context_message(context), "beams cannot give nu = 0.35 at the coordination number 10, only 0.0"));
    brc_context_clear(context);
    assert_int_equal(brc_beam_law_invert(context, brc_beam_law_for(0.125), &(brc_beam_body){.coordination = 14}, 0.2,
                                         72e9, &r, &e, NULL),
                     BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(context), "outside the calibrated laws (5.5 to 13)"));
    /* the flat end, where r_m is not determined well */
    const brc_beam_law *law = brc_beam_law_for(0.125);
    const brc_beam_body twelve = {.coordination = 12};
    assert_int_equal(
        brc_beam_law_invert(context, law, &twelve, brc_beam_law_poisson(law, 12, 0.11), 72e9, &r, &e, &warning),
        BRC_OK);
    assert_true(warning);
    assert_int_equal(brc_beam_law_invert(context, law, &twelve, 0.2, 72e9, &r, &e, &warning), BRC_OK);
    assert_false(warning);
    brc_context_free(&context);
}

/* A body with as many bonds inside as the fit's cubes has their law; bisection halves the range 60 times. */
static void a_body_is_as_stiff_as_the_cube_with_its_bonds_inside(void **state)
{
    (void)state;
    static const double spreads[] = {0.125, 0.25};
    for (int s = 0; s < 2; ++s) {
        const brc_beam_law *law = brc_beam_law_for(spreads[s]);
        for (double cn = 5.5; cn <= 13; cn += 0.5) {
            const brc_beam_body alike = {.coordination = cn + 0.3, .inner = cn * brc_beam_law_inner(law, cn)},
                                unknown = {.coordination = cn};
            assert_true(fabs(brc_beam_law_coordination(law, &alike) - cn) < 1e-12);
            assert_true(brc_beam_law_coordination(law, &unknown) == cn);
        }
    }
}

/* An infinite body has no walls: at one cn it has fewer bonds inside than the cubes, so it takes stiffer beams. By how
 * much: the shares of elements at the walls of a cube of 21 diameters, about 6 / 21, miss up to half their bonds each;
 * inside there are 5 to 9 % more. */
static void a_large_body_takes_stiffer_beams_than_a_small_one(void **state)
{
    (void)state;
    brc_context *context = quiet();
    const brc_beam_law *law = brc_beam_law_for(0.125);
    for (double cn = 6; cn <= 13; ++cn) {
        double radius[3], young[3];
        assert_true(brc_beam_law_inner(law, cn) > 1.05 && brc_beam_law_inner(law, cn) < 1.09);
        for (int k = 0; k < 3; ++k) {
            const brc_beam_body body = {.coordination = cn, .inner = cn * (1 + 0.03 * k)};
            assert_int_equal(brc_beam_law_invert(context, law, &body, 0.2, 1, &radius[k], &young[k], NULL), BRC_OK);
        }
        /* E S of a beam at the same nu */
        for (int k = 0; k < 2; ++k)
            assert_true(radius[k] * radius[k] * young[k] > radius[k + 1] * radius[k + 1] * young[k + 1]);
    }
    brc_context_free(&context);
}

/* Bonds inside beyond the fit: the fit's end, with a word; where the coordination number itself is far out, refused as
 * before. */
static void bonds_beyond_the_fit_are_taken_as_at_its_end(void **state)
{
    (void)state;
    const brc_beam_law *law = brc_beam_law_for(0.125);
    const brc_beam_body many = {.coordination = 13, .inner = 16}, few = {.coordination = 5.5, .inner = 5.5};
    assert_true(fabs(brc_beam_law_coordination(law, &many) - 13) < 1e-12);
    assert_true(fabs(brc_beam_law_coordination(law, &few) - 5.5) < 1e-12);
}

/* E_m makes up for how E reads by the bounding box; the cube of 10 000 spheres is where the law is at home: d / L
 * 0.0491. A bar of 10 : 1 : 1 has soft sides and stiff beams. */
static void beams_make_up_for_the_reading_of_a_body(void **state)
{
    (void)state;
    brc_context *context = quiet();
    const brc_beam_law *law = brc_beam_law_for(0.125);
    const double cube[3] = {1 / 0.0491, 1 / 0.0491, 1 / 0.0491}, bar[3] = {10 / 0.103, 1 / 0.103, 1 / 0.103};
    const brc_beam_body at_home = {.coordination = 10, .reading = brc_beam_body_reading(cube)},
                        slender = {.coordination = 10, .reading = brc_beam_body_reading(bar)},
                        unknown = {.coordination = 10};
    double r[3], e[3];
    assert_true(fabs(brc_beam_law_reading(&at_home) - 1) < 1e-4);
    assert_true(brc_beam_law_reading(&unknown) == 1);
    assert_int_equal(brc_beam_law_invert(context, law, &at_home, 0.23, 1, &r[0], &e[0], NULL), BRC_OK);
    assert_int_equal(brc_beam_law_invert(context, law, &slender, 0.23, 1, &r[1], &e[1], NULL), BRC_OK);
    assert_int_equal(brc_beam_law_invert(context, law, &unknown, 0.23, 1, &r[2], &e[2], NULL), BRC_OK);
    assert_true(r[0] == r[1] && r[0] == r[2]);
    assert_true(fabs(e[0] / e[2] - 1) < 1e-4);
    assert_true(fabs(e[1] / e[2] * (1 + 0.0103 - 0.2 * 0.206) / (1 + 0.6 * 0.0491) - 1) < 1e-4);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_spread_is_taken),
        cmocka_unit_test(a_body_is_as_stiff_as_the_cube_with_its_bonds_inside),
        cmocka_unit_test(beams_make_up_for_the_reading_of_a_body),
        cmocka_unit_test(a_large_body_takes_stiffer_beams_than_a_small_one),
        cmocka_unit_test(bonds_beyond_the_fit_are_taken_as_at_its_end),
        cmocka_unit_test(nu_falls_and_e_grows_with_r_m_everywhere),
        cmocka_unit_test(inversion_gives_what_was_asked),
        cmocka_unit_test(the_laws_give_what_the_paper_measured),
        cmocka_unit_test(the_papers_form_says_the_same_to_its_own_error),
        cmocka_unit_test(what_beams_cannot_give_is_refused_with_the_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
