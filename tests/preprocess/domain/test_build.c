#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/domain_file.h"

#include <stdio.h>
#include <string.h>

/* Planes of curved walls are placed so that the volume is exact; what is left is the rounding of ten thousand sums. */
static void cell_volumes_sum_to_the_shape(void **state)
{
    const brc_build_request requests[] = {test_box(1000, 0.0),      test_box(8000, 1.0),   test_cylinder(500, 0.9),
                                          test_cylinder(5000, 0.5), test_sphere(500, 0.9), test_sphere(8000, 1.0)};
    const double pi = 3.14159265358979323846;
    const double volume[] = {1.0, 1.0, 0.09 * pi, 0.09 * pi, pi / 6.0, pi / 6.0};
    for (size_t k = 0; k < sizeof requests / sizeof *requests; ++k) {
        brc_domain *d = test_build(*state, &requests[k]);
        double sum = 0.0;
        for (int64_t e = 0; e < d->n_elements; ++e)
            sum += d->volume[e];
        assert_near(sum / volume[k], 1.0, 1e-12);
        assert_near(d->quality.volume_error, 0.0, 1e-12);
        assert_int_equal(brc_domain_check(*state, d), BRC_OK);
        brc_domain_free(&d);
    }
}

/* The inertia of the whole from the cells by the parallel-axis theorem: box a^2 + b^2 over 12 at unit mass. The sum
 * runs over a thousand cells, so rounding stays below 1e-13. */
static void inertia_of_the_cells_sums_to_that_of_the_box(void **state)
{
    brc_build_request r = test_box(1000, 1.0);
    r.shape.size[0] = 2.0;
    brc_domain *d = test_build(*state, &r);
    double inertia[6] = {0.0};
    const double centre[3] = {1.0, 0.5, 0.5};
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = d->centroid[3 * e + k] - centre[k];
        const double v = d->volume[e], *own = d->inertia + 6 * e;
        inertia[0] += own[0] + v * (x[1] * x[1] + x[2] * x[2]);
        inertia[1] += own[1] + v * (x[0] * x[0] + x[2] * x[2]);
        inertia[2] += own[2] + v * (x[0] * x[0] + x[1] * x[1]);
        inertia[3] += own[3] - v * x[1] * x[2];
        inertia[4] += own[4] - v * x[0] * x[2];
        inertia[5] += own[5] - v * x[0] * x[1];
    }
    const double expected[6] = {2.0 * 2.0 / 12.0, 2.0 * 5.0 / 12.0, 2.0 * 5.0 / 12.0, 0.0, 0.0, 0.0};
    for (int k = 0; k < 6; ++k)
        assert_near(inertia[k], expected[k], 1e-13);
    brc_domain_free(&d);
}

static void a_full_spread_leaves_a_proper_domain(void **state)
{
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        brc_build_request r = test_box(1000, 1.0);
        r.fill.seed = seed;
        brc_domain *d = test_build(*state, &r);
        assert_int_equal(d->n_elements, 1000);
        assert_int_equal(brc_domain_check(*state, d), BRC_OK);
        assert_true(d->quality.support_smallest > 0.0);
        brc_domain_free(&d);
    }
}

static void lloyd_sweeps_even_out_the_cells(void **state)
{
    brc_build_request r = test_sphere(1500, 0.9);
    brc_domain *rough = test_build(*state, &r);
    r.fill.lloyd_sweeps = 5;
    brc_domain *relaxed = test_build(*state, &r);
    assert_int_equal(relaxed->n_elements, rough->n_elements);
    assert_true(relaxed->quality.smallest_distance > 2.0 * rough->quality.smallest_distance);
    assert_true(relaxed->quality.support_smallest > rough->quality.support_smallest);
    double off[2] = {0.0, 0.0};
    for (int64_t e = 0; e < rough->n_elements; ++e)
        for (int k = 0; k < 3; ++k) {
            off[0] += fabs(rough->position[3 * e + k] - rough->centroid[3 * e + k]);
            off[1] += fabs(relaxed->position[3 * e + k] - relaxed->centroid[3 * e + k]);
        }
    assert_true(off[1] < 0.35 * off[0]); /* seeds approach the centroids of their cells */
    brc_domain_free(&rough);
    brc_domain_free(&relaxed);
}

static void files_are_equal_bytes_for_any_number_of_threads(void **state)
{
    brc_build_request requests[] = {test_box(5000, 1.0), test_cylinder(3000, 0.9), test_sphere(3000, 0.9)};
    requests[2].fill.lloyd_sweeps = 2;
    for (int k = 0; k < 3; ++k) {
        brc_domain *first = test_build(*state, &requests[k]);
        for (int32_t threads = 2; threads <= 3; ++threads) {
            requests[k].n_threads = threads;
            brc_domain *d = test_build(*state, &requests[k]);
            test_same_bytes(*state, first, d);
            brc_domain_free(&d);
        }
        brc_domain_free(&first);
    }
}

