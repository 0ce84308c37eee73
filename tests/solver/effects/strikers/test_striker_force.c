/* Free strikers under a prescribed force: alone, in gravity, on elastic columns; what is booked, and what a checkpoint
 * has of it. */
#include "../../core/state_cases.h"
#include "../../../../host/solver/effects/strikers/striker_contact.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define STEEL "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}\n  steel: {E: 10 Pa, nu: 0.2, density: 1000 kg/m^3}"
#define FILL "cells: [2, 2, 2], spread: 50 %, seed: 1"
#define BRICK(motion)                                                                                                  \
    "interactions: {contact: {}}\nstrikers:\n  brick: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [10 m, 0, 0]}}, "  \
    "material: steel, motion: {free: {" motion "}}}\n"
#define STAGE(steps) "  - name: move\n    solver: {dynamic: {steps: " steps ", time_step: 1 ms}}\n"

static void open_alone(bench_case *c, const char *keys, const char *stages)
{
    open_case(
        c,
        (case_options){
            .materials = STEEL, .fill = FILL, .gravity = keys, .stages = stages, .n_threads = 1, .no_contact = true});
    begin_first(c);
}

static brc_striker_now now_of(bench_case *c, int32_t striker)
{
    brc_striker_now now;
    assert_done(c, brc_simulation_striker_now(c->simulation, striker, &now));
    return now;
}

/* x = F t^2 / 2m, v = F t / m, W = F x = m v^2 / 2 are exact for velocity Verlet under a constant force, but for
 * roundings of 1000 steps; mass 1000 kg. */
static void a_mass_under_a_constant_force_follows_the_parabola(void **state)
{
    (void)state;
    bench_case c;
    open_alone(&c, BRICK("force: [200 N, 0, -100 N]"), STAGE("1000"));
    run_steps(&c, 1000);
    const brc_striker_now now = now_of(&c, 0);
    const double roundings = 1000 * 1e-16;
    assert_true(fabs(now.displacement[0] - 0.1) < roundings && fabs(now.velocity[0] - 0.2) < roundings);
    assert_true(fabs(now.displacement[2] + 0.05) < roundings && now.displacement[1] == 0 && now.spin[0] == 0);
    assert_true(now.applied[0] == 200 && now.applied[2] == -100 && now.force[0] == 0);
    const brc_ledger ledger = ledger_now(&c);
    assert_true(fabs(ledger.work - 25) < 25 * roundings && fabs(ledger.kinetic - 25) < 25 * roundings);
    close_case(&c);
}

/* A force that rises as F t / T: v = F t^2 / 2 m T exactly, as its kicks are trapezoids; x = (F t^3 - F t dt^2) / 6 m
 * T, a third difference left out each step. Its work is the energy, to roundings, after the first step too. After T the
 * force stays. */
static void a_force_follows_its_table_and_its_work_is_booked(void **state)
{
    (void)state;
    bench_case c;
    open_alone(&c, BRICK("force: [0, 300 N, 0], table: [[0, 0], [1 s, 1]]"), STAGE("1500"));
    run_steps(&c, 1);
    brc_ledger ledger = ledger_now(&c);
    assert_true(ledger.kinetic > 0 && fabs(ledger.work / ledger.kinetic - 1) < 1e-14);
    run_steps(&c, 999);
    brc_striker_now now = now_of(&c, 0);
    const double dt = 1e-3, m = 1000, force = 300, roundings = 1000 * 1e-16;
    assert_true(fabs(now.velocity[1] - force / (2 * m)) < roundings);
    assert_true(fabs(now.displacement[1] - force * (1 - dt * dt) / (6 * m)) < roundings);
    assert_true(now.applied[1] == force);
    ledger = ledger_now(&c);
    assert_true(fabs(ledger.kinetic - ledger.work) < 100 * roundings);
    run_steps(&c, 500);
    now = now_of(&c, 0);
    assert_true(fabs(now.velocity[1] - (force / (2 * m) + 0.5 * force / m)) < roundings && now.applied[1] == force);
    close_case(&c);
}

