/* Device memory is what the tables of fields say (host/solver/core/fields.h): to the byte, for every example and every
 * scene of tests/digest, from scene and domain alone. */
#include "support.h"
#include "../../host/base/memory.h"
#include "../../host/commands/setup.h"
#include "../../host/scene/scene_reader.h"
#include "../../host/solver/core/solver.h"
#include <glob.h>
#include <stdio.h>
#include <string.h>

enum { MOST_ELEMENTS = 2000 };

/* Large bodies are made of fewer elements: it is bytes that are asked for, not physics. */
static void make_small(brc_scene *scene)
{
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        brc_fill *fill = &scene->bodies[b].fill;
        if (fill->n_elements > MOST_ELEMENTS) fill->n_elements = MOST_ELEMENTS;
        while (fill->cells[0] * fill->cells[1] * fill->cells[2] > 2 * MOST_ELEMENTS)
            for (int c = 0; c < 3; ++c)
                fill->cells[c] -= fill->cells[c] / 3;
    }
}

/* What scene and domain of a part want, asked anew. */
static int64_t planned_anew(const brc_setup *setup, int32_t k)
{
    const brc_simulation *s = setup->simulation[k];
    brc_layout *layout = NULL;
    brc_wants wants;
    test_done(brc_simulation_layout(test_context, s->scene, s->domain, brc_device_slice(s->device), &layout));
    brc_wants_make(s->scene, s->domain, layout, s->device, s->material_of_element, &wants);
    wants.pieces = s->wants.pieces;
    const int64_t bytes = brc_fields_planned(&wants, BRC_LIFE_RUN);
    brc_layout_free(&layout);
    return bytes;
}

/* All parts of one scene; returns how many there were. */
static int look_at(const char *path, brc_precision precision)
{
    brc_scene *scene = NULL;
    brc_setup setup = {0};
    test_done(brc_scene_read(test_context, path, 0, NULL, &scene));
    if (!strstr(path, "edge-impact")) make_small(scene); /* whose plate has two layers of cells */
    test_done(brc_setup_domains(test_context, scene, NULL, 1, &setup));
    test_done(brc_setup_simulations(
        test_context, &(brc_device_request){.selector = "cpu", .precision = precision, .n_threads = 1}, &setup));
    for (int32_t k = 0; k < setup.n; ++k) {
        const int64_t planned = planned_anew(&setup, k), held = brc_device_bytes(setup.device[k]);
        if (planned != held)
            fail_msg("%s, part %d: %lld bytes planned, %lld held", path, (int)k, (long long)planned, (long long)held);
    }
    const int n = setup.n;
    brc_setup_free(&setup);
    brc_scene_free(&scene);
    return n;
}

static void look_at_all(const char *pattern, int least, brc_precision precision)
{
    char path[1024];
    glob_t found;
    int n = 0;
    snprintf(path, sizeof path, "%s/%s", BRC_SOURCE_DIR_PATH, pattern);
    assert_int_equal(glob(path, 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; ++i)
        n += look_at(found.gl_pathv[i], precision);
    globfree(&found);
    assert_true(n >= least);
}

static void fields_of_every_example_are_all_that_is_held(void **state)
{
    (void)state, look_at_all("examples/*/scene.yaml", 28, BRC_DOUBLE);
}

static void fields_of_all_models_and_effects_are_all_that_is_held(void **state)
{
    (void)state, look_at_all("tests/digest/scenes/*.yaml", 6, BRC_DOUBLE);
}

static void fields_are_all_that_is_held_in_lower_precisions(void **state)
{
    (void)state;
    look_at_all("tests/digest/scenes/*.yaml", 6, BRC_MIXED);
    look_at_all("tests/digest/scenes/*.yaml", 6, BRC_SINGLE);
}

/* With the lists of contact, the guard and the loads of the stage: what is planned, at most what is held, and no more
 * than a quarter below. */
static void what_contact_and_a_stage_add_is_near_the_plan(void **state)
{
    (void)state;
    char path[1024];
    brc_scene *scene = NULL;
    brc_setup setup = {0};
    snprintf(path, sizeof path, "%s/tests/digest/scenes/cells-shear.yaml", BRC_SOURCE_DIR_PATH);
    test_done(brc_scene_read(test_context, path, 0, NULL, &scene));
    test_done(brc_setup_domains(test_context, scene, NULL, 1, &setup));
    test_done(brc_setup_simulations(test_context, &(brc_device_request){.selector = "cpu", .n_threads = 1}, &setup));
    const int64_t planned = brc_simulation_planned_bytes(setup.simulation[0]);
    test_done(brc_simulation_begin_stage(setup.simulation[0], 1));
    const int64_t held = brc_device_bytes(setup.device[0]);
    assert_true(planned <= held);
    assert_true((double)planned >= 0.75 * (double)held);
    brc_setup_free(&setup);
    brc_scene_free(&scene);
}

/* Two fields of a table in one place are never both there, and names say what is where. */
static void tables_are_sound(void **state)
{
    (void)state;
    const brc_field_table *table;
    for (int t = 0; (table = brc_field_table_at(t)); ++t)
        for (int i = 0; i < table->n; ++i) {
            const brc_field_row *a = &table->fields[i];
            assert_true(a->name[0] && a->what[0] && a->width > 0);
            for (int j = 0; j < i; ++j) {
                const brc_field_row *b = &table->fields[j];
                if (a->at != b->at && strcmp(a->name, b->name) != 0) continue;
                if (!a->wanted || !b->wanted || a->wanted == b->wanted)
                    fail_msg("%s: '%s' and '%s' are in one place", table->owner, a->name, b->name);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(tables_are_sound, test_begin, test_end),
        cmocka_unit_test_setup_teardown(fields_of_every_example_are_all_that_is_held, test_begin, test_end),
        cmocka_unit_test_setup_teardown(fields_of_all_models_and_effects_are_all_that_is_held, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_contact_and_a_stage_add_is_near_the_plan, test_begin, test_end),
        cmocka_unit_test_setup_teardown(fields_are_all_that_is_held_in_lower_precisions, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
