#include "../spheres.h"
#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/packing/beams.h"

#include <stdlib.h>
#include <string.h>

typedef struct pair {
    double ratio;
    int32_t i, j;
} pair;

static int compare(const void *left, const void *right)
{
    const pair *a = left, *b = right;
    if (a->ratio != b->ratio) return a->ratio < b->ratio ? -1 : 1;
    if (a->i != b->i) return a->i < b->i ? -1 : 1;
    return a->j < b->j ? -1 : a->j > b->j;
}

/* n random spheres in a box of these sizes, radii between 1 and `widest`. */
static void draw(brc_context *context, int64_t n, const double size[3], double widest, double **x, double **r)
{
    assert_int_equal(BRC_ALLOCATE(context, x, 3 * n, "positions"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(context, r, n, "radii"), BRC_OK);
    for (int64_t e = 0; e < n; ++e) {
        double u[4];
        brc_random_uniform4(3, BRC_RANDOM_TEST, (uint64_t)e, 0, u);
        for (int c = 0; c < 3; ++c)
            (*x)[3 * e + c] = size[c] * u[c];
        (*r)[e] = pow(widest, u[3]);
    }
}

static brc_domain *bond(brc_context *context, double *x, double *r, int64_t n, double coordination, int n_threads)
{
    brc_domain *d;
    assert_int_equal(BRC_ALLOCATE(context, &d, 1, "domain"), BRC_OK);
    if (brc_beams_bond(context, x, r, n, coordination, n_threads, d) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return d;
}

/* Against all pairs, sorted. */
static void compare_with_all_pairs(brc_context *context, const double size[3], double widest, double coordination)
{
    enum { N = 400 };
    static pair all[N * (N - 1) / 2];
    static bool wanted[N][N];
    double *x, *r;
    draw(context, N, size, widest, &x, &r);
    int64_t n = 0;
    for (int i = 0; i < N; ++i)
        for (int j = i + 1; j < N; ++j) {
            const double a = x[3 * i] - x[3 * j], b = x[3 * i + 1] - x[3 * j + 1], c = x[3 * i + 2] - x[3 * j + 2];
            all[n++] = (pair){sqrt(a * a + b * b + c * c) / (r[i] + r[j]), i, j};
        }
    qsort(all, (size_t)n, sizeof *all, compare);
    const int64_t bonds = (int64_t)(coordination * N / 2.0 + 0.5);
    memset(wanted, 0, sizeof wanted);
    for (int64_t b = 0; b < bonds; ++b)
        wanted[all[b].i][all[b].j] = true;
    brc_domain *d = bond(context, x, r, N, coordination, 2);
    assert_int_equal(d->n_bonds, bonds);
    assert_true(d->quality.growth == all[bonds - 1].ratio);
    for (int64_t e = 0; e < N; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            if (d->neighbour[h] > e) assert_true(wanted[e][d->neighbour[h]]);
    brc_domain_free(&d);
}

static void bonds_are_the_nearest_pairs(void **state)
{
    const double cube[3] = {20.0, 20.0, 20.0}, rod[3] = {400.0, 3.0, 3.0}, loose[3] = {1e5, 1e5, 1e5};
    compare_with_all_pairs(*state, cube, 1.0, 6.3);  /* equal radii */
    compare_with_all_pairs(*state, cube, 8.0, 10.0); /* small among large */
    compare_with_all_pairs(*state, rod, 2.0, 13.0);
    compare_with_all_pairs(*state, loose, 2.0, 8.0);  /* nothing near: the reach has to grow a thousandfold */
    compare_with_all_pairs(*state, cube, 2.0, 399.0); /* every pair there is */
    compare_with_all_pairs(*state, cube, 2.0, 0.005); /* one bond */
}

/* On a cubic grid of equal spheres all nearest pairs have one ratio: the first by index are taken. */
static void ties_go_to_the_smaller_indices(void **state)
{
    enum { SIDE = 6, N = SIDE * SIDE * SIDE, BONDS = 321 };
    double *x, *r;
    assert_int_equal(BRC_ALLOCATE(*state, &x, 3 * N, "positions"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(*state, &r, N, "radii"), BRC_OK);
    for (int e = 0; e < N; ++e) {
        x[3 * e] = e % SIDE;
        x[3 * e + 1] = e / SIDE % SIDE;
        x[3 * e + 2] = e / (SIDE * SIDE);
        r[e] = 0.5;
    }
    brc_domain *d = bond(*state, x, r, N, 2.0 * BONDS / N, 2);
    assert_int_equal(d->n_bonds, BONDS);
    assert_true(d->quality.growth == 1.0);
    int64_t b = 0;
    const int step[3] = {1, SIDE, SIDE * SIDE};
    for (int e = 0; e < N && b < BONDS; ++e)
        for (int c = 0; c < 3 && b < BONDS; ++c) {
            if (e / step[c] % SIDE == SIDE - 1) continue;
            const int32_t h = d->bond_half_edge[b++];
            assert_true(h >= d->row_start[e] && h < d->row_start[e + 1]);
            assert_int_equal(d->neighbour[h], e + step[c]);
        }
    brc_domain_free(&d);
}

static void the_mean_coordination_number_is_the_wanted_one(void **state)
{
    const int count[3] = {10, 11, 12};
    const double n = 10 * 11 * 12;
    double before = 0.0;
    for (double wanted = 5.5; wanted <= 13.0; wanted += 0.5) {
        brc_domain *d = test_spheres(*state, count, wanted, 0, 2);
        assert_near(d->quality.coordination_mean, wanted,
                    1.0 / n); /* a whole number of bonds: half of one off at most */
        assert_true(d->quality.growth >= before);
        before = d->quality.growth;
        brc_domain_free(&d);
    }
}

/* A sphere stands for its part of the body, by its own volume. */
static void spheres_have_the_volume_and_inertia_of_their_part_of_the_body(void **state)
{
    const int count[3] = {5, 4, 3};
    brc_domain *d = test_spheres(*state, count, 8.0, 2, 1);
    assert_int_equal(d->element_kind, BRC_ELEMENT_SPHERE);
    double sum = 0.0, all = 0.0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        sum += 4.0 / 3.0 * 3.14159265358979323846 * d->radius[e] * d->radius[e] * d->radius[e];
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double r = d->radius[e], v = 4.0 / 3.0 * 3.14159265358979323846 * r * r * r * 60.0 / sum;
        all += d->volume[e];
        assert_near(d->volume[e] / v, 1.0, 1e-15);
        for (int k = 0; k < 6; ++k)
            assert_near(d->inertia[6 * e + k], k < 3 ? 0.4 * v * r * r : 0.0, 1e-16);
        assert_memory_equal(d->centroid + 3 * e, d->position + 3 * e, 3 * sizeof(double));
    }
    assert_near(all, 60.0, 1e-12);
    assert_near(d->quality.volume_fraction, sum / 60.0, 1e-14);
    assert_near(d->quality.volume_cells, sum, 1e-12);
    for (int c = 0; c < 3; ++c) { /* the outermost spheres touch the walls */
        assert_near(d->bounds[0][c], 0.0, 1e-15);
        assert_near(d->bounds[1][c], count[c], 1e-14);
    }
    assert_null(d->area_vector);
    assert_null(d->free_start);
    assert_null(d->vertex);
    brc_domain_free(&d);
}

static void walls_know_the_spheres_that_touch_them_and_their_first_layer(void **state)
{
    const int count[3] = {6, 5, 4};
    brc_domain *d = test_spheres(*state, count, 8.0, 0, 2);
    const char *const wall[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    const int64_t members[6] = {20, 20, 24, 24, 30, 30};
    assert_int_equal(d->n_walls, 6);
    assert_int_equal(d->n_sets, 12);
    for (int w = 0; w < 6; ++w) {
        char layer[32] = "";
        strcat(strcat(layer, wall[w]), "_layer");
        assert_string_equal(d->sets[w].name, wall[w]);
        assert_string_equal(d->sets[6 + w].name, layer);
        for (int s = w; s < 12; s += 6) { /* second spheres begin at 1.4 m, layers end at 0.99 m */
            assert_int_equal(d->sets[s].kind, BRC_SET_ELEMENTS);
            assert_int_equal(d->sets[s].n_members, members[w]);
        }
        const int axis = w / 2;
        for (int64_t k = 0; k < d->sets[w].n_members; ++k) {
            const int32_t e = d->sets[w].members[k];
            const double x = d->position[3 * e + axis];
            assert_near(w % 2 ? count[axis] - x : x, d->radius[e], 1e-14);
        }
    }
    brc_domain_free(&d);
}

/* A sphere 1.5 radii from the wall belongs to its layer but does not touch it; one at 2.01 radii to neither. */
static void a_layer_reaches_two_radii_deep(void **state)
{
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {10.0, 10.0, 10.0}};
    const double depth[4] = {1.0, 1.5, 2.0, 2.01};
    brc_solid *solid;
    double *x, *r;
    brc_domain *d;
    assert_int_equal(BRC_ALLOCATE(*state, &d, 1, "domain"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(*state, &x, 12, "positions"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(*state, &r, 4, "radii"), BRC_OK);
    for (int e = 0; e < 4; ++e) {
        r[e] = 0.4;
        x[3 * e] = 0.4 * depth[e];
        x[3 * e + 1] = 2.0 + e;
        x[3 * e + 2] = 5.0;
    }
    assert_int_equal(brc_solid_create(*state, &box, 1, &solid), BRC_OK);
    assert_int_equal(brc_beams_build(*state, solid, x, r, 4, 1.5, false, 1, d), BRC_OK);
    const brc_set *touch = &d->sets[brc_domain_find_set(d, "x-")],
                  *layer = &d->sets[brc_domain_find_set(d, "x-_layer")];
    assert_int_equal(touch->n_members, 1);
    assert_int_equal(layer->n_members, 3);
    for (int32_t e = 0; e < 3; ++e)
        assert_int_equal(layer->members[e], e);
    brc_solid_free(&solid);
    brc_domain_free(&d);
}

static void one_and_two_threads_give_equal_bytes(void **state)
{
    const int count[3] = {14, 15, 16};
    brc_domain *a = test_spheres(*state, count, 9.0, 0, 1), *b = test_spheres(*state, count, 9.0, 0, 2);
    assert_int_equal(a->n_bonds, b->n_bonds);
    assert_memory_equal(a->row_start, b->row_start, (size_t)(a->n_elements + 1) * sizeof *a->row_start);
    assert_memory_equal(a->neighbour, b->neighbour, (size_t)a->n_half_edges * sizeof *a->neighbour);
    assert_memory_equal(a->twin, b->twin, (size_t)a->n_half_edges * sizeof *a->twin);
    assert_memory_equal(a->bond, b->bond, (size_t)a->n_half_edges * sizeof *a->bond);
    assert_memory_equal(&a->quality, &b->quality, sizeof a->quality);
    for (int s = 0; s < a->n_sets; ++s)
        assert_memory_equal(a->sets[s].members, b->sets[s].members, (size_t)a->sets[s].n_members * sizeof(int32_t));
    brc_domain_free(&a);
    brc_domain_free(&b);
}

/* The domain and all that is needed on the way, at the paper's largest coordination number. */
static void bonding_needs_less_than_400_bytes_a_sphere(void **state)
{
    enum { N = 50000 };
    const double size[3] = {37.0, 37.0, 37.0};
    double *x, *r;
    draw(*state, N, size, 1.3, &x, &r);
    const int64_t before = brc_memory_held();
    brc_domain *d = bond(*state, x, r, N, 13.0, 2);
    assert_true(brc_memory_peak() - before < 400 * (int64_t)N);
    brc_domain_free(&d);
}

static void refused(brc_context *context, double *x, double *r, int64_t n, double coordination, const char *part)
{
    brc_domain *d;
    brc_context_clear(context);
    assert_int_equal(BRC_ALLOCATE(context, &d, 1, "domain"), BRC_OK);
    assert_int_equal(brc_beams_bond(context, x, r, n, coordination, 1, d), BRC_BAD_INPUT);
    assert_null(d->position); /* points stay with the caller */
    test_says(context, part);
    brc_domain_free(&d);
}

static void wrong_spheres_and_unreachable_numbers_are_refused(void **state)
{
    double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, r[4] = {0.5, 0.5, 0.5, 0.5};
    refused(*state, x[0], r, 1, 1.0, "1 elements, must be 2");
    refused(*state, x[0], r, 4, 3.1, "3.1 cannot be reached with 4 elements, at most 3");
    refused(*state, x[0], r, 4, 0.0, "0 cannot be reached");
    refused(*state, x[0], r, 4, NAN, "cannot be reached");
    r[2] = 0.0;
    refused(*state, x[0], r, 4, 2.0, "sphere 2 at (0, 1, 0) m has the radius 0 m");
    r[2] = 0.5;
    x[3][1] = INFINITY;
    refused(*state, x[0], r, 4, 2.0, "sphere 3 at (0, inf, 1) m");
    memcpy(x[3], x[1], sizeof x[3]);
    refused(*state, x[0], r, 4, 2.0, "spheres 1 and 3 (counted from 0) are in one place, (1, 0, 0) m");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(bonds_are_the_nearest_pairs, test_begin, test_end),
        cmocka_unit_test_setup_teardown(ties_go_to_the_smaller_indices, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_mean_coordination_number_is_the_wanted_one, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_have_the_volume_and_inertia_of_their_part_of_the_body, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(walls_know_the_spheres_that_touch_them_and_their_first_layer, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(a_layer_reaches_two_radii_deep, test_begin, test_end),
        cmocka_unit_test_setup_teardown(one_and_two_threads_give_equal_bytes, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bonding_needs_less_than_400_bytes_a_sphere, test_begin, test_end),
        cmocka_unit_test_setup_teardown(wrong_spheres_and_unreachable_numbers_are_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
