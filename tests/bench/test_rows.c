#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "../../bench/rows.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"

static brc_rows two_rows(brc_context *context)
{
    brc_rows rows = {.context = context};
    brc_rows_begin(&rows);
    brc_rows_text(&rows, "case", "a \"quoted\", word");
    brc_rows_number(&rows, "ours", 0.1);
    brc_rows_begin(&rows);
    brc_rows_integer(&rows, "elements", 1000);
    brc_rows_number(&rows, "ours", NAN);
    brc_rows_number(&rows, "ours", 2);
    brc_rows_number(&rows, "paper", NAN);
    return rows;
}

/* The text of a file that the two rows are written into; freed by brc_memory_free. */
static char *written(brc_context *context, const char *name)
{
    brc_rows rows = two_rows(context);
    char folder[] = "rows-test-XXXXXX", path[64], *text;
    size_t bytes;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(brc_rows_write(&rows, folder), BRC_OK);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(brc_file_read_whole(context, path, 10000, &text, &bytes), BRC_OK);
    snprintf(path, sizeof path, "rm -r %s", folder);
    assert_int_equal(system(path), 0);
    brc_rows_free(&rows);
    return text;
}

static void csv_has_the_keys_of_all_rows_and_empty_fields_for_what_is_missing(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    char *text = written(context, "rows.csv");
    assert_string_equal(text, "case,ours,elements,paper\n\"a \"\"quoted\"\", word\",0.1,,\n,2,1000,\n");
    brc_memory_free(text);
    brc_context_free(&context);
}

static void json_is_an_array_of_objects_with_null_for_what_is_no_number(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    char *text = written(context, "rows.json");
    assert_int_equal(text[0], '[');
    assert_non_null(strstr(text, "\"a \\\"quoted\\\", word\""));
    assert_non_null(strstr(text, "\"paper\": null"));
    assert_non_null(strstr(text, "\"elements\": 1000"));
    brc_memory_free(text);
    brc_context_free(&context);
}

static void a_field_given_again_is_replaced(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_rows rows = two_rows(context);
    assert_int_equal(rows.rows[1].n_fields, 3);
    assert_true(brc_row_find(&rows.rows[1], "ours")->number == 2);
    assert_null(brc_row_find(&rows.rows[1], "case"));
    brc_rows_free(&rows);
    brc_context_free(&context);
}

static void too_many_fields_are_a_failure_told_when_writing(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_rows rows = {.context = context};
    brc_rows_begin(&rows);
    for (int k = 0; k <= BRC_FIELDS_MOST; ++k) {
        char key[16];
        snprintf(key, sizeof key, "k%d", k);
        brc_rows_integer(&rows, key, k);
    }
    assert_int_equal(brc_rows_write(&rows, "nowhere"), BRC_INTERNAL);
    assert_false(brc_file_exists("nowhere"));
    brc_rows_free(&rows);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_has_the_keys_of_all_rows_and_empty_fields_for_what_is_missing),
        cmocka_unit_test(json_is_an_array_of_objects_with_null_for_what_is_no_number),
        cmocka_unit_test(a_field_given_again_is_replaced),
        cmocka_unit_test(too_many_fields_are_a_failure_told_when_writing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
