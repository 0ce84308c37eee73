#include "../support.h"

#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/domain/cracks.h"

#include <string.h>

/* Seeds of a noisy grid in the cube of 1 m, the spacing 1 / n, with room for their images. */
typedef struct seeds {
    double *position;
    int64_t n, room;
    double spacing;
} seeds;

static seeds noisy(int64_t n, double spread, uint64_t seed)
{
    seeds s = {.n = n * n * n, .room = 2 * n * n * n, .spacing = 1.0 / (double)n};
    assert_int_equal(BRC_ALLOCATE(NULL, &s.position, 3 * s.room, "seeds"), BRC_OK);
    for (int64_t e = 0; e < s.n; ++e) {
        const int64_t index[3] = {e % n, e / n % n, e / (n * n)};
        double u[4];
        brc_random_uniform4(seed, BRC_RANDOM_TEST, (uint64_t)e, 0, u);
        for (int k = 0; k < 3; ++k)
            s.position[3 * e + k] = ((double)index[k] + 0.5 + spread * (u[k] - 0.5)) * s.spacing;
    }
    return s;
}

/* Mirror, then drop the images outside the cube, as the builder does. */
static void mirror_inside(brc_context *context, const brc_crack *crack, seeds *s)
{
    if (brc_cracks_mirror_seeds(context, 1, crack, s->spacing, s->position, &s->n, s->room) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    int64_t kept = 0;
    for (int64_t e = 0; e < s->n; ++e) {
        bool inside = true;
        for (int k = 0; k < 3; ++k)
            inside = inside && s->position[3 * e + k] > 1e-6 && s->position[3 * e + k] < 1.0 - 1e-6;
        if (inside) memmove(s->position + 3 * kept++, s->position + 3 * e, 3 * sizeof(double));
    }
    s->n = kept;
}

static double nearest_square(const seeds *s, const double x[3], int64_t other_than)
{
    double least = HUGE_VAL;
    for (int64_t e = 0; e < s->n; ++e) {
        if (e == other_than) continue;
        double square = 0.0;
        for (int k = 0; k < 3; ++k)
            square += pow(s->position[3 * e + k] - x[k], 2.0);
        least = fmin(least, square);
    }
    return least;
}

static double smallest_distance(const seeds *s)
{
    double least = HUGE_VAL;
    for (int64_t e = 0; e < s->n; ++e)
        least = fmin(least, nearest_square(s, s->position + 3 * e, e));
    return sqrt(least);
}

static brc_crack penny(double height, double radius)
{
    return (brc_crack){.name = "penny",
                       .kind = BRC_CRACK_DISC,
                       .point = {0.5, 0.5, height},
                       .normal = {0.0, 0.0, 1.0},
                       .radius = radius,
                       .flat = true};
}

/* The plane z = height over the whole cube and beyond it, turned a little about x when asked. */
static brc_crack through(double height, double slope)
{
    return (brc_crack){.name = "through",
                       .kind = BRC_CRACK_RECTANGLE,
                       .point = {-1.0, -1.0, height - 1.5 * slope},
                       .edge = {{3.0, 0.0, 0.0}, {0.0, 3.0, 3.0 * slope}},
                       .flat = true};
}

/* Where nothing is promised: a seam of one spacing along the rim, and two spacings from walls that the plane meets at a
 * slant, for there images fall outside. */
static bool in_seam(const brc_crack *crack, double spacing, const double x[3])
{
    if (crack->kind == BRC_CRACK_DISC)
        return hypot(x[0] - crack->point[0], x[1] - crack->point[1]) > crack->radius - spacing;
    return crack->edge[1][2] != 0.0 && (x[1] < 2.0 * spacing || x[1] > 1.0 - 2.0 * spacing);
}

/* Points of the crack at random: the nearest seeds above and below must be equally near, or a face would leave the
 * plane there. Images are exact to a rounding of 1e-16 m, squared distances of 1e-2 m^2 to some 1e-17. */
static void over_the_crack_the_nearest_seeds_are_mirror_pairs(void **state)
{
    const brc_crack cracks[] = {penny(0.5, 0.35),   penny(0.47, 0.35),  through(0.5, 0.0), through(0.52, 0.0),
                                through(0.5, 0.37), through(0.15, 0.0), through(0.84, 0.0)};
    for (size_t c = 0; c < sizeof cracks / sizeof *cracks; ++c)
        for (uint64_t seed = 0; seed < 3; ++seed) {
            seeds s = noisy(10, seed == 2 ? 0.0 : 0.9, seed);
            mirror_inside(*state, &cracks[c], &s);
            const bool disc = cracks[c].kind == BRC_CRACK_DISC;
            const double slope = disc ? 0.0 : cracks[c].edge[1][2] / cracks[c].edge[1][1];
            for (uint64_t p = 0; p < 300; ++p) {
                double u[4];
                brc_random_uniform4(77, BRC_RANDOM_TEST, p, c, u);
                const double x[3] = {u[0], u[1],
                                     cracks[c].point[2] + (disc ? 0.0 : slope * (u[1] - cracks[c].point[1]))};
                if (in_seam(&cracks[c], s.spacing, x)) continue;
                double side[2] = {HUGE_VAL, HUGE_VAL};
                for (int64_t e = 0; e < s.n; ++e) {
                    const double *y = s.position + 3 * e;
                    double square = 0.0;
                    for (int k = 0; k < 3; ++k)
                        square += (x[k] - y[k]) * (x[k] - y[k]);
                    const int above = y[2] - x[2] - slope * (y[1] - x[1]) > 0.0;
                    side[above] = fmin(side[above], square);
                }
                assert_near(side[0], side[1], 1e-15);
            }
            brc_memory_free(s.position);
        }
}

/* Points of the sides of a rectangle, away from its corners: the nearest seeds inside and beyond must be equally near,
 * or a face would reach across. */
static void faces_end_at_the_sides_of_a_rectangle(void **state)
{
    const brc_crack notch = {.name = "notch",
                             .kind = BRC_CRACK_RECTANGLE,
                             .point = {-0.1, -0.1, 0.47},
                             .edge = {{0.64, 0.0, 0.0}, {0.0, 1.2, 0.0}},
                             .flat = true};
    brc_crack window = notch;
    window.point[0] = 0.2, window.point[1] = 0.25, window.edge[0][0] = 0.6, window.edge[1][1] = 0.5;
    for (int inside = 0; inside < 2; ++inside)
        for (uint64_t seed = 0; seed < 5; ++seed) {
            seeds s = noisy(10, seed == 2 ? 0.0 : 0.9, seed);
            const brc_crack *crack = inside ? &window : &notch;
            mirror_inside(*state, crack, &s);
            const double at = crack->point[0] + crack->edge[0][0];
            const double from = inside ? crack->point[1] + 1.5 * s.spacing : 0.0;
            const double to = inside ? crack->point[1] + crack->edge[1][1] - 1.5 * s.spacing : 1.0;
            for (int p = 0; p <= 100; ++p) {
                const double x[3] = {at, from + 0.01 * p * (to - from), 0.47};
                double side[2] = {HUGE_VAL, HUGE_VAL};
                for (int64_t e = 0; e < s.n; ++e) {
                    const double *y = s.position + 3 * e;
                    const double square =
                        (x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]);
                    side[y[0] > at] = fmin(side[y[0] > at], square);
                }
                assert_near(side[0], side[1], 1e-15);
            }
            brc_memory_free(s.position);
        }
}

