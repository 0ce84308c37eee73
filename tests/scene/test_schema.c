/* Every entry of the schema table, each in a scene made from the table: valid as its sample, refused with the right
 * line and column as anything else. Nothing here names a key except where a scene could not be made without. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "../../host/scene/scene_reader.h"
#include "sample.h"

typedef struct count {
    int entries, scenes;
} count;

static const char *leaf_unit(const sample_path *path)
{
    const brc_entry *entry = path->chain[path->depth - 1];
    const char *unit = entry->unit ? entry->unit : "";
    if (unit[0] != '@') return unit;
    for (int i = 0; i < path->depth; ++i) {
        const char *key = path->chain[i]->key;
        if (strcmp(unit, BRC_UNIT_MEASURE) == 0) {
            if (strcmp(key, "E") == 0 || strcmp(key, "K") == 0 || strcmp(key, "G") == 0) return "Pa";
            if (strcmp(key, "frequency") == 0) return "Hz";
            if (strcmp(key, "rate") == 0) return "N/s";
            if (strcmp(key, "duration") == 0) return "s";
            if (strcmp(key, "peak") == 0 || strcmp(key, "at_first_break") == 0 || strcmp(key, "mean") == 0) return "N";
        } else if (strcmp(key, "frequency") == 0 || strcmp(key, "rate") == 0 || strcmp(key, "duration") == 0) {
            return "s";
        }
    }
    return "";
}

static bool path_has(const sample_path *path, const char *key)
{
    for (int i = 0; i < path->depth; ++i)
        if (strcmp(path->chain[i]->key, key) == 0) return true;
    return false;
}

/* Elements have no normal, a half-space alone no end, a noisy grid no spheres and so no model of beams, a plane no
 * mass, one radius or factor is no distribution, and events know no contact, which all samples have: no valid scene
 * made of samples alone contains these entries there. tests/scene/test_reader_check.c and test_fracture_keys.c read
 * valid ones. */
static bool cannot_be_valid(const sample_path *path)
{
    return path_has(path, "opening") || path_has(path, "jaws") ||
           (path_has(path, "regions") && path_has(path, "body")) ||
           (path_has(path, "striker") && path_has(path, "against")) || path_has(path, "beams") ||
           path_has(path, "events") || path_has(path, "element_rotation") || /* elements of dlsm have none */
           (path_has(path, "strikers") && path_has(path, "free")) || path_has(path, "radii") || path_has(path, "cbm") ||
           (path_has(path, "scatter") && path_has(path, "table")) ||
           (path->depth == 2 && path_has(path, "fracture") && path_has(path, "friction")) || /* samples have contact */
           path_has(path,
                    "shear_fracture_energy") || /* stands beside fracture_energy; solver/test_sliding.c reads it */
           (path_has(path, "half_space") && path_has(path, "parts")) ||
           (path_has(path, "normal") && !path_has(path, "faces") && !path_has(path, "half_space") &&
            !path_has(path, "disc"));
}

static brc_status read_scene(brc_context *context, const sample_scene *sample)
{
    brc_scene *scene = NULL;
    brc_context_clear(context);
    const brc_status status =
        brc_scene_read_text(context, "scene.yaml", sample->text, (size_t)sample->length, 0, NULL, &scene);
    if (status != BRC_OK) assert_null(scene);
    brc_scene_free(&scene);
    return status;
}

/* The scene must be refused, with an error at `column_offset` columns after the marked place. */
static void expect_refusal(const sample_path *path, sample_fault fault, const char *value, int column_offset,
                           count *counted)
{
    static sample_scene sample;
    char wanted[64], name[256];
    sample_make(path, fault, value, &sample);
    brc_context *context = brc_context_create();
    const brc_status status = read_scene(context, &sample);
    snprintf(wanted, sizeof wanted, "scene.yaml:%d:%d: error: ", sample.line, sample.column + column_offset);
    if (status != BRC_BAD_INPUT || !strstr(brc_context_message(context), wanted))
        fail_msg("%s, fault %d, '%s': expected %s\ngot status %d: %s\n%s", sample_path_text(path, name, sizeof name),
                 (int)fault, value ? value : "", wanted, (int)status, brc_context_message(context), sample.text);
    brc_context_free(&context);
    ++counted->scenes;
}

static void value_refused(const sample_path *path, const char *value, count *counted)
{
    expect_refusal(path, SAMPLE_VALUE, value, 0, counted);
}

