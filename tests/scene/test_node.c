/* Hostile and broken texts: each ends with one clear sentence at the right place, soon and with little memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include "../../host/base/memory.h"
#include "bad.h"

static void empty_text_is_refused(void **state)
{
    (void)state;
    bad_scene("", "1:1", "the scene is empty");
    bad_scene("# only a comment\n", "1:1", "the scene is empty");
    bad_scene("---\n", "2:1", "found nothing");
    bad_scene("just words\n", "1:1", "expected a map");
    bad_scene("- a\n- b\n", "1:1", "found a list of 2");
}

static void broken_yaml_has_its_place(void **state)
{
    (void)state;
    bad_scene("version: 1\nbodies: [a, b\nstages: 3\n", "3:7", "not YAML");
    bad_scene("version: 1\n\tx: 2\n", "2:1", "not YAML");
    bad_scene("version: \"1\n", "2:1", "not YAML");
}

static void two_documents_are_refused(void **state)
{
    (void)state;
    bad_scene(HEAD STAGES "---\nversion: 1\n", "10:1", "a second document");
}

static void duplicate_keys_are_refused_with_both_places(void **state)
{
    (void)state;
    bad_scene(HEAD STAGES "version: 1\n", "10:1", "duplicate key 'version', given before at 1:1");
    bad_scene(HEAD STAGES "gravity: [0, 0, 0]\ngravity: [0, 0, 0]\ngravity: [0, 0, 0]\n", "12:1",
              "duplicate key 'gravity', given before at 11:1");
    /* the same key spelt with an escape is the same key */
    bad_scene(HEAD STAGES "\"vers\\u0069on\": 1\n", "10:1", "duplicate key 'version'");
}

static void what_is_not_utf8_is_refused_at_its_byte(void **state)
{
    (void)state;
    bad_scene("version: 1\ntitle: caf\xe9\n", "2:11", "byte 0xe9 is not UTF-8");
    bad_scene("title: \xc3\xa9\xc3\xa9\xff\n", "1:10", "byte 0xff"); /* columns count characters, not bytes */
    bad_scene("title: \xc0\x80\n", "1:8", "not UTF-8");              /* overlong */
    bad_scene("title: \xed\xa0\x80\n", "1:8", "not UTF-8");          /* surrogate */
    bad_scene("title: \xf4\x90\x80\x80\n", "1:8", "not UTF-8");      /* beyond Unicode */
    bad_scene("title: \xe2\x82", "1:8", "not UTF-8");                /* cut off */
    bad_scene("\xff\xfev\n", "1:1", "not UTF-8");                    /* UTF-16 */
}

static void control_bytes_are_refused(void **state)
{
    (void)state;
    bad_bytes("version: 1\na\0b: 2\n", 17, "2:2", "control byte 0x00");
    bad_scene("version: 1\ntitle: a\x1b[31mb\n", "2:9", "control byte 0x1b");
    bad_scene(HEAD STAGES "title: \"a\\0b\"\n", "10:8", "control character");
    bad_scene(HEAD STAGES "title: |\n  two\n  lines\n", "10:8", "line break");
}

static void a_byte_order_mark_is_no_error(void **state)
{
    (void)state;
    brc_scene *scene = good_scene("\xef\xbb\xbf" HEAD STAGES);
    brc_scene_free(&scene);
}

static void deep_nesting_is_refused(void **state)
{
    (void)state;
    enum { DEEP = 100000 };
    char *text = malloc(DEEP + 16);
    assert_non_null(text);
    strcpy(text, "title: ");
    memset(text + 7, '[', DEEP);
    bad_bytes(text, 7 + DEEP, "1:71", "nested deeper than 64 levels"); /* the map is the first level */
    free(text);
}

static void aliases_are_copies(void **state)
{
    (void)state;
    brc_scene *scene = good_scene("version: 1\n"
                                  "materials: {a: &m {E: 1 Pa, nu: 0.1, density: 1 kg/m^3}, b: *m}\n"
                                  "bodies: [{domain: d.h5, material: b}]\n" STAGES);
    assert_int_equal(scene->n_materials, 2);
    assert_true(scene->materials[1].poisson == 0.1);
    brc_scene_free(&scene);
}

