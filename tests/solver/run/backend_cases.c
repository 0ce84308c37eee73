#include "backend_cases.h"
#include "../../skip.h"
#include "../models/cbm/beams_case.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char shaken[] = "  - name: shake\n    solver: {dynamic: {steps: 100, time_step: 10 ms}}\n    loads:\n"
                             "      - %s: {set: left, x: 1 mm/s}\n    initial:\n"
                             "      - random: {amplitude: [1 mm/s, 1 mm/s, 1 mm/s], seed: 3}\n";

double *backend_shaken(const char *device, const char *model, brc_precision precision, bool exact, int64_t *n)
{
    char stages[600];
    const bool published = strcmp(model, "dlsm") != 0;
    snprintf(stages, sizeof stages, shaken, published ? "element_velocity" : "face_velocity");
    bench_case c;
    open_case(&c, (case_options){.device = device,
                                 .model = model,
                                 .precision = precision,
                                 .exact = exact,
                                 .stages = stages,
                                 .sets = published ? "sets:\n  left: {elements: {wall: x-}}\n"
                                                   : "sets:\n  left: {faces: {wall: x-}}\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 30));
    *n = 3 * c.domain->n_elements;
    double *u = calloc((size_t)*n, sizeof *u);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    close_case(&c);
    return u;
}

/* Beams with forces and prescribed rotations, in motion. */
static double *shaken_beams(const char *device, brc_precision precision, bool exact, int64_t *n)
{
    static const char stages[] = "sets:\n  low: {elements: {box: {from: [0, 0, 0], to: [80 cm, 9 m, 9 m]}}}\n  high: "
                                 "{elements: {box: {from: [3.2 m, 0, 0], to: [9 m, 9 m, 9 m]}}}\n"
                                 "stages:\n  - name: shake\n    solver: {dynamic: {steps: 1000}}\n    initial:\n      "
                                 "- random: {amplitude: [10 mm/s, 10 mm/s, 10 mm/s], seed: 3}\n"
                                 "    loads:\n      - element_velocity: {set: low, x: -1 mm/s}\n      - "
                                 "element_rotation: {set: low, y: 0.1 rad, table: [[0, 0], [100 s, 1]]}\n"
                                 "      - element_force: {set: high, z: 1 mN}\n";
    beams_case c;
    open_lattice(
        &c, 4,
        (beams_options){.coordination = 6, .stages = stages, .device = device, .precision = precision, .exact = exact});
    beams_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    beams_done(&c, brc_simulation_advance(c.simulation, 30));
    *n = 7 * c.domain->n_elements;
    double *u = calloc((size_t)*n, sizeof *u);
    beams_done(&c, brc_simulation_displacement(c.simulation, u));
    beams_done(&c, brc_simulation_orientation(c.simulation, u + 3 * c.domain->n_elements, NULL));
    close_beams(&c);
    return u;
}

/* The device the cases run on. */
static const char *device_here;

static void exact_runs_equal_the_cpu_bit_for_bit(void **state)
{
    (void)state;
    static const char *const models[] = {"dlsm", "dlsm-published"};
    for (int m = 0; m < 2; ++m) {
        int64_t n = 0;
        double *ours = backend_shaken("cpu", models[m], BRC_DOUBLE, true, &n);
        double *theirs = backend_shaken(device_here, models[m], BRC_DOUBLE, true, &n);
        assert_memory_equal(ours, theirs, (size_t)n * sizeof *ours);
        free(ours);
        free(theirs);
    }
}

static void exact_beams_equal_the_cpu_bit_for_bit(void **state)
{
    (void)state;
    int64_t n = 0;
    double *ours = shaken_beams("cpu", BRC_DOUBLE, true, &n), *theirs = shaken_beams(device_here, BRC_DOUBLE, true, &n);
    assert_memory_equal(ours, theirs, (size_t)n * sizeof *ours);
    free(ours);
    free(theirs);
}

/* One model: PoCL takes some ten seconds to build each variant. */
static void fused_runs_equal_the_cpu_to_rounding_in_every_precision(void **state)
{
    (void)state;
    for (int p = 0; p < 3; ++p) {
        int64_t n = 0;
        double *ours = backend_shaken("cpu", "dlsm", (brc_precision)p, false, &n);
        double *theirs = backend_shaken(device_here, "dlsm", (brc_precision)p, false, &n);
        double size = 0, off = 0;
        for (int64_t i = 0; i < n; ++i) {
            size = fmax(size, fabs(ours[i]));
            off = fmax(off, fabs(ours[i] - theirs[i]));
        }
        /* thirty steps of differently contracted sums: 30 times some ten roundings of the coefficients' type */
        const double bound = p == 0 ? 1e-13 : 1e-4;
        if (!(off <= bound * size)) fail_msg("%s precision %d: %g of %g", device_here, p, off, size);
        free(ours);
        free(theirs);
    }
}

int backend_cases_run(const char *device)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_runs_equal_the_cpu_bit_for_bit),
        cmocka_unit_test(exact_beams_equal_the_cpu_bit_for_bit),
        cmocka_unit_test(fused_runs_equal_the_cpu_to_rounding_in_every_precision),
    };
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    char why[400];
    bool usable = false;
    if (!context || brc_device_list_create(context, &list) != BRC_OK) {
        fprintf(stderr, "no device list: %s\n", context ? brc_context_message(context) : "no memory");
        brc_context_free(&context);
        return 1;
    }
    snprintf(why, sizeof why, "there is no device %s", device);
    for (int d = 0; d < list->n; ++d) {
        if (strcmp(list->items[d].selector, device) != 0) continue;
        usable = list->items[d].usable;
        snprintf(why, sizeof why, "device %s: %s", device, list->items[d].why_not);
    }
    brc_device_list_free(&list);
    brc_context_free(&context);
    if (!usable) return test_skip(why);
    device_here = device;
    return cmocka_run_group_tests_name(device, tests, NULL, NULL);
}
