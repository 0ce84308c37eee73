/* What is refused, mended and turned when a mesh is read. */
#include "../support.h"
#include "../support_mesh.h"

#include <stdio.h>
#include <string.h>

static const double ZERO[3] = {0.0, 0.0, 0.0}, ONE[3] = {1.0, 1.0, 1.0};

static void add_cube(test_mesh *list, double x, double y, double z, double size, int n)
{
    const double low[3] = {x, y, z}, high[3] = {x + size, y + size, z + size};
    test_mesh_box(list, low, high, n);
}

/* Read, free the list; the sentence holds all of the parts. */
static void refused(brc_context *context, test_mesh *list, const char *first, const char *second)
{
    brc_status status;
    assert_null(test_mesh_read(context, list, 1, &status));
    assert_int_equal(status, BRC_BAD_INPUT);
    test_says(context, first);
    test_says(context, second);
    test_mesh_free(list);
}

static brc_mesh *accepted(brc_context *context, test_mesh *list)
{
    brc_status status;
    brc_mesh *mesh = test_mesh_read(context, list, 1, &status);
    if (!mesh) fail_msg("%s", brc_context_message(context));
    test_mesh_free(list);
    return mesh;
}

static void an_open_cube_is_refused_with_the_number_of_edges_and_the_first(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 1);
    --list.n; /* of the face z = 1: (0 0 1) (1 1 1) (0 1 1) */
    refused(*state, &list, "open: 3 edges have one triangle only, the first from (", "close the mesh");
    add_cube(&list, 0, 0, 0, 1, 1);
    memmove(list.corner, list.corner + 3, (size_t)(3 * (list.n - 1)) * sizeof *list.corner);
    --list.n;
    /* (0 0 0) (0 0 1) (0 1 1) is gone; the next one begins with their common edge */
    refused(*state, &list, "open: 3 edges have one triangle only, the first from (0, 0, 0) to (0, 1, 1)",
            "repair tool");
}

static void vertices_that_nearly_meet_are_named_as_the_cause_of_open_edges(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0.0, 0.0, 0.0, 1.0, 1);
    for (int64_t k = 0; k < 3 * list.n; ++k)
        list.corner[k][k % 3] += 1e-5 * sin((double)(7 * k)); /* every triangle for itself */
    refused(*state, &list, "the mesh is open: 36 edges", "from other vertices: merge vertices nearer than that");
}

static void an_inner_wall_is_refused_as_an_edge_of_three_triangles(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 1);
    add_cube(&list, 1, 0, 0, 1, 1); /* shares a whole face */
    refused(*state, &list, "5 edges have more than two triangles, the first 4", "unite the parts");
}

static void triangles_facing_the_wrong_way_are_turned(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 4);
    test_mesh_reverse(&list, 1, 5);
    brc_mesh *mesh = accepted(*state, &list);
    assert_near(brc_mesh_volume(mesh), 1.0, 1e-14);
    assert_int_equal(brc_mesh_n_patches(mesh), 6);
    brc_mesh_free(&mesh);
    add_cube(&list, 0, 0, 0, 1, 2);
    test_mesh_reverse(&list, 0, 1); /* inside out as a whole */
    mesh = accepted(*state, &list);
    assert_near(brc_mesh_volume(mesh), 1.0, 1e-14);
    assert_true(brc_mesh_inside(mesh, (double[3]){0.5, 0.4, 0.3}));
    assert_true(brc_mesh_is_convex(mesh));
    brc_mesh_free(&mesh);
}

/* A Klein bottle (figure-8 immersion): after one turn around the ring the tube closes upside down. */
static void a_surface_with_one_side_is_refused(void **state)
{
    enum { N = 16, M = 12 };
    test_mesh list = {0};
    double p[N][M][3];
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < M; ++j) {
            const double u = 2.0 * acos(-1.0) * i / N, v = 2.0 * acos(-1.0) * (j + 0.5) / M;
            const double r = 3.0 + cos(u / 2) * sin(v) - sin(u / 2) * sin(2 * v);
            p[i][j][0] = r * cos(u);
            p[i][j][1] = r * sin(u);
            p[i][j][2] = sin(u / 2) * sin(v) + cos(u / 2) * sin(2 * v);
        }
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < M; ++j) {
            const int k = (j + 1) % M;
            const double *a = p[i][j], *d = p[i][k];
            const double *b = i + 1 < N ? p[i + 1][j] : p[0][M - 1 - j], *c = i + 1 < N ? p[i + 1][k] : p[0][M - 1 - k];
            test_mesh_add(&list, a, b, c);
            test_mesh_add(&list, a, c, d);
        }
    refused(*state, &list, "the surface has no outside", "rebuild the surface");
}

