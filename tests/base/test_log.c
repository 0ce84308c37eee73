#include "support.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include <string.h>
#include <time.h>

static int begin(void **state)
{
    *state = brc_context_create();
    return *state ? 0 : -1;
}

static int end(void **state)
{
    brc_context_free((brc_context **)state);
    return 0;
}

static int count_lines(const char *text)
{
    int n = 0;
    for (; *text; ++text)
        n += *text == '\n';
    return n;
}

static void levels_above_the_chosen_one_are_silent(void **state)
{
    brc_context *context = *state;
    assert_int_equal(brc_log_get_level(context), BRC_LOG_INFO);
    test_catch_stderr();
    brc_log(context, BRC_LOG_INFO, "told %d", 1);
    brc_log(context, BRC_LOG_DEBUG, "not told");
    brc_log_set_level(context, BRC_LOG_ERROR);
    brc_log(context, BRC_LOG_WARNING, "not told either");
    brc_log(context, BRC_LOG_ERROR, "bad");
    brc_log(NULL, BRC_LOG_ERROR, "nobody");
    assert_string_equal(test_caught_stderr(), "told 1\nerror: bad\n");
}

static void a_quick_task_in_a_pipe_is_silent(void **state)
{
    brc_context *context = *state;
    const int64_t before = brc_memory_held();
    brc_progress *progress;
    test_catch_stderr();
    assert_int_equal(brc_progress_create(context, &progress, "stage pull", 1000, "steps", 60000.0, "bond updates/s"),
                     BRC_OK);
    for (int k = 1; k <= 1000; ++k)
        brc_progress_update(progress, k);
    brc_progress_finish(&progress);
    assert_string_equal(test_caught_stderr(), ""); /* a thousand updates take far less than 1 s */
    assert_null(progress);
    brc_progress_finish(&progress);
    brc_progress_finish(NULL);
    assert_int_equal(brc_memory_held(), before);
}

static void a_slow_task_in_a_pipe_tells_rate_and_time_left(void **state)
{
    brc_context *context = *state;
    brc_progress *progress;
    test_catch_stderr();
    assert_int_equal(brc_progress_create(context, &progress, "cells", 4, "cells", 60000.0, "bond updates/s"), BRC_OK);
    const struct timespec longer_than_one_second = {1, 20000000};
    nanosleep(&longer_than_one_second, NULL);
    brc_progress_update(progress, 1);
    brc_progress_update(progress, 4);
    brc_progress_finish(&progress);
    const char *text = test_caught_stderr();
    assert_int_equal(count_lines(text), 2);
    assert_non_null(strstr(text, "cells: 25 % (1 of 4 cells)"));
    assert_non_null(strstr(text, "cells: 100 % (4 of 4 cells)"));
    assert_non_null(strstr(text, "bond updates/s"));
    assert_null(strchr(text, '\033')); /* no terminal, no control characters */
    assert_non_null(strstr(text, ", left "));
}

static void a_task_without_known_end_shows_neither_percent_nor_time_left(void **state)
{
    brc_context *context = *state;
    brc_progress *progress;
    test_catch_stderr();
    assert_int_equal(brc_progress_create(context, &progress, "pull", 0, "iterations", 0.0, NULL), BRC_OK);
    const struct timespec longer_than_one_second = {1, 20000000};
    nanosleep(&longer_than_one_second, NULL);
    brc_progress_update(progress, 17); /* no part of anything: a line only every ten seconds */
    brc_progress_finish(&progress);
    const char *text = test_caught_stderr();
    assert_int_equal(count_lines(text), 2);
    assert_non_null(strstr(text, "pull: 17 iterations, "));
    assert_null(strchr(text, '%'));
    assert_null(strstr(text, "left"));
}

static void progress_is_silent_below_level_info(void **state)
{
    brc_context *context = *state;
    brc_log_set_level(context, BRC_LOG_WARNING);
    brc_progress *progress;
    test_catch_stderr();
    assert_int_equal(brc_progress_create(context, &progress, "quiet", 1, "steps", 0.0, NULL), BRC_OK);
    brc_progress_update(progress, 1);
    brc_progress_finish(&progress);
    assert_string_equal(test_caught_stderr(), "");
}

static void the_clock_does_not_run_backwards(void **state)
{
    (void)state;
    double last = brc_clock_s();
    for (int k = 0; k < 1000; ++k) {
        const double now = brc_clock_s();
        assert_true(now >= last);
        last = now;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(levels_above_the_chosen_one_are_silent, begin, end),
        cmocka_unit_test_setup_teardown(a_quick_task_in_a_pipe_is_silent, begin, end),
        cmocka_unit_test_setup_teardown(a_slow_task_in_a_pipe_tells_rate_and_time_left, begin, end),
        cmocka_unit_test_setup_teardown(a_task_without_known_end_shows_neither_percent_nor_time_left, begin, end),
        cmocka_unit_test_setup_teardown(progress_is_silent_below_level_info, begin, end),
        cmocka_unit_test(the_clock_does_not_run_backwards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
