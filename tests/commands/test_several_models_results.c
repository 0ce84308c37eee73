/* Results of scenes of several models: one folder for all, files, commands that read it. */
#include "several_models.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/commands/run_scene.h"
#include "../../host/commands/setup.h"
#include "../../host/output/cracks/cracks.h"
#include "../../host/output/h5_read.h"
#include "../../host/scene/scene_reader.h"
#include "../../host/solver/run/lockstep.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- results ---- */

static char folder[] = "/tmp/breccia-several-XXXXXX";

static double *read_cells(const char *run, const char *name, int64_t first, int64_t n, int64_t columns)
{
    char path[512];
    double *out;
    brc_h5_read h5;
    snprintf(path, sizeof path, "%s/%s/frames/000001.vtkhdf", folder, run);
    must(brc_h5_read_open(context, path, &h5));
    snprintf(path, sizeof path, "VTKHDF/CellData/%s", name);
    must(BRC_ALLOCATE(context, &out, n * columns, "test"));
    must(brc_h5_read_rows(&h5, path, H5T_NATIVE_DOUBLE, first, n, out));
    brc_h5_read_close(&h5);
    return out;
}

static brc_status record(const char *text, const char *name, bool stop, brc_run_results *out)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    const brc_run_request request = {.path = "test",
                                     .text = text,
                                     .text_bytes = strlen(text),
                                     .folder = path,
                                     .device = "cpu",
                                     .n_threads = 1,
                                     .created = stop ? interrupt : NULL};
    return brc_run_scene(context, &request, out);
}

static char *summary_of(const char *name)
{
    char path[512], *text;
    snprintf(path, sizeof path, "%s/%s/summary.json", folder, name);
    must(BRC_ALLOCATE(context, &text, 1 << 20, "test"));
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    return text;
}

static double last_of(const char *summary, const char *sensor)
{
    char key[96];
    snprintf(key, sizeof key, "\"%s\": {", sensor);
    const char *at = strstr(strstr(summary, "\"sensors\""), key);
    assert_non_null(at);
    return strtod(strstr(at, "\"last\": ") + strlen("\"last\": "), NULL);
}

#define PULL                                                                                                           \
    "sets:\n" ENDS "stages:\n  - name: pull\n    solver:\n      static: {increments: 1}\n    loads:\n"                 \
    "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n      - element_displacement: {set: right, x: 1 "    \
    "um}\n"
#define SENSORS                                                                                                        \
    "sensors:\n  force:\n    reaction: {set: right, component: x}\n  elastic:\n    energy: elastic\n"                  \
    "  tip:\n    point: {point: [20 mm, 60 mm, 10 mm], component: x}\n"

static void one_folder_of_results_holds_both_models(void **state)
{
    (void)state;
    static const char *const field[] = {"displacement", "velocity", "stress", "strain", "von_mises", "position"};
    static const int columns[] = {3, 3, 6, 6, 1, 3};
    brc_run_results both, alone[2];
    assert_non_null(mkdtemp(folder));
    must(record(BOTH PULL SENSORS, "both", false, &both));
    must(record(ALONE_CELLS PULL SENSORS, "cells", false, &alone[0]));
    must(record(ALONE_SPHERES PULL SENSORS, "spheres", false, &alone[1]));
    assert_int_equal(both.n_elements, alone[0].n_elements + alone[1].n_elements);
    assert_int_equal(both.n_bonds, alone[0].n_bonds + alone[1].n_bonds);
    for (size_t f = 0; f < sizeof field / sizeof *field; ++f)
        for (int k = 0; k < 2; ++k) {
            const int64_t n = alone[k].n_elements, first = k == 0 ? 0 : alone[0].n_elements;
            double *a = read_cells("both", field[f], first, n, columns[f]),
                   *b = read_cells(k == 0 ? "cells" : "spheres", field[f], 0, n, columns[f]);
            assert_memory_equal(a, b, (size_t)(n * columns[f]) * sizeof *a);
            brc_memory_free(a);
            brc_memory_free(b);
        }
    double *body = read_cells("both", "body", 0, both.n_elements, 1),
           *model = read_cells("both", "model", 0, both.n_elements, 1),
           *id = read_cells("both", "element_id", 0, both.n_elements, 1);
    for (int64_t e = 0; e < both.n_elements; ++e) {
        assert_true(body[e] == (e >= alone[0].n_elements) && model[e] == body[e]);
        assert_true(id[e] == (double)e);
    }
    brc_memory_free(body);
    brc_memory_free(model);
    brc_memory_free(id);
    char *text = summary_of("both"), *part[2] = {summary_of("cells"), summary_of("spheres")};
    assert_non_null(strstr(text, "\"model\": \"dlsm, cbm\""));
    assert_non_null(strstr(text, "\"parts\": ["));
    assert_non_null(strstr(text, "\"beams and element rotations (cbm)\""));
    assert_non_null(strstr(text, "\"status\": \"done\""));
    /* sums of two numbers that the files hold to the last digit */
    assert_true(last_of(text, "force") == last_of(part[0], "force") + last_of(part[1], "force"));
    assert_true(last_of(text, "elastic") == last_of(part[0], "elastic") + last_of(part[1], "elastic"));
    assert_true(last_of(text, "tip") == last_of(part[0], "tip")); /* nearest to the bar */
    assert_true(both.ledger.work == alone[0].ledger.work + alone[1].ledger.work);
    /* errors add and so do the energies they are measured by, but for which of them (elastic, work) is the larger: the
     * same to the error itself */
    assert_true(fabs(both.ledger.closure) <= 1.01 * fmax(fabs(alone[0].ledger.closure), fabs(alone[1].ledger.closure)));
    brc_memory_free(text);
    for (int k = 0; k < 2; ++k) {
        brc_memory_free(part[k]);
        brc_run_results_free(&alone[k]);
    }
    for (int f = 0; f < 5; ++f)
        if (f != 2) assert_non_null(both.file[f]); /* all but histories are looked at here */
    brc_run_results_free(&both);
}

