/* Contact of cells (model dlsm): a block on a wall against the exact oscillator, fragments that meet, momentum, energy,
 * sliding, rest. Material of E 1 Pa and density 1 kg/m^3; cells of one box have no bond when there is one: rigid
 * bodies. */
#include "contact_case.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A cube of 1 m and 8 cells, far stiffer than its contact with a fixed wall below: K_s = 0.25 N/m for each of the four
 * cells there, whose face of 0.25 m^2 and h = 0.5 m make it k_n A^2 / h^3 = K_s, together a spring of 1 N/m under 1
 * kg. */
static void open_block(bench_case *c, const char *contact, const char *young, const char *gravity, const char *height,
                       const char *stage)
{
    static char keys[1024], material[200];
    snprintf(keys, sizeof keys,
             "interactions: {contact: {stiffness: 0.25 N/m%s}}\nstrikers:\n  floor: {plane: {point: [0, 0, %s], "
             "normal: [0, 0, 1]}, material: stone}\n",
             contact, height);
    snprintf(material, sizeof material, "  stone: {E: %s, nu: 0.2, density: 1 kg/m^3}", young);
    open_case(c, (case_options){.fill = "cells: [2, 2, 2], spread: 0",
                                .materials = material,
                                .sets = keys,
                                .gravity = gravity,
                                .stages = stage,
                                .n_threads = 1});
    begin_first(c);
}

/* Depth, time in contact and speed after it: half a period of pi s of an oscillator of 1 kg on 1 N/m, v sqrt(m / K)
 * deep. The block's own spring, E A / L = 1e4 N/m, adds some 1e-4 to the time and to what stays in vibration; the
 * scheme 1e-6. With damping b of critical for the mass of one cell, an eighth of the block where it carries a quarter:
 * b / sqrt(2). */
static void a_block_bounces_off_a_wall_as_off_a_spring(void **state)
{
    (void)state;
    static const char *const laws[2] = {"", ", damping: 20 %"};
    const double b = 0.2 / sqrt(2), s = sqrt(1 - b * b), wanted[2] = {1, exp(-b * atan2(2 * b * s, 2 * b * b - 1) / s)};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        double u[24], v[24], deepest = 0, speed = 0;
        int64_t touching = 0;
        open_block(&c, laws[k], "10 kPa", "", "-1 mm",
                   "  - name: fall\n    solver: {dynamic: {steps: 10000, time_step: 1.57079632679 ms}}\n    initial:\n "
                   "     - velocity: {velocity: [0, 0, -0.01 m/s]}\n");
        for (int step = 0; step < 3000; ++step) {
            run_steps(&c, 1);
            assert_done(&c, brc_simulation_displacement(c.simulation, u));
            double mean = 0;
            for (int e = 0; e < 8; ++e)
                mean += u[3 * e + 2] / 8;
            deepest = fmax(deepest, -1e-3 - mean);
            touching += mean < -1e-3;
        }
        assert_done(&c, brc_simulation_velocity(c.simulation, v));
        for (int e = 0; e < 8; ++e)
            speed += v[3 * e + 2] / 8;
        const brc_ledger ledger = ledger_now(&c);
        if (k == 0) assert_true(fabs(deepest / 0.01 - 1) < 1e-3 && llabs(touching - 2000) <= 4);
        assert_true(fabs(speed / 0.01 - wanted[k]) < (k ? 5e-3 : 1e-3));
        assert_true(fabs(ledger.closure) < (k ? 5e-3 : 1e-4));
        assert_true(ledger.contact == 0);
        close_case(&c);
    }
}

/* A block on a plane at an angle whose tangent is 1 % below the friction comes to rest, one 1 % above keeps going. Drag
 * of c = 0.5 /s lets it settle; the excess of 0.4 % of g = 1 mm/s^2 then moves it at 0.004 g / c = 8e-6 m/s along the
 * slope, to the same order as its cosine. */
static void sliding_starts_where_the_slope_is_the_friction(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        double v[24], speed = 0;
        char gravity[120];
        const double slope = 0.4 * (k ? 1.01 : 0.99), g = 1e-3, cosine = 1 / sqrt(1 + slope * slope);
        snprintf(gravity, sizeof gravity, "gravity: [%.17g m/s^2, 0, %.17g m/s^2]\n", g * slope * cosine, -g * cosine);
        open_block(&c, ", friction: 0.4, damping: 50 %", "1 kPa", gravity, "0",
                   "  - name: rest\n    solver: {dynamic: {steps: 20000, time_step: 5 ms, mass_damping: 0.5 1/s}}\n");
        run_steps(&c, 12000);
        assert_done(&c, brc_simulation_velocity(c.simulation, v));
        for (int e = 0; e < 8; ++e)
            speed += v[3 * e] / 8;
        const double excess = g * cosine * (slope - 0.4) / 0.5;
        if (k)
            assert_true(fabs(speed / excess - 1) < 0.05);
        else
            assert_true(fabs(speed) < 1e-3 * g * cosine * 0.004 / 0.5);
        close_case(&c);
    }
}

