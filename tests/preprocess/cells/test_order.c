#include "../support.h"

#include "../../../host/base/random.h"
#include "../../../preprocess/cells/order.h"

#include <string.h>

/* What makes it a Hilbert curve: it visits a whole grid in steps of one grid cell. */
static void the_curve_visits_a_grid_from_neighbour_to_neighbour(void **state)
{
    enum { SIDE = 8, N = SIDE * SIDE * SIDE };
    double x[N][3];
    int32_t order[N], seen[N] = {0};
    for (int k = 0; k < N; ++k) { /* in an order that has nothing to do with the curve */
        const int cell = 211 * k % N;
        x[k][0] = cell % SIDE;
        x[k][1] = cell / SIDE % SIDE;
        x[k][2] = cell / (SIDE * SIDE);
    }
    assert_int_equal(brc_order_hilbert(*state, x[0], N, NULL, 1, order), BRC_OK);
    for (int k = 0; k < N; ++k) {
        assert_true(order[k] >= 0 && order[k] < N && seen[order[k]]++ == 0);
        if (k == 0) continue;
        const double *a = x[order[k - 1]], *b = x[order[k]];
        assert_true(fabs(a[0] - b[0]) + fabs(a[1] - b[1]) + fabs(a[2] - b[2]) == 1.0);
    }
}

static void equal_points_keep_their_order_and_threads_change_nothing(void **state)
{
    enum { N = 3000 };
    static double x[N][3];
    static int32_t one[N], two[N];
    for (int k = 0; k < N; ++k) {
        double u[4];
        brc_random_uniform4(1, BRC_RANDOM_TEST, (uint64_t)(k % 1000), 0, u); /* every point three times */
        memcpy(x[k], u, sizeof x[k]);
    }
    const double bounds[2][3] = {{-1, 0, 0}, {0.5, 1, 1}}; /* points outside count as on the surface */
    assert_int_equal(brc_order_hilbert(*state, x[0], N, bounds, 1, one), BRC_OK);
    assert_int_equal(brc_order_hilbert(*state, x[0], N, bounds, 2, two), BRC_OK);
    assert_memory_equal(one, two, sizeof one);
    assert_int_equal(brc_order_hilbert(*state, x[0], N, NULL, 2, one), BRC_OK);
    for (int k = 0; k < N; k += 3) {
        assert_int_equal(one[k + 1], one[k] + 1000);
        assert_int_equal(one[k + 2], one[k] + 2000);
    }
}

static void points_move_with_their_radii(void **state)
{
    enum { N = 500 };
    double x[N][3], r[N], before = 0.0, after = 0.0;
    for (int k = 0; k < N; ++k) {
        double u[4];
        brc_random_uniform4(2, BRC_RANDOM_TEST, (uint64_t)k, 0, u);
        memcpy(x[k], u, sizeof x[k]);
        r[k] = u[0] + 2.0 * u[1] + 4.0 * u[2];
        if (k > 0) before += hypot(hypot(x[k][0] - x[k - 1][0], x[k][1] - x[k - 1][1]), x[k][2] - x[k - 1][2]);
    }
    assert_int_equal(brc_order_points(*state, x[0], r, N, 1), BRC_OK);
    for (int k = 0; k < N; ++k) {
        assert_true(r[k] == x[k][0] + 2.0 * x[k][1] + 4.0 * x[k][2]);
        if (k > 0) after += hypot(hypot(x[k][0] - x[k - 1][0], x[k][1] - x[k - 1][1]), x[k][2] - x[k - 1][2]);
    }
    /* random neighbours are 0.66 apart, those along the curve about the spacing, 500^(-1/3) = 0.13 */
    assert_true(after < 0.3 * before);
    assert_int_equal(brc_order_points(*state, x[0], NULL, N, 1), BRC_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_curve_visits_a_grid_from_neighbour_to_neighbour, test_begin, test_end),
        cmocka_unit_test_setup_teardown(equal_points_keep_their_order_and_threads_change_nothing, test_begin, test_end),
        cmocka_unit_test_setup_teardown(points_move_with_their_radii, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
