#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "device_cases.h"
#include "../skip.h"
#include "../../host/base/log.h"
#include "../../host/device/device_bandwidth.h"
#include "kernel_list.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

brc_status device_cases_open(brc_context *context, const brc_device_request *request)
{
    brc_device *device = NULL;
    brc_context_clear(context);
    const brc_status status = brc_device_open(context, request, &device);
    assert_true((status == BRC_OK) == (device != NULL));
    brc_device_close(&device);
    return status;
}

void device_cases_says(brc_context *context, const char *expected)
{
    if (strstr(brc_context_message(context), expected)) return;
    printf("'%s' is not in: %s\n", expected, brc_context_message(context));
    fail();
}

bool device_cases_find(brc_device_kind kind, brc_device_info *info, char *why, size_t bytes)
{
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    *info = (brc_device_info){.usable = false};
    snprintf(why, bytes, "there is no device list");
    if (context && brc_device_list_create(context, &list) == BRC_OK)
        for (int d = 0; d < list->n && !info->usable; ++d)
            if (list->items[d].kind == kind) *info = list->items[d];
    if (!info->usable) snprintf(why, bytes, "no usable device of this kind: %s", info->why_not);
    brc_device_list_free(&list);
    brc_context_free(&context);
    return info->usable;
}

enum { N = 1003 }; /* no multiple of a lane or a work-group */

static const brc_precision precisions[] = {BRC_DOUBLE, BRC_MIXED, BRC_SINGLE};

/* The device the cases run on. */
static brc_device_info device_info;

typedef struct bench {
    brc_context *context;
    brc_device *device;
} bench;

static bench bench_open_as(brc_precision precision, bool many_materials, int n_threads, bool exact)
{
    bench b = {.context = brc_context_create()};
    assert_non_null(b.context);
    const brc_device_request request = {.selector = device_info.selector,
                                        .precision = precision,
                                        .many_materials = many_materials,
                                        .n_threads = n_threads,
                                        .exact = exact};
    if (brc_device_open(b.context, &request, &b.device) != BRC_OK) {
        printf("%s\n", brc_context_message(b.context)); /* fail_msg would cut a compiler log */
        fail();
    }
    return b;
}

/* Every rounding as written: what the bitwise claims are about. */
static bench bench_open(brc_precision precision, bool many_materials, int n_threads)
{
    return bench_open_as(precision, many_materials, n_threads, true);
}

static void bench_close(bench *b)
{
    brc_device_close(&b->device);
    assert_null(b->device);
    brc_context_free(&b->context);
}

#define DONE(b, call)                                                                                                  \
    do {                                                                                                               \
        if ((call) != BRC_OK) fail_msg("%s", brc_context_message((b).context));                                        \
    } while (0)

static bool runs_here(brc_precision precision)
{
    return device_info.has_double || precision == BRC_SINGLE;
}

static brc_kernel *kernel_of(bench *b, const char *name)
{
    brc_kernel *kernel = NULL;
    DONE(*b, brc_kernel_find(b->device, name, &kernel));
    return kernel;
}

/* A buffer of n numbers of the state. */
static brc_buffer *state_buffer(bench *b, const double *values, int n)
{
    brc_buffer *buffer = NULL;
    const int bytes = brc_precision_state_bytes(brc_device_get_precision(b->device));
    DONE(*b, brc_buffer_create(b->device, &buffer, (int64_t)n * bytes, "test numbers"));
    if (values) {
        float *const narrow = malloc((size_t)n * sizeof *narrow);
        assert_non_null(narrow);
        for (int i = 0; i < n; ++i)
            narrow[i] = (float)values[i];
        DONE(*b, brc_buffer_write(buffer, 0, bytes == 8 ? (const void *)values : narrow, (int64_t)n * bytes));
        free(narrow);
    }
    return buffer;
}

static void state_read(bench *b, brc_buffer *buffer, double *values, int n)
{
    const int bytes = brc_precision_state_bytes(brc_device_get_precision(b->device));
    if (bytes == 8) {
        DONE(*b, brc_buffer_read(buffer, 0, values, (int64_t)n * 8));
        return;
    }
    float *const narrow = malloc((size_t)n * sizeof *narrow);
    assert_non_null(narrow);
    DONE(*b, brc_buffer_read(buffer, 0, narrow, (int64_t)n * 4));
    for (int i = 0; i < n; ++i)
        values[i] = narrow[i];
    free(narrow);
}

static void ramp(double *values, int n, double from, double step)
{
    for (int i = 0; i < n; ++i)
        values[i] = (double)(float)(from + step * i);
}

