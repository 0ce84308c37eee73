#include "support.h"
#include "../../host/base/random.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void equal_arguments_give_equal_bits(void **state)
{
    (void)state;
    double first[4], second[4];
    brc_random_uniform4(7, BRC_RANDOM_TEST, 3, 4, first);
    brc_random_uniform4(8, BRC_RANDOM_TEST, 3, 4, second); /* a draw between changes nothing */
    brc_random_uniform4(7, BRC_RANDOM_TEST, 3, 4, second);
    assert_memory_equal(first, second, sizeof first);
}

/* Every bit of every argument must matter: with 64-bit draws a chance collision is out of question. */
static void each_bit_of_each_argument_changes_the_draw(void **state)
{
    (void)state;
    double base[4], other[4];
    brc_random_uniform4(7, BRC_RANDOM_TEST, 3, 4, base);
    for (int bit = 0; bit < 64; ++bit) {
        const uint64_t flip = (uint64_t)1 << bit;
        brc_random_uniform4(7 ^ flip, BRC_RANDOM_TEST, 3, 4, other);
        assert_memory_not_equal(base, other, sizeof base);
        brc_random_uniform4(7, BRC_RANDOM_TEST, 3 ^ flip, 4, other);
        assert_memory_not_equal(base, other, sizeof base);
        brc_random_uniform4(7, BRC_RANDOM_TEST, 3, 4 ^ flip, other);
        assert_memory_not_equal(base, other, sizeof base);
    }
    brc_random_uniform4(7, BRC_RANDOM_GRID_NOISE, 3, 4, other);
    assert_memory_not_equal(base, other, sizeof base);
}

static void draws_lie_strictly_inside_zero_and_one_and_are_uniform(void **state)
{
    (void)state;
    enum { N = 20000 };
    double sum = 0.0, sum_of_squares = 0.0, sum_of_products = 0.0;
    for (uint64_t k = 0; k < N; ++k) {
        double u[4];
        brc_random_uniform4(1, BRC_RANDOM_TEST, k, 0, u);
        for (int i = 0; i < 4; ++i) {
            assert_true(u[i] > 0.0 && u[i] < 1.0);
            sum += u[i];
            sum_of_squares += u[i] * u[i];
        }
        sum_of_products += u[0] * u[1] + u[2] * u[3];
    }
    /* Five standard deviations of the mean of a uniform number (0.289 / sqrt(n)), its square (0.298) and a product of
     * two (0.22, half as many). */
    const double n = 4.0 * N;
    assert_true(fabs(sum / n - 0.5) < 5.0 * 0.289 / sqrt(n));
    assert_true(fabs(sum_of_squares / n - 1.0 / 3.0) < 5.0 * 0.298 / sqrt(n));
    assert_true(fabs(sum_of_products / (0.5 * n) - 0.25) < 5.0 * 0.22 / sqrt(0.5 * n));
}

/* Files keyed by draws must be the same next year: the numbers of today. */
static void the_stream_never_changes(void **state)
{
    (void)state;
    static const double expected[4] = {0x1.19f5599cp-3, 0x1.803d495p-5, 0x1.faf96718p-4, 0x1.971cb6bdp-1};
    double u[4];
    brc_random_uniform4(2026, BRC_RANDOM_GRID_NOISE, 12345678901ULL, 2, u);
    for (int i = 0; i < 4; ++i)
        assert_true(u[i] == expected[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_arguments_give_equal_bits),
        cmocka_unit_test(each_bit_of_each_argument_changes_the_draw),
        cmocka_unit_test(draws_lie_strictly_inside_zero_and_one_and_are_uniform),
        cmocka_unit_test(the_stream_never_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
