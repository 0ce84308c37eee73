/* Which pairs are listed, and when they are looked for again. Cells of E 1 Pa and density 1 kg/m^3 (contact_case.h). */
#include "contact_case.h"
#include "../fracture/fracture_case.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Displacements and velocities of a cube of 4 x 4 x 4 cells that bursts and is crushed, after 400 steps, and pairs that
 * touch. */
static double *crushed(const char *model, const char *contact, int64_t *n, int64_t *listed)
{
    bench_case c;
    char keys[200];
    snprintf(keys, sizeof keys,
             "fracture: {criterion: bond-normal}\ninteractions: {contact: {friction: 0.3, restitution: 0.7%s}}\n",
             contact);
    open_case(&c, (case_options){.model = model,
                                 .fill = "cells: [4, 4, 4], spread: 90 %, seed: 1",
                                 .stages = CONTACT_CRUSH,
                                 .materials = CELLS_STRENGTH("2e-4 Pa"),
                                 .sets = keys,
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 400));
    *n = 6 * c.domain->n_elements;
    *listed = brc_simulation_contact_report(c.simulation).n_pairs;
    double *out = calloc((size_t)*n, sizeof *out);
    assert_done(&c, brc_simulation_displacement(c.simulation, out));
    assert_done(&c, brc_simulation_velocity(c.simulation, out + *n / 2));
    close_case(&c);
    return out;
}

/* The thicker the skin the more pairs are listed and the fewer are sifted out; at 0.3 m, more than a cell, nearly all
 * of the cube. A pair that touched and was not listed would show in the motion. */
static void the_skin_changes_no_bit_of_the_motion(void **state)
{
    (void)state;
    static const char *const models[2] = {"dlsm", "dlsm-published"};
    for (int m = 0; m < 2; ++m) {
        int64_t n[3], listed[3];
        double *thick = crushed(models[m], ", skin: 0.3 m", &n[0], &listed[0]),
               *chosen = crushed(models[m], "", &n[1], &listed[1]);
        double *thin = crushed(models[m], ", skin: 2 mm", &n[2], &listed[2]);
        print_message("%s: %lld, %lld and %lld pairs listed\n", models[m], (long long)listed[0], (long long)listed[1],
                      (long long)listed[2]);
        assert_true(listed[0] > listed[1] && listed[1] > listed[2] && listed[2] > 0);
        assert_memory_equal(thick, chosen, (size_t)n[0] * sizeof *thick);
        assert_memory_equal(thick, thin, (size_t)n[0] * sizeof *thick);
        free(thick), free(chosen), free(thin);
    }
}

#define FAST                                                                                                           \
    "  - name: burst\n    solver: {dynamic: {steps: 2000}}\n    initial:\n"                                            \
    "      - velocity: {gradient: {x: [-8e-3 1/s, 2e-3 1/s, 0], y: [-4e-3 1/s, 6e-3 1/s, 2e-3 1/s], z: [0, 0, 1e-2 "   \
    "1/s]}}\n"
enum { DLSM, PUBLISHED, BEAMS };
/* A cube that bursts and is pressed together; whole: all pairs are looked for after every break. */
static void open_crushed(bench_case *c, int kind, bool whole)
{
    if (kind == BEAMS)
        open_fracture(
            c,
            (fracture_options){
                .elements = 300,
                .strength = "strength: {tension: 1e-3 Pa}",
                .beam = "{radius: 0.4, E: 8 Pa, strength: 1e-3 Pa}",
                .stages = "stages:\n" FAST,
                .fracture = "{criterion: virial-principal}\ninteractions: {contact: {friction: 0.3, restitution: 0.7}}",
                .n_threads = 1});
    else
        open_case(c, (case_options){.model = kind == PUBLISHED ? "dlsm-published" : "dlsm",
                                    .fill = "cells: [6, 6, 6], spread: 90 %, seed: 1",
                                    .stages = CONTACT_CRUSH,
                                    .materials = CELLS_STRENGTH("8e-4 Pa"),
                                    .sets = CONTACT_KEYS,
                                    .n_threads = 1});
    assert_done(c, brc_simulation_begin_stage(c->simulation, 0));
    brc_contact_always_whole(c->simulation, whole);
}

