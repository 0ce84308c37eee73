#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/hdf5_io.h"

#include <stdio.h>
#include <string.h>

static const char path[] = "hdf5_io_under_test.h5";

static void arrays_and_attributes_come_back(void **state)
{
    brc_context *context = *state;
    const int32_t numbers[6] = {-1, 2, INT32_MAX, INT32_MIN, 0, 7};
    const double bounds[2] = {-0.5, 1e300};
    const hid_t file = brc_h5_create_file(path);
    assert_int_equal(brc_h5_write_array(context, file, path, "numbers", BRC_H5_INT32, 2, 3, numbers), BRC_OK);
    assert_int_equal(brc_h5_write_array(context, file, path, "none", BRC_H5_DOUBLE, 0, 1, bounds), BRC_OK);
    assert_int_equal(brc_h5_write_numbers(context, file, path, "bounds", BRC_H5_DOUBLE, 2, bounds), BRC_OK);
    assert_int_equal(brc_h5_write_text(context, file, path, "title", "a text"), BRC_OK);
    void *data;
    char *text;
    int64_t rows;
    double back[2];
    assert_int_equal(brc_h5_read_array(context, file, path, "numbers", BRC_H5_INT32, -1, 3, &data, &rows), BRC_OK);
    assert_int_equal(rows, 2);
    assert_memory_equal(data, numbers, sizeof numbers);
    brc_memory_free(data);
    assert_int_equal(brc_h5_read_array(context, file, path, "none", BRC_H5_DOUBLE, 0, 1, &data, NULL), BRC_OK);
    brc_memory_free(data);
    assert_int_equal(brc_h5_read_numbers(context, file, path, "bounds", BRC_H5_DOUBLE, 2, back), BRC_OK);
    assert_memory_equal(back, bounds, sizeof bounds);
    assert_int_equal(brc_h5_read_text(context, file, path, "title", &text), BRC_OK);
    assert_string_equal(text, "a text");
    brc_memory_free(text);
    H5Fclose(file);
    remove(path);
}

/* The formula of docs/reference/domain.md on the stored words of -1 and 2. */
static void the_checksum_is_the_documented_one(void **state)
{
    brc_context *context = *state;
    const int32_t numbers[2] = {-1, 2};
    const hid_t file = brc_h5_create_file(path);
    assert_int_equal(brc_h5_write_array(context, file, path, "numbers", BRC_H5_INT32, 2, 1, numbers), BRC_OK);
    const uint64_t words[2] = {0xffffffffffffffffu, 2u};
    uint64_t sum = 0x9e3779b97f4a7c15u;
    for (int k = 0; k < 2; ++k) {
        sum = (sum ^ words[k]) * 0xff51afd7ed558ccdu;
        sum ^= sum >> 32;
    }
    int64_t stored;
    const hid_t set = H5Dopen2(file, "numbers", H5P_DEFAULT);
    assert_int_equal(brc_h5_read_numbers(context, set, path, "checksum", BRC_H5_INT64, 1, &stored), BRC_OK);
    assert_true(stored == (int64_t)sum);
    H5Dclose(set);
    H5Fclose(file);
    remove(path);
}

static void wrong_kinds_are_refused_with_path_and_name(void **state)
{
    brc_context *context = *state;
    const double number = 1.0;
    void *data;
    char *text;
    int64_t count;
    brc_h5_voice voice;
    brc_h5_quiet(&voice);
    const hid_t file = brc_h5_create_file(path);
    assert_int_equal(brc_h5_write_array(context, file, path, "x", BRC_H5_DOUBLE, 1, 1, &number), BRC_OK);
    assert_int_equal(brc_h5_write_numbers(context, file, path, "n", BRC_H5_DOUBLE, 1, &number), BRC_OK);
    assert_int_equal(brc_h5_read_array(context, file, path, "x", BRC_H5_INT64, 1, 1, &data, NULL), BRC_BAD_INPUT);
    test_says(context, "hdf5_io_under_test.h5: 'x' has another type, expected 64-bit integers");
    assert_int_equal(brc_h5_read_array(context, file, path, "y", BRC_H5_DOUBLE, 1, 1, &data, NULL), BRC_BAD_INPUT);
    test_says(context, "'y' is missing");
    assert_int_equal(brc_h5_read_numbers(context, file, path, "n", BRC_H5_INT64, 1, &count), BRC_BAD_INPUT);
    assert_int_equal(brc_h5_read_numbers(context, file, path, "m", BRC_H5_INT64, 1, &count), BRC_BAD_INPUT);
    test_says(context, "the attribute 'm' is missing");
    assert_int_equal(brc_h5_read_text(context, file, path, "n", &text), BRC_BAD_INPUT);
    assert_null(text);
    H5Fclose(file);
    brc_h5_loud(&voice);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(arrays_and_attributes_come_back, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_checksum_is_the_documented_one, test_begin, test_end),
        cmocka_unit_test_setup_teardown(wrong_kinds_are_refused_with_path_and_name, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
