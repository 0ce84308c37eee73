#include "../support.h"

#include "../../../host/base/random.h"
#include "../../../preprocess/cells/voronoi.h"

#include <string.h>

static brc_solid *unit_box(brc_context *context, brc_walls *walls)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1.0, 1.0, 1.0}};
    brc_solid *solid = NULL;
    assert_int_equal(brc_solid_create(context, &shape, 1, &solid), BRC_OK);
    assert_int_equal(brc_walls_create(context, solid, 0.5, walls), BRC_OK);
    return solid;
}

static void release(brc_solid **solid, brc_walls *walls)
{
    brc_walls_free(walls);
    brc_solid_free(solid);
}

/* Two points in a unit cube share it by the plane x = 0.5: the first cell is a slab with the corners of half the
 * cube. */
static void two_points_share_the_cube_at_their_bisector(void **state)
{
    brc_walls walls;
    brc_solid *solid = unit_box(*state, &walls);
    const double x[6] = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5};
    brc_voronoi *voronoi;
    assert_int_equal(brc_voronoi_create(*state, x, 2, &walls, 0.5, &voronoi), BRC_OK);
    brc_voronoi_worker *worker = brc_voronoi_worker_create(voronoi);
    brc_polyhedron cell;
    assert_int_equal(brc_voronoi_cell(worker, 0, &cell), BRC_OK);
    assert_int_equal(cell.n_vertices, 8);
    assert_int_equal(cell.n_faces, 6);
    for (int v = 0; v < 8; ++v) {
        assert_near(fabs(cell.vertex[3 * v]), 0.25, 1e-15);
        assert_near(fabs(cell.vertex[3 * v + 1]), 0.5, 1e-15);
        assert_near(fabs(cell.vertex[3 * v + 2]), 0.5, 1e-15);
    }
    int seen = 0; /* the neighbour once, and five sides of the box: all but x+ */
    for (int f = 0; f < 6; ++f) {
        assert_int_equal(cell.face_start[f + 1] - cell.face_start[f], 4);
        seen |= 1 << (cell.face_other[f] + 6);
    }
    assert_int_equal(seen, 1 << 7 | 1 << 5 | 1 << 3 | 1 << 2 | 1 << 1 | 1 << 0);
    brc_voronoi_worker_free(&worker);
    brc_voronoi_free(&voronoi);
    release(&solid, &walls);
}

static void a_cell_does_not_depend_on_the_worker_or_on_what_it_did_before(void **state)
{
    enum { N = 200 };
    brc_walls walls;
    brc_solid *solid = unit_box(*state, &walls);
    double x[3 * N];
    for (int e = 0; e < N; ++e) {
        double draw[4];
        brc_random_uniform4(1, BRC_RANDOM_TEST, (uint64_t)e, 0, draw);
        memcpy(x + 3 * e, draw, 3 * sizeof *x);
    }
    brc_voronoi *voronoi;
    assert_int_equal(brc_voronoi_create(*state, x, N, &walls, 0.17, &voronoi), BRC_OK);
    brc_voronoi_worker *used = brc_voronoi_worker_create(voronoi);
    brc_polyhedron a, b;
    for (int e = N - 1; e >= 0; --e)
        assert_int_equal(brc_voronoi_cell(used, e, &a), BRC_OK);
    for (int e = 0; e < N; e += 7) {
        brc_voronoi_worker *fresh = brc_voronoi_worker_create(voronoi);
        assert_int_equal(brc_voronoi_cell(used, e, &a), BRC_OK);
        assert_int_equal(brc_voronoi_cell(fresh, e, &b), BRC_OK);
        assert_int_equal(a.n_vertices, b.n_vertices);
        assert_int_equal(a.n_faces, b.n_faces);
        assert_memory_equal(a.vertex, b.vertex, 3 * (size_t)a.n_vertices * sizeof(double));
        assert_memory_equal(a.face_other, b.face_other, (size_t)a.n_faces * sizeof(int32_t));
        brc_voronoi_worker_free(&fresh);
    }
    brc_voronoi_worker_free(&used);
    brc_voronoi_free(&voronoi);
    release(&solid, &walls);
}

static void points_voro_would_lose_silently_are_refused(void **state)
{
    brc_context *context = *state;
    brc_walls walls;
    brc_solid *solid = unit_box(context, &walls);
    const struct {
        double x[9];
        const char *says;
    } cases[] = {{{0.2, 0.2, 0.2, 0.7, 0.7, 0.7, 0.2, 0.2, 0.2}, "seeds 0 and 2 (counted from 0) are the same point"},
                 {{0.2, 0.2, 0.2, 0.7, 0.7, 1.7, 0.3, 0.2, 0.2}, "seed 1 at (0.7, 0.7, 1.7) m lies outside"},
                 {{0.2, 0.2, 0.2, 0.7, NAN, 0.7, 0.3, 0.2, 0.2}, "seed 1: position (0.7, nan, 0.7) is not finite"},
                 {{0.2, 0.2, 0.2, 0.7, INFINITY, 0.7, 0.3, 0.2, 0.2}, "is not finite"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        brc_voronoi *voronoi;
        brc_context_clear(context);
        assert_int_equal(brc_voronoi_create(context, cases[k].x, 3, &walls, 0.5, &voronoi), BRC_BAD_INPUT);
        assert_null(voronoi);
        test_says(context, cases[k].says);
    }
    release(&solid, &walls);
}

/* Voro++ leaves the program when 2^24 points fall into one of its blocks; the wrapper refuses long before. */
static void a_crowd_in_one_spot_is_refused(void **state)
{
    brc_context *context = *state;
    enum { N = 10002 };
    static double x[3 * N];
    brc_walls walls;
    brc_solid *solid = unit_box(context, &walls);
    for (int e = 0; e < N; ++e) {
        x[3 * e] = 0.5 + 1e-6 * e;
        x[3 * e + 1] = x[3 * e + 2] = 0.5;
    }
    brc_voronoi *voronoi;
    assert_int_equal(brc_voronoi_create(context, x, N, &walls, 0.5, &voronoi), BRC_BAD_INPUT);
    test_says(context, "crowd near");
    release(&solid, &walls);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(two_points_share_the_cube_at_their_bisector, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_cell_does_not_depend_on_the_worker_or_on_what_it_did_before, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(points_voro_would_lose_silently_are_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_crowd_in_one_spot_is_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
