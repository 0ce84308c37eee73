#include "support.h"
#include "../../host/base/log.h"
#include <stdio.h>
#include <string.h>

static void codes_have_the_promised_exit_codes(void **state)
{
    (void)state;
    assert_int_equal(brc_status_exit_code(BRC_OK), 0);
    assert_int_equal(brc_status_exit_code(BRC_PHYSICS_STOPPED), 1);
    assert_int_equal(brc_status_exit_code(BRC_BOUND_MISSED), 1);
    assert_int_equal(brc_status_exit_code(BRC_BAD_INPUT), 2);
    assert_int_equal(brc_status_exit_code(BRC_NO_MEMORY), 3);
    assert_int_equal(brc_status_exit_code(BRC_FILE_FAILED), 3);
    assert_string_equal(brc_status_text(BRC_NO_MEMORY), "out of memory");
}

static void an_unknown_code_is_still_answered(void **state)
{
    (void)state;
    assert_string_equal(brc_status_text((brc_status)999), "unknown status code");
    assert_int_equal(brc_status_exit_code((brc_status)999), 3);
}

static void a_new_context_has_no_message(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    assert_string_equal(brc_context_message(context), "");
    brc_context_free(&context);
    assert_null(context);
    brc_context_free(&context);
    brc_context_free(NULL);
}

static void failures_gather_line_by_line_and_give_their_code(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    assert_int_equal(BRC_FAIL(context, BRC_BAD_INPUT, "bond %d: rest length 0 m, must be > 0", 17), BRC_BAD_INPUT);
    assert_string_equal(brc_context_message(context), "bond 17: rest length 0 m, must be > 0");
    assert_int_equal(BRC_FAIL(context, BRC_FILE_FAILED, "second"), BRC_FILE_FAILED);
    assert_string_equal(brc_context_message(context), "bond 17: rest length 0 m, must be > 0\nsecond");
    brc_context_clear(context);
    assert_string_equal(brc_context_message(context), "");
    assert_int_equal(BRC_FAIL(context, BRC_INTERNAL, "third"), BRC_INTERNAL);
    assert_string_equal(brc_context_message(context), "third");
    brc_context_free(&context);
}

static void a_failure_without_context_still_gives_its_code(void **state)
{
    (void)state;
    assert_int_equal(BRC_FAIL(NULL, BRC_NO_MEMORY, "no place for this sentence"), BRC_NO_MEMORY);
    assert_string_equal(brc_context_message(NULL), "");
    brc_context_clear(NULL);
}

static void endless_failures_do_not_eat_the_memory(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    char sentence[1001];
    memset(sentence, 'x', 1000);
    sentence[1000] = '\0';
    for (int k = 0; k < 5000; ++k)
        assert_int_equal(BRC_FAIL(context, BRC_BAD_INPUT, "%s", sentence), BRC_BAD_INPUT);
    const size_t length = strlen(brc_context_message(context));
    assert_true(length >= 1000000); /* 1 MiB less one sentence at most */
    assert_true(length <= 1 << 20);
    brc_context_free(&context);
}

static void the_place_is_told_at_level_debug_alone(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    test_catch_stderr();
    BRC_FAIL(context, BRC_BAD_INPUT, "quiet");
    brc_log_set_level(context, BRC_LOG_DEBUG);
    BRC_FAIL(context, BRC_BAD_INPUT, "loud");
    const char *text = test_caught_stderr();
    assert_null(strstr(text, "quiet"));
    assert_non_null(strstr(text, "loud"));
    assert_non_null(strstr(text, "test_status.c:"));
    brc_context_free(&context);
}

static brc_status try_hands_upward(brc_context *context, bool *reached)
{
    BRC_TRY(BRC_OK);
    BRC_TRY(BRC_FAIL(context, BRC_DEVICE_FAILED, "no device"));
    *reached = true;
    return BRC_OK;
}

static brc_status try_or_cleans(brc_context *context, bool *cleaned)
{
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_OK);
    BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_DEVICE_FAILED, "no device"));
    status = BRC_INTERNAL;
cleanup:
    *cleaned = true;
    return status;
}

static void try_returns_the_first_failure(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    bool reached = false;
    bool cleaned = false;
    assert_int_equal(try_hands_upward(context, &reached), BRC_DEVICE_FAILED);
    assert_false(reached);
    assert_int_equal(try_or_cleans(context, &cleaned), BRC_DEVICE_FAILED);
    assert_true(cleaned);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_have_the_promised_exit_codes),
        cmocka_unit_test(an_unknown_code_is_still_answered),
        cmocka_unit_test(a_new_context_has_no_message),
        cmocka_unit_test(failures_gather_line_by_line_and_give_their_code),
        cmocka_unit_test(a_failure_without_context_still_gives_its_code),
        cmocka_unit_test(endless_failures_do_not_eat_the_memory),
        cmocka_unit_test(the_place_is_told_at_level_debug_alone),
        cmocka_unit_test(try_returns_the_first_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
