/* What is kept of a simulation is all that its future needs. */
#include "state_cases.h"
#include <stdlib.h>
#include <string.h>

static void a_run_goes_on_in_double_mixed_and_single(void **state)
{
    (void)state;
    state_resumes_on("cpu", BRC_DOUBLE);
    state_resumes_on("cpu", BRC_MIXED);
    state_resumes_on("cpu", BRC_SINGLE);
}

static void what_softens_goes_on_in_double_mixed_and_single(void **state)
{
    (void)state;
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        softening_resumes_on("cpu", (brc_precision)p);
}

static void fragments_that_meet_go_on_in_double_mixed_and_single(void **state)
{
    (void)state;
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        contact_resumes_on("cpu", (brc_precision)p);
}

/* Static events: what is left of a body is solved again and again. */
static void a_body_goes_on_breaking_event_by_event(void **state)
{
    (void)state;
    const fracture_options beams = {.n_threads = 1,
                                    .fracture = "{criterion: virial-principal}",
                                    .strength = "strength: {tension: 2e-4 Pa}",
                                    .elements = 300,
                                    .stages = "stages:\n  - name: crack\n    solver: {static: {events: {most: 6}, "
                                              "finite_strain: false, tolerance: 1e-4}}\n    loads:\n"
                                              "      - element_displacement: {set: x-, x: -1e-4 m}\n      - "
                                              "element_displacement: {set: x+, x: 1e-4 m}\n"};
    assert_true(state_resumes((state_case){.beams = &beams}, (int[]){1, 4, 0}) >= 6);
    const case_options cells = {
        .n_threads = 1,
        .materials = CELLS_STRENGTH("2e-4 Pa"),
        .sets = CELLS_FRACTURE,
        .fill = "cells: [5, 5, 5], spread: 50 %, seed: 1",
        .stages = "  - name: crack\n    solver: {static: {events: {most: 6}, finite_strain: false, tolerance: 1e-4}}\n "
                  "   loads:\n"
                  "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: x+, x: 1e-4 m}\n"};
    assert_true(state_resumes((state_case){.cells = &cells}, (int[]){1, 4, 0}) >= 6);
}

static void turned_elements_and_a_stage_to_failure_go_on(void **state)
{
    (void)state;
    const fracture_options beams = {
        .n_threads = 1,
        .fracture = "{criterion: virial-principal}",
        .strength = "strength: {tension: 2e-4 Pa}",
        .elements = 300,
        .stages = "stages:\n  - name: load\n    solver: {static: {increments: 2, to_failure: 80 %, finite_strain: "
                  "false, tolerance: 1e-4}}\n    loads:\n"
                  "      - element_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - element_displacement: {set: x+, "
                  "x: 1e-4 m}\n"
                  "  - name: twist\n    solver: {dynamic: {steps: 30}}\n    loads:\n      - element_displacement: "
                  "{set: x-, x: 0, y: 0, z: 0}\n"
                  "      - element_rotation: {set: x+, x: 1e-2 rad, table: [[0 s, 0], [10 s, 1]]}\n"};
    state_resumes((state_case){.beams = &beams}, (int[]){1, 2, 3, 20, 0});
}

/* Driven and tumbling ones, in two stages. */
static void strikers_go_on(void **state)
{
    (void)state;
    const case_options cells = {.n_threads = 1,
                                .no_contact = true,
                                .fill = "cells: [3, 3, 3], spread: 50 %, seed: 1",
                                .gravity =
                                    "gravity: [0, 0, -1e-4 m/s^2]\ninteractions: {contact: {}}\nstrikers:\n"
                                    "  brick: {shape: {box: {size: [1 m, 2 m, 3 m], origin: [10 m, 0, 0]}}, material: "
                                    "stone, motion: {free: {spin: [3 rad/s, 1 rad/s, 2 rad/s]}}}\n"
                                    "  press: {plane: {point: [0, 0, -9 m], normal: [0, 0, 1]}, material: stone, "
                                    "motion: {driven: {velocity: [0, 0, 1e-3 m/s], table: [[0, 0], [1 s, 1]]}}}\n",
                                .stages = "  - name: fall\n    solver: {dynamic: {steps: 40}}\n  - name: further\n    "
                                          "solver: {dynamic: {steps: 40, integrator: tchamwa-wielgosz}}\n"};
    state_resumes((state_case){.cells = &cells}, (int[]){20, 60, 0});
}

/* A body crushed on a floor: pairs of cells and of cells and the floor, with friction, some cells rigid. */
static void touching_surfaces_go_on_with_their_friction(void **state)
{
    (void)state;
    const case_options cells = {.n_threads = 1,
                                .materials = CELLS_STRENGTH("2e-4 Pa"),
                                .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                                .stages = "  - name: crush\n    solver: {dynamic: {steps: 300}}\n    initial:\n      - "
                                          "velocity: {gradient: {x: [-4e-2 1/s, 5e-3 1/s, 0], y: [0, 3e-2 1/s, 0]}}\n",
                                .sets = CELLS_FRACTURE
                                "interactions: {contact: {friction: 0.3, restitution: 0.7}}\nstrikers:\n"
                                "  floor: {plane: {point: [-1e-3 m, 0, 0], normal: [1, 0, 0]}, material: stone}\n"};
    state_resumes((state_case){.cells = &cells}, (int[]){20, 100, 0});
    static memory_store kept; /* and there was something to keep */
    bench_case c;
    open_case(&c, cells);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 300));
    memory_store_begin(&kept, c.context);
    assert_done(&c, brc_lockstep_save(1, &c.simulation, &kept.store));
    assert_true(memory_store_find(&kept, 0, "contact.pairs")->rows > 20);
    assert_true(*(double *)memory_store_find(&kept, 0, "contact.n_rigid")->data > 0);
    memory_store_free(&kept);
    close_case(&c);
}

static void a_store_without_a_number_is_refused(void **state)
{
    (void)state;
    state_is_refused_without(
        (case_options){
            .n_threads = 1, .stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE},
        60, 4, (const char *const[]){"velocity", "fracture.half_edges", "cells.area", "modes"});
}

static void name_one_too_many(memory_item *broken, const bench_case *of)
{
    ((int32_t *)broken->data)[broken->rows - 1] = (int32_t)of->domain->n_half_edges;
}

static void broken_bonds_that_the_domain_does_not_have_are_refused(void **state)
{
    (void)state;
    state_is_refused_forged(
        (case_options){
            .n_threads = 1, .stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE},
        60, "fracture.half_edges", name_one_too_many, "broken bonds: half-edge");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_goes_on_in_double_mixed_and_single),
        cmocka_unit_test(what_softens_goes_on_in_double_mixed_and_single),
        cmocka_unit_test(fragments_that_meet_go_on_in_double_mixed_and_single),
        cmocka_unit_test(a_body_goes_on_breaking_event_by_event),
        cmocka_unit_test(turned_elements_and_a_stage_to_failure_go_on),
        cmocka_unit_test(strikers_go_on),
        cmocka_unit_test(touching_surfaces_go_on_with_their_friction),
        cmocka_unit_test(a_store_without_a_number_is_refused),
        cmocka_unit_test(broken_bonds_that_the_domain_does_not_have_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
