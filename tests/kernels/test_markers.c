/* Markers of arrays in signatures (portable.h) against what kernels read and write: numbers of other elements'
 * rows become NaN, and the results of one element must stay the same where an array is read at its own rows, and change
 * where it is gathered. The passes of an elastic step, on the C build. All other kernels: test_kernel_markers.py. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../host/device/device.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SLICES = 4, SLOTS = 3, MOST_ARRAYS = 24, NAME = 40, SPARE = 16, MOST_NUMBERS = 9 * 16 * SLICES * SLOTS + SPARE };

/* How the rows of an array are stored. */
typedef enum where { STARTS, LISTED, NEIGHBOUR, ROW, BLOCK_OF, ELEMENT, SLOT, SLICE } where;
typedef struct storage {
    const char *name;
    where where;
    int width;
} storage;
static const storage known[] = {
    {"row_start", STARTS, 1},    {"list", LISTED, 1},
    {"neighbour", NEIGHBOUR, 1}, {"ahead", ROW, 1},
    {"boundary", BLOCK_OF, 1},   {"displacement", ELEMENT, 3},
    {"orientation", ELEMENT, 4}, {"velocity", ELEMENT, 3},
    {"force", ELEMENT, 3},       {"torque", ELEMENT, 3},
    {"spin", ELEMENT, 3},        {"mass", ELEMENT, 1},
    {"inertia", ELEMENT, 1},     {"gradient", ELEMENT, 9},
    {"stress", ELEMENT, 9},      {"flux", ELEMENT, 9},
    {"bond_part", ELEMENT, 9},   {"strain", ELEMENT, 6},
    {"volume", ELEMENT, 1},      {"inv_volume", ELEMENT, 1},
    {"modulus", ELEMENT, 1},     {"ell_of", ELEMENT, 1},
    {"lame_of", ELEMENT, 3},     {"beam_of", ELEMENT, 3},
    {"elastic", ELEMENT, 1},     {"stabilisation", ELEMENT, 1},
    {"out", ELEMENT, 1},         {"bond_ratio", ELEMENT, 1},
    {"inv_shape", SLICE, 6},     {"spanned", SLICE, 6},
    {"material", SLICE, 4},      {"held_gradient", SLICE, 9},
    {"held_moment", SLICE, 9},   {"offset", SLOT, 3},
    {"branch", SLOT, 3},         {"ratio", SLOT, 1},
    {"inv_length", SLOT, 1},     {"limit", SLOT, 1},
};

typedef struct array {
    storage is;
    brc_use use;
    int n;
    bool whole_numbers;
    union {
        double real[MOST_NUMBERS];
        int32_t integer[MOST_NUMBERS];
    } first; /* before every launch */
    brc_buffer *buffer;
} array;

typedef struct bench {
    brc_context *context;
    brc_device *device;
    brc_kernel *kernel;
    int lanes, slice, n; /* W, C, elements */
    int one;             /* the element whose results are looked at */
    int n_items, n_args;
    brc_arg args[64];
    int array_of[64]; /* parameter -> array; -1: a number */
    int n_arrays;
    array arrays[MOST_ARRAYS];
} bench;

static storage storage_of(const char *kernel, const char *name)
{
    if (strcmp(name, "area") == 0) return (storage){name, SLOT, strncmp(kernel, "dlsm", 4) == 0 ? 3 : 1};
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
        if (strcmp(known[k].name, name) == 0) return known[k];
    printf("kernel %s: where its array '%s' is stored is not known here\n", kernel, name);
    fail();
    return known[0];
}

/* The element that a number of an array belongs to; -1: to none. */
static int element_of(const bench *b, const array *a, int at)
{
    const int width = a->is.width;
    switch (a->is.where) {
    case ROW:
    case ELEMENT: return at / width < b->n ? at / width : -1;
    case NEIGHBOUR:
    case SLOT:
        return at / (width * b->slice * SLOTS) < SLICES ? at / (width * b->slice * SLOTS) * b->slice + at % b->slice
                                                        : -1;
    case SLICE: return at / (width * b->slice) < SLICES ? at / (width * b->slice) * b->slice + at % b->slice : -1;
    case BLOCK_OF: return at < SLICES && at != b->one / b->slice ? at * b->slice : b->one;
    default: return -1;
    }
}