static void sample_is_accepted(const sample_path *path, void *data)
{
    static sample_scene sample;
    char name[256];
    count *counted = data;
    ++counted->entries;
    if (cannot_be_valid(path)) return;
    sample_make(path, SAMPLE_VALID, NULL, &sample);
    brc_context *context = brc_context_create();
    if (read_scene(context, &sample) != BRC_OK)
        fail_msg("%s: %s\n%s", sample_path_text(path, name, sizeof name), brc_context_message(context), sample.text);
    brc_context_free(&context);
    ++counted->scenes;
}

static void wrong_type_is_refused(const sample_path *path, void *data)
{
    count *counted = data;
    switch (path->chain[path->depth - 1]->type) {
    case BRC_TYPE_QUANTITY:
    case BRC_TYPE_INTEGER:
        value_refused(path, "[1, 2]", counted);
        value_refused(path, "{a: 1}", counted);
        value_refused(path, "word", counted);
        value_refused(path, "\"\"", counted);
        value_refused(path, "nan", counted);
        value_refused(path, "0x10", counted);
        value_refused(path, "1e999", counted);
        break;
    case BRC_TYPE_VECTOR:
    case BRC_TYPE_DIRECTION:
    case BRC_TYPE_INTEGERS:
        value_refused(path, "word", counted);
        value_refused(path, "[0, 0, 0, 0, 0]", counted);
        expect_refusal(path, SAMPLE_VALUE, path->chain[path->depth - 1]->length == 2 ? "[x, 0]" : "[x, 0, 0]", 1,
                       counted);
        break;
    case BRC_TYPE_BOOL:
        value_refused(path, "yes", counted);
        value_refused(path, "1", counted);
        value_refused(path, "[true]", counted);
        break;
    case BRC_TYPE_STRING:
        value_refused(path, "[a]", counted);
        value_refused(path, "\"\"", counted);
        break;
    case BRC_TYPE_NAME:
        value_refused(path, "[a]", counted);
        value_refused(path, "two words", counted);
        value_refused(path, "a.b", counted);
        value_refused(path, "x1234567890123456789012345678901234567890123456789012345678901234567890", counted);
        if (path->chain[path->depth - 1]->refers) value_refused(path, "nobody-has-this-name", counted);
        break;
    case BRC_TYPE_WORD:
    case BRC_TYPE_CHOICE:
    case BRC_TYPE_MATERIAL:
        value_refused(path, "[a]", counted);
        value_refused(path, "no-such-word", counted);
        break;
    case BRC_TYPE_TABLE:
        value_refused(path, "3", counted);
        value_refused(path, "[]", counted);
        expect_refusal(path, SAMPLE_VALUE, "[3]", 1, counted);
        expect_refusal(path, SAMPLE_VALUE, "[[0, x]]", 5, counted);
        expect_refusal(path, SAMPLE_VALUE, "[[0, 1], [0, 2]]", 10, counted);
        break;
    case BRC_TYPE_STRUCT: value_refused(path, "[1, 2]", counted); break;
    case BRC_TYPE_LIST:
    case BRC_TYPE_NAMED: value_refused(path, "17", counted); break;
    }
}

static void wrong_unit_is_refused(const sample_path *path, void *data)
{
    const brc_entry *entry = path->chain[path->depth - 1];
    const char *unit = leaf_unit(path);
    count *counted = data;
    switch (entry->type) {
    case BRC_TYPE_QUANTITY:
    case BRC_TYPE_INTEGER:
        value_refused(path, "1 kg^3/rad", counted);
        value_refused(path, "1 lightyear", counted);
        value_refused(path, "1 Pa GPa GPa, or so", counted);
        if (unit[0]) value_refused(path, "1", counted);
        break;
    case BRC_TYPE_VECTOR:
    case BRC_TYPE_DIRECTION:
    case BRC_TYPE_INTEGERS:
        expect_refusal(path, SAMPLE_VALUE, entry->length == 2 ? "[1 kg^3/rad, 0]" : "[1 kg^3/rad, 0, 0]", 1, counted);
        if (unit[0]) expect_refusal(path, SAMPLE_VALUE, entry->length == 2 ? "[1, 0]" : "[1, 0, 0]", 1, counted);
        break;
    case BRC_TYPE_TABLE:
        expect_refusal(path, SAMPLE_VALUE, "[[1 kg^3, 1]]", 2, counted);
        expect_refusal(path, SAMPLE_VALUE, "[[0, 1 Pa]]", 5, counted);
        break;
    default: break;
    }
}

