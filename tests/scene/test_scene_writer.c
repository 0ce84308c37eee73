/* A scene written back is the scene that was read; every example is one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/scene/scene_reader.h"
#include "sample.h"

/* Where a thing stands differs between two texts of a scene. */
static void take_place(char place[BRC_PLACE_LENGTH], const char *name)
{
    if (place[0]) assert_memory_equal(place, name, strlen(name));
    memset(place, 0, BRC_PLACE_LENGTH);
}

static brc_scene *read_or_fail(brc_context *context, const char *name, const char *text, size_t bytes)
{
    brc_scene *scene = NULL;
    if (brc_scene_read_text(context, name, text, bytes, 0, NULL, &scene) != BRC_OK)
        fail_msg("%s\n%.*s", brc_context_message(context), (int)bytes, text);
    for (int i = 0; i < scene->n_bodies; ++i)
        take_place(scene->bodies[i].place, name);
    for (int i = 0; i < scene->n_sets; ++i)
        take_place(scene->sets[i].place, name);
    for (int i = 0; i < scene->n_sensors; ++i)
        take_place(scene->sensors[i].place, name);
    return scene;
}

static void expect_equal_arrays(const void *a, int32_t n_a, const void *b, int32_t n_b, size_t size)
{
    assert_int_equal(n_a, n_b);
    assert_memory_equal(a, b, (size_t)n_a * size);
}

static void expect_equal_bodies(brc_body left, brc_body right)
{
    expect_equal_arrays(left.regions, left.n_regions, right.regions, right.n_regions, sizeof *left.regions);
    expect_equal_arrays(left.cracks, left.n_cracks, right.cracks, right.n_cracks, sizeof *left.cracks);
    expect_equal_arrays(left.phases, left.n_phases, right.phases, right.n_phases, sizeof *left.phases);
    expect_equal_arrays(left.shape.parts, left.shape.n_parts, right.shape.parts, right.shape.n_parts,
                        sizeof *left.shape.parts);
    expect_equal_arrays(left.fill.radii, left.fill.n_radii, right.fill.radii, right.fill.n_radii,
                        sizeof *left.fill.radii);
    left.regions = right.regions = NULL;
    left.cracks = right.cracks = NULL;
    left.phases = right.phases = NULL;
    left.shape.parts = right.shape.parts = NULL;
    left.fill.radii = right.fill.radii = NULL;
    assert_memory_equal(&left, &right, sizeof left);
}

static void expect_equal_scenes(const brc_scene *a, const brc_scene *b)
{
    assert_int_equal(a->n_materials, b->n_materials);
    assert_memory_equal(a->materials, b->materials, (size_t)a->n_materials * sizeof *a->materials);
    assert_memory_equal(&a->model, &b->model, sizeof a->model);
    assert_int_equal(a->n_sets, b->n_sets);
    assert_memory_equal(a->sets, b->sets, (size_t)a->n_sets * sizeof *a->sets);
    assert_int_equal(a->n_sensors, b->n_sensors);
    assert_memory_equal(a->sensors, b->sensors, (size_t)a->n_sensors * sizeof *a->sensors);
    assert_int_equal(a->n_measures, b->n_measures);
    assert_memory_equal(a->measures, b->measures, (size_t)a->n_measures * sizeof *a->measures);
    assert_memory_equal(&a->output, &b->output, sizeof a->output);
    assert_memory_equal(a->gravity, b->gravity, sizeof a->gravity);
    assert_int_equal(a->n_bodies, b->n_bodies);
    for (int i = 0; i < a->n_bodies; ++i)
        expect_equal_bodies(a->bodies[i], b->bodies[i]);
    expect_equal_arrays(a->limits, a->n_limits, b->limits, b->n_limits, sizeof *a->limits);
    assert_int_equal(a->n_stages, b->n_stages);
    for (int i = 0; i < a->n_stages; ++i) {
        brc_stage left = a->stages[i], right = b->stages[i];
        assert_int_equal(left.n_initials, right.n_initials);
        assert_memory_equal(left.initials, right.initials, (size_t)left.n_initials * sizeof *left.initials);
        assert_int_equal(left.n_loads, right.n_loads);
        for (int l = 0; l < left.n_loads; ++l) {
            brc_load p = left.loads[l], q = right.loads[l];
            assert_int_equal(p.table.n, q.table.n);
            assert_memory_equal(p.table.time, q.table.time, (size_t)p.table.n * sizeof(double));
            assert_memory_equal(p.table.value, q.table.value, (size_t)p.table.n * sizeof(double));
            p.table = q.table = (brc_table){0};
            assert_memory_equal(&p, &q, sizeof p);
        }
        left.initials = right.initials = NULL;
        left.loads = right.loads = NULL;
        assert_memory_equal(&left, &right, sizeof left);
    }
}

