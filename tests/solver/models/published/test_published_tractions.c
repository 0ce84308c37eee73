/* dlsm-published under tractions and pressures: force and torque on cells that turn. */
#include "../../support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Two of three components, so that forces, arms and torques point every way; z+ is 1 m^2. */
static const char short_push[] = "  - name: push\n    solver: {dynamic: {steps: 100, time_step: {fixed: 1e-6 s}}}\n    "
                                 "loads:\n      - traction: {set: z+, x: 2 Pa, z: 1 Pa}\n";

/* Sum of push and of arm x push over the free faces of the set that belong to element e. */
static void load_of(const brc_domain *d, const brc_set *set, const double traction[3], int64_t e, double force[3],
                    double torque[3])
{
    for (int c = 0; c < 3; ++c)
        force[c] = torque[c] = 0;
    for (int64_t m = 0; m < set->n_members; ++m) {
        const int64_t f = set->members[m];
        if (d->free_element[f] != e) continue;
        double arm[3], push[3];
        const double *s = d->free_area_vector + 3 * f;
        for (int c = 0; c < 3; ++c) {
            arm[c] = d->free_centroid[3 * f + c] - d->position[3 * e + c];
            push[c] = traction[c] * sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
            force[c] += push[c];
        }
        for (int c = 0; c < 3; ++c)
            torque[c] += arm[(c + 1) % 3] * push[(c + 2) % 3] - arm[(c + 2) % 3] * push[(c + 1) % 3];
    }
}

static void a_cell_is_pushed_and_turned_by_its_faces(void **state)
{
    (void)state;
    static const double traction[3] = {2, 0, 1};
    bench_case c;
    open_case(
        &c, (case_options){.model = "dlsm-published", .fill = "cells: [3, 3, 3], spread: 60 %", .stages = short_push});
    const brc_domain *d = c.domain;
    const int64_t n = d->n_elements;
    const brc_set *set = d->sets + brc_domain_find_set(d, "z+");
    double *force = calloc((size_t)(3 * n), sizeof *force), *turn = calloc((size_t)(4 * n), sizeof *turn),
           *spin = calloc((size_t)(3 * n), sizeof *spin);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_force(c.simulation, force));
    assert_done(&c, brc_simulation_advance(c.simulation, 1));
    assert_done(&c, brc_simulation_orientation(c.simulation, turn, spin));
    int turned = 0;
    for (int64_t e = 0; e < n; ++e) {
        double f[3], t[3];
        load_of(d, set, traction, e, f, t);
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(force[3 * e + k] - f[k]) < 1e-14); /* sums of areas below 1: rounding */
        const double *inertia = d->inertia + 6 * e, moment = (inertia[0] + inertia[1] + inertia[2]) / 3,
                     torque = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
        if (torque == 0) continue;
        /* inertia of a ball, density 1; bonds answer with the square of the step over that of a wave across a cell,
         * 1e-10 */
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(spin[3 * e + k] * moment / 1e-6 - t[k]) < 1e-6 * torque);
        ++turned;
    }
    assert_true(turned >= 9); /* the upper layer */
    free(force);
    free(turn);
    free(spin);
    close_case(&c);
}

/* In a time that waves need for 1e-4 of a cell, bonds hold (1e-4)^2 of what the loads did: the rest is kinetic, of
 * flight and of turning. */
static void work_of_tractions_is_the_kinetic_energy_of_a_short_push(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger l;
    open_case(
        &c, (case_options){.model = "dlsm-published", .fill = "cells: [3, 3, 3], spread: 60 %", .stages = short_push});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_ledger(c.simulation, &l));
    assert_true(l.work > 0);
    if (!(fabs(l.kinetic / l.work - 1) < 1e-6)) fail_msg("kinetic %.9g, work %.9g", l.kinetic, l.work);
    close_case(&c);
}

/* Cells of next to no stiffness fly and spin by a whole turn and more, each a rigid body: what they have is what the
 * load did, to second order in the step. */
static double closure_of_spinning_cells(const char *step, int n_steps)
{
    char stages[400];
    bench_case c;
    brc_ledger l;
    snprintf(stages, sizeof stages,
             "  - name: spin\n    solver: {dynamic: {steps: %d, time_step: {fixed: %s}}}\n    initial:\n      - spin: "
             "{angular_velocity: [300 rad/s, 2000 rad/s, 500 rad/s]}\n"
             "    loads:\n      - traction: {set: z+, x: 200 kPa, y: 100 kPa, z: 300 kPa}\n",
             n_steps, step);
    open_case(&c, (case_options){.model = "dlsm-published",
                                 .materials = "  stone: {E: 1e-6 Pa, nu: 0.2, density: 1 kg/m^3}",
                                 .fill = "cells: [2, 2, 2], spread: 60 %",
                                 .stages = stages});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_ledger(c.simulation, &l));
    close_case(&c);
    return l.closure;
}

static void arms_turn_with_the_cell(void **state)
{
    (void)state;
    const double coarse = closure_of_spinning_cells("20 us", 200), fine = closure_of_spinning_cells("10 us", 400);
    assert_true(fabs(coarse) < 1.6e-3); /* the square of the angle of a step, 2000 x 20e-6 */
    if (!(fabs(fine) < 0.3 * fabs(coarse)))
        fail_msg("%.3g, then %.3g", coarse, fine); /* a quarter, and what the next order leaves */
}

/* A bar of 6 cells pressed at its end: strain times modulus is the pressure, but that the cells held whole at the other
 * end shorten it by half a cell, 1/12. */
static void a_pressed_bar_gets_shorter_as_it_should(void **state)
{
    (void)state;
    bench_case c;
    double mean = 0, area = 0;
    open_case(
        &c, (case_options){.model = "dlsm-published",
                           .fill = "cells: [6, 6, 6], spread: 30 %",
                           .sets = "sets:\n  low_x: {elements: x-}\n  low_y: {elements: y-}\n  low_z: {elements: z-}\n",
                           .stages = "  - name: press\n    solver: {static: {finite_strain: false}}\n    loads:\n      "
                                     "- element_displacement: {set: low_x, x: 0}\n"
                                     "      - element_displacement: {set: low_y, y: 0}\n      - element_displacement: "
                                     "{set: low_z, z: 0}\n      - pressure: {set: x+, value: 1e-6 Pa}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    const brc_set *end = c.domain->sets + brc_domain_find_set(c.domain, "x+");
    double *u = calloc((size_t)(3 * c.domain->n_elements), sizeof *u);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    for (int64_t m = 0; m < end->n_members; ++m) {
        const int64_t f = end->members[m];
        mean += c.domain->free_area_vector[3 * f] * u[3 * (int64_t)c.domain->free_element[f]];
        area += c.domain->free_area_vector[3 * f];
    }
    /* from the middle of the first cells to that of the last: 1 m less a cell */
    const double expected = -1e-6 * (1 - 1.0 / 6);
    if (!(fabs(mean / area / expected - 1) < 1.0 / 12)) fail_msg("%.6g, expected %.6g", mean / area, expected);
    free(u);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cell_is_pushed_and_turned_by_its_faces),
        cmocka_unit_test(work_of_tractions_is_the_kinetic_energy_of_a_short_push),
        cmocka_unit_test(arms_turn_with_the_cell),
        cmocka_unit_test(a_pressed_bar_gets_shorter_as_it_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
