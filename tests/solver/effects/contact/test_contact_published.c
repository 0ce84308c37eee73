/* Contact of cells of dlsm-published: polyhedra that turn with their own rotations. E 1 Pa, density 1 kg/m^3. */
#include "contact_case.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Momentum and its moment about the origin, of cells' turning too; *most: sums of magnitudes. */
static void momenta(bench_case *c, double out[6], double most[2])
{
    const int64_t n = c->domain->n_elements;
    double *u = calloc((size_t)(14 * n), sizeof *u), *v = u + 3 * n, *q = v + 3 * n, *w = q + 4 * n,
           *inertia = w + 3 * n;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    assert_done(c, brc_simulation_orientation(c->simulation, q, w));
    assert_done(c, brc_state_from_rows(c->simulation, brc_inertia_of(c->simulation), inertia, 1));
    memset(out, 0, 6 * sizeof *out);
    most[0] = most[1] = 0;
    for (int64_t e = 0; e < n; ++e) {
        const double m = c->domain->volume[e], *p = v + 3 * e;
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = c->domain->position[3 * e + k] + u[3 * e + k];
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            out[k] += m * p[k];
            out[3 + k] += m * (x[a] * p[b] - x[b] * p[a]) + inertia[e] * w[3 * e + k];
            most[0] += fabs(m * p[k]);
            most[1] += fabs(m * x[a] * p[b]) + fabs(m * x[b] * p[a]);
        }
    }
    free(u);
}

/* A cube that bursts into pieces which meet again, with friction and damping: nothing acts from outside. Rounding of
 * 600 steps of sums over 64 cells with 1000 bonds and pairs: 1e-16 of their magnitudes times the root of 6e5. */
static void keep_momenta(const char *model)
{
    bench_case c;
    double before[6], after[6], most[2];
    open_case(&c, (case_options){.model = model,
                                 .fill = "cells: [4, 4, 4], spread: 90 %, seed: 1",
                                 .stages = CONTACT_CRUSH,
                                 .materials = CELLS_STRENGTH("2e-4 Pa"),
                                 .sets = CONTACT_KEYS,
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    momenta(&c, before, most);
    double lost = 0, touched = 0;
    for (int k = 0; k < 6; ++k) {
        brc_ledger ledger;
        assert_done(&c, brc_simulation_advance(c.simulation, 100));
        assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
        touched = fmax(touched, ledger.contact);
        lost = ledger.friction;
    }
    momenta(&c, after, most);
    double off[2] = {0, 0};
    for (int k = 0; k < 6; ++k)
        off[k / 3] = fmax(off[k / 3], fabs(after[k] - before[k]));
    print_message(
        "momentum off by %.3g of %.3g, its moment by %.3g of %.3g; contact held %.3g J at most, friction took %.3g J\n",
        off[0], most[0], off[1], most[1], touched, lost);
    assert_true(touched > 0 && lost > 0);
    assert_true(off[0] < 1e-13 * most[0]);
    assert_true(off[1] < 1e-13 * most[1]);
    close_case(&c);
}
static void momentum_and_its_moment_stay(void **state)
{
    (void)state;
    keep_momenta("dlsm-published");
    keep_momenta("{dlsm-published: {couple_modulus: 0.5}}");
}

/* A cube of 1 m and 8 cells, far stiffer than its contact with a wall: K_s = 0.25 N/m for each of the four cells there
 * makes a spring of 1 N/m under 1 kg: half a period of pi s, v sqrt(m / K) deep, and off as fast as it came. The
 * block's own spring, E A / L = 1e4 N/m, takes 1e-4; the integrator damps by (phi - 1) omega dt / 2 = 8e-5 of
 * critical, 2.5e-4 of the speed. */
static void a_block_bounces_off_a_wall_as_off_a_spring(void **state)
{
    (void)state;
    bench_case c;
    double u[24], v[24], deepest = 0, speed = 0;
    int64_t touching = 0;
    open_case(&c,
              (case_options){.model = "dlsm-published",
                             .fill = "cells: [2, 2, 2], spread: 0",
                             .materials = "  stone: {E: 10 kPa, nu: 0.2, density: 1 kg/m^3}",
                             .sets = "interactions: {contact: {stiffness: 0.25 N/m}}\nstrikers:\n  floor: {plane: "
                                     "{point: [0, 0, -1 mm], normal: [0, 0, 1]}, material: stone}\n",
                             .stages = "  - name: fall\n    solver: {dynamic: {steps: 10000, time_step: 1.57079632679 "
                                       "ms, integrator: {tchamwa-wielgosz: {phi: 1.1}}}}\n    initial:\n"
                                       "      - velocity: {velocity: [0, 0, -0.01 m/s]}\n",
                             .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    for (int step = 0; step < 3000; ++step) {
        double mean = 0;
        assert_done(&c, brc_simulation_advance(c.simulation, 1));
        assert_done(&c, brc_simulation_displacement(c.simulation, u));
        for (int e = 0; e < 8; ++e)
            mean += u[3 * e + 2] / 8;
        deepest = fmax(deepest, -1e-3 - mean);
        touching += mean < -1e-3;
    }
    assert_done(&c, brc_simulation_velocity(c.simulation, v));
    for (int e = 0; e < 8; ++e)
        speed += v[3 * e + 2] / 8;
    print_message("depth %.6f, time %lld steps, speed after %.6f\n", deepest / 0.01, (long long)touching, speed / 0.01);
    assert_true(fabs(deepest / 0.01 - 1) < 1e-3 && llabs(touching - 2000) <= 4 && fabs(speed / 0.01 - 1) < 1e-3);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_and_its_moment_stay),
        cmocka_unit_test(a_block_bounces_off_a_wall_as_off_a_spring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
