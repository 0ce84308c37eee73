/* Static stages without finite strain whose body turns far: what is read of them is of the full law, so that the ledger
 * does not close, and they are warned of. */
#include "../models/cbm/beams_case.h"
#include "../support.h"
#include "../../../host/base/log.h"
#include <stdio.h>
#include <string.h>

static const char warning[] = "warning: stage 'bend': finite_strain: false, and parts of the body turn so far that ";

/* A bar of 20:1 under a load at its end, or with that end moved aside. */
static const char *told_of_cells(const char *solver, const char *load)
{
    char stages[300];
    bench_case c;
    snprintf(stages, sizeof stages,
             "  - name: bend\n    solver: {static: {%s}}\n    loads:\n"
             "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - %s\n",
             solver, load);
    open_case(&c, (case_options){.shape = "{box: {size: [20 m, 1 m, 1 m]}}",
                                 .fill = "cells: [40, 3, 3], spread: 50 %",
                                 .stages = stages});
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    const brc_status status = brc_simulation_run(c.simulation);
    const char *said = heard();
    assert_done(&c, status);
    close_case(&c);
    return said;
}

static const char *told_of_beams(const char *aside)
{
    char stages[600];
    beams_case c;
    snprintf(stages, sizeof stages,
             "sets:\n  left: {elements: {box: {from: [0 m, 0 m, 0 m], to: [1.2 m, 20 m, 20 m]}}}\n"
             "  right: {elements: {box: {from: [8.2 m, 0 m, 0 m], to: [20 m, 20 m, 20 m]}}}\n"
             "stages:\n  - name: bend\n    solver: {static: {finite_strain: false}}\n    loads:\n"
             "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n"
             "      - element_displacement: {set: right, z: %s}\n",
             aside);
    open_lattice(&c, 9, (beams_options){.coordination = 6, .stages = stages});
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    const brc_status status = brc_simulation_run(c.simulation);
    const char *said = heard();
    beams_done(&c, status);
    close_beams(&c);
    return said;
}

/* By the full law a turn by t is a strain of t^2 / 2: here of 3 %, beside 0.1 % of bending, or of 1e-10 beside 1e-7. */
static void a_bar_that_turns_far_is_warned_of(void **state)
{
    (void)state;
    assert_non_null(strstr(told_of_cells("finite_strain: false", "traction: {set: x+, z: 1e-4 Pa}"), warning));
    assert_non_null(strstr(told_of_cells("finite_strain: false", "face_displacement: {set: x+, z: 3 m}"), warning));
    assert_null(strstr(told_of_cells("finite_strain: false", "traction: {set: x+, z: 1e-9 Pa}"), "warning"));
    assert_null(strstr(told_of_cells("finite_strain: false", "face_displacement: {set: x+, z: 0.1 mm}"), "warning"));
    assert_null(strstr(told_of_cells("increments: 4", "traction: {set: x+, z: 1e-5 Pa}"), "warning"));
}

static void beams_that_turn_far_are_warned_of(void **state)
{
    (void)state;
    assert_non_null(strstr(told_of_beams("3 m"), warning));
    assert_null(strstr(told_of_beams("0.1 mm"), "warning"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bar_that_turns_far_is_warned_of),
        cmocka_unit_test(beams_that_turn_far_are_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