static int numbers_of(const bench *b, storage is)
{
    switch (is.where) {
    case STARTS: return SLICES + 1;
    case LISTED: return 1;
    case BLOCK_OF: return SLICES;
    case ROW:
    case ELEMENT:
    case SLICE: return b->n * is.width;
    default: return b->n * is.width * SLOTS;
    }
}

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void fill(const bench *b, array *a, uint32_t *seed)
{
    memset(&a->first, 0, sizeof a->first);
    a->n = numbers_of(b, a->is);
    for (int k = 0; k < a->n; ++k) {
        const int slot = k / b->slice; /* of NEIGHBOUR: others, in other slices */
        switch (a->is.where) {
        case STARTS: a->first.integer[k] = SLOTS * k; break;
        case LISTED: a->first.integer[k] = b->one; break;
        case NEIGHBOUR:
            a->first.integer[k] = (element_of(b, a, k) + (slot % SLOTS + 1) * b->slice + 3 * slot + 1) % b->n;
            break;
        case ROW: a->first.integer[k] = (k + b->slice) % b->n; break;
        case BLOCK_OF: a->first.integer[k] = k; break;
        default:
            if (strcmp(a->is.name, "displacement") == 0) { /* apart by less than what branches are long */
                a->first.real[k] = 1 + 1e-5 * (double)(next(seed) % 1000);
                break;
            }
            a->first.real[k] = 0.5 + (double)(next(seed) % 1000) / 1000;
            break;
        }
    }
}

static void set_up(bench *b, const char *name, bool many_materials)
{
    uint32_t seed = 7;
    *b = (bench){.context = brc_context_create()};
    const brc_device_request request = {.selector = "cpu", .precision = BRC_DOUBLE, .many_materials = many_materials};
    assert_int_equal(brc_device_open(b->context, &request, &b->device), BRC_OK);
    assert_int_equal(brc_kernel_find(b->device, name, &b->kernel), BRC_OK);
    b->lanes = brc_device_lanes(b->device);
    b->slice = brc_device_slice(b->device);
    b->n = SLICES * b->slice;
    b->one = b->slice + b->slice / 2;
    b->n_args = brc_kernel_parameters(b->kernel);
    assert_true(b->n_args > 0);
    static char names[MOST_ARRAYS][NAME];
    for (int k = 0; k < b->n_args; ++k) {
        char word[NAME];
        const brc_arg_kind kind = brc_kernel_parameter(b->kernel, k, word, sizeof word);
        b->array_of[k] = -1;
        b->args[k] = kind == BRC_ARG_INT ? BRC_INT(1) : (brc_arg){.kind = kind, .value.real = 0.3};
        if (kind != BRC_ARG_BUFFER) continue;
        assert_true(b->n_arrays < MOST_ARRAYS);
        array *a = &b->arrays[b->n_arrays];
        snprintf(names[b->n_arrays], NAME, "%s", word);
        a->is = storage_of(name, names[b->n_arrays]);
        a->use = brc_kernel_use(b->kernel, k);
        a->whole_numbers = a->is.where <= BLOCK_OF;
        fill(b, a, &seed);
        assert_true(a->n + SPARE <= MOST_NUMBERS);
        assert_int_equal(brc_buffer_create(b->device, &a->buffer, 8 * (a->n + SPARE), word), BRC_OK);
        b->args[k] = BRC_BUF(a->buffer);
        b->array_of[k] = b->n_arrays++;
    }
    char second[NAME];
    brc_kernel_parameter(b->kernel, 1, second, sizeof second);
    const bool listed = strcmp(second, "n") == 0; /* ... of a list of one */
    char first[NAME];
    brc_kernel_parameter(b->kernel, 0, first, sizeof first);
    const bool by_element = strcmp(first, "n") == 0 || strcmp(first, "n_rows") == 0;
    b->n_items = listed ? 1 : by_element ? b->n : b->n / b->lanes;
    b->args[0] = BRC_INT(b->n_items);
}

static void tear_down(bench *b)
{
    for (int k = 0; k < b->n_arrays; ++k)
        brc_buffer_free(&b->arrays[k].buffer);
    brc_device_close(&b->device);
    brc_context_free(&b->context);
}

/* Array `poisoned` (-1: none) with its numbers times `factor`, or other neighbours and no blocks, in the rows of other
 * elements. */
