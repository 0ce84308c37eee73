#include "../support.h"
#include "../../../host/solver/core/sym3.h"
#include <math.h>

static void eigenvectors_rebuild_the_matrix(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 200; ++trial) {
        double a[6], values[3], v[3][3], back[6] = {0};
        for (uint64_t c = 0; c < 6; ++c)
            a[c] = random_at(6 * trial + c) * (trial % 7 == 0 ? 1e-9 : 1) * (c > 2 && trial % 5 == 0 ? 0 : 1);
        brc_sym3_eigen(a, values, v);
        assert_true(values[0] <= values[1] && values[1] <= values[2]);
        static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
        double size = fabs(values[0]) + fabs(values[2]);
        for (int c = 0; c < 6; ++c) {
            for (int k = 0; k < 3; ++k)
                back[c] += values[k] * v[k][pair[c][0]] * v[k][pair[c][1]];
            assert_true(fabs(back[c] - a[c]) <= 1e-14 * size); /* a few roundings */
        }
    }
}

static void inverse_times_matrix_is_identity(void **state)
{
    (void)state;
    const double a[6] = {4, 3, 2, 0.5, -0.3, 0.7};
    double b[6];
    assert_int_equal(brc_sym3_pseudo_inverse(a, 1e-12, b), 3);
    const double m[3][3] = {{a[0], a[5], a[4]}, {a[5], a[1], a[3]}, {a[4], a[3], a[2]}};
    const double n[3][3] = {{b[0], b[5], b[4]}, {b[5], b[1], b[3]}, {b[4], b[3], b[2]}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double sum = 0;
            for (int k = 0; k < 3; ++k)
                sum += m[i][k] * n[k][j];
            assert_true(fabs(sum - (i == j)) < 1e-14);
        }
}

static void flat_matrix_is_inverted_over_what_it_spans(void **state)
{
    (void)state;
    const double plane[6] = {2, 4, 0, 0, 0, 0}, line[6] = {0, 0, 5, 0, 0, 0}, none[6] = {0};
    double out[6];
    assert_int_equal(brc_sym3_pseudo_inverse(plane, 1e-6, out), 2);
    assert_true(fabs(out[0] - 0.5) < 1e-15 && fabs(out[1] - 0.25) < 1e-15 && out[2] == 0);
    assert_int_equal(brc_sym3_pseudo_inverse(line, 1e-6, out), 1);
    assert_true(fabs(out[2] - 0.2) < 1e-15 && out[0] == 0);
    assert_int_equal(brc_sym3_pseudo_inverse(none, 1e-6, out), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eigenvectors_rebuild_the_matrix),
        cmocka_unit_test(inverse_times_matrix_is_identity),
        cmocka_unit_test(flat_matrix_is_inverted_over_what_it_spans),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
