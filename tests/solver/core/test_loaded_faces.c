/* Loads per area on a part of a wall: the total is that of the region asked for, not of the faces whose middle lies in
 * it. */
#include "../support.h"
#include "../../../host/base/memory.h"
#include "../../../host/solver/core/loaded_faces.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char strip[] =
    "sets:\n  strip: {faces: {wall: z+, box: {from: [31 cm, 0, 50 cm], to: [63 cm, 1 m, 2 m]}}}\n";

/* Work on a linear displacement is exact in `dlsm`, whatever the cells: forces on cells at X add up to the load and to
 * its moment. Corners of cells are good to 1e-11. */
static void force_and_moment_of_a_pressed_strip_are_those_of_its_area(const char *load, const double total[3])
{
    bench_case c;
    char stages[256];
    snprintf(stages, sizeof stages,
             "  - name: push\n    solver: {dynamic: {steps: 1, time_step: {fixed: 1e-6 s}}}\n    loads:\n      - %s\n",
             load);
    open_case(&c, (case_options){.fill = "cells: [5, 4, 4], spread: 90 %", .sets = strip, .stages = stages});
    const brc_domain *d = c.domain;
    double *force = calloc((size_t)(3 * d->n_elements), sizeof *force), sum[3] = {0}, moment[3] = {0};
    begin_first(&c);
    assert_done(&c, brc_simulation_force(c.simulation, force));
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int k = 0; k < 3; ++k) {
            sum[k] += force[3 * e + k];
            moment[k] += force[3 * e + k] * d->position[3 * e];
        }
    for (int k = 0; k < 3; ++k) {
        if (!(fabs(sum[k] - total[k]) < 1e-10)) fail_msg("force %d: %.12g, expected %.12g", k, sum[k], total[k]);
        if (!(fabs(moment[k] - 0.47 * total[k]) < 1e-10))
            fail_msg("moment %d: %.12g, expected %.12g", k, moment[k], 0.47 * total[k]);
    }
    free(force);
    close_case(&c);
}

static void pressure_on_a_strip_is_that_of_its_area(void **state)
{
    (void)state;
    force_and_moment_of_a_pressed_strip_are_those_of_its_area("pressure: {set: strip, value: 2 Pa}",
                                                              (double[3]){0, 0, -0.64});
}

static void traction_on_a_strip_is_that_of_its_area(void **state)
{
    (void)state;
    force_and_moment_of_a_pressed_strip_are_those_of_its_area("traction: {set: strip, x: 1 Pa, y: -2 Pa, z: 3 Pa}",
                                                              (double[3]){0.32, -0.64, 0.96});
}

static void a_wall_is_loaded_whole_and_a_strip_beyond_its_members(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [5, 4, 4], spread: 90 %", .sets = strip});
    const brc_domain *d = c.domain;
    const brc_set *wall = d->sets + brc_domain_find_set(d, "z+"), *set = d->sets + brc_domain_find_set(d, "strip");
    brc_loaded_face *out = NULL;
    int64_t n = 0;
    assert_done(&c, brc_loaded_faces(c.context, c.scene, d, wall, &out, &n));
    assert_int_equal(n, wall->n_members);
    for (int64_t k = 0; k < n; ++k) {
        assert_int_equal(out[k].face, wall->members[k]);
        assert_memory_equal(out[k].area, d->free_area_vector + 3 * (int64_t)out[k].face, sizeof out[k].area);
        assert_memory_equal(out[k].centroid, d->free_centroid + 3 * (int64_t)out[k].face, sizeof out[k].centroid);
    }
    brc_memory_free(out);
    assert_done(&c, brc_loaded_faces(c.context, c.scene, d, set, &out, &n));
    assert_true(n > set->n_members); /* faces with their middle outside are loaded too, as far as they reach in */
    brc_memory_free(out);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_on_a_strip_is_that_of_its_area),
        cmocka_unit_test(traction_on_a_strip_is_that_of_its_area),
        cmocka_unit_test(a_wall_is_loaded_whole_and_a_strip_beyond_its_members),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
