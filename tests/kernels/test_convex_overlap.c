/* The overlap of two convex polyhedra against exact volumes, another way of cutting, and its own differences. One lane,
 * double. */
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on
#include "convex_case.h"

#include <math.h>

static const convex_map unit = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static convex_pose at(double x, double y, double z)
{
    return (convex_pose){{x, y, z}, unit};
}

static double norm(convex_map m)
{
    return sqrt(m.xx * m.xx + m.xy * m.xy + m.xz * m.xz + m.yx * m.yx + m.yy * m.yy + m.yz * m.yz + m.zx * m.zx +
                m.zy * m.zy + m.zz * m.zz);
}

static void two_cubes_overlap_in_the_box_they_share(void **state)
{
    (void)state;
    convex_case a, b;
    convex_case_box(&a, 1, 1, 1);
    convex_case_box(&b, 1, 1, 1);
    const convex_overlap o =
        convex_overlap_of(convex_case_shape(&a), at(0, 0, 0), convex_case_shape(&b), at(0.75, 0.5, 0.25));
    /* by hand: 0.25 x 0.5 x 0.75; the box's faces inside A are its three lower ones, their normals outward of B point
     * down */
    assert_true(fabs(o.volume - 0.25 * 0.5 * 0.75) < 1e-15);
    assert_true(fabs(o.area.x + 0.5 * 0.75) < 1e-15 && fabs(o.area.y + 0.25 * 0.75) < 1e-15 &&
                fabs(o.area.z + 0.25 * 0.5) < 1e-15);
    assert_int_equal(o.failed, 0);
}

static void body_within_another_feels_no_force(void **state)
{
    (void)state;
    convex_case a, b;
    convex_case_box(&a, 1, 1, 1);
    convex_case_box(&b, 0.25, 0.5, 0.125);
    for (int order = 0; order < 2; ++order) {
        const convex_shape one = convex_case_shape(order ? &b : &a), other = convex_case_shape(order ? &a : &b);
        const convex_overlap o = convex_overlap_of(one, at(0, 0, 0), other, at(0.125, 0.0625, 0));
        assert_true(fabs(o.volume - 0.25 * 0.5 * 0.125) < 1e-16);
        assert_true(convex_length(o.area) < 1e-16);
    }
}

/* Planes of both in one plane to rounding only: turned together, then tilted by ever less against each other. */
static void faces_in_one_plane_count_once(void **state)
{
    (void)state;
    uint64_t random = 1;
    convex_case a, b;
    convex_case_box(&a, 1, 1, 1);
    convex_case_box(&b, 1, 1, 1);
    const double shift[6][3] = {{0, 0, 0}, {0.75, 0, 0}, {0, 0.999, 0}, {0.5, 0, 0.25}, {0, 0, 1 - 1e-9}, {0, 0, 1}};
    for (int trial = 0; trial < 4000; ++trial) {
        const double *d = shift[trial % 6], tilt = pow(10.0, -3 - trial % 17);
        const convex_map turn = convex_case_rotation(&random);
        const convex_vec axis = {tilt * convex_case_number(&random), tilt * convex_case_number(&random),
                                 tilt * convex_case_number(&random)};
        const convex_map tilted = {1, -axis.z, axis.y, axis.z, 1, -axis.x, -axis.y, axis.x, 1};
        const convex_pose pose_a = {{0, 0, 0}, turn},
                          pose_b = {convex_turn(turn, (convex_vec){d[0], d[1], d[2]}), convex_product(turn, tilted)};
        const convex_overlap o = convex_overlap_of(convex_case_shape(&a), pose_a, convex_case_shape(&b), pose_b);
        const double expected = (1 - d[0]) * (1 - d[1]) * (1 - d[2]);
        /* a tilt moves no point of the cube by more than 1.5 tilt: six faces of area 1; rounding: some dozen corners of
         * size 1 */
        assert_int_equal(o.failed, 0);
        assert_true(fabs(o.volume - expected) < 9 * tilt + 1e-14);
        if (tilt < 1e-12 &&
            d[2] == 1 - 1e-9) { /* a slab that is thin against the cube: its normal and moment are exact too */
            const convex_vec across = convex_turn(turn, (convex_vec){0, 0, -1});
            assert_true(convex_length(convex_sub(o.area, across)) < 1e-6);
        }
    }
}