static void a_vector_sum_equals_the_host_loop(void **unused)
{
    (void)unused;
    double x[N], y[N], got[N];
    ramp(x, N, -1, 0.37);
    ramp(y, N, 5, -0.11);
    for (size_t p = 0; p < 3; ++p) {
        if (!runs_here(precisions[p])) continue;
        bench b = bench_open(precisions[p], false, 0);
        brc_buffer *bx = state_buffer(&b, x, N), *by = state_buffer(&b, y, N);
        DONE(b, BRC_LAUNCH(kernel_of(&b, "vector_axpy"), N, BRC_INT(N), BRC_STATE(0.3), BRC_BUF(bx), BRC_BUF(by)));
        state_read(&b, by, got, N);
        for (int i = 0; i < N; ++i) /* no contraction: the same two roundings as here, so equal bits */
            if (precisions[p] == BRC_SINGLE) {
                const float product = 0.3f * (float)x[i];
                assert_true((float)got[i] == (float)y[i] + product);
            } else {
                const double product = 0.3 * x[i];
                assert_true(got[i] == y[i] + product);
            }
        brc_buffer_free(&bx);
        brc_buffer_free(&by);
        bench_close(&b);
    }
}

static void a_sum_over_a_list_equals_the_host_loop(void **unused)
{
    (void)unused;
    double x[N], got[2];
    int32_t index[N];
    ramp(x, N, -1, 0.37);
    for (int i = 0; i < N; ++i)
        index[i] = (int)((long)i * 611 % N);
    for (size_t p = 0; p < 3; ++p) {
        if (!runs_here(precisions[p])) continue;
        bench b = bench_open(precisions[p], true, 0);
        brc_buffer *bx = state_buffer(&b, x, N), *by = state_buffer(&b, NULL, 2), *bi = NULL;
        double sum = 0;
        DONE(b, brc_buffer_create(b.device, &bi, sizeof index, "index"));
        DONE(b, brc_buffer_write(bi, 0, index, sizeof index));
        DONE(b, BRC_LAUNCH(kernel_of(&b, "vector_sum_listed"), 1, BRC_INT(1), BRC_INT(N), BRC_INT(1), BRC_BUF(bi),
                           BRC_BUF(bx), BRC_BUF(by)));
        state_read(&b, by, got, 2);
        for (int i = 0; i < N; ++i)
            sum = precisions[p] == BRC_SINGLE ? (double)(float)(sum + x[index[i]]) : sum + x[index[i]];
        assert_true(got[0] == 0 && got[1] == sum);
        brc_buffer_free(&bx);
        brc_buffer_free(&by);
        brc_buffer_free(&bi);
        bench_close(&b);
    }
}

static void launches_and_copies_run_in_the_order_given(void **unused)
{
    (void)unused;
    double one[N], got[N];
    ramp(one, N, 1, 0);
    bench b = bench_open(device_info.has_double ? BRC_DOUBLE : BRC_SINGLE, false, 0);
    const int64_t bytes = (int64_t)N * brc_precision_state_bytes(brc_device_get_precision(b.device));
    brc_buffer *x = state_buffer(&b, one, N), *y = state_buffer(&b, NULL, N);
    brc_kernel *axpy = kernel_of(&b, "vector_axpy");
    /* y <- y + x, x <- y: 1, 2, 4 ... 2^19, exact in single precision; any other order gives another number */
    for (int round = 0; round < 20; ++round) {
        DONE(b, BRC_LAUNCH(axpy, N, BRC_INT(N), BRC_STATE(1), BRC_BUF(x), BRC_BUF(y)));
        DONE(b, brc_buffer_copy(x, y, bytes));
    }
    state_read(&b, x, got, N);
    for (int i = 0; i < N; ++i)
        assert_true(got[i] == 524288);
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    bench_close(&b);
}

