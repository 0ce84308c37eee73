#include "support.h"
#include "fake_simulation.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/output/recorder.h"
#include <hdf5.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* Tension along x, strain 1e-3, lateral -0.25e-3, stress 1 MPa over 1 m^2: E = 1 GPa and nu = 0.25 as the material. */
static const char SCENE[] =
    TEST_SCENE_HEAD "stages:\n  - name: pull\n    solver:\n      static: {increments: 4}\n    loads:\n"
                    "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: x+, x: 2 mm}\n"
                    "sensors:\n  force:\n    reaction: {set: x+, component: x}\n"
                    "  strain:\n    face_strain: {set: x+, against: x-, component: x}\n"
                    "  lateral:\n    face_strain: {set: y+, against: y-, component: y}\n"
                    "  stress:\n    stress: {component: xx}\n"
                    "  kinetic:\n    energy: kinetic\n"
                    "measure:\n  E:\n    E: {load: force, area: x+, strain: strain, target: 1 GPa}\n"
                    "  nu:\n    nu: {lateral: lateral, axial: strain}\n"
                    "output:\n  picture: {colour: stress_xx}\n  curve: {x: strain, y: stress}\n";

typedef struct run {
    brc_scene *scene;
    brc_domain *domain;
    brc_device *device;
    brc_simulation simulation;
    const brc_domain *built;
    brc_simulation *alone;
    brc_assembly whole;
    brc_recorder *recorder;
    char *folder;
} run;

static void begin_run(run *r)
{
    memset(r, 0, sizeof *r);
    r->scene = test_scene(SCENE);
    r->domain = test_domain(200);
    r->folder = test_new_folder();
    const brc_device_request request = {.selector = "cpu", .precision = BRC_MIXED};
    assert_int_equal(brc_device_open(test_context, &request, &r->device), BRC_OK);
    r->simulation = (brc_simulation){.scene = r->scene,
                                     .domain = r->domain,
                                     .device = r->device,
                                     .stage = -1,
                                     .gradient = {{1e-3, 0, 0}, {0, -0.25e-3, 0}, {0, 0, -0.25e-3}},
                                     .stress = {1e6},
                                     .graded = 0.2,
                                     .reaction = {1e6, 0, 0},
                                     .ledger = {.elastic = 1000, .kinetic = NAN}};
}

static void end_run(run *r)
{
    brc_recorder_free(&r->recorder);
    brc_device_close(&r->device);
    brc_domain_free(&r->domain);
    brc_scene_free(&r->scene);
    test_remove_folder(r->folder);
    brc_context_clear(test_context);
}

static brc_status record(run *r)
{
    BRC_TRY(brc_recorder_create(test_context, r->folder, brc_clock_s(), &r->recorder));
    brc_recorder_set_scene(r->recorder, r->scene);
    r->built = r->domain;
    r->alone = &r->simulation;
    r->whole = brc_assembly_make(r->scene, NULL, 1, &r->alone);
    brc_recorder_set_domains(r->recorder, 1, &r->built, 1.5);
    brc_status status = brc_recorder_observe(r->recorder, &r->whole);
    if (status == BRC_OK) status = brc_simulation_run(&r->simulation);
    return brc_recorder_finish(r->recorder, status);
}

static void assert_holds(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("\"%s\" is not in:\n%s", part, text);
}

static void a_run_leaves_every_file_the_header_lists(void **state)
{
    (void)state;
    static const char *const name[] = {"summary.json",         "result.h5",           "histories.csv",
                                       "picture.png",          "curve.png",           "frames.vtkhdf.series",
                                       "frames/000000.vtkhdf", "frames/000001.vtkhdf"};
    run r;
    begin_run(&r);
    assert_int_equal(record(&r), BRC_OK);
    for (size_t k = 0; k < sizeof name / sizeof name[0]; ++k)
        if (!brc_file_exists(test_path(r.folder, name[k]))) fail_msg("no %s", name[k]);
    assert_string_equal(brc_recorder_path(r.recorder, "picture.png"), test_path(r.folder, "picture.png"));
    assert_null(brc_recorder_path(r.recorder, "nonsense"));
    end_run(&r);
}

static void every_frame_has_a_picture_where_the_scene_asks_for_it(void **state)
{
    (void)state;
    run r;
    begin_run(&r);
    r.scene->output.picture_frames = true;
    assert_int_equal(record(&r), BRC_OK);
    assert_true(brc_file_exists(test_path(r.folder, "pictures/000000.png")) &&
                brc_file_exists(test_path(r.folder, "pictures/000001.png")));
    brc_recorder_free(&r.recorder);
    assert_int_equal(brc_recorder_create(test_context, r.folder, brc_clock_s(), &r.recorder),
                     BRC_OK); /* a new run clears them away */
    assert_false(brc_file_exists(test_path(r.folder, "pictures/000000.png")));
    end_run(&r);
}

