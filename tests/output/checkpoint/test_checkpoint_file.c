/* The file of a checkpoint: its seal, its format, what it says about the run that wrote it. */
#include "../support.h"
#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/append.h"
#include "../../../host/output/checkpoint/checkpoint.h"
#include "../../../host/output/checkpoint/checkpoint_identity.h"
#include "../../../host/output/checkpoint/checkpoint_store.h"
#include "../../../host/output/seal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void write_bytes(const char *path, const char *bytes, size_t n)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, n, file), n);
    fclose(file);
}

static bool is_whole(const char *path, char why[256])
{
    bool whole;
    assert_int_equal(brc_seal_check(test_context, path, &whole, why, 256), BRC_OK);
    return whole;
}

/* CRC-32 of "123456789" is CBF43926 (the check value of its definition). */
static void the_sum_is_the_crc_of_its_definition(void **state)
{
    (void)state;
    assert_int_equal(brc_seal_sum(0, "123456789", 9), 0xcbf43926);
    assert_int_equal(brc_seal_sum(brc_seal_sum(0, "12345", 5), "6789", 4), 0xcbf43926);
    assert_int_equal(brc_seal_join(brc_seal_join(0, brc_seal_sum(0, "12345", 5), 5), brc_seal_sum(0, "6789", 4), 4),
                     0xcbf43926);
    assert_int_equal(brc_seal_join(0xcbf43926, 0, 0), 0xcbf43926);
}

static void a_sealed_file_is_told_from_one_cut_short_or_changed(void **state)
{
    (void)state;
    char *folder = test_new_folder(), why[256], byte;
    const char *path = test_path(folder, "file");
    const size_t n = (1 << 20) + 77; /* more than one block */
    char *data = calloc(1, n);
    for (size_t k = 0; k < n; ++k)
        data[k] = (char)(k * 7);
    write_bytes(path, data, n);
    assert_false(is_whole(path, why));
    assert_non_null(strstr(why, "no seal"));
    assert_int_equal(brc_seal_add(test_context, path), BRC_OK);
    assert_true(is_whole(path, why));
    struct stat size;
    assert_int_equal(stat(path, &size), 0);
    const off_t places[] = {0, 1 << 20, (off_t)n - 1, (off_t)n + 20};
    for (size_t k = 0; k < sizeof places / sizeof *places; ++k) { /* one bit anywhere, and back */
        FILE *file = fopen(path, "r+b");
        for (int turn = 0; turn < 2; ++turn) {
            fseeko(file, places[k], SEEK_SET);
            assert_int_equal(fread(&byte, 1, 1, file), 1);
            byte ^= 4;
            fseeko(file, places[k], SEEK_SET);
            fwrite(&byte, 1, 1, file);
            fflush(file);
            assert_int_equal(is_whole(path, why), turn == 1);
        }
        fclose(file);
    }
    assert_int_equal(truncate(path, size.st_size - 1), 0);
    assert_false(is_whole(path, why));
    assert_int_equal(truncate(path, 0), 0);
    assert_false(is_whole(path, why));
    bool whole;
    assert_int_equal(brc_seal_check(test_context, test_path(folder, "none"), &whole, why, sizeof why), BRC_BAD_INPUT);
    brc_context_clear(test_context);
    free(data);
    test_remove_folder(folder);
}

