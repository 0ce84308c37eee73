#include "../spheres.h"
#include "../support.h"

#include "../../../preprocess/domain/overlap.h"
#include "../../../preprocess/domain/pose.h"

#include <stdio.h>
#include <string.h>

static const double none[3] = {0.0, 0.0, 0.0};

static void move(brc_domain *d, double x, double y, double z)
{
    const double by[3] = {x, y, z};
    brc_pose_apply(none, none, by, d);
}

static brc_status check(brc_context *context, const brc_domain *a, const brc_domain *b)
{
    const brc_domain *bodies[2] = {a, b};
    brc_context_clear(context);
    return brc_overlap_check(context, 2, bodies, NULL);
}

/* Two cubes of ten cells a side without noise: positions at 0.05, 0.15, ... */
static void overlapping_cubes_are_counted_and_touching_ones_are_not(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *a = test_build(*state, &r), *b = test_build(*state, &r);
    move(b, 1.0, 0.0, 0.0); /* a common face */
    assert_int_equal(check(*state, a, b), BRC_OK);
    move(b, -1e-9, 0.0, 0.0); /* rounding */
    assert_int_equal(check(*state, a, b), BRC_OK);
    move(b, 0.0, 1.0, 0.0); /* a common edge */
    assert_int_equal(check(*state, a, b), BRC_OK);
    move(b, -0.26, -0.97, -0.02);
    /* b begins at x = 0.74: layers of a at 0.75, 0.85, 0.95 are in it (30 rows of 10 in y of which all from 0.03 on,
     * and in z all to 0.98) */
    assert_int_equal(check(*state, a, b), BRC_BAD_INPUT);
    test_says(*state, "bodies 0 and 1 overlap: 300 elements of body 0 and 300 of body 1 stand in the other one, the "
                      "first at (0.75, 0.05, 0.05) m; "
                      "move them apart with `pose`");
    assert_int_equal(check(*state, b, a), BRC_BAD_INPUT);
    test_says(*state, "300 elements of body 0 and 300 of body 1");
    brc_domain_free(&a);
    brc_domain_free(&b);
}

/* Cells of a regular grid have their positions half a cell from the wall; what reaches in less is told by corners, from
 * a tenth of a cell on. */
