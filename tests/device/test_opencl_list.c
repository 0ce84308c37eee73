/* Drivers that abort, end the program or hang while OpenCL devices are listed: a line of the list, never the end. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "device_cases.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/device/opencl_list.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static const char vendors[] = BRC_BUILD_DIR_PATH "/tests/failing.icd";

/* A context that logs nothing, and from now on the failing driver as the only one. */
static brc_context *fail_by(const char *how)
{
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    assert_int_equal(
        brc_file_write_whole(context, vendors, BRC_FAILING_ICD_PATH "\n", strlen(BRC_FAILING_ICD_PATH) + 1), BRC_OK);
    setenv("OCL_ICD_VENDORS", vendors, 1);
    setenv("BRC_FAILING_ICD", how, 1);
    return context;
}

static const brc_device_info *opencl_line(const brc_device_list *list)
{
    for (int d = 0; d < list->n; ++d)
        if (list->items[d].kind == BRC_DEVICE_OPENCL) return &list->items[d];
    fail();
    return NULL;
}

static void assert_no_child_is_left(void)
{
    errno = 0;
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static void a_driver_that_aborts_is_a_line_and_auto_takes_the_cpu(void **unused)
{
    (void)unused;
    brc_context *context = fail_by("abort");
    brc_device_list *list = NULL;
    brc_device *device = NULL;
#pragma omp parallel num_threads(2)
    {
        /* threads that a fork does not have */
    }
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    const brc_device_info *const line = opencl_line(list);
    assert_false(line->usable);
    assert_non_null(
        strstr(line->why_not, "an OpenCL driver ended with signal 6 (Aborted) while devices were listed: mend it"));
    assert_string_equal(list->items[list->automatic].selector, "cpu");
    brc_device_list_free(&list);
    assert_no_child_is_left();
    assert_int_equal(brc_device_open(context, &(brc_device_request){.selector = "auto"}, &device), BRC_OK);
    assert_int_equal(brc_device_get_info(device)->kind, BRC_DEVICE_CPU);
    brc_device_close(&device);
    assert_int_equal(device_cases_open(context, &(brc_device_request){.selector = "opencl:0"}), BRC_BAD_INPUT);
    device_cases_says(context, "cannot be used: an OpenCL driver ended with signal 6 (Aborted)");
    brc_context_free(&context);
}

static void a_driver_that_ends_the_program_writes_none_of_its_files_twice(void **unused)
{
    (void)unused;
    brc_context *context = fail_by("exit");
    brc_device_list *list = NULL;
    FILE *const file = tmpfile();
    assert_non_null(file);
    fprintf(file, "still in memory");
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    assert_non_null(strstr(opencl_line(list)->why_not, "ended the program with exit code 3 while"));
    assert_int_equal(fflush(file), 0);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    assert_int_equal(ftell(file), strlen("still in memory"));
    fclose(file);
    brc_device_list_free(&list);
    brc_context_free(&context);
}

static void a_driver_that_hangs_is_stopped_in_time(void **unused)
{
    (void)unused;
    brc_context *context = fail_by("hang");
    brc_device_list list = {.n = 0};
    const double begin = brc_clock_s();
    assert_int_equal(brc_opencl_list_within(context, &list, 1), BRC_OK);
    assert_true(brc_clock_s() - begin >= 1);
    assert_true(brc_clock_s() - begin < 15); /* a busy machine is slow, but the driver would sleep for ever */
    assert_int_equal(list.n, 1);
    assert_false(list.items[0].usable);
    assert_non_null(strstr(list.items[0].why_not, "an OpenCL driver gave no answer in 1 s while devices were listed"));
    assert_no_child_is_left();
    brc_memory_free(list.items);
    brc_context_free(&context);
}

static void a_driver_without_devices_is_told_from_no_driver(void **unused)
{
    (void)unused;
    brc_context *context = fail_by("empty");
    brc_device_list *list = NULL;
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    const brc_device_info *line = opencl_line(list);
    assert_false(line->usable);
    assert_string_equal(line->driver, "OpenCL platform EMPTY");
    assert_non_null(strstr(line->why_not, "the driver of platform EMPTY is there and lists no device"));
    assert_int_equal(device_cases_open(context, &(brc_device_request){.selector = "opencl:0"}), BRC_BAD_INPUT);
    device_cases_says(context, "device opencl:0 (no device) cannot be used: the driver of platform EMPTY");
    brc_device_list_free(&list);
    brc_context_free(&context);
    context = fail_by("platformless");
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    line = opencl_line(list);
    assert_false(line->usable);
    assert_non_null(
        strstr(line->why_not, "failing.icd) and gives no platform: its library is missing, or it finds no device"));
    brc_device_list_free(&list);
    brc_context_free(&context);
}

static void a_list_without_drivers_says_what_to_install(void **unused)
{
    (void)unused;
    brc_context *context = fail_by("");
    brc_device_list *list = NULL;
    setenv("OCL_ICD_VENDORS", BRC_BUILD_DIR_PATH "/no-such-folder/", 1);
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    assert_non_null(strstr(opencl_line(list)->why_not, "no OpenCL driver is installed"));
    brc_device_list_free(&list);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_driver_that_aborts_is_a_line_and_auto_takes_the_cpu),
        cmocka_unit_test(a_driver_that_ends_the_program_writes_none_of_its_files_twice),
        cmocka_unit_test(a_driver_that_hangs_is_stopped_in_time),
        cmocka_unit_test(a_driver_without_devices_is_told_from_no_driver),
        cmocka_unit_test(a_list_without_drivers_says_what_to_install),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
