/* The same bonds break on the first OpenCL device (PoCL in CI) as on the cpu. */
#include "../skip.h"
#include "cells_case.h"
#include <stdio.h>
#include <string.h>

static void the_same_cells_break_on_an_opencl_device(void **state)
{
    (void)state;
    const case_options cpu = {.stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE, .exact = true};
    case_options other = cpu;
    other.device = "opencl:0";
    cells_compare(cpu, other);
}

static void the_same_cells_soften_on_an_opencl_device(void **state)
{
    (void)state;
    const case_options cpu = {.stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa, fracture_energy: 2e-8 J/m^2, softening: exponential"),
                              .sets = CELLS_FRACTURE, .exact = true};
    case_options other = cpu;
    other.device = "opencl:0";
    cells_compare(cpu, other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_cells_break_on_an_opencl_device), cmocka_unit_test(the_same_cells_soften_on_an_opencl_device)};
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    bool there = false;
    if (!context || brc_device_list_create(context, &list) != BRC_OK) return 1;
    for (int k = 0; k < list->n; ++k)
        there |= list->items[k].usable && list->items[k].has_double && strcmp(list->items[k].selector, "opencl:0") == 0;
    brc_device_list_free(&list);
    brc_context_free(&context);
    if (!there) return test_skip("there is no device opencl:0 with double precision");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