static void volume_agrees_with_the_corners_of_all_planes(void **state)
{
    (void)state;
    uint64_t random = 2;
    int touching = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        convex_case a, b;
        convex_case_random(&a, trial % CONVEX_KINDS, 5 + trial % 11, &random);
        convex_case_random(&b, trial / 4 % CONVEX_KINDS, 5 + trial % 13, &random);
        const convex_pose pose_a = {{0.1, -3, 7}, convex_case_map(0.15, &random)};
        convex_pose pose_b = {{0.1, -3, 7}, convex_case_map(0.15, &random)};
        const double spread = trial % 3 == 0 ? 0.3 : 1.5;
        pose_b.origin.x += spread * convex_case_number(&random);
        pose_b.origin.y += spread * convex_case_number(&random);
        pose_b.origin.z += spread * convex_case_number(&random);
        const convex_overlap o = convex_overlap_of(convex_case_shape(&a), pose_a, convex_case_shape(&b), pose_b);
        const double expected = convex_case_shared(&a, pose_a, &b, pose_b);
        touching += expected > 0;
        assert_int_equal(o.failed, 0);
        /* corners of size 10 to rounding, areas up to 100; the reference's corners are worse by its smallest
         * determinants */
        assert_true(fabs(o.volume - expected) < 1e-11);
    }
    assert_true(touching > 500); /* or the test says nothing */
}

static double volume_at(const convex_case *a, convex_pose pose_a, const convex_case *b, convex_pose pose_b)
{
    return convex_overlap_of(convex_case_shape(a), pose_a, convex_case_shape(b), pose_b).volume;
}

static convex_map added(convex_map a, double k, convex_map b)
{
    return (convex_map){a.xx + k * b.xx, a.xy + k * b.xy, a.xz + k * b.xz, a.yx + k * b.yx, a.yy + k * b.yy,
                        a.yz + k * b.yz, a.zx + k * b.zx, a.zy + k * b.zy, a.zz + k * b.zz};
}

static convex_pose moved(convex_pose p, double t, convex_vec d, convex_map m)
{
    return (convex_pose){convex_add(p.origin, convex_scale(t, d)), added(p.map, t, m)};
}

static double contract(convex_map a, convex_map b)
{
    return a.xx * b.xx + a.xy * b.xy + a.xz * b.xz + a.yx * b.yx + a.yy * b.yy + a.yz * b.yz + a.zx * b.zx +
           a.zy * b.zy + a.zz * b.zz;
}

/* Energy V^2 / 2 along random motions of one body's origin and map: its slope by differences against V times the
 * analytic one. V is a piecewise cubic of the motion, and its second derivative has kinks where a corner passes a face:
 * a sixth-order difference is exact between kinks, and the smallest mismatch of several steps is one that meets no
 * kink. */