/* Gravity comes on top, a rail takes what is across it, and Tchamwa-Wielgosz books what it loses: the energy is kept to
 * roundings of the terms. */
static void gravity_rails_and_integrators_go_with_it(void **state)
{
    (void)state;
    static const char *const integrator[] = {"", ", integrator: {tchamwa-wielgosz: {phi: 1.1}}"};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char stages[200];
        snprintf(stages, sizeof stages, "  - name: move\n    solver: {dynamic: {steps: 100, time_step: 1 ms%s}}\n",
                 integrator[k]);
        open_alone(&c,
                   "gravity: [3 m/s^2, 0, -10 m/s^2]\n" BRICK(
                       "force: [0, 0, 4000 N], mass: 500 kg, hold: {x: true, rotation: true}"),
                   stages);
        run_steps(&c, 100);
        const brc_striker_now now = now_of(&c, 0);
        brc_striker_energies e;
        assert_done(&c, brc_strikers_energies(c.simulation, &e));
        assert_true(fabs(now.velocity[2] + 0.2) < 1e-13 &&
                    now.displacement[0] == 0); /* 4000 / 500 - 10 = -2 m/s^2, 0.1 s */
        assert_true(fabs(e.kinetic + e.potential + e.numerical - e.work) < 1e-12 * fabs(e.work));
        assert_true(e.work < 0 && (k == 0) == (e.numerical == 0));
        close_case(&c);
    }
}

/* ---- a platen on a column: E 1 Pa, 1 m x 1 m x 1 m, so k = E A / L = 1 N/m of the column ---- */

#define PRESSED(platens, damping, solver)                                                                              \
    (case_options)                                                                                                     \
    {                                                                                                                  \
        .materials = STEEL, .fill = "cells: [3, 3, 6], spread: 0 %",                                                   \
        .gravity = "interactions: {contact: {damping: " damping                                                        \
                   "}}\nplatens: {axis: z, friction: 0, material: steel, " platens "}\n",                              \
        .stages = "  - name: press\n    solver: {dynamic: {" solver "}}\n", .n_threads = 1                             \
    }
enum { LOW, HIGH };

/* Mean displacement along z of the layer of cells at a height: 1/12 m below or above the ends of six layers [m]. */
static double layer(bench_case *c, double height)
{
    double sum = 0, *u = NULL;
    int n = 0;
    assert_non_null(u = malloc(3 * (size_t)c->domain->n_elements * sizeof *u));
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    for (int64_t e = 0; e < c->domain->n_elements; ++e)
        if (fabs(c->domain->position[3 * e + 2] - height) < 0.01) sum += u[3 * e + 2], ++n;
    free(u);
    assert_int_equal(n, 9);
    return sum / n;
}

/* Drag of the column and dashpots of its surfaces bring it to rest: the column between the middles of its end layers,
 * 5/6 m apart, is shortened by 5/6 F / k, and all of the force goes through. What is left of the motion after 40 s is
 * e^-40 or less; at a strain of 1e-4 the law of St. Venant and Kirchhoff gives way by 3/2 of that more than the linear
 * one, 1.5e-4. */
static void a_pressed_column_rests_at_force_over_stiffness(void **state)
{
    (void)state;
    bench_case c;
    const double force = 1e-4;
    open_case(&c, PRESSED("force: 0.1 mN, mass: 10 g", "50 %", "duration: 40 s, mass_damping: 2 1/s"));
    begin_first(&c);
    run_steps(&c, (int64_t)(40 / brc_simulation_time_step(c.simulation).value));
    const double shortened = layer(&c, 1.0 / 12) - layer(&c, 11.0 / 12), low = now_of(&c, LOW).force[2],
                 high = now_of(&c, HIGH).force[2];
    assert_true(fabs(shortened / (5.0 / 6 * force) - 1) < 2e-4);
    assert_true(fabs(high / force - 1) < 1e-4 && fabs(low / force + 1) < 1e-4 && now_of(&c, HIGH).applied[2] == -force);
    close_case(&c);
}

