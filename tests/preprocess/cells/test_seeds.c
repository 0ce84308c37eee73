#include "../support.h"

#include "../../../host/base/memory.h"

#include "../../../preprocess/cells/seeds.h"

#include <stdlib.h>

/* Plan and draw the seeds of a request; the caller frees the positions. */
static double *draw(brc_context *context, const brc_build_request *r, brc_grid *grid, int64_t *n, int64_t *n_duplicate)
{
    brc_walls walls;
    double *position;
    brc_solid *solid = NULL;
    assert_int_equal(brc_solid_create(context, &r->shape, 1, &solid), BRC_OK);
    assert_int_equal(brc_walls_create(context, solid, brc_fill_spacing(solid, &r->fill), &walls), BRC_OK);
    assert_int_equal(brc_grid_plan(context, &r->fill, &walls, 1, grid), BRC_OK);
    assert_int_equal(brc_seeds_draw(context, grid, &r->fill, &walls, &position, n, n_duplicate), BRC_OK);
    for (int64_t e = 0; e < *n; ++e)
        assert_true(brc_walls_inside(&walls, position + 3 * e, 0.0));
    brc_walls_free(&walls);
    brc_solid_free(&solid);
    return position;
}

static void without_noise_seeds_are_centres_of_the_grid_cells(void **state)
{
    brc_build_request r = test_box(0, 0.0);
    r.fill.cells[0] = 2;
    r.fill.cells[1] = 3;
    r.fill.cells[2] = 4;
    brc_grid grid;
    int64_t n, n_duplicate;
    double *x = draw(*state, &r, &grid, &n, &n_duplicate);
    assert_int_equal(n, 24);
    for (int64_t e = 0; e < n; ++e) {
        assert_near(x[3 * e], (e % 2 + 0.5) / 2.0, 1e-16);
        assert_near(x[3 * e + 1], (e / 2 % 3 + 0.5) / 3.0, 2e-16);
        assert_near(x[3 * e + 2], (e / 6 + 0.5) / 4.0, 2e-16);
    }
    brc_memory_free(x);
}

/* Uniform noise over a fraction d of the cell: no seed farther than d/2 from the centre, mean 0, variance d^2/12. With
 * 8000 seeds the mean of three components has the deviation d/sqrt(12 * 24000) = 0.0019 d; five of these are allowed,
 * and the relative deviation of the variance, sqrt(4/5/24000) = 0.6 %, likewise. */
static void noise_is_uniform_over_the_asked_part_of_the_cell(void **state)
{
    const double spread[2] = {0.4, 1.0};
    for (int s = 0; s < 2; ++s) {
        brc_build_request r = test_box(8000, spread[s]);
        brc_grid grid;
        int64_t n, n_duplicate;
        double *x = draw(*state, &r, &grid, &n, &n_duplicate);
        assert_int_equal(n, 8000);
        double mean = 0.0, square = 0.0;
        for (int64_t k = 0; k < 3 * n; ++k) {
            const double noise = fmod(x[k] * 20.0, 1.0) - 0.5;
            assert_true(fabs(noise) <= 0.5 * spread[s] + 1e-12);
            mean += noise / (3.0 * (double)n);
            square += noise * noise / (3.0 * (double)n);
        }
        assert_near(mean, 0.0, 5.0 * 0.0019 * spread[s]);
        assert_near(square / (spread[s] * spread[s] / 12.0), 1.0, 5.0 * 0.006);
        brc_memory_free(x);
    }
}

static void the_number_of_elements_is_met(void **state)
{
    const struct {
        brc_build_request request;
        int64_t off; /* a box of nearly cubic grid cells cannot do better; curved shapes are searched */
    } cases[] = {{test_box(1000, 0.5), 0},       {test_box(10000, 0.5), 200},  {test_box(100000, 0.5), 600},
                 {test_cylinder(2000, 0.8), 10}, {test_sphere(2000, 0.8), 10}, {test_cylinder(20000, 0.0), 600}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        brc_grid grid;
        int64_t n, n_duplicate;
        brc_memory_free(draw(*state, &cases[k].request, &grid, &n, &n_duplicate));
        assert_true(llabs(n - cases[k].request.fill.n_elements) <= cases[k].off);
        assert_int_equal(n, grid.n_inside);
    }
}

