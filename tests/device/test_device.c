/* Choosing and opening a device: selectors, refusals and their sentences, instruction sets. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "device_cases.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void a_selector_of_another_form_is_refused(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    static const char *const selectors[] = {"",
                                            "gpu",
                                            "cpu:0",
                                            "opencl",
                                            "opencl:",
                                            "opencl:x",
                                            "opencl:1x",
                                            "opencl:-1",
                                            "target:+1",
                                            "CPU",
                                            "opencl:0000000000000001"};
    for (size_t k = 0; k < sizeof selectors / sizeof selectors[0]; ++k) {
        const brc_device_request request = {.selector = selectors[k]};
        assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
        char expected[160];
        snprintf(
            expected, sizeof expected,
            "device '%s' is not a selector: expected auto, cpu, opencl:N, opencl:auto or target:N; usable here: cpu",
            selectors[k]);
        device_cases_says(context, expected);
    }
    brc_context_free(&context);
}

static void a_device_that_is_not_there_is_refused_with_those_that_are(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    const brc_device_request request = {.selector = "opencl:77"};
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "device 'opencl:77' is not there; usable here: cpu");
    brc_context_free(&context);
}

static void requests_the_cpu_cannot_meet_are_refused(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device_request request = {.selector = "cpu", .n_threads = -1};
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "-1 threads: expected 1 to 4096");
    request = (brc_device_request){.selector = "cpu", .lanes = 3};
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "elements at once, not 3");
    request = (brc_device_request){.selector = "cpu", .kernel_folder = "kernels"};
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "needs an OpenCL device");
    brc_context_free(&context);
}

/* A short computation of n numbers, each of which takes in another one in every round. */
static void sums(brc_context *context, brc_precision precision, bool exact, double *result, int n)
{
    brc_device *device = NULL;
    brc_buffer *x = NULL, *y = NULL;
    brc_kernel *axpy = NULL;
    double *const wide = calloc((size_t)n, sizeof *wide);
    float *const narrow = calloc((size_t)n, sizeof *narrow);
    const int64_t each = brc_precision_state_bytes(precision), size = n * each;
    char *const own = calloc((size_t)n, (size_t)each), *const other = calloc((size_t)n, (size_t)each);
    assert_true(wide && narrow && own && other);
    for (int i = 0; i < n; ++i) {
        narrow[i] = 0.37f * (float)i - 1;
        wide[i] = narrow[i];
    }
    const brc_device_request request = {.selector = "cpu", .precision = precision, .exact = exact};
    assert_int_equal(brc_device_open(context, &request, &device), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &x, size, "x"), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &y, size, "y"), BRC_OK);
    assert_int_equal(brc_buffer_write(x, 0, precision == BRC_SINGLE ? (void *)narrow : wide, size), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_axpy", &axpy), BRC_OK);
    for (int round = 0; round < 10; ++round) {
        assert_int_equal(brc_buffer_read(x, 0, own, size), BRC_OK);
        for (int i = 0; i < n; ++i)
            memcpy(other + i * each, own + (int64_t)i * 611 % n * each, (size_t)each);
        assert_int_equal(brc_buffer_write(y, 0, other, size), BRC_OK);
        assert_int_equal(BRC_LAUNCH(axpy, n, BRC_INT(n), BRC_STATE(1.0 / 3), BRC_BUF(y), BRC_BUF(x)), BRC_OK);
    }
    assert_int_equal(brc_buffer_read(x, 0, precision == BRC_SINGLE ? (void *)narrow : wide, size), BRC_OK);
    for (int i = 0; i < n; ++i)
        result[i] = precision == BRC_SINGLE ? (double)narrow[i] : wide[i];
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    brc_device_close(&device);
    free(wide);
    free(narrow);
    free(own);
    free(other);
}

