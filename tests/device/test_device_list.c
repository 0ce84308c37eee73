/* The list of devices: what is in it, and which one `auto` takes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../host/device/device_list.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static brc_device_info made_up(brc_device_kind kind, const char *selector, bool gpu, bool has_double, bool usable)
{
    brc_device_info info = {.kind = kind, .is_gpu = gpu, .has_double = has_double, .usable = usable};
    snprintf(info.selector, sizeof info.selector, "%s", selector);
    snprintf(info.name, sizeof info.name, "made up %s", selector);
    return info;
}

static void the_processor_is_always_there_and_something_is_automatic(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    assert_true(list->n >= 3); /* cpu, and OpenCL and target at least as a line saying why not */
    assert_string_equal(list->items[0].selector, "cpu");
    assert_true(list->items[0].usable && list->items[0].has_double && list->items[0].memory_bytes > 0);
    assert_true(list->automatic >= 0 && list->automatic < list->n && list->items[list->automatic].usable);
    assert_non_null(strstr(list->why, list->items[list->automatic].selector));
    for (int d = 0; d < list->n; ++d)
        assert_true(list->items[d].usable || list->items[d].why_not[0]);
    brc_device_list_free(&list);
    assert_null(list);
    brc_context_free(&context);
}

static void automatic_takes_the_first_gpu_that_has_the_precision(void **unused)
{
    (void)unused;
    char why[512];
    brc_device_info items[] = {
        made_up(BRC_DEVICE_CPU, "cpu", false, true, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:0", false, true, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:1", true, true, false),
        made_up(BRC_DEVICE_OPENCL, "opencl:2", true, false, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:3", true, true, true),
    };
    brc_device_list list = {.n = 5, .items = items};
    assert_int_equal(brc_device_list_choose(&list, BRC_DOUBLE, why, sizeof why), 4);
    assert_non_null(strstr(why, "auto takes opencl:3, the first GPU that has the double precision asked for"));
    assert_int_equal(brc_device_list_choose(&list, BRC_SINGLE, why, sizeof why), 3);
    list.n = 4;
    assert_int_equal(brc_device_list_choose(&list, BRC_MIXED, why, sizeof why), 0);
    assert_non_null(strstr(why, "no GPU here has double precision"));
}

static void ranks_of_a_machine_take_its_gpus_in_turn(void **unused)
{
    (void)unused;
    brc_device_info items[] = {
        made_up(BRC_DEVICE_CPU, "cpu", false, true, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:0", false, true, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:1", true, true, false),
        made_up(BRC_DEVICE_OPENCL, "opencl:2", true, false, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:3", true, true, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:4", true, true, true),
    };
    brc_device_list list = {.n = 6, .items = items};
    static const int of_double[] = {4, 5, 4}, of_single[] = {3, 4, 5, 3};
    for (int k = 0; k < 3; ++k)
        assert_int_equal(brc_device_list_deal(&list, BRC_DOUBLE, k), of_double[k]);
    for (int k = 0; k < 4; ++k)
        assert_int_equal(brc_device_list_deal(&list, BRC_SINGLE, k), of_single[k]);
    list.n = 4; /* no GPU that has the precision: the driver for the CPU */
    assert_int_equal(brc_device_list_deal(&list, BRC_MIXED, 1), 1);
    list.n = 1;
    assert_int_equal(brc_device_list_deal(&list, BRC_DOUBLE, 0), -1);
}

static void automatic_takes_the_cpu_rather_than_opencl_on_the_cpu(void **unused)
{
    (void)unused;
    char why[512];
    brc_device_info items[] = {
        made_up(BRC_DEVICE_OPENCL, "opencl:0", false, true, true),
        made_up(BRC_DEVICE_TARGET, "target:0", false, true, true),
        made_up(BRC_DEVICE_CPU, "cpu", false, true, true),
    };
    const brc_device_list list = {.n = 3, .items = items};
    assert_int_equal(brc_device_list_choose(&list, BRC_SINGLE, why, sizeof why), 2);
    assert_non_null(strstr(why, "auto takes cpu, since no usable GPU was found; OpenCL drivers that run on the CPU are "
                                "slower than the cpu backend and taken only by name"));
}

static void the_printed_list_marks_the_automatic_one_and_says_why(void **unused)
{
    (void)unused;
    brc_device_info items[] = {
        made_up(BRC_DEVICE_CPU, "cpu", false, true, true),
        made_up(BRC_DEVICE_OPENCL, "opencl:0", true, false, false),
    };
    snprintf(items[1].why_not, sizeof items[1].why_not, "it is imaginary");
    items[0].memory_bytes = (int64_t)3 << 30;
    const brc_device_list list = {.n = 2, .items = items, .why = "because"};
    char *text = NULL;
    size_t bytes;
    FILE *const file = open_memstream(&text, &bytes);
    assert_non_null(file);
    brc_device_list_print(&list, file);
    fclose(file);
    assert_non_null(strstr(text, "* cpu        made up cpu\n"));
    assert_non_null(strstr(text, "3.0 GiB"));
    assert_non_null(strstr(text, "  opencl:0   made up opencl:0\n"));
    assert_non_null(strstr(text, "single only"));
    assert_non_null(strstr(text, "not usable: it is imaginary\n"));
    assert_non_null(strstr(text, "\nbecause\n"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_processor_is_always_there_and_something_is_automatic),
        cmocka_unit_test(automatic_takes_the_first_gpu_that_has_the_precision),
        cmocka_unit_test(ranks_of_a_machine_take_its_gpus_in_turn),
        cmocka_unit_test(automatic_takes_the_cpu_rather_than_opencl_on_the_cpu),
        cmocka_unit_test(the_printed_list_marks_the_automatic_one_and_says_why),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