/* Sum of momentum and of its moment about the origin, spins of rigid cells included. */
static void momenta(bench_case *c, double out[6])
{
    const int64_t n = c->domain->n_elements;
    double *u = calloc((size_t)(9 * n), sizeof *u), *v = u + 3 * n, *l = v + 3 * n;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    assert_done(c, brc_contact_momenta(c->simulation, l));
    for (int k = 0; k < 6; ++k)
        out[k] = 0;
    for (int64_t e = 0; e < n; ++e)
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const double *x = c->domain->position + 3 * e, m = c->domain->volume[e];
            out[k] += m * v[3 * e + k];
            out[3 + k] +=
                m * ((x[a] + u[3 * e + a]) * v[3 * e + b] - (x[b] + u[3 * e + b]) * v[3 * e + a]) + l[3 * e + k];
        }
    free(u);
}

/* Momentum m v of 1 kg at some 1e-3 m/s, summed over 216 cells in 1200 steps: rounding of 1e-16 each, 1e-12 in all with
 * room for the moments' arms. */
static void fragments_that_meet_keep_momentum_and_energy(void **state)
{
    (void)state;
    bench_case c;
    double before[6], after[6];
    open_case(
        &c, (case_options){
                .stages = CONTACT_CRUSH, .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CONTACT_KEYS, .n_threads = 1});
    begin_first(&c);
    momenta(&c, before);
    run_steps(&c, 1500);
    momenta(&c, after);
    const brc_ledger ledger = ledger_now(&c);
    int64_t broken;
    assert_done(&c, brc_simulation_broken(c.simulation, &broken));
    print_message("%lld broken, %g rigid, friction %.3g, impact %.3g, contact %.3g, fracture %.3g of %.3g J; closure "
                  "%.3g; momenta %.2g %.2g %.2g %.2g %.2g %.2g\n",
                  (long long)broken, brc_simulation_contact_report(c.simulation).n_rigid, ledger.friction,
                  ledger.impact, ledger.contact, ledger.fracture, ledger.initial, ledger.closure, after[0] - before[0],
                  after[1] - before[1], after[2] - before[2], after[3] - before[3], after[4] - before[4],
                  after[5] - before[5]);
    assert_true(broken > 100 && brc_simulation_contact_report(c.simulation).n_rigid > 5 && ledger.friction > 0 &&
                ledger.impact > 0);
    for (int k = 0; k < 6; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-12 * 1e-3);
    assert_true(fabs(ledger.closure) < 0.02);
    close_case(&c);
}

/* A cube thrown on the floor so hard that most of it comes off, with friction and restitution: what contact takes is
 * what is lost. A break moves surfaces where nothing moves, since the gradients of its cells jump; as a motion that
 * would be work of dashpots and friction, the more of it the finer the step. Bound: that of complete fracture, 5 % of
 * the peak of the elastic energy at 0.8 of the critical step, and the part of it that second order leaves at half the
 * step. */
static void surfaces_that_a_break_moves_rub_nothing(void **state)
{
    (void)state;
    static const double bound[2] = {0.05, 0.0125};
    for (int half = 0; half < 2; ++half) {
        bench_case c;
        char stage[300];
        snprintf(stage, sizeof stage,
                 "  - name: hit\n    solver: {dynamic: {duration: 8 s, time_step: {auto: {safety: %g}}}}\n    "
                 "initial:\n      - velocity: {velocity: [0, 0, -7e-3 m/s]}\n",
                 half ? 0.4 : 0.8);
        open_case(
            &c,
            (case_options){
                .stages = stage,
                .materials = CELLS_STRENGTH("8e-4 Pa"),
                .n_threads = 1,
                .shape = "{sphere: {centre: [0, 0, 0.5 m], radius: 0.5 m}}",
                .fill = "elements: 400, spread: 90 %, lloyd: 3, seed: 1",
                .sets =
                    "fracture: {criterion: bond-normal}\ninteractions: {contact: {friction: 0.3, restitution: 0.5}}\n"
                    "strikers:\n  floor: {plane: {point: [0, 0, -1 mm], normal: [0, 0, 1]}, material: stone}\n"});
        assert_done(&c, brc_simulation_run(c.simulation));
        const brc_ledger l = ledger_now(&c);
        const double lacks = l.total - l.initial + l.friction + l.impact + l.fracture + l.numerical;
        print_message("%lld broken, %g rigid, friction %.3g, impact %.3g, fracture %.3g of %.3g J: %.2g of the peak "
                      "elastic energy\n",
                      (long long)count_broken(&c), brc_simulation_contact_report(c.simulation).n_rigid, l.friction,
                      l.impact, l.fracture, l.initial, lacks / l.peak_elastic);
        assert_true(count_broken(&c) > 300 && brc_simulation_contact_report(c.simulation).n_rigid > 20);
        assert_true(fabs(lacks) < bound[half] * l.peak_elastic);
        close_case(&c);
    }
}

