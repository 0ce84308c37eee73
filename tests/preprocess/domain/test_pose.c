#include "../spheres.h"
#include "../support.h"

#include "../../../preprocess/domain/pose.h"

#include <string.h>

/* A quarter turn about z through the origin of the shape, then a shift: (x, y, z) -> (-y, x, z) + t. */
static void a_posed_body_is_the_turned_and_shifted_one(void **state)
{
    brc_build_request r = test_box(500, 0.9);
    r.shape.size[0] = 2.0;
    brc_domain *a = test_build(*state, &r);
    r.rotation[2] = 1.57079632679489662;
    r.translation[0] = 1.0;
    r.translation[1] = -2.0;
    r.translation[2] = 0.5;
    brc_domain *b = test_build(*state, &r);
    assert_int_equal(brc_domain_check(*state, b), BRC_OK);
    assert_int_equal(a->n_bonds, b->n_bonds);
    for (int64_t e = 0; e < a->n_elements; ++e) {
        const double *x = a->position + 3 * e, *y = b->position + 3 * e;
        assert_near(y[0], -x[1] + 1.0, 1e-15);
        assert_near(y[1], x[0] - 2.0, 1e-15);
        assert_near(y[2], x[2] + 0.5, 1e-15);
        const double *i = a->inertia + 6 * e, *j = b->inertia + 6 * e;
        const double expected[6] = {i[1], i[0], i[2], i[4], -i[3], -i[5]};
        for (int k = 0; k < 6; ++k)
            assert_near(j[k], expected[k], 1e-18);
    }
    for (int64_t h = 0; h < a->n_half_edges; ++h) {
        assert_near(b->area_vector[3 * h], -a->area_vector[3 * h + 1], 1e-16);
        assert_near(b->area_vector[3 * h + 1], a->area_vector[3 * h], 1e-16);
    }
    const double low[3] = {0.0, -2.0, 0.5}, high[3] = {1.0, 0.0, 1.5};
    for (int k = 0; k < 3; ++k) {
        assert_near(b->bounds[0][k], low[k], 1e-14);
        assert_near(b->bounds[1][k], high[k], 1e-14);
    }
    brc_domain_free(&a);
    brc_domain_free(&b);
}

/* About the shape's own origin, not the world's; volumes, closure and first moments survive any turn. */
static void any_turn_keeps_the_identities_of_the_cells(void **state)
{
    brc_build_request r = test_cylinder(600, 0.9);
    r.shape.origin[0] = 3.0;
    r.rotation[0] = 0.3;
    r.rotation[1] = -1.1;
    r.rotation[2] = 2.0;
    brc_domain *d = test_build(*state, &r);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    assert_near(test_worst_closure(d), 0.0, 1e-12);
    assert_near(test_worst_first_moment(d), 0.0, 1e-12);
    assert_near(d->quality.volume_error, 0.0, 1e-12);
    /* the end x- stays centred at the origin of the shape */
    double mean[3] = {0.0, 0.0, 0.0}, area = 0.0;
    const brc_set *end = &d->sets[brc_domain_find_set(d, "x-")];
    for (int64_t k = 0; k < end->n_members; ++k) {
        const int64_t f = end->members[k];
        const double *s = d->free_area_vector + 3 * f;
        const double one = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        area += one;
        for (int c = 0; c < 3; ++c)
            mean[c] += one * d->free_centroid[3 * f + c];
    }
    assert_near(mean[0] / area, 3.0, 1e-13);
    assert_near(mean[1] / area, 0.0, 1e-13);
    assert_near(mean[2] / area, 0.0, 1e-13);
    brc_domain_free(&d);
}

static void sets_are_picked_in_posed_coordinates(void **state)
{
    brc_set_request set = {.name = "far", .kind = BRC_SET_FACES};
    set.where =
        (brc_predicate){.has_half_space = true, .half_space_point = {10.999, 0, 0}, .half_space_normal = {1, 0, 0}};
    brc_build_request r = test_box(1000, 0.9);
    r.translation[0] = 10.0;
    r.sets = &set;
    r.n_sets = 1;
    brc_domain *d = test_build(*state, &r);
    const brc_set *far = &d->sets[brc_domain_find_set(d, "far")], *wall = &d->sets[brc_domain_find_set(d, "x+")];
    assert_int_equal(far->n_members, wall->n_members);
    brc_domain_free(&d);
}

static void poses_that_are_not_finite_are_refused(void **state)
{
    brc_build_request r = test_box(1000, 0.9);
    r.translation[1] = NAN;
    test_refused(*state, &r, BRC_BAD_INPUT, "pose: translation and rotation must be finite");
}

/* A quarter turn about z: (x, y, z) -> (-y, x, z) + t; radii, volumes and inertia stay to the last bit. */
static void spheres_are_turned_and_shifted(void **state)
{
    const int count[3] = {4, 3, 2};
    const double origin[3] = {0.0, 0.0, 0.0}, turn[3] = {0.0, 0.0, 1.57079632679489662}, by[3] = {1.0, -2.0, 0.5};
    brc_domain *a = test_spheres(*state, count, 7.0, 0, 1), *b = test_spheres(*state, count, 7.0, 0, 1);
    brc_pose_apply(origin, turn, by, b);
    assert_int_equal(brc_domain_check(*state, b), BRC_OK);
    for (int64_t e = 0; e < a->n_elements; ++e) {
        assert_near(b->position[3 * e], -a->position[3 * e + 1] + 1.0, 1e-15);
        assert_near(b->position[3 * e + 1], a->position[3 * e] - 2.0, 1e-15);
        assert_near(b->position[3 * e + 2], a->position[3 * e + 2] + 0.5, 1e-15);
    }
    assert_memory_equal(a->inertia, b->inertia, 6 * (size_t)a->n_elements * sizeof(double));
    assert_memory_equal(a->radius, b->radius, (size_t)a->n_elements * sizeof(double));
    const double low[3] = {-2.0, -2.0, 0.5}, high[3] = {1.0, 2.0, 2.5};
    for (int c = 0; c < 3; ++c) {
        assert_near(b->bounds[0][c], low[c], 1e-14);
        assert_near(b->bounds[1][c], high[c], 1e-14);
    }
    brc_domain_free(&a);
    brc_domain_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_posed_body_is_the_turned_and_shifted_one, test_begin, test_end),
        cmocka_unit_test_setup_teardown(any_turn_keeps_the_identities_of_the_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_are_turned_and_shifted, test_begin, test_end),
        cmocka_unit_test_setup_teardown(sets_are_picked_in_posed_coordinates, test_begin, test_end),
        cmocka_unit_test_setup_teardown(poses_that_are_not_finite_are_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