static void numbers_come_back_from_a_sealed_file_as_they_were(void **state)
{
    (void)state;
    char *folder = test_new_folder(), *text = NULL, why[256];
    const char *path = test_path(folder, "state.h5");
    double x[3][2] = {{1.0 / 3, -0.0}, {5e-324, 1e308}, {0, 2}}, y[3][2];
    float f = 1.0f / 3, g;
    int64_t big = INT64_MIN, n = 0;
    int32_t *list = NULL;
    bool flag = true, back = false;
    char words[32] = "auto: power iteration", again[32];
    brc_h5 h5;
    assert_int_equal(brc_h5_create(test_context, path, &h5), BRC_OK);
    brc_state_store store = brc_checkpoint_store_write(&h5, 2);
    store.part = 1;
    assert_int_equal(store.numbers(&store, "x", BRC_STORED_DOUBLE, 3, 2, x), BRC_OK);
    assert_int_equal(store.numbers(&store, "f", BRC_STORED_FLOAT, 1, 1, &f), BRC_OK);
    assert_int_equal(brc_store_integer(&store, "big", &big), BRC_OK);
    assert_int_equal(brc_store_flag(&store, "flag", &flag), BRC_OK);
    assert_int_equal(brc_store_text(&store, "words", words, sizeof words), BRC_OK);
    assert_int_equal(brc_store_array(test_context, &store, "empty", BRC_STORED_INT32, 1, &n, (void **)&list), BRC_OK);
    brc_h5_text(&h5, "note", "kept");
    assert_int_equal(brc_h5_commit_sealed(&h5), BRC_OK);
    assert_true(is_whole(path, why));
    brc_h5_read in;
    assert_int_equal(brc_h5_read_open(test_context, path, &in), BRC_OK);
    store = brc_checkpoint_store_read(&in);
    store.part = 1;
    assert_int_equal(store.numbers(&store, "x", BRC_STORED_DOUBLE, 3, 2, y), BRC_OK);
    assert_memory_equal(x, y, sizeof x);
    assert_int_equal(store.numbers(&store, "f", BRC_STORED_FLOAT, 1, 1, &g), BRC_OK);
    assert_memory_equal(&f, &g, sizeof f);
    assert_int_equal(brc_store_flag(&store, "flag", &back), BRC_OK);
    assert_true(back);
    big = 0;
    assert_int_equal(brc_store_integer(&store, "big", &big), BRC_OK);
    assert_true(big == INT64_MIN);
    assert_int_equal(brc_store_text(&store, "words", again, sizeof again), BRC_OK);
    assert_string_equal(words, again);
    n = 7;
    assert_int_equal(brc_store_array(test_context, &store, "empty", BRC_STORED_INT32, 1, &n, (void **)&list), BRC_OK);
    assert_int_equal(n, 0);
    assert_int_equal(brc_h5_read_string(&in, "note", &text), BRC_OK);
    assert_string_equal(text, "kept");
    assert_int_equal(store.numbers(&store, "x", BRC_STORED_DOUBLE, 2, 3, y), BRC_BAD_INPUT); /* of another size */
    assert_non_null(strstr(brc_context_message(test_context), "parts/1/x has 3 x 2 numbers, 2 x 3 are expected"));
    store.part = 0;
    assert_int_equal(store.numbers(&store, "x", BRC_STORED_DOUBLE, 3, 2, y), BRC_BAD_INPUT); /* of another part */
    brc_context_clear(test_context);
    brc_h5_read_close(&in);
    brc_memory_free(text);
    brc_memory_free(list);
    test_remove_folder(folder);
}

/* Identity alone, with a format of the test's choice. */
static void write_identity(const char *path, int64_t format, const char *scene)
{
    brc_h5 h5;
    assert_int_equal(brc_h5_create(test_context, path, &h5), BRC_OK);
    brc_h5_group(&h5, "identity");
    brc_h5_dataset(&h5, "identity/format_version", H5T_NATIVE_INT64, 1, 0, &format);
    brc_h5_text(&h5, "identity/scene", scene);
    brc_h5_text(&h5, "identity/version", "0.0.1");
    brc_h5_text(&h5, "identity/commit", "abc");
    assert_int_equal(brc_h5_commit_sealed(&h5), BRC_OK);
}

static void says(const char *part)
{
    if (!strstr(brc_context_message(test_context), part))
        fail_msg("'%s' is not in: %s", part, brc_context_message(test_context));
    brc_context_clear(test_context);
}

static const char *const stages = "stages:\n  - name: pull\n    solver: {dynamic: {steps: 10}}\n";