/* With `rotation: false` cells that came off keep the orientation they came off with: no spin, none of its energy.
 * Without it they turn, and the motion is another one. */
static void cells_that_came_off_turn_unless_switched_off(void **state)
{
    (void)state;
    double *place[2], energy[2], moved[2] = {0};
    int64_t n = 0;
    for (int off = 0; off < 2; ++off) {
        bench_case c;
        open_case(&c, (case_options){.stages = CONTACT_CRUSH,
                                     .materials = CELLS_STRENGTH("2e-4 Pa"),
                                     .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                                     .n_threads = 1,
                                     .sets = off ? "fracture: {criterion: bond-normal}\ninteractions: {contact: "
                                                   "{friction: 0.3, restitution: 0.7, rotation: false}}\n"
                                                 : CONTACT_KEYS});
        begin_first(&c);
        run_steps(&c, 400);
        n = c.domain->n_elements;
        place[off] = calloc((size_t)(3 * n), sizeof **place);
        assert_true(brc_simulation_contact_report(c.simulation).n_rigid > 5);
        assert_done(&c, brc_simulation_displacement(c.simulation, place[off]));
        assert_done(&c, brc_contact_spin_energy(c.simulation, &energy[off]));
        for (int64_t k = 0; k < 3 * n; ++k)
            moved[off] = fmax(moved[off], fabs(place[off][k]));
        close_case(&c);
    }
    double apart = 0;
    for (int64_t k = 0; k < 3 * n; ++k)
        apart = fmax(apart, fabs(place[0][k] - place[1][k]));
    assert_true(energy[0] > 0 && energy[1] == 0);
    assert_true(apart > 1e-3 * moved[0]); /* far beyond rounding, 1e-12 after these steps */
    free(place[0]), free(place[1]);
}

/* Forces are minus the gradient of all energies where fragments overlap, rigid cells among them. */
static void forces_are_the_gradient_of_the_energy_with_touching_fragments(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.stages = CELLS_BURST(1000),
                                 .materials = CELLS_STRENGTH("5e-4 Pa"),
                                 .sets = "fracture: {criterion: bond-normal}\ninteractions: {contact: {}}\n",
                                 .n_threads = 1});
    begin_first(&c);
    run_steps(&c, 400);
    const int64_t n = 3 * c.domain->n_elements;
    double *u = calloc((size_t)(3 * n), sizeof *u), *f = u + n, *moved = f + n, along = 0, energy[2];
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    for (int64_t k = 0; k < n; ++k)
        u[k] += 2e-3 * random_at((uint64_t)k); /* press some together */
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    const brc_ledger at = ledger_now(&c);
    assert_true(at.contact > 0 && brc_simulation_contact_report(c.simulation).n_rigid > 0);
    for (int64_t k = 0; k < n; ++k)
        along += f[k] * random_at((uint64_t)(n + k));
    for (int side = 0; side < 2; ++side) {
        for (int64_t k = 0; k < n; ++k)
            moved[k] = u[k] + (side ? 1e-7 : -1e-7) * random_at((uint64_t)(n + k));
        assert_done(&c, brc_simulation_set_state(c.simulation, moved, NULL));
        const brc_ledger now = ledger_now(&c);
        energy[side] = now.elastic + now.stabilisation + now.contact;
    }
    const double slope = (energy[1] - energy[0]) / 2e-7;
    assert_true(fabs(slope + along) < 1e-6 * fabs(along));
    free(u);
    close_case(&c);
}

/* A cube torn to dust while a load acts on its side x-. What held faces and tractions do to a cell goes by its H, which
 * is 0 of cells without bonds, so that such cells do not turn: forces are minus the gradient of all energies
 * (differences to 1e-6), and the ledger closes as in fragments_that_meet_keep_momentum_and_energy. Where half of the
 * elements turn, and not half of the rows, which are padded, the passes go over the others alone: so this does not
 * depend on the layout. */