static void a_new_buffer_is_zero_and_copies_keep_to_their_offsets(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    unsigned char data[4099], got[4099];
    for (size_t i = 0; i < sizeof data; ++i)
        data[i] = (unsigned char)(i * 7 + 1);
    brc_buffer *x = NULL, *y = NULL;
    DONE(b, brc_buffer_create(b.device, &x, sizeof data, "bytes"));
    DONE(b, brc_buffer_create(b.device, &y, sizeof data, "more bytes"));
    assert_int_equal(brc_buffer_bytes(x), sizeof data);
    DONE(b, brc_buffer_read(x, 0, got, sizeof got));
    for (size_t i = 0; i < sizeof got; ++i)
        assert_int_equal(got[i], 0);
    DONE(b, brc_buffer_write(x, 5, data, 100));
    DONE(b, brc_buffer_read(x, 4, got, 102));
    assert_int_equal(got[0], 0);
    assert_memory_equal(got + 1, data, 100);
    assert_int_equal(got[101], 0);
    DONE(b, brc_buffer_write(x, 0, data, sizeof data));
    DONE(b, brc_buffer_copy(y, x, 1000));
    DONE(b, brc_buffer_read(y, 0, got, sizeof got));
    assert_memory_equal(got, data, 1000);
    for (size_t i = 1000; i < sizeof got; ++i)
        assert_int_equal(got[i], 0);
    DONE(b, brc_buffer_fill_zero(x));
    DONE(b, brc_buffer_read(x, 0, got, sizeof got));
    for (size_t i = 0; i < sizeof got; ++i)
        assert_int_equal(got[i], 0);
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    bench_close(&b);
}

static void a_copy_beyond_the_end_is_refused(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    char data[32] = {0};
    brc_buffer *x = NULL, *y = NULL;
    DONE(b, brc_buffer_create(b.device, &x, 16, "sixteen"));
    DONE(b, brc_buffer_create(b.device, &y, 32, "thirty-two"));
    assert_int_equal(brc_buffer_write(x, 8, data, 9), BRC_INTERNAL);
    assert_int_equal(brc_buffer_read(x, -1, data, 1), BRC_INTERNAL);
    assert_int_equal(brc_buffer_read(x, INT64_MAX, data, INT64_MAX), BRC_INTERNAL);
    assert_int_equal(brc_buffer_copy(x, y, 17), BRC_INTERNAL);
    assert_int_equal(brc_buffer_copy(x, x, 1), BRC_INTERNAL);
    assert_non_null(strstr(brc_context_message(b.context), "buffer of sixteen: cannot write 9 bytes at 8, it has 16"));
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    bench_close(&b);
}

static void a_buffer_of_no_bytes_is_a_valid_argument(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    brc_buffer *empty = NULL, *other = NULL;
    DONE(b, brc_buffer_create(b.device, &empty, 0, "nothing"));
    DONE(b, brc_buffer_create(b.device, &other, 0, "nothing else"));
    assert_int_equal(brc_buffer_bytes(empty), 0);
    assert_int_equal(brc_device_bytes(b.device), 0);
    DONE(b, brc_buffer_write(empty, 0, "", 0));
    DONE(b, brc_buffer_fill_zero(empty));
    DONE(b, brc_buffer_copy(empty, other, 0));
    DONE(b, BRC_LAUNCH(kernel_of(&b, "vector_axpy"), 8, BRC_INT(0), BRC_STATE(1), BRC_BUF(empty), BRC_BUF(NULL)));
    DONE(b, brc_device_wait(b.device));
    brc_buffer_free(&empty);
    brc_buffer_free(&other);
    bench_close(&b);
}

static void held_bytes_are_counted_exactly(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    brc_buffer *x = NULL, *y = NULL;
    assert_int_equal(brc_device_bytes(b.device), 0);
    DONE(b, brc_buffer_create(b.device, &x, 1001, "x"));
    DONE(b, brc_buffer_create(b.device, &y, 3 << 20, "y"));
    assert_int_equal(brc_device_bytes(b.device), 1001 + (3 << 20));
    brc_buffer_free(&x);
    assert_null(x);
    assert_int_equal(brc_device_bytes(b.device), 3 << 20);
    brc_buffer_free(&y);
    assert_int_equal(brc_device_bytes(b.device), 0);
    bench_close(&b);
}

static void a_buffer_that_does_not_fit_is_refused_and_the_device_goes_on(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    brc_buffer *small = NULL, *huge = NULL;
    DONE(b, brc_buffer_create(b.device, &small, 4000, "something small"));
    static const int64_t sizes[] = {(int64_t)1 << 50, INT64_MAX}; /* a petabyte, and what overflows when rounded up */
    for (size_t s = 0; s < 2; ++s) {
        brc_context_clear(b.context);
        assert_int_equal(brc_buffer_create(b.device, &huge, sizes[s], "the stiffness of everything"),
                         BRC_DEVICE_FAILED);
        assert_null(huge);
        const char *const message = brc_context_message(b.context);
        char expected[96];
        snprintf(expected, sizeof expected, "has no room for the stiffness of everything: %lld bytes asked, 4000 held",
                 (long long)sizes[s]);
        if (!strstr(message, expected) || !strstr(message, device_info.selector)) fail_msg("%s", message);
    }
    assert_int_equal(brc_device_bytes(b.device), 4000);
    DONE(b, brc_buffer_create(b.device, &huge, 4000, "something as small"));
    DONE(b, BRC_LAUNCH(kernel_of(&b, "vector_axpy"), 1000, BRC_INT(1000), BRC_STATE(1), BRC_BUF(huge), BRC_BUF(small)));
    DONE(b, brc_device_wait(b.device));
    brc_buffer_free(&huge);
    brc_buffer_free(&small);
    bench_close(&b);
}

