/* Time stepping: conservation, the order of the ledger's closure, the time step, and that equal runs give equal
 * bytes. */
#include "../support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char shaken[] =
    "  - name: shake\n    solver: {dynamic: {steps: 100000, time_step: {auto: {safety: %s}}%s}}\n    initial:\n"
    "      - random: {amplitude: [1 mm/s, 1 mm/s, 1 mm/s], seed: 3}\n";

static char *stage_text(char *text, size_t size, const char *safety, const char *more)
{
    snprintf(text, size, shaken, safety, more);
    return text;
}

static void momentum_of(bench_case *c, double linear[3], double angular[3], double *scale)
{
    const brc_domain *d = c->domain;
    double *u = calloc((size_t)(3 * d->n_elements), sizeof *u), *v = calloc((size_t)(3 * d->n_elements), sizeof *v);
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    memset(linear, 0, 3 * sizeof *linear);
    memset(angular, 0, 3 * sizeof *angular);
    *scale = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double m = d->volume[e];
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = d->position[3 * e + k] + u[3 * e + k];
        for (int k = 0; k < 3; ++k) {
            linear[k] += m * v[3 * e + k];
            angular[k] += m * (x[(k + 1) % 3] * v[3 * e + (k + 2) % 3] - x[(k + 2) % 3] * v[3 * e + (k + 1) % 3]);
            *scale += m * fabs(v[3 * e + k]);
        }
    }
    free(u);
    free(v);
}

static void momentum_and_angular_momentum_are_constant(void **state)
{
    (void)state;
    char text[512];
    bench_case c;
    open_case(&c, (case_options){.stages = stage_text(text, sizeof text, "0.8", "")});
    double linear[2][3], angular[2][3], scale;
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    momentum_of(&c, linear[0], angular[0], &scale);
    assert_done(&c, brc_simulation_advance(c.simulation, 5000));
    momentum_of(&c, linear[1], angular[1], &scale);
    for (int k = 0; k < 3; ++k) { /* rounding of 5000 steps: each adds at most 1e-16 of the momentum in play */
        assert_true(fabs(linear[1][k] - linear[0][k]) < 1e-12 * scale);
        assert_true(fabs(angular[1][k] - angular[0][k]) < 1e-10 * scale);
    }
    close_case(&c);
}

/* Largest |closure| over 400 samples of the same physical time. */
static double worst_closure(const char *safety, int steps_each)
{
    char text[512];
    bench_case c;
    open_case(&c, (case_options){.stages = stage_text(text, sizeof text, safety, "")});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        brc_ledger ledger;
        assert_done(&c, brc_simulation_advance(c.simulation, steps_each));
        assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
        worst = fmax(worst, fabs(ledger.closure));
    }
    close_case(&c);
    return worst;
}

static void closure_falls_with_the_square_of_the_step(void **state)
{
    (void)state;
    const double coarse = worst_closure("0.4", 5), fine = worst_closure("0.1", 20);
    const double order = log(coarse / fine) / log(4);
    /* Verlet's oscillation is second order; the fourth-order term adds up to a tenth at 0.4 of the critical step */
    if (order < 1.85 || order > 2.25) fail_msg("order %g: %g, %g", order, coarse, fine);
}

static void mean_energy_does_not_drift(void **state)
{
    (void)state;
    char text[512];
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [4, 4, 4], spread: 90 %, seed: 1",
                                 .stages = stage_text(text, sizeof text, "0.8", "")});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    double mean[2] = {0, 0};
    for (int part = 0; part < 10; ++part)
        for (int i = 0; i < 100; ++i) {
            brc_ledger ledger;
            assert_done(&c, brc_simulation_advance(c.simulation, 20));
            assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
            if (part == 0) mean[0] += ledger.total / 100;
            if (part == 9) mean[1] += ledger.total / 100;
        }
    close_case(&c);
    /* the sampling noise of a mean of 100 samples of Verlet's few-percent oscillation is some 1e-3; growth would be far
     * more */
    assert_true(fabs(mean[1] / mean[0] - 1) < 3e-3);
}

static void tchamwa_dissipation_is_booked(void **state)
{
    (void)state;
    char text[512];
    bench_case c;
    open_case(&c, (case_options){
                      .stages = stage_text(text, sizeof text, "0.3", ", integrator: {tchamwa-wielgosz: {phi: 1.05}}")});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    brc_ledger ledger;
    assert_done(&c, brc_simulation_advance(c.simulation, 300));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(ledger.numerical > 0.01 * ledger.initial); /* there is dissipation to book */
    /* exact for a linear system: what is left is the law's own nonlinearity, strains of 1e-3 */
    if (!(fabs(ledger.closure) < 1e-3)) fail_msg("closure %g", ledger.closure);
    close_case(&c);
}

