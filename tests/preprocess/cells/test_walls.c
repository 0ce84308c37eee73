#include "../support.h"

#include "../../../preprocess/cells/walls.h"

#define PI 3.14159265358979323846

static brc_solid *make(brc_context *context, const brc_shape *shape, double spacing, brc_walls *walls)
{
    brc_solid *solid = NULL;
    if (brc_solid_create(context, shape, 1, &solid) != BRC_OK ||
        brc_walls_create(context, solid, spacing, walls) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return solid;
}

static void a_prism_has_the_area_of_its_circle(void **state)
{
    brc_context *context = *state;
    const brc_shape shape = {.kind = BRC_SHAPE_CYLINDER, .length = 1.0, .radius = 0.25, .axis = 2};
    brc_walls walls;
    brc_solid *solid = make(context, &shape, 0.05, &walls);
    const double n = walls.n_planes;
    assert_true(walls.n_planes >= 32);
    assert_near(n * walls.offset * walls.offset * tan(PI / n), PI * 0.0625, 1e-15); /* rounding */
    for (int32_t k = 0; k < walls.n_planes; ++k)
        assert_near(walls.normal[3 * k + 2], 0.0, 0.0);
    brc_walls_free(&walls);
    brc_solid_free(&solid);
}

/* The wall list of a shape: every plane nearer than the reach must be among those named near, and `inside` must agree
 * with a loop over all planes. Points lie in, on and out of the shape, on the poles of the sphere's lattice too. */
static void near_planes_are_found_wherever_the_point_lies(void **state)
{
    brc_context *context = *state;
    const brc_shape shape[4] = {
        {.kind = BRC_SHAPE_CYLINDER, .origin = {-1.0, 0.2, 0.3}, .length = 2.0, .radius = 0.7},
        {.kind = BRC_SHAPE_SPHERE, .origin = {0.1, 0.2, 0.3}, .radius = 0.7},
        {.kind = BRC_SHAPE_CONE, .origin = {-1.0, 0.2, 0.3}, .length = 2.0, .radius = 0.9, .radius2 = 0.5},
        {.kind = BRC_SHAPE_CONE, .origin = {-1.0, 0.2, 0.3}, .length = 2.0, .radius = 0.1, .radius2 = 1.3}};
    const double direction[5][3] = {
        {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, {0.6, -0.64, 0.48}, {0.0, -0.28, -0.96}};
    const double radius[5] = {0.0, 0.35, 0.65, 0.7, 0.75}, reach[3] = {0.01, 0.1, 2.0};
    for (int s = 0; s < 4; ++s) {
        brc_walls walls;
        brc_solid *solid = make(context, &shape[s], 0.04, &walls);
        for (int p = 0; p < 75; ++p) {
            double x[3], within = reach[p % 3];
            for (int k = 0; k < 3; ++k)
                x[k] = shape[s].origin[k] + radius[p / 3 % 5] * direction[p / 15][k];
            if (s != 1) x[0] = 0.0; /* there all are as wide as the sphere */
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
        brc_solid_free(&solid);
    }
}

/* The pyramid's cross-section halfway is a regular polygon with the area of the cone's there. */
static void a_pyramid_has_the_volume_of_its_cone(void **state)
{
    const brc_shape shape = {.kind = BRC_SHAPE_CONE, .length = 2.0, .radius = 0.5, .radius2 = 0.25, .axis = 0};
    brc_walls walls;
    brc_solid *solid = make(*state, &shape, 0.05, &walls);
    const double n = walls.n_planes, x[3] = {1.0, 0.0, 0.0};
    double inner = HUGE_VAL; /* across the axis */
    for (int32_t k = 0; k < walls.n_planes; ++k)
        inner = fmin(inner, brc_walls_depth(&walls, k, x) / sqrt(1.0 - walls.normal[3 * k] * walls.normal[3 * k]));
    assert_near(n * inner * inner * tan(PI / n), PI * 0.375 * 0.375, 1e-14); /* rounding */
    brc_walls_free(&walls);
    brc_solid_free(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_prism_has_the_area_of_its_circle, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_pyramid_has_the_volume_of_its_cone, test_begin, test_end),
        cmocka_unit_test_setup_teardown(near_planes_are_found_wherever_the_point_lies, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