static void less_than_a_cell_of_overlap_is_found(void **state)
{
    const char *const name[2] = {"anvil", "ball"};
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *a = test_build(*state, &r), *b = test_build(*state, &r);
    const brc_domain *bodies[2] = {a, b};
    move(b, 0.97, 0.05,
         0.05); /* corners of b in the middle of faces of cells of a, 0.3 cells deep: 10 x 10 less those beside a */
    assert_int_equal(brc_overlap_check(*state, 2, bodies, name), BRC_BAD_INPUT);
    test_says(*state, "bodies 'anvil' and 'ball' overlap by less than a cell: corners of 100 cells of body 'anvil' and "
                      "of 100 of body 'ball'");
    move(b, 0.021, 0.0, 0.0); /* 0.09 cells: what round walls that touch may do */
    assert_int_equal(check(*state, a, b), BRC_OK);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

/* A small ball well inside one large cell of the other: only one side sees it. Beside the box: none. */
static void a_small_body_inside_a_large_cell_is_found(void **state)
{
    brc_build_request r = test_box(27, 0.0);
    brc_domain *box = test_build(*state, &r);
    r = test_sphere(200, 0.5);
    r.shape.radius = 0.01;
    brc_domain *ball = test_build(*state, &r);
    move(ball, 0.6, 0.6, 0.6); /* the middle cell reaches from 1/3 to 2/3 and has its position at 1/2 */
    assert_int_equal(check(*state, box, ball), BRC_BAD_INPUT);
    char words[128];
    snprintf(words, sizeof words, "0 elements of body 0 and %d of body 1", (int)ball->n_elements);
    test_says(*state, words);
    move(ball, 0.5, 0.0, 0.0);
    assert_int_equal(check(*state, box, ball), BRC_OK);
    brc_domain_free(&box);
    brc_domain_free(&ball);
}

/* Bounding boxes overlap, bodies do not: a cube turned by 45 degrees beside another's corner. */
static void bodies_with_overlapping_bounds_may_stand_apart(void **state)
{
    const double turn[3] = {0.0, 0.0, 0.78539816339744831}, by[3] = {1.3, 0.75, 0.0};
    const brc_build_request r = test_box(1000, 0.9);
    brc_domain *a = test_build(*state, &r), *b = test_build(*state, &r);
    brc_pose_apply(none, turn, by, b); /* x + y >= 2.05 everywhere in b, 2 at most in a */
    assert_true(b->bounds[0][0] < 0.6 && b->bounds[0][1] < 0.76);
    assert_int_equal(check(*state, a, b), BRC_OK);
    move(b, -0.3, -0.3, 0.0);
    assert_int_equal(check(*state, a, b), BRC_BAD_INPUT);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

/* The count, against every pair. */
static void overlapping_spheres_are_counted_like_all_pairs(void **state)
{
    const int count[3] = {5, 5, 5};
    brc_domain *a = test_spheres(*state, count, 8.0, 0, 1), *b = test_spheres(*state, count, 8.0, 1, 1);
    move(b, 4.6, 0.1, -0.2);
    int seen[2] = {0, 0};
    for (int side = 0; side < 2; ++side) {
        const brc_domain *d = side ? b : a, *o = side ? a : b;
        for (int64_t e = 0; e < d->n_elements; ++e) {
            bool hit = false;
            for (int64_t f = 0; f < o->n_elements; ++f) {
                double square = 0.0;
                for (int c = 0; c < 3; ++c)
                    square += pow(d->position[3 * e + c] - o->position[3 * f + c], 2.0);
                hit = hit || sqrt(square) < 0.9 * (d->radius[e] + o->radius[f]);
            }
            seen[side] += hit;
        }
    }
    assert_true(seen[0] > 0 && seen[1] > 0);
    assert_int_equal(check(*state, a, b), BRC_BAD_INPUT);
    char words[128];
    snprintf(words, sizeof words, "%d elements of body 0 and %d of body 1", seen[0], seen[1]);
    test_says(*state, words);
    move(b, 0.4, -0.1, 0.2); /* shifted by its own length: packed boxes side by side */
    assert_int_equal(check(*state, a, b), BRC_OK);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

/* Centres lie outside the other's bounds, yet the spheres overlap by 0.15 of the sum of their radii. */
static void two_spheres_overlap_though_neither_centre_is_in_the_other(void **state)
{
    const int count[3] = {2, 2, 2};
    brc_domain *a = test_spheres(*state, count, 3.0, 0, 1), *b = test_spheres(*state, count, 3.0, 1, 1);
    double reach = 0.0;
    for (int64_t e = 0; e < 8; ++e)
        reach = fmax(reach, a->radius[e]);
    move(b, 2.0 - 0.25 * reach, 0.0, 0.0);
    assert_int_equal(check(*state, a, b), BRC_BAD_INPUT);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

static void every_overlapping_pair_is_named(void **state)
{
    const brc_build_request r = test_box(64, 0.9);
    brc_domain *d[3];
    for (int k = 0; k < 3; ++k) {
        d[k] = test_build(*state, &r);
        move(d[k], 0.6 * k, 0.0, 0.0);
    }
    assert_int_equal(brc_overlap_check(*state, 3, (const brc_domain *const *)d, NULL), BRC_BAD_INPUT);
    test_says(*state, "bodies 0 and 1 overlap");
    test_says(*state, "bodies 1 and 2 overlap");
    assert_null(strstr(brc_context_message(*state), "bodies 0 and 2"));
    for (int k = 0; k < 3; ++k)
        brc_domain_free(&d[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(overlapping_cubes_are_counted_and_touching_ones_are_not, test_begin, test_end),
        cmocka_unit_test_setup_teardown(less_than_a_cell_of_overlap_is_found, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_small_body_inside_a_large_cell_is_found, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bodies_with_overlapping_bounds_may_stand_apart, test_begin, test_end),
        cmocka_unit_test_setup_teardown(overlapping_spheres_are_counted_like_all_pairs, test_begin, test_end),
        cmocka_unit_test_setup_teardown(two_spheres_overlap_though_neither_centre_is_in_the_other, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(every_overlapping_pair_is_named, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