static void a_minimal_distance_is_kept_and_the_dropped_are_counted(void **state)
{
    brc_build_request r = test_box(1000, 1.0);
    r.fill.min_distance = 0.05;
    brc_grid grid;
    int64_t n, n_duplicate;
    double *x = draw(*state, &r, &grid, &n, &n_duplicate);
    assert_true(n_duplicate > 0);
    assert_int_equal(n + n_duplicate, 1000);
    for (int64_t i = 0; i < n; ++i)
        for (int64_t j = 0; j < i; ++j) {
            const double a = x[3 * i] - x[3 * j], b = x[3 * i + 1] - x[3 * j + 1], c = x[3 * i + 2] - x[3 * j + 2];
            assert_true(a * a + b * b + c * c >= 0.05 * 0.05);
        }
    brc_memory_free(x);
}

static void bad_fills_are_refused_with_the_cure(void **state)
{
    brc_context *context = *state;
    brc_build_request r = test_box(0, 0.0);
    test_refused(context, &r, BRC_BAD_INPUT, "exactly one of them");
    r = test_box(1000, 0.0);
    r.fill.spacing = 0.1;
    test_refused(context, &r, BRC_BAD_INPUT, "2 of the number of elements");
    r = test_box(1000, 1.1);
    test_refused(context, &r, BRC_BAD_INPUT, "must be 0 to 1");
    r = test_box(1000, NAN);
    test_refused(context, &r, BRC_BAD_INPUT, "must be 0 to 1");
    r = test_box(1000, 1e-12);
    test_refused(context, &r, BRC_BAD_INPUT, "use 0 for cubes");
    r = test_box(-5, 0.0);
    test_refused(context, &r, BRC_BAD_INPUT, "-5 elements");
    r = test_box(1000, 0.5);
    r.fill.min_distance = 0.2;
    test_refused(context, &r, BRC_BAD_INPUT, "would drop most seeds");
    r = test_box(0, 0.5);
    r.fill.cells[0] = r.fill.cells[1] = 3;
    test_refused(context, &r, BRC_BAD_INPUT, "0 grid cells along z");
    r = test_box(0, 0.5);
    r.fill.spacing = 1e-9;
    test_refused(context, &r, BRC_BAD_INPUT, "use larger cells");
    r = test_box(400000000, 0.5);
    test_refused(context, &r, BRC_BAD_INPUT, "elements");
}

static void a_body_one_cell_thick_is_refused_with_the_cure(void **state)
{
    brc_context *context = *state;
    brc_build_request r = test_box(1000, 0.5);
    r.shape.size[2] = 0.01;
    test_refused(context, &r, BRC_BAD_INPUT, "cells across z (0.01 m), must be at least 2");
    test_says(context, "use a spacing of 0.005 m or less (about 8e+04 elements");
    r = test_box(1, 0.0);
    test_refused(context, &r, BRC_BAD_INPUT, "must be at least 2");
    r = test_sphere(3, 0.0);
    test_refused(context, &r, BRC_BAD_INPUT, "must be at least 2");
    r = test_cylinder(50, 0.0);
    r.shape.length = 0.01;
    test_refused(context, &r, BRC_BAD_INPUT, "cells across x");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(without_noise_seeds_are_centres_of_the_grid_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(noise_is_uniform_over_the_asked_part_of_the_cell, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_number_of_elements_is_met, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_minimal_distance_is_kept_and_the_dropped_are_counted, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bad_fills_are_refused_with_the_cure, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_body_one_cell_thick_is_refused_with_the_cure, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
