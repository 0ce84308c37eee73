#include "../spheres.h"
#include "../support.h"

#include <string.h>

static void a_built_domain_passes_its_check(void **state)
{
    const brc_build_request r = test_sphere(500, 1.0);
    brc_domain *d = test_build(*state, &r);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    assert_int_equal(brc_domain_find_set(d, "surface"), 0);
    assert_int_equal(brc_domain_find_set(d, "no such set"), -1);
    brc_domain_free(&d);
    assert_null(d);
    brc_domain_free(&d); /* of nothing is allowed */
}

/* Break one number of a sound domain after the other; the check must name each, and pass again once it is mended. */
static void every_broken_property_is_named(void **state)
{
    brc_context *context = *state;
    const brc_build_request r = test_box(300, 0.9);
    brc_domain *d = test_build(context, &r);
#define BREAK(place, value, says)                                                                                      \
    do {                                                                                                               \
        char kept[sizeof(place)];                                                                                      \
        memcpy(kept, &(place), sizeof kept);                                                                           \
        (place) = (value);                                                                                             \
        brc_context_clear(context);                                                                                    \
        assert_int_equal(brc_domain_check(context, d), BRC_BAD_INPUT);                                                 \
        test_says(context, (says));                                                                                    \
        memcpy(&(place), kept, sizeof kept);                                                                           \
    } while (0)
    BREAK(d->n_elements, 0, "0 elements");
    BREAK(d->n_bonds, d->n_bonds + 1, "must be twice as many");
    BREAK(d->row_start[5], d->row_start[7], "rows of half-edges");
    BREAK(d->free_start[d->n_elements], 3, "rows of free faces");
    BREAK(d->vertex_start[0], 1, "rows of cell corners");
    BREAK(d->free_polygon_start[2], 1 << 30, "rows of free polygons");
    BREAK(d->neighbour[3], -1, "a neighbour is out of range");
    BREAK(d->twin[3], (int32_t)d->n_half_edges, "a twin is out of range");
    BREAK(d->twin[3], d->twin[4], "do not point at each other");
    BREAK(d->bond[3], d->bond[3] + 1, "different bonds");
    BREAK(d->bond_half_edge[3], d->bond_half_edge[4], "is not in order");
    BREAK(d->area_vector[9], d->area_vector[9] * (1.0 + 1e-15), "not opposite");
    BREAK(d->area_vector[9], NAN, "is not finite");
    BREAK(d->face_centroid[9], 0.5, "has two centroids");
    BREAK(d->volume[2], -1.0, "element 2 has the volume -1");
    BREAK(d->position[2], INFINITY, "a position is not finite");
    BREAK(d->free_element[0], 299, "free face 0 belongs to element 299");
    BREAK(d->free_wall[0], 6, "the wall of a free face is out of range");
    BREAK(d->free_polygon[0], 1 << 20, "corner that is not its element's");
    BREAK(d->free_area_vector[0], d->free_area_vector[0] + 1e-3, "surface open");
    BREAK(d->region[1], -1, "a region is negative");
    BREAK(d->sets[0].members[0], -2, "set 'x-' has a member out of range");
    BREAK(d->sets[0].members[1], d->sets[0].members[0], "not ascending");
    assert_int_equal(brc_domain_check(context, d), BRC_OK);
    brc_domain_free(&d);
}

/* Spoil one number of a sphere domain, expect the sentence, mend it. */
#define SPOIL(field, wrong, sentence)                                                                                  \
    do {                                                                                                               \
        const double right = (field);                                                                                  \
        (field) = (wrong);                                                                                             \
        brc_context_clear(context);                                                                                    \
        assert_int_equal(brc_domain_check(context, d), BRC_BAD_INPUT);                                                 \
        test_says(context, sentence);                                                                                  \
        (field) = right;                                                                                               \
    } while (0)

static void every_broken_property_of_spheres_is_named(void **state)
{
    brc_context *context = *state;
    const int count[3] = {4, 3, 3};
    brc_domain *d = test_spheres(context, count, 7.0, 0, 1);
    SPOIL(d->radius[5], -d->radius[5], "sphere 5 has the radius -0.4");
    SPOIL(d->radius[5], 2.0 * d->radius[5], "the volume of sphere 5 is not that of its radius");
    SPOIL(d->inertia[6 * 7 + 4], 1e-6, "the inertia of sphere 7 is not that of its radius");
    SPOIL(d->centroid[3 * 9], 0.0, "the centroid of sphere 9 is not its position");
    SPOIL(d->position[3 * 9], NAN, "a position is not finite");
    SPOIL(d->volume[2], 0.0, "element 2 has the volume 0");
    double *radius = d->radius;
    d->radius = NULL;
    brc_context_clear(context);
    assert_int_equal(brc_domain_check(context, d), BRC_BAD_INPUT);
    test_says(context, "spheres without radii");
    d->radius = radius;
    d->element_kind = (brc_element_kind)7;
    assert_int_equal(brc_domain_check(context, d), BRC_BAD_INPUT);
    test_says(context, "elements of the unknown kind 7");
    d->element_kind = BRC_ELEMENT_SPHERE;
    assert_int_equal(brc_domain_check(context, d), BRC_OK);
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_built_domain_passes_its_check, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_broken_property_is_named, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_broken_property_of_spheres_is_named, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