/* Two broken bonds: the stream in result.h5 and cracks.csv, counts in the summary, damage and fragments in the
 * frames. */
static void what_broke_is_in_every_file(void **state)
{
    (void)state;
    static const brc_break breaks[] = {
        {.time = 1e-3,
         .step = 4,
         .mode = BRC_BREAK_TENSION,
         .bond = 7,
         .element_i = 1,
         .element_j = 5,
         .position = {0.1, 0.2, 0.3},
         .normal = {1, 0, 0},
         .stress = 5e7,
         .energy = 1e-6,
         .area = 0.5},
        {.time = 2e-3, .step = 8, .mode = BRC_BREAK_SHEAR, .bond = 3, .element_i = 0, .element_j = 2, .area = 0.25}};
    run r;
    begin_run(&r);
    r.simulation.breaks = breaks;
    r.simulation.n_breaks = 2;
    assert_int_equal(record(&r), BRC_OK);
    char *text = test_read(test_path(r.folder, "cracks.csv"));
    assert_holds(text, "0.001,4,0,tension,7,1,5,0.1");
    assert_holds(text, "0.002,8,0,shear,3,0,2,0,0,0");
    brc_memory_free(text);
    text = test_read(test_path(r.folder, "summary.json"));
    assert_holds(text, "\"broken\": 2");
    assert_holds(text, "\"fragments\": 2");
    assert_holds(text, "\"first_break_s\": 0.001");
    assert_holds(text, "\"shear\": 1");
    assert_holds(text, "\"crack_area_m2\": 0.75");
    assert_holds(text, "\"largest_fragment\": 0.99");
    assert_holds(text, "\"kinetic_over_elastic_at_first_break\": 0.01");
    assert_holds(text, "\"name\": \"quasi-static\"");
    brc_memory_free(text);
    text = test_read(test_path(r.folder, "fragments.csv")); /* two frames of two */
    assert_holds(text, "0,0,0,0,0,");
    assert_holds(text, "1,0,0,1,");
    assert_holds(text, ",99,0,0,0,0,0,0,0,0,0,1,2,3,4,5,6,7,0,0,1\n");
    brc_memory_free(text);
    assert_true(brc_file_exists(test_path(r.folder, "frames/000001.cracks.vtu")));
    text = test_read(test_path(r.folder, "cracks.vtu.series"));
    assert_holds(text, "frames/000000.cracks.vtu");
    brc_memory_free(text);
    hid_t file = H5Fopen(test_path(r.folder, "result.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
    int64_t bond[2];
    double position[6];
    hid_t set = H5Dopen2(file, "cracks/bond", H5P_DEFAULT);
    assert_true(H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, bond) >= 0);
    H5Dclose(set);
    set = H5Dopen2(file, "cracks/position", H5P_DEFAULT);
    assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, position) >= 0);
    H5Dclose(set);
    H5Fclose(file);
    assert_true(bond[0] == 7 && bond[1] == 3 && position[2] == 0.3);
    const int64_t n = r.domain->n_elements;
    double *damage = calloc((size_t)n, sizeof *damage);
    file = H5Fopen(test_path(r.folder, "frames/000001.vtkhdf"), H5F_ACC_RDONLY, H5P_DEFAULT);
    set = H5Dopen2(file, "VTKHDF/CellData/damage", H5P_DEFAULT);
    assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, damage) >= 0);
    H5Dclose(set);
    H5Fclose(file);
    assert_true(damage[n - 1] == (double)(n - 1) / (double)n);
    free(damage);
    end_run(&r);
}

