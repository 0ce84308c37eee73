/* What part of a face a predicate takes. Tolerances: corners of the two sides of an edge agree to Voro++'s tolerance,
 * 1e-11 of a squared spacing and better; sums of some hundred faces of 1 m^2 in all are held to 1e-10. */
#include "../support.h"

#include "../../../preprocess/domain/set_share.h"
#include "../../../preprocess/domain/sets.h"

#include <string.h>

/* Area vector, and area times centroid, of all faces as far as they are inside. */
static void sums(const brc_domain *d, const brc_predicate *where, double area[3], double moment[3])
{
    for (int c = 0; c < 3; ++c)
        area[c] = moment[c] = 0;
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        double s[3], x[3];
        if (brc_predicate_share(where, d, f, s, x) == 0) continue;
        const double size = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        for (int c = 0; c < 3; ++c) {
            area[c] += s[c];
            moment[c] += size * x[c];
        }
    }
}

static void a_box_on_a_wall_takes_its_own_area_whatever_the_cells(void **state)
{
    for (int n = 100; n <= 1000; n *= 10) {
        brc_build_request r = test_box(n, 0.9);
        brc_domain *d = test_build(*state, &r);
        const brc_predicate where = {
            .has_wall = true, .wall = "z+", .has_box = true, .box = {{0.21, 0.13, 0.5}, {0.64, 0.77, 2}}};
        double area[3], moment[3];
        sums(d, &where, area, moment);
        const double exact = 0.43 * 0.64;
        assert_near(area[2], exact, 1e-10);
        assert_near(moment[0], exact * 0.425, 1e-10);
        assert_near(moment[1], exact * 0.45, 1e-10);
        assert_near(moment[2], exact, 1e-10);
        double members = 0; /* the set of whole faces is another area: the test would see a share that is not taken */
        for (int64_t f = 0; f < d->n_free_faces; ++f)
            if (brc_predicate_holds(&where, BRC_SET_FACES, d, f)) members += d->free_area_vector[3 * f + 2];
        assert_true(fabs(members - exact) > 1e-3);
        brc_domain_free(&d);
    }
}

static void two_sides_of_an_oblique_plane_add_up_to_the_whole(void **state)
{
    brc_build_request r = test_box(300, 0.9);
    brc_domain *d = test_build(*state, &r);
    brc_predicate where = {
        .has_half_space = true, .half_space_point = {0.4, 0.5, 0.45}, .half_space_normal = {1, -2, 0.5}};
    int64_t cut = 0;
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        double one[3], other[3], x[3], y[3];
        const double a = brc_predicate_share(&where, d, f, one, x);
        for (int c = 0; c < 3; ++c)
            where.half_space_normal[c] = -where.half_space_normal[c];
        const double b = brc_predicate_share(&where, d, f, other, y);
        for (int c = 0; c < 3; ++c)
            where.half_space_normal[c] = -where.half_space_normal[c];
        assert_near(a + b, 1, 1e-8); /* a sliver below 1e-9 of a face is left out */
        const double *s = d->free_area_vector + 3 * f, *middle = d->free_centroid + 3 * f;
        if (a == 1 || b == 1) { /* the domain's own numbers */
            assert_memory_equal(a == 1 ? one : other, s, 3 * sizeof *s);
            assert_memory_equal(a == 1 ? x : y, middle, 3 * sizeof *middle);
            continue;
        }
        ++cut;
        for (int c = 0; c < 3; ++c)
            assert_near(a * x[c] + b * y[c], middle[c], 1e-8);
    }
    assert_true(cut > 20);
    brc_domain_free(&d);
}

static void two_strips_of_a_round_side_press_equally(void **state)
{
    brc_build_request r = test_cylinder(500, 0.9); /* along x, radius 0.3 */
    brc_domain *d = test_build(*state, &r);
    for (int side = -1; side <= 1; side += 2) {
        const brc_predicate where = {.has_wall = true,
                                     .wall = "side",
                                     .has_box = true,
                                     .box = {{-1, -0.06, side < 0 ? -1 : 0}, {2, 0.06, side < 0 ? 0 : 1}}};
        double area[3], moment[3];
        sums(d, &where, area, moment);
        assert_near(area[2], side * 0.12, 1e-10); /* the shadow of the strip: 0.12 by 1 m */
        assert_near(area[0], 0, 1e-10);
    }
    brc_domain_free(&d);
}

static void what_planes_do_not_cut_is_taken_whole_or_not_at_all(void **state)
{
    brc_build_request r = test_box(300, 0.9);
    brc_domain *d = test_build(*state, &r);
    const brc_predicate ball = {.has_sphere = true, .sphere_centre = {0.5, 0.5, 1}, .sphere_radius = 0.3},
                        wall = {.has_wall = true, .wall = "x-"};
    const brc_predicate all = {.has_box = true, .box = {{0, 0, 0}, {1, 1, 1}}};
    const brc_predicate up = {.has_normal = true,
                              .normal = {0, 0, 1},
                              .normal_angle = 0.1,
                              .has_box = true,
                              .box = {{-1, -1, -1}, {2, 2, 2}}};
    assert_false(brc_predicate_cuts(&ball) || brc_predicate_cuts(&wall));
    assert_true(brc_predicate_cuts(&all));
    const brc_predicate *const each[] = {&ball, &wall, &all, &up};
    for (int k = 0; k < 4; ++k)
        for (int64_t f = 0; f < d->n_free_faces; ++f) {
            double s[3], x[3];
            const double share = brc_predicate_share(each[k], d, f, s, x);
            assert_true(share == (brc_predicate_holds(each[k], BRC_SET_FACES, d, f) ? 1 : 0));
        }
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_box_on_a_wall_takes_its_own_area_whatever_the_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(two_sides_of_an_oblique_plane_add_up_to_the_whole, test_begin, test_end),
        cmocka_unit_test_setup_teardown(two_strips_of_a_round_side_press_equally, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_planes_do_not_cut_is_taken_whole_or_not_at_all, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