static void assert_same_file(const char *a, const char *b, const char *name)
{
    char path[2][512], command[1200];
    snprintf(path[0], sizeof path[0], "%s/%s/%s", folder, a, name);
    snprintf(path[1], sizeof path[1], "%s/%s/%s", folder, b, name);
    snprintf(command, sizeof command, "cmp '%s' '%s'", path[0], path[1]);
    assert_int_equal(system(command), 0);
}

/* Whether the scene or its only body names the model is the same run, byte for byte. */
static void one_model_gives_the_same_bytes_wherever_it_is_written(void **state)
{
    (void)state;
    brc_run_results out[2];
    must(record(ALONE_SPHERES PULL SENSORS, "above", false, &out[0]));
    must(record(MATERIALS "bodies:\n" SPHERES "    model: cbm\n" PULL SENSORS, "within", false, &out[1]));
    assert_same_file("above", "within", "frames/000000.vtkhdf");
    assert_same_file("above", "within", "frames/000001.vtkhdf");
    assert_same_file("above", "within", "histories.csv");
    assert_same_file("above", "within", "picture.png");
    for (int k = 0; k < 2; ++k)
        brc_run_results_free(&out[k]);
}

static void a_run_that_fails_at_once_names_the_models_it_was_asked_for(void **state)
{
    (void)state;
    brc_run_results out;
    assert_int_equal(record(BOTH
                            "sets:\n  far:\n    elements:\n      sphere: {centre: [1 km, 0, 0], radius: 1 m}\n" SPIN,
                            "failed", false, &out),
                     BRC_BAD_INPUT);
    brc_context_clear(context);
    char *text = summary_of("failed");
    assert_non_null(strstr(text, "\"model\": \"dlsm, cbm\""));
    assert_non_null(strstr(text, "\"status\": \"bad_input\""));
    assert_null(strstr(text, "\"parts\""));
    brc_memory_free(text);
    brc_run_results_free(&out);
}

static void an_interrupt_stops_both_and_keeps_the_results(void **state)
{
    (void)state;
    brc_run_results out;
    assert_int_equal(record(BOTH "sets:\n" ENDS SPIN SENSORS, "stopped", true, &out), BRC_INTERRUPTED);
    brc_context_clear(context);
    assert_int_equal(out.steps, 1); /* every step is sampled, and the signal is looked at after each batch */
    char *text = summary_of("stopped");
    assert_non_null(strstr(text, "\"status\": \"interrupted\""));
    brc_memory_free(text);
    brc_run_results_free(&out);
}

static void export_check_and_build_know_both_models(void **state)
{
    (void)state;
    char arguments[1024], path[512];
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    must(brc_file_write_whole(context, path, BOTH PULL SENSORS, strlen(BOTH PULL SENSORS)));
    snprintf(arguments, sizeof arguments, "export %s/both --format vtu", folder);
    assert_int_equal(test_program(arguments), 0);
    snprintf(arguments, sizeof arguments, "export %s/both --format csv", folder);
    assert_int_equal(test_program(arguments), 0);
    snprintf(arguments, sizeof arguments, "check %s/scene.yaml --all --device cpu --threads 1", folder);
    assert_int_equal(test_program(arguments), 0);
    assert_non_null(strstr(test_program_stdout(), "model cbm: 150 elements"));
    assert_non_null(strstr(test_program_stdout(), "effects in with dlsm: conservative elasticity (dlsm)"));
    assert_non_null(strstr(test_program_stdout(), "effects in with cbm: beams and element rotations (cbm)"));
    snprintf(arguments, sizeof arguments, "build %s/scene.yaml -o %s/d.h5 --threads 1", folder, folder);
    assert_int_equal(test_program(arguments), 0);
    snprintf(path, sizeof path, "%s/d-dlsm.h5", folder);
    assert_true(brc_file_exists(path));
    snprintf(path, sizeof path, "%s/d-cbm.h5", folder);
    assert_true(brc_file_exists(path));
    snprintf(arguments, sizeof arguments, "rm -r '%s'", folder);
    assert_int_equal(system(arguments), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_folder_of_results_holds_both_models),
        cmocka_unit_test(one_model_gives_the_same_bytes_wherever_it_is_written),
        cmocka_unit_test(a_run_that_fails_at_once_names_the_models_it_was_asked_for),
        cmocka_unit_test(an_interrupt_stops_both_and_keeps_the_results),
        cmocka_unit_test(export_check_and_build_know_both_models),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
