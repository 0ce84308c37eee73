#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/cells/tessellation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 4096 };

/* A face of a cell by the three smallest of its points, which no other face has. */
typedef struct key {
    int32_t point[3];
    int32_t element;
} key;

static int compare_keys(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(int32_t[3]));
}
static int compare_points(const void *a, const void *b)
{
    return *(const int32_t *)a < *(const int32_t *)b ? -1 : *(const int32_t *)a > *(const int32_t *)b;
}

static brc_tessellation joined(brc_context *context, const brc_domain *d, const uint8_t *whole, int n_threads)
{
    brc_tessellation t;
    assert_int_equal(brc_tessellation_create(context, d, n_threads, &t), BRC_OK);
    assert_int_equal(brc_tessellation_join(context, whole, n_threads, &t), BRC_OK);
    return t;
}

/* Place of each point: that of its first corner, whose point it is. The caller frees. */
static double *places(const brc_tessellation *t)
{
    double *x = malloc(3 * sizeof(double) * (size_t)t->n_points);
    for (int64_t p = 0; p < t->n_points; ++p) {
        assert_int_equal(t->point[t->first[p]], p);
        memcpy(x + 3 * p, t->domain->vertex + 3 * (int64_t)t->first[p], 3 * sizeof(double));
    }
    return x;
}

/* Edges of the faces, each in both directions once; and six times the volume, by the divergence theorem. */
static double closed_volume(const brc_tessellation *t, const double *x, int64_t e)
{
    int32_t count[MOST], point[MOST], edge[MOST][2];
    const double *o = t->domain->position + 3 * e;
    const int64_t n_faces = brc_tessellation_faces(t, e, count, point);
    assert_int_equal(n_faces, t->face_start[e + 1] - t->face_start[e]);
    int64_t n_edges = 0;
    double volume = 0;
    for (int64_t f = 0, first = 0; f < n_faces; first += count[f++])
        for (int32_t k = 0; k < count[f]; ++k) {
            edge[n_edges][0] = point[first + k];
            edge[n_edges++][1] = point[first + (k + 1) % count[f]];
            if (k == 0 || k + 1 == count[f]) continue;
            const double *a = x + 3 * (int64_t)point[first], *b = x + 3 * (int64_t)point[first + k],
                         *c = x + 3 * (int64_t)point[first + k + 1];
            for (int m = 0; m < 3; ++m) {
                const int i = (m + 1) % 3, j = (m + 2) % 3;
                volume += (a[m] - o[m]) * ((b[i] - o[i]) * (c[j] - o[j]) - (b[j] - o[j]) * (c[i] - o[i]));
            }
        }
    assert_int_equal(n_edges, t->loop_start[e + 1] - t->loop_start[e]);
    for (int64_t k = 0; k < n_edges; ++k) {
        int back = 0, same = 0;
        for (int64_t m = 0; m < n_edges; ++m) {
            back += edge[m][0] == edge[k][1] && edge[m][1] == edge[k][0];
            same += edge[m][0] == edge[k][0] && edge[m][1] == edge[k][1];
        }
        if (back != same)
            fail_msg("element %lld: an edge is gone along %d times and back %d times", (long long)e, same, back);
    }
    int32_t own[MOST];
    const int64_t n_points = brc_tessellation_points(t, e, own);
    assert_int_equal(n_points, t->point_start[e + 1] - t->point_start[e]);
    assert_int_equal(n_points - n_edges / 2 + n_faces, 2); /* Euler */
    return volume / 6;
}

/* Faces that two cells have in common; no face is of more. */
static int64_t shared_faces(const brc_tessellation *t)
{
    int32_t count[MOST], point[MOST];
    int64_t n = 0, shared = 0;
    key *all = malloc(sizeof(key) * (size_t)t->face_start[t->domain->n_elements]);
    for (int64_t e = 0; e < t->domain->n_elements; ++e) {
        const int64_t n_faces = brc_tessellation_faces(t, e, count, point);
        for (int64_t f = 0, first = 0; f < n_faces; first += count[f++]) {
            qsort(point + first, (size_t)count[f], sizeof *point, compare_points);
            all[n].element = (int32_t)e;
            memcpy(all[n++].point, point + first, sizeof all->point);
        }
    }
    qsort(all, (size_t)n, sizeof *all, compare_keys);
    for (int64_t k = 1; k < n; ++k) {
        if (compare_keys(all + k, all + k - 1) != 0) continue;
        if (k > 1) assert_int_not_equal(compare_keys(all + k, all + k - 2), 0);
        assert_int_not_equal(all[k].element, all[k - 1].element);
        ++shared;
    }
    free(all);
    return shared;
}

/* Closed, turned outward, of the volume of the cells, and sharing what the bonds join. limit: faces of bonds that may
 * be without a partner. */