/* A noisy grid of spread 0.5 keeps half a spacing between its seeds, and so must what mirroring makes of it, but for
 * pushed seeds: a quarter. */
static void mirroring_keeps_seeds_apart(void **state)
{
    const brc_crack cracks[] = {penny(0.5, 0.3),   penny(0.47, 0.3),   penny(0.45, 0.2),
                                through(0.5, 0.0), through(0.55, 0.0), through(0.5, 0.61)};
    for (size_t c = 0; c < sizeof cracks / sizeof *cracks; ++c)
        for (int k = 0; k < 2; ++k) {
            seeds s = noisy(10, k ? 0.5 : 0.0, 1);
            mirror_inside(*state, &cracks[c], &s);
            assert_true(smallest_distance(&s) >= 0.25 * s.spacing * (1.0 - 1e-12));
            assert_true(s.n > 800 && s.n < 1200);
            brc_memory_free(s.position);
        }
}

/* The plane through a layer of a regular grid: its seeds are pushed to one side and come back as images on the
 * other. */
static void a_plane_through_seeds_pushes_them_aside(void **state)
{
    seeds s = noisy(9, 0.0, 0);
    const brc_crack crack = through(0.5, 0.0);
    mirror_inside(*state, &crack, &s);
    assert_near(smallest_distance(&s), 0.5 * s.spacing, 1e-15);
    int64_t near = 0;
    for (int64_t e = 0; e < s.n; ++e)
        near += fabs(fabs(s.position[3 * e + 2] - 0.5) - 0.25 * s.spacing) < 1e-15;
    assert_int_equal(near, 2 * 81);
    assert_int_equal(s.n, 9 * 81 + 81);
    brc_memory_free(s.position);
}

