#include "cells_case.h"
#include "../../../skip.h"

void cells_compare(case_options a, case_options b)
{
    bench_case x, y;
    open_case(&x, a);
    open_case(&y, b);
    assert_same_breaks(&x, &y, 60);
    close_case(&x);
    close_case(&y);
}

static const char *other_device;

static void compare_devices(case_options cpu)
{
    cpu.exact = true;
    case_options other = cpu;
    other.device = other_device;
    cells_compare(cpu, other);
}

static void cells_break_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices(
        (case_options){.stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE});
    compare_devices((case_options){
        .stages = CELLS_CRUSH(100, "0.8"), .materials = CELLS_STRENGTH("3e-4 Pa"), .sets = CELLS_FRACTURE});
}

static void cells_soften_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices(
        (case_options){.stages = CELLS_BURST(60),
                       .materials = CELLS_STRENGTH("2e-4 Pa, fracture_energy: 2e-8 J/m^2, softening: exponential"),
                       .sets = CELLS_FRACTURE});
    compare_devices((case_options){
        .stages = CELLS_BURST(60),
        .sets = CELLS_FRACTURE,
        .materials = CELLS_STRENGTH(
            "2e-4 Pa, fracture_energy: 2e-8 J/m^2") "\n  other: {E: 2 Pa, nu: 0, density: 1 kg/m^3, strength: "
                                                    "{tension: 3e-4 Pa, fracture_energy: 1e-8 J/m^2}}",
        .regions = "    regions:\n      - {where: {box: {from: [-1 m, 0.5 m, -1 m], to: [2 m, 2 m, 2 m]}}, material: "
                   "other}\n"});
}

static void cells_slide_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices((case_options){
        .stages = CELLS_CRUSH(60, "0.8"),
        .materials = CELLS_STRENGTH("3e-4 Pa, fracture_energy: 1e-7 J/m^2, shear_fracture_energy: 3e-7 J/m^2"),
        .sets = "fracture: {criterion: {mohr-coulomb: {cohesion: 3e-4 Pa, friction: 30 deg}}}\n"});
}

static void published_cells_break_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices((case_options){.model = "dlsm-published",
                                   .stages = CELLS_BURST(60),
                                   .materials = CELLS_STRENGTH("2e-4 Pa"),
                                   .sets = CELLS_FRACTURE});
}

static void cells_break_by_their_elements_stress_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices((case_options){.stages = CELLS_BURST(60),
                                   .materials = CELLS_STRENGTH("2e-4 Pa"),
                                   .sets = "fracture: {criterion: {virial-principal: {level: 1}}}\n"});
}

int cells_device_run(const char *device)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_break_as_on_the_cpu), cmocka_unit_test(cells_soften_as_on_the_cpu),
        cmocka_unit_test(cells_slide_as_on_the_cpu), cmocka_unit_test(published_cells_break_as_on_the_cpu),
        cmocka_unit_test(cells_break_by_their_elements_stress_as_on_the_cpu)};
    other_device = device;
    if (!device_is_there(device)) return test_skip("there is no such device with double precision");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
