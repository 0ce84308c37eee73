/* Kernels compiled at run time by the first usable OpenCL device: the compiler's log, other folders, every width. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "device_cases.h"
#include "../skip.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/device/opencl_aside.h"
#include "../../host/device/opencl_list.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static brc_device_info info;

/* First: no driver is loaded yet. Asking in this process loads it, so that the list after that is made here too. */
static void the_list_of_a_child_is_the_list_of_this_process(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    static brc_device_info here[BRC_OPENCL_MOST_DEVICES], aside[BRC_OPENCL_MOST_DEVICES];
    int n = -1;
    char why[128] = "";
    brc_opencl_aside(brc_opencl_describe_all, 20, aside, BRC_OPENCL_MOST_DEVICES, &n, why, sizeof why);
    assert_string_equal(why, "");
    assert_false(brc_opencl_driver_is_loaded());
    const int expected = brc_opencl_describe_all(here, BRC_OPENCL_MOST_DEVICES);
    assert_true(expected > 0);
    assert_true(brc_opencl_driver_is_loaded());
    assert_int_equal(n, expected);
    assert_memory_equal(here, aside, (size_t)n * sizeof *here);
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    int seen = 0;
    for (int d = 0; d < list->n; ++d)
        if (list->items[d].kind == BRC_DEVICE_OPENCL) assert_memory_equal(&list->items[d], &here[seen++], sizeof *here);
    assert_int_equal(seen, expected);
    brc_device_list_free(&list);
    brc_context_free(&context);
}

static void kernels_that_do_not_compile_show_the_whole_log(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    static const char folder[] = BRC_BUILD_DIR_PATH "/broken-kernels", good[] = "#include \"law.h\"\n",
                      broken[] = "\n\nthis is no kernel;\n";
    assert_int_equal(brc_file_make_folder(context, folder), BRC_OK);
    assert_int_equal(
        brc_file_write_whole(context, BRC_BUILD_DIR_PATH "/broken-kernels/kernels.h", good, sizeof good - 1), BRC_OK);
    assert_int_equal(
        brc_file_write_whole(context, BRC_BUILD_DIR_PATH "/broken-kernels/law.h", broken, sizeof broken - 1), BRC_OK);
    const brc_device_request request = {.selector = info.selector, .precision = BRC_SINGLE, .kernel_folder = folder};
    assert_int_equal(device_cases_open(context, &request), BRC_DEVICE_FAILED);
    device_cases_says(context, info.selector);
    device_cases_says(context, info.name);
    device_cases_says(context, "broken-kernels do not compile: CL_BUILD_PROGRAM_FAILURE");
    device_cases_says(context, "-cl-std=CL1.2 -cl-denorms-are-zero -D BRC_PRECISION=2 -D BRC_LANES=");
    device_cases_says(context, "law.h:3:"); /* the compiler's log, with the file and line of the pasted text */
    brc_context_free(&context);
}

static void the_kernels_of_a_folder_replace_the_embedded_ones(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device_request request = {.selector = info.selector, .kernel_folder = BRC_SOURCE_DIR_PATH "/kernels"};
    request.precision = BRC_SINGLE;
    if (device_cases_open(context, &request) != BRC_OK) device_cases_says(context, "(it compiles)");
    request.kernel_folder = BRC_SOURCE_DIR_PATH "/no-such-folder";
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "no-such-folder/kernels.h");
    brc_context_free(&context);
}

/* One element a work-item in every variant, which is what a GPU compiles, checked without one; and the widths no device
 * chooses by itself. (Width 8 in every variant: test_device_opencl.) */
static void the_kernels_compile_for_every_width(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    static const struct {
        brc_precision precision;
        bool many;
        int lanes;
    } variants[] = {{BRC_DOUBLE, false, 1}, {BRC_DOUBLE, true, 1},  {BRC_MIXED, false, 1},
                    {BRC_MIXED, true, 1},   {BRC_SINGLE, false, 1}, {BRC_SINGLE, true, 1},
                    {BRC_DOUBLE, false, 4}, {BRC_MIXED, true, 16},  {BRC_SINGLE, true, 16}};
    assert_int_equal(setenv("BRECCIA_OPENCL_PROGRAM", "whole", 1), 0);
    for (size_t k = 0; k < sizeof variants / sizeof variants[0]; ++k) {
        const brc_device_request request = {.selector = info.selector,
                                            .precision = variants[k].precision,
                                            .many_materials = variants[k].many,
                                            .lanes = variants[k].lanes};
        if (request.precision != BRC_SINGLE && !info.has_double) continue;
        if (device_cases_open(context, &request) != BRC_OK) device_cases_says(context, "(it compiles)");
    }
    assert_int_equal(unsetenv("BRECCIA_OPENCL_PROGRAM"), 0);
    const brc_device_request request = {.selector = info.selector, .precision = BRC_SINGLE, .lanes = 5};
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "5 elements a work-item: expected 1, 4, 8 or 16");
    brc_context_free(&context);
}

