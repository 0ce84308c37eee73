#include "support.h"
#include "../../host/base/memory.h"
#include <string.h>

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

static void blocks_are_zeroed_and_aligned(void **state)
{
    brc_context *context = *state;
    for (int64_t n = 0; n < 200; n += 7) {
        double *block;
        assert_int_equal(BRC_ALLOCATE(context, &block, n, "numbers"), BRC_OK);
        assert_non_null(block);
        assert_int_equal((uintptr_t)block % 64, 0);
        for (int64_t k = 0; k < n; ++k)
            assert_true(block[k] == 0.0);
        memset(block, 0xff, (size_t)n * sizeof *block); /* so that the next block reuses dirty memory */
        brc_memory_free(block);
    }
}

static void held_bytes_return_to_where_they_were(void **state)
{
    brc_context *context = *state;
    const int64_t before = brc_memory_held();
    char *block;
    assert_int_equal(BRC_ALLOCATE(context, &block, 1000, "bytes"), BRC_OK);
    assert_int_equal(brc_memory_held() - before, 1024); /* whole lines of 64 bytes */
    assert_true(brc_memory_peak() >= brc_memory_held());
    assert_int_equal(brc_memory_resize(context, (void **)&block, 100, 1, "bytes"), BRC_OK);
    assert_int_equal(brc_memory_held() - before, 128);
    assert_true(brc_memory_peak() >= before + 1024);
    brc_memory_free(block);
    brc_memory_free(NULL);
    assert_int_equal(brc_memory_held(), before);
    brc_memory_mark(); /* what was held before counts no more */
    assert_int_equal(brc_memory_peak_since_mark(), before);
    assert_int_equal(BRC_ALLOCATE(context, &block, 64, "bytes"), BRC_OK);
    brc_memory_free(block);
    assert_int_equal(brc_memory_peak_since_mark(), before + 64);
}

static void whole_pages_of_what_is_forgotten_are_gone(void **state)
{
    enum { BYTES = 1 << 22, FROM = 1 << 20, LENGTH = 2 << 20 };
    char *block;
    assert_int_equal(BRC_ALLOCATE(*state, &block, BYTES, "bytes"), BRC_OK);
    memset(block, 1, BYTES);
    brc_memory_forget(block + FROM, LENGTH);
    for (int k = 0; k < FROM; ++k) {
        assert_int_equal(block[k], 1);
        assert_int_equal(block[FROM + LENGTH + k], 1);
    }
    assert_int_equal(block[FROM + LENGTH / 2], 0);
    brc_memory_free(block);
}

/* More than this machine has, of which a page is written, is no more than a page. */
static void sparse_blocks_take_what_is_written(void **state)
{
    enum { AT = 123 << 20, LENGTH = 1 << 16 };
    const int64_t bytes = (int64_t)1 << 40, held = brc_memory_held();
    char *block;
    assert_int_equal(brc_memory_allocate_sparse(*state, (void **)&block, bytes, 1, "bytes"), BRC_OK);
    assert_int_equal((uintptr_t)block % 64, 0);
    assert_int_equal(brc_memory_block_bytes(block), bytes);
    assert_int_equal(block[AT] + block[bytes - 1], 0);
    brc_memory_free(block);
    assert_int_equal(brc_memory_allocate_sparse(*state, (void **)&block, AT + LENGTH, 1, "bytes"), BRC_OK);
    const int64_t before = brc_memory_sparse_resident(block);
    memset(block + AT, 1, LENGTH);
    const int64_t there = brc_memory_sparse_resident(block) - before;
    assert_true(there >= LENGTH && there < 2 * LENGTH);
    brc_memory_forget(block + AT, LENGTH);
    assert_true(brc_memory_sparse_resident(block) <= before + LENGTH / 2);
    assert_false(brc_memory_spill_sparse(block)); /* there is no folder */
    brc_memory_free(block);
    assert_int_equal(brc_memory_held(), held);
    assert_int_equal(brc_memory_allocate_sparse(*state, (void **)&block, INT64_MAX, 8, "bytes"), BRC_NO_MEMORY);
    assert_null(block);
}

