#include "../spheres.h"
#include "../support.h"

#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/quality.h"

#include <stdio.h>
#include <string.h>

static brc_quality_limit refuse(const char *number, double value)
{
    brc_quality_limit limit = {.has_refuse = true, .refuse = value};
    strcpy(limit.number, number);
    return limit;
}

static brc_status judge(brc_context *context, const brc_domain *d, brc_quality_limit limit)
{
    brc_context_clear(context);
    return brc_quality_judge(context, d, 1, &limit);
}

/* On cubes all numbers are known; limits exactly on the value hold, beyond it they do not. */
static void limits_hold_up_to_the_value_and_not_beyond(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &r);
    const struct {
        const char *name;
        double good, bad;
    } cases[] = {
        {"coordination_least", 3, 4},
        {"pieces", 1, 0.5},
        {"unbonded", 0, -0.5},
        {"smallest_distance", 0.999, 1.001},
        {"support", 0.499, 0.501},
        {"volume_error", 1e-12, -1e-12},
        {"duplicates", 0, -1},
        {"lost", 0, -1},
        {"tiny_faces", 0, -1},
        {"tiny_face_area", 0, -1},
        {"closure", 1e-12, -1},
        {"twin_area", 1e-12, -1},
        /* directions of a grid of cubes: 900 bonds along each axis; the fabric is even, the bins are not, the cubic
           order is 2/3 */
        {"anisotropy_fabric", 1e-12, -1},
        {"anisotropy_worst_bin", 100, 10},
        {"anisotropy_rms", 100, 1},
        {"anisotropy_excess", 100, 1},
        {"anisotropy_cubic", 0.667, 0.666},
    };
    int32_t n;
    const brc_quality_number *numbers = brc_quality_numbers(&n);
    assert_int_equal(n, sizeof cases / sizeof *cases); /* none is left out here */
    for (int32_t k = 0; k < n; ++k) {
        const brc_quality_number *number = NULL;
        for (int32_t m = 0; m < n; ++m)
            if (strcmp(numbers[m].name, cases[k].name) == 0) number = &numbers[m];
        assert_non_null(number);
        if (judge(*state, d, refuse(cases[k].name, cases[k].good)) != BRC_OK)
            fail_msg("%s", brc_context_message(*state));
        if (judge(*state, d, refuse(cases[k].name, cases[k].bad)) != BRC_BAD_INPUT) fail_msg("%s holds", cases[k].name);
        test_says(*state, cases[k].name);
        test_says(*state, number->cure);
    }
    brc_domain_free(&d);
}

static void all_broken_limits_are_listed_in_one_sentence(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &r);
    const brc_quality_limit limits[4] = {refuse("support", 0.7),
                                         refuse("pieces", 1.0),
                                         refuse("coordination_least", 4.0),
                                         {.number = "smallest_distance", .has_warn = true, .warn = 2.0}};
    assert_int_equal(brc_quality_judge(*state, d, 4, limits), BRC_BAD_INPUT);
    test_says(*state, "support is 0.5, must be at least 0.7");
    test_says(*state, "coordination_least is 3, must be at least 4");
    const char *message = brc_context_message(*state);
    assert_null(strstr(message, "pieces"));
    assert_null(strstr(message, "smallest_distance")); /* a warning is no refusal */
    assert_null(strchr(message, '\n'));
    brc_domain_free(&d);
}

static void unknown_and_unfitting_numbers_are_refused(void **state)
{
    const int count[3] = {4, 4, 4};
    brc_domain *d = test_spheres(*state, count, 8.0, 0, 1);
    assert_int_equal(judge(*state, d, refuse("suport", 1.0)), BRC_BAD_INPUT);
    test_says(*state, "there is no number 'suport'; there are duplicates, smallest_distance, coordination_least, "
                      "pieces, unbonded, anisotropy_fabric");
    assert_int_equal(judge(*state, d, refuse("support", 1.0)), BRC_BAD_INPUT);
    test_says(*state, "'support' is a number of cells, this body is made of spheres");
    assert_int_equal(judge(*state, d, refuse("pieces", NAN)), BRC_BAD_INPUT);
    test_says(*state, "the limits of 'pieces' must be finite");
    assert_int_equal(judge(*state, d, refuse("unbonded", 0.0)),
                     d->quality.n_elements_without_bond > 0 ? BRC_BAD_INPUT : BRC_OK);
    assert_int_equal(brc_quality_judge(*state, d, 0, NULL), BRC_OK);
    brc_domain_free(&d);
}

static void every_number_is_in_the_documentation(void **state)
{
    int32_t n;
    char *text;
    size_t bytes;
    const brc_quality_number *numbers = brc_quality_numbers(&n);
    assert_int_equal(
        brc_file_read_whole(*state, BRC_SOURCE_DIR_PATH "/docs/reference/domain.md", 1 << 20, &text, &bytes), BRC_OK);
    for (int32_t k = 0; k < n; ++k) {
        char row[512];
        snprintf(row, sizeof row, "| `%s` | %s | %s |", numbers[k].name, numbers[k].meaning,
                 numbers[k].less_is_worse ? "less" : "more");
        if (!strstr(text, row)) fail_msg("docs/reference/domain.md has no row \"%s\"", row);
    }
    brc_memory_free(text);
}

/* Few bonds among many spheres. */
static void loose_elements_are_counted(void **state)
{
    const int count[3] = {4, 4, 4};
    brc_domain *d = test_spheres(*state, count, 0.2, 0, 1); /* six bonds for 64 spheres */
    int64_t alone = 0;
    for (int64_t e = 0; e < 64; ++e)
        alone += d->row_start[e + 1] == d->row_start[e];
    assert_int_equal(d->n_bonds, 6);
    assert_int_equal(d->quality.n_elements_without_bond, alone);
    /* few bonds do not close circles: each joins two pieces */
    assert_int_equal(d->quality.n_pieces, 64 - 6);
    assert_int_equal(judge(*state, d, refuse("unbonded", (double)alone - 1)), BRC_BAD_INPUT);
    assert_int_equal(judge(*state, d, refuse("pieces", 58)), BRC_OK);
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(limits_hold_up_to_the_value_and_not_beyond, test_begin, test_end),
        cmocka_unit_test_setup_teardown(all_broken_limits_are_listed_in_one_sentence, test_begin, test_end),
        cmocka_unit_test_setup_teardown(unknown_and_unfitting_numbers_are_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_number_is_in_the_documentation, test_begin, test_end),
        cmocka_unit_test_setup_teardown(loose_elements_are_counted, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