static void cavities_count_as_holes_and_kernels_as_solid(void **state)
{
    for (int inside_out = 0; inside_out < 2; ++inside_out) {
        test_mesh list = {0};
        add_cube(&list, 0, 0, 0, 8, 2);
        add_cube(&list, 1, 1, 1, 4, 2); /* cavity */
        test_mesh_reverse(&list, 48, 1);
        add_cube(&list, 2, 2, 2, 2, 2); /* kernel */
        add_cube(&list, 6, 6, 6, 1, 1); /* a second cavity */
        test_mesh_reverse(&list, 3 * 48, 1);
        add_cube(&list, 10, 0, 0, 1, 1); /* a second body */
        if (inside_out) test_mesh_reverse(&list, 0, 1);
        brc_mesh *mesh = accepted(*state, &list);
        assert_near(brc_mesh_volume(mesh), 512.0 - 64.0 + 8.0 - 1.0 + 1.0, 1e-11);
        assert_false(brc_mesh_is_convex(mesh));
        assert_false(brc_mesh_inside(mesh, (double[3]){1.5, 1.5, 1.5}));
        assert_true(brc_mesh_inside(mesh, (double[3]){0.5, 1.5, 1.5}));
        assert_true(brc_mesh_inside(mesh, (double[3]){3.0, 3.0, 3.0}));
        assert_false(brc_mesh_inside(mesh, (double[3]){6.5, 6.5, 6.5}));
        assert_true(brc_mesh_inside(mesh, (double[3]){10.5, 0.5, 0.5}));
        assert_near(brc_mesh_depth(mesh, (double[3]){3.0, 3.1, 0.6}), 0.4, 1e-14);
        brc_mesh_free(&mesh);
    }
}

static void a_shell_within_a_shell_that_faces_the_same_way_is_refused(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 8, 1);
    add_cube(&list, 1, 1, 1, 4, 1);
    refused(*state, &list, "lies within 1 other but is oriented as a solid", "reverse this shell for a cavity");
}

static void cuts_are_refused_with_the_pair_and_the_place(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 1);
    add_cube(&list, 0.7, 0.6, 0.5, 1, 1); /* general overlap */
    refused(*state, &list, "cut or touch each other, the first are triangles ", "unite overlapping parts");
    add_cube(&list, 0, 0, 0, 1, 4);
    add_cube(&list, 0.5, 0.125, 0.75, 1, 4); /* vertices of one exactly on faces of the other */
    refused(*state, &list, "cut or touch each other", "near (");
    add_cube(&list, 0, 0, 0, 1, 1);
    add_cube(&list, 1, 0.25, 0.25, 0.5, 1); /* face on face */
    refused(*state, &list, "cut or touch each other", "near (1, ");
    add_cube(&list, 0, 0, 0, 1, 1);
    add_cube(&list, 1, 1, 1, 1, 1); /* at a corner */
    refused(*state, &list, "cut or touch each other", "near (1, 1, 1)");
}

/* The surface of a cube dented by moving one inner vertex of its top through the bottom. */
static void a_surface_that_cuts_itself_is_refused(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 4);
    for (int64_t k = 0; k < 3 * list.n; ++k)
        if (list.corner[k][0] == 0.5 && list.corner[k][1] == 0.5 && list.corner[k][2] == 1.0) list.corner[k][2] = -0.3;
    refused(*state, &list, "cut or touch each other", "0)");
    /* folding one vertex of a flat face over its neighbours, within the plane */
    add_cube(&list, 0, 0, 0, 1, 4);
    for (int64_t k = 0; k < 3 * list.n; ++k)
        if (list.corner[k][0] == 0.5 && list.corner[k][1] == 0.5 && list.corner[k][2] == 1.0) list.corner[k][0] = 0.9;
    refused(*state, &list, "cut or touch each other", ", 1)");
}

static void a_thin_gap_that_single_precision_resolves_is_no_cut(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 3);
    add_cube(&list, 1.00001, 0, 0, 1, 3);
    brc_mesh *mesh = accepted(*state, &list);
    assert_near(brc_mesh_volume(mesh), 2.0, 1e-13);
    assert_false(brc_mesh_inside(mesh, (double[3]){1.000005, 0.5, 0.5}));
    brc_mesh_free(&mesh);
}

/* The corner (0 0 1) - (1 0 1) edge of a cube with points on it that only one side uses: the other side reaches them by
 * triangles without height. */