static void force_is_the_slope_of_the_energy(void **state)
{
    (void)state;
    uint64_t random = 3;
    int pairs = 0;
    for (int trial = 0; pairs < 400; ++trial) {
        convex_case a, b;
        convex_case_random(&a, trial % CONVEX_KINDS, 6 + trial % 12, &random);
        convex_case_random(&b, trial / 4 % CONVEX_KINDS, 6 + trial % 9, &random);
        const convex_pose pose_a = {{0, 0, 0}, convex_case_map(0.15, &random)};
        convex_pose pose_b = {{convex_case_number(&random), convex_case_number(&random), convex_case_number(&random)},
                              convex_case_map(0.15, &random)};
        const convex_overlap o = convex_overlap_of(convex_case_shape(&a), pose_a, convex_case_shape(&b), pose_b);
        if (o.volume < 1e-4) continue;
        ++pairs;
        for (int side = 0; side < 2; ++side) {
            const convex_vec d = {convex_case_number(&random), convex_case_number(&random),
                                  convex_case_number(&random)};
            const convex_map m = convex_case_map(0.5, &random);
            const convex_map slope_of_map =
                convex_reference_moment(side ? o.moment_b : o.moment_a, side ? pose_b.map : pose_a.map);
            const double slope = o.volume * ((side ? 1 : -1) * convex_dot(o.area, d) + contract(slope_of_map, m));
            const double size = o.volume * (convex_length(o.area) + norm(slope_of_map));
            double best = HUGE_VAL;
            for (double h = 1e-3; h > 1e-6; h /= 3) {
                double sum = 0;
                static const double weight[3] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
                for (int k = 1; k <= 3; ++k)
                    for (int sign = -1; sign < 2; sign += 2) {
                        const double t = sign * k * h;
                        const double v = volume_at(&a, side ? pose_a : moved(pose_a, t, d, m), &b,
                                                   side ? moved(pose_b, t, d, m) : pose_b);
                        sum += sign * weight[k - 1] * 0.5 * v * v / h;
                    }
                best = fmin(best, fabs(sum - slope));
            }
            assert_true(best <
                        1e-6 * size + 1e-10); /* a body within the other: nothing but rounding of the differences */
        }
    }
}

static void action_is_reaction_and_moments_balance(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int trial = 0; trial < 2000; ++trial) {
        convex_case a, b;
        convex_case_random(&a, trial % CONVEX_KINDS, 6 + trial % 12, &random);
        convex_case_random(&b, trial / 4 % CONVEX_KINDS, 6 + trial % 9, &random);
        const convex_pose pose_a = {{0, 0, 0}, convex_case_map(0.15, &random)};
        const convex_pose pose_b = {
            {convex_case_number(&random), convex_case_number(&random), convex_case_number(&random)},
            convex_case_map(0.15, &random)};
        const convex_overlap o = convex_overlap_of(convex_case_shape(&a), pose_a, convex_case_shape(&b), pose_b);
        if (!(o.volume > 0)) continue;
        /* of the whole surface, about the origin of A: the integral of n (x) x is V times unity, hence no net torque.
         * Areas up to 100, some hundred roundings each */
        const convex_map whole = convex_add_outer(added(o.moment_a, 1, o.moment_b), o.area, pose_b.origin);
        assert_true(norm(added(whole, -o.volume, unit)) < 1e-12);
        assert_true(convex_length(convex_sub(convex_add(convex_torque(o.moment_a), convex_torque(o.moment_b)),
                                             convex_cross(pose_b.origin, o.area))) < 1e-12);
    }
}

static void reordered_bodies_give_the_same_overlap(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int trial = 0; trial < 500; ++trial) {
        convex_case a, b;
        convex_case_random(&a, trial % CONVEX_KINDS, 6 + trial % 12, &random);
        convex_case_random(&b, trial / 4 % CONVEX_KINDS, 6 + trial % 9, &random);
        const convex_pose pose_a = {{0, 0, 0}, convex_case_map(0.15, &random)},
                          pose_b = {{0.5, 0.25, 0.125}, convex_case_map(0.15, &random)};
        const convex_overlap o = convex_overlap_of(convex_case_shape(&a), pose_a, convex_case_shape(&b), pose_b);
        const convex_overlap p = convex_overlap_of(convex_case_shape(&b), pose_b, convex_case_shape(&a), pose_a);
        assert_true(fabs(o.volume - p.volume) < 1e-12);
        assert_true(convex_length(convex_add(o.area, p.area)) < 1e-12);
        /* a quotient by the surface, which may be small */
        if (o.volume > 1e-6) assert_true(convex_length(convex_sub(o.point, p.point)) < 1e-9);
    }
}

