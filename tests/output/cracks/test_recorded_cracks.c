/* The recorder with the real solver: a packing of beams is pulled until it breaks; every file tells the same. */
#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/frames/export.h"
#include "../../../host/output/recorder.h"
#include "../../../host/scene/scene_reader.h"
#include "../../../host/solver/effects/fracture/fracture.h"
#include "../../../host/solver/run/stage_end.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SCENE[] =
    "version: 1\nmaterials:\n  glass: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.4, E: 8 Pa}, strength: "
    "{tension: 2e-4 Pa}}\nmodel: cbm\n"
    "fracture: {criterion: {virial-principal: {level: 1}}}\n"
    "bodies:\n  - name: cube\n    shape: {box: {size: [1 m, 1 m, 1 m]}}\n    fill: {packing: {elements: 500, seed: "
    "1}}\n    beams: 8\n    material: glass\n"
    "stages:\n  - name: pull\n    solver: {dynamic: {duration: 3 s, stop_after_peak: {sensor: force, below: 60 %}}}\n"
    "    initial:\n      - velocity: {gradient: {x: [4e-4 1/s, 0, 0]}, origin: [0.5 m, 0.5 m, 0.5 m]}\n"
    "    loads:\n      - element_velocity: {set: x-, x: -2e-4 m/s}\n      - element_velocity: {set: x+, x: 2e-4 m/s}\n"
    "  - name: after\n    solver: {dynamic: {steps: 20}}\n"
    "sensors:\n  force: {reaction: {set: x+, component: x}}\n  broken: {fracture: broken}\n  area: {fracture: "
    "crack_area}\n  pieces: {fracture: fragments}\n"
    "  largest: {fracture: largest_fragment}\n  ratio: {fracture: failure_ratio}\n  tip: {crack_tip: {direction: [0, "
    "1, 0]}}\n"
    "measure:\n  first: {at_first_break: {of: ratio, stage: pull}}\n  last: {peak: {of: area}}\n"
    "output: {frames: 4, picture: false, history_every: 5}\n";

typedef struct run {
    brc_scene *scene;
    brc_domain *domain;
    brc_device *device;
    brc_simulation *simulation;
    const brc_domain *built;
    brc_assembly whole;
    brc_recorder *recorder;
    char *folder;
} run;

/* An observer that fails the run at sample number `left` of those with something broken. */
static brc_status fail_at(void *self, brc_simulation *simulation)
{
    int *left = self;
    int64_t broken;
    BRC_TRY(brc_simulation_broken(simulation, &broken));
    return broken > 0 && --*left == 0 ? BRC_FAIL(test_context, BRC_PHYSICS_STOPPED, "the test stops here") : BRC_OK;
}

static brc_status record(run *r, int stop_at)
{
    memset(r, 0, sizeof *r);
    r->folder = test_new_folder();
    assert_int_equal(brc_scene_read_text(test_context, "test.yaml", SCENE, sizeof SCENE - 1, 0, NULL, &r->scene),
                     BRC_OK);
    const brc_body *body = r->scene->bodies;
    const brc_build_request request = {.shape = body->shape, .fill = body->fill, .beams = body->beams};
    assert_int_equal(brc_domain_build(test_context, &request, &r->domain), BRC_OK);
    const brc_device_request device = {.selector = "cpu", .precision = BRC_DOUBLE, .n_threads = 1};
    assert_int_equal(brc_device_open(test_context, &device, &r->device), BRC_OK);
    assert_int_equal(brc_recorder_create(test_context, r->folder, brc_clock_s(), &r->recorder), BRC_OK);
    brc_recorder_set_scene(r->recorder, r->scene);
    r->built = r->domain;
    brc_recorder_set_domains(r->recorder, 1, &r->built, 0);
    assert_int_equal(brc_simulation_create(test_context, r->scene, r->domain, r->device, &r->simulation), BRC_OK);
    r->whole = brc_assembly_make(r->scene, NULL, 1, &r->simulation);
    assert_int_equal(brc_recorder_observe(r->recorder, &r->whole), BRC_OK);
    const brc_observer stop = {.self = &stop_at, .sample = fail_at};
    assert_int_equal(brc_simulation_observe(r->simulation, &stop), BRC_OK);
    return brc_recorder_finish(r->recorder, brc_simulation_run(r->simulation));
}

static void end_run(run *r)
{
    brc_recorder_free(&r->recorder);
    brc_simulation_free(&r->simulation);
    brc_device_close(&r->device);
    brc_domain_free(&r->domain);
    brc_scene_free(&r->scene);
    test_remove_folder(r->folder);
    brc_context_clear(test_context);
}