static void triangles_without_height_are_mended(void **state)
{
    static const double A[3] = {0, 0, 1}, B[3] = {1, 0, 1};
    test_mesh list = {0}, whole = {0};
    add_cube(&whole, 0, 0, 0, 1, 1);
    for (int64_t t = 0; t < whole.n; ++t) {
        double(*c)[3] = whole.corner + 3 * t;
        int at = -1;
        bool split = c[0][2] == 1.0 && c[1][2] == 1.0 && c[2][2] == 1.0; /* the top only */
        for (int k = 0; k < 3; ++k)
            if ((!memcmp(c[k], A, sizeof A) && !memcmp(c[(k + 1) % 3], B, sizeof B))) at = k;
        if (!split || at < 0) {
            test_mesh_add(&list, c[0], c[1], c[2]);
            continue;
        }
        double p[5][3];
        for (int i = 0; i < 5; ++i)
            for (int d = 0; d < 3; ++d)
                p[i][d] = A[d] + (B[d] - A[d]) * i / 4.0;
        for (int i = 0; i < 4; ++i)
            test_mesh_add(&list, p[i], p[i + 1], c[(at + 2) % 3]);
        test_mesh_add(&list, p[0], p[4], p[2]); /* without height; runs with the front's edge reversed */
        test_mesh_add(&list, p[0], p[2], p[1]);
        test_mesh_add(&list, p[2], p[4], p[3]);
        test_mesh_add(&list, p[1], p[1], p[2]); /* with two equal corners */
    }
    test_mesh_free(&whole);
    assert_int_equal(list.n, 12 + 3 + 3 + 1);
    brc_mesh *mesh = accepted(*state, &list);
    assert_int_equal(brc_mesh_n_triangles(mesh), 12 + 3 + 3);
    assert_near(brc_mesh_volume(mesh), 1.0, 1e-14);
    assert_near(brc_mesh_area(mesh), 6.0, 1e-13);
    assert_int_equal(brc_mesh_n_patches(mesh), 6);
    assert_true(brc_mesh_is_convex(mesh));
    assert_near(brc_mesh_depth(mesh, (double[3]){0.5, -0.1, 1.1}), -sqrt(0.02), 1e-14);
    brc_mesh_free(&mesh);
}

static void vertices_within_a_billionth_of_the_size_are_one(void **state)
{
    test_mesh list = {0};
    add_cube(&list, 0, 0, 0, 1, 4);
    for (int64_t k = 0; k < 3 * list.n; ++k)
        for (int d = 0; d < 3; ++d)
            list.corner[k][d] += 2e-10 * (double)((7 * k + 3 * d) % 5 - 2); /* apart by at most 14e-10 < 1.73e-9 */
    brc_mesh *mesh = accepted(*state, &list);
    assert_int_equal(brc_mesh_n_triangles(mesh), 192);
    assert_near(brc_mesh_volume(mesh), 1.0, 1e-8);
    brc_mesh_free(&mesh);
}

/* In single precision a turned plane is not plane, and rounding makes slivers: still six flat faces, convex, and no
 * cut. */
static void single_precision_leaves_a_turned_cube_flat_and_convex(void **state)
{
    static const double SHIFT[3] = {3.0, -2.0, 1.0};
    test_mesh list = {0};
    test_mesh_box(&list, ZERO, ONE, 20);
    test_mesh_turn(&list, 0.4, SHIFT);
    test_mesh_write_binary(&list, "test_mesh_turned.stl");
    brc_mesh *mesh = NULL;
    if (brc_mesh_read_stl(*state, "test_mesh_turned.stl", 1.0, ZERO, 1, &mesh) != BRC_OK)
        fail_msg("%s", brc_context_message(*state));
    assert_int_equal(brc_mesh_n_patches(mesh), 6);
    assert_true(brc_mesh_is_convex(mesh));
    assert_near(brc_mesh_volume(mesh), 1.0,
                6.0 * 3.0 * 0x1p-23); /* faces move by at most half a unit of the last place of 4, 2^-22 / 2 */
    brc_mesh_foot feet[6];
    double middle[3] = {0.5, 0.5, 0.5};
    list.n = 1;
    memcpy(list.corner[0], middle, sizeof middle);
    test_mesh_turn(&list, 0.4, SHIFT);
    assert_int_equal(brc_mesh_feet(mesh, list.corner[0], 0.51, feet, 6), 6);
    for (int k = 0; k < 6; ++k)
        assert_true(feet[k].flat);
    brc_mesh_free(&mesh);
    test_mesh_free(&list);
    remove("test_mesh_turned.stl");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_open_cube_is_refused_with_the_number_of_edges_and_the_first, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(vertices_that_nearly_meet_are_named_as_the_cause_of_open_edges, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(an_inner_wall_is_refused_as_an_edge_of_three_triangles, test_begin, test_end),
        cmocka_unit_test_setup_teardown(triangles_facing_the_wrong_way_are_turned, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_surface_with_one_side_is_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cavities_count_as_holes_and_kernels_as_solid, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_shell_within_a_shell_that_faces_the_same_way_is_refused, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(cuts_are_refused_with_the_pair_and_the_place, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_surface_that_cuts_itself_is_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_thin_gap_that_single_precision_resolves_is_no_cut, test_begin, test_end),
        cmocka_unit_test_setup_teardown(triangles_without_height_are_mended, test_begin, test_end),
        cmocka_unit_test_setup_teardown(vertices_within_a_billionth_of_the_size_are_one, test_begin, test_end),
        cmocka_unit_test_setup_teardown(single_precision_leaves_a_turned_cube_flat_and_convex, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
