#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/packing/start.h"

#include <string.h>

static brc_solid *cube(brc_context *context)
{
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {1.0, 1.0, 1.0}};
    brc_solid *solid;
    assert_int_equal(brc_solid_create(context, &box, 1, &solid), BRC_OK);
    return solid;
}

static void exactly_as_many_start_points_as_asked_lie_inside(void **state)
{
    const brc_shape shapes[] = {{.kind = BRC_SHAPE_BOX, .size = {1.0, 2.0, 0.5}},
                                {.kind = BRC_SHAPE_SPHERE, .radius = 2.0, .origin = {5.0, 0.0, 0.0}},
                                {.kind = BRC_SHAPE_CYLINDER, .radius = 0.1, .length = 5.0, .axis = 2},
                                {.kind = BRC_SHAPE_TORUS, .radius = 1.0, .radius2 = 0.2}};
    const int64_t numbers[] = {1, 7, 100, 3001};
    const brc_fill fill = {.kind = BRC_FILL_PACKING, .seed = 4};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; ++s) {
        brc_solid *solid;
        assert_int_equal(brc_solid_create(*state, &shapes[s], 1, &solid), BRC_OK);
        for (int k = 0; k < 4; ++k) {
            double *x, *again, deepest, deep_again;
            const double margin = 0.02;
            if (brc_pack_start(*state, solid, &fill, numbers[k], margin, 1, &x, &deepest) != BRC_OK)
                fail_msg("%s", brc_context_message(*state));
            double most = 0.0;
            for (int64_t i = 0; i < numbers[k]; ++i) {
                assert_true(brc_solid_inside(solid, x + 3 * i, margin));
                most = fmax(most, brc_solid_depth(solid, x + 3 * i));
            }
            assert_near(most, deepest, 0.0);
            assert_int_equal(brc_pack_start(*state, solid, &fill, numbers[k], margin, 3, &again, &deep_again), BRC_OK);
            assert_memory_equal(x, again, (size_t)numbers[k] * 3 * sizeof *x);
            brc_memory_free(x);
            brc_memory_free(again);
        }
        brc_solid_free(&solid);
    }
}

/* 64 000 points in eight octants. Thrown at random, the squares of the deviations from 8000 sum up to 8 * 8000 * 7/8 =
 * 56 000 in the mean; one in each cell of a grid, only the 3 * 400 cells that a plane between octants cuts can deviate,
 * by at most 1/4 each: 8 * 1200 / 4 = 2400 at most in the mean. */
static void every_region_holds_its_share_of_start_points(void **state)
{
    const int64_t n = 64000;
    const brc_fill fill = {.kind = BRC_FILL_PACKING, .seed = 9};
    brc_solid *solid = cube(*state);
    double *x, deepest, squares = 0.0;
    int64_t counts[8] = {0};
    assert_int_equal(brc_pack_start(*state, solid, &fill, n, 0.005, 1, &x, &deepest), BRC_OK);
    for (int64_t i = 0; i < n; ++i)
        counts[(x[3 * i] > 0.5) + 2 * (x[3 * i + 1] > 0.5) + 4 * (x[3 * i + 2] > 0.5)]++;
    for (int k = 0; k < 8; ++k)
        squares += pow((double)(counts[k] - n / 8), 2.0);
    assert_true(squares < 3.0 * 2400.0);
    brc_memory_free(x);
    brc_solid_free(&solid);
}

static void other_seeds_give_other_points_and_radii(void **state)
{
    const brc_fill one = {.kind = BRC_FILL_PACKING, .seed = 1, .radius_spread = 0.1},
                   two = {.kind = BRC_FILL_PACKING, .seed = 2, .radius_spread = 0.1};
    brc_solid *solid = cube(*state);
    double *a, *b, deepest;
    assert_int_equal(brc_pack_start(*state, solid, &one, 100, 0.01, 1, &a, &deepest), BRC_OK);
    assert_int_equal(brc_pack_start(*state, solid, &two, 100, 0.01, 1, &b, &deepest), BRC_OK);
    assert_true(memcmp(a, b, 300 * sizeof *a) != 0);
    assert_true(brc_pack_radius(&one, 0) != brc_pack_radius(&two, 0));
    brc_memory_free(a);
    brc_memory_free(b);
    brc_solid_free(&solid);
}