/* To the last bit: who is exposed, who is listed, when, and what is evaluated again may not matter. */
static void after_breaks_only_pairs_around_them_are_looked_for_and_the_motion_is_the_same(void **state)
{
    (void)state;
    for (int kind = DLSM; kind <= BEAMS; ++kind) {
        double *out[2];
        int64_t n = 0, searches[2], broken[2];
        for (int whole = 0; whole < 2; ++whole) {
            bench_case c;
            open_crushed(&c, kind, whole);
            assert_done(&c, brc_simulation_advance(c.simulation, 400));
            n = 6 * c.domain->n_elements;
            searches[whole] = brc_simulation_contact_report(c.simulation).searches;
            broken[whole] = count_broken(&c);
            out[whole] = calloc((size_t)n, sizeof *out[whole]);
            assert_done(&c, brc_simulation_displacement(c.simulation, out[whole]));
            assert_done(&c, brc_simulation_velocity(c.simulation, out[whole] + n / 2));
            close_case(&c);
        }
        print_message("%lld bonds broken, %lld searches of all, and %lld where every break makes one\n",
                      (long long)broken[0], (long long)searches[0], (long long)searches[1]);
        assert_true(broken[0] > 50 && broken[0] == broken[1]);
        assert_true(searches[1] > 2 * searches[0]);
        assert_memory_equal(out[0], out[1], (size_t)n * sizeof *out[0]);
        free(out[0]), free(out[1]);
    }
}

/* Pairs, their order and what they remember: the list that grew by what breaks changed of it, against one that is made
 * at once. */
static void a_list_that_grew_is_that_of_a_search_from_the_same_places(void **state)
{
    (void)state;
    for (int kind = DLSM; kind <= BEAMS; ++kind) {
        bench_case c;
        int32_t *ends[2];
        double *history[2];
        int64_t n[2];
        open_crushed(&c, kind, false);
        for (int part = 0; part < 4; ++part) {
            assert_done(&c, brc_simulation_advance(c.simulation, 97));
            for (int k = 0; k < 2; ++k) {
                n[k] = brc_simulation_contact_report(c.simulation).n_pairs;
                assert_true(n[k] > 0);
                ends[k] = calloc((size_t)(2 * n[k]), sizeof *ends[k]);
                history[k] = calloc((size_t)(BRC_CONTACT_HISTORY * n[k]), sizeof *history[k]);
                assert_done(&c, brc_contact_read_pairs(c.simulation, ends[k], history[k]));
                if (k == 0) assert_done(&c, brc_contact_list_again(c.simulation));
            }
            assert_true(n[0] == n[1]);
            assert_memory_equal(ends[0], ends[1], (size_t)(2 * n[0]) * sizeof *ends[0]);
            assert_memory_equal(history[0], history[1], (size_t)(BRC_CONTACT_HISTORY * n[0]) * sizeof *history[0]);
            for (int k = 0; k < 2; ++k)
                free(ends[k]), free(history[k]);
        }
        close_case(&c);
    }
}

/* How often pairs are looked for in 400 steps of 0.05 s of a cube of 27 cells with these keys and this initial
 * velocity, after 40 steps, in which a strength of nothing parts all cells. */
static int64_t searches(const char *materials, const char *keys, const char *initial)
{
    bench_case c;
    char stage[400];
    snprintf(stage, sizeof stage,
             "  - name: fly\n    solver: {dynamic: {steps: 100000, time_step: 0.05 s}}\n    initial:\n      - "
             "velocity: {%s}\n",
             initial);
    open_case(&c, (case_options){.fill = "cells: [3, 3, 3], spread: 50 %, seed: 1",
                                 .materials = materials,
                                 .sets = keys,
                                 .stages = stage,
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 40));
    if (materials) assert_true(brc_simulation_contact_report(c.simulation).n_rigid == 27);
    const int64_t before = brc_simulation_contact_report(c.simulation).searches;
    assert_done(&c, brc_simulation_advance(c.simulation, 400));
    const int64_t after = brc_simulation_contact_report(c.simulation).searches;
    close_case(&c);
    return after - before;
}

