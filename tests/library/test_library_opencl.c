/* Arrays of a device with memory of its own (PoCL in CI): read back when they are asked for. */
#include "support.h"
#include "../skip.h"
#include <math.h>
#include <string.h>

static bool is_there(const char *selector)
{
    static breccia_device devices[64];
    const int n = breccia_devices(64, devices);
    for (int k = 0; k < n && k < 64; ++k)
        if (strcmp(devices[k].selector, selector) == 0 && devices[k].usable) return true;
    return false;
}

static void arrays_are_read_back(void **state)
{
    (void)state;
    breccia_scene *scene = make_scene();
    breccia_array here, there, again;
    double before, largest = 0, apart = 0;
    breccia_run *cpu = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
    breccia_run *opencl = breccia_run_create(scene, &(breccia_options){.device = "opencl:0"});
    assert_int_equal(breccia_run_step(cpu, 10, NULL), BRECCIA_OK);
    assert_int_equal(breccia_run_step(opencl, 10, NULL), BRECCIA_OK);
    assert_int_equal(breccia_run_array(cpu, "velocity", 0, &here), BRECCIA_OK);
    assert_int_equal(breccia_run_array(opencl, "velocity", 0, &there), BRECCIA_OK);
    assert_true(here.is_live && !there.is_live && there.width == 3 && there.precision == 8);
    double by_element[216][3];
    for (int64_t r = 0; r < here.n_rows; ++r)
        if (here.element[r] >= 0)
            memcpy(by_element[here.element[r]], (double *)here.data + 3 * r, sizeof by_element[0]);
    for (int64_t r = 0; r < there.n_rows; ++r)
        for (int c = 0; there.element[r] >= 0 && c < 3; ++c) {
            largest = fmax(largest, fabs(by_element[there.element[r]][c]));
            apart = fmax(apart, fabs(by_element[there.element[r]][c] - ((double *)there.data)[3 * r + c]));
        }
    assert_true(largest > 1e-4 && apart < 1e-10 * largest);
    before = ((double *)there.data)[0];
    assert_int_equal(breccia_run_step(opencl, 10, NULL), BRECCIA_OK);
    assert_true(((double *)there.data)[0] == before); /* a copy, until it is asked for again: into the same memory */
    assert_int_equal(breccia_run_array(opencl, "velocity", 0, &again), BRECCIA_OK);
    assert_true(again.data == there.data && ((double *)again.data)[0] != before);
    breccia_run_free(cpu);
    breccia_run_free(opencl);
    breccia_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(arrays_are_read_back)};
    if (!is_there("opencl:0")) return test_skip("no OpenCL device here (Debian: pocl-opencl-icd)");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
