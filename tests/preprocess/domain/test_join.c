#include "../spheres.h"
#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/pose.h"

#include <math.h>
#include <string.h>

static void joined_bodies_keep_their_numbers_and_share_walls_and_sets(void **state)
{
    brc_set_request set = {.name = "grip", .kind = BRC_SET_ELEMENTS, .where = {.has_wall = true, .wall = "x-"}};
    brc_build_request r[2] = {test_box(300, 0.9), test_cylinder(300, 0.9)};
    r[0].sets = r[1].sets = &set;
    r[0].n_sets = r[1].n_sets = 1;
    r[1].translation[0] = 1.5;
    r[1].body = 1;
    brc_domain *part[2] = {test_build(*state, &r[0]), test_build(*state, &r[1])}, *d;
    const brc_domain *parts[2] = {part[0], part[1]};
    assert_int_equal(brc_domain_join(*state, 2, parts, NULL, BRC_ALONE, &d), BRC_OK);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    const int64_t n = part[0]->n_elements, f = part[0]->n_free_faces, h = part[0]->n_half_edges;
    assert_int_equal(d->n_elements, n + part[1]->n_elements);
    assert_int_equal(d->n_bonds, part[0]->n_bonds + part[1]->n_bonds);
    assert_int_equal(d->n_free_faces, f + part[1]->n_free_faces);
    assert_memory_equal(d->position + 3 * n, part[1]->position, 3 * (size_t)part[1]->n_elements * sizeof(double));
    assert_memory_equal(d->area_vector + 3 * h, part[1]->area_vector,
                        3 * (size_t)part[1]->n_half_edges * sizeof(double));
    for (int64_t k = 0; k < part[1]->n_half_edges; ++k)
        assert_int_equal(d->neighbour[h + k], part[1]->neighbour[k] + n);
    for (int64_t e = 0; e < d->n_elements; ++e)
        assert_int_equal(d->body[e], e < n ? 0 : 1);
    assert_int_equal(d->n_walls, 7); /* six of the box; the cylinder adds its side */
    assert_int_equal(d->n_sets, 8);
    const char *const both[2] = {"x-", "grip"};
    for (int k = 0; k < 2; ++k) {
        const brc_set *s = &d->sets[brc_domain_find_set(d, both[k])];
        const brc_set *a = &part[0]->sets[brc_domain_find_set(part[0], both[k])];
        const brc_set *b = &part[1]->sets[brc_domain_find_set(part[1], both[k])];
        assert_int_equal(s->n_members, a->n_members + b->n_members);
        assert_int_equal(s->members[a->n_members], b->members[0] + (k == 0 ? f : n));
    }
    assert_near(d->quality.volume_shape, part[0]->quality.volume_shape + part[1]->quality.volume_shape, 1e-15);
    assert_near(d->quality.volume_error, 0.0, 1e-12);
    assert_near(d->bounds[1][0], 2.5, 1e-14);
    assert_non_null(strstr(d->provenance, " | "));
    for (int k = 0; k < 2; ++k)
        brc_domain_free(&part[k]);
    brc_domain_free(&d);
}

static void joining_one_body_gives_it_back(void **state)
{
    const brc_build_request r = test_sphere(300, 0.9);
    brc_domain *a = test_build(*state, &r), *d;
    const brc_domain *parts[1] = {a};
    assert_int_equal(brc_domain_join(*state, 1, parts, NULL, BRC_ALONE, &d), BRC_OK);
    assert_memory_equal(&d->quality, &a->quality, sizeof a->quality);
    assert_memory_equal(d->vertex, a->vertex, 3 * (size_t)a->vertex_start[a->n_elements] * sizeof(double));
    assert_memory_equal(d->twin, a->twin, (size_t)a->n_half_edges * sizeof(int32_t));
    brc_domain_free(&a);
    brc_domain_free(&d);
}

