/* Strikers and bodies that meet. */
#include "../contact/contact_case.h"
#include "../../../../host/solver/effects/strikers/strikers.h"
#include <math.h>
#include <stdlib.h>

#define STONE "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}\n  steel: {E: 10 Pa, nu: 0.2, density: 2 kg/m^3}"
#define FILL "cells: [4, 4, 4], spread: 50 %, seed: 1"
/* A ball of 0.3 m off the middle above a free cube of 1 m, 0.01 m away from its top, that falls on it and turns. */
#define BALL                                                                                                           \
    "interactions: {contact: {}}\nstrikers:\n"                                                                         \
    "  ball: {shape: {sphere: {radius: 0.3 m, centre: [0.6 m, 0.45 m, 1.31 m]}}, facets: 24, material: steel, "        \
    "motion: {free: {velocity: [0.01 m/s, 0, -0.05 m/s], spin: [0.1 rad/s, 0.2 rad/s, 0]}}}\n"

/* Momentum and angular momentum about the origin of all, and sums of magnitudes that they are small against. */
typedef struct momenta {
    double linear[3], angular[3], size;
} momenta;

static momenta momenta_of(bench_case *c)
{
    const int64_t n = c->domain->n_elements;
    double *u = calloc((size_t)(3 * n), sizeof *u), *v = calloc((size_t)(3 * n), sizeof *v);
    momenta all = {.size = 0};
    brc_striker_now now;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    assert_done(c, brc_simulation_striker_now(c->simulation, 0, &now));
    for (int64_t e = 0; e <= n; ++e) {
        const bool ball = e == n;
        const double m = ball ? brc_simulation_striker_body(c->simulation, 0)->mass : c->domain->volume[e];
        double x[3], p[3];
        for (int k = 0; k < 3; ++k) {
            x[k] = ball ? now.position[k] : c->domain->position[3 * e + k] + u[3 * e + k];
            p[k] = m * (ball ? now.velocity[k] : v[3 * e + k]);
            all.linear[k] += p[k];
            all.size += fabs(p[k]);
        }
        for (int k = 0; k < 3; ++k)
            all.angular[k] +=
                x[(k + 1) % 3] * p[(k + 2) % 3] - x[(k + 2) % 3] * p[(k + 1) % 3] + (ball ? now.momentum[k] : 0);
    }
    free(u), free(v);
    return all;
}

static void play(bench_case *c, const char *stages, int64_t steps)
{
    open_case(c, (case_options){.materials = STONE, .fill = FILL, .gravity = BALL, .stages = stages, .n_threads = 1});
    assert_done(c, brc_simulation_begin_stage(c->simulation, 0));
    assert_done(c, brc_simulation_advance(c->simulation, steps));
}

/* Forces of a pair are equal and opposite and act at one point, so momenta change by rounding alone: some 10 roundings
 * of a force a step, 1e-15 of the largest momentum each. The cells of dlsm are points whose moments close with the
 * surface's: angular momentum likewise. */
static void momenta_are_kept_when_a_free_ball_strikes(void **state)
{
    (void)state;
    bench_case c;
    brc_striker_now before, after;
    play(&c, "  - name: hit\n    solver: {dynamic: {steps: 400, time_step: 2 ms}}\n", 0);
    const momenta first = momenta_of(&c);
    assert_done(&c, brc_simulation_striker_now(c.simulation, 0, &before));
    double deepest = 0;
    for (int k = 0; k < 80; ++k) {
        assert_done(&c, brc_simulation_advance(c.simulation, 50));
        brc_striker_now now;
        assert_done(&c, brc_simulation_striker_now(c.simulation, 0, &now));
        deepest = fmax(deepest, fabs(now.force[2]));
        const momenta there = momenta_of(&c);
        for (int i = 0; i < 3; ++i) {
            assert_true(fabs(there.linear[i] - first.linear[i]) < 4000 * 1e-15 * first.size);
            assert_true(fabs(there.angular[i] - first.angular[i]) <
                        4000 * 1e-15 * 2 * first.size); /* 2 m: how far things are */
        }
    }
    assert_done(&c, brc_simulation_striker_now(c.simulation, 0, &after));
    assert_true(deepest > 0 && after.velocity[2] > before.velocity[2] + 0.03); /* it did strike */
    assert_true(fabs(after.force[2]) == 0);                                    /* and fly off */
    close_case(&c);
}

/* Closure of the ledger after the blow: second order in the step. */
static double closure_at(const char *stages, int64_t steps)
{
    bench_case c;
    brc_ledger ledger;
    double worst = 0;
    play(&c, stages, 0);
    for (int64_t k = 0; k < steps; k += steps / 40) {
        assert_done(&c, brc_simulation_advance(c.simulation, steps / 40));
        assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
        worst = fmax(worst, fabs(ledger.closure));
    }
    close_case(&c);
    return worst;
}
static void the_ledger_closes_with_the_square_of_the_step(void **state)
{
    (void)state;
    const double coarse = closure_at("  - name: hit\n    solver: {dynamic: {steps: 400, time_step: 8 ms}}\n", 400);
    const double fine = closure_at("  - name: hit\n    solver: {dynamic: {steps: 800, time_step: 4 ms}}\n", 800);
    assert_true(coarse > 1e-8 && coarse < 1e-2);
    assert_true(coarse / fine > 3 && coarse / fine < 5.5);
}

/* A plane pushed into the cube from below against gravity of none: its work is what the ledger gains. */
static void a_driven_wall_does_work(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger ledger;
    open_case(&c, (case_options){.materials = STONE,
                                 .fill = FILL,
                                 .n_threads = 1,
                                 .gravity = "interactions: {contact: {}}\nstrikers:\n"
                                            "  press: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: steel, "
                                            "motion: {driven: {velocity: [0, 0, 5 cm/s]}}}\n",
                                 .stages = "  - name: push\n    solver: {dynamic: {steps: 2000, time_step: 4 ms}}\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 500));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(ledger.work > 0.5 * 1 * 0.05 * 0.05); /* the cube moves at least with the wall */
    assert_true(fabs(ledger.closure) < 1e-3); /* (w dt)^2 / 8 at a hundredth of a radian a step, ten times that */
    close_case(&c);
}

static void a_blade_inside_a_cell_is_as_deep_as_it_is_below_the_face(void **state)
{
    (void)state;
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        contact_blade((case_options){.precision = (brc_precision)p});
    contact_blade((case_options){.model = "dlsm-published"});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momenta_are_kept_when_a_free_ball_strikes),
        cmocka_unit_test(the_ledger_closes_with_the_square_of_the_step),
        cmocka_unit_test(a_driven_wall_does_work),
        cmocka_unit_test(a_blade_inside_a_cell_is_as_deep_as_it_is_below_the_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
