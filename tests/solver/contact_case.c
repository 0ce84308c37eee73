#include "contact_case.h"
#include "../skip.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Displacements, velocities and momenta of turning [9 n]; *rigid: cells without bonds. */
static double *outcome_of(case_options o, int64_t *n, double *rigid)
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
    *rigid = c.simulation->contact->n_rigid;
    double *out = calloc((size_t)(3 * *n), sizeof *out);
    assert_done(&c, brc_simulation_displacement(c.simulation, out));
    assert_done(&c, brc_simulation_velocity(c.simulation, out + *n));
    assert_done(&c, brc_state_from_rows(c.simulation, c.simulation->contact->momentum, out + 2 * *n, 3));
    close_case(&c);
    return out;
}

void contact_compare(case_options a, case_options b)
{
    int64_t n[2];
    double rigid[2];
    double *x = outcome_of(a, &n[0], &rigid[0]), *y = outcome_of(b, &n[1], &rigid[1]);
    assert_true(n[0] == n[1] && rigid[0] == rigid[1] && rigid[0] > 3);
    assert_memory_equal(x, y, (size_t)(3 * n[0]) * sizeof *x);
    free(x), free(y);
}

static const char *other_device;
static void fragments_meet_as_on_the_cpu(void **state)
{
    (void)state;
    contact_compare((case_options){.exact = true}, (case_options){.exact = true, .device = other_device});
}

int contact_device_run(const char *device)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fragments_meet_as_on_the_cpu)};
    other_device = device;
    if (!device_is_there(device)) return test_skip("there is no such device with double precision");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