static void mass_damping_decays_as_it_says_and_is_booked(void **state)
{
    (void)state;
    bench_case c; /* a rigid body drifting in a fluid: v = v0 exp(-c t) */
    open_case(&c,
              (case_options){
                  .stages = "  - name: drift\n    solver: {dynamic: {steps: 1000, mass_damping: 2 1/s}}\n    initial:\n"
                            "      - velocity: {velocity: [1 mm/s, 0, 0]}\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 100));
    brc_ledger ledger;
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    const double speed = 1e-3 * exp(-2 * brc_simulation_time(c.simulation));
    assert_true(fabs(ledger.kinetic / (0.5 * speed * speed) - 1) < 1e-12);
    assert_true(fabs(ledger.closure) < 1e-12);
    close_case(&c);
}

static void gravity_is_free_fall(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.gravity = "gravity: [0, 0, -9.81 m/s^2]\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 50));
    const double t = brc_simulation_time(c.simulation);
    double *u = calloc((size_t)(3 * c.domain->n_elements), sizeof *u);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    for (int64_t e = 0; e < c.domain->n_elements; ++e) /* Verlet is exact for a constant force: rounding of 50 steps */
        assert_true(fabs(u[3 * e + 2] + 0.5 * 9.81 * t * t) < 1e-11 * t * t);
    brc_ledger ledger;
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(fabs(ledger.kinetic + ledger.potential) < 1e-11 * ledger.kinetic);
    free(u);
    close_case(&c);
}

/* Slow pull by a velocity ramp: the work of the loads is what the solid holds. */
/* 27 cells do not fill slices of 8: what pads them falls with them and must have no energy. Kinetic plus potential is 0
 * for Verlet, to the rounding of 30 steps. */
static void a_body_that_falls_keeps_its_energy(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger ledger;
    open_case(&c, (case_options){.gravity = "gravity: [0, 0, -9.81 m/s^2]\n",
                                 .fill = "cells: [3, 3, 3], spread: 50 %, seed: 1"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 30));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(ledger.kinetic > 1 && fabs(ledger.total) < 1e-13 * ledger.kinetic);
    close_case(&c);
}

static void work_of_loads_closes_the_ledger(void **state)
{
    (void)state;
    const char *const stages[] = {
        "  - name: pull\n    solver: {dynamic: {duration: 4 s, time_step: {auto: {safety: 0.4}}}}\n    loads:\n"
        "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n"
        "      - face_velocity: {set: x+, x: 1 mm/s, table: [[0 s, 0], [2 s, 1], [4 s, 0]]}\n",
        "  - name: push\n    solver: {dynamic: {duration: 4 s, time_step: {auto: {safety: 0.4}}}}\n    loads:\n"
        "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n"
        "      - traction: {set: x+, x: 1 mPa, y: 2 mPa, z: 0, table: [[0 s, 0], [2 s, 1], [4 s, 0.5]]}\n",
        "  - name: impose\n    solver: {dynamic: {duration: 4 s, time_step: {auto: {safety: 0.4}}}}\n    loads:\n"
        "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n"
        "      - element_velocity: {set: right, x: 1 mm/s, table: [[0 s, 0], [2 s, 1], [4 s, 0]]}\n"};
    for (int k = 0; k < 3; ++k) {
        bench_case c;
        open_case(&c,
                  (case_options){.stages = stages[k],
                                 .sets = "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\n"});
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
        const int64_t steps =
            brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value);
        assert_done(&c, brc_simulation_advance(c.simulation, steps));
        brc_ledger ledger;
        assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
        assert_true(ledger.work > 1e-12);
        /* smooth motion over some 300 steps: second order in the step, (1/300)^2 times the number of waves in play */
        if (!(fabs(ledger.closure) < 2e-3)) fail_msg("load %d: closure %g of work %g", k, ledger.closure, ledger.work);
        close_case(&c);
    }
}

/* Prescribed elements are pulled through the fluid by nobody: work of their load and what damping takes are those of
 * the rest. Smooth motion as above, and the same bound. */
static void drag_and_prescribed_elements_share_no_energy(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){
                      .stages =
                          "  - name: impose\n    solver: {dynamic: {duration: 4 s, mass_damping: 0.5 1/s, time_step: "
                          "{auto: {safety: 0.4}}}}\n    loads:\n"
                          "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n"
                          "      - element_velocity: {set: right, x: 1 mm/s, table: [[0 s, 0], [2 s, 1], [4 s, 0]]}\n",
                      .sets = "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\n"});
    begin_first(&c);
    run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
    const brc_ledger ledger = ledger_now(&c);
    assert_true(ledger.damping > 0.05 * ledger.work); /* there is something to share */
    if (!(fabs(ledger.closure) < 2e-3)) fail_msg("closure %g of work %g", ledger.closure, ledger.work);
    close_case(&c);
}

