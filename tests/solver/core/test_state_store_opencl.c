/* What is kept of a simulation on the first OpenCL device (PoCL in CI) is all that its future there needs. */
#include "state_cases.h"
#include <stdlib.h>

/* Kept on the cpu, taken up on a device with longer slices: the same numbers under the same names. */
static void what_is_kept_does_not_depend_on_the_order_of_storage(void **state)
{
    (void)state;
    static memory_store first, second;
    case_options options = {.stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE};
    bench_case a, b;
    open_case(&a, options);
    assert_done(&a, brc_simulation_begin_stage(a.simulation, 0));
    assert_done(&a, brc_simulation_advance(a.simulation, 60));
    memory_store_begin(&first, a.context);
    assert_done(&a, brc_lockstep_save(1, &a.simulation, &first.store));
    options.device = "opencl:0";
    options.lanes = 16;
    open_case(&b, options);
    assert_int_not_equal(brc_device_slice(a.device), brc_device_slice(b.device));
    first.context = b.context;
    first.store.loading = true;
    assert_done(&b, brc_lockstep_load(1, &b.simulation, &first.store));
    memory_store_begin(&second, b.context);
    assert_done(&b, brc_lockstep_save(1, &b.simulation, &second.store));
    assert_true(memory_store_find(&first, 0, "fracture.half_edges")->rows > 20);
    assert_same_store(&first, &second);
    memory_store_free(&first), memory_store_free(&second);
    close_case(&a), close_case(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_kept_does_not_depend_on_the_order_of_storage)};
    const int code = state_cases_run("opencl:0");
    return code ? code : cmocka_run_group_tests(tests, NULL, NULL);
}
