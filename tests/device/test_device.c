/* Choosing and opening a device: selectors, refusals and their sentences, instruction sets, the compiler's log. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/device/device.h"
#include "../../host/device/device_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Open and close; the status, and the sentence left in the context. */
static brc_status open_and_close(brc_context *context, const brc_device_request *request)
{
    brc_device *device = NULL;
    brc_context_clear(context);
    const brc_status status = brc_device_open(context, request, &device);
    assert_true((status == BRC_OK) == (device != NULL));
    brc_device_close(&device);
    return status;
}

static void assert_says(brc_context *context, const char *expected)
{
    if (strstr(brc_context_message(context), expected)) return;
    printf("'%s' is not in: %s\n", expected, brc_context_message(context));
    fail();
}

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
        assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
        char expected[160];
        snprintf(expected, sizeof expected,
                 "device '%s' is not a selector: expected auto, cpu, opencl:N or target:N; usable here: cpu",
                 selectors[k]);
        assert_says(context, expected);
    }
    brc_context_free(&context);
}

static void a_device_that_is_not_there_is_refused_with_those_that_are(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    const brc_device_request request = {.selector = "opencl:77"};
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "device 'opencl:77' is not there; usable here: cpu");
    brc_context_free(&context);
}

static void requests_the_cpu_cannot_meet_are_refused(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device_request request = {.selector = "cpu", .n_threads = -1};
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "-1 threads: expected 1 to 4096");
    request = (brc_device_request){.selector = "cpu", .lanes = 3};
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "elements at once, not 3");
    request = (brc_device_request){.selector = "cpu", .kernel_folder = "kernels"};
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "needs an OpenCL device");
    brc_context_free(&context);
}

/* A short computation of n numbers. */
static void sums(brc_context *context, brc_precision precision, bool exact, double *result, int n)
{
    brc_device *device = NULL;
    brc_buffer *x = NULL, *y = NULL, *index = NULL;
    brc_kernel *axpy = NULL, *gather = NULL;
    double *const wide = calloc((size_t)n, sizeof *wide);
    float *const narrow = calloc((size_t)n, sizeof *narrow);
    int32_t *const other = calloc((size_t)n, sizeof *other);
    assert_true(wide && narrow && other);
    for (int i = 0; i < n; ++i) {
        narrow[i] = 0.37f * (float)i - 1;
        wide[i] = narrow[i];
        other[i] = (int32_t)((long)i * 611 % n);
    }
    const brc_device_request request = {.selector = "cpu", .precision = precision, .exact = exact};
    const int64_t size = (int64_t)n * brc_precision_state_bytes(precision);
    assert_int_equal(brc_device_open(context, &request, &device), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &x, size, "x"), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &y, size, "y"), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &index, n * 4, "index"), BRC_OK);
    assert_int_equal(brc_buffer_write(x, 0, precision == BRC_SINGLE ? (void *)narrow : wide, size), BRC_OK);
    assert_int_equal(brc_buffer_write(index, 0, other, n * 4), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_axpy", &axpy), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_gather", &gather), BRC_OK);
    for (int round = 0; round < 10; ++round) {
        assert_int_equal(BRC_LAUNCH(gather, n, BRC_INT(n), BRC_BUF(index), BRC_BUF(x), BRC_BUF(y)), BRC_OK);
        assert_int_equal(BRC_LAUNCH(axpy, n, BRC_INT(n), BRC_STATE(1.0 / 3), BRC_BUF(y), BRC_BUF(x)), BRC_OK);
    }
    assert_int_equal(brc_buffer_read(x, 0, precision == BRC_SINGLE ? (void *)narrow : wide, size), BRC_OK);
    for (int i = 0; i < n; ++i)
        result[i] = precision == BRC_SINGLE ? (double)narrow[i] : wide[i];
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    brc_buffer_free(&index);
    brc_device_close(&device);
    free(wide);
    free(narrow);
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
            if (open_and_close(context, &request) != BRC_OK) {
                assert_says(context, "is not an instruction set this machine and this build have");
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

static void the_cpu_kernels_take_denormal_numbers_for_zero_and_the_caller_keeps_them(void **unused)
{
    (void)unused;
#if defined(__x86_64__)
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
#else
    printf("SKIPPED: the float mode is set on x86-64 only\n");
    skip();
#endif
}

static void a_word_that_is_no_instruction_set_is_refused(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    assert_int_equal(setenv("BRECCIA_ISA", "v9", 1), 0);
    const brc_device_request request = {.selector = "cpu"};
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "BRECCIA_ISA is 'v9'");
    assert_int_equal(unsetenv("BRECCIA_ISA"), 0);
    brc_context_free(&context);
}

