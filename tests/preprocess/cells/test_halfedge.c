#include "../support.h"

#include "../../../host/base/random.h"

#include <string.h>

/* All shapes and fills whose half-edges must obey the same rules. */
enum { N_CASES = 6 };
static brc_build_request request_of(int k)
{
    brc_build_request r[N_CASES] = {test_box(1000, 0.0),     test_box(1000, 1.0),   test_box(1000, 1e-4),
                                    test_cylinder(800, 0.9), test_sphere(800, 0.9), test_sphere(800, 0.0)};
    r[5].fill.lloyd_sweeps = 2;
    return r[k];
}

/* Area vectors and centroids come from corners that Voro++ knows to 1e-14 of a cell, and each cell sums about fifteen:
 * 1e-12 leaves room for cells of unlucky shape, and is what the patch test at 1e-10 needs. At spread 1e-4 faces of
 * 1e-10 of the mean area occur; those below 1e-12 are dropped and leave their cells open by as much. */
static void every_cell_is_closed_and_exact_for_linear_fields(void **state)
{
    for (int k = 0; k < N_CASES; ++k) {
        const brc_build_request r = request_of(k);
        brc_domain *d = test_build(*state, &r);
        assert_near(test_worst_closure(d), 0.0, 1e-12);
        assert_near(test_worst_first_moment(d), 0.0, 1e-12);
        assert_near(d->quality.twin_area_worst, 0.0, 1e-12);
        brc_domain_free(&d);
    }
}

static void twins_are_exactly_opposite_and_point_at_each_other(void **state)
{
    for (int k = 0; k < N_CASES; ++k) {
        const brc_build_request r = request_of(k);
        brc_domain *d = test_build(*state, &r);
        for (int64_t e = 0; e < d->n_elements; ++e)
            for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
                const int64_t t = d->twin[h];
                assert_int_equal(d->twin[t], h);
                assert_int_equal(d->neighbour[t], e);
                assert_int_equal(d->bond[t], d->bond[h]);
                for (int c = 0; c < 3; ++c) {
                    assert_true(d->area_vector[3 * h + c] == -d->area_vector[3 * t + c]);
                    assert_true(d->face_centroid[3 * h + c] == d->face_centroid[3 * t + c]);
                }
            }
        brc_domain_free(&d);
    }
}

static void every_bond_appears_once_from_its_smaller_element(void **state)
{
    for (int k = 0; k < N_CASES; ++k) {
        const brc_build_request r = request_of(k);
        brc_domain *d = test_build(*state, &r);
        assert_int_equal(d->n_half_edges, 2 * d->n_bonds);
        int64_t b = 0;
        for (int64_t e = 0; e < d->n_elements; ++e)
            for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
                if (h > d->row_start[e]) assert_true(d->neighbour[h] > d->neighbour[h - 1]);
                if (d->neighbour[h] < e) continue;
                assert_int_equal(d->bond_half_edge[b], h);
                assert_int_equal(d->bond[h], b++);
            }
        assert_int_equal(b, d->n_bonds);
        brc_domain_free(&d);
    }
}

/* R = (L/S) s to rounding, and the centroid lies on the bisector of the two seeds. */
static void a_face_is_normal_to_its_branch_and_halves_it(void **state)
{
    const brc_build_request r = request_of(1);
    brc_domain *d = test_build(*state, &r);
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const double *x = d->position + 3 * e, *y = d->position + 3 * (int64_t)d->neighbour[h];
            const double *s = d->area_vector + 3 * h, *c = d->face_centroid + 3 * h;
            double length = 0.0, area = 0.0, nearer = 0.0;
            for (int k = 0; k < 3; ++k) {
                length += (y[k] - x[k]) * (y[k] - x[k]);
                area += s[k] * s[k];
                nearer += (c[k] - 0.5 * (x[k] + y[k])) * (y[k] - x[k]);
            }
            const double q = sqrt(length / area);
            for (int k = 0; k < 3; ++k)
                assert_near(q * s[k], y[k] - x[k], 1e-15);
            assert_near(nearer / length, 0.0, 1e-13);
        }
    brc_domain_free(&d);
}

/* The definition of Voronoi cells, by brute force: the cell that holds a point is that of the nearest seed. */
static void a_point_lies_in_the_cell_of_its_nearest_seed(void **state)
{
    for (int k = 1; k < N_CASES; k += 2) { /* box, cylinder, relaxed sphere */
        const brc_build_request r = request_of(k);
        brc_domain *d = test_build(*state, &r);
        for (uint64_t p = 0; p < 500; ++p) {
            double draw[4], x[3];
            brc_random_uniform4(3, BRC_RANDOM_TEST, p, 1, draw);
            for (int c = 0; c < 3; ++c)
                x[c] = d->bounds[0][c] + draw[c] * (d->bounds[1][c] - d->bounds[0][c]);
            int64_t nearest = 0;
            double least = HUGE_VAL;
            for (int64_t e = 0; e < d->n_elements; ++e) {
                double square = 0.0;
                for (int c = 0; c < 3; ++c)
                    square += (x[c] - d->position[3 * e + c]) * (x[c] - d->position[3 * e + c]);
                if (square < least) {
                    least = square;
                    nearest = e;
                }
            }
            for (int64_t h = d->row_start[nearest]; h < d->row_start[nearest + 1]; ++h) {
                double beyond = 0.0, area = 0.0;
                for (int c = 0; c < 3; ++c) {
                    beyond += (x[c] - d->face_centroid[3 * h + c]) * d->area_vector[3 * h + c];
                    area += d->area_vector[3 * h + c] * d->area_vector[3 * h + c];
                }
                assert_true(beyond / sqrt(area) <= 1e-12); /* rounding of positions of about 1 m */
            }
        }
        brc_domain_free(&d);
    }
}