static void the_summary_has_the_stable_keys_with_the_values_of_the_run(void **state)
{
    (void)state;
    run r;
    begin_run(&r);
    assert_int_equal(record(&r), BRC_OK);
    char *text = test_read(test_path(r.folder, "summary.json"));
    static const char *const part[] = {"\"version\": \"",
                                       "\"commit\": \"",
                                       "\"model\": \"dlsm\"",
                                       "\"precision\": \"mixed\"",
                                       "\"device\": \"cpu (",
                                       "\"title\": \"Test, \\\"quoted\\\"\"",
                                       "\"broken\": 0",
                                       "\"value_s\": 1e-06",
                                       "\"governed_by\": \"auto: power iteration\"",
                                       "\"safety\": 0.8",
                                       "\"steps\": 4",
                                       "\"total_s\": ",
                                       "\"build_s\": 1.5",
                                       "\"setup_s\": 0.25",
                                       "\"steps_s\": 2",
                                       "\"output_s\": ",
                                       "\"bond_updates_per_s\": ",
                                       "\"phases\": {",
                                       "\"search_s\": 0.25",
                                       "\"host_bytes\": ",
                                       "\"device_bytes\": 0",
                                       "\"kinetic_J\": null",
                                       "\"elastic_J\": 1000",
                                       "\"closure\": 0",
                                       "\"dlsm elasticity\",\n",
                                       "\"gravity\"\n",
                                       "\"target\": 1000000000",
                                       "\"unit\": \"Pa\"",
                                       "\"last\": ",
                                       "\"min\": ",
                                       "\"max\": ",
                                       "\"status\": \"done\"",
                                       "\"reason\": \"\"",
                                       "\"exit_code\": 0"};
    for (size_t k = 0; k < sizeof part / sizeof part[0]; ++k)
        assert_holds(text, part[k]);
    brc_memory_free(text);
    assert_int_equal(brc_recorder_measure_count(r.recorder), 2);
    const brc_measured *measured = brc_recorder_measures(r.recorder);
    /* The lateral contraction of the faces is left out of nothing here: linear data, so rounding alone. The area of a
     * flat wall is that of its cells, summed: 1e-12. */
    assert_true(fabs(measured[0].value / 1e9 - 1) < 1e-11);
    assert_true(fabs(measured[0].error) < 1e-11);
    assert_true(fabs(measured[1].value - 0.25) < 1e-12);
    assert_true(measured[1].has_target && measured[1].target == 0.25);
    end_run(&r);
}

static void a_scene_that_cannot_be_read_still_leaves_a_summary(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_recorder *recorder;
    assert_int_equal(brc_recorder_create(test_context, folder, brc_clock_s(), &recorder), BRC_OK);
    char *text = test_read(test_path(folder, "summary.json"));
    assert_holds(text, "\"status\": \"running\"");
    brc_memory_free(text);
    const brc_status wrong = BRC_FAIL(test_context, BRC_BAD_INPUT, "scene.yaml:1:2: error: \"nu\"\tis 0.5");
    assert_int_equal(brc_recorder_finish(recorder, wrong), BRC_BAD_INPUT);
    brc_recorder_free(&recorder);
    text = test_read(test_path(folder, "summary.json"));
    assert_holds(text, "\"status\": \"bad_input\"");
    assert_holds(text, "\"reason\": \"scene.yaml:1:2: error: \\\"nu\\\"\\tis 0.5\"");
    assert_holds(text, "\"elements\": null");
    assert_holds(text, "\"exit_code\": 2");
    brc_memory_free(text);
    brc_context_clear(test_context);
    test_remove_folder(folder);
}

static void a_stopped_run_keeps_its_results_and_its_status(void **state)
{
    (void)state;
    run r;
    begin_run(&r);
    r.simulation.end = BRC_PHYSICS_STOPPED;
    assert_int_equal(record(&r), BRC_PHYSICS_STOPPED);
    char *text = test_read(test_path(r.folder, "summary.json"));
    assert_holds(text, "\"status\": \"physics_stopped\"");
    brc_memory_free(text);
    assert_true(H5Fis_hdf5(test_path(r.folder, "result.h5")) > 0);
    end_run(&r);
}

static void results_of_an_earlier_run_are_removed_and_other_files_kept(void **state)
{
    (void)state;
    run r;
    begin_run(&r);
    assert_int_equal(record(&r), BRC_OK);
    brc_recorder_free(&r.recorder);
    assert_int_equal(brc_file_write_whole(test_context, test_path(r.folder, "notes.txt"), "mine", 4), BRC_OK);
    assert_int_equal(brc_file_write_whole(test_context, test_path(r.folder, "frames/notes.txt"), "mine", 4), BRC_OK);
    assert_int_equal(brc_file_write_whole(test_context, test_path(r.folder, "frames/000007.vtkhdf.part"), "x", 1),
                     BRC_OK);
    assert_int_equal(brc_recorder_create(test_context, r.folder, brc_clock_s(), &r.recorder), BRC_OK);
    assert_false(brc_file_exists(test_path(r.folder, "result.h5")));
    assert_false(brc_file_exists(test_path(r.folder, "frames/000000.vtkhdf")));
    assert_false(brc_file_exists(test_path(r.folder, "frames/000007.vtkhdf.part")));
    assert_true(brc_file_exists(test_path(r.folder, "notes.txt")));
    assert_true(brc_file_exists(test_path(r.folder, "frames/notes.txt")));
    end_run(&r);
}

