/* What static stages leave free to move as a whole: which body, which motion, and whether loads push it there. */
#include "../support.h"
#include "../../../host/base/log.h"
#include "../../../host/solver/statics/free_bodies.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STAGE(loads) "  - name: pull\n    solver: static\n    loads:\n" loads

static const char *told_of(const char *loads, const char *gravity, bool all)
{
    bench_case c;
    open_case(&c, (case_options){.stages = loads,
                                 .gravity = gravity,
                                 .shape = "{box: {size: [2 m, 1 m, 1 m]}}",
                                 .fill = "cells: [4, 2, 2], spread: 0 %",
                                 .sets = "sets: {low: {elements: {wall: x-}}, high: {elements: {wall: x+}}}\n"});
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    const brc_status status = brc_free_bodies_tell(c.context, c.scene, c.domain, all);
    const char *said = heard();
    assert_int_equal(status, BRC_OK);
    close_case(&c);
    return said;
}

static void expect(const char *said, const char *words)
{
    if (!strstr(said, words)) fail_msg("expected '%s', heard '%s'", words, said);
}

static void a_body_that_is_held_is_not_told_of(void **state)
{
    (void)state;
    assert_string_equal(
        told_of(STAGE("      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - traction: {set: x+, y: 1 Pa}\n"),
                NULL, true),
        "");
    assert_string_equal(told_of(STAGE("      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: "
                                      "y-, y: 0}\n      - face_displacement: {set: z-, z: 0}\n"),
                                NULL, true),
                        "");
}

static void motions_that_loads_push_are_warned_of_by_name(void **state)
{
    (void)state;
    expect(told_of(STAGE("      - face_displacement: {set: x-, x: 0, z: 0}\n      - face_displacement: {set: x+, x: "
                         "0}\n      - traction: {set: x+, y: 1 Pa}\n"),
                   NULL, false),
           "warning: stage 'pull': body 'body' is free to move along y, and its loads push it there");
    expect(told_of(STAGE("      - face_displacement: {set: x-, x: 0}\n      - traction: {set: y+, z: 1 Pa}\n      - "
                         "traction: {set: y-, z: -1 Pa}\n"),
                   NULL, false),
           "warning: stage 'pull': body 'body' is free to move along y, z and to turn about x, and its loads push it "
           "there"); /* no resultant, but a moment */
    expect(told_of(STAGE("      - traction: {set: x+, x: 1 Pa}\n"), NULL, false),
           "along x, y, z and to turn about x, y, z, and its loads");
    expect(told_of(STAGE("      - face_displacement: {set: x-, x: 0}\n"), "gravity: [0, -10 m/s^2, 0]\n", false),
           "its loads push it there");
    expect(
        told_of(STAGE("      - face_displacement: {set: x-, x: 0, y: 0}\n      - pressure: {set: z-, value: 1 Pa}\n"),
                NULL, false),
        "along z");
    expect(
        told_of(
            STAGE("      - element_displacement: {set: low, x: 0, y: 0}\n      - element_force: {set: high, z: 1 N}\n"),
            NULL, false),
        "along z");
}

static void motions_that_no_load_pushes_are_told_where_all_are_asked_for(void **state)
{
    (void)state;
    static const char balanced[] =
        STAGE("      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: x+, x: 1 mm}\n");
    expect(told_of(balanced, NULL, true),
           "body 'body' is free to move along y, z and to turn about x; no load pushes it there, and it stays");
    assert_null(strstr(told_of(balanced, NULL, true), "warning"));
    assert_string_equal(told_of(balanced, NULL, false), "");
    assert_string_equal(told_of(STAGE("      - face_displacement: {set: x-, x: 0}\n      - traction: {set: y+, y: 1 "
                                      "Pa}\n      - traction: {set: y-, y: -1 Pa}\n"),
                                NULL, false),
                        "");
}

static void dynamic_stages_may_move_as_they_like(void **state)
{
    (void)state;
    assert_string_equal(
        told_of("  - name: go\n    solver: {dynamic: {steps: 1}}\n    loads:\n      - traction: {set: x+, x: 1 Pa}\n",
                NULL, true),
        "");
}

/* A prism of w = 1 m and h = 2 m pressed by p from four sides turns about its axis as exp(q t): a turn gives the couple
 * 2 p w^2 h, over the inertia rho w^4 h / 8 of cells whose middles stand w / 4 off the axis; q = 4 1/s of 1 Pa and 1
 * kg/m^3, so it grows tenfold in ln 10 / q = 0.58 s. */
static void dead_loads_that_press_a_body_which_may_turn_are_warned_of(void **state)
{
    (void)state;
#define PRESSED(duration, value, more)                                                                                 \
    "  - name: crush\n    solver: {dynamic: {duration: " duration                                                      \
    "}}\n    loads:\n      - face_displacement: {set: x-, x: 0}\n      - face_velocity: {set: x+, x: -1 mm/s}\n"       \
    "      - pressure: {set: y-, value: " value more "}\n      - pressure: {set: y+, value: " value more               \
    "}\n      - pressure: {set: z-, value: " value more "}\n      - pressure: {set: z+, value: " value more "}\n"
    expect(told_of(PRESSED("9 s", "1 Pa", ""), NULL, false),
           "warning: stage 'crush': body 'body' is free to turn about x, and its loads press it: they keep their "
           "direction, so that a turn grows tenfold every 0.58 s of the 9 s they last");
    assert_string_equal(told_of(PRESSED("5 s", "1 Pa", ""), NULL, false), "");  /* too short */
    assert_string_equal(told_of(PRESSED("9 s", "-1 Pa", ""), NULL, false), ""); /* pulled it turns back */
    assert_string_equal(told_of(PRESSED("9 s", "1 Pa", ", table: [[0, 1], [4 s, 0]]"), NULL, false), ""); /* a pulse */
    assert_string_equal(
        told_of(PRESSED("9 s", "1 Pa", "") "      - element_displacement: {set: low, y: 0, z: 0}\n", NULL, false), "");
}