/* Hand-checkable: ten cubes along each edge. */
static void cells_without_noise_are_exact_cubes(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &r);
    assert_int_equal(d->n_elements, 1000);
    assert_int_equal(d->n_bonds, 3 * 9 * 10 * 10);
    assert_int_equal(d->n_free_faces, 600);
    for (int64_t e = 0; e < 1000; ++e) {
        assert_near(d->volume[e], 1e-3, 1e-17);
        for (int k = 0; k < 3; ++k) {
            assert_near(d->centroid[3 * e + k], d->position[3 * e + k], 1e-15);
            assert_near(d->inertia[6 * e + k], 1e-3 * 2e-2 / 12.0, 1e-19);
            assert_near(d->inertia[6 * e + 3 + k], 0.0, 1e-19);
        }
        assert_int_equal(d->vertex_start[e + 1] - d->vertex_start[e], 8);
    }
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        const double *s = d->area_vector + 3 * h;
        assert_near(fabs(s[0]) + fabs(s[1]) + fabs(s[2]), 1e-2, 1e-16);
    }
    assert_int_equal(d->quality.n_tiny_faces_dropped, 0);
    assert_int_equal(d->quality.coordination_histogram[3], 8);
    assert_int_equal(d->quality.coordination_histogram[4], 12 * 8);
    assert_int_equal(d->quality.coordination_histogram[5], 6 * 64);
    assert_int_equal(d->quality.coordination_histogram[6], 512);
    brc_domain_free(&d);
}

static void faces_below_the_threshold_leave_both_sides_and_are_counted(void **state)
{
    brc_build_request r = test_box(1000, 1.0);
    brc_domain *whole = test_build(*state, &r);
    r.tiny_face_threshold = 9e-4;
    brc_domain *less = test_build(*state, &r);
    double mean = 0.0;
    for (int64_t h = 0; h < whole->n_half_edges; ++h) {
        const double *s = whole->area_vector + 3 * h;
        mean += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / (double)whole->n_half_edges;
    }
    int64_t small = 0;
    for (int64_t b = 0; b < whole->n_bonds; ++b) {
        const double *s = whole->area_vector + 3 * (int64_t)whole->bond_half_edge[b];
        small += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) < 9e-4 * mean;
    }
    for (int64_t f = 0; f < whole->n_free_faces; ++f) {
        const double *s = whole->free_area_vector + 3 * f;
        small += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) < 9e-4 * mean;
    }
    assert_true(small > 10);
    assert_int_equal(less->quality.n_tiny_faces_dropped, small);
    assert_int_equal(whole->n_bonds + whole->n_free_faces - less->n_bonds - less->n_free_faces, small);
    assert_int_equal(brc_domain_check(*state, less), BRC_OK);
    assert_true(less->quality.closure_worst > 1e-8 && less->quality.closure_worst < 1e-3);
    assert_true(less->quality.tiny_face_area_fraction > 0.0 && less->quality.tiny_face_area_fraction < 9e-4);
    brc_domain_free(&whole);
    brc_domain_free(&less);
}

static void polygons_of_free_faces_enclose_their_area(void **state)
{
    for (int k = 0; k < N_CASES; ++k) {
        const brc_build_request r = request_of(k);
        brc_domain *d = test_build(*state, &r);
        for (int64_t f = 0; f < d->n_free_faces; ++f) {
            const int64_t start = d->free_polygon_start[f], n = d->free_polygon_start[f + 1] - start;
            assert_true(n >= 3);
            double sum[3] = {0.0, 0.0, 0.0};
            const double *o = d->vertex + 3 * (int64_t)d->free_polygon[start];
            for (int64_t p = 1; p + 1 < n; ++p) { /* counter-clockwise from outside: the sum is the outward vector */
                const double *a = d->vertex + 3 * (int64_t)d->free_polygon[start + p];
                const double *b = d->vertex + 3 * (int64_t)d->free_polygon[start + p + 1];
                for (int c = 0; c < 3; ++c) {
                    const int i = (c + 1) % 3, j = (c + 2) % 3;
                    sum[c] += 0.5 * ((a[i] - o[i]) * (b[j] - o[j]) - (a[j] - o[j]) * (b[i] - o[i]));
                }
            }
            for (int c = 0; c < 3; ++c)
                assert_near(sum[c], d->free_area_vector[3 * f + c], 1e-15);
        }
        brc_domain_free(&d);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_cell_is_closed_and_exact_for_linear_fields, test_begin, test_end),
        cmocka_unit_test_setup_teardown(twins_are_exactly_opposite_and_point_at_each_other, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_bond_appears_once_from_its_smaller_element, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_face_is_normal_to_its_branch_and_halves_it, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_point_lies_in_the_cell_of_its_nearest_seed, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cells_without_noise_are_exact_cubes, test_begin, test_end),
        cmocka_unit_test_setup_teardown(faces_below_the_threshold_leave_both_sides_and_are_counted, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(polygons_of_free_faces_enclose_their_area, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