static void a_billion_laughs_end_soon(void **state)
{
    (void)state;
    char text[2048] = "a0: &a0 [lol, lol, lol, lol, lol, lol, lol, lol, lol, lol]\n";
    for (int i = 1; i < 10; ++i) {
        char line[128];
        snprintf(line, sizeof line, "a%d: &a%d [*a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d]\n", i, i,
                 i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
        strcat(text, line);
    }
    /* a4 has 111 111 values: the second copy of it in a5 is too much. */
    bad_scene(text, "6:15", "leads to more than 250000 values");
}

static void an_alias_of_what_it_stands_in_is_refused(void **state)
{
    (void)state;
    bad_scene("a: &a [1, *a]\n", "1:11", "stands inside what it refers to");
    bad_scene("a: *nobody\n", "1:4", "has no anchor");
    bad_scene("a: &a 1\n*a : 2\n", "2:1", "a key must be a plain word");
    bad_scene("[1, 2]: 3\n", "1:1", "a key must be a plain word");
}

static void tags_are_refused(void **state)
{
    (void)state;
    bad_scene("version: !!int 1\n", "1:10", "tags");
    bad_scene("version: !python/object {}\n", "1:10", "tags");
    bad_scene("a: !!seq [1]\n", "1:4", "tags");
}

static void long_lists_are_refused(void **state)
{
    (void)state;
    char *text = malloc(1 << 17);
    assert_non_null(text);
    strcpy(text, HEAD "stages: [");
    size_t at = strlen(text);
    for (int i = 0; i < 4097; ++i)
        at += (size_t)sprintf(text + at, "a, ");
    strcpy(text + at, "]\n");
    bad_scene(text, "9:9", "has 4097 items, at most 4096 are read");
    free(text);
}

static void many_errors_are_counted_but_not_all_told(void **state)
{
    (void)state;
    char *text = malloc(1 << 17);
    assert_non_null(text);
    size_t at = (size_t)sprintf(text, HEAD STAGES);
    for (int i = 0; i < 1000; ++i)
        at += (size_t)sprintf(text + at, "unknown%d: 1\n", i);
    assert_int_equal(count_errors(text), 100);
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    brc_scene_read_text(context, "s.yaml", text, strlen(text), 0, NULL, &scene);
    assert_non_null(strstr(brc_context_message(context), "and 900 more errors"));
    brc_context_free(&context);
    free(text);
}

/* Processor time [s]: other programs do not count. */
static double processor_s(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Thousands of names that do not exist, against thousands that do: nothing may grow with their product and more. */
static void a_large_wrong_scene_is_refused_soon(void **state)
{
    (void)state;
    enum { SETS = 4000, STAGES_MANY = 4, LOADS = 4000 };
    char *text = malloc((size_t)1 << 21);
    assert_non_null(text);
    size_t at =
        (size_t)sprintf(text, "version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\n"
                              "bodies: [{shape: {sphere: {radius: 1 m}}, fill: {noisy_grid: {elements: 9}}}]\nsets:\n");
    for (int i = 0; i < SETS; ++i)
        at += (size_t)sprintf(text + at, "  set_number_%d: {faces: surface}\n", i);
    at += (size_t)sprintf(text + at, "stages:\n");
    for (int k = 0; k < STAGES_MANY; ++k) {
        at += (size_t)sprintf(text + at, "  - name: s%d\n    solver: static\n    loads:\n", k);
        for (int i = 0; i < LOADS; ++i)
            at += (size_t)sprintf(text + at, "      - pressure: {set: sett_number_%d, value: 1 Pa}\n", i + 3);
    }
    const double before = processor_s();
    assert_int_equal(count_errors(text), 100);
    assert_true(processor_s() - before < 20); /* half a second; minutes if every name were guessed */
    free(text);
}

/* A sparse file costs the disk nothing; reading it would cost a gigabyte and seconds. */
static void a_gigabyte_of_zeros_is_refused_without_reading_it(void **state)
{
    (void)state;
    char path[] = "zeros-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_int_equal(ftruncate(file, (off_t)1 << 30), 0);
    close(file);
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    const double before = processor_s();
    const int64_t most = brc_memory_peak();
    assert_int_equal(brc_scene_read(context, path, 0, NULL, &scene), BRC_BAD_INPUT);
    assert_true(processor_s() - before < 0.5); /* reading it takes longer on any machine of today */
    assert_true(brc_memory_peak() - most < (int64_t)1 << 26);
    assert_non_null(strstr(brc_context_message(context), "1073741824 bytes"));
    assert_null(scene);
    /* Within the limit it is read, and refused at the first byte. */
    assert_int_equal(truncate(path, 1 << 20), 0);
    brc_context_clear(context);
    assert_int_equal(brc_scene_read(context, path, 0, NULL, &scene), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(context), ":1:1: error: the control byte 0x00"));
    unlink(path);
    brc_context_free(&context);
}

static void more_text_than_the_limit_is_refused(void **state)
{
    (void)state;
    const size_t bytes = ((size_t)16 << 20) + 1;
    char *text = malloc(bytes);
    assert_non_null(text);
    memset(text, '#', bytes);
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    assert_int_equal(brc_scene_read_text(context, "s.yaml", text, bytes, 0, NULL, &scene), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(context), "at most 16777216"));
    brc_context_free(&context);
    free(text);
}

static void what_is_no_file_is_refused(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    assert_int_equal(brc_scene_read(context, "there-is-no-such-scene.yaml", 0, NULL, &scene), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(context), "there-is-no-such-scene.yaml"));
    assert_int_equal(brc_scene_read(context, ".", 0, NULL, &scene), BRC_BAD_INPUT);
    assert_null(scene);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_text_is_refused),
        cmocka_unit_test(broken_yaml_has_its_place),
        cmocka_unit_test(two_documents_are_refused),
        cmocka_unit_test(duplicate_keys_are_refused_with_both_places),
        cmocka_unit_test(what_is_not_utf8_is_refused_at_its_byte),
        cmocka_unit_test(control_bytes_are_refused),
        cmocka_unit_test(a_byte_order_mark_is_no_error),
        cmocka_unit_test(deep_nesting_is_refused),
        cmocka_unit_test(aliases_are_copies),
        cmocka_unit_test(a_billion_laughs_end_soon),
        cmocka_unit_test(an_alias_of_what_it_stands_in_is_refused),
        cmocka_unit_test(tags_are_refused),
        cmocka_unit_test(long_lists_are_refused),
        cmocka_unit_test(many_errors_are_counted_but_not_all_told),
        cmocka_unit_test(a_large_wrong_scene_is_refused_soon),
        cmocka_unit_test(a_gigabyte_of_zeros_is_refused_without_reading_it),
        cmocka_unit_test(more_text_than_the_limit_is_refused),
        cmocka_unit_test(what_is_no_file_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
