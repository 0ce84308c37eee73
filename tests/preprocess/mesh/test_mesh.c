/* What a mesh answers, against formulas for cubes and lists of triangles without a tree. Coordinates are of the order
 * of 1, so distances computed in two ways agree to a few hundred roundings: 1e-13. */
#include "../support.h"
#include "../support_mesh.h"

#include "../../../host/base/random.h"

#include <string.h>

static const double ZERO[3] = {0.0, 0.0, 0.0}, ONE[3] = {1.0, 1.0, 1.0};
static const double EXACT = 1e-13;

static brc_mesh *read_good(brc_context *context, const test_mesh *list)
{
    brc_status status;
    brc_mesh *mesh = test_mesh_read(context, list, 2, &status);
    if (!mesh) fail_msg("%s", brc_context_message(context));
    return mesh;
}

/* Point number k of the box low .. low + width. */
static void random_point(uint64_t k, double low, double width, double x[3])
{
    double u[4];
    brc_random_uniform4(11, BRC_RANDOM_TEST, k, 0, u);
    for (int d = 0; d < 3; ++d)
        x[d] = low + width * u[d];
}

static void a_cube_has_its_volume_area_faces_and_bounds(void **state)
{
    test_mesh list = {0};
    test_mesh_box(&list, ZERO, ONE, 4);
    brc_mesh *mesh = read_good(*state, &list);
    double bounds[2][3];
    brc_mesh_bounds(mesh, bounds);
    assert_int_equal(brc_mesh_n_triangles(mesh), 6 * 4 * 4 * 2);
    assert_near(brc_mesh_volume(mesh), 1.0, 1e-14);
    assert_near(brc_mesh_area(mesh), 6.0, 1e-13);
    assert_int_equal(brc_mesh_n_patches(mesh), 6);
    assert_true(brc_mesh_is_convex(mesh));
    assert_memory_equal(bounds[0], ZERO, sizeof ZERO);
    assert_memory_equal(bounds[1], ONE, sizeof ONE);
    assert_int_equal(brc_mesh_concave_edges(mesh, NULL, 0), 0);
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static double cube_depth(const double x[3])
{
    double inside = HUGE_VAL, outside = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double depth = fmin(x[d], 1.0 - x[d]);
        inside = fmin(inside, depth);
        if (depth < 0.0) outside += depth * depth;
    }
    return inside >= 0.0 ? inside : -sqrt(outside);
}

