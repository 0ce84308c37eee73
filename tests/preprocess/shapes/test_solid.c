/* Solids: inside, depth and feet against closed formulas and against random probing of the membership alone. */
#include "../shapes.h"
#include "../support.h"

#include "../../../host/base/random.h"
#include "../../../preprocess/shapes/solid.h"

#include <string.h>

#define PI 3.14159265358979323846

static brc_solid *make(brc_context *context, const brc_shape *shape)
{
    brc_solid *solid = NULL;
    if (brc_solid_create(context, shape, 1, &solid) != BRC_OK) fail_msg("%s", brc_context_message(context));
    return solid;
}

static void refused(brc_context *context, const brc_shape *shape, const char *part)
{
    brc_solid *solid = NULL;
    brc_context_clear(context);
    assert_int_equal(brc_solid_create(context, shape, 1, &solid), BRC_BAD_INPUT);
    assert_null(solid);
    test_says(context, part);
}

/* Point k of a lattice of random points in a box a little larger than the bounds. */
static void random_point(const brc_solid *solid, uint64_t k, double x[3])
{
    double bounds[2][3], u[4];
    brc_solid_bounds(solid, bounds);
    brc_random_uniform4(11, BRC_RANDOM_TEST, k, 0, u);
    for (int d = 0; d < 3; ++d)
        x[d] = bounds[0][d] + (1.2 * u[d] - 0.1) * (bounds[1][d] - bounds[0][d]);
}

static void random_direction(uint64_t k, uint64_t l, double v[3])
{
    double u[4];
    brc_random_uniform4(12, BRC_RANDOM_TEST, k, l, u);
    const double z = 2.0 * u[0] - 1.0, r = sqrt(1.0 - z * z);
    v[0] = r * cos(2.0 * PI * u[1]);
    v[1] = r * sin(2.0 * PI * u[1]);
    v[2] = z;
}

/* A ball of the depth's radius lies on one side of the surface; one a little larger does not, seen along the nearest
 * foot. */
static void probe(const brc_solid *solid, const char *name)
{
    double bounds[2][3];
    brc_solid_bounds(solid, bounds);
    const double size = bounds[1][0] - bounds[0][0];
    for (uint64_t k = 0; k < 300; ++k) {
        double x[3], y[3], v[3];
        random_point(solid, k, x);
        const bool inside = brc_solid_inside(solid, x, 0.0);
        const double depth = brc_solid_depth(solid, x);
        if (inside != (depth > 0.0)) fail_msg("%s, point %d: inside %d, depth %g", name, (int)k, inside, depth);
        for (uint64_t l = 0; l < 60; ++l) {
            random_direction(k, l, v);
            for (int d = 0; d < 3; ++d)
                y[d] = x[d] + 0.999 * fabs(depth) * v[d];
            if (brc_solid_inside(solid, y, 0.0) != inside)
                fail_msg("%s: (%g %g %g) inside %d, depth %g; (%g %g %g) is on the other side", name, x[0], x[1], x[2],
                         inside, depth, y[0], y[1], y[2]);
        }
        brc_foot feet[64];
        const int32_t n = brc_solid_feet(solid, x, 1e-9 * size + fabs(depth) * 1.5, feet, 64);
        assert_in_range(n, 0, 64);
        if (!inside) {
            assert_int_equal(n, 0);
            continue;
        }
        if (n < 1) fail_msg("%s: no foot of (%g %g %g) at depth %g", name, x[0], x[1], x[2], depth);
        const brc_foot *least = &feet[0];
        for (int32_t f = 0; f < n; ++f) {
            if (feet[f].depth < least->depth) least = &feet[f];
            test_near_at(feet[f].normal[0] * feet[f].normal[0] + feet[f].normal[1] * feet[f].normal[1] +
                             feet[f].normal[2] * feet[f].normal[2],
                         1.0, 1e-12, name, (int)k);
        }
        if (fabs(least->depth - depth) > 1e-9 * size)
            fail_msg("%s: (%g %g %g) has depth %g, its nearest foot is %g away", name, x[0], x[1], x[2], depth,
                     least->depth);
        for (int d = 0; d < 3; ++d)
            y[d] = x[d] + 1.0001 * depth * least->normal[d];
        if (brc_solid_inside(solid, y, 0.0))
            fail_msg("%s: (%g %g %g): beyond its foot at %g it is still inside", name, x[0], x[1], x[2], depth);
    }
}

