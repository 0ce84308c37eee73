/* Displacements that begin elsewhere than what they hold stands are told of, with how far and the cure. */
#include "../../support.h"
#include <string.h>

#define CLAMP "{face_displacement: {set: x-, x: 0, y: 0, z: 0}}"
#define PULL "  - name: pull\n    solver: static\n    loads: [" CLAMP ", {face_displacement: {set: x+, x: 1 mm}}]\n"
#define NEXT(load) "  - name: next\n    solver: {dynamic: {steps: 3}}\n    loads: [" CLAMP ", " load "]\n"

static const char *said_of(const char *stages)
{
    return heard_of_run((case_options){.fill = "cells: [4, 4, 4], spread: 90 %",
                                       .stages = stages,
                                       .sets = "sets: {end: {elements: {wall: x+}}}\n",
                                       .n_threads = 1});
}

static void what_snaps_is_told_of(void **state)
{
    (void)state;
    const char *said = said_of(PULL NEXT("{face_displacement: {set: x+, x: 0}}"));
    assert_non_null(strstr(said, "stage 'next': face_displacement begins up to 0.001 m from where 'x+' stands"));
    assert_non_null(strstr(said, "`face_velocity: {set: x+, x: 0}`"));
    assert_null(strstr(said, "'x-'"));
    said = said_of(NEXT("{face_displacement: {set: x+, x: 1 mm}}")); /* at once, from rest */
    assert_non_null(strstr(said, "face_displacement begins up to 0.001 m from where 'x+' stands"));
    said = said_of(PULL NEXT("{element_displacement: {set: end, x: 0}}"));
    assert_non_null(strstr(said, "stage 'next': element_displacement begins up to 0.00"));
    assert_non_null(strstr(said, "`element_velocity: {set: end, x: 0}`"));
}

static void what_goes_on_from_where_it_stands_is_not(void **state)
{
    (void)state;
    static const char *const smooth[] = {PULL NEXT("{face_displacement: {set: x+, x: 1 mm}}"),
                                         PULL NEXT("{face_velocity: {set: x+, x: 0}}"),
                                         PULL NEXT("{element_velocity: {set: end, x: 0}}"),
                                         NEXT("{face_displacement: {set: x+, x: 1 mm, table: [[0, 0], [1 s, 1]]}}"),
                                         NEXT("{face_velocity: {set: x+, x: 1 mm/s}}"),
                                         NEXT("{element_displacement: {set: end, x: 0}}")};
    for (size_t k = 0; k < sizeof smooth / sizeof *smooth; ++k)
        assert_null(strstr(said_of(smooth[k]), "stands"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_snaps_is_told_of),
        cmocka_unit_test(what_goes_on_from_where_it_stands_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
