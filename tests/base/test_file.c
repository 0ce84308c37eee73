#include "support.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct fixture {
    brc_context *context;
    const char *folder;
    char path[128];
} fixture;

static fixture fixture_now;

static int begin(void **state)
{
    fixture_now.context = brc_context_create();
    fixture_now.folder = test_new_folder();
    snprintf(fixture_now.path, sizeof fixture_now.path, "%s/file", fixture_now.folder);
    *state = &fixture_now;
    return 0;
}

static int end(void **state)
{
    fixture *f = *state;
    unlink(f->path);
    rmdir(f->folder);
    brc_context_free(&f->context);
    return 0;
}

static void what_is_written_is_read_back(void **state)
{
    fixture *f = *state;
    char data[70000]; /* more than one read of a pipe's size; with NULs inside */
    for (size_t k = 0; k < sizeof data; ++k)
        data[k] = (char)(k * 7);
    assert_int_equal(brc_file_write_whole(f->context, f->path, data, sizeof data), BRC_OK);
    char *back;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(f->context, f->path, sizeof data, &back, &bytes), BRC_OK);
    assert_int_equal(bytes, sizeof data);
    assert_memory_equal(back, data, bytes);
    assert_int_equal(back[bytes], '\0');
    brc_memory_free(back);
}

static void nothing_stands_aside_after_writing(void **state)
{
    fixture *f = *state;
    char *aside;
    assert_int_equal(brc_file_aside(f->context, f->path, &aside), BRC_OK);
    assert_int_equal(brc_file_write_whole(f->context, f->path, "a", 1), BRC_OK);
    assert_int_equal(brc_file_write_whole(f->context, f->path, "bc", 2), BRC_OK);
    assert_true(brc_file_exists(f->path));
    assert_false(brc_file_exists(aside));
    brc_memory_free(aside);
    struct stat information;
    assert_int_equal(stat(f->path, &information), 0);
    assert_int_equal(information.st_size, 2);
}

static void an_empty_file_is_read(void **state)
{
    fixture *f = *state;
    char *back;
    size_t bytes;
    assert_int_equal(brc_file_write_whole(f->context, f->path, "", 0), BRC_OK);
    assert_int_equal(brc_file_read_whole(f->context, f->path, 10, &back, &bytes), BRC_OK);
    assert_int_equal(bytes, 0);
    assert_string_equal(back, "");
    brc_memory_free(back);
}

static void too_large_a_file_is_refused_with_the_limit(void **state)
{
    fixture *f = *state;
    char *back;
    size_t bytes;
    assert_int_equal(brc_file_write_whole(f->context, f->path, "12345", 5), BRC_OK);
    assert_int_equal(brc_file_read_whole(f->context, f->path, 4, &back, &bytes), BRC_BAD_INPUT);
    assert_null(back);
    assert_non_null(strstr(brc_context_message(f->context), "5 bytes"));
    assert_non_null(strstr(brc_context_message(f->context), "at most 4"));
    assert_int_equal(brc_file_read_whole(f->context, f->path, 5, &back, &bytes), BRC_OK);
    brc_memory_free(back);
}

static void an_endless_device_is_refused_at_the_limit(void **state)
{
    fixture *f = *state;
    char *back;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(f->context, "/dev/zero", 1000000, &back, &bytes), BRC_BAD_INPUT);
    assert_null(back);
    assert_non_null(strstr(brc_context_message(f->context), "1000000 bytes"));
}

static void folders_and_missing_files_are_refused_by_name(void **state)
{
    fixture *f = *state;
    char *back;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(f->context, f->folder, 10, &back, &bytes), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(f->context), "is a folder"));
    brc_context_clear(f->context);
    assert_int_equal(brc_file_read_whole(f->context, f->path, 10, &back, &bytes), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(f->context), f->path));
    assert_non_null(strstr(brc_context_message(f->context), "No such file"));
}

static void folders_are_made_with_their_parents(void **state)
{
    fixture *f = *state;
    char deep[256];
    snprintf(deep, sizeof deep, "%s/a/b//c/", f->folder);
    assert_int_equal(brc_file_make_folder(f->context, deep), BRC_OK);
    assert_int_equal(brc_file_make_folder(f->context, deep), BRC_OK);
    assert_true(brc_file_exists(deep));
    static const char *const parts[] = {"/a/b/c", "/a/b", "/a"};
    for (int k = 0; k < 3; ++k) {
        snprintf(deep, sizeof deep, "%s%s", f->folder, parts[k]);
        assert_int_equal(rmdir(deep), 0);
    }
}