static void the_depth_is_the_radius_of_the_largest_ball_on_one_side(void **state)
{
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        const brc_shape shape = test_shape_of(k, &room);
        brc_solid *solid = make(*state, &shape);
        probe(solid, room.name);
        brc_solid_free(&solid);
    }
}

/* Single shapes by their formula. Parts by exact chords along up to 1024 x 1024 lines: the error estimate must hold,
 * with a factor of 3 as two grids may agree by chance, and be small. */
static void volumes_are_those_of_the_formulas(void **state)
{
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        const brc_shape shape = test_shape_of(k, &room);
        brc_solid *solid = make(*state, &shape);
        double error = 1.0;
        const double off = brc_solid_volume(solid, &error) / room.volume - 1.0;
        if (shape.kind == BRC_SHAPE_PARTS)
            assert_true(error > 0.0 && error < 3e-5);
        else
            assert_true(error == 0.0);
        if (fabs(off) > 3.0 * error + 1e-14) fail_msg("%s: volume off by %g, estimated %g", room.name, off, error);
        brc_solid_free(&solid);
    }
}

static void intersections_of_half_spaces_are_convex(void **state)
{
    static const char *const convex[] = {
        "box",        "plate", "sphere", "cylinder", "disc", "frustum", "cone", "cut sphere", "two balls in common",
        "turned box", "wedge"};
    int n = 0;
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        const brc_shape shape = test_shape_of(k, &room);
        brc_solid *solid = make(*state, &shape);
        bool expected = false;
        for (size_t c = 0; c < sizeof convex / sizeof *convex; ++c)
            expected = expected || strcmp(convex[c], room.name) == 0;
        assert_int_equal(brc_solid_is_convex(solid), expected);
        n += expected;
        brc_solid_free(&solid);
    }
    assert_int_equal(n, sizeof convex / sizeof *convex);
}

static void bounds_are_tight(void **state)
{
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        double found[2][3];
        const brc_shape shape = test_shape_of(k, &room);
        brc_solid *solid = make(*state, &shape);
        brc_solid_bounds(solid, found);
        for (int d = 0; d < 3; ++d)
            for (int side = 0; side < 2; ++side)
                assert_near(found[side][d], room.bounds[side][d], 1e-7); /* found by search where round */
        brc_solid_free(&solid);
    }
}

static void a_foot_on_a_concave_edge_is_the_nearest_point_of_the_edge(void **state)
{
    test_shape room;
    const brc_shape shape = test_shape_named("L-shape", &room);
    brc_solid *solid = make(*state, &shape);
    const double x[3] = {0.85, 0.8, 0.5}; /* the edge runs along z through (1, 1) */
    brc_foot feet[8];
    assert_int_equal(brc_solid_feet(solid, x, 0.26, feet, 8), 1);
    assert_near(feet[0].depth, 0.25, 1e-14);
    assert_near(feet[0].normal[0], 0.6, 1e-13);
    assert_near(feet[0].normal[1], 0.8, 1e-13);
    assert_false(feet[0].plane);
    assert_near(brc_solid_depth(solid, x), 0.25, 1e-14);
    const double beside[3] = {0.9, 1.2, 0.5}; /* next to the upper box's right side */
    assert_int_equal(brc_solid_feet(solid, beside, 0.2, feet, 8), 1);
    assert_near(feet[0].depth, 0.1, 1e-14);
    assert_string_equal(brc_solid_wall_name(solid, feet[0].wall), "x+");
    assert_true(feet[0].plane);
    brc_solid_free(&solid);
}