static void sets_of_one_name_and_two_kinds_are_refused(void **state)
{
    brc_set_request set = {.name = "grip", .kind = BRC_SET_ELEMENTS, .where = {.has_wall = true, .wall = "x-"}};
    brc_build_request r = test_box(300, 0.9);
    r.sets = &set;
    r.n_sets = 1;
    brc_domain *a = test_build(*state, &r);
    set.kind = BRC_SET_FACES;
    r.translation[0] = 2.0;
    brc_domain *b = test_build(*state, &r), *d;
    const brc_domain *parts[2] = {a, b};
    assert_int_equal(brc_domain_join(*state, 2, parts, NULL, BRC_ALONE, &d), BRC_BAD_INPUT);
    assert_null(d);
    test_says(*state, "set 'grip' holds faces in one body and elements in another");
    assert_int_equal(brc_domain_join(*state, 0, parts, NULL, BRC_ALONE, &d), BRC_BAD_INPUT);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

static void give_grains(brc_context *context, brc_domain *d, int32_t n)
{
    assert_int_equal(BRC_ALLOCATE(context, &d->grain, d->n_elements, "grains"), BRC_OK);
    for (int64_t e = 0; e < d->n_elements; ++e)
        d->grain[e] = (int32_t)(e % n);
}

/* Bodies of 3 and 2 grains and one without, which becomes a grain of its own. */
static void grains_are_numbered_through_all_bodies(void **state)
{
    brc_build_request r = test_box(64, 0.9);
    brc_domain *part[3], *d;
    for (int k = 0; k < 3; ++k) {
        r.translation[0] = 2.0 * k;
        part[k] = test_build(*state, &r);
    }
    give_grains(*state, part[0], 3);
    give_grains(*state, part[2], 2);
    assert_int_equal(brc_domain_join(*state, 3, (const brc_domain *const *)part, NULL, BRC_ALONE, &d), BRC_OK);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    for (int64_t e = 0; e < d->n_elements; ++e)
        assert_int_equal(d->grain[e], e < 64 ? e % 3 : e < 128 ? 3 : 4 + e % 2);
    assert_int_equal(d->quality.n_pieces, 3);
    for (int k = 0; k < 3; ++k)
        brc_domain_free(&part[k]);
    brc_domain_free(&d);
}

static void spheres_are_joined_with_their_radii_and_walls(void **state)
{
    const int count[3] = {5, 4, 4}, more[3] = {3, 3, 3};
    const double none[3] = {0.0, 0.0, 0.0}, up[3] = {0.0, 0.0, 4.5};
    brc_domain *a = test_spheres(*state, count, 8.0, 0, 1), *b = test_spheres(*state, more, 9.0, 1, 1), *d;
    brc_pose_apply(none, none, up, b);
    const brc_domain *parts[2] = {a, b};
    assert_int_equal(brc_domain_join(*state, 2, parts, NULL, BRC_ALONE, &d), BRC_OK);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    assert_int_equal(d->element_kind, BRC_ELEMENT_SPHERE);
    assert_int_equal(d->n_elements, 80 + 27);
    assert_int_equal(d->n_bonds, a->n_bonds + b->n_bonds);
    assert_memory_equal(d->radius, a->radius, 80 * sizeof(double));
    assert_memory_equal(d->radius + 80, b->radius, 27 * sizeof(double));
    assert_null(d->free_start);
    assert_int_equal(d->n_sets, 12);
    const brc_set *set = &d->sets[brc_domain_find_set(d, "z-")];
    assert_int_equal(set->n_members, 20 + 9);
    assert_int_equal(set->members[20], 80 + b->sets[brc_domain_find_set(b, "z-")].members[0]);
    assert_near(d->quality.volume_shape, 80.0 + 27.0, 1e-12);
    double volume[2] = {0};
    for (int64_t e = 0; e < 107; ++e)
        volume[e >= 80] += d->volume[e];
    assert_true(fabs(a->quality.volume_fraction / b->quality.volume_fraction - 1) > 1e-3);
    assert_near(volume[0], 80.0, 1e-12); /* each body's spheres stand for all of it */
    assert_near(volume[1], 27.0, 1e-12);
    assert_near(d->quality.growth, fmax(a->quality.growth, b->quality.growth), 0.0);
    assert_int_equal(d->quality.n_pieces, 2);
    brc_domain_free(&a);
    brc_domain_free(&b);
    brc_domain_free(&d);
}

static void cells_and_spheres_are_not_joined(void **state)
{
    const int count[3] = {3, 3, 3};
    brc_build_request r = test_box(64, 0.9);
    r.translation[0] = 10.0;
    brc_domain *a = test_spheres(*state, count, 8.0, 0, 1), *b = test_build(*state, &r), *d;
    const brc_domain *parts[2] = {a, b};
    assert_int_equal(brc_domain_join(*state, 2, parts, NULL, BRC_ALONE, &d), BRC_BAD_INPUT);
    assert_null(d);
    test_says(*state,
              "body 0 is made of spheres, body 1 of cells, which one domain cannot hold; give `beams` to all bodies");
    brc_domain_free(&a);
    brc_domain_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(joined_bodies_keep_their_numbers_and_share_walls_and_sets, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(joining_one_body_gives_it_back, test_begin, test_end),
        cmocka_unit_test_setup_teardown(sets_of_one_name_and_two_kinds_are_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(grains_are_numbered_through_all_bodies, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_are_joined_with_their_radii_and_walls, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cells_and_spheres_are_not_joined, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