static void a_file_in_the_way_of_a_folder_is_named(void **state)
{
    fixture *f = *state;
    assert_int_equal(brc_file_write_whole(f->context, f->path, "x", 1), BRC_OK);
    assert_int_equal(brc_file_make_folder(f->context, f->path), BRC_FILE_FAILED);
    assert_non_null(strstr(brc_context_message(f->context), f->path));
    assert_int_equal(brc_file_make_folder(f->context, ""), BRC_FILE_FAILED);
}

static void a_failed_write_leaves_the_old_file_and_no_part(void **state)
{
    fixture *f = *state;
    char nowhere[256];
    snprintf(nowhere, sizeof nowhere, "%s/missing/file", f->folder);
    assert_int_equal(brc_file_write_whole(f->context, nowhere, "x", 1), BRC_FILE_FAILED);
    assert_non_null(strstr(brc_context_message(f->context), "cannot create"));
}

static void a_full_disk_is_one_sentence(void **state)
{
    fixture *f = *state;
    /* The part beside the file is a link to the device that is always full. */
    char *aside;
    assert_int_equal(brc_file_write_whole(f->context, f->path, "old", 3), BRC_OK);
    assert_int_equal(brc_file_aside(f->context, f->path, &aside), BRC_OK);
    assert_int_equal(symlink("/dev/full", aside), 0);
    assert_int_equal(brc_file_write_whole(f->context, f->path, "new text", 8), BRC_FILE_FAILED);
    assert_non_null(strstr(brc_context_message(f->context), "No space left"));
    assert_false(brc_file_exists(aside));
    char *back;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(f->context, f->path, 10, &back, &bytes), BRC_OK);
    assert_string_equal(back, "old");
    brc_memory_free(back);
    brc_memory_free(aside);
}

static void an_aside_is_committed_or_discarded(void **state)
{
    fixture *f = *state;
    char *aside;
    assert_int_equal(brc_file_aside(f->context, f->path, &aside), BRC_OK);
    assert_int_equal(brc_file_commit(f->context, aside, f->path), BRC_FILE_FAILED); /* nobody wrote it */
    FILE *file = fopen(aside, "w");
    assert_non_null(file);
    fputs("text", file);
    fclose(file);
    assert_int_equal(brc_file_commit(f->context, aside, f->path), BRC_OK);
    assert_true(brc_file_exists(f->path));
    assert_false(brc_file_exists(aside));
    file = fopen(aside, "w");
    assert_non_null(file);
    fclose(file);
    brc_file_discard(aside);
    brc_file_discard(aside);
    brc_file_discard(NULL);
    assert_false(brc_file_exists(aside));
    brc_memory_free(aside);
}

static void a_place_that_cannot_be_written_to_is_known_before(void **state)
{
    fixture *f = *state;
    char missing[160];
    snprintf(missing, sizeof missing, "%s/missing/new", f->folder);
    assert_int_equal(brc_file_check_place(f->context, f->path), BRC_OK);
    assert_false(brc_file_exists(f->path)); /* asked, not made */
    assert_int_equal(brc_file_check_place(f->context, "new"), BRC_OK);
    assert_int_equal(brc_file_check_place(f->context, f->folder), BRC_FILE_FAILED);
    assert_int_equal(brc_file_check_place(f->context, missing), BRC_FILE_FAILED);
    assert_non_null(strstr(brc_context_message(f->context), "is a folder"));
    assert_non_null(strstr(brc_context_message(f->context), "No such file or directory"));
}

static void joining_puts_one_slash(void **state)
{
    fixture *f = *state;
    char *path;
    assert_int_equal(brc_file_join(f->context, "results", "summary.json", &path), BRC_OK);
    assert_string_equal(path, "results/summary.json");
    brc_memory_free(path);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, begin, end)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(what_is_written_is_read_back),
        CASE(nothing_stands_aside_after_writing),
        CASE(an_empty_file_is_read),
        CASE(too_large_a_file_is_refused_with_the_limit),
        CASE(an_endless_device_is_refused_at_the_limit),
        CASE(folders_and_missing_files_are_refused_by_name),
        CASE(folders_are_made_with_their_parents),
        CASE(a_file_in_the_way_of_a_folder_is_named),
        CASE(a_failed_write_leaves_the_old_file_and_no_part),
        CASE(a_full_disk_is_one_sentence),
        CASE(an_aside_is_committed_or_discarded),
        CASE(a_place_that_cannot_be_written_to_is_known_before),
        CASE(joining_puts_one_slash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