/* Seeds away from the crack are not touched, in order and in place; images come last. */
static void other_seeds_keep_place_and_order(void **state)
{
    seeds s = noisy(12, 0.9, 4), before = noisy(12, 0.9, 4);
    const brc_crack crack = penny(0.5, 0.15);
    assert_int_equal(brc_cracks_mirror_seeds(*state, 1, &crack, s.spacing, s.position, &s.n, s.room), BRC_OK);
    int64_t at = 0, far = 0;
    for (int64_t e = 0; e < before.n; ++e) {
        const double *x = before.position + 3 * e;
        if (fabs(x[2] - 0.5) <= 3.0 * s.spacing && hypot(x[0] - 0.5, x[1] - 0.5) <= 0.15 + 0.5 * s.spacing) continue;
        while (at < s.n && memcmp(s.position + 3 * at, x, 3 * sizeof(double)) != 0)
            ++at;
        assert_true(at < s.n);
        ++far;
    }
    assert_true(far > 1400);
    brc_crack rough = crack;
    rough.flat = false;
    memcpy(s.position, before.position, 3 * (size_t)before.n * sizeof(double));
    s.n = before.n;
    assert_int_equal(brc_cracks_mirror_seeds(*state, 1, &rough, s.spacing, s.position, &s.n, s.room), BRC_OK);
    assert_int_equal(s.n, before.n);
    assert_memory_equal(s.position, before.position, 3 * (size_t)before.n * sizeof(double));
    assert_int_equal(brc_cracks_mirror_seeds(*state, 1, &crack, s.spacing, s.position, &s.n, 1000), BRC_BAD_INPUT);
    test_says(*state, "there is room for 1000: cracks are too near to each other or to walls for cells of 0.0833 m");
    brc_memory_free(s.position);
    brc_memory_free(before.position);
}

/* Twelve cells a side: planes 0.4 apart are 4.8 spacings from each other, 0.6 are 7.2. */
static void flat_cracks_nearer_than_six_spacings_are_warned_of(void **state)
{
    for (int far = 0; far < 2; ++far) {
        seeds s = noisy(12, 0.9, 4);
        char text[1024];
        brc_crack cracks[2] = {penny(far ? 0.2 : 0.3, 0.3), penny(far ? 0.8 : 0.7, 0.3)};
        strcpy(cracks[0].name, "low");
        strcpy(cracks[1].name, "high");
        test_caught caught = test_catch_stderr();
        brc_log_set_level(*state, BRC_LOG_WARNING);
        const brc_status status = brc_cracks_mirror_seeds(*state, 2, cracks, s.spacing, s.position, &s.n, s.room);
        test_release_stderr(&caught, text, sizeof text);
        assert_int_equal(status, BRC_OK);
        if (far)
            assert_string_equal(text, "");
        else if (!strstr(text, "cracks 'low' and 'high' come nearer to each other than six cells"))
            fail_msg("%s", text);
        brc_memory_free(s.position);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(over_the_crack_the_nearest_seeds_are_mirror_pairs, test_begin, test_end),
        cmocka_unit_test_setup_teardown(faces_end_at_the_sides_of_a_rectangle, test_begin, test_end),
        cmocka_unit_test_setup_teardown(mirroring_keeps_seeds_apart, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_plane_through_seeds_pushes_them_aside, test_begin, test_end),
        cmocka_unit_test_setup_teardown(flat_cracks_nearer_than_six_spacings_are_warned_of, test_begin, test_end),
        cmocka_unit_test_setup_teardown(other_seeds_keep_place_and_order, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