/* Draws against the exact moments, five standard errors allowed. */
static void compare_moments(const brc_fill *fill, double square, double cube_mean, double largest)
{
    enum { DRAWS = 100000 };
    double sum[3] = {0.0}, sixth = 0.0, most = 0.0;
    for (int i = 0; i < DRAWS; ++i) {
        const double r = brc_pack_radius(fill, i);
        assert_true(r > 0.0);
        sum[0] += r / DRAWS;
        sum[1] += r * r / DRAWS;
        sum[2] += r * r * r / DRAWS;
        sixth += pow(r, 6) / DRAWS;
        most = fmax(most, r);
    }
    assert_near(brc_pack_mean_square(fill), square, 1e-12 * square);
    assert_near(brc_pack_mean_cube(fill), cube_mean, 1e-12 * cube_mean);
    assert_near(brc_pack_largest(fill), largest, 1e-12 * largest);
    const double deviation = sqrt(square - 1.0), deviation3 = sqrt(sixth - cube_mean * cube_mean),
                 errors = 5.0 / sqrt(DRAWS);
    assert_near(sum[0], 1.0, errors * deviation);
    assert_near(sum[1], square, errors * 2.0 * largest * deviation); /* |d(r^2)| <= 2 r_max |dr| */
    assert_near(sum[2], cube_mean, errors * deviation3 + 1e-12);
    assert_true(most <= largest * (1.0 + 1e-12) && most > largest - errors * largest);
}

/* Uniform in 1 -+ s: mean square 1 + s^2/3, mean cube 1 + s^2. */
static void radii_are_uniform_over_the_spread(void **state)
{
    (void)state;
    const brc_fill fill = {.radius_spread = 0.25, .seed = 3};
    compare_moments(&fill, 1.0 + 0.0625 / 3.0, 1.0625, 1.25);
}

/* Half of the spheres uniform in 1 .. 3, a quarter uniform in 3 .. 4, a quarter of 8 (a step): mean 2/2 + 3.5/4 + 8/4 =
 * 3.875; squares: (27 - 1)/6, (64 - 27)/3 and 64; cubes: (81 - 1)/8, (256 - 81)/4 and 512. */
static void radii_follow_a_table(void **state)
{
    (void)state;
    brc_radius table[] = {{1.0, 0.0}, {3.0, 0.5}, {4.0, 0.75}, {8.0, 0.75}, {8.0, 1.0}};
    const brc_fill fill = {.n_radii = 5, .radii = table, .seed = 3};
    const double mean = 3.875, square = 26.0 / 6.0 / 2.0 + 37.0 / 3.0 / 4.0 + 16.0,
                 cube_mean = 10.0 / 2.0 + 175.0 / 4.0 / 4.0 + 128.0;
    assert_near(brc_pack_mean_radius(&fill), mean, 1e-14);
    compare_moments(&fill, square / (mean * mean), cube_mean / pow(mean, 3), 8.0 / mean);
    int n_large = 0;
    for (int i = 0; i < 10000; ++i) {
        const double r = brc_pack_radius(&fill, i) * mean;
        n_large += r > 7.999;
        assert_true(r < 4.0 + 1e-12 || r > 8.0 - 1e-12);
    }
    assert_near(n_large, 2500.0, 5.0 * sqrt(10000.0 * 0.25 * 0.75));
}

static void a_solid_without_room_is_refused(void **state)
{
    const brc_shape plate = {.kind = BRC_SHAPE_BOX, .size = {1.0, 1.0, 0.01}};
    const brc_fill fill = {.kind = BRC_FILL_PACKING, .seed = 1};
    brc_solid *solid;
    double *x, deepest;
    assert_int_equal(brc_solid_create(*state, &plate, 1, &solid), BRC_OK);
    assert_int_equal(brc_pack_start(*state, solid, &fill, 1000, 0.006, 1, &x, &deepest), BRC_BAD_INPUT);
    assert_null(x);
    test_says(*state, "too thin");
    brc_solid_free(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(exactly_as_many_start_points_as_asked_lie_inside, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_region_holds_its_share_of_start_points, test_begin, test_end),
        cmocka_unit_test_setup_teardown(other_seeds_give_other_points_and_radii, test_begin, test_end),
        cmocka_unit_test_setup_teardown(radii_are_uniform_over_the_spread, test_begin, test_end),
        cmocka_unit_test_setup_teardown(radii_follow_a_table, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_solid_without_room_is_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