/* A wall is a very large box of B, whose other faces are far away. */
static void wall_cuts_as_a_large_box_does(void **state)
{
    (void)state;
    uint64_t random = 6;
    int touching = 0;
    convex_case wall;
    convex_case_box(&wall, 256, 256, 256);
    for (int trial = 0; trial < 1000; ++trial) {
        convex_case a;
        convex_case_random(&a, trial % CONVEX_KINDS, 6 + trial % 12, &random);
        const convex_map turn = convex_case_rotation(&random);
        const convex_vec normal = convex_turn(turn, (convex_vec){0, 0, 1}), foot = {0.5, -0.25, 0.125};
        const convex_plane plane = {normal, convex_dot(normal, foot)};
        const convex_pose pose_b = {convex_sub(foot, convex_scale(128, normal)), turn};
        const convex_pose pose_a = {convex_add(foot, convex_scale(convex_case_number(&random), normal)),
                                    convex_case_map(0.15, &random)};
        const convex_overlap o = convex_wall_overlap(convex_case_shape(&a), pose_a, plane, pose_b.origin);
        const convex_overlap p = convex_overlap_of(convex_case_shape(&a), pose_a, convex_case_shape(&wall), pose_b);
        assert_int_equal(o.failed, 0);
        touching += o.volume > 0;
        /* corners of size 200 to rounding, areas up to 100, moments of them over arms up to 200 */
        assert_true(fabs(o.volume - p.volume) < 1e-10);
        assert_true(convex_length(convex_sub(o.area, p.area)) < 1e-10);
        assert_true(norm(added(o.moment_a, -1, p.moment_a)) < 1e-10 && norm(added(o.moment_b, -1, p.moment_b)) < 1e-8);
        if (o.volume > 1e-6) assert_true(convex_length(convex_sub(o.point, p.point)) < 1e-8);
    }
    assert_true(touching > 500);
}

static void box_on_a_wall_is_cut_where_it_sinks_in(void **state)
{
    (void)state;
    convex_case a;
    convex_case_box(&a, 1, 2, 0.5);
    const convex_plane wall = {{0, 0, 1}, 3};
    const convex_overlap o = convex_wall_overlap(convex_case_shape(&a), at(7, 8, 3.1875), wall, (convex_vec){0, 0, 0});
    assert_true(fabs(o.volume - 0.0625 * 2) < 1e-15 && fabs(o.area.z - 2) < 1e-15 && o.area.x == 0 && o.area.y == 0);
    assert_true(fabs(o.point.x - 7) < 1e-14 && fabs(o.point.y - 8) < 1e-14 && fabs(o.point.z - 2.96875) < 1e-14);
    assert_true(convex_wall_overlap(convex_case_shape(&a), at(7, 8, 3.25), wall, (convex_vec){0, 0, 0}).volume ==
                0); /* it just touches */
    assert_true(convex_wall_overlap(convex_case_shape(&a), at(7, 8, 4), wall, (convex_vec){0, 0, 0}).volume == 0);
}

/* The nearest point of a convex body is the one that lies in it with the whole body behind the plane across the way to
 * it. */
