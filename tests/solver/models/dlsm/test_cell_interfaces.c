/* Interfaces of cells that soften, pulled otherwise than straight apart: what a crack along them costs
 * (docs/notebook/fracture.md, softening_onset.cl). */
#include "../../effects/fracture/cells_case.h"
#include <math.h>

/* A pull along the crack, however large, neither cheapens it nor makes it dearer: a weak plane across x is pulled apart
 * while the body is pulled along y by as much, or three times as much. The bound is that of the flat crack; by the
 * axis of the largest of both pulls it cost half. */
static void a_pull_along_a_crack_does_not_cheapen_it(void **state)
{
    (void)state;
    const char *along[] = {"1e-4", "3e-4"};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char stages[512];
        snprintf(
            stages, sizeof stages,
            "  - name: pull\n    solver: {dynamic: {duration: 60 s, mass_damping: 0.5 1/s, time_step: {auto: {safety: "
            "0.1}}}}\n    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - face_velocity: {set: x+, x: "
            "1e-4 m/s}\n      - face_displacement: {set: y-, y: 0 m}\n      - face_velocity: {set: y+, y: %s m/s}\n"
            "    initial:\n      - velocity: {gradient: {x: [1e-4 1/s, 0, 0], y: [0, %s 1/s, 0]}}\n",
            along[k], along[k]);
        open_case(&c, (case_options){.materials = CELLS_TWINS("0"),
                                     .regions = CELLS_TWIN_HALF,
                                     .sets = CELLS_WEAK_PLANE("1e-6"),
                                     .fill = "cells: [6, 3, 3], spread: 0 %, seed: 1",
                                     .stages = stages});
        begin_first(&c);
        run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
        const brc_softening_report report = softening_now(&c);
        print_message("pulled along by %s: spent %.6f of G_c A\n", along[k], report.spent / 1e-6);
        assert_int_equal(report.n_ended, 9);
        assert_true(fabs(report.spent / 1e-6 - 1) < 0.01);
        close_case(&c);
    }
}

/* An interface costs its fracture energy however the stress leans that opens it, as no crack chooses its plane: a weak
 * plane opens under as much shear as pull, whose axis has a cosine of 0.85 to its normal, and is then pulled straight
 * apart, to an opening of 20 mm beside a slide of 1.2 mm: 0.998, and what is lost while both were as large. */
static void an_interface_that_opens_askew_costs_its_fracture_energy(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){
                      .materials = CELLS_TWINS("0"),
                      .regions = CELLS_TWIN_HALF,
                      .sets = CELLS_WEAK_PLANE("1e-5"),
                      .fill = "cells: [6, 3, 3], spread: 0 %, seed: 1",
                      .stages =
                          "  - name: pull\n    solver: {dynamic: {duration: 260 s, mass_damping: 0.5 1/s, "
                          "time_step: {auto: {safety: 0.3}}}}\n    loads:\n"
                          "      - face_displacement: {set: x-, x: 0 m, y: 0 m}\n"
                          "      - face_velocity: {set: x+, x: 1e-4 m/s}\n"
                          "      - face_velocity: {set: x+, y: 2e-4 m/s, table: [[0, 1], [6 s, 1], [6.5 s, 0]]}\n"
                          "    initial:\n      - velocity: {gradient: {x: [1e-4 1/s, 0, 0], y: [2e-4 1/s, 0, 0]}}\n"});
    begin_first(&c);
    run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
    const brc_softening_report report = softening_now(&c);
    print_message("opened askew: %lld ended, spent %.4f of G_c A\n", (long long)report.n_ended, report.spent / 1e-5);
    assert_int_equal(report.n_ended, 9);
    assert_true(report.spent / 1e-5 > 0.97 && report.spent / 1e-5 < 1.01);
    close_case(&c);
}

/* A crack that slides along an interface costs its fracture energy too, on its smooth plane, however rough cells make
 * it: two halves are moved along each other by more than the 20 mm at which the cohesion ends, while their distance is
 * kept (flat) or the second half is free to rise (rough). */
static void a_slide_along_an_interface_costs_its_fracture_energy(void **state)
{
    (void)state;
    const struct {
        const char *fill, *across;
        double least, most;
    } cases[] = {{"cells: [6, 3, 3], spread: 0 %, seed: 1", ", x: 0 m/s", 0.99, 1.01},
                 {"cells: [8, 6, 6], spread: 60 %, seed: 1", "", 0.9, 1.1}};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char stages[512];
        snprintf(stages, sizeof stages,
                 "  - name: slide\n    solver: {dynamic: {duration: 260 s, mass_damping: 0.5 1/s, time_step: {auto: "
                 "{safety: 0.3}}}}\n    loads:\n      - face_displacement: {set: x-, x: 0 m, y: 0 m, z: 0 m}\n"
                 "      - face_velocity: {set: x+, y: 2e-4 m/s, z: 0 m/s%s}\n"
                 "    initial:\n      - velocity: {gradient: {y: [2e-4 1/s, 0, 0]}}\n",
                 cases[k].across);
        open_case(&c, (case_options){.materials = CELLS_TWINS("0"),
                                     .regions = CELLS_TWIN_HALF,
                                     .sets = CELLS_WEAK_PLANE("1e-5"),
                                     .fill = cases[k].fill,
                                     .stages = stages});
        begin_first(&c);
        run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
        const brc_softening_report report = softening_now(&c);
        print_message("slid, %s: %lld of %lld ended, spent %.4f of G_c A\n", cases[k].fill, (long long)report.n_ended,
                      (long long)report.n_opened, report.spent / 1e-5);
        assert_true(report.spent / 1e-5 > cases[k].least && report.spent / 1e-5 < cases[k].most);
        close_case(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pull_along_a_crack_does_not_cheapen_it),
        cmocka_unit_test(an_interface_that_opens_askew_costs_its_fracture_energy),
        cmocka_unit_test(a_slide_along_an_interface_costs_its_fracture_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
