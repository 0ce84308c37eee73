/* Cuts whose sides end in each other are told of, with how far and the cure. */
#include "../support.h"
#include <stdio.h>
#include <string.h>

/* A cube of uneven cells cut right through at half its height. */
#define CUT                                                                                                            \
    "    cracks: [{name: cut, patch: {rectangle: {corner: [-0.1 m, 0.5 m, -0.1 m], edge: [1.2 m, 0, 0], other_edge: "  \
    "[0, 0, 1.2 m]}}}]\n"
#define HELD(motion, y)                                                                                                \
    "    loads: [{face_displacement: {set: y-, x: 0, y: 0, z: 0}}, {face_" motion ": {set: y+, x: 0, y: " y            \
    ", z: 0}}]\n"

/* What is said of a run. */
static const char *said_of(const char *stages, const char *keys)
{
    return heard_of_run((case_options){.regions = CUT, .stages = stages, .gravity = keys, .n_threads = 1});
}

/* Either half follows what holds it, as nothing joins them: 10 mm, exactly. */
static void sides_that_end_in_each_other_are_told_of(void **state)
{
    (void)state;
    const char *said = said_of("  - name: press\n    solver: static\n" HELD("displacement", "-10 mm"), NULL);
    assert_non_null(strstr(said, "stage 'press': at its end the sides of crack 'cut' lie in each other, over 100 % of "
                                 "it and by up to 0.01 m"));
    assert_non_null(strstr(said, "contact: {friction: ...}}`, in a dynamic stage"));
    said = said_of("  - name: press\n    solver: {dynamic: {duration: 10 s}}\n" HELD("velocity", "-1 mm/s"), NULL);
    assert_non_null(strstr(said, "the sides of crack 'cut' lie in each other, over 100 % of it"));
    assert_null(strstr(said, "in a dynamic stage"));
}

static void open_cuts_and_cuts_that_touch_are_not(void **state)
{
    (void)state;
    assert_null(strstr(said_of("  - name: pull\n    solver: static\n" HELD("displacement", "10 mm"), NULL), "sides"));
    assert_null(
        strstr(said_of("  - name: shear\n    solver: static\n    loads: [{face_displacement: {set: y-, x: 0, y: "
                       "0, z: 0}}, {face_displacement: {set: y+, x: 10 mm, y: 0.5 mm, z: 0}}]\n",
                       NULL),
               "sides"));
    assert_null(strstr(said_of("  - name: press\n    solver: {dynamic: {duration: 10 s}}\n" HELD("velocity", "-1 mm/s"),
                               "interactions: {contact: {}}\n"),
                       "sides"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_that_end_in_each_other_are_told_of),
        cmocka_unit_test(open_cuts_and_cuts_that_touch_are_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