static void walls_carry_the_name_of_their_part(void **state)
{
    test_shape room;
    const brc_shape shape = test_shape_named("box minus cylinder", &room);
    brc_solid *solid = make(*state, &shape);
    const char *const name[] = {"x-", "x+", "y-", "y+", "z-", "z+", "hole_z-", "hole_z+", "hole_side"};
    assert_int_equal(brc_solid_n_walls(solid), 9);
    for (int w = 0; w < 9; ++w)
        assert_string_equal(brc_solid_wall_name(solid, w), name[w]);
    const double x[3] = {0.45, 1.0, 0.5};
    brc_foot foot;
    assert_int_equal(brc_solid_feet(solid, x, 0.1, &foot, 1), 1);
    assert_string_equal(brc_solid_wall_name(solid, foot.wall), "hole_side");
    assert_near(foot.depth, 0.05, 1e-15);
    assert_near(foot.normal[0], 1.0, 1e-15);
    brc_solid_free(&solid);
}

static void margins_are_kept(void **state)
{
    test_shape room;
    const brc_shape ring = test_shape_named("torus", &room);
    brc_solid *solid = make(*state, &ring);
    const double x[3] = {1.35, 0.0, 0.0};
    assert_true(brc_solid_inside(solid, x, 0.0499));
    assert_false(brc_solid_inside(solid, x, 0.0501));
    brc_solid_free(&solid);
}

static void the_surface_is_about_right(void **state)
{
    /* box 2 x 2 x 1 with a round hole through it: 8 + 8 - 2 pi / 4 + pi */
    test_shape room;
    const brc_shape shape = test_shape_named("box minus cylinder", &room);
    brc_solid *solid = make(*state, &shape);
    const double exact = 16.0 - 0.5 * PI + PI;
    assert_near(brc_solid_surface(solid), exact, 0.05 * exact); /* seven directions stand for all */
    brc_solid_free(&solid);
}

static void wrong_shapes_are_refused_with_the_cure(void **state)
{
    test_shape room;
    brc_shape s = test_shape_named("torus", &room);
    s.radius2 = 1.0;
    refused(*state, &s, "the torus meets itself");
    s = test_shape_named("frustum", &room);
    s.radius = s.radius2 = 0.0;
    refused(*state, &s, "both radii of the cone are 0");
    s = test_shape_named("frustum", &room);
    s.length = -1.0;
    refused(*state, &s, "the length of the cone is -1 m");
    s = (brc_shape){.kind = BRC_SHAPE_BOX, .size = {1.0, 0.0, 1.0}};
    refused(*state, &s, "an edge length of the box is 0 m");
    s.size[1] = NAN;
    refused(*state, &s, "must be finite and > 0");
    s = (brc_shape){.kind = BRC_SHAPE_CYLINDER, .length = 1.0, .radius = 1.0, .axis = 3};
    refused(*state, &s, "axis of the cylinder is 3");
    s = (brc_shape){.kind = BRC_SHAPE_SPHERE, .radius = INFINITY};
    refused(*state, &s, "the radius of the sphere");
    s = (brc_shape){.kind = (brc_shape_kind)99};
    refused(*state, &s, "kind 99 is unknown");
    s = (brc_shape){.kind = BRC_SHAPE_HALF_SPACE, .normal = {1, 0, 0}};
    refused(*state, &s, "as a part");
    s = (brc_shape){.kind = BRC_SHAPE_PARTS};
    refused(*state, &s, "0 parts");
    brc_shape_part parts[2] = {{.shape = test_shape_named("sphere", &room)},
                               {.role = BRC_PART_REMOVE, .shape = test_shape_named("box", &room)}};
    s = (brc_shape){.kind = BRC_SHAPE_PARTS, .n_parts = 2, .parts = parts};
    refused(*state, &s, "its parts leave nothing");
    parts[0].role = BRC_PART_REMOVE;
    refused(*state, &s, "the first part must be added");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_depth_is_the_radius_of_the_largest_ball_on_one_side, test_begin, test_end),
        cmocka_unit_test_setup_teardown(volumes_are_those_of_the_formulas, test_begin, test_end),
        cmocka_unit_test_setup_teardown(intersections_of_half_spaces_are_convex, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bounds_are_tight, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_foot_on_a_concave_edge_is_the_nearest_point_of_the_edge, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(walls_carry_the_name_of_their_part, test_begin, test_end),
        cmocka_unit_test_setup_teardown(margins_are_kept, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_surface_is_about_right, test_begin, test_end),
        cmocka_unit_test_setup_teardown(wrong_shapes_are_refused_with_the_cure, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