static void out_of_range(const sample_path *path, double value, count *counted)
{
    const brc_entry *entry = path->chain[path->depth - 1];
    const char *unit = leaf_unit(path);
    char text[128];
    if (entry->type == BRC_TYPE_VECTOR && entry->length == 2)
        snprintf(text, sizeof text, "[%.17g %s, 0]", value, unit);
    else if (entry->type == BRC_TYPE_VECTOR)
        snprintf(text, sizeof text, "[%.17g %s, 0, 0]", value, unit);
    else if (entry->type == BRC_TYPE_INTEGERS)
        snprintf(text, sizeof text, "[%.17g, 1, 1]", value);
    else
        snprintf(text, sizeof text, "%.17g %s", value, unit);
    expect_refusal(path, SAMPLE_VALUE, text, text[0] == '[', counted);
}

static void out_of_range_is_refused(const sample_path *path, void *data)
{
    const brc_entry *entry = path->chain[path->depth - 1];
    if (!brc_entry_has_range(entry)) return;
    const brc_range range = entry->range;
    out_of_range(path, range.low - 1 - fabs(range.low), data);
    if (range.low_open) out_of_range(path, range.low, data);
    if (isinf(range.high)) return;
    out_of_range(path, range.high + 1 + fabs(range.high), data);
    if (range.high_open) out_of_range(path, range.high, data);
}

static void duplicate_is_refused(const sample_path *path, void *data)
{
    expect_refusal(path, SAMPLE_DUPLICATE, NULL, 0, data);
}

static void missing_is_refused(const sample_path *path, void *data)
{
    if (path->chain[path->depth - 1]->required) expect_refusal(path, SAMPLE_MISSING, NULL, 0, data);
}

static void unknown_is_refused(const sample_path *path, void *data)
{
    const int i = path->depth - 1;
    const brc_section *section = i > 0 ? path->chain[i - 1]->section : brc_schema();
    /* In a one-of the complaint is about several keys, at the map, which begins at this first key. */
    expect_refusal(path, SAMPLE_UNKNOWN, NULL, 0, data);
    assert_non_null(section);
}

static int visit_all(void (*visit)(const sample_path *path, void *data))
{
    count counted = {0, 0};
    sample_visit(visit, &counted);
    print_message("%d scenes\n", counted.scenes);
    return counted.scenes;
}

static void every_entry_accepts_its_sample(void **state)
{
    (void)state;
    assert_true(visit_all(sample_is_accepted) > 100); /* the table has some hundred entries */
}
static void every_entry_refuses_a_wrong_type(void **state)
{
    (void)state;
    assert_true(visit_all(wrong_type_is_refused) > 300);
}
static void every_entry_refuses_a_wrong_unit(void **state)
{
    (void)state;
    assert_true(visit_all(wrong_unit_is_refused) > 100);
}
static void every_entry_refuses_what_is_out_of_range(void **state)
{
    (void)state;
    assert_true(visit_all(out_of_range_is_refused) > 50);
}
static void every_entry_refuses_a_duplicate(void **state)
{
    (void)state;
    assert_true(visit_all(duplicate_is_refused) > 100);
}
static void every_required_entry_is_missed(void **state)
{
    (void)state;
    assert_true(visit_all(missing_is_refused) > 30);
}
static void every_section_refuses_an_unknown_key(void **state)
{
    (void)state;
    assert_true(visit_all(unknown_is_refused) > 100);
}

/* Defaults and samples are texts; a slip in the table shows here and not at a user's. */
static void check_entry(const sample_path *path, void *data)
{
    const brc_entry *entry = path->chain[path->depth - 1];
    char name[256];
    (void)data;
    sample_path_text(path, name, sizeof name);
    if (!entry->meaning || !entry->meaning[0]) fail_msg("%s has no meaning", name);
    if (entry->required && entry->given) fail_msg("%s is required and has a default", name);
    if (entry->given && strchr("[", entry->given[0])) fail_msg("%s: defaults are single values or {}", name);
    if (entry->type == BRC_TYPE_VECTOR && (entry->length < 2 || entry->length > 3)) fail_msg("%s: length", name);
    if (entry->type == BRC_TYPE_INTEGER && !brc_entry_has_range(entry)) fail_msg("%s: integers need a range", name);
    if (entry->type == BRC_TYPE_INTEGER && entry->size == 4 && entry->range.high > 2147483647.0)
        fail_msg("%s: range beyond int32", name);
}

static void table_is_sound(void **state)
{
    (void)state;
    sample_visit(check_entry, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_is_sound),
        cmocka_unit_test(every_entry_accepts_its_sample),
        cmocka_unit_test(every_entry_refuses_a_wrong_type),
        cmocka_unit_test(every_entry_refuses_a_wrong_unit),
        cmocka_unit_test(every_entry_refuses_what_is_out_of_range),
        cmocka_unit_test(every_entry_refuses_a_duplicate),
        cmocka_unit_test(every_required_entry_is_missed),
        cmocka_unit_test(every_section_refuses_an_unknown_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