static void assert_sound(brc_context *context, const brc_domain *d, double tolerance, int64_t limit)
{
    brc_tessellation t = joined(context, d, NULL, 0);
    double *x = places(&t), worst = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        worst = fmax(worst, fabs(closed_volume(&t, x, e) / d->volume[e] - 1));
    const int64_t shared = shared_faces(&t);
    printf("%lld cells, %lld corners, %lld points, %lld bonds, %lld shared faces, volumes to %.2g\n",
           (long long)d->n_elements, (long long)d->vertex_start[d->n_elements], (long long)t.n_points,
           (long long)d->n_bonds, (long long)shared, worst);
    assert_true(worst < tolerance);
    assert_true(shared >= d->n_bonds - limit);
    free(x);
    brc_tessellation_free(&t);
}

static void random_cells_are_closed_and_share_the_faces_of_their_bonds(void **state)
{
    brc_build_request request[] = {test_box(4000, 0.9), test_cylinder(3000, 0.9), test_sphere(2000, 0.7)};
    for (int k = 0; k < 3; ++k) {
        brc_domain *d = test_build(*state, &request[k]);
        assert_sound(*state, d, 1e-8, 0);
        brc_domain_free(&d);
    }
}

static void regular_cells_meet_eight_in_a_corner(void **state)
{
    brc_build_request request = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &request);
    assert_sound(*state, d, 1e-8, 0);
    brc_domain_free(&d);
}

/* Far more faces than usual are too small to be kept, and come back as faces of one cell each. */
static void dropped_faces_are_found_again_from_their_edges(void **state)
{
    brc_build_request request = test_box(2000, 0.9);
    request.tiny_face_threshold = 9e-4;
    brc_domain *d = test_build(*state, &request);
    assert_true(d->quality.n_tiny_faces_dropped > 20);
    assert_sound(*state, d, 1e-5, 0); /* neighbours of those dropped together are one face, which is not flat; 9e-4 of a
                                         face is dropped at most */
    brc_domain_free(&d);
}

/* Bonds across the middle of a box are broken, all but those beyond a line in it: the points come apart up to the
 * tip. */
static void points_come_apart_along_a_crack_and_stay_one_at_its_tip(void **state)
{
    brc_build_request request = test_box(2000, 0.9);
    brc_domain *d = test_build(*state, &request);
    uint8_t *whole = malloc((size_t)d->n_half_edges);
    double middle[3];
    int64_t n_broken = 0;
    for (int k = 0; k < 3; ++k)
        middle[k] = 0.5 * (d->bounds[0][k] + d->bounds[1][k]);
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        const double *a = d->position + 3 * (int64_t)d->neighbour[h],
                     *b = d->position + 3 * (int64_t)d->neighbour[d->twin[h]];
        whole[h] = (a[0] < middle[0]) == (b[0] < middle[0]) || d->face_centroid[3 * h + 1] > middle[1];
        n_broken += !whole[h] && a[0] < middle[0];
    }
    assert_true(n_broken > 20);
    brc_tessellation before = joined(*state, d, NULL, 0), after = joined(*state, d, whole, 0);
    assert_true(after.n_points > before.n_points && after.n_points < before.n_points + 6 * n_broken);
    const int64_t parted = shared_faces(&before) - shared_faces(&after);
    assert_true(parted <= n_broken && parted > n_broken - 5); /* a face at the tip may have all of its corners there */
    int64_t tip = 0;
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        if (whole[h]) continue;
        const int64_t e = d->neighbour[d->twin[h]], j = d->neighbour[h];
        int32_t mine[MOST], other[MOST];
        const int64_t n = brc_tessellation_points(&after, e, mine), m = brc_tessellation_points(&after, j, other);
        for (int64_t k = 0; k < n; ++k)
            for (int64_t l = 0; l < m; ++l)
                tip += mine[k] == other[l];
    }
    assert_true(tip > 0);
    brc_tessellation_free(&before);
    brc_tessellation_free(&after);
    free(whole);
    brc_domain_free(&d);
}

static void threads_do_not_change_a_point(void **state)
{
    brc_build_request request = test_sphere(800, 0.7);
    brc_domain *d = test_build(*state, &request);
    brc_tessellation one = joined(*state, d, NULL, 1), many = joined(*state, d, NULL, 5);
    const int64_t n = d->n_elements;
    assert_int_equal(one.n_points, many.n_points);
    assert_memory_equal(one.point, many.point, 4 * (size_t)d->vertex_start[n]);
    assert_memory_equal(one.loop_start, many.loop_start, 8 * (size_t)(n + 1));
    assert_memory_equal(one.corner, many.corner, 4 * (size_t)one.corner_start[one.outline_start[n]]);
    brc_tessellation_free(&one);
    brc_tessellation_free(&many);
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(random_cells_are_closed_and_share_the_faces_of_their_bonds, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(regular_cells_meet_eight_in_a_corner, test_begin, test_end),
        cmocka_unit_test_setup_teardown(dropped_faces_are_found_again_from_their_edges, test_begin, test_end),
        cmocka_unit_test_setup_teardown(points_come_apart_along_a_crack_and_stay_one_at_its_tip, test_begin, test_end),
        cmocka_unit_test_setup_teardown(threads_do_not_change_a_point, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