static void foot_of_a_sphere_is_the_nearest_point(void **state)
{
    (void)state;
    uint64_t random = 7;
    int on[3] = {0, 0, 0};
    convex_case a;
    for (int trial = 0; trial < 20000; ++trial) {
        if (trial % 20 == 0) convex_case_random(&a, trial / 20 % CONVEX_KINDS, 6 + trial % 13, &random);
        const convex_shape s = convex_case_shape(&a);
        const convex_pose pose = {{1, 2, 3}, convex_case_rotation(&random)};
        const convex_vec x = {1 + 2 * convex_case_number(&random), 2 + 2 * convex_case_number(&random),
                              3 + 2 * convex_case_number(&random)};
        const convex_foot foot = convex_foot_on_polyhedron(s, pose, x, 100);
        const convex_vec place = convex_turn(convex_transpose(pose.map), convex_sub(foot.point, pose.origin));
        const convex_vec normal = convex_turn(convex_transpose(pose.map), foot.normal);
        double outside = -HUGE_VAL, above = -HUGE_VAL;
        int planes = 0;
        for (int f = 0; f < s.n_faces; ++f) {
            const convex_plane p = convex_own_plane(s, f);
            const double h = convex_dot(p.normal, place) - p.height;
            outside = fmax(outside, h);
            planes += fabs(h) < 1e-9;
        }
        for (int k = 0; k < s.n_corners; ++k)
            above = fmax(above, convex_dot(normal, convex_sub(convex_corner(s, k), place)));
        assert_true(outside < 1e-13); /* corners up to 10 to rounding */
        assert_true(fabs(convex_length(foot.normal) - 1) < 1e-14);
        assert_true(convex_length(convex_sub(convex_sub(x, foot.point), convex_scale(foot.distance, foot.normal))) <
                    1e-13);
        if (foot.distance > 0)
            assert_true(above <
                        1e-12 / fmin(1, foot.distance)); /* the way's direction, to rounding of places up to 40 */
        if (foot.distance > 0 && planes > 0 && planes < 4) ++on[planes - 1];
    }
    assert_true(on[0] > 100 && on[1] > 100 && on[2] > 100); /* faces, edges and corners */
}

static void foot_within_a_box_is_on_its_nearest_face(void **state)
{
    (void)state;
    convex_case a;
    convex_case_box(&a, 1, 2, 4);
    const convex_foot foot =
        convex_foot_on_polyhedron(convex_case_shape(&a), at(0, 0, 0), (convex_vec){0.375, 0.5, 1.5}, 0);
    assert_true(foot.distance == -0.125 && foot.normal.x == 1 && foot.point.x == 0.5 && foot.point.y == 0.5 &&
                foot.point.z == 1.5);
    assert_true(convex_foot_on_polyhedron(convex_case_shape(&a), at(0, 0, 0), (convex_vec){0, 0, 3}, 0.5).distance >
                0.5);
}

/* A run that went wrong has cells whose places are no numbers, or so large that their products are none: no overlap of
 * them may be looked for without end. */
static void places_that_are_no_numbers_end_too(void **state)
{
    (void)state;
    uint64_t random = 7;
    int refused = 0;
    convex_case a, b;
    convex_case_box(&a, 1, 1, 1);
    convex_case_box(&b, 1, 1, 1);
    for (int k = 0; k < 200000; ++k) {
        convex_pose pose[2];
        for (int i = 0; i < 2; ++i) {
            const double large = pow(10, 154 * (1 + convex_case_number(&random))),
                         far = pow(10, 154 * (1 + convex_case_number(&random)));
            double *const map = &pose[i].map.xx, *const origin = &pose[i].origin.x;
            for (int c = 0; c < 9; ++c)
                map[c] = large * convex_case_number(&random);
            for (int c = 0; c < 3; ++c)
                origin[c] = k % 2 ? far * convex_case_number(&random) : 0;
            if (k % 3 == 0) map[k / 3 % 9] = k % 4 ? NAN : INFINITY;
        }
        refused += convex_overlap_of(convex_case_shape(&a), pose[0], convex_case_shape(&b), pose[1]).failed == 2;
    }
    assert_true(refused > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_cubes_overlap_in_the_box_they_share),
        cmocka_unit_test(body_within_another_feels_no_force),
        cmocka_unit_test(faces_in_one_plane_count_once),
        cmocka_unit_test(volume_agrees_with_the_corners_of_all_planes),
        cmocka_unit_test(force_is_the_slope_of_the_energy),
        cmocka_unit_test(action_is_reaction_and_moments_balance),
        cmocka_unit_test(reordered_bodies_give_the_same_overlap),
        cmocka_unit_test(wall_cuts_as_a_large_box_does),
        cmocka_unit_test(box_on_a_wall_is_cut_where_it_sinks_in),
        cmocka_unit_test(foot_of_a_sphere_is_the_nearest_point),
        cmocka_unit_test(foot_within_a_box_is_on_its_nearest_face),
        cmocka_unit_test(places_that_are_no_numbers_end_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
