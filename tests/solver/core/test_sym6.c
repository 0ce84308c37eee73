#include "../support.h"
#include "../../../host/solver/core/sym6.h"
#include <math.h>
#include <string.h>

/* B B^T + 0.1 of a random B: eigenvalues from 0.1 to about 10. */
static void make(uint64_t trial, double a[6][6])
{
    double b[6][6];
    for (uint64_t i = 0; i < 6; ++i)
        for (uint64_t j = 0; j < 6; ++j)
            b[i][j] = random_at(36 * trial + 6 * i + j) - 0.5;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            a[i][j] = i == j ? 0.1 : 0;
            for (int k = 0; k < 6; ++k)
                a[i][j] += b[i][k] * b[j][k];
        }
}

/* Rounding times a condition of some hundred. */
static void inverse_times_matrix_is_identity(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 200; ++trial) {
        double a[6][6], inverse[6][6];
        make(trial, a);
        memcpy(inverse, a, sizeof a);
        assert_true(brc_sym6_invert(inverse));
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) {
                double sum = 0;
                for (int k = 0; k < 6; ++k)
                    sum += a[i][k] * (k < j ? inverse[k][j] : inverse[j][k]);
                assert_true(fabs(sum - (i == j)) < 1e-12);
            }
    }
}

static void what_is_not_positive_is_refused(void **state)
{
    (void)state;
    for (int at = 0; at < 6; ++at) {
        double a[6][6];
        make(7, a);
        a[at][at] = -1;
        assert_false(brc_sym6_invert(a));
        a[0][0] = NAN;
        assert_false(brc_sym6_invert(a));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverse_times_matrix_is_identity),
        cmocka_unit_test(what_is_not_positive_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
