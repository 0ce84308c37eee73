#include "../support.h"

#include "../../../preprocess/cells/cells.h"

static const brc_shape cube = {.kind = BRC_SHAPE_BOX, .size = {1.0, 1.0, 1.0}};

static brc_solid *cube_walls(brc_context *context, brc_walls *walls)
{
    brc_solid *solid = NULL;
    assert_int_equal(brc_solid_create(context, &cube, 1, &solid), BRC_OK);
    assert_int_equal(brc_walls_create(context, solid, 0.5, walls), BRC_OK);
    return solid;
}

/* Seeds at x = 0.2 and 0.6 share the cube at 0.4; the centroids of the two slabs lie at 0.2 and 0.7. The first seed is
 * at its centroid already, but for a rounding that must not move it. */
static void a_lloyd_sweep_moves_seeds_to_the_centroids_of_their_cells(void **state)
{
    brc_walls walls;
    brc_solid *solid = cube_walls(*state, &walls);
    double x[6] = {0.2, 0.5, 0.5, 0.6, 0.5, 0.5};
    assert_int_equal(brc_cells_relax(*state, x, 2, &walls, 0.5, 1, false, "test"), BRC_OK);
    assert_true(x[0] == 0.2 && x[1] == 0.5 && x[2] == 0.5);
    assert_near(x[3], 0.7, 1e-15);
    brc_walls_free(&walls);
    brc_solid_free(&solid);
}

static void the_parts_of_two_slabs_are_written_down_in_order(void **state)
{
    brc_walls walls;
    brc_solid *solid = cube_walls(*state, &walls);
    const double x[6] = {0.2, 0.5, 0.5, 0.6, 0.5, 0.5};
    brc_cells cells;
    assert_int_equal(brc_cells_compute(*state, x, 2, &walls, 0.5, 2, false, &cells), BRC_OK);
    assert_int_equal(cells.n_runs, 1);
    const brc_cell_run *run = &cells.run[0];
    assert_near(cells.volume[0], 0.4, 5e-16); /* rounding of sums */
    assert_near(cells.volume[1], 0.6, 5e-16);
    assert_int_equal(run->n_faces, 2);
    for (int e = 0; e < 2; ++e) {
        assert_int_equal(cells.n_faces[e], 1);
        assert_int_equal(cells.n_free[e], 5);
        assert_int_equal(cells.n_corners[e], 8);
        assert_int_equal(run->neighbour[e], 1 - e);
        assert_near(run->area[e], 1.0, 1e-15);
        assert_near(run->centroid[3 * e], 0.4, 5e-16);
    }
    const int32_t walls_in_order[10] = {0, 2, 3, 4, 5, 1, 2, 3, 4, 5}; /* the first lacks x+, the second x- */
    for (int f = 0; f < 10; ++f)
        assert_int_equal(run->free_wall[f], walls_in_order[f]);
    brc_cells_free(&cells);
    brc_cells_free(&cells); /* of nothing is allowed */
    brc_walls_free(&walls);
    brc_solid_free(&solid);
}

static void seeds_that_have_no_cell_are_refused(void **state)
{
    brc_walls walls;
    brc_solid *solid = cube_walls(*state, &walls);
    const double x[6] = {0.2, 0.5, 0.5, 1.6, 0.5, 0.5};
    brc_cells cells;
    assert_int_equal(brc_cells_compute(*state, x, 2, &walls, 0.5, 1, false, &cells), BRC_BAD_INPUT);
    test_says(*state, "seed 1 at (1.6, 0.5, 0.5) m lies outside the shape");
    brc_walls_free(&walls);
    brc_solid_free(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_lloyd_sweep_moves_seeds_to_the_centroids_of_their_cells, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(the_parts_of_two_slabs_are_written_down_in_order, test_begin, test_end),
        cmocka_unit_test_setup_teardown(seeds_that_have_no_cell_are_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
