#include "support.h"

#include "../../preprocess/shape.h"

#define PI 3.14159265358979323846

static void volumes_and_bounds_are_those_of_the_textbook(void **state)
{
    (void)state;
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .origin = {1.0, 2.0, 3.0}, .size = {2.0, 3.0, 4.0}};
    const brc_shape cylinder = {.kind = BRC_SHAPE_CYLINDER, .origin = {1.0, 2.0, 3.0}, .length = 2.0, .radius = 0.5, .axis = 1};
    const brc_shape sphere = {.kind = BRC_SHAPE_SPHERE, .radius = 2.0};
    assert_near(brc_shape_volume(&box), 24.0, 1e-14);
    assert_near(brc_shape_volume(&cylinder), PI * 0.5, 1e-15);
    assert_near(brc_shape_volume(&sphere), PI * 32.0 / 3.0, 1e-14);
    double bounds[2][3];
    brc_shape_bounds(&cylinder, bounds);
    const double expected[2][3] = {{0.5, 2.0, 2.5}, {1.5, 4.0, 3.5}};
    for (int k = 0; k < 3; ++k) {
        assert_near(bounds[0][k], expected[0][k], 1e-15);
        assert_near(bounds[1][k], expected[1][k], 1e-15);
    }
}

static void shapes_without_extent_are_refused(void **state)
{
    brc_context *context = *state;
    brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1.0, 0.0, 1.0}};
    assert_int_equal(brc_shape_check(context, &shape), BRC_BAD_INPUT);
    shape.size[1] = NAN;
    assert_int_equal(brc_shape_check(context, &shape), BRC_BAD_INPUT);
    shape = (brc_shape){.kind = BRC_SHAPE_CYLINDER, .length = 1.0, .radius = -1.0};
    assert_int_equal(brc_shape_check(context, &shape), BRC_BAD_INPUT);
    shape.radius = 1.0;
    shape.axis = 3;
    assert_int_equal(brc_shape_check(context, &shape), BRC_BAD_INPUT);
    test_says(context, "axis of the cylinder is 3");
    shape = (brc_shape){.kind = BRC_SHAPE_SPHERE, .radius = INFINITY};
    assert_int_equal(brc_shape_check(context, &shape), BRC_BAD_INPUT);
    shape = (brc_shape){.kind = (brc_shape_kind)9};
    assert_int_equal(brc_shape_check(context, &shape), BRC_BAD_INPUT);
}

static void a_prism_has_the_area_of_its_circle(void **state)
{
    brc_context *context = *state;
    const brc_shape shape = {.kind = BRC_SHAPE_CYLINDER, .length = 1.0, .radius = 0.25, .axis = 2};
    brc_walls walls;
    assert_int_equal(brc_walls_create(context, &shape, 0.05, &walls), BRC_OK);
    const double n = walls.n_planes;
    assert_true(walls.n_planes >= 32);
    assert_near(n * walls.offset * walls.offset * tan(PI / n), PI * 0.0625, 1e-15); /* rounding */
    for (int32_t k = 0; k < walls.n_planes; ++k) assert_near(walls.normal[3 * k + 2], 0.0, 0.0);
    brc_walls_free(&walls);
}

/* The wall list of a shape: every plane nearer than the reach must be among those named near, and `inside` must agree
 * with a loop over all planes. Points lie in, on and out of the shape, on the poles of the sphere's lattice too. */
static void near_planes_are_found_wherever_the_point_lies(void **state)
{
    brc_context *context = *state;
    const brc_shape shape[2] = {{.kind = BRC_SHAPE_CYLINDER, .origin = {-1.0, 0.2, 0.3}, .length = 2.0, .radius = 0.7},
                                {.kind = BRC_SHAPE_SPHERE, .origin = {0.1, 0.2, 0.3}, .radius = 0.7}};
    const double direction[5][3] = {{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, {0.6, -0.64, 0.48}, {0.0, -0.28, -0.96}};
    const double radius[5] = {0.0, 0.35, 0.65, 0.7, 0.75}, reach[3] = {0.01, 0.1, 2.0};
    for (int s = 0; s < 2; ++s) {
        brc_walls walls;
        assert_int_equal(brc_walls_create(context, &shape[s], 0.04, &walls), BRC_OK);
        for (int p = 0; p < 75; ++p) {
            double x[3], within = reach[p % 3];
            for (int k = 0; k < 3; ++k) x[k] = shape[s].origin[k] + radius[p / 3 % 5] * direction[p / 15][k];
            if (s == 0) x[0] = 0.0;
            int64_t first, count;
            brc_walls_near(&walls, x, within, &first, &count);
            bool inside = true;
            for (int32_t k = 0; k < walls.n_planes; ++k) {
                const double depth = brc_walls_depth(&walls, k, x);
                inside = inside && depth >= 0.01;
                const int64_t place = ((k - first) % walls.n_planes + walls.n_planes) % walls.n_planes;
                if (depth < within) assert_true(place < count);
            }
            assert_int_equal(brc_walls_inside(&walls, x, 0.01), inside);
        }
        brc_walls_free(&walls);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(volumes_and_bounds_are_those_of_the_textbook, test_begin, test_end),
        cmocka_unit_test_setup_teardown(shapes_without_extent_are_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_prism_has_the_area_of_its_circle, test_begin, test_end),
        cmocka_unit_test_setup_teardown(near_planes_are_found_wherever_the_point_lies, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
