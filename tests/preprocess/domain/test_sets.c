#include "../spheres.h"
#include "../support.h"

#include "../../../preprocess/domain/sets.h"

#include <string.h>

static brc_set_request face_set(const char *name)
{
    brc_set_request set = {.kind = BRC_SET_FACES};
    strcpy(set.name, name);
    return set;
}

static const brc_set *set_of(const brc_domain *d, const char *name)
{
    const int32_t s = brc_domain_find_set(d, name);
    assert_true(s >= 0);
    return &d->sets[s];
}

/* Area of a set of free faces. */
static double area_of(const brc_domain *d, const char *name)
{
    const brc_set *set = set_of(d, name);
    double area = 0.0;
    for (int64_t k = 0; k < set->n_members; ++k) {
        const double *s = d->free_area_vector + 3 * (int64_t)set->members[k];
        area += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    }
    return area;
}

static void every_wall_has_a_set_that_covers_it(void **state)
{
    brc_build_request r = test_box(1000, 0.9);
    r.shape.size[1] = 2.0;
    brc_domain *d = test_build(*state, &r);
    const char *const name[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    const double area[6] = {2.0, 2.0, 1.0, 1.0, 2.0, 2.0};
    for (int w = 0; w < 6; ++w) {
        assert_string_equal(d->wall_name[w], name[w]);
        assert_int_equal(brc_domain_find_set(d, name[w]), w);
        assert_near(area_of(d, name[w]), area[w], 1e-12); /* sums of some hundred faces */
        const brc_set *set = set_of(d, name[w]);
        const double at = w % 2 ? r.shape.size[w / 2] : 0.0;
        for (int64_t k = 0; k < set->n_members; ++k)
            assert_true(d->free_centroid[3 * (int64_t)set->members[k] + w / 2] == at); /* exactly on the wall */
    }
    brc_domain_free(&d);
}

static void curved_walls_are_named_and_ends_follow_the_axis(void **state)
{
    brc_build_request r = test_cylinder(1000, 0.5);
    r.shape.axis = 2;
    brc_domain *d = test_build(*state, &r);
    assert_int_equal(d->n_walls, 3);
    const double pi = 3.14159265358979323846;
    assert_near(area_of(d, "z-"), 0.09 * pi, 1e-12);
    assert_near(area_of(d, "z+"), 0.09 * pi, 1e-12);
    /* perimeter of the prism: 2 A / offset, above the circle's by (pi/n)^2/6 relative, n >= 32 */
    assert_near(area_of(d, "side") / (0.6 * pi), 1.0, 2e-3);
    assert_true(area_of(d, "side") > 0.6 * pi);
    brc_domain_free(&d);
    r = test_sphere(1000, 0.5);
    d = test_build(*state, &r);
    assert_int_equal(d->n_walls, 1);
    assert_near(area_of(d, "surface") / pi, 1.0, 5e-3);
    assert_int_equal(set_of(d, "surface")->n_members, d->n_free_faces);
    brc_domain_free(&d);
}

static void each_predicate_picks_what_it_says(void **state)
{
    enum { N = 7 };
    brc_set_request sets[N] = {face_set("wall"),       face_set("box"), face_set("sphere"), face_set("cylinder"),
                               face_set("half space"), face_set("up"),  face_set("both")};
    sets[0].where = (brc_predicate){.has_wall = true, .wall = "y+"};
    sets[1].where = (brc_predicate){.has_box = true, .box = {{0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}};
    sets[2].where = (brc_predicate){.has_sphere = true, .sphere_centre = {0.5, 0.5, 1.0}, .sphere_radius = 0.3};
    sets[3].where = (brc_predicate){.has_cylinder = true,
                                    .cylinder_point = {9.0, 0.5, 0.5},
                                    .cylinder_axis = {-2.0, 0.0, 0.0},
                                    .cylinder_radius = 0.25};
    sets[4].where =
        (brc_predicate){.has_half_space = true, .half_space_point = {0.0, 0.0, 0.7}, .half_space_normal = {0, 0, 3}};
    sets[5].where = (brc_predicate){.has_normal = true, .normal = {0.0, 0.0, 2.0}, .normal_angle = 0.1};
    sets[6].where = sets[4].where;
    sets[6].where.has_wall = true;
    strcpy(sets[6].where.wall, "x-");
    brc_build_request r = test_box(1000, 0.0);
    r.n_sets = N;
    r.sets = sets;
    brc_domain *d = test_build(*state, &r);
    assert_int_equal(d->n_sets, 6 + N);
    /* counted by hand on a grid of ten: face centroids lie at 0.05, 0.15, ... */
    assert_int_equal(set_of(d, "wall")->n_members, 100);
    assert_int_equal(set_of(d, "box")->n_members, 50);
    assert_int_equal(set_of(d, "sphere")->n_members, 32); /* lattice points (odd, odd)/20 within 0.3 of the middle */
    assert_int_equal(set_of(d, "cylinder")->n_members, 2 * 16); /* within 0.25, on both ends */
    assert_int_equal(set_of(d, "half space")->n_members, 4 * 30 + 100);
    assert_int_equal(set_of(d, "up")->n_members, 100);
    assert_int_equal(set_of(d, "both")->n_members, 30);
    for (int s = 6; s < 6 + N; ++s)
        for (int64_t k = 1; k < d->sets[s].n_members; ++k)
            assert_true(d->sets[s].members[k - 1] < d->sets[s].members[k]);
    brc_domain_free(&d);
}

static void elements_are_picked_by_position_and_by_wall(void **state)
{
    brc_set_request sets[2] = {{.name = "corner", .kind = BRC_SET_ELEMENTS},
                               {.name = "skin", .kind = BRC_SET_ELEMENTS}};
    sets[0].where = (brc_predicate){.has_box = true, .box = {{0.0, 0.0, 0.0}, {0.25, 0.25, 0.25}}};
    sets[1].where = (brc_predicate){.has_wall = true, .wall = "x-"};
    brc_build_request r = test_box(1000, 0.0);
    r.n_sets = 2;
    r.sets = sets;
    brc_domain *d = test_build(*state, &r);
    assert_int_equal(set_of(d, "corner")->n_members, 27); /* 0.25 itself is on the rim, inclusive */
    assert_int_equal(set_of(d, "skin")->n_members, 100);
    assert_int_equal(set_of(d, "skin")->kind, BRC_SET_ELEMENTS);
    brc_domain_free(&d);
}

static void bad_sets_are_refused_with_a_sentence(void **state)
{
    brc_context *context = *state;
    brc_set_request sets[2] = {face_set("clamp"), face_set("clamp")};
    brc_build_request r = test_box(1000, 0.0);
    r.sets = sets;
    r.n_sets = 1;
    sets[0].where = (brc_predicate){.has_sphere = true, .sphere_centre = {5, 5, 5}, .sphere_radius = 0.1};
    test_refused(
        context, &r, BRC_BAD_INPUT,
        "set 'clamp' is empty: none of the 600 free faces fits; the body reaches from (0, 0, 0) to (1, 1, 1) m");
    sets[0].where = (brc_predicate){
        .has_box = true, .box = {{0.28, 0.28, 0.9}, {0.33, 0.33, 2}}}; /* about a corner of four faces of 0.1 m */
    test_refused(
        context, &r, BRC_BAD_INPUT,
        "set 'clamp' is empty: it reaches into 4 of the 600 free faces, and the middle of none of them is inside");
    sets[0].where = (brc_predicate){.has_wall = true, .wall = "side"};
    test_refused(context, &r, BRC_BAD_INPUT,
                 "wall 'side' is unknown, the walls of this shape are x-, x+, y-, y+, z-, z+");
    sets[0].where = (brc_predicate){.has_box = true, .box = {{0, 1, 0}, {1, 0, 1}}};
    test_refused(context, &r, BRC_BAD_INPUT, "from 1 m to 0 m along y");
    sets[0].where = (brc_predicate){.has_normal = true, .normal_angle = 0.1};
    test_refused(context, &r, BRC_BAD_INPUT, "must be finite and not zero");
    sets[0].where = (brc_predicate){.has_cylinder = true, .cylinder_axis = {1, 0, 0}};
    test_refused(context, &r, BRC_BAD_INPUT, "radius 0 m must be");
    sets[0].where = (brc_predicate){.has_normal = true, .normal = {1, 0, 0}};
    sets[0].kind = BRC_SET_ELEMENTS;
    test_refused(context, &r, BRC_BAD_INPUT, "elements have no normal");
    sets[0] = face_set("x-");
    sets[0].where = (brc_predicate){.has_wall = true, .wall = "x-"};
    test_refused(context, &r, BRC_BAD_INPUT, "set 'x-': the name is already taken");
    r.n_sets = 2;
    sets[0] = sets[1];
    sets[0].where = sets[1].where = (brc_predicate){.has_wall = true, .wall = "x-"};
    test_refused(context, &r, BRC_BAD_INPUT, "set 'clamp': the name is already taken");
    r.n_sets = 1;
    sets[0].name[0] = '\0';
    test_refused(context, &r, BRC_BAD_INPUT, "empty name");
}

static void walls_of_spheres_are_the_elements_that_touch_them(void **state)
{
    const int count[3] = {6, 5, 4};
    brc_domain *d = test_spheres(*state, count, 8.0, 0, 1);
    brc_set_request sets[2] = {{.name = "grip", .kind = BRC_SET_ELEMENTS, .where = {.has_wall = true, .wall = "x+"}},
                               {.name = "edge", .kind = BRC_SET_ELEMENTS, .where = {.has_wall = true, .wall = "x+"}}};
    sets[1].where.has_half_space = true;
    sets[1].where.half_space_point[2] = 3.0;
    sets[1].where.half_space_normal[2] = 1.0;
    for (int again = 0; again < 2; ++again) { /* wall sets are still there the second time */
        assert_int_equal(brc_sets_build(*state, 2, sets, d), BRC_OK);
        assert_int_equal(d->n_sets, 14);
        const brc_set *wall = set_of(d, "x+"), *grip = set_of(d, "grip"), *edge = set_of(d, "edge");
        assert_int_equal(wall->n_members, 20);
        assert_int_equal(grip->n_members, 20);
        assert_memory_equal(wall->members, grip->members, 20 * sizeof *wall->members);
        assert_int_equal(edge->n_members, 5);
        for (int64_t k = 0; k < 5; ++k)
            assert_int_equal(edge->members[k], 90 + 6 * k + 5);
    }
    sets[0].kind = BRC_SET_FACES;
    assert_int_equal(brc_sets_build(*state, 1, sets, d), BRC_BAD_INPUT);
    test_says(*state, "set 'grip': spheres have no faces; pick elements instead");
    brc_domain_free(&d);
}

/* Sets that are asked for again replace those of the same name, others stay. */
static void sets_built_again_keep_what_is_not_named(void **state)
{
    brc_set_request sets[2] = {face_set("clamp"), face_set("top")};
    sets[0].where = (brc_predicate){.has_wall = true, .wall = "x-"};
    sets[1].where = (brc_predicate){.has_wall = true, .wall = "z+"};
    brc_build_request r = test_box(1000, 0.0);
    r.n_sets = 2;
    r.sets = sets;
    brc_domain *d = test_build(*state, &r);
    sets[0].kind = BRC_SET_ELEMENTS;
    sets[0].where = (brc_predicate){.has_box = true, .box = {{0, 0, 0}, {0.05, 0.05, 0.05}}};
    assert_int_equal(brc_sets_build(*state, 1, sets, d), BRC_OK);
    assert_int_equal(d->n_sets, 8);
    assert_int_equal(set_of(d, "clamp")->kind, BRC_SET_ELEMENTS);
    assert_int_equal(set_of(d, "clamp")->n_members, 1);
    assert_int_equal(set_of(d, "top")->n_members, 100);
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_wall_has_a_set_that_covers_it, test_begin, test_end),
        cmocka_unit_test_setup_teardown(curved_walls_are_named_and_ends_follow_the_axis, test_begin, test_end),
        cmocka_unit_test_setup_teardown(each_predicate_picks_what_it_says, test_begin, test_end),
        cmocka_unit_test_setup_teardown(elements_are_picked_by_position_and_by_wall, test_begin, test_end),
        cmocka_unit_test_setup_teardown(walls_of_spheres_are_the_elements_that_touch_them, test_begin, test_end),
        cmocka_unit_test_setup_teardown(sets_built_again_keep_what_is_not_named, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bad_sets_are_refused_with_a_sentence, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