static void a_wrong_argument_list_is_refused(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    brc_kernel *const axpy = kernel_of(&b, "vector_axpy");
    assert_int_equal(BRC_LAUNCH(axpy, 1, BRC_INT(1), BRC_BUF(NULL), BRC_BUF(NULL)), BRC_INTERNAL);
    assert_int_equal(BRC_LAUNCH(axpy, 1, BRC_INT(1), BRC_DBL(1), BRC_BUF(NULL), BRC_BUF(NULL)), BRC_INTERNAL);
    assert_int_equal(BRC_LAUNCH(axpy, 1, BRC_INT(1), BRC_COEFF(1), BRC_BUF(NULL), BRC_BUF(NULL)), BRC_INTERNAL);
    assert_int_equal(BRC_LAUNCH(axpy, 1, BRC_INT(1), BRC_STATE(1), BRC_BUF(NULL), BRC_BUF(NULL), BRC_INT(1)),
                     BRC_INTERNAL);
    assert_non_null(strstr(brc_context_message(b.context), "kernel vector_axpy takes isbb"));
    assert_non_null(strstr(brc_context_message(b.context), "was given ibb"));
    brc_kernel *none = NULL;
    assert_int_equal(brc_kernel_find(b.device, "vector_none", &none), BRC_INTERNAL);
    assert_null(none);
    assert_non_null(strstr(brc_context_message(b.context), "no kernel 'vector_none'"));
    bench_close(&b);
}

static void two_devices_share_no_buffers(void **unused)
{
    (void)unused;
    bench a = bench_open(BRC_SINGLE, false, 1), b = bench_open(BRC_SINGLE, false, 2);
    brc_buffer *x = NULL, *y = NULL;
    DONE(a, brc_buffer_create(a.device, &x, 64, "mine"));
    DONE(b, brc_buffer_create(b.device, &y, 64, "yours"));
    assert_int_equal(brc_buffer_copy(y, x, 64), BRC_INTERNAL);
    assert_int_equal(BRC_LAUNCH(kernel_of(&a, "vector_copy"), 8, BRC_INT(8), BRC_BUF(x), BRC_BUF(y)), BRC_INTERNAL);
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    bench_close(&a);
    bench_close(&b);
}

/* x after `rounds` rounds of sums over a list that are added to it: any change of order or rounding would show. */
static void mix(bench *b, double *got, int rounds)
{
    double x[N];
    int32_t index[N];
    ramp(x, N, -1, 0.37);
    for (int i = 0; i < N; ++i)
        index[i] = (int)((long)i * 611 % N);
    brc_buffer *bx = state_buffer(b, x, N), *by = state_buffer(b, NULL, N), *bi = NULL;
    DONE(*b, brc_buffer_create(b->device, &bi, sizeof index, "index"));
    DONE(*b, brc_buffer_write(bi, 0, index, sizeof index));
    for (int round = 0; round < rounds; ++round) {
        DONE(*b, BRC_LAUNCH(kernel_of(b, "vector_sum_listed"), 1, BRC_INT(1), BRC_INT(N - round), BRC_INT(round),
                            BRC_BUF(bi), BRC_BUF(bx), BRC_BUF(by)));
        DONE(*b, BRC_LAUNCH(kernel_of(b, "vector_axpy"), N, BRC_INT(N), BRC_STATE(1.0 / 3), BRC_BUF(by), BRC_BUF(bx)));
    }
    state_read(b, bx, got, N);
    brc_buffer_free(&bx);
    brc_buffer_free(&by);
    brc_buffer_free(&bi);
}