static void two_runs_write_equal_bytes(void **state)
{
    (void)state;
    static const char *const name[] = {"result.h5", "histories.csv", "picture.png", "frames/000001.vtkhdf"};
    run a, b;
    begin_run(&a);
    begin_run(&b);
    assert_int_equal(record(&a), BRC_OK);
    assert_int_equal(record(&b), BRC_OK);
    for (size_t k = 0; k < sizeof name / sizeof name[0]; ++k) {
        char *first, *second;
        size_t n, m;
        brc_file_read_whole(test_context, test_path(a.folder, name[k]), 1 << 28, &first, &n);
        brc_file_read_whole(test_context, test_path(b.folder, name[k]), 1 << 28, &second, &m);
        assert_int_equal(n, m);
        assert_memory_equal(first, second, n);
        brc_memory_free(first);
        brc_memory_free(second);
    }
    end_run(&a);
    end_run(&b);
}

/* A limit on the size of files refuses writes just as a full disk does, and needs no rights. */
static void a_full_disk_gives_one_sentence_and_leaves_readable_results(void **state)
{
    (void)state;
    run r;
    struct rlimit before, limit;
    begin_run(&r);
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    limit = before;
    limit.rlim_cur = 45000; /* room for the index, not for a frame of 200 cells */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const brc_status status = record(&r);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(status, BRC_FILE_FAILED);
    const char *message = brc_context_message(test_context);
    assert_null(strchr(message, '\n')); /* one sentence */
    assert_holds(message, "frames/000000.vtkhdf");
    assert_holds(message, "File too large; free some space");
    assert_false(brc_file_exists(test_path(r.folder, "frames/000000.vtkhdf")));
    assert_false(brc_file_exists(test_path(r.folder, "frames/000000.vtkhdf.part")));
    char *text = test_read(test_path(r.folder, "summary.json"));
    assert_holds(text, "\"status\": \"file_failed\"");
    assert_holds(text, "File too large");
    brc_memory_free(text);
    text = test_read(test_path(r.folder, "histories.csv"));
    assert_holds(text, "0,0,0,0,0,0,0,0,");
    brc_memory_free(text);
    assert_true(H5Fis_hdf5(test_path(r.folder, "result.h5")) > 0);
    end_run(&r);
}

static void a_folder_that_cannot_be_made_is_named(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_recorder *recorder;
    assert_int_equal(brc_file_write_whole(test_context, test_path(folder, "file"), "x", 1), BRC_OK);
    assert_int_equal(brc_recorder_create(test_context, test_path(folder, "file"), 0, &recorder), BRC_FILE_FAILED);
    assert_null(recorder);
    assert_holds(brc_context_message(test_context), "is a file where a folder is needed");
    brc_context_clear(test_context);
    test_remove_folder(folder);
}

static void without_gnuplot_the_run_is_done_all_the_same(void **state)
{
    (void)state;
    run r;
    begin_run(&r);
    char *path = strdup(getenv("PATH"));
    setenv("PATH", "/nonexistent", 1);
    assert_int_equal(record(&r), BRC_OK);
    setenv("PATH", path, 1);
    free(path);
    assert_false(brc_file_exists(test_path(r.folder, "curve.png")));
    assert_false(brc_file_exists(test_path(r.folder, "curve.png.script")));
    assert_true(brc_file_exists(test_path(r.folder, "picture.png")));
    end_run(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_leaves_every_file_the_header_lists),
        cmocka_unit_test(every_frame_has_a_picture_where_the_scene_asks_for_it),
        cmocka_unit_test(what_broke_is_in_every_file),
        cmocka_unit_test(the_summary_has_the_stable_keys_with_the_values_of_the_run),
        cmocka_unit_test(a_scene_that_cannot_be_read_still_leaves_a_summary),
        cmocka_unit_test(a_stopped_run_keeps_its_results_and_its_status),
        cmocka_unit_test(results_of_an_earlier_run_are_removed_and_other_files_kept),
        cmocka_unit_test(two_runs_write_equal_bytes),
        cmocka_unit_test(a_full_disk_gives_one_sentence_and_leaves_readable_results),
        cmocka_unit_test(a_folder_that_cannot_be_made_is_named),
        cmocka_unit_test(without_gnuplot_the_run_is_done_all_the_same),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