static void resizing_keeps_the_first_bytes_and_zeroes_the_new(void **state)
{
    brc_context *context = *state;
    int *block = NULL;
    assert_int_equal(brc_memory_resize(context, (void **)&block, 10, sizeof *block, "numbers"), BRC_OK);
    for (int k = 0; k < 10; ++k)
        block[k] = k + 1;
    assert_int_equal(brc_memory_resize(context, (void **)&block, 5, sizeof *block, "numbers"), BRC_OK);
    assert_int_equal(brc_memory_resize(context, (void **)&block, 1000, sizeof *block, "numbers"), BRC_OK);
    for (int k = 0; k < 1000; ++k)
        assert_int_equal(block[k], k < 5 ? k + 1 : 0);
    brc_memory_free(block);
}

static void what_cannot_be_had_is_refused_with_its_name_and_size(void **state)
{
    brc_context *context = *state;
    double *block = (double *)(uintptr_t)64;
    /* 4 PB: more than the address space of the processor, whatever the machine is willing to promise. */
    assert_int_equal(BRC_ALLOCATE(context, &block, (int64_t)1 << 49, "bond areas"), BRC_NO_MEMORY);
    assert_null(block);
    assert_non_null(strstr(brc_context_message(context), "bond areas"));
    assert_non_null(strstr(brc_context_message(context), "GB"));
}

static void overflow_and_negative_counts_are_refused(void **state)
{
    brc_context *context = *state;
    void *block;
    assert_int_equal(brc_memory_allocate(context, &block, INT64_MAX, 16, "much"), BRC_NO_MEMORY);
    assert_null(block);
    assert_int_equal(brc_memory_allocate(context, &block, INT64_MAX, 1, "much"), BRC_NO_MEMORY);
    assert_int_equal(brc_memory_allocate(context, &block, -1, 8, "less than nothing"), BRC_NO_MEMORY);
    assert_non_null(strstr(brc_context_message(context), "less than nothing"));
}

static void a_refused_resize_leaves_the_block(void **state)
{
    brc_context *context = *state;
    int *block;
    assert_int_equal(BRC_ALLOCATE(context, &block, 3, "numbers"), BRC_OK);
    block[2] = 42;
    assert_int_equal(brc_memory_resize(context, (void **)&block, (int64_t)1 << 50, sizeof *block, "numbers"),
                     BRC_NO_MEMORY);
    assert_int_equal(block[2], 42);
    brc_memory_free(block);
}

/* Two blocks; handed: *out gets the second. */
static brc_status hold(brc_context *context, int64_t second, int64_t *during, double **out)
{
    BRC_LOCAL(context, 100, int32_t, first, "counts");
    BRC_LOCAL(context, second, double, numbers, "numbers");
    assert_true(first[99] == 0);
    *during = brc_memory_held();
    if (!out) return BRC_OK;
    *out = numbers;
    numbers = NULL;
    return BRC_OK;
}

static void blocks_of_a_scope_end_with_it_wherever_it_returns(void **state)
{
    brc_context *context = *state;
    const int64_t before = brc_memory_held();
    int64_t during = 0;
    double *kept = NULL;
    assert_int_equal(hold(context, 10, &during, NULL), BRC_OK);
    assert_int_equal(during - before, 448 + 128);
    assert_int_equal(brc_memory_held(), before);
    assert_int_equal(hold(context, -1, &during, &kept), BRC_NO_MEMORY);
    assert_null(kept);
    assert_int_equal(brc_memory_held(), before);
    assert_int_equal(hold(context, 10, &during, &kept), BRC_OK);
    assert_int_equal(brc_memory_held() - before, 128);
    brc_memory_free(kept);
    assert_int_equal(brc_memory_held(), before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(blocks_are_zeroed_and_aligned, begin, end),
        cmocka_unit_test_setup_teardown(held_bytes_return_to_where_they_were, begin, end),
        cmocka_unit_test_setup_teardown(whole_pages_of_what_is_forgotten_are_gone, begin, end),
        cmocka_unit_test_setup_teardown(sparse_blocks_take_what_is_written, begin, end),
        cmocka_unit_test_setup_teardown(resizing_keeps_the_first_bytes_and_zeroes_the_new, begin, end),
        cmocka_unit_test_setup_teardown(what_cannot_be_had_is_refused_with_its_name_and_size, begin, end),
        cmocka_unit_test_setup_teardown(overflow_and_negative_counts_are_refused, begin, end),
        cmocka_unit_test_setup_teardown(a_refused_resize_leaves_the_block, begin, end),
        cmocka_unit_test_setup_teardown(blocks_of_a_scope_end_with_it_wherever_it_returns, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
