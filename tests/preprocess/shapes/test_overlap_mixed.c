/* Bodies of cells beside bodies of spheres. */
#include "../spheres.h"
#include "../support.h"

#include "../../../preprocess/domain/overlap.h"
#include "../../../preprocess/domain/pose.h"

#include <stdio.h>
#include <string.h>

/* A cube of 10 x 10 x 10 cells of 1 m, from 0 to 10 m in each direction, and one sphere of about 0.45 m at a place of
 * its own. */
typedef struct pair {
    brc_domain *cells, *spheres;
} pair;

static pair begin(void **state)
{
    static const int two[3] = {2, 1, 1};
    brc_build_request r = test_box(1000, 0.0);
    for (int c = 0; c < 3; ++c)
        r.shape.size[c] = 10.0;
    brc_context_clear(*state);
    pair p = {test_build(*state, &r), test_spheres(*state, two, 1.0, 1, 1)};
    p.spheres->radius[1] = 1e-9; /* a speck in the middle of the other: bonds need two */
    memcpy(p.spheres->position + 3, p.spheres->position, 3 * sizeof *p.spheres->position);
    return p;
}

static void end(pair *p)
{
    brc_domain_free(&p->cells);
    brc_domain_free(&p->spheres);
}

static brc_status place(void **state, const pair *p, double x, double y, double z)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    static const char *const name[2] = {"plate", "ball"};
    const double by[3] = {x - p->spheres->position[0], y - p->spheres->position[1], z - p->spheres->position[2]};
    const brc_domain *const both[2] = {p->cells, p->spheres}, *const turned[2] = {p->spheres, p->cells};
    static const char *const names_turned[2] = {"ball", "plate"};
    brc_pose_apply(none, none, by, p->spheres);
    brc_context_clear(*state);
    const brc_status other_way = brc_overlap_check(*state, 2, turned, names_turned);
    brc_context_clear(*state);
    const brc_status status = brc_overlap_check(*state, 2, both, name);
    assert_int_equal(status, other_way);
    return status;
}

/* The middle is a radius from the face, less or more by what may overlap (0.9 of it) and a little. */
static void a_sphere_may_touch_a_face_and_not_reach_through_it(void **state)
{
    pair p = begin(state);
    const double r = p.spheres->radius[0];
    assert_int_equal(place(state, &p, 10.0 + r, 5.3, 5.2), BRC_OK);
    assert_int_equal(place(state, &p, 10.0 + 0.91 * r, 5.3, 5.2), BRC_OK);
    assert_int_equal(place(state, &p, 10.0 + 0.89 * r, 5.3, 5.2), BRC_BAD_INPUT);
    test_says(
        *state,
        "bodies 'plate' and 'ball' overlap: 0 elements of body 'plate' and 1 of body 'ball' stand in the other one");
    assert_int_equal(place(state, &p, 4.9, 5.3, 5.2), BRC_BAD_INPUT); /* well inside, and the speck too */
    test_says(*state, "2 of body 'ball'");
    assert_int_equal(place(state, &p, 10.0 - 0.2 * r, 5.3, 5.2), BRC_BAD_INPUT);
    end(&p);
}

/* Outside a corner the distance from the corner counts, not that from the planes of the faces. */
static void beside_edges_and_corners_the_true_distance_counts(void **state)
{
    pair p = begin(state);
    const double r = p.spheres->radius[0], away = 0.91 * r / sqrt(3.0), near = 0.89 * r / sqrt(3.0),
                 edge = 0.91 * r / sqrt(2.0);
    assert_int_equal(place(state, &p, 10.0 + away, 10.0 + away, 10.0 + away), BRC_OK);
    assert_int_equal(place(state, &p, 10.0 + near, 10.0 + near, 10.0 + near), BRC_BAD_INPUT);
    assert_int_equal(place(state, &p, -edge, -edge, 3.0), BRC_OK);
    assert_int_equal(place(state, &p, -edge + 0.02 * r, -edge + 0.02 * r, 3.0), BRC_BAD_INPUT);
    end(&p);
}

/* Against the distance from the cube in closed form, at places all around it. */
static void random_places_are_told_apart_as_by_the_distance_from_the_cube(void **state)
{
    pair p = begin(state);
    const double r = p.spheres->radius[0];
    uint64_t draw = 12345;
    int inside = 0, outside = 0;
    for (int k = 0; k < 200; ++k) {
        double x[3], square = 0.0;
        for (int c = 0; c < 3; ++c) {
            draw = draw * 6364136223846793005ULL + 1442695040888963407ULL;
            x[c] = -1.0 + 12.0 * (double)(draw >> 11) / 9007199254740992.0;
            const double beyond = fmax(fmax(-x[c], x[c] - 10.0), 0.0);
            square += beyond * beyond;
        }
        const double gap = sqrt(square) - 0.9 * r;
        if (fabs(gap) < 1e-6) continue; /* rounding decides */
        assert_int_equal(place(state, &p, x[0], x[1], x[2]), gap < 0.0 ? BRC_BAD_INPUT : BRC_OK);
        inside += gap < 0.0;
        outside += gap > 0.0;
    }
    assert_true(inside > 20 && outside > 20);
    end(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_sphere_may_touch_a_face_and_not_reach_through_it, test_begin, test_end),
        cmocka_unit_test_setup_teardown(beside_edges_and_corners_the_true_distance_counts, test_begin, test_end),
        cmocka_unit_test_setup_teardown(random_places_are_told_apart_as_by_the_distance_from_the_cube, test_begin,
                                        test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