static void another_format_is_refused_and_another_program_goes_on(void **state)
{
    (void)state;
    char *folder = test_new_folder(), text[2000], *yaml = NULL;
    brc_checkpoints *found = NULL;
    snprintf(text, sizeof text, "%s%s", TEST_SCENE_HEAD, stages);
    brc_scene *scene = test_scene(text);
    brc_log_set_level(test_context, BRC_LOG_ERROR);
    assert_int_equal(brc_checkpoint_scene(test_context, scene, &yaml), BRC_OK);
    assert_int_equal(mkdir(test_path(folder, "checkpoints"), 0777), 0);
    write_identity(test_path(folder, "checkpoints/000003.h5"), BRC_CHECKPOINT_FORMAT_VERSION, yaml);
    assert_int_equal(brc_checkpoints_create(test_context, folder, scene, true, &found), BRC_OK);
    assert_non_null(strstr(brc_checkpoints_report(found).from, "checkpoints/000003.h5"));
    brc_checkpoints_free(&found);
    write_identity(test_path(folder, "checkpoints/000004.h5"), BRC_CHECKPOINT_FORMAT_VERSION + 1, yaml);
    assert_int_equal(brc_checkpoints_create(test_context, folder, scene, true, &found), BRC_BAD_INPUT);
    snprintf(text, sizeof text, "000004.h5: is a checkpoint of format %d, this program reads %d",
             BRC_CHECKPOINT_FORMAT_VERSION + 1, BRC_CHECKPOINT_FORMAT_VERSION);
    says(text);
    assert_null(found);
    brc_memory_free(yaml);
    brc_scene_free(&scene);
    test_remove_folder(folder);
}

static void a_scene_that_differs_is_refused_with_the_key(void **state)
{
    (void)state;
    char *folder = test_new_folder(), text[2000], *yaml = NULL;
    brc_checkpoints *found = NULL;
    static const struct {
        const char *more, *says;
    } changed[] = {
        {"gravity: [0, 0, -9.81 m/s^2]\n", "gravity"},
        {"output: {frames: 7}\n", "output: 'frames: 7' there"},
        {"stages:\n  - name: pull\n    solver: {dynamic: {steps: 20}}\n", "'steps: 20' there, 'steps: 10' here"}};
    for (size_t k = 0; k < sizeof changed / sizeof *changed; ++k) {
        const bool own_stages = strncmp(changed[k].more, "stages", 6) == 0;
        snprintf(text, sizeof text, "%s%s%s", TEST_SCENE_HEAD, own_stages ? "" : stages, changed[k].more);
        brc_scene *other = test_scene(text);
        snprintf(text, sizeof text, "%s%s", TEST_SCENE_HEAD, stages);
        brc_scene *scene = test_scene(text);
        assert_int_equal(brc_checkpoint_scene(test_context, other, &yaml), BRC_OK);
        if (k == 0) assert_int_equal(mkdir(test_path(folder, "checkpoints"), 0777), 0);
        write_identity(test_path(folder, "checkpoints/000000.h5"), BRC_CHECKPOINT_FORMAT_VERSION, yaml);
        assert_int_equal(brc_checkpoints_create(test_context, folder, scene, true, &found), BRC_BAD_INPUT);
        says(changed[k].says);
        brc_memory_free(yaml);
        brc_scene_free(&other);
        brc_scene_free(&scene);
    }
    test_remove_folder(folder);
}

static void a_growing_file_goes_on_where_it_was(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    const char *path = test_path(folder, "rows.csv");
    brc_append *file = NULL;
    brc_text text = {.context = test_context};
    write_bytes(path, "head\none\ntwo\n", 13);
    assert_int_equal(brc_append_reopen(test_context, path, 9, &file), BRC_OK);
    brc_text_add(&text, "three\n");
    assert_int_equal(brc_append_add(test_context, file, &text), BRC_OK);
    assert_int_equal(brc_append_bytes(file), 15);
    brc_append_free(&file);
    brc_text_free(&text);
    char *all = test_read(path);
    assert_string_equal(all, "head\none\nthree\n");
    brc_memory_free(all);
    assert_int_equal(brc_append_reopen(test_context, path, 16, &file), BRC_BAD_INPUT);
    says("has 15 bytes, the run goes on behind 16");
    assert_int_equal(brc_append_reopen(test_context, test_path(folder, "none"), 0, &file), BRC_BAD_INPUT);
    brc_context_clear(test_context);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sum_is_the_crc_of_its_definition),
        cmocka_unit_test(a_sealed_file_is_told_from_one_cut_short_or_changed),
        cmocka_unit_test(numbers_come_back_from_a_sealed_file_as_they_were),
        cmocka_unit_test(another_format_is_refused_and_another_program_goes_on),
        cmocka_unit_test(a_scene_that_differs_is_refused_with_the_key),
        cmocka_unit_test(a_growing_file_goes_on_where_it_was),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
