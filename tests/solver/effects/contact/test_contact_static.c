/* Scenes that come to rest before anything can touch: contact sleeps in static stages and modes. */
#include "../../models/cbm/beams_case.h"
#include "contact_case.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HOLD "    loads:\n      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n"
#define REST "  - name: rest\n    solver: static\n" HOLD "      - face_displacement: {set: x+, x: %s}\n"
#define SHAKE "  - name: shake\n    solver: {dynamic: {steps: 400, time_step: {auto: {safety: 0.2}}}}\n" HOLD
#define CONTACT "interactions: {contact: {friction: 0.3}}\n"
#define FLOOR CONTACT "strikers:\n  floor: {plane: {point: [1 m, 0, 0], normal: [-1, 0, 0]}, material: stone}\n"

static const char *const cells = "cells: [4, 4, 4], spread: 90 %, seed: 1";

static void come_to_rest(bench_case *c)
{
    begin_first(c);
    assert_done(c, brc_statics_run(1, &c->simulation, NULL));
}

/* Displacements after the static first stage, in which x+ moves. */
static double *at_rest(const char *keys, const char *move, int64_t *n)
{
    bench_case c;
    char stages[600];
    snprintf(stages, sizeof stages, REST SHAKE, move);
    open_case(&c, (case_options){.fill = cells, .sets = keys, .stages = stages, .n_threads = 1});
    come_to_rest(&c);
    *n = 3 * c.domain->n_elements;
    double *out = calloc((size_t)*n, sizeof *out);
    assert_done(&c, brc_simulation_displacement(c.simulation, out));
    close_case(&c);
    return out;
}

static void a_rest_is_the_same_with_contact_and_without(void **state)
{
    (void)state;
    static const char *const moves[2] = {"-1e-3 m", "1e-3 m"};
    for (int k = 0; k < 2; ++k) { /* away from the wall that stands at x+, and through it */
        int64_t n[2];
        double *with = at_rest(FLOOR, moves[k], &n[0]), *without = at_rest(NULL, moves[k], &n[1]);
        assert_true(n[0] == n[1] && with[0] != 0);
        assert_memory_equal(with, without, (size_t)n[0] * sizeof *with);
        free(with), free(without);
    }
}

/* A cube held short lets go towards a wall that stood at its face: it reaches where it came from, and rests there.
 * Without the wall its face swings as far beyond. */
static void what_was_at_rest_meets_the_wall_when_it_moves(void **state)
{
    (void)state;
    double most[2] = {0, 0}, worst = 0;
    for (int wall = 0; wall < 2; ++wall) {
        bench_case c;
        char stages[600];
        snprintf(stages, sizeof stages, REST SHAKE, "-1e-3 m");
        open_case(&c, (case_options){.fill = cells, .sets = wall ? FLOOR : NULL, .stages = stages, .n_threads = 1});
        come_to_rest(&c);
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 1));
        const double held = ledger_now(&c).elastic;
        double *u = calloc((size_t)(3 * c.domain->n_elements), sizeof *u);
        for (int k = 0; k < 400; ++k) {
            assert_done(&c, brc_simulation_advance(c.simulation, 1));
            assert_done(&c, brc_simulation_displacement(c.simulation, u));
            double mean = 0;
            int64_t n = 0;
            for (int64_t e = 0; e < c.domain->n_elements; ++e)
                if (c.domain->position[3 * e] > 0.75) mean += u[3 * e], ++n;
            most[wall] = fmax(most[wall], mean / (double)n);
            worst = fmax(worst, fabs(ledger_now(&c).closure));
        }
        assert_true(held > 0.4e-6 &&
                    held < 0.7e-6); /* E / 2 times the square of the strain, and what the clamped face adds */
        free(u);
        close_case(&c);
    }
    print_message("face %.3g mm, with the wall %.3g mm; closure %.2g\n", 1e3 * most[0], 1e3 * most[1], worst);
    /* The wall is as stiff as a cell, so it gives by about the share of a cell of the cube: a quarter. */
    assert_true(most[0] > 0.6e-3 && most[1] < 0.4e-3);
    assert_true(worst < 2e-2); /* of a leapfrog the fastest mode is off by (2 x 0.2)^2 / 8 of its energy */
}

static void what_a_rest_presses_together_is_refused(void **state)
{
    (void)state;
    bench_case c;
    char stages[600];
    snprintf(stages, sizeof stages, REST SHAKE, "1e-3 m"); /* through the wall */
    open_case(&c, (case_options){.fill = cells, .sets = FLOOR, .stages = stages, .n_threads = 1});
    assert_int_equal(brc_simulation_run(c.simulation), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "stage 'rest' knows no contact"));
    close_case(&c);
}

/* Spheres without a beam are for contact to move, but at rest they need a place: they keep theirs. Two joined spheres
 * and one far away. */
static void a_loose_sphere_stays_while_the_others_come_to_rest(void **state)
{
    (void)state;
    bench_case c;
    static const double x[9] = {1, 1, 1, 2, 1, 1, 9, 9, 9};
    double u[9];
    open_beams(&c,
               (beams_options){.n = 3,
                               .position = x,
                               .radius = 0.5,
                               .coordination = 2.0 / 3,
                               .stages = CONTACT "gravity: [0, 0, -1e-6 m/s^2]\nsets:\n  root: {elements: {sphere: "
                                                 "{centre: [1 m, 1 m, 1 m], radius: 10 cm}}}\n"
                                                 "stages:\n  - name: rest\n    solver: static\n    loads:\n      - "
                                                 "element_displacement: {set: root, x: 0, y: 0, z: 0}\n"
                                                 "      - element_rotation: {set: root, x: 0, y: 0, z: 0}\n  - name: "
                                                 "fall\n    solver: {dynamic: {steps: 10, time_step: 1 s}}\n"});
    come_to_rest(&c);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    assert_true(u[5] < -1e-6 && u[6] == 0 && u[7] == 0 && u[8] == 0);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 1));
    run_steps(&c, 10);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    assert_true(fabs(u[8] / -5e-5 - 1) < 1e-9); /* g t^2 / 2 */
    close_beams(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rest_is_the_same_with_contact_and_without),
        cmocka_unit_test(what_was_at_rest_meets_the_wall_when_it_moves),
        cmocka_unit_test(what_a_rest_presses_together_is_refused),
        cmocka_unit_test(a_loose_sphere_stays_while_the_others_come_to_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