static void depth_in_a_cube_is_that_of_its_planes(void **state)
{
    test_mesh list = {0};
    test_mesh_box(&list, ZERO, ONE, 3);
    brc_mesh *mesh = read_good(*state, &list);
    for (uint64_t k = 0; k < 5000; ++k) {
        double x[3];
        random_point(k, -0.5, 2.0, x);
        for (int d = 0; d < 3; ++d)
            if (k % 3 == 0) x[d] = round(8.0 * x[d]) / 8.0; /* many of them on faces, edges and corners */
        const double depth = cube_depth(x);
        assert_near(brc_mesh_depth(mesh, x), depth, EXACT);
        if (depth != 0.0 || k % 3 == 0) assert_int_equal(brc_mesh_inside(mesh, x), depth >= 0.0);
    }
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

/* Random points, half of them near vertices, where signs go wrong first. */
static void compare_with_list(brc_context *context, test_mesh *list, double low, double width, uint64_t n)
{
    brc_mesh *mesh = read_good(context, list);
    for (uint64_t k = 0; k < n; ++k) {
        double x[3], noise[3];
        random_point(k, low, width, x);
        random_point(n + k, -1e-3, 2e-3, noise);
        if (k % 2)
            for (int d = 0; d < 3; ++d)
                x[d] = list->corner[k * 7 % (uint64_t)(3 * list->n)][d] + noise[d];
        const double distance = test_mesh_distance(list, x);
        const bool inside = test_mesh_winding(list, x) > 0.5;
        assert_near(brc_mesh_depth(mesh, x), inside ? distance : -distance, EXACT);
        assert_int_equal(brc_mesh_inside(mesh, x), inside);
    }
    brc_mesh_free(&mesh);
    test_mesh_free(list);
}

static void depth_agrees_with_winding_number_and_search_of_all_triangles(void **state)
{
    static const double SHIFT[3] = {0.1, -0.2, 0.05};
    test_mesh torus = {0}, l = {0}, spheres = {0}, turned = {0};
    test_mesh_torus(&torus, 1.0, 0.4, 24, 12);
    compare_with_list(*state, &torus, -1.5, 3.0, 2000);
    test_mesh_l_profile(&l, 1.0);
    compare_with_list(*state, &l, -0.5, 3.0, 2000);
    test_mesh_torus(&turned, 1.0, 0.3, 9, 5); /* sharp everywhere, concave inside the ring */
    test_mesh_turn(&turned, 0.7, SHIFT);
    compare_with_list(*state, &turned, -1.5, 3.0, 2000);
    test_mesh_sphere(&spheres, ZERO, 1.0, 6); /* with a cavity and a kernel */
    test_mesh_sphere(&spheres, ZERO, 0.7, 6);
    test_mesh_reverse(&spheres, 8 * 36, 1);
    test_mesh_sphere(&spheres, ZERO, 0.4, 6);
    compare_with_list(*state, &spheres, -1.1, 2.2, 2000);
}

static void a_sphere_is_one_convex_patch_and_its_volume_rises_to_the_balls(void **state)
{
    double before = 1.0;
    for (int f = 8; f <= 32; f *= 2) {
        test_mesh list = {0};
        test_mesh_sphere(&list, ONE, 0.5, f);
        brc_mesh *mesh = read_good(*state, &list);
        const double error = 1.0 - brc_mesh_volume(mesh) / (acos(-1.0) / 6.0);
        assert_int_equal(brc_mesh_n_patches(mesh), 1);
        assert_true(brc_mesh_is_convex(mesh));
        assert_true(error > 0.0);
        if (f > 8)
            assert_near(before / error, 4.0,
                        0.2); /* second order in the triangles' size; 5 % for what comes after it */
        before = error;
        brc_mesh_free(&mesh);
        test_mesh_free(&list);
    }
}

static void feet_in_a_corner_of_a_cube_are_its_three_faces(void **state)
{
    test_mesh list = {0};
    test_mesh_box(&list, ZERO, ONE, 5);
    brc_mesh *mesh = read_good(*state, &list);
    const double x[3] = {0.12, 0.23, 0.34};
    brc_mesh_foot feet[8];
    assert_int_equal(brc_mesh_feet(mesh, x, 0.4, feet, 8), 3);
    bool seen[3] = {false, false, false};
    for (int k = 0; k < 3; ++k) {
        assert_true(feet[k].flat && !feet[k].on_edge && !feet[k].concave);
        assert_true(k == 0 || feet[k].patch > feet[k - 1].patch);
        for (int d = 0; d < 3; ++d) {
            if (feet[k].normal[d] > -0.5) continue;
            seen[d] = true;
            assert_near(feet[k].distance, x[d], EXACT);
            for (int e = 0; e < 3; ++e)
                assert_near(feet[k].point[e], e == d ? 0.0 : x[e], EXACT);
        }
    }
    assert_true(seen[0] && seen[1] && seen[2]);
    assert_int_equal(brc_mesh_feet(mesh, x, 0.2, feet, 8), 1);
    assert_int_equal(brc_mesh_feet(mesh, x, 3.0, feet, 2), 3); /* more than asked for, six in all */
    assert_int_equal(brc_mesh_feet(mesh, x, 3.0, feet, 6), 6);
    assert_int_equal(brc_mesh_feet(mesh, x, 0.0, feet, 8), 0);
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static void feet_beyond_the_edges_of_a_patch_lie_on_its_rim(void **state)
{
    test_mesh list = {0};
    test_mesh_l_profile(&list, 4.0);
    brc_mesh *mesh = read_good(*state, &list);
    const double below[3] = {0.5, 0.7, 2.0}; /* both faces of the concave edge end there as seen from here */
    brc_mesh_foot feet[8];
    int at_edge = 0;
    const int32_t n = brc_mesh_feet(mesh, below, 1.9, feet, 8);
    assert_int_equal(n, 6); /* all but the ends; z = 0 and 4 are 2 away */
    for (int k = 0; k < n; ++k) {
        if (!feet[k].on_edge) continue;
        if (!feet[k].concave) continue;
        ++at_edge;
        assert_near(feet[k].point[0], 1.0, EXACT);
        assert_near(feet[k].point[1], 1.0, EXACT);
        assert_near(feet[k].distance, sqrt(0.25 + 0.09), EXACT);
    }
    assert_int_equal(at_edge, 2);
    const double outside[3] = {-0.5, 0.5, 2.0}; /* the faces y = 0 and y = 2 end at convex edges */
    int convex_rims = 0;
    const int32_t m = brc_mesh_feet(mesh, outside, 0.8, feet, 8);
    for (int k = 0; k < m; ++k)
        convex_rims += feet[k].on_edge && !feet[k].concave;
    assert_int_equal(m, 2);
    assert_int_equal(convex_rims, 1);
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static void more_patches_than_a_window_holds_are_all_found(void **state)
{
    test_mesh list = {0};
    for (int i = 0; i < 60; ++i) { /* 360 faces */
        const double low[3] = {1.5 * (i % 4), 1.5 * (i / 4 % 4), 1.5 * (i / 16)};
        const double high[3] = {low[0] + 1.0, low[1] + 1.0, low[2] + 1.0};
        test_mesh_box(&list, low, high, 1);
    }
    brc_mesh *mesh = read_good(*state, &list);
    static brc_mesh_foot feet[400];
    const double x[3] = {2.0, 1.7, 3.1};
    assert_int_equal(brc_mesh_n_patches(mesh), 360);
    assert_int_equal(brc_mesh_feet(mesh, x, 100.0, feet, 400), 360);
    for (int32_t p = 0; p < 360; ++p)
        assert_int_equal(feet[p].patch, p);
    double nearest = HUGE_VAL;
    for (int32_t p = 0; p < 360; ++p)
        nearest = fmin(nearest, feet[p].distance);
    assert_near(nearest, test_mesh_distance(&list, x), EXACT);
    assert_near(brc_mesh_volume(mesh), 60.0, 1e-11);
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static void the_concave_edge_of_an_l_is_listed_with_its_two_normals(void **state)
{
    test_mesh list = {0};
    test_mesh_l_profile(&list, 3.0);
    brc_mesh *mesh = read_good(*state, &list);
    brc_mesh_edge edge;
    assert_int_equal(brc_mesh_concave_edges(mesh, NULL, 0), 1);
    assert_int_equal(brc_mesh_concave_edges(mesh, &edge, 1), 1);
    for (int k = 0; k < 2; ++k) {
        assert_near(edge.end[k][0], 1.0, 0.0);
        assert_near(edge.end[k][1], 1.0, 0.0);
    }
    assert_near(fabs(edge.end[1][2] - edge.end[0][2]), 3.0, 0.0);
    /* one faces +x (the wall x = 1), one +y (the wall y = 1); the edge runs with the first triangle to its left */
    assert_near(edge.normal[0][0] + edge.normal[1][0], 1.0, EXACT);
    assert_near(edge.normal[0][1] + edge.normal[1][1], 1.0, EXACT);
    const double way = edge.end[1][2] - edge.end[0][2]; /* down along the x-wall (seen from +x with z up it lies right
                                                           of the edge), or up along the y-wall */
    assert_true(way * (edge.normal[0][0] - edge.normal[0][1]) < 0.0);
    assert_false(brc_mesh_is_convex(mesh));
    assert_near(brc_mesh_volume(mesh), 9.0, 1e-13);
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static void lines_enter_and_leave_also_through_vertices_and_edges(void **state)
{
    test_mesh list = {0};
    test_mesh_torus(&list, 1.0, 0.4, 16, 8);
    brc_mesh *mesh = read_good(*state, &list);
    double t[16];
    for (uint64_t k = 0; k < 6000; ++k) {
        double x[3];
        random_point(k, -1.5, 3.0, x);
        const int axis = (int)(k % 3);
        if (k % 2) memcpy(x, list.corner[k % (uint64_t)(3 * list.n)], sizeof x); /* through a vertex */
        const int32_t n = brc_mesh_crossings(mesh, x, axis, t, 16);
        assert_int_equal(n % 2, 0);
        assert_true(n <= 16);
        for (int32_t i = 0; i < n; ++i) {
            assert_true(i == 0 || t[i] >= t[i - 1]);
            double on[3] = {x[0], x[1], x[2]};
            on[axis] += t[i];
            assert_near(brc_mesh_depth(mesh, on), 0.0, EXACT);
            if (i + 1 == n || k % 2) continue;
            on[axis] += 0.5 * (t[i + 1] - t[i]);
            assert_int_equal(brc_mesh_inside(mesh, on), i % 2 == 0); /* between two crossings */
        }
        if (n >= 2) assert_int_equal(brc_mesh_crossings(mesh, x, axis, t + 8, 1), n);
        if (n >= 2) assert_near(t[8], t[0], 0.0);
    }
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static void chords_on_a_grid_sum_to_the_volume_of_a_cube(void **state)
{
    test_mesh list = {0};
    test_mesh_box(&list, ZERO, ONE, 4);
    brc_mesh *mesh = read_good(*state, &list);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 8; ++i) /* lines on edges of triangles and on the cube's own: half-open, so i = 8 misses */
            for (int j = 0; j < 8; ++j) {
                double x[3] = {0.0, 0.0, 0.0}, t[4];
                x[(axis + 1) % 3] = i / 8.0;
                x[(axis + 2) % 3] = j / 8.0;
                assert_int_equal(brc_mesh_crossings(mesh, x, axis, t, 4), 2);
                assert_near(t[0], 0.0, EXACT);
                assert_near(t[1], 1.0, EXACT);
            }
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
}

static void one_thread_and_two_give_the_same_mesh(void **state)
{
    static const double SHIFT[3] = {0.3, 0.1, 0.2};
    test_mesh list = {0};
    test_mesh_torus(&list, 1.0, 0.4, 30, 20);
    test_mesh_turn(&list, 1.1, SHIFT);
    brc_status status;
    brc_mesh *one = test_mesh_read(*state, &list, 1, &status), *two = test_mesh_read(*state, &list, 2, &status);
    assert_true(one && two);
    assert_near(brc_mesh_volume(one), brc_mesh_volume(two), 0.0);
    for (uint64_t k = 0; k < 500; ++k) {
        double x[3];
        brc_mesh_foot a, b;
        memset(&a, 0, sizeof a);
        memset(&b, 0, sizeof b);
        random_point(k, -1.5, 3.0, x);
        assert_int_equal(brc_mesh_feet(one, x, 1.0, &a, 1), brc_mesh_feet(two, x, 1.0, &b, 1));
        assert_memory_equal(&a, &b, sizeof a);
    }
    brc_mesh_free(&one);
    brc_mesh_free(&two);
    test_mesh_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_cube_has_its_volume_area_faces_and_bounds, test_begin, test_end),
        cmocka_unit_test_setup_teardown(depth_in_a_cube_is_that_of_its_planes, test_begin, test_end),
        cmocka_unit_test_setup_teardown(depth_agrees_with_winding_number_and_search_of_all_triangles, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(a_sphere_is_one_convex_patch_and_its_volume_rises_to_the_balls, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(feet_in_a_corner_of_a_cube_are_its_three_faces, test_begin, test_end),
        cmocka_unit_test_setup_teardown(feet_beyond_the_edges_of_a_patch_lie_on_its_rim, test_begin, test_end),
        cmocka_unit_test_setup_teardown(more_patches_than_a_window_holds_are_all_found, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_concave_edge_of_an_l_is_listed_with_its_two_normals, test_begin, test_end),
        cmocka_unit_test_setup_teardown(lines_enter_and_leave_also_through_vertices_and_edges, test_begin, test_end),
        cmocka_unit_test_setup_teardown(chords_on_a_grid_sum_to_the_volume_of_a_cube, test_begin, test_end),
        cmocka_unit_test_setup_teardown(one_thread_and_two_give_the_same_mesh, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
