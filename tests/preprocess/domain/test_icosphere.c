#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/domain/icosphere.h"

#include <stdlib.h>
#include <string.h>

static brc_icosphere make(void *context, int level)
{
    brc_icosphere sphere;
    assert_int_equal(brc_icosphere_make(context, level, &sphere), BRC_OK);
    return sphere;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void vertices_are_unit_vectors_and_come_with_their_opposites(void **state)
{
    for (int level = 0; level <= BRC_ICOSPHERE_LEVEL_MOST; ++level) {
        brc_icosphere s = make(*state, level);
        assert_int_equal(s.n_vertices, 10 * (int)pow(4, level) + 2);
        assert_int_equal(s.n_triangles, 20 * (int)pow(4, level));
        for (int32_t v = 0; v < s.n_vertices; ++v) {
            const double *a = s.vertex + 3 * v, *b = s.vertex + 3 * s.opposite[v];
            assert_near(dot(a, a), 1, 1e-15);
            for (int c = 0; c < 3; ++c)
                assert_true(a[c] == -b[c]);
            assert_int_equal(s.opposite[s.opposite[v]], v);
        }
        brc_icosphere_free(&s);
    }
}

static int compare(const void *a, const void *b)
{
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return p < q ? -1 : p > q;
}

/* Every directed edge occurs once and so does its reverse: closed and oriented; with V - E + F = 2 it is one sphere. */
static void triangles_close_the_sphere(void **state)
{
    brc_icosphere s = make(*state, 3);
    const int32_t n = 3 * s.n_triangles;
    int64_t *edge, *reverse;
    assert_int_equal(BRC_ALLOCATE(*state, &edge, n, "test"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(*state, &reverse, n, "test"), BRC_OK);
    for (int32_t t = 0; t < s.n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const int64_t a = s.triangle[3 * t + k], b = s.triangle[3 * t + (k + 1) % 3];
            edge[3 * t + k] = a << 32 | b;
            reverse[3 * t + k] = b << 32 | a;
        }
    qsort(edge, (size_t)n, sizeof *edge, compare);
    qsort(reverse, (size_t)n, sizeof *reverse, compare);
    for (int32_t k = 0; k < n; ++k) {
        assert_true(edge[k] == reverse[k]);
        assert_true(k == 0 || edge[k] != edge[k - 1]);
    }
    assert_int_equal(s.n_vertices - n / 2 + s.n_triangles, 2);
    brc_memory_free(edge);
    brc_memory_free(reverse);
    brc_icosphere_free(&s);
}

/* The search relies on it: the pole of an acute triangle lies inside. */
static void every_triangle_is_acute(void **state)
{
    brc_icosphere s = make(*state, BRC_ICOSPHERE_LEVEL_MOST);
    for (int32_t t = 0; t < s.n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const double *a = s.vertex + 3 * s.triangle[3 * t + k], *b = s.vertex + 3 * s.triangle[3 * t + (k + 1) % 3],
                         *c = s.vertex + 3 * s.triangle[3 * t + (k + 2) % 3];
            const double ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                         ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
            assert_true(dot(ab, ac) > 0);
        }
    brc_icosphere_free(&s);
}

/* Rounding of up to 40962 sums of terms below 1: far below 1e-13 of 4 pi. */
static void solid_angles_sum_to_four_pi(void **state)
{
    for (int level = 0; level <= BRC_ICOSPHERE_LEVEL_MOST; ++level) {
        brc_icosphere s = make(*state, level);
        double sum = 0;
        for (int32_t v = 0; v < s.n_vertices; ++v)
            sum += s.solid_angle[v];
        assert_near(sum, 4 * M_PI, 1e-13 * 4 * M_PI);
        brc_icosphere_free(&s);
    }
}

/* Girard: the area of a spherical polygon is the sum of its angles less (corners - 2) pi. Here the polygon of
 * directions nearest to a vertex, from the poles of the planes through it and two neighbours; angles keep 1e-15 each,
 * up to 1e-13 where a side is short (level 3: sides of 0.08). */
static void solid_angles_are_those_of_the_polygons_of_nearest_directions(void **state)
{
    brc_icosphere s = make(*state, 3);
    for (int32_t v = 0; v < s.n_vertices; ++v) {
        int32_t triangles[6], n = 0, ring[6];
        for (int32_t t = 0; t < s.n_triangles; ++t)
            for (int k = 0; k < 3; ++k)
                if (s.triangle[3 * t + k] == v) triangles[n++] = t;
        assert_int_equal(n, v < 12 ? 5 : 6);
        int32_t next = -1; /* walk round v: the triangle (v, p, q) is followed by the one (v, q, r) */
        double pole[6][3];
        for (int m = 0; m < n; ++m)
            for (int k = 0; k < n; ++k) {
                const int32_t *t = s.triangle + 3 * triangles[k];
                const int at = t[0] == v ? 0 : t[1] == v ? 1 : 2;
                if (m == 0 ? k != 0 : t[(at + 1) % 3] != next) continue;
                ring[m] = t[(at + 1) % 3];
                const int32_t after = t[(at + 2) % 3];
                const double *a = s.vertex + 3 * v, *b = s.vertex + 3 * ring[m], *c = s.vertex + 3 * after;
                const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                             q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
                for (int x = 0; x < 3; ++x)
                    pole[m][x] = p[(x + 1) % 3] * q[(x + 2) % 3] - p[(x + 2) % 3] * q[(x + 1) % 3];
                next = after;
                break;
            }
        double angles = 0;
        for (int m = 0; m < n;
             ++m) { /* between the sides to the poles before and after: their planes hold the centre */
            const double *o = pole[m];
            double side[2][3];
            for (int e = 0; e < 2; ++e) {
                const double *p = pole[(m + (e ? 1 : n - 1)) % n];
                const double along = dot(p, o) / dot(o, o);
                for (int x = 0; x < 3; ++x)
                    side[e][x] = p[x] - along * o[x];
            }
            angles += acos(dot(side[0], side[1]) / sqrt(dot(side[0], side[0]) * dot(side[1], side[1])));
        }
        assert_near(s.solid_angle[v], angles - (n - 2) * M_PI, 1e-12);
    }
    brc_icosphere_free(&s);
}

static int32_t nearest_of_all(const brc_icosphere *s, const double *direction)
{
    int32_t best = 0;
    for (int32_t v = 1; v < s->n_vertices; ++v)
        if (dot(s->vertex + 3 * v, direction) > dot(s->vertex + 3 * best, direction)) best = v;
    return best;
}

static void the_nearest_vertex_is_that_of_a_search_through_all(void **state)
{
    for (int level = 0; level <= 4; ++level) {
        brc_icosphere s = make(*state, level);
        for (uint64_t k = 0; k < 4000; ++k) {
            double r[4];
            brc_random_uniform4(1, BRC_RANDOM_TEST, k, (uint64_t)level, r);
            const double d[3] = {1e3 * (r[0] - 0.5), 1e3 * (r[1] - 0.5), 1e3 * (r[2] - 0.5)};
            assert_int_equal(brc_icosphere_nearest(&s, d), nearest_of_all(&s, d));
        }
        brc_icosphere_free(&s);
    }
}

/* At level 0 the axes lie half-way between two vertices, and the poles of triangles between three. */
static void among_equally_near_vertices_the_first_is_taken(void **state)
{
    for (int level = 0; level <= 2; ++level) {
        brc_icosphere s = make(*state, level);
        for (int k = 1; k < 27; ++k) {
            const double d[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            if (dot(d, d) > 0) assert_int_equal(brc_icosphere_nearest(&s, d), nearest_of_all(&s, d));
        }
        brc_icosphere_free(&s);
    }
    brc_icosphere s = make(*state, 0);
    const double x[3] = {1, 0, 0}, *first = s.vertex + 3 * brc_icosphere_nearest(&s, x);
    int32_t equal = 0;
    for (int32_t v = 0; v < s.n_vertices; ++v)
        equal += s.vertex[3 * v] == first[0];
    assert_int_equal(equal, 2); /* there is a tie indeed */
    brc_icosphere_free(&s);
}

static void levels_that_are_not_there_are_refused(void **state)
{
    brc_icosphere s;
    assert_int_equal(brc_icosphere_make(*state, 7, &s), BRC_BAD_INPUT);
    test_says(*state, "level 7");
    assert_int_equal(brc_icosphere_make(*state, -1, &s), BRC_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(vertices_are_unit_vectors_and_come_with_their_opposites, test_begin, test_end),
        cmocka_unit_test_setup_teardown(triangles_close_the_sphere, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_triangle_is_acute, test_begin, test_end),
        cmocka_unit_test_setup_teardown(solid_angles_sum_to_four_pi, test_begin, test_end),
        cmocka_unit_test_setup_teardown(solid_angles_are_those_of_the_polygons_of_nearest_directions, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(the_nearest_vertex_is_that_of_a_search_through_all, test_begin, test_end),
        cmocka_unit_test_setup_teardown(among_equally_near_vertices_the_first_is_taken, test_begin, test_end),
        cmocka_unit_test_setup_teardown(levels_that_are_not_there_are_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