static void launch(bench *b, int poisoned, double factor)
{
    for (int k = 0; k < b->n_arrays; ++k) {
        array *a = &b->arrays[k];
        static union {
            double real[MOST_NUMBERS];
            int32_t integer[MOST_NUMBERS];
        } now;
        memcpy(&now, &a->first, sizeof now);
        for (int i = 0; k == poisoned && i < a->n; ++i) {
            const int e = element_of(b, a, i);
            if (e < 0 || e == b->one) continue;
            if (!a->whole_numbers)
                now.real[i] *= factor;
            else
                now.integer[i] = a->is.where == BLOCK_OF ? -1 : 0;
        }
        assert_int_equal(brc_buffer_write(a->buffer, 0, &now, (a->whole_numbers ? 4 : 8) * (int64_t)a->n), BRC_OK);
    }
    assert_int_equal(brc_kernel_launch(b->kernel, b->n_items, b->n_args, b->args), BRC_OK);
}

typedef struct results {
    int n;
    double of[64];
} results;

/* What stands in the rows of the one element, of all arrays that are written; others[0]: how many numbers of other
 * elements are not what they were. */
static results results_of(const bench *b, int *others)
{
    results r = {0};
    *others = 0;
    for (int k = 0; k < b->n_arrays; ++k) {
        const array *a = &b->arrays[k];
        static double now[MOST_NUMBERS];
        if (!brc_use_writes(a->use)) continue;
        assert_int_equal(brc_buffer_read(a->buffer, 0, now, 8 * (int64_t)a->n), BRC_OK);
        for (int i = 0; i < a->n; ++i)
            if (element_of(b, a, i) != b->one)
                *others += memcmp(&now[i], &a->first.real[i], sizeof now[i]) != 0;
            else if (r.n < 64)
                r.of[r.n++] = now[i];
    }
    return r;
}

static void check(const char *name, bool many_materials)
{
    static bench b;
    int others;
    set_up(&b, name, many_materials);
    launch(&b, -1, 1);
    const results expected = results_of(&b, &others);
    assert_true(expected.n > 0 && expected.n < 64);
    for (int k = 0; k < expected.n; ++k)
        assert_true(isfinite(expected.of[k]));
    if (strstr(name, "_listed")) assert_int_equal(others, 0); /* a list of one writes its own rows alone */
    for (int k = 0; k < b.n_arrays; ++k) {
        const array *a = &b.arrays[k];
        if (a->is.where == STARTS || a->is.where == LISTED || a->use == BRC_USE_PUT) continue;
        bool same = true;
        for (int way = 0; way < 2; ++way) { /* the lesser of a number and NaN is the number */
            launch(&b, k, way == 0 ? NAN : 0.25);
            const results found = results_of(&b, &others);
            same = same && memcmp(expected.of, found.of, sizeof(double) * (size_t)expected.n) == 0;
        }
        const bool gathers = a->use == BRC_USE_GATHER && many_materials; /* one material: some are not read */
        if (same && gathers) printf("%s: '%s' is gathered, and other rows count for nothing\n", name, a->is.name);
        if (!same && a->use != BRC_USE_GATHER) printf("%s: '%s' is read at other rows\n", name, a->is.name);
        assert_true(gathers ? !same : same || a->use == BRC_USE_GATHER);
    }
    tear_down(&b);
}

static void own_rows_alone_are_read_and_gathers_are_not(void **unused)
{
    (void)unused;
    static const char *const passes[] = {"dlsm_gradient",
                                         "dlsm_stress",
                                         "dlsm_flux_pass",
                                         "dlsm_flux_linear",
                                         "dlsm_force",
                                         "dlsm_energy",
                                         "dlsm_gradient_listed",
                                         "dlsm_stress_listed",
                                         "dlsm_flux_pass_listed",
                                         "dlsm_force_listed",
                                         "dlsm_energy_listed",
                                         "published_strain_pass",
                                         "published_force_pass",
                                         "published_energy",
                                         "published_force_pass_listed",
                                         "published_energy_listed",
                                         "published_breaking_strain",
                                         "published_breaking_force",
                                         "published_breaking_strain_listed",
                                         "published_breaking_force_listed",
                                         "cbm_force_pass",
                                         "cbm_energy",
                                         "advance",
                                         "advance_rotation",
                                         "kinetic_energy"};
    for (size_t k = 0; k < sizeof passes / sizeof *passes; ++k) {
        check(passes[k], true);
        check(passes[k], false);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(own_rows_alone_are_read_and_gathers_are_not)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