static void critical_step_is_where_verlet_turns_unstable(void **state)
{
    (void)state;
    const double safeties[] = {0.97, 1.06}; /* beyond 1 no scene file may ask for */
    double grown[2];
    for (int k = 0; k < 2; ++k) {
        char text[512];
        bench_case c;
        open_case(&c, (case_options){.stages = stage_text(text, sizeof text, "1", "")});
        c.scene->stages[0].safety = safeties[k];
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
        brc_ledger before, after;
        assert_done(&c, brc_simulation_ledger(c.simulation, &before));
        assert_done(&c, brc_simulation_advance(c.simulation, 400));
        assert_done(&c, brc_simulation_ledger(c.simulation, &after));
        grown[k] = after.total / before.total;
        close_case(&c);
    }
    assert_true(grown[0] < 20);     /* Verlet's oscillation grows as 1/(1 - 0.97^2) near the limit */
    assert_true(!(grown[1] < 1e3)); /* 6 % beyond: e^(400 * 0.35) */
}

static void same_bytes_for_one_and_two_threads(void **state)
{
    (void)state;
    const char *const models[] = {"dlsm", "dlsm-published"};
    for (int m = 0; m < 2; ++m) {
        double *u[2];
        int64_t n = 0;
        for (int k = 0; k < 2; ++k) {
            char text[512];
            bench_case c;
            open_case(&c, (case_options){.model = models[m],
                                         .n_threads = 1 + k,
                                         .stages = stage_text(text, sizeof text, "0.5", "")});
            n = 3 * c.domain->n_elements;
            u[k] = calloc((size_t)n, sizeof *u[k]);
            assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
            assert_done(&c, brc_simulation_advance(c.simulation, 50));
            assert_done(&c, brc_simulation_displacement(c.simulation, u[k]));
            close_case(&c);
        }
        assert_memory_equal(u[0], u[1], (size_t)n * sizeof *u[0]);
        free(u[0]);
        free(u[1]);
    }
}

/* A square table of displacement, a smooth field, precisions: differences at the size of the coefficients' rounding. */
static void mixed_and_single_follow_double(void **state)
{
    (void)state;
    double *u[3];
    int64_t n = 0;
    double size = 0;
    for (int p = 0; p < 3; ++p) {
        char text[512];
        bench_case c;
        open_case(&c,
                  (case_options){.precision = (brc_precision)p, .stages = stage_text(text, sizeof text, "0.5", "")});
        n = 3 * c.domain->n_elements;
        u[p] = calloc((size_t)n, sizeof *u[p]);
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
        assert_done(&c, brc_simulation_advance(c.simulation, 100));
        assert_done(&c, brc_simulation_displacement(c.simulation, u[p]));
        close_case(&c);
    }
    double off[3] = {0};
    for (int64_t i = 0; i < n; ++i) {
        size = fmax(size, fabs(u[0][i]));
        for (int p = 1; p < 3; ++p)
            off[p] = fmax(off[p], fabs(u[p][i] - u[0][i]));
    }
    /* A bond's stiffness is wrong by at most the rounding of its coefficients and operations, some 15 of 2^-24 = 9e-7;
     * an oscillation's phase by half of that times its phase, which is at most 2 asin(0.5) = 1.05 a step: 100 steps
     * give 5e-5 of the amplitude. The steps themselves may differ by as much (power iteration on the rounded
     * stiffness): 1e-4. */
    assert_true(off[1] < 1e-4 * size);
    assert_true(off[2] < 1e-4 * size);
    assert_true(off[1] > 0 && off[2] > 0);
    for (int p = 0; p < 3; ++p)
        free(u[p]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_and_angular_momentum_are_constant),
        cmocka_unit_test(closure_falls_with_the_square_of_the_step),
        cmocka_unit_test(mean_energy_does_not_drift),
        cmocka_unit_test(tchamwa_dissipation_is_booked),
        cmocka_unit_test(mass_damping_decays_as_it_says_and_is_booked),
        cmocka_unit_test(gravity_is_free_fall),
        cmocka_unit_test(a_body_that_falls_keeps_its_energy),
        cmocka_unit_test(work_of_loads_closes_the_ledger),
        cmocka_unit_test(drag_and_prescribed_elements_share_no_energy),
        cmocka_unit_test(critical_step_is_where_verlet_turns_unstable),
        cmocka_unit_test(same_bytes_for_one_and_two_threads),
        cmocka_unit_test(mixed_and_single_follow_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
