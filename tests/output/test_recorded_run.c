/* The recorder with the real solver: a small bar is pulled, then rings. */
#include "support.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/output/h5_read.h"
#include "../../host/output/recorder.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Bar wave: c = sqrt(E/rho) = 1000 m/s, L = 2 m, one end held: f = c/(4 L) = 125 Hz. */
static const char SCENE[] =
    TEST_SCENE_HEAD "stages:\n"
                    "  - name: pull\n    solver:\n      static: {increments: 2}\n    loads:\n"
                    "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: y-, y: 0}\n"
                    "      - face_displacement: {set: z-, z: 0}\n      - face_displacement: {set: x+, x: 2 um}\n"
                    "  - name: ring\n    solver:\n      dynamic: {duration: 100 ms}\n    loads:\n"
                    "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: y-, y: 0}\n"
                    "      - face_displacement: {set: z-, z: 0}\n"
                    "sensors:\n  force:\n    reaction: {set: x+, component: x}\n"
                    "  strain:\n    face_strain: {set: x+, against: x-, component: x}\n"
                    "  lateral:\n    face_strain: {set: y+, against: y-, component: y}\n"
                    "  end:\n    face_mean: {set: x+, component: x}\n"
                    "measure:\n  E:\n    E: {load: force, area: x+, strain: strain, stage: pull}\n"
                    "  nu:\n    nu: {lateral: lateral, axial: strain, stage: pull}\n"
                    "  f:\n    frequency: {of: end, stage: ring}\n"
                    "output:\n  frames: 2\n  picture: false\n";

static void a_bar_gives_its_moduli_and_its_bar_wave(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_scene *scene = test_scene(SCENE);
    brc_domain *domain = test_domain(120);
    brc_device *device;
    brc_simulation *simulation;
    brc_recorder *recorder;
    const brc_device_request request = {.selector = "cpu", .precision = BRC_DOUBLE, .n_threads = 1};
    assert_int_equal(brc_device_open(test_context, &request, &device), BRC_OK);
    assert_int_equal(brc_recorder_create(test_context, folder, brc_clock_s(), &recorder), BRC_OK);
    brc_recorder_set_scene(recorder, scene);
    const brc_domain *const built = domain;
    brc_recorder_set_domains(recorder, 1, &built, 0);
    assert_int_equal(brc_simulation_create(test_context, scene, domain, device, &simulation), BRC_OK);
    brc_assembly whole = brc_assembly_make(scene, NULL, 1, &simulation);
    assert_int_equal(brc_recorder_observe(recorder, &whole), BRC_OK);
    const brc_status status = brc_recorder_finish(recorder, brc_simulation_run(simulation));
    if (status != BRC_OK) fail_msg("%s", brc_context_message(test_context));
    const brc_measured *m = brc_recorder_measures(recorder);
    /* The patch test holds at any resolution; what is left is the solver's tolerance (1e-10) over the strain fit. */
    assert_true(fabs(m[0].error) < 1e-6);
    assert_true(fabs(m[1].error) < 1e-6);
    /* Lateral inertia lowers it (Rayleigh): by nu^2 k^2 r^2 / 2 = 1.3 %, k = pi / (2 L), r^2 = 2/3 m^2 of the 2 x 2 m
     * section that the two planes of symmetry make of this bar. 120 cells: 1 %. */
    if (!(fabs(m[2].value / (125 * (1 - 0.0128)) - 1) < 0.01)) fail_msg("f = %g Hz (%s)", m[2].value, m[2].why_not);
    brc_h5_read h5;
    int64_t rows, columns;
    const char *path = test_path(folder, "result.h5");
    assert_int_equal(brc_h5_read_open(test_context, path, &h5), BRC_OK);
    assert_int_equal(brc_h5_read_size(&h5, "frames/time", &rows, &columns), BRC_OK);
    double time[16];
    assert_in_range(rows, 4, 8); /* start, and two intervals of each stage; a stage may show its start again */
    assert_int_equal(brc_h5_read_rows(&h5, "frames/time", H5T_NATIVE_DOUBLE, 0, rows, time), BRC_OK);
    for (int64_t k = 1; k < rows; ++k)
        assert_true(time[k] > time[k - 1]);
    assert_true(fabs(time[rows - 1] - 0.1) < 1e-3); /* physical time of the only dynamic stage, to a step */
    assert_true(brc_h5_read_has(&h5, "frames/000000/CellData/stress")); /* through the external link */
    brc_h5_read_close(&h5);
    brc_recorder_free(&recorder);
    brc_simulation_free(&simulation);
    brc_device_close(&device);
    brc_domain_free(&domain);
    brc_scene_free(&scene);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_bar_gives_its_moduli_and_its_bar_wave)};
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