static void instruction_sets_differ_by_rounding_alone_and_not_at_all_where_exact(void **unused)
{
    (void)unused;
    enum { N = 1003 };
    static const brc_precision precisions[] = {BRC_DOUBLE, BRC_MIXED, BRC_SINGLE};
    static double first[N], got[N];
    brc_context *context = brc_context_create();
    int tried = 0;
    for (size_t p = 0; p < 3; ++p) {
        const double epsilon = precisions[p] == BRC_SINGLE ? 1.2e-7 : 2.3e-16;
        assert_int_equal(unsetenv("BRECCIA_ISA"), 0);
        sums(context, precisions[p], true, first, N);
        static const char *const levels[] = {"generic", "v2", "v3", "v4"};
        for (size_t k = 0; k < 4; ++k) {
            assert_int_equal(setenv("BRECCIA_ISA", levels[k], 1), 0);
            const brc_device_request request = {.selector = "cpu", .precision = precisions[p]};
            if (device_cases_open(context, &request) != BRC_OK) {
                device_cases_says(context, "is not an instruction set this machine and this build have");
                continue;
            }
            sums(context, precisions[p], true, got, N);
            assert_memory_equal(first, got, sizeof got);
            /* ten sums of positive weights: at most ten roundings of numbers below 371 (4/3)^10 < 6600 */
            sums(context, precisions[p], false, got, N);
            for (int i = 0; i < N; ++i)
                assert_true(got[i] - first[i] <= 66000 * epsilon && first[i] - got[i] <= 66000 * epsilon);
            ++tried;
        }
    }
    assert_int_equal(unsetenv("BRECCIA_ISA"), 0);
    assert_true(tried >= 3); /* one level at least in each precision */
    brc_context_free(&context);
}

#if defined(__x86_64__) /* where the float mode is set */
static void the_cpu_kernels_take_denormal_numbers_for_zero_and_the_caller_keeps_them(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device *device = NULL;
    brc_buffer *x = NULL, *y = NULL;
    brc_kernel *copy = NULL, *axpy = NULL;
    enum { N = 4096 }; /* work for both threads */
    static float tiny[N], got[N];
    for (int i = 0; i < N; ++i)
        tiny[i] = 1e-40f;
    const brc_device_request request = {.selector = "cpu", .precision = BRC_SINGLE, .n_threads = 2};
    assert_int_equal(brc_device_open(context, &request, &device), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &x, sizeof tiny, "x"), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &y, sizeof tiny, "y"), BRC_OK);
    assert_int_equal(brc_buffer_write(x, 0, tiny, sizeof tiny), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_copy", &copy), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_axpy", &axpy), BRC_OK);
    assert_int_equal(BRC_LAUNCH(axpy, N, BRC_INT(N), BRC_STATE(1), BRC_BUF(x), BRC_BUF(y)), BRC_OK);
    assert_int_equal(brc_buffer_read(y, 0, got, sizeof got), BRC_OK);
    for (int i = 0; i < N; ++i)
        assert_true(got[i] == 0);
    assert_int_equal(BRC_LAUNCH(copy, N, BRC_INT(N), BRC_BUF(x), BRC_BUF(y)), BRC_OK);
    assert_int_equal(brc_buffer_read(y, 0, got, sizeof got), BRC_OK);
    assert_memory_equal(got, tiny, sizeof tiny); /* copying is no arithmetic */
    volatile float half_of_tiny = tiny[0];
    half_of_tiny = half_of_tiny / 2;
    assert_true(half_of_tiny > 0);
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    brc_device_close(&device);
    brc_context_free(&context);
}
#endif

static void a_word_that_is_no_instruction_set_is_refused(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    assert_int_equal(setenv("BRECCIA_ISA", "v9", 1), 0);
    const brc_device_request request = {.selector = "cpu"};
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "BRECCIA_ISA is 'v9'");
    assert_int_equal(unsetenv("BRECCIA_ISA"), 0);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_selector_of_another_form_is_refused),
        cmocka_unit_test(a_device_that_is_not_there_is_refused_with_those_that_are),
        cmocka_unit_test(requests_the_cpu_cannot_meet_are_refused),
        cmocka_unit_test(instruction_sets_differ_by_rounding_alone_and_not_at_all_where_exact),
#if defined(__x86_64__)
        cmocka_unit_test(the_cpu_kernels_take_denormal_numbers_for_zero_and_the_caller_keeps_them),
#endif
        cmocka_unit_test(a_word_that_is_no_instruction_set_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