/* Flight over 60 cells, and dust that grows by 0.4 of its size, 0.6 of a cell at the edge, bring no two together: what
 * is left of the motion is rounding. Against a wall the whole way counts: 22 m of flight along one that is 1 m below,
 * 0.7 m or more from the balls about the cells, 33 times at most. */
static void what_flies_or_grows_as_a_whole_is_not_looked_for_again(void **state)
{
    (void)state;
    static const char wall[] = "interactions: {contact: {}}\nstrikers:\n  far: {plane: {point: [0, 0, -1 m], normal: "
                               "[0, 0, 1]}, material: stone}\n";
    const char *const touch = "interactions: {contact: {}}\n", *const flight = "velocity: [1 m/s, 0.5 m/s, 0]";
    assert_int_equal(searches(NULL, touch, flight), 0);
    const int64_t along = searches(NULL, wall, flight);
    assert_true(along > 0 && along <= 33);
    assert_int_equal(searches(CELLS_STRENGTH("1e-12 Pa"), CONTACT_KEYS,
                              "gradient: {x: [0.02 1/s, 0, 0], y: [0, 0.02 1/s, 0], z: [0, 0, 0.02 1/s]}"),
                     0);
    assert_true(searches(CELLS_STRENGTH("1e-12 Pa"), CONTACT_KEYS,
                         "gradient: {x: [0.02 1/s, 0, 0], y: [0, 0.02 1/s, 0], z: [0, 0, 0.06 1/s]}") > 0);
}

/* Once all bonds are broken there is no stiffness but that of contact: omega^2 = 4 k / m of the lightest cell, with
 * friction times 2.5 tangential / normal, 2 (1 - nu) / (2 - nu), nu = 0.2; the bound is that of cells of 1/27 m^3 at
 * most, k = E h, m = rho h^3: 2 h / sqrt(4 * 2.5 * 0.889) = 0.67 h, and more than half of it, as no cell is eight times
 * smaller in a grid of 50 % noise. */
static void a_stage_of_nothing_but_dust_takes_its_step_from_contact(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c,
              (case_options){
                  .fill = "cells: [3, 3, 3], spread: 50 %, seed: 1",
                  .materials = CELLS_STRENGTH("1e-12 Pa"),
                  .sets = CONTACT_KEYS,
                  .n_threads = 1,
                  .stages =
                      "  - name: burst\n    solver: {dynamic: {steps: 40, time_step: 0.05 s}}\n    initial:\n"
                      "      - velocity: {gradient: {x: [0.02 1/s, 0, 0], y: [0, 0.02 1/s, 0], z: [0, 0, 0.02 1/s]}}\n"
                      "  - name: fly\n    solver: {dynamic: {steps: 40}}\n"});
    brc_time_step step;
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 40));
    assert_true(brc_simulation_contact_report(c.simulation).n_rigid == 27);
    assert_done(&c, brc_simulation_find_time_step(c.simulation, 1, &step));
    print_message("%s: %.4g s\n", step.governed_by, step.critical);
    assert_string_equal(step.governed_by, "auto: contact");
    assert_true(step.critical <= 0.67 / 3 && step.critical > 0.5 * 0.67 / 3);
    assert_done(&c, brc_simulation_advance(c.simulation, 40));
    close_case(&c);
}

/* A cube of cells in which nothing is cracked: the pairs two cells apart on its surface, whose balls meet, all have a
 * plane between them. */
static void nothing_is_listed_in_a_whole_body_at_rest(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [6, 6, 6], spread: 90 %, lloyd: 3",
                                 .sets = "interactions: {contact: {}}\n",
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_int_equal(brc_simulation_contact_report(c.simulation).n_pairs, 0);
    assert_true(brc_simulation_contact_report(c.simulation).n_listed > 100);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_skin_changes_no_bit_of_the_motion),
        cmocka_unit_test(after_breaks_only_pairs_around_them_are_looked_for_and_the_motion_is_the_same),
        cmocka_unit_test(a_list_that_grew_is_that_of_a_search_from_the_same_places),
        cmocka_unit_test(what_flies_or_grows_as_a_whole_is_not_looked_for_again),
        cmocka_unit_test(a_stage_of_nothing_but_dust_takes_its_step_from_contact),
        cmocka_unit_test(nothing_is_listed_in_a_whole_body_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