static void exact_work_gives_equal_bytes_for_any_thread_count_and_device(void **unused)
{
    (void)unused;
    for (size_t p = 0; p < 3; ++p) {
        if (!runs_here(precisions[p])) continue;
        double first[N], got[N];
        brc_device_info here = device_info;
        snprintf(device_info.selector, sizeof device_info.selector, "cpu");
        bench reference = bench_open(precisions[p], false, 1);
        mix(&reference, first, 30);
        bench_close(&reference);
        device_info = here;
        bench one = bench_open(precisions[p], false, 1), two = bench_open(precisions[p], false, 2);
        for (int repeat = 0; repeat < 2; ++repeat) {
            mix(&one, got, 30);
            assert_memory_equal(first, got, sizeof got);
            mix(&two, got, 30);
            assert_memory_equal(first, got, sizeof got);
        }
        bench_close(&one);
        bench_close(&two);
    }
}

static void fused_operations_too_give_equal_bytes_for_any_thread_count(void **unused)
{
    (void)unused;
    double first[N], got[N];
    bench one = bench_open_as(BRC_SINGLE, false, 1, false), two = bench_open_as(BRC_SINGLE, false, 2, false);
    mix(&one, first, 30);
    mix(&one, got, 30);
    assert_memory_equal(first, got, sizeof got);
    mix(&two, got, 30);
    assert_memory_equal(first, got, sizeof got);
    bench_close(&one);
    bench_close(&two);
}

static void every_kernel_of_the_list_is_there_in_every_variant(void **unused)
{
    (void)unused;
#define NAME(name) #name,
    static const char *const names[] = {BRC_KERNEL_LIST(NAME)};
    for (size_t p = 0; p < 3; ++p)
        for (int many = 0; many < 2; ++many) {
            if (!runs_here(precisions[p])) continue;
            bench b = bench_open(precisions[p], many, 0);
            assert_int_equal(brc_device_has_many_materials(b.device), many);
            assert_int_equal(brc_device_get_precision(b.device), precisions[p]);
            assert_int_equal(brc_device_slice(b.device) % brc_device_lanes(b.device), 0);
            for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k)
                kernel_of(&b, names[k]);
            bench_close(&b);
        }
}

static void the_copy_bandwidth_is_measured(void **unused)
{
    (void)unused;
    bench b = bench_open(BRC_SINGLE, false, 0);
    double rate = 0;
    DONE(b, brc_device_copy_bandwidth(b.device, 8 << 20, brc_clock_s, &rate));
    assert_true(rate > 1e7 && rate < 1e14); /* bytes per second of anything that computes: a wrong unit would show */
    assert_int_equal(brc_device_bytes(b.device), 0);
    assert_int_equal(brc_device_copy_bandwidth(b.device, 0, brc_clock_s, &rate), BRC_BAD_INPUT);
    bench_close(&b);
}

int device_cases_run(brc_device_kind kind)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_vector_sum_equals_the_host_loop),
        cmocka_unit_test(a_sum_over_a_list_equals_the_host_loop),
        cmocka_unit_test(launches_and_copies_run_in_the_order_given),
        cmocka_unit_test(a_new_buffer_is_zero_and_copies_keep_to_their_offsets),
        cmocka_unit_test(a_copy_beyond_the_end_is_refused),
        cmocka_unit_test(a_buffer_of_no_bytes_is_a_valid_argument),
        cmocka_unit_test(held_bytes_are_counted_exactly),
        cmocka_unit_test(a_buffer_that_does_not_fit_is_refused_and_the_device_goes_on),
        cmocka_unit_test(a_wrong_argument_list_is_refused),
        cmocka_unit_test(two_devices_share_no_buffers),
        cmocka_unit_test(exact_work_gives_equal_bytes_for_any_thread_count_and_device),
        cmocka_unit_test(fused_operations_too_give_equal_bytes_for_any_thread_count),
        cmocka_unit_test(every_kernel_of_the_list_is_there_in_every_variant),
        cmocka_unit_test(the_copy_bandwidth_is_measured),
    };
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    if (!context || brc_device_list_create(context, &list) != BRC_OK) {
        fprintf(stderr, "no device list: %s\n", context ? brc_context_message(context) : "no memory");
        brc_context_free(&context);
        return 1;
    }
    int failures = 0, devices = 0;
    for (int d = 0; d < list->n; ++d) {
        if (list->items[d].kind != kind) continue;
        if (!list->items[d].usable) {
            printf("SKIPPED device %s: %s\n", list->items[d].selector, list->items[d].why_not);
            continue;
        }
        ++devices;
        device_info = list->items[d];
        printf("device %s: %s; %s\n", device_info.selector, device_info.name, device_info.driver);
        failures += cmocka_run_group_tests_name(device_info.selector, tests, NULL, NULL);
    }
    brc_device_list_free(&list);
    brc_context_free(&context);
    if (devices == 0) return test_skip("there is no usable device of this kind");
    return failures ? 1 : 0;
}