static void motions_aslant_the_axes_are_counted(void **state)
{
    (void)state;
    brc_free_motions free;
    char text[128];
    const double corner[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    brc_free_motions_begin(&free, 4, corner);
    for (int k = 0; k < 3; ++k)
        brc_free_motions_clamp(&free, k);
    for (int k = 0; k < 4; ++k)
        brc_free_motions_hold(&free, corner + 3 * k, 2);
    free.held[0][0] += 1, free.held[1][1] += 1, free.held[0][1] -= 1, free.held[1][0] -= 1; /* u_x - u_y is held */
    assert_true(brc_free_motions_find(&free));
    assert_int_equal(free.n, 1);
    assert_string_equal(brc_free_motions_text(&free, text, sizeof text), "in 1 way aslant the axes");
}

/* Nothing holds the body: two tractions that balance. The strains are those of blocks; nothing is said of where the
 * body went. */
static void assert_it_stays(const char *materials)
{
    static const char freely[] = "  - name: pull\n    solver: {static: {finite_strain: false}}\n    loads:\n"
                                 "      - traction: {set: x-, x: -1 uPa}\n      - traction: {set: x+, x: 1 uPa}\n";
    bench_case c;
    double *strain[2], largest = 0, off = 0;
    int64_t n = 0;
    for (int k = 0; k < 2; ++k) {
        open_case(&c, (case_options){
                          .fill = "cells: [8, 8, 8], spread: 90 %, seed: 1", .materials = materials, .stages = freely});
        c.scene->stages[0].preconditioner = k == 0 ? BRC_PRECONDITIONER_MULTIGRID : BRC_PRECONDITIONER_BLOCKS;
        assert_done(&c, brc_simulation_run(c.simulation));
        n = c.domain->n_elements;
        strain[k] = calloc((size_t)(6 * n), sizeof *strain[k]);
        assert_done(&c, brc_simulation_strain_stress(c.simulation, strain[k], NULL, NULL));
        double *u = calloc((size_t)(3 * n), sizeof *u), mean[3] = {0}, span = 0;
        assert_done(&c, brc_simulation_displacement(c.simulation, u));
        for (int64_t i = 0; i < 3 * n; ++i) {
            mean[i % 3] += u[i] / (double)n;
            span = fmax(span, fabs(u[i]));
        }
        for (int i = 0; i < 3; ++i)
            if (!(fabs(mean[i]) < 0.1 * span))
                fail_msg("mean displacement %g, the largest %g", mean[i],
                         span); /* multigrid's rigid motions were taken off */
        free(u);
        close_case(&c);
    }
    for (int64_t i = 0; i < 6 * n; ++i) {
        largest = fmax(largest, fabs(strain[1][i]));
        off = fmax(off, fabs(strain[0][i] - strain[1][i]));
    }
    if (!(off < 1e-7 * largest)) fail_msg("strains off by %g of %g", off, largest);
    free(strain[0]), free(strain[1]);
}

static void a_free_body_stays_where_it_is(void **state)
{
    (void)state;
    assert_it_stays(NULL);
    assert_it_stays("  stone: {E: 1 Pa, nu: -0.95, density: 1 kg/m^3}");
}

/* A prism between two plates, pressed from the sides by dead loads: free to move along two axes and to turn about the
 * third. Loads are balanced by the undeformed body; by which a turn of 1e-6 would leave 1e-6 of them. */
static void a_confined_prism_is_in_equilibrium(void **state)
{
    (void)state;
    for (int by_levels = 0; by_levels < 2; ++by_levels) {
        bench_case c;
        open_case(&c, (case_options){.materials = "  stone: {E: 50 GPa, nu: 0.25, density: 2650 kg/m^3}",
                                     .shape = "{box: {size: [25 mm, 50 mm, 25 mm]}}",
                                     .fill = "cells: [5, 10, 5], spread: 90 %, lloyd: 3, seed: 1",
                                     .stages = STAGE(
                                         "      - face_displacement: {set: y-, y: 0}\n      - face_displacement: {set: "
                                         "y+, y: 0}\n      - pressure: {set: x-, value: 10 MPa}\n      - pressure: "
                                         "{set: x+, value: 10 MPa}\n      - pressure: {set: z-, value: 10 MPa}\n      "
                                         "- pressure: {set: z+, value: 10 MPa}\n")});
        c.scene->stages[0].preconditioner = by_levels ? BRC_PRECONDITIONER_MULTIGRID : BRC_PRECONDITIONER_BLOCKS;
        assert_done(&c, brc_simulation_run(c.simulation));
        const brc_static_report report = brc_simulation_static_report(c.simulation);
        if (!(report.residual < 1e-10 && report.corrections < 6))
            fail_msg("residual %g after %d corrections", report.residual, (int)report.corrections);
        close_case(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_that_is_held_is_not_told_of),
        cmocka_unit_test(motions_that_loads_push_are_warned_of_by_name),
        cmocka_unit_test(motions_that_no_load_pushes_are_told_where_all_are_asked_for),
        cmocka_unit_test(dynamic_stages_may_move_as_they_like),
        cmocka_unit_test(dead_loads_that_press_a_body_which_may_turn_are_warned_of),
        cmocka_unit_test(motions_aslant_the_axes_are_counted),
        cmocka_unit_test(a_free_body_stays_where_it_is),
        cmocka_unit_test(a_confined_prism_is_in_equilibrium),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