/* The first usable OpenCL device, or a skip that says why. */
static brc_device_info opencl_device(brc_context *context)
{
    brc_device_list *list = NULL;
    brc_device_info info = {.usable = false};
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    for (int d = 0; d < list->n && !info.usable; ++d)
        if (list->items[d].kind == BRC_DEVICE_OPENCL) info = list->items[d];
    brc_device_list_free(&list);
    if (!info.usable) {
        printf("SKIPPED: %s\n", info.why_not);
        skip();
    }
    return info;
}

static void kernels_that_do_not_compile_show_the_whole_log(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    const brc_device_info info = opencl_device(context);
    static const char folder[] = BRC_BUILD_DIR_PATH "/broken-kernels", good[] = "#include \"law.h\"\n",
                      broken[] = "\n\nthis is no kernel;\n";
    assert_int_equal(brc_file_make_folder(context, folder), BRC_OK);
    assert_int_equal(
        brc_file_write_whole(context, BRC_BUILD_DIR_PATH "/broken-kernels/kernels.h", good, sizeof good - 1), BRC_OK);
    assert_int_equal(
        brc_file_write_whole(context, BRC_BUILD_DIR_PATH "/broken-kernels/law.h", broken, sizeof broken - 1), BRC_OK);
    const brc_device_request request = {.selector = info.selector, .precision = BRC_SINGLE, .kernel_folder = folder};
    assert_int_equal(open_and_close(context, &request), BRC_DEVICE_FAILED);
    assert_says(context, info.selector);
    assert_says(context, info.name);
    assert_says(context, "broken-kernels do not compile: CL_BUILD_PROGRAM_FAILURE");
    assert_says(context, "-cl-std=CL1.2 -cl-denorms-are-zero -D BRC_PRECISION=2 -D BRC_LANES=");
    assert_says(context, "law.h:3:"); /* the compiler's log, with the file and line of the pasted text */
    brc_context_free(&context);
}

static void the_kernels_of_a_folder_replace_the_embedded_ones(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    const brc_device_info info = opencl_device(context);
    brc_device_request request = {.selector = info.selector, .kernel_folder = BRC_SOURCE_DIR_PATH "/kernels"};
    request.precision = BRC_SINGLE;
    if (open_and_close(context, &request) != BRC_OK) assert_says(context, "(it compiles)");
    request.kernel_folder = BRC_SOURCE_DIR_PATH "/no-such-folder";
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "no-such-folder/kernels.h");
    brc_context_free(&context);
}

/* One element a work-item in every variant, which is what a GPU compiles, checked without one; and the widths no device
 * chooses by itself. (Width 8 in every variant: test_device_opencl.) */
static void the_kernels_compile_for_every_width(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    const brc_device_info info = opencl_device(context);
    static const struct {
        brc_precision precision;
        bool many;
        int lanes;
    } variants[] = {{BRC_DOUBLE, false, 1}, {BRC_DOUBLE, true, 1},  {BRC_MIXED, false, 1},
                    {BRC_MIXED, true, 1},   {BRC_SINGLE, false, 1}, {BRC_SINGLE, true, 1},
                    {BRC_DOUBLE, false, 4}, {BRC_MIXED, true, 16},  {BRC_SINGLE, true, 16}};
    for (size_t k = 0; k < sizeof variants / sizeof variants[0]; ++k) {
        const brc_device_request request = {.selector = info.selector,
                                            .precision = variants[k].precision,
                                            .many_materials = variants[k].many,
                                            .lanes = variants[k].lanes};
        if (request.precision != BRC_SINGLE && !info.has_double) continue;
        if (open_and_close(context, &request) != BRC_OK) assert_says(context, "(it compiles)");
    }
    const brc_device_request request = {.selector = info.selector, .precision = BRC_SINGLE, .lanes = 5};
    assert_int_equal(open_and_close(context, &request), BRC_BAD_INPUT);
    assert_says(context, "5 elements a work-item: expected 1, 4, 8 or 16");
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_selector_of_another_form_is_refused),
        cmocka_unit_test(a_device_that_is_not_there_is_refused_with_those_that_are),
        cmocka_unit_test(requests_the_cpu_cannot_meet_are_refused),
        cmocka_unit_test(instruction_sets_differ_by_rounding_alone_and_not_at_all_where_exact),
        cmocka_unit_test(the_cpu_kernels_take_denormal_numbers_for_zero_and_the_caller_keeps_them),
        cmocka_unit_test(a_word_that_is_no_instruction_set_is_refused),
        cmocka_unit_test(kernels_that_do_not_compile_show_the_whole_log),
        cmocka_unit_test(the_kernels_of_a_folder_replace_the_embedded_ones),
        cmocka_unit_test(the_kernels_compile_for_every_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