/* What the environment adds to the options is compiled with, and what the compiler says is kept. */
static void options_and_log_are_the_environments(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    const brc_device_request request = {.selector = info.selector, .precision = BRC_SINGLE};
    static const char log[] = BRC_BUILD_DIR_PATH "/compiler-log.txt";
    char many[300], *text = NULL;
    size_t bytes;
    memset(many, ' ', sizeof many - 1);
    many[sizeof many - 1] = '\0';
    (void)remove(log);
    assert_int_equal(setenv("BRECCIA_OPENCL_LOG", log, 1), 0);
    assert_int_equal(setenv("BRECCIA_OPENCL_PROGRAM", "whole", 1), 0);
    assert_int_equal(setenv("BRECCIA_OPENCL_OPTIONS", "-D BRC_UNUSED=3", 1), 0);
    if (device_cases_open(context, &request) != BRC_OK) device_cases_says(context, "(it compiles)");
    assert_int_equal(brc_file_read_whole(context, log, 1 << 20, &text, &bytes), BRC_OK);
    assert_non_null(strstr(text, "-D BRC_UNUSED=3"));
    brc_memory_free(text);
    assert_int_equal(setenv("BRECCIA_OPENCL_OPTIONS", "-no-such-option", 1), 0);
    assert_int_equal(device_cases_open(context, &request), BRC_DEVICE_FAILED);
    device_cases_says(context, "-D BRC_MANY_MATERIALS=0 -no-such-option");
    assert_int_equal(setenv("BRECCIA_OPENCL_OPTIONS", many, 1), 0);
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "BRECCIA_OPENCL_OPTIONS has 299 characters: expected at most 200");
    assert_int_equal(unsetenv("BRECCIA_OPENCL_OPTIONS"), 0);
    assert_int_equal(unsetenv("BRECCIA_OPENCL_PROGRAM"), 0);
    assert_int_equal(unsetenv("BRECCIA_OPENCL_LOG"), 0);
    brc_context_free(&context);
}

static void note_program(void *self, brc_log_level level, const char *line)
{
    (void)level;
    const char *const found = strstr(line, "a program of ");
    if (found) snprintf(self, 64, "%.*s", (int)strcspn(found, ","), found);
}

/* y += x, by a kernel that is bound already, and what is in y then. */
static float add(brc_kernel *axpy, brc_buffer *x, brc_buffer *y)
{
    float out = 0;
    assert_int_equal(BRC_LAUNCH(axpy, 1, BRC_INT(1), BRC_STATE(1), BRC_BUF(x), BRC_BUF(y)), BRC_OK);
    assert_int_equal(brc_buffer_read(y, 0, &out, sizeof out), BRC_OK);
    return out;
}

/* As the drivers of GPUs have them: what was asked for until the first launch, then what was asked for later. */
static void a_program_has_the_kernels_that_were_asked_for(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device_request request = {.selector = info.selector, .precision = BRC_SINGLE};
    brc_device *device = NULL;
    brc_buffer *x = NULL, *y = NULL;
    brc_kernel *axpy = NULL, *copy = NULL, *other = NULL;
    const float two = 2;
    char made[64] = "";
    brc_log_set_level(context, BRC_LOG_INFO);
    brc_log_set_sink(context, note_program, made);
    assert_int_equal(setenv("BRECCIA_OPENCL_PROGRAM", "some", 1), 0);
    assert_int_equal(device_cases_open(context, &request), BRC_BAD_INPUT);
    device_cases_says(context, "BRECCIA_OPENCL_PROGRAM is 'some': expected whole or parts");
    assert_int_equal(setenv("BRECCIA_OPENCL_PROGRAM", "parts", 1), 0);
    if (brc_device_open(context, &request, &device) != BRC_OK) device_cases_says(context, "(it opens)");
    assert_int_equal(brc_buffer_create(device, &x, sizeof two, "test numbers"), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &y, sizeof two, "test numbers"), BRC_OK);
    assert_int_equal(brc_buffer_write(x, 0, &two, sizeof two), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_axpy", &axpy), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "dlsm_force_listed", &other), BRC_OK); /* never launched */
    assert_string_equal(made, "");
    assert_true(add(axpy, x, y) == 2);
    assert_string_equal(made, "a program of 2 kernels");
    assert_int_equal(brc_kernel_find(device, "vector_copy", &copy), BRC_OK);
    assert_true(add(axpy, x, y) == 4);
    assert_string_equal(made, "a program of 2 kernels");
    assert_int_equal(BRC_LAUNCH(copy, 1, BRC_INT(1), BRC_BUF(x), BRC_BUF(y)), BRC_OK);
    assert_string_equal(made, "a program of 1 kernels");
    assert_true(add(axpy, x, y) == 4);
    brc_context_clear(context);
    assert_int_equal(brc_kernel_find(device, "no_such_kernel", &other), BRC_INTERNAL);
    device_cases_says(context, "there is no kernel 'no_such_kernel'");
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    brc_device_close(&device);
    assert_int_equal(unsetenv("BRECCIA_OPENCL_PROGRAM"), 0);
    brc_context_free(&context);
}

#define CACHE BRC_BUILD_DIR_PATH "/kept-programs"

