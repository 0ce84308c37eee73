#include "support.h"
#include "../../host/base/memory.h"
#include "../../host/base/spill.h"
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LONG = 1 << 20, SHORT = 1000 };

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

static char *take(brc_context *context, int64_t bytes)
{
    char *block;
    if (brc_memory_allocate(context, (void **)&block, bytes, 1, "bytes") != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    for (int64_t k = 0; k < bytes; ++k)
        assert_int_equal(block[k], 0);
    memset(block, 1, (size_t)bytes);
    return block;
}

/* In a child: a process keeps the file that it has begun. */
static void a_folder_that_is_not_there_is_named(void **state)
{
    brc_context *context = *state;
    const pid_t child = fork();
    if (child == 0) {
        void *block;
        setenv("BRECCIA_SPILL", "/no/such/folder", 1);
        const bool refused = brc_memory_allocate(context, &block, LONG, 1, "cells") == BRC_NO_MEMORY && !block;
        const char *const said = brc_context_message(context);
        _exit(refused && strstr(said, "cells") && strstr(said, "/no/such/folder (BRECCIA_SPILL)") &&
                      strstr(said, "No such file or directory")
                  ? 0
                  : 1);
    }
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_int_equal(result, 0);
}

static void long_blocks_lie_in_the_file_and_are_zero_again(void **state)
{
    brc_context *context = *state;
    const int64_t held = brc_memory_held();
    char *one = take(context, LONG), *other = take(context, LONG + 5), *little = take(context, SHORT);
    assert_true(brc_spill_has(one) && brc_spill_has(other) && !brc_spill_has(little));
    assert_int_equal((uintptr_t)one % 64, 0);
    char *const place = one;
    brc_memory_free(one);
    one = take(context, LONG + 700); /* of its class: at its place, and zero */
    assert_ptr_equal(one, place);
    for (int k = 0; k < LONG; ++k)
        assert_int_equal(other[k], 1);
    assert_int_equal(brc_memory_resize(context, (void **)&little, LONG, 1, "bytes"), BRC_OK);
    assert_true(brc_spill_has(little) && little[SHORT - 1] == 1 && little[SHORT] == 0);
    brc_memory_forget(other, LONG);
    assert_int_equal(other[LONG / 2], 0);
    brc_memory_free(one);
    brc_memory_free(other);
    brc_memory_free(little);
    assert_int_equal(brc_memory_held(), held);
}

static void a_child_has_a_file_of_its_own(void **state)
{
    brc_context *context = *state;
    char *block = take(context, LONG);
    const pid_t child = fork();
    if (child == 0) {
        char *own = NULL;
        bool well = block[LONG - 1] == 1;
        memset(block, 2, LONG);
        well = well && brc_memory_allocate(context, (void **)&own, LONG, 1, "bytes") == BRC_OK && own != block &&
               brc_spill_has(own) && own[0] == 0;
        if (well) memset(own, 3, LONG);
        brc_memory_free(block);
        brc_memory_free(own);
        _exit(well ? 0 : 1);
    }
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_int_equal(result, 0);
    for (int k = 0; k < LONG; ++k)
        assert_int_equal(block[k], 1);
    char *const next = take(context, LONG);
    brc_memory_free(block);
    brc_memory_free(next);
}

/* A sparse block that is laid there keeps what it has; one part of a program names a folder of its own. */
static void sparse_blocks_are_laid_in_the_file(void **state)
{
    char *block;
    const char *const folder = getenv("BRECCIA_SPILL");
    assert_int_equal(brc_memory_allocate_sparse(*state, (void **)&block, 4 * LONG, 1, "bytes"), BRC_OK);
    assert_false(brc_spill_has(block));
    memset(block + LONG, 1, LONG);
    brc_spill_into("elsewhere");
    assert_string_equal(brc_spill_folder(), "elsewhere");
    brc_spill_into(folder);
    assert_true(brc_memory_spill_sparse(block));
    brc_spill_into(NULL);
    assert_string_equal(brc_spill_folder(), folder);
    memset(block + 3 * LONG, 2, LONG);
    for (int k = 0; k < LONG; ++k) {
        assert_int_equal(block[k] + block[2 * LONG + k], 0);
        assert_int_equal(block[LONG + k], 1);
        assert_int_equal(block[3 * LONG + k], 2);
    }
    assert_int_equal(brc_memory_block_bytes(block), 4 * LONG);
    brc_memory_free(block);
}

static void more_than_the_disk_has_is_a_sentence(void **state)
{
    brc_context *context = *state;
    void *block;
    assert_int_equal(brc_memory_allocate(context, &block, (int64_t)1 << 50, 1, "cells"), BRC_NO_MEMORY);
    assert_null(block);
    assert_non_null(strstr(brc_context_message(context), "GB are free there"));
    assert_true(brc_spill_room() > 0.0);
}

static void nothing_with_a_name_is_left(void **state)
{
    (void)state;
    const int file = brc_spill_file();
    struct stat about;
    assert_true(file >= 0);
    assert_int_equal(fstat(file, &about), 0);
    assert_int_equal(about.st_nlink, 0);
    close(file);
    assert_int_equal(rmdir(getenv("BRECCIA_SPILL")), 0); /* empty */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_folder_that_is_not_there_is_named, begin, end),
        cmocka_unit_test_setup_teardown(long_blocks_lie_in_the_file_and_are_zero_again, begin, end),
        cmocka_unit_test_setup_teardown(a_child_has_a_file_of_its_own, begin, end),
        cmocka_unit_test_setup_teardown(sparse_blocks_are_laid_in_the_file, begin, end),
        cmocka_unit_test_setup_teardown(more_than_the_disk_has_is_a_sentence, begin, end),
        cmocka_unit_test_setup_teardown(nothing_with_a_name_is_left, begin, end),
    };
    setenv("BRECCIA_SPILL", test_new_folder(), 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
