/* The same physics with every instruction set of the cpu. Other devices: test_backend_opencl, test_backend_target. */
#include "backend_cases.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether this machine and this build have the instruction set that BRECCIA_ISA names now. */
static bool has_instruction_set(void)
{
    brc_context *context = brc_context_create();
    brc_device *device = NULL;
    const brc_status status = brc_device_open(context, &(brc_device_request){.selector = "cpu"}, &device);
    if (status != BRC_OK)
        assert_non_null(
            strstr(brc_context_message(context), "is not an instruction set this machine and this build have"));
    brc_device_close(&device);
    brc_context_free(&context);
    return status == BRC_OK;
}

static void lanes_and_instruction_sets_agree(void **state)
{
    (void)state;
    int64_t n = 0;
    double *reference = backend_shaken("cpu", "dlsm", BRC_DOUBLE, true, &n);
    const char *const levels[] = {"generic", "v2", "v3", "v4"};
    int tried = 0;
    for (int k = 0; k < 4; ++k) {
        setenv("BRECCIA_ISA", levels[k], 1);
        if (!has_instruction_set()) continue;
        ++tried;
        double *u = backend_shaken("cpu", "dlsm", BRC_DOUBLE, false, &n), size = 0, off = 0;
        for (int64_t i = 0; i < n; ++i) {
            size = fmax(size, fabs(reference[i]));
            off = fmax(off, fabs(u[i] - reference[i]));
        }
        /* thirty steps of differently contracted sums: 30 times some ten roundings */
        assert_true(off <= 1e-13 * size);
        free(u);
    }
    unsetenv("BRECCIA_ISA");
    assert_true(tried >= 1); /* the baseline at least */
    free(reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lanes_and_instruction_sets_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