/* Entries of the folder; *path: one of them. */
static int kept(char *path, size_t bytes)
{
    DIR *const list = opendir(CACHE);
    int n = 0;
    for (struct dirent *d = list ? readdir(list) : NULL; d; d = readdir(list))
        if (d->d_name[0] != '.') {
            ++n;
            snprintf(path, bytes, CACHE "/%s", d->d_name);
        }
    if (list) closedir(list);
    return n;
}

static void count_taken(void *self, brc_log_level level, const char *line)
{
    (void)level;
    *(int *)self += strstr(line, "program taken from the cache") != NULL;
}

/* One kernel, under the name of one of ours: PoCL compiles all of a program before it gives it away. */
#define SMALL BRC_BUILD_DIR_PATH "/small-kernels"
static const char small_kernel[] =
    "__kernel void vector_axpy(int n, float a, __global const float *x, __global float *y)\n"
    "{\n    const int i = (int)get_global_id(0);\n    if (i < n) y[i] += a * x[i];\n}\n";

/* Opens, and lets a kernel of the program run. */
static void open_and_run(brc_context *context, bool exact)
{
    const brc_device_request request = {
        .selector = info.selector, .precision = BRC_SINGLE, .kernel_folder = SMALL, .exact = exact};
    brc_device *device = NULL;
    brc_buffer *x = NULL, *y = NULL;
    brc_kernel *kernel = NULL;
    const float one[3] = {1, 2, 3};
    float doubled[3];
    if (brc_device_open(context, &request, &device) != BRC_OK) device_cases_says(context, "(it opens)");
    assert_int_equal(brc_buffer_create(device, &x, sizeof one, "test numbers"), BRC_OK);
    assert_int_equal(brc_buffer_create(device, &y, sizeof one, "test numbers"), BRC_OK);
    assert_int_equal(brc_buffer_write(x, 0, one, sizeof one), BRC_OK);
    assert_int_equal(brc_kernel_find(device, "vector_axpy", &kernel), BRC_OK);
    if (BRC_LAUNCH(kernel, 3, BRC_INT(3), BRC_STATE(2), BRC_BUF(x), BRC_BUF(y)) != BRC_OK)
        device_cases_says(context, "(it is launched)");
    assert_int_equal(brc_buffer_read(y, 0, doubled, sizeof doubled), BRC_OK);
    for (int k = 0; k < 3; ++k)
        assert_true(doubled[k] == 2 * one[k]);
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    brc_device_close(&device);
}

/* One byte in the middle is another, or the second half is gone. */
static void spoil(const char *path, bool cut)
{
    FILE *const file = fopen(path, "r+");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    const long half = ftell(file) / 2;
    assert_int_equal(fseek(file, half, SEEK_SET), 0);
    const int byte = fgetc(file);
    assert_int_equal(fseek(file, half, SEEK_SET), 0);
    assert_true(cut ? ftruncate(fileno(file), half) == 0 : fputc(byte ^ 1, file) != EOF);
    assert_int_equal(fclose(file), 0);
}

static void programs_are_kept_and_what_is_not_whole_is_compiled_again(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    int taken = 0;
    char path[600];
    assert_int_equal(brc_file_make_folder(context, SMALL), BRC_OK);
    assert_int_equal(brc_file_write_whole(context, SMALL "/kernels.h", small_kernel, sizeof small_kernel - 1), BRC_OK);
    while (kept(path, sizeof path))
        assert_int_equal(remove(path), 0);
    brc_log_set_level(context, BRC_LOG_DEBUG);
    brc_log_set_sink(context, count_taken, &taken);
    assert_int_equal(setenv("BRECCIA_OPENCL_CACHE", CACHE, 1), 0);
    open_and_run(context, false);
    assert_int_equal(taken, 0);
    assert_int_equal(kept(path, sizeof path), 1);
    open_and_run(context, false);
    assert_int_equal(taken, 1);
    for (int cut = 0; cut < 2; ++cut) {
        spoil(path, cut);
        open_and_run(context, false); /* not taken, but written anew */
        assert_int_equal(taken, 1 + cut);
        open_and_run(context, false);
        assert_int_equal(taken, 2 + cut);
    }
    open_and_run(context, true); /* other options */
    assert_int_equal(taken, 3);
    assert_int_equal(kept(path, sizeof path), 2);
    assert_int_equal(setenv("BRECCIA_OPENCL_CACHE", "off", 1), 0);
    open_and_run(context, true);
    assert_int_equal(taken, 3);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_list_of_a_child_is_the_list_of_this_process),
        cmocka_unit_test(kernels_that_do_not_compile_show_the_whole_log),
        cmocka_unit_test(the_kernels_of_a_folder_replace_the_embedded_ones),
        cmocka_unit_test(the_kernels_compile_for_every_width),
        cmocka_unit_test(options_and_log_are_the_environments),
        cmocka_unit_test(a_program_has_the_kernels_that_were_asked_for),
        cmocka_unit_test(programs_are_kept_and_what_is_not_whole_is_compiled_again),
    };
    char why[400];
    if (!device_cases_find(BRC_DEVICE_OPENCL, &info, why, sizeof why)) return test_skip(why);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
