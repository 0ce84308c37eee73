/* Strikers of hundreds and thousands of faces against cells much smaller and much larger than they are. Double, eight
 * lanes. */
#include "../support.h"

#include "../../../preprocess/shapes/convex.h"

#define BRC_PRECISION 0
#define BRC_LANES 8
#define BRC_SLICE 8
#define BRC_MANY_MATERIALS 0
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpsabi"
#include "../../../kernels/effects/contact/convex_wall.h"

static convex_shape shape_of(const brc_convex *c)
{
    return (convex_shape){c->corner,          c->plane,         c->loop_start, c->loop,
                          c->corner_start[1], c->face_start[1], c->radius[0]};
}

static brc_convex make(void **state, brc_shape shape, int32_t facets)
{
    brc_convex made;
    brc_rigid rigid;
    assert_int_equal(brc_convex_of_shape(*state, &shape, facets, 0, 1, &made, &rigid), BRC_OK);
    return made;
}

static brc_shape cube(double half)
{
    return (brc_shape){.kind = BRC_SHAPE_BOX, .origin = {-half, -half, -half}, .size = {2 * half, 2 * half, 2 * half}};
}

/* Turned about some axis by k radian, as a matrix. */
static convex_map turn_of(int k)
{
    const double c = cos(k), s = sin(k), d = cos(2.1 * k), e = sin(2.1 * k);
    return convex_product((convex_map){c, -s, 0, s, c, 0, 0, 0, 1}, (convex_map){1, 0, 0, 0, d, -e, 0, e, d});
}

/* With every direction of an icosphere there is its opposite: any plane through the middle leaves half. */
static void large_cell_cuts_a_sphere_in_halves(void **state)
{
    static const int32_t facets[3] = {24, 48, 96};
    brc_convex box = make(state, cube(8), 8);
    for (int s = 0; s < 3; ++s) {
        brc_convex sphere = make(state, (brc_shape){.kind = BRC_SHAPE_SPHERE, .radius = 0.5}, facets[s]);
        const double half = 0.5 * 4.0 / 3.0 * 3.14159265358979323846 * 0.125;
        for (int k = 0; k < 12; ++k) {
            const convex_map turn = turn_of(k);
            const convex_pose pose_a = {convex_turn(turn, (convex_vec){8, 0.25, -0.5}), turn},
                              pose_b = {{0, 0, 0}, turn_of(0)};
            const convex_overlap o = convex_overlap_of(shape_of(&box), pose_a, shape_of(&sphere), pose_b);
            const convex_overlap p = convex_overlap_of(shape_of(&sphere), pose_b, shape_of(&box), pose_a);
            const convex_plane wall = {convex_turn(turn, (convex_vec){1, 0, 0}), 0};
            const convex_overlap w = convex_wall_overlap(shape_of(&sphere), pose_b, wall, (convex_vec){0, 0, 0});
            assert_int_equal(o.failed + p.failed + w.failed, 0);
            /* thousands of faces, each to rounding of places of 10 */
            assert_near(o.volume, half, 1e-12);
            assert_near(p.volume, half, 1e-12);
            assert_near(w.volume, half, 1e-12);
        }
        brc_convex_free(&sphere);
    }
    brc_convex_free(&box);
}

/* Small cells around it: force and torque balance, the same from both sides, and nothing beyond the sphere's own
 * reach. */
static void small_cells_feel_a_sphere_of_many_faces(void **state)
{
    brc_convex sphere = make(state, (brc_shape){.kind = BRC_SHAPE_SPHERE, .radius = 0.5}, 48);
    int touching = 0;
    for (double half = 0.0125; half < 1; half *= 4) {
        brc_convex box = make(state, cube(half), 8);
        for (int k = 0; k < 60; ++k) {
            const convex_map turn = turn_of(k);
            const double away = 0.5 + half * (k % 6 - 2) * 0.5;
            const convex_pose pose_a = {convex_turn(turn_of(3 * k + 1), (convex_vec){away, 0, 0}), turn},
                              pose_b = {{0, 0, 0}, turn_of(7)};
            const convex_overlap o = convex_overlap_of(shape_of(&box), pose_a, shape_of(&sphere), pose_b);
            const convex_overlap p = convex_overlap_of(shape_of(&sphere), pose_b, shape_of(&box), pose_a);
            touching += o.volume > 0;
            assert_int_equal(o.failed + p.failed, 0);
            assert_near(o.volume, p.volume, 1e-14);
            assert_true(convex_length(convex_add(o.area, p.area)) < 1e-13);
            assert_true(o.volume <= 8 * half * half * half * (1 + 1e-12));
            const convex_vec torque = convex_sub(convex_add(convex_torque(o.moment_a), convex_torque(o.moment_b)),
                                                 convex_cross(convex_sub(pose_b.origin, pose_a.origin), o.area));
            assert_true(convex_length(torque) < 1e-13);
        }
        brc_convex_free(&box);
    }
    assert_true(touching > 100);
    brc_convex_free(&sphere);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(large_cell_cuts_a_sphere_in_halves, test_begin, test_end),
        cmocka_unit_test_setup_teardown(small_cells_feel_a_sphere_of_many_faces, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
