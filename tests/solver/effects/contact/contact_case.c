#include "contact_case.h"
#include "../../../../host/solver/effects/contact/touching.h"
#include "../../../skip.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Displacements, velocities and momenta of turning [9 n]; *rigid: cells without bonds; what touches. */
static double *outcome_of(case_options o, int64_t *n, double *rigid, brc_touching *touching)
{
    bench_case c;
    o.fill = "cells: [4, 4, 4], spread: 90 %, seed: 1";
    o.stages = CONTACT_CRUSH;
    o.materials = CELLS_STRENGTH("2e-4 Pa");
    o.sets = CONTACT_KEYS;
    open_case(&c, o);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 400));
    *n = 3 * c.domain->n_elements;
    *rigid = brc_simulation_contact_report(c.simulation).n_rigid;
    double *out = calloc((size_t)(3 * *n), sizeof *out);
    assert_done(&c, brc_simulation_displacement(c.simulation, out));
    assert_done(&c, brc_simulation_velocity(c.simulation, out + *n));
    assert_done(&c, brc_contact_momenta(c.simulation, out + 2 * *n));
    assert_done(&c, brc_simulation_touching(c.simulation, touching));
    close_case(&c);
    return out;
}

void contact_compare(case_options a, case_options b)
{
    int64_t n[2];
    double rigid[2];
    brc_touching touching[2];
    double *x = outcome_of(a, &n[0], &rigid[0], &touching[0]), *y = outcome_of(b, &n[1], &rigid[1], &touching[1]);
    assert_true(n[0] == n[1] && rigid[0] == rigid[1] && rigid[0] > 3);
    assert_memory_equal(x, y, (size_t)(3 * n[0]) * sizeof *x);
    assert_memory_equal(&touching[0], &touching[1], sizeof touching[0]);
    free(x), free(y);
}

void contact_blade(case_options o)
{
    static const struct {
        int64_t steps;
        double depth;
    } at[] = {{1, 0.5e-3}, {2, 1.5e-3}, {41, 40.5e-3}, {81, 80.5e-3}};
    bench_case c;
    int64_t done = 0;
    o.n_threads = 1;
    o.fill = "cells: [4, 4, 4], spread: 50 %, seed: 1";
    o.stages = "  - name: cut\n    solver: {dynamic: {steps: 200, time_step: 10 ms}}\n";
    o.gravity = "interactions: {contact: {}}\nstrikers:\n"
                "  blade: {shape: {box: {size: [0.6 m, 0.6 m, 1 mm], origin: [0.2 m, 0.2 m, 1.0005 m]}}, material: "
                "stone, motion: {driven: {velocity: [0, 0, -0.1 m/s]}}}\n";
    open_case(&c, o);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    for (size_t k = 0; k < sizeof at / sizeof *at; ++k, done = at[k - 1].steps) {
        brc_touching now;
        assert_done(&c, brc_simulation_advance(c.simulation, at[k].steps - done));
        assert_done(&c, brc_simulation_touching(c.simulation, &now));
        if (!(fabs(now.penetration - at[k].depth) < 1e-4))
            fail_msg("%g m deep after %d steps, expected %g m", now.penetration, (int)at[k].steps, at[k].depth);
    }
    close_case(&c);
}

static const char *other_device;
static void fragments_meet_as_on_the_cpu(void **state)
{
    (void)state;
    contact_compare((case_options){.exact = true}, (case_options){.exact = true, .device = other_device});
}

static void a_blade_is_as_deep_as_on_the_cpu(void **state)
{
    (void)state;
    contact_blade((case_options){.device = other_device});
}

int contact_device_run(const char *device)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fragments_meet_as_on_the_cpu),
                                       cmocka_unit_test(a_blade_is_as_deep_as_on_the_cpu)};
    other_device = device;
    if (!device_is_there(device)) return test_skip("there is no such device with double precision");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
