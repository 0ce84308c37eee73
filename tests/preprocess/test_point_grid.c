#include "support.h"

#include "../../host/base/random.h"
#include "../../preprocess/point_grid.h"

/* Points on a coarse lattice, so that many are equally near, some of them beyond the bounds. */
static void draw(uint64_t k, double x[3])
{
    double u[4];
    brc_random_uniform4(5, BRC_RANDOM_TEST, k, 0, u);
    for (int c = 0; c < 3; ++c)
        x[c] = floor(12.0 * u[c]) / 8.0 - 0.25;
}

static void the_nearest_point_is_that_of_brute_force(void **state)
{
    enum { N = 300, TRIES = 400 };
    static const double bounds[2][3] = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    static const double edges[] = {1e-9, 0.05, 0.3, 5.0};
    for (size_t t = 0; t < sizeof edges / sizeof *edges; ++t) {
        brc_point_grid *grid = NULL;
        static double position[N][3];
        assert_int_equal(brc_point_grid_create(*state, bounds, edges[t], N, &grid), BRC_OK);
        double x[3] = {0.5, 0.5, 0.5};
        assert_int_equal(brc_point_grid_nearest(grid, x), -1);
        for (int n = 0; n < N; ++n) {
            draw((uint64_t)n, position[n]);
            brc_point_grid_add(grid, position[n]);
        }
        for (int k = 0; k < TRIES; ++k) {
            draw(100000u + (uint64_t)k, x);
            if (k % 3 == 0) x[0] *= 20.0; /* far beyond the bounds */
            double least = HUGE_VAL;
            int nearest = -1;
            for (int n = 0; n < N; ++n) {
                const double r[3] = {x[0] - position[n][0], x[1] - position[n][1], x[2] - position[n][2]};
                const double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
                if (square < least) {
                    least = square;
                    nearest = n;
                }
            }
            assert_int_equal(brc_point_grid_nearest(grid, x), nearest);
            assert_false(brc_point_grid_crowded(grid, x, sqrt(least) * (1.0 - 1e-12)));
            assert_true(brc_point_grid_crowded(grid, x, sqrt(least) * (1.0 + 1e-12) + 1e-30));
        }
        brc_point_grid_free(&grid);
    }
}

static void bounds_without_extent_are_no_trouble(void **state)
{
    const double bounds[2][3] = {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
    brc_point_grid *grid = NULL;
    assert_int_equal(brc_point_grid_create(*state, bounds, 0.0, 2, &grid), BRC_OK);
    brc_point_grid_add(grid, bounds[0]);
    brc_point_grid_add(grid, bounds[1]);
    const double x[3] = {-1.0, 0.0, 7.0};
    assert_int_equal(brc_point_grid_nearest(grid, x), 0);
    brc_point_grid_free(&grid);
    assert_null(grid);
    brc_point_grid_free(&grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_nearest_point_is_that_of_brute_force, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bounds_without_extent_are_no_trouble, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
