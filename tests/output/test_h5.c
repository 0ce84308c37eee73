#include "support.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/output/h5.h"
#include "../../host/output/h5_read.h"
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

static brc_status write_rows(const char *path, bool in_memory, int64_t rows)
{
    brc_h5 h5;
    double row[200];
    const int64_t version[2] = {1, 0};
    BRC_TRY(in_memory ? brc_h5_create_in_memory(test_context, path, &h5) : brc_h5_create(test_context, path, &h5));
    brc_h5_group(&h5, "group");
    brc_h5_dataset(&h5, "group/table", H5T_NATIVE_DOUBLE, rows, 2, NULL);
    for (int64_t first = 0; first < rows; first += 100) {
        for (int64_t k = 0; k < 200; ++k)
            row[k] = (double)(2 * first + k);
        brc_h5_rows(&h5, "group/table", H5T_NATIVE_DOUBLE, first, 100, row);
    }
    brc_h5_attribute_integers(&h5, "group", "Version", 2, version);
    brc_h5_attribute_text(&h5, "group", "Type", "UnstructuredGrid");
    brc_h5_text(&h5, "text", "");
    return brc_h5_commit(&h5);
}

static void blocks_are_read_back_and_bytes_are_equal_each_time(void **state)
{
    (void)state;
    for (int in_memory = 0; in_memory < 2; ++in_memory) {
        char *folder = test_new_folder();
        brc_h5_read h5;
        double value[4];
        int64_t rows, columns;
        assert_int_equal(write_rows(test_path(folder, "a.h5"), in_memory, 1000), BRC_OK);
        assert_int_equal(write_rows(test_path(folder, "b.h5"), in_memory, 1000), BRC_OK);
        char *a, *b;
        size_t n, m;
        brc_file_read_whole(test_context, test_path(folder, "a.h5"), 1 << 24, &a, &n);
        brc_file_read_whole(test_context, test_path(folder, "b.h5"), 1 << 24, &b, &m);
        assert_int_equal(n, m);
        assert_memory_equal(a, b, n);
        brc_memory_free(a);
        brc_memory_free(b);
        const char *path = test_path(folder, "a.h5");
        assert_int_equal(brc_h5_read_open(test_context, path, &h5), BRC_OK);
        assert_int_equal(brc_h5_read_size(&h5, "group/table", &rows, &columns), BRC_OK);
        assert_true(rows == 1000 && columns == 2);
        assert_int_equal(brc_h5_read_rows(&h5, "group/table", H5T_NATIVE_DOUBLE, 998, 2, value), BRC_OK);
        for (int k = 0; k < 4; ++k)
            assert_true(value[k] == 1996 + k);
        assert_int_equal(brc_h5_read_rows(&h5, "group/table", H5T_NATIVE_DOUBLE, 999, 2, value), BRC_BAD_INPUT);
        assert_int_equal(brc_h5_read_size(&h5, "group/none", &rows, &columns), BRC_BAD_INPUT);
        assert_non_null(strstr(brc_context_message(test_context), "group/none is missing"));
        brc_context_clear(test_context);
        brc_h5_read_close(&h5);
        test_remove_folder(folder);
    }
}

/* Limits from "not even the head" to "all but the last bytes": HDF5 meets the refusal in every kind of call. */
static void a_refused_write_anywhere_is_one_sentence_and_the_old_file_stays(void **state)
{
    (void)state;
    struct rlimit before, limit;
    char *folder = test_new_folder();
    char path[64]; /* used past the turns of test_path */
    snprintf(path, sizeof path, "%s/a.h5", folder);
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(write_rows(path, false, 100), BRC_OK);
    getrlimit(RLIMIT_FSIZE, &before);
    static const long most[] = {0, 100, 1000, 2000, 5000, 100000, 1600000, 1601500};
    for (int in_memory = 0; in_memory < 2; ++in_memory)
        for (size_t k = 0; k < sizeof most / sizeof most[0]; ++k) {
            limit = before;
            limit.rlim_cur = (rlim_t)most[k];
            setrlimit(RLIMIT_FSIZE, &limit);
            const brc_status status = write_rows(path, in_memory, 100000);
            setrlimit(RLIMIT_FSIZE, &before);
            assert_int_equal(status, BRC_FILE_FAILED);
            assert_non_null(strstr(brc_context_message(test_context), "File too large"));
            assert_null(strchr(brc_context_message(test_context), '\n'));
            brc_context_clear(test_context);
            assert_false(brc_file_exists(test_path(folder, "a.h5.part")));
        }
    brc_h5_read h5;
    int64_t rows, columns;
    assert_int_equal(brc_h5_read_open(test_context, path, &h5), BRC_OK);
    assert_int_equal(brc_h5_read_size(&h5, "group/table", &rows, &columns), BRC_OK);
    assert_int_equal(rows, 100);
    brc_h5_read_close(&h5);
    test_remove_folder(folder);
}

static void a_folder_that_is_not_there_is_named_with_the_reason(void **state)
{
    (void)state;
    for (int in_memory = 0; in_memory < 2; ++in_memory) {
        assert_int_equal(write_rows("no-such-folder/a.h5", in_memory, 100), BRC_FILE_FAILED);
        assert_non_null(strstr(brc_context_message(test_context), "no-such-folder/a.h5"));
        assert_non_null(strstr(brc_context_message(test_context), "No such file or directory"));
        brc_context_clear(test_context);
    }
}

static void what_is_not_hdf5_is_refused(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_h5_read h5;
    const char *path = test_path(folder, "a.h5");
    assert_int_equal(brc_file_write_whole(test_context, path, "text", 4), BRC_OK);
    assert_int_equal(brc_h5_read_open(test_context, path, &h5), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "cannot be opened as an HDF5 file"));
    brc_context_clear(test_context);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_are_read_back_and_bytes_are_equal_each_time),
        cmocka_unit_test(a_refused_write_anywhere_is_one_sentence_and_the_old_file_stays),
        cmocka_unit_test(a_folder_that_is_not_there_is_named_with_the_reason),
        cmocka_unit_test(what_is_not_hdf5_is_refused),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
