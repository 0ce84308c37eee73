#include "support.h"
#include "../../host/base/memory.h"
#include "../../host/output/text.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *json_of(brc_json *json, char *folder)
{
    static char text[4096];
    assert_int_equal(brc_json_write(json, test_path(folder, "a.json")), BRC_OK);
    char *read = test_read(test_path(folder, "a.json"));
    strncpy(text, read, sizeof text - 1);
    brc_memory_free(read);
    test_remove_folder(folder);
    return text;
}

static void numbers_read_back_to_the_same_double(void **state)
{
    (void)state;
    const double value[] = {0.1, 1.0 / 3, 1e-300, 6.02214076e23, -5e-324, 123456789012345678.0, 0.30000000000000004};
    for (size_t k = 0; k < sizeof value / sizeof value[0]; ++k) {
        brc_text text = {.context = test_context};
        brc_text_add_number(&text, value[k]);
        assert_true(strtod(text.data, NULL) == value[k]);
        brc_text_free(&text);
    }
    brc_text text = {.context = test_context};
    brc_text_add_number(&text, 0.1);
    assert_string_equal(text.data, "0.1");
    brc_text_free(&text);
}

static void nested_objects_and_arrays_are_closed_and_separated(void **state)
{
    (void)state;
    brc_json json = {.text = {.context = test_context}};
    brc_json_begin_object(&json, NULL);
    brc_json_begin_array(&json, "a");
    brc_json_integer(&json, NULL, -9007199254740993);
    brc_json_boolean(&json, NULL, true);
    brc_json_end(&json);
    brc_json_begin_object(&json, "empty");
    brc_json_end(&json);
    brc_json_null(&json, "n");
    assert_string_equal(json_of(&json, test_new_folder()),
                        "{\n  \"a\": [\n    -9007199254740993,\n    true\n  ],\n  \"empty\": {},\n  \"n\": null\n}\n");
}

static void numbers_that_are_not_finite_are_null(void **state)
{
    (void)state;
    brc_json json = {.text = {.context = test_context}};
    brc_json_begin_array(&json, NULL);
    brc_json_number(&json, NULL, NAN);
    brc_json_number(&json, NULL, -INFINITY);
    brc_json_number(&json, NULL, -0.5);
    assert_string_equal(json_of(&json, test_new_folder()), "[\n  null,\n  null,\n  -0.5\n]\n");
}

static void strings_are_escaped_and_always_utf8(void **state)
{
    (void)state;
    static const struct {
        const char *in, *out;
    } one[] = {{"a\"b\\c\n\t\x01\x7f", "\"a\\\"b\\\\c\\n\\t\\u0001\\u007f\""},
               {"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x8e\x88", "\"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x8e\x88\""},
               {"\xff", "\"\\ufffd\""},
               {"\xc3", "\"\\ufffd\""},                       /* cut off */
               {"\xc0\xaf", "\"\\ufffd\\ufffd\""},            /* overlong */
               {"\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\""}, /* a surrogate */
               {"\xf4\x90\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\""}};
    for (size_t k = 0; k < sizeof one / sizeof one[0]; ++k) {
        brc_json json = {.text = {.context = test_context}};
        char expected[128];
        brc_json_begin_array(&json, NULL);
        brc_json_string(&json, NULL, one[k].in);
        snprintf(expected, sizeof expected, "[\n  %s\n]\n", one[k].out);
        assert_string_equal(json_of(&json, test_new_folder()), expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_read_back_to_the_same_double),
        cmocka_unit_test(nested_objects_and_arrays_are_closed_and_separated),
        cmocka_unit_test(numbers_that_are_not_finite_are_null),
        cmocka_unit_test(strings_are_escaped_and_always_utf8),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