static void dust_with_loaded_faces_does_not_turn(void **state)
{
    (void)state;
    static const char *const load[2] = {"face_displacement: {set: x-, x: 0, y: 0, z: 0}",
                                        "traction: {set: x-, x: 1e-3 Pa, y: 1e-3 Pa}"};
    for (int kind = 0; kind < 2; ++kind) {
        bench_case c;
        char stages[500];
        snprintf(stages, sizeof stages, "%s    loads:\n      - %s\n", CONTACT_CRUSH, load[kind]);
        open_case(&c, (case_options){.fill = "cells: [4, 4, 4], spread: 90 %, seed: 1",
                                     .materials = CELLS_STRENGTH("2e-4 Pa"),
                                     .n_threads = 1,
                                     .stages = stages,
                                     .sets = "fracture: {criterion: bond-normal}\ninteractions: {contact: {}}\n"});
        begin_first(&c);
        const int64_t n = 3 * c.domain->n_elements;
        for (int k = 0; k < 1500; ++k) {
            run_steps(&c, 1);
            assert_true(!brc_contact_bonded(c.simulation) ==
                        !(2 * brc_simulation_contact_report(c.simulation).n_rigid > (double)c.domain->n_elements));
        }
        double *u = calloc((size_t)(3 * n), sizeof *u), *f = u + n, *moved = f + n, along = 0, energy[2];
        const double closure = ledger_now(&c).closure, rigid = brc_simulation_contact_report(c.simulation).n_rigid;
        assert_done(&c, brc_simulation_displacement(c.simulation, u));
        assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
        assert_done(&c, brc_simulation_force(c.simulation, f));
        for (int64_t k = 0; k < n; ++k)
            along += f[k] * random_at((uint64_t)(n + k));
        for (int side = 0; side < 2; ++side) {
            for (int64_t k = 0; k < n; ++k)
                moved[k] = u[k] + (side ? 1e-7 : -1e-7) * random_at((uint64_t)(n + k));
            assert_done(&c, brc_simulation_set_state(c.simulation, moved, NULL));
            const brc_ledger now = ledger_now(&c);
            energy[side] = now.elastic + now.stabilisation + now.contact;
        }
        const double slope = (energy[1] - energy[0]) / 2e-7;
        print_message("%s: %g of %lld rigid, closure %.3g, slope %.9g and force %.9g\n", load[kind], rigid,
                      (long long)c.domain->n_elements, closure, slope, along);
        assert_true(rigid > 32 && rigid < (double)c.domain->n_elements);
        assert_true(fabs(closure) < 0.02);
        if (kind == 0) assert_true(fabs(slope + along) < 1e-6 * fabs(along));
        free(u);
        close_case(&c);
    }
}

static void threads_change_nothing(void **state)
{
    (void)state;
    contact_compare((case_options){.n_threads = 1}, (case_options){.n_threads = 2});
}

/* Arrays only where they are asked for, and where nothing is near the same motion to the last bit, with equal steps. */
static void what_is_not_asked_for_is_not_there(void **state)
{
    (void)state;
    bench_case plain, with;
    static const char burst[] = "  - name: burst\n    solver: {dynamic: {steps: 50, time_step: 10 ms}}\n    initial:\n "
                                "     - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n";
    open_case(&plain, (case_options){.stages = burst});
    open_case(&with, (case_options){.stages = burst, .sets = "interactions: {contact: {}}\n"});
    assert_true(is_listed(brc_simulation_effects_out(plain.simulation), "contact") &&
                is_listed(brc_simulation_effects_in(with.simulation), "contact"));
    assert_true(brc_device_bytes(plain.device) < brc_device_bytes(with.device) && !plain.simulation->contact);
    const int64_t n = 3 * plain.domain->n_elements;
    double *u = calloc((size_t)(2 * n), sizeof *u);
    begin_first(&plain), begin_first(&with);
    run_steps(&plain, 50), run_steps(&with, 50);
    assert_done(&plain, brc_simulation_displacement(plain.simulation, u));
    assert_done(&with, brc_simulation_displacement(with.simulation, u + n));
    assert_memory_equal(u, u + n, (size_t)n * sizeof *u);
    free(u);
    close_case(&plain), close_case(&with);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_bounces_off_a_wall_as_off_a_spring),
        cmocka_unit_test(sliding_starts_where_the_slope_is_the_friction),
        cmocka_unit_test(fragments_that_meet_keep_momentum_and_energy),
        cmocka_unit_test(surfaces_that_a_break_moves_rub_nothing),
        cmocka_unit_test(cells_that_came_off_turn_unless_switched_off),
        cmocka_unit_test(dust_with_loaded_faces_does_not_turn),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(what_is_not_asked_for_is_not_there),
        cmocka_unit_test(forces_are_the_gradient_of_the_energy_with_touching_fragments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