/* Put on at once without drag, a platen of 100 times the column's mass goes twice as far as it rests, and the column
 * then bears 2 F; the column's own mass, a third of it, is 0.3 % of what moves. Waves through the column add up to
 * sqrt(m / M) of the force at most: 10 %, and the mean over a wave's way through and back has less. Way: of the platen,
 * twice that of static equilibrium, which is F over the stiffness of column and surfaces in a row, taken from the
 * oscillation's own period, 2 pi sqrt(M / k). */
static void a_force_put_on_at_once_goes_twice_as_far(void **state)
{
    (void)state;
    bench_case c;
    const double force = 1e-3, mass = 100 + 1.0 / 3;
    double deepest = 0, most = 0, at = 0, mean = 0;
    open_case(&c, PRESSED("force: 1 mN, mass: 100 kg", "0", "duration: 60 s"));
    begin_first(&c);
    const double dt = brc_simulation_time_step(c.simulation).value;
    const int within = (int)(2 / dt); /* steps of a wave's way through the column and back: speed 1.05 m/s */
    for (int64_t k = 0; k < (int64_t)(45 / dt); ++k) {
        run_steps(&c, 1);
        const double way = -now_of(&c, HIGH).displacement[2];
        mean += (-now_of(&c, LOW).force[2] - mean) / within;
        most = fmax(most, mean);
        if (way > deepest) deepest = way, at = (double)(k + 1) * dt;
    }
    const double stiffness = mass * M_PI * M_PI / (at * at); /* at: half a period */
    assert_true(fabs(deepest * stiffness / (2 * force) - 1) < 0.02);
    assert_true(fabs(most / (2 * force) - 1) < 0.02);
    const brc_ledger ledger = ledger_now(&c);
    assert_true(fabs(ledger.closure) < 1e-3 && ledger.work > 0);
    close_case(&c);
}

/* From rest it falls through a gap that a list of contacts, looked over a quarter of a second before, does not see
 * coming: the first step that ends below the gap has contact. */
static void a_pushed_striker_is_seen_coming(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, PRESSED("force: 50 N, mass: 1 kg, gap: 2 cm", "0", "steps: 400, time_step: 2 ms"));
    begin_first(&c);
    int met = 0;
    for (int k = 0; k < 100 && !met; ++k) {
        run_steps(&c, 1);
        met = now_of(&c, HIGH).displacement[2] < -0.0201;
    }
    assert_true(met && now_of(&c, HIGH).force[2] > 0);
    close_case(&c);
}

/* A force that changes with time, contact and breaks: the run goes on from a checkpoint with the same bits. */
static void a_run_goes_on_from_its_checkpoint(void **state)
{
    (void)state;
    const case_options pressed = {
        .materials = CELLS_STRENGTH("2e-3 Pa"),
        .fill = "cells: [3, 3, 3], spread: 50 %, seed: 1",
        .n_threads = 1,
        .gravity = "fracture: {criterion: bond-normal}\nplatens: {axis: z, force: 20 mN, mass: 0.5 kg, ramp: 5 s}\n",
        .stages = "  - name: press\n    solver: {dynamic: {steps: 1200, time_step: {auto: {safety: 0.4}}}}\n"};
    assert_true(state_resumes((state_case){.cells = &pressed}, (int[]){2, 4, 0}) > 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mass_under_a_constant_force_follows_the_parabola),
        cmocka_unit_test(a_force_follows_its_table_and_its_work_is_booked),
        cmocka_unit_test(gravity_rails_and_integrators_go_with_it),
        cmocka_unit_test(a_pressed_column_rests_at_force_over_stiffness),
        cmocka_unit_test(a_force_put_on_at_once_goes_twice_as_far),
        cmocka_unit_test(a_pushed_striker_is_seen_coming),
        cmocka_unit_test(a_run_goes_on_from_its_checkpoint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
