#include "../support.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/sensors/history_csv.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static brc_sensor sensors[2] = {{.name = "a,\"b\"", .kind = BRC_SENSOR_REACTION},
                                {.name = "c", .kind = BRC_SENSOR_STRAIN}};
static const brc_scene scene = {.n_sensors = 2, .sensors = sensors};
#define HEAD "stage,step,stage_time,time_s,\"a,\"\"b\"\" [N]\",c [-]\n"

static void begin(const char *path, brc_history **h, brc_history_csv **csv)
{
    assert_int_equal(brc_history_create(test_context, 2, h), BRC_OK);
    assert_int_equal(brc_history_csv_create(test_context, &scene, path, csv), BRC_OK);
}

static brc_status add(brc_history *h, brc_history_csv *csv, int k)
{
    assert_int_equal(brc_history_add(test_context, h, 0, k, k, k, (double[]){k, 2}), BRC_OK);
    return brc_history_csv_add(test_context, csv, h);
}

static void assert_file_is(const char *path, const char *expected)
{
    char *text = test_read(path);
    assert_string_equal(text, expected);
    brc_memory_free(text);
}

static void rows_have_units_all_digits_and_empty_fields_for_missing_values(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    const char *path = test_path(folder, "h.csv");
    brc_history *h;
    brc_history_csv *csv;
    begin(path, &h, &csv);
    assert_file_is(path, HEAD); /* from the first moment */
    brc_history_add(test_context, h, 0, 0, 0, 0, (double[]){0.1, NAN});
    brc_history_add(test_context, h, 1, 7, 0.5, 1.5, (double[]){-1e300, 2});
    assert_int_equal(brc_history_csv_finish(test_context, csv, h), BRC_OK);
    assert_file_is(path, HEAD "0,0,0,0,0.10000000000000001,\n1,7,0.5,1.5,-1.0000000000000001e+300,2\n");
    brc_history_csv_free(&csv);
    assert_null(csv);
    brc_history_free(&h);
    test_remove_folder(folder);
}

static void rows_reach_the_file_within_a_second_and_each_once(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    const char *path = test_path(folder, "h.csv");
    brc_history *h;
    brc_history_csv *csv;
    begin(path, &h, &csv);
    enum { N = 3000 };
    for (int k = 0; k < N; ++k) /* far too fast to write one by one */
        assert_int_equal(add(h, csv, k), BRC_OK);
    usleep(1001000);
    assert_int_equal(add(h, csv, N), BRC_OK);
    char *before = test_read(path);
    int rows = 0, used = 0, step;
    for (const char *line = strchr(before, '\n') + 1; *line; line += used, ++rows) {
        assert_int_equal(sscanf(line, "0,%d,%*d,%*d,%*d,2\n%n", &step, &used), 1);
        assert_int_equal(step, rows);
    }
    assert_int_equal(rows, N + 1);
    assert_int_equal(brc_history_csv_finish(test_context, csv, h), BRC_OK);
    assert_file_is(path, before);
    brc_memory_free(before);
    brc_history_csv_free(&csv);
    brc_history_free(&h);
    test_remove_folder(folder);
}

static void a_full_disk_leaves_whole_rows_and_what_is_missing_may_follow(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    const char *path = test_path(folder, "h.csv");
    brc_history *h;
    brc_history_csv *csv;
    struct rlimit old, small;
    begin(path, &h, &csv);
    brc_history_add(test_context, h, 0, 0, 0, 0, (double[]){0, 2});
    assert_int_equal(brc_history_csv_finish(test_context, csv, h), BRC_OK);
    brc_history_add(test_context, h, 0, 1, 1, 1, (double[]){1, 2});
    /* a limit on the size of files refuses writes just as a full disk does: room for half a row */
    getrlimit(RLIMIT_FSIZE, &old);
    small = (struct rlimit){.rlim_cur = strlen(HEAD) + 12 + 6, .rlim_max = old.rlim_max};
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const brc_status status = brc_history_csv_finish(test_context, csv, h);
    setrlimit(RLIMIT_FSIZE, &old);
    signal(SIGXFSZ, SIG_DFL);
    assert_int_equal(status, BRC_FILE_FAILED);
    assert_non_null(strstr(brc_context_message(test_context), "h.csv: cannot write: File too large"));
    assert_file_is(path, HEAD "0,0,0,0,0,2\n");
    assert_int_equal(brc_history_csv_finish(test_context, csv, h), BRC_OK);
    assert_file_is(path, HEAD "0,0,0,0,0,2\n0,1,1,1,1,2\n");
    brc_history_csv_free(&csv);
    assert_int_equal(brc_history_csv_create(test_context, &scene, test_path(folder, "no/h.csv"), &csv),
                     BRC_FILE_FAILED);
    assert_null(csv);
    brc_history_free(&h);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_have_units_all_digits_and_empty_fields_for_missing_values),
        cmocka_unit_test(rows_reach_the_file_within_a_second_and_each_once),
        cmocka_unit_test(a_full_disk_leaves_whole_rows_and_what_is_missing_may_follow),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
