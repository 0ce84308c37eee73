/* Neighbouring cells of a random domain, where their contact happens: exactly touching, pushed together by a little,
 * deformed; in double and single. */
#include "../support.h"

#include "../overlap_pairs.h"

#include <stdlib.h>
#include <string.h>

static brc_domain *domain;
static brc_convex convex;
static int64_t n_pairs;
static overlap_pair *pair;
static overlap_found *found, *other;

/* Every bond a pair; B is moved towards A by `depth` of the branch, maps are unity and up to `strain` of noise. */
static void make_pairs(double depth, double strain)
{
    uint32_t noise = 1;
    for (int64_t b = 0; b < n_pairs; ++b) {
        const int64_t h = domain->bond_half_edge[b], j = domain->neighbour[h], i = domain->neighbour[domain->twin[h]];
        pair[b] = (overlap_pair){.of = {(int32_t)i, (int32_t)j}};
        for (int k = 0; k < 3; ++k)
            pair[b].origin[1][k] = (1 - depth) * (domain->position[3 * j + k] - domain->position[3 * i + k]);
        for (int side = 0; side < 2; ++side)
            for (int k = 0; k < 9; ++k) {
                noise = noise * 1664525u + 1013904223u;
                pair[b].map[side][k] = (k % 4 == 0) + strain * (noise / 2147483648.0 - 1);
            }
    }
}

static int begin(void **state)
{
    if (test_begin(state)) return 1;
    brc_build_request request = test_box(3000, 0.9);
    domain = test_build(*state, &request);
    if (brc_convex_of_domain(*state, domain, 1, &convex) != BRC_OK) return 1;
    n_pairs = domain->n_bonds;
    pair = malloc((size_t)n_pairs * sizeof *pair);
    found = malloc((size_t)n_pairs * sizeof *found);
    other = malloc((size_t)n_pairs * sizeof *other);
    return !pair || !found || !other;
}

static int end(void **state)
{
    free(pair);
    free(found);
    free(other);
    brc_convex_free(&convex);
    brc_domain_free(&domain);
    return test_end(state);
}

/* Area of the face and length of the branch of bond b. */
static double face_of(int64_t b, double *length)
{
    const double *s = domain->area_vector + 3 * (int64_t)domain->bond_half_edge[b], *x = pair[b].origin[1];
    *length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    return sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
}

static void cells_that_shared_a_face_touch_without_overlap(void **state)
{
    (void)state;
    make_pairs(0, 0);
    for (int single = 0; single < 2; ++single) {
        (single ? overlap_pairs_single : overlap_pairs_double)(&convex, n_pairs, pair, 1, found);
        for (int64_t b = 0; b < n_pairs; ++b) {
            double length;
            const double area = face_of(b, &length), size = convex.radius[pair[b].of[0]] + convex.radius[pair[b].of[1]];
            assert_int_equal(found[b].failed, 0);
            /* a gap of some roundings of the size; positions are at up to 1 and cells of 0.07 */
            assert_true(found[b].volume >= 0 && found[b].volume < (single ? 1e-5 : 1e-13) * size * area +
                                                                      (single ? 1e-12 : 1e-20) * size * size * size);
        }
    }
}

/* Pushed in by a thousandth of the branch: face area times depth, but for the strips along its edges, of the order of
 * depth times perimeter; the area vector is the face's likewise. */
static void pushed_together_they_share_face_times_depth(void **state)
{
    (void)state;
    make_pairs(1e-3, 0);
    overlap_pairs_double(&convex, n_pairs, pair, 1, found);
    int64_t large = 0;
    for (int64_t b = 0; b < n_pairs; ++b) {
        double length, dot = 0, square = 0;
        const double area = face_of(b, &length), depth = length * 1e-3 / (1 - 1e-3),
                     *s = domain->area_vector + 3 * (int64_t)domain->bond_half_edge[b];
        if (area < 0.1 * length * length) continue; /* strips would be as large as the face */
        ++large;
        assert_true(fabs(found[b].volume - area * depth) < 0.05 * area * depth);
        for (int k = 0; k < 3; ++k) {
            dot -= found[b].area[k] * s[k] / area;
            square += found[b].area[k] * found[b].area[k];
        }
        assert_true(dot > 0.9 * area && dot < 1.1 * area && square < 1.21 * area * area);
    }
    assert_true(large > n_pairs / 4);
}

