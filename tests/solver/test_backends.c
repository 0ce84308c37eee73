/* The same physics on every device: bit for bit in double without contraction, to rounding with it. */
#include "support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const shaken = "  - name: shake\n    solver: {dynamic: {steps: 100, time_step: 10 ms}}\n    loads:\n"
                                  "      - %s: {set: left, x: 1 mm/s}\n    initial:\n"
                                  "      - random: {amplitude: [1 mm/s, 1 mm/s, 1 mm/s], seed: 3}\n";

/* Displacements after `steps` steps [3 n], or NULL with a visible message when the device is not there. */
static double *run(const char *device, const char *model, brc_precision precision, bool exact, int64_t *n)
{
    char stages[600];
    const bool published = strcmp(model, "dlsm") != 0;
    snprintf(stages, sizeof stages, shaken, published ? "element_velocity" : "face_velocity");
    bench_case c;
    const brc_status status = try_case(
        &c, (case_options){.device = device, .model = model, .precision = precision, .exact = exact, .stages = stages,
                           .sets = published ? "sets:\n  left: {elements: {wall: x-}}\n" : "sets:\n  left: {faces: {wall: x-}}\n"});
    if (status == BRC_BAD_INPUT && strcmp(device, "cpu") != 0 && !c.device) {
        print_message("SKIPPED, no device %s: %s\n", device, brc_context_message(c.context));
        close_case(&c);
        return NULL;
    }
    assert_done(&c, status);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 30));
    *n = 3 * c.domain->n_elements;
    double *u = calloc((size_t)*n, sizeof *u);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    close_case(&c);
    return u;
}

static const char *const models[] = {"dlsm", "dlsm-published"};

static void compare(const char *device)
{
    for (int m = 0; m < 2; ++m) {
        int64_t n = 0;
        double *ours = run("cpu", models[m], BRC_DOUBLE, true, &n), *theirs = run(device, models[m], BRC_DOUBLE, true, &n);
        if (theirs) assert_memory_equal(ours, theirs, (size_t)n * sizeof *ours);
        for (int p = 0; theirs && m == 0 && p < 3; ++p) { /* one model: PoCL takes some ten seconds to build each variant */
            double *a = run("cpu", models[m], (brc_precision)p, false, &n), *b = run(device, models[m], (brc_precision)p, false, &n);
            double size = 0, off = 0;
            for (int64_t i = 0; i < n; ++i) {
                size = fmax(size, fabs(a[i]));
                off = fmax(off, fabs(a[i] - b[i]));
            }
            /* thirty steps of differently contracted sums: 30 times some ten roundings of the coefficients' type */
            const double bound = p == 0 ? 1e-13 : 1e-4;
            if (!(off <= bound * size)) fail_msg("%s %s precision %d: %g of %g", device, models[m], p, off, size);
            free(a);
            free(b);
        }
        free(ours);
        free(theirs);
    }
}

static void opencl_equals_cpu(void **state)
{
    (void)state;
    compare("opencl:0");
}

static void target_equals_cpu(void **state)
{
    (void)state;
    compare("target:0");
}

static void lanes_and_instruction_sets_agree(void **state)
{
    (void)state;
    int64_t n = 0;
    double *reference = run("cpu", "dlsm", BRC_DOUBLE, true, &n);
    const char *const levels[] = {"v2", "v3", "v4"};
    for (int k = 0; k < 3; ++k) {
        setenv("BRECCIA_ISA", levels[k], 1);
        double *u = run("cpu", "dlsm", BRC_DOUBLE, false, &n), size = 0, off = 0;
        for (int64_t i = 0; i < n; ++i) {
            size = fmax(size, fabs(reference[i]));
            off = fmax(off, fabs(u[i] - reference[i]));
        }
        assert_true(off <= 1e-13 * size); /* as above */
        free(u);
    }
    unsetenv("BRECCIA_ISA");
    free(reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opencl_equals_cpu),
        cmocka_unit_test(target_equals_cpu),
        cmocka_unit_test(lanes_and_instruction_sets_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
