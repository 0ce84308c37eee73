/* Errors are told in the order of the text, and misspelt words are guessed, but not wildly. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>
#include "../../host/scene/problem.h"

static const char *const WORDS[] = {"density", "nu", "E", "duration", "steps"};

static const char *guess(const char *found)
{
    return brc_nearest_word(found, 5, WORDS);
}

static void slips_are_guessed(void **state)
{
    (void)state;
    assert_string_equal(guess("densty"), "density");
    assert_string_equal(guess("Density"), "density");
    assert_string_equal(guess("dennsitty"), "density");
    assert_string_equal(guess("mu"), "nu");
    assert_string_equal(guess("step"), "steps");
}

static void other_words_are_not_guessed(void **state)
{
    (void)state;
    assert_null(guess("fracture"));
    assert_null(guess("x"));
    assert_null(guess(""));
    assert_null(guess("a-word-that-is-much-longer-than-any-key-of-a-scene-can-be"));
}

static void problems_are_sorted_by_place_with_overrides_last(void **state)
{
    (void)state;
    static const char *const overrides[] = {"a=1"};
    brc_context *context = brc_context_create();
    brc_problems *problems = NULL;
    assert_int_equal(brc_problems_create(context, "f", 1, overrides, &problems), BRC_OK);
    assert_int_equal(brc_problems_report(problems), BRC_OK);
    brc_problems_add(problems, (brc_mark){1, 0, 0}, "override");
    brc_problems_add(problems, (brc_mark){0, 10, 1}, "third");
    brc_problems_add(problems, (brc_mark){0, 2, 20}, "second, %d", 2);
    brc_problems_add(problems, (brc_mark){0, 2, 3}, "first");
    brc_problems_add(problems, (brc_mark){0, 10, 1}, "fourth, at the place of the third");
    assert_int_equal(brc_problems_count(problems), 5);
    assert_int_equal(brc_problems_report(problems), BRC_BAD_INPUT);
    assert_string_equal(brc_context_message(context), "f:2:3: error: first\n"
                                                      "f:2:20: error: second, 2\n"
                                                      "f:10:1: error: third\n"
                                                      "f:10:1: error: fourth, at the place of the third\n"
                                                      "f: in the override 'a=1': error: override");
    brc_problems_free(&problems);
    assert_null(problems);
    brc_context_free(&context);
}

static void guessing_ends_when_no_more_is_told(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_problems *problems = NULL;
    assert_int_equal(brc_problems_create(context, "f", 0, NULL, &problems), BRC_OK);
    assert_string_equal(brc_problems_nearest(problems, "densty", 5, WORDS), "density");
    for (int i = 0; i < BRC_PROBLEMS_MOST + 3; ++i)
        brc_problems_add(problems, (brc_mark){0, i, 1}, "one");
    assert_null(brc_problems_nearest(problems, "densty", 5, WORDS));
    brc_problems_report(problems);
    assert_non_null(strstr(brc_context_message(context), "f: and 3 more errors"));
    brc_problems_free(&problems);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slips_are_guessed),
        cmocka_unit_test(other_words_are_not_guessed),
        cmocka_unit_test(problems_are_sorted_by_place_with_overrides_last),
        cmocka_unit_test(guessing_ends_when_no_more_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