static void single_precision_is_as_good_as_its_places(void **state)
{
    (void)state;
    make_pairs(0.02, 0.02);
    const double seconds = overlap_pairs_double(&convex, n_pairs, pair, 1, found),
                 seconds_single = overlap_pairs_single(&convex, n_pairs, pair, 1, other);
    double worst_volume = 0, worst_area = 0, worst_moment = 0;
    int64_t touching = 0;
    for (int64_t b = 0; b < n_pairs; ++b) {
        const double size = convex.radius[pair[b].of[0]] + convex.radius[pair[b].of[1]];
        assert_int_equal(other[b].failed, 0);
        touching += found[b].volume > 0;
        worst_volume = fmax(worst_volume, fabs(found[b].volume - other[b].volume) / (size * size * size));
        for (int k = 0; k < 3; ++k)
            worst_area = fmax(worst_area, fabs(found[b].area[k] - other[b].area[k]) / (size * size));
        for (int k = 0; k < 9; ++k)
            for (int side = 0; side < 2; ++side)
                worst_moment = fmax(worst_moment,
                                    fabs(found[b].moment[side][k] - other[b].moment[side][k]) / (size * size * size));
    }
    printf("%lld pairs, %lld share volume; one thread: double %.3f us a pair, single %.3f us; single off by %.1e of "
           "the size cubed (volume), %.1e (moments), "
           "%.1e of it squared (area)\n",
           (long long)n_pairs, (long long)touching, 1e6 * seconds / (double)n_pairs,
           1e6 * seconds_single / (double)n_pairs, worst_volume, worst_moment, worst_area);
    /* heights to some 6e-8 of the size, over areas up to the size squared; an area changes by more only where a face is
     * nearly in the plane of another: by rounding over the angle, with maps that are 0.02 off */
    assert_true(worst_volume < 2e-6 && worst_area < 2e-4 && worst_moment < 2e-4);
}

static void assert_other_is_found(void)
{
    for (int64_t b = 0; b < n_pairs; ++b) {
        assert_true(found[b].volume == other[b].volume && found[b].failed == other[b].failed);
        assert_memory_equal(found[b].area, other[b].area, sizeof found[b].area);
        assert_memory_equal(found[b].moment, other[b].moment, sizeof found[b].moment);
        assert_memory_equal(found[b].point, other[b].point, sizeof found[b].point);
    }
}

static void threads_do_not_change_a_bit(void **state)
{
    (void)state;
    make_pairs(0.1, 0.05);
    memset(found, 0, (size_t)n_pairs * sizeof *found);
    memset(other, 0, (size_t)n_pairs * sizeof *other);
    overlap_pairs_double(&convex, n_pairs, pair, 1, found);
    overlap_pairs_double(&convex, n_pairs, pair, 3, other);
    assert_other_is_found();
}

/* Planes that are asked in blocks are those that are asked one by one, in the same order: deep and shallow overlaps,
 * faces in one plane. */
static void lanes_do_not_change_a_bit(void **state)
{
    (void)state;
    const struct {
        double depth, strain;
    } some[] = {{0.1, 0.05}, {0.01, 0.1}, {1e-3, 0}, {0, 0}};
    for (size_t k = 0; k < sizeof some / sizeof *some; ++k) {
        make_pairs(some[k].depth, some[k].strain);
        memset(found, 0, (size_t)n_pairs * sizeof *found);
        memset(other, 0, (size_t)n_pairs * sizeof *other);
        overlap_pairs_double(&convex, n_pairs, pair, 1, found);
        overlap_pairs_one_lane(&convex, n_pairs, pair, 1, other);
        assert_other_is_found();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cells_that_shared_a_face_touch_without_overlap, begin, end),
        cmocka_unit_test_setup_teardown(pushed_together_they_share_face_times_depth, begin, end),
        cmocka_unit_test_setup_teardown(single_precision_is_as_good_as_its_places, begin, end),
        cmocka_unit_test_setup_teardown(threads_do_not_change_a_bit, begin, end),
        cmocka_unit_test_setup_teardown(lanes_do_not_change_a_bit, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