static void another_seed_gives_another_domain(void **state)
{
    brc_build_request r = test_box(1000, 0.5);
    brc_domain *a = test_build(*state, &r);
    r.fill.seed = 8;
    brc_domain *b = test_build(*state, &r);
    assert_true(a->n_bonds != b->n_bonds || memcmp(a->position, b->position, 3000 * sizeof(double)) != 0);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

static void regions_take_the_last_predicate_that_fits(void **state)
{
    brc_predicate regions[2] = {
        {.has_half_space = true, .half_space_point = {0.5, 0, 0}, .half_space_normal = {1, 0, 0}},
        {.has_sphere = true, .sphere_centre = {1, 1, 1}, .sphere_radius = 0.3}};
    brc_build_request r = test_box(1000, 0.9);
    r.n_regions = 2;
    r.regions = regions;
    r.body = 4;
    brc_domain *d = test_build(*state, &r);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = d->position + 3 * e;
        const double far = sqrt((x[0] - 1) * (x[0] - 1) + (x[1] - 1) * (x[1] - 1) + (x[2] - 1) * (x[2] - 1));
        assert_int_equal(d->region[e], far <= 0.3 ? 2 : x[0] >= 0.5 ? 1 : 0);
        assert_int_equal(d->body[e], 4);
    }
    brc_domain_free(&d);
    regions[1].sphere_centre[0] = 5.0;
    test_refused(*state, &r, BRC_BAD_INPUT, "region 2: no element lies in it");
}

static void bytes_and_elements_are_estimated_within_a_tenth(void **state)
{
    brc_context *context = *state;
    brc_build_request requests[] = {test_box(1000, 0.0),     test_box(1000, 0.001),    test_box(20000, 1.0),
                                    test_cylinder(300, 0.5), test_cylinder(8000, 0.9), test_sphere(64, 0.5),
                                    test_sphere(8000, 1.0),  test_sphere(4000, 0.0),   test_cylinder(8000, 0.0),
                                    test_box(8000, 0.5)};
    requests[7].fill.lloyd_sweeps = 3;
    requests[8].fill.lloyd_sweeps = 3;
    requests[9].fill.lloyd_sweeps = 4;
    for (size_t k = 0; k < sizeof requests / sizeof *requests; ++k) {
        int64_t n, bytes;
        assert_int_equal(brc_domain_estimate(context, &requests[k], &n, &bytes), BRC_OK);
        const int64_t before = brc_memory_held();
        brc_domain *d = test_build(context, &requests[k]);
        const double real = (double)(brc_memory_held() - before);
        assert_int_equal(d->n_elements, n);
        if (fabs((double)bytes / real - 1.0) > 0.1)
            fail_msg("case %zu: estimate %lld, real %g", k, (long long)bytes, real);
        brc_domain_free(&d);
    }
}

/* Corners of the cells are there twice for a moment, faces never. */
static void building_takes_a_third_more_than_the_domain(void **state)
{
    const brc_build_request request = test_box(20480, 0.9); /* whole runs of cells */
    const int64_t before = brc_memory_held();
    brc_memory_mark();
    brc_domain *d = test_build(*state, &request);
    const double real = (double)(brc_memory_held() - before), most = (double)(brc_memory_peak_since_mark() - before);
    if (most > 1.4 * real) fail_msg("%g times the domain", most / real);
    brc_domain_free(&d);
}

static void more_elements_than_memory_holds_are_refused_before_building(void **state)
{
    brc_build_request r = test_box(0, 0.5);
    r.fill.cells[0] = r.fill.cells[1] = 500000;
    r.fill.cells[2] = 2;
    int64_t n, bytes;
    assert_int_equal(brc_domain_estimate(*state, &r, &n, &bytes), BRC_BAD_INPUT);
    test_says(*state, "ask for at most");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cell_volumes_sum_to_the_shape, test_begin, test_end),
        cmocka_unit_test_setup_teardown(inertia_of_the_cells_sums_to_that_of_the_box, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_full_spread_leaves_a_proper_domain, test_begin, test_end),
        cmocka_unit_test_setup_teardown(lloyd_sweeps_even_out_the_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(files_are_equal_bytes_for_any_number_of_threads, test_begin, test_end),
        cmocka_unit_test_setup_teardown(another_seed_gives_another_domain, test_begin, test_end),
        cmocka_unit_test_setup_teardown(regions_take_the_last_predicate_that_fits, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bytes_and_elements_are_estimated_within_a_tenth, test_begin, test_end),
        cmocka_unit_test_setup_teardown(building_takes_a_third_more_than_the_domain, test_begin, test_end),
        cmocka_unit_test_setup_teardown(more_elements_than_memory_holds_are_refused_before_building, test_begin,
                                        test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