static void expect_round_trip(const char *text, size_t bytes)
{
    brc_context *context = brc_context_create();
    char *written = NULL, *again = NULL;
    brc_scene *first = read_or_fail(context, "first", text, bytes);
    assert_int_equal(brc_scene_to_yaml(context, first, &written), BRC_OK);
    brc_scene *second = read_or_fail(context, "written", written, strlen(written));
    expect_equal_scenes(first, second);
    assert_int_equal(brc_scene_to_yaml(context, second, &again), BRC_OK);
    assert_string_equal(written, again);
    brc_memory_free(written);
    brc_memory_free(again);
    brc_scene_free(&first);
    brc_scene_free(&second);
    brc_context_free(&context);
}

static void round_trip_of_entry(const sample_path *path, void *data)
{
    static sample_scene sample;
    brc_scene *scene = NULL;
    sample_make(path, SAMPLE_VALID, NULL, &sample);
    brc_context *context = brc_context_create();
    /* Those few that cannot be valid are test_schema's business. */
    const brc_status status = brc_scene_read_text(context, "x", sample.text, (size_t)sample.length, 0, NULL, &scene);
    brc_scene_free(&scene);
    brc_context_free(&context);
    if (status != BRC_OK) return;
    expect_round_trip(sample.text, (size_t)sample.length);
    ++*(int *)data;
}

static void every_entry_survives_being_written(void **state)
{
    (void)state;
    int n = 0;
    sample_visit(round_trip_of_entry, &n);
    assert_true(n > 200);
}

static void every_example_reads_and_survives_being_written(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob(BRC_SOURCE_DIR_PATH "/examples/*/scene.yaml", 0, NULL, &found), 0);
    assert_true(found.gl_pathc >= 8);
    brc_context *context = brc_context_create();
    for (size_t i = 0; i < found.gl_pathc; ++i) {
        char *text = NULL;
        size_t bytes = 0;
        assert_int_equal(brc_file_read_whole(context, found.gl_pathv[i], 1 << 20, &text, &bytes), BRC_OK);
        expect_round_trip(text, bytes);
        brc_memory_free(text);
    }
    brc_context_free(&context);
    globfree(&found);
}

/* Found by the fuzzer: a value that is zero where the default is not, beside a group of which another key is given. */
static void zeros_survive_beside_a_group_of_keys(void **state)
{
    (void)state;
    static const char text[] = "version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\n"
                               "bodies:\n  - shape: {box: {size: [1 m, 1 m, 1 m]}}\n    fill: {packing: {elements: 10, "
                               "seed: 0, coordination: 6}}\n"
                               "stages: [{name: pull, solver: static}]\n";
    expect_round_trip(text, strlen(text));
}

static void texts_with_special_characters_survive(void **state)
{
    (void)state;
    static const char text[] =
        "version: 1\ntitle: \"a: 'b' \\\"c\\\" # \\\\ \xc3\xa9\"\n"
        "materials: {true: {E: 1 Pa, nu: 0, density: 1 kg/m^3}, 1-2: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\n"
        "bodies: [{domain: \"my file.h5\", material: 1-2}]\nstages: [{name: +1, solver: static}]\n";
    expect_round_trip(text, sizeof text - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_entry_survives_being_written),
        cmocka_unit_test(every_example_reads_and_survives_being_written),
        cmocka_unit_test(zeros_survive_beside_a_group_of_keys),
        cmocka_unit_test(texts_with_special_characters_survive),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