/* Column `name` of the last row of a table. */
static double last_of(const char *path, const char *name)
{
    char *text = test_read(path), *row = text, *end = strchr(text, '\n');
    int column = 0;
    const char *found = strstr(text, name);
    assert_true(found && found < end);
    for (const char *c = text; c < found; ++c)
        column += *c == ',';
    for (char *line = end + 1; *line; line = strchr(line, '\n') + 1)
        row = line;
    for (; column > 0; --column)
        row = strchr(row, ',') + 1;
    const double value = strtod(row, NULL);
    brc_memory_free(text);
    return value;
}

static int64_t rows_of(const char *path)
{
    char *text = test_read(path);
    int64_t n = -1; /* without the head */
    for (const char *c = text; *c; ++c)
        n += *c == '\n';
    brc_memory_free(text);
    return n;
}

static void every_file_tells_the_same(void **state)
{
    (void)state;
    run r;
    const brc_break *list;
    int64_t n, n_fragments;
    double area = 0, tip = -INFINITY, mass = 0;
    if (record(&r, 0) != BRC_OK) fail_msg("%s", brc_context_message(test_context));
    assert_int_equal(brc_simulation_breaks(r.simulation, &n, &list), BRC_OK);
    assert_true(n > 50); /* or this would show little */
    for (int64_t k = 0; k < n; ++k) {
        area += list[k].area;
        tip = fmax(tip, list[k].position[1]);
    }
    const char *histories = test_path(r.folder, "histories.csv"), *cracks = test_path(r.folder, "cracks.csv");
    assert_int_equal(rows_of(cracks), n);
    assert_true(last_of(histories, "broken [") == (double)n);
    assert_true(last_of(histories, "area [") == area &&
                last_of(histories, "tip [") == tip); /* the same sums in the same order */
    assert_true(last_of(cracks, "time [") == list[n - 1].time && last_of(cracks, "bond") == list[n - 1].bond);
    int32_t *fragment = calloc((size_t)r.domain->n_elements, sizeof *fragment);
    assert_int_equal(brc_simulation_fragments(r.simulation, fragment, &n_fragments), BRC_OK);
    for (int64_t e = 0; e < r.domain->n_elements; ++e)
        mass += r.domain->volume[e];
    assert_true(last_of(histories, "pieces [") == (double)n_fragments);
    assert_true(last_of(test_path(r.folder, "fragments.csv"), "fragment,") == (double)(n_fragments - 1));
    assert_true(last_of(histories, "largest [") <= 1 && last_of(histories, "largest [") > 0.1);
    free(fragment);
    /* the first stage ended by its sensor, the second by its plan; the failure ratio reached its limit between two
     * samples */
    assert_non_null(strstr(brc_simulation_stage_reason(r.simulation, 0), "stop_after_peak: force fell"));
    assert_string_equal(brc_simulation_stage_reason(r.simulation, 1), "");
    assert_int_equal(brc_simulation_step(r.simulation), 20);
    const brc_measured *m = brc_recorder_measures(r.recorder);
    assert_true(m[0].value > 0.9 && m[0].value < 1.1 && m[1].value == area);
    char *text = test_read(test_path(r.folder, "summary.json"));
    assert_non_null(strstr(text, "\"ended_by\": \"stop_after_peak"));
    brc_memory_free(text);
    assert_int_equal(brc_export(test_context, r.folder, "vtu", NULL, NULL), BRC_OK);
    assert_int_equal(brc_export(test_context, r.folder, "csv", NULL, NULL), BRC_OK);
    static const char *const exported[] = {"export/frames/000000.cracks.vtu", "export/cracks.vtu.series",
                                           "export/cracks.csv", "export/fragments.csv"};
    for (size_t k = 0; k < sizeof exported / sizeof exported[0]; ++k)
        if (!brc_file_exists(test_path(r.folder, exported[k]))) fail_msg("no %s", exported[k]);
    end_run(&r);
}

/* What a run that ends in a failure leaves: every break up to then. */
static void a_run_that_fails_keeps_its_breaks(void **state)
{
    (void)state;
    run r;
    const brc_break *list;
    int64_t n;
    assert_int_equal(record(&r, 3), BRC_PHYSICS_STOPPED);
    assert_int_equal(brc_simulation_breaks(r.simulation, &n, &list), BRC_OK);
    assert_true(n > 0);
    assert_int_equal(rows_of(test_path(r.folder, "cracks.csv")), n);
    assert_true(last_of(test_path(r.folder, "fragments.csv"), "frame") == -1); /* it moved on since its last frame */
    end_run(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_file_tells_the_same),
                                       cmocka_unit_test(a_run_that_fails_keeps_its_breaks)};
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
