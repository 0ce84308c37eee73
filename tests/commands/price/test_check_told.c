/* What `breccia check` and `breccia run` say before a run of what the run cannot give. */
#include "../support.h"
#include <stdio.h>
#include <string.h>

#define BAR                                                                                                            \
    "version: 1\nmaterials: {stone: {E: 20 GPa, nu: 0.2, density: 2500 kg/m^3%s}}\n%s"                                 \
    "bodies: [{name: block, shape: {box: {size: [8 mm, 4 mm, 4 mm]}}, fill: {noisy_grid: {cells: [8, 4, 4], seed: "    \
    "1}}}]\n"
#define STRONG ", strength: {tension: 10 MPa}"
#define SOFT ", strength: {tension: 10 MPa, fracture_energy: 40 J/m^2}"
#define PULL                                                                                                           \
    "stages:\n  - name: pull\n    solver: static\n    loads:\n      - face_displacement: {set: x-, x: 0%s}\n      - "  \
    "traction: {set: x+, %s: 1 MPa}\n"
#define TEAR                                                                                                           \
    "stages:\n  - {name: tear, solver: {dynamic: {steps: 20}}, initial: [{velocity: {gradient: {x: [1 1/s, 0, "        \
    "0]}}}]}\n"
#define QUIET "output: {frames: none, picture: false}\n"

static int told_of(const char *command, const char *strength, const char *keys, const char *stages)
{
    char text[2048], line[256];
    snprintf(text, sizeof text, BAR "%s" QUIET, strength, keys, stages);
    test_make_folder(text);
    if (strcmp(command, "run") == 0)
        snprintf(line, sizeof line, "run --device cpu -o %s/result %s/scene.yaml", test_folder(), test_folder());
    else
        snprintf(line, sizeof line, "%s --all --device cpu --brief %s/scene.yaml", command, test_folder());
    const int code = test_program(line);
    test_remove_folder(NULL);
    return code;
}

static void expect(const char *said, const char *words)
{
    if (!strstr(said, words)) fail_msg("expected '%s', found '%s'", words, said);
}

static void the_error_class_is_called_elastic(void **state)
{
    (void)state;
    char pull[512];
    snprintf(pull, sizeof pull, PULL, ", y: 0, z: 0", "x");
    assert_int_equal(told_of("check", "", "", pull), 0);
    expect(test_program_stdout(), "error class (elastic): ");
    assert_null(strstr(test_program_stdout(), "what breaks"));
}

static void scenes_that_break_are_told_what_was_measured_of_their_kind(void **state)
{
    (void)state;
    assert_int_equal(told_of("check", STRONG, "fracture: {}\n", TEAR), 0);
    expect(test_program_stdout(), "what breaks: the errors above are of the elastic solid");
    expect(test_program_stdout(), "measured where dlsm breaks: onset in an even pull within 0.03 % of the strength");
    assert_int_equal(told_of("check", SOFT, "fracture: {}\n", TEAR), 0);
    expect(test_program_stdout(), "measured where dlsm breaks: peak loads of notched parts +3 to +7 %");
    expect(test_program_stdout(), "(docs/notebook/fracture.md, \"What fracture must show\")");
    assert_int_equal(told_of("check", STRONG, "model: dlsm-published\nfracture: {}\n", TEAR), 0);
    expect(test_program_stdout(), "measured where dlsm-published breaks: only the onset");
}

static void both_warn_of_stages_that_break_nothing(void **state)
{
    (void)state;
    char pull[512];
    snprintf(pull, sizeof pull, PULL, ", y: 0, z: 0", "x");
    static const char *const commands[] = {"check", "run"};
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(told_of(commands[k], STRONG, "fracture: {}\n", pull), 0);
        expect(test_program_stderr(), "scene.yaml:3:1: fracture: no stage breaks a bond");
    }
}

static void both_warn_of_bodies_that_loads_push_where_nothing_holds_them(void **state)
{
    (void)state;
    char pull[512];
    static const char sentence[] = "warning: stage 'pull': body 'block' is free to move along y, z and to turn about "
                                   "x, and its loads push it there: no equilibrium answers them; hold it there";
    snprintf(pull, sizeof pull, PULL, "", "y");
    told_of("check", "", "", pull);
    expect(test_program_stderr(), sentence);
    assert_int_not_equal(told_of("run", "", "", pull), 0);
    expect(test_program_stderr(), sentence);
    snprintf(pull, sizeof pull, PULL, "", "x");
    assert_int_equal(told_of("check", "", "", pull), 0);
    expect(test_program_stderr(),
           "body 'block' is free to move along y, z and to turn about x; no load pushes it there, and it stays");
    assert_int_equal(told_of("run", "", "", pull), 0);
    assert_null(strstr(test_program_stderr(), "is free to move"));
}

static void wrong_scenes_are_refused_at_their_place_before_anything_is_built(void **state)
{
    (void)state;
    assert_int_equal(told_of("run", STRONG, "model: cbm\n", TEAR), 2);
    expect(test_program_stderr(), "scene.yaml:3:8: error: model cbm needs spheres joined by beams");
    assert_int_equal(told_of("run", "", "fracture: {}\n", TEAR), 2);
    expect(test_program_stderr(), "scene.yaml:3:1: error: fracture: nothing can break");
    assert_null(strstr(test_program_stderr(), "cells"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_error_class_is_called_elastic),
        cmocka_unit_test(scenes_that_break_are_told_what_was_measured_of_their_kind),
        cmocka_unit_test(both_warn_of_stages_that_break_nothing),
        cmocka_unit_test(both_warn_of_bodies_that_loads_push_where_nothing_holds_them),
        cmocka_unit_test(wrong_scenes_are_refused_at_their_place_before_anything_is_built),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
