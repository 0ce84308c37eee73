#include "../support.h"

#include "../../../preprocess/domain/quality.h"
#include "../spheres.h"

#include <stdlib.h>
#include <string.h>

/* On cubes everything is known: A = sum over both neighbours along each axis of (L/S) S^2 = 2 V, so A/(2V) has the
 * eigenvalues 1; a corner cube has one neighbour along each axis and 1/2. */
static void cubes_have_the_quality_computed_by_hand(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &r);
    const brc_quality *q = &d->quality;
    assert_near(q->support_smallest, 0.5, 1e-7); /* acos loses half the digits at equal eigenvalues */
    assert_near(q->smallest_distance, 0.1, 1e-15);
    assert_near(q->mean_spacing, 0.1, 1e-15);
    assert_near(q->coordination_mean, 5.4, 1e-15);
    assert_near(q->volume_error, 0.0, 1e-14);
    assert_int_equal(q->n_seeds_requested, 1000);
    assert_int_equal(q->n_seeds_lost, 0);
    brc_domain_free(&d);
}

/* The smallest eigenvalue l makes A - l I singular and positive semi-definite: its determinant vanishes. */
static void support_is_the_smallest_eigenvalue(void **state)
{
    const brc_build_request r = test_box(27, 1.0);
    brc_domain *d = test_build(*state, &r);
    double least = HUGE_VAL;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double a[3][3] = {{0.0}};
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const double *s = d->area_vector + 3 * h, *x = d->position + 3 * e;
            const double *y = d->position + 3 * (int64_t)d->neighbour[h];
            const double length =
                sqrt((y[0] - x[0]) * (y[0] - x[0]) + (y[1] - x[1]) * (y[1] - x[1]) + (y[2] - x[2]) * (y[2] - x[2]));
            const double area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    a[i][j] += length / area * s[i] * s[j] / (2.0 * d->volume[e]);
        }
        double low = 0.0, high = 10.0; /* bisection on the sign of the leading minors of A - l I */
        for (int k = 0; k < 60; ++k) {
            const double l = 0.5 * (low + high), b = a[0][0] - l, c = b * (a[1][1] - l) - a[0][1] * a[1][0];
            const double det = c * (a[2][2] - l) - b * a[1][2] * a[2][1] - a[0][2] * a[0][2] * (a[1][1] - l) +
                               2.0 * a[0][1] * a[1][2] * a[0][2];
            if (b > 0.0 && c > 0.0 && det > 0.0)
                low = l;
            else
                high = l;
        }
        least = fmin(least, low);
    }
    assert_near(d->quality.support_smallest, least, 1e-7);
    brc_domain_free(&d);
}

static void the_printed_table_holds_the_numbers_and_the_histogram(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &r);
    FILE *file = tmpfile();
    assert_non_null(file);
    brc_quality_print(file, d);
    char text[4096] = "";
    rewind(file);
    const size_t n = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[n] = '\0';
    const char *const parts[] = {"asked for 1000",
                                 "5.400 per element",
                                 "    3           8 ",
                                 "    6         512 ####",
                                 "relative error",
                                 "support",
                                 "pieces           1; elements without bonds 0",
                                 "cell volumes     1 | 1 | 1 | 1 | 1 of the mean",
                                 "faces of a cell  6 | 6 | 6 | 6 | 6 "};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
        if (!strstr(text, parts[k])) fail_msg("'%s' is missing in\n%s", parts[k], text);
    brc_domain_free(&d);
}

static int compare(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* The five numbers of a spread, by sorting. Single precision holds seven digits. */
static void assert_spread(const double spread[5], double *value, int64_t n, double unit)
{
    static const double share[5] = {0.0, 0.05, 0.5, 0.95, 1.0};
    qsort(value, (size_t)n, sizeof *value, compare);
    for (int k = 0; k < 5; ++k) {
        const double expected = value[(int64_t)(share[k] * (double)(n - 1))] / unit;
        assert_near(spread[k], expected, 1e-7 * expected);
    }
}

static void spreads_are_those_of_the_sorted_values(void **state)
{
    const int count[3] = {9, 8, 7};
    const brc_build_request r = test_box(700, 0.9);
    brc_domain *both[2] = {test_build(*state, &r), test_spheres(*state, count, 9.0, 0, 2)};
    for (int k = 0; k < 2; ++k) {
        const brc_domain *d = both[k];
        double *value = malloc((size_t)(d->n_elements + d->n_bonds) * sizeof *value), sum = 0.0;
        for (int64_t e = 0; e < d->n_elements; ++e)
            sum += value[e] = d->volume[e];
        assert_spread(d->quality.volume_spread, value, d->n_elements, sum / (double)d->n_elements);
        for (int64_t e = 0, b = 0; e < d->n_elements; ++e)
            for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
                const double *x = d->position + 3 * e, *y = d->position + 3 * (int64_t)d->neighbour[h];
                if (d->neighbour[h] > e)
                    value[b++] = sqrt(pow(x[0] - y[0], 2) + pow(x[1] - y[1], 2) + pow(x[2] - y[2], 2));
            }
        assert_spread(d->quality.branch_spread, value, d->n_bonds, d->quality.mean_spacing);
        for (int64_t e = 0; e < d->n_elements && k == 0; ++e)
            value[e] = (double)(d->row_start[e + 1] - d->row_start[e] + d->free_start[e + 1] - d->free_start[e]);
        if (k == 0) assert_spread(d->quality.faces_spread, value, d->n_elements, 1.0);
        free(value);
    }
    assert_near(both[1]->quality.mean_spacing, 1.0, 1e-14); /* a sphere a cubic metre */
    assert_near(both[1]->quality.volume_error, 0.0, 0.0);
    brc_domain_free(&both[0]);
    brc_domain_free(&both[1]);
}

static void spheres_print_what_they_have(void **state)
{
    const int count[3] = {4, 4, 4};
    brc_domain *d = test_spheres(*state, count, 8.0, 0, 1);
    char text[4096] = "";
    FILE *file = fmemopen(text, sizeof text, "w");
    assert_non_null(file);
    brc_quality_print(file, d);
    fclose(file);
    const char *const parts[] = {"fraction 0.", "sphere volumes",    "growth ",
                                 "branches ",   "8.000 per element", "pieces           1;"};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
        if (!strstr(text, parts[k])) fail_msg("'%s' is missing in\n%s", parts[k], text);
    assert_null(strstr(text, "closure"));
    assert_null(strstr(text, "tiny faces"));
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cubes_have_the_quality_computed_by_hand, test_begin, test_end),
        cmocka_unit_test_setup_teardown(support_is_the_smallest_eigenvalue, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spreads_are_those_of_the_sorted_values, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_print_what_they_have, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_printed_table_holds_the_numbers_and_the_histogram, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
