/* Shapes filled with packings, beams and points of a file, and beside one another. */
#include "shape_case.h"
#include "../support_mesh.h"

#include "../../../host/base/log.h"
#include "../../../preprocess/shapes/solid.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void packings_become_cells_or_beams_in_any_shape(void **state)
{
    test_shape room;
    brc_build_request r = request_for(test_shape_named("torus", &room), 0);
    r.fill =
        (brc_fill){.kind = BRC_FILL_PACKING, .n_elements = 1500, .radius_spread = 0.25, .coordination = 6.2, .seed = 1};
    brc_domain *d = test_build(*state, &r);
    check_domain(*state, d, "packing");
    assert_int_equal(d->n_elements, 1500);
    assert_near(d->quality.volume_cells / room.volume, 1.0, curved_bound(1500));
    brc_domain_free(&d);
    r.beams = 8.0;
    r.rotation[0] = 0.3;
    d = test_build(*state, &r);
    assert_int_equal(d->element_kind, BRC_ELEMENT_SPHERE);
    assert_int_equal(d->n_bonds, 6000);
    brc_domain_free(&d);
}

/* Every shape, packed, turned and moved, and twice side by side in one domain. */
static void every_shape_is_packed_turned_and_put_beside_another(void **state)
{
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        const int64_t n = 600;
        brc_build_request r = request_for(test_shape_of(k, &room), n);
        r.fill = (brc_fill){.kind = BRC_FILL_PACKING,
                            .n_elements = n,
                            .radius_spread = 0.125,
                            .coordination = 6.2,
                            .tolerance = 0.1,
                            .seed = 2};
        r.rotation[0] = 0.4;
        r.rotation[1] = -0.7;
        r.translation[2] = 2.5;
        brc_domain *pair[2], *joined = NULL, *other;
        pair[0] = test_build(*state, &r);
        check_domain(*state, pair[0], room.name);
        const double h = cbrt(room.volume / (double)pair[0]->n_elements),
                     off = pair[0]->quality.volume_cells / room.volume - 1.0;
        const double bound = room.wall == TEST_EXACT    ? 1e-9
                             : room.wall == TEST_CURVED ? curved_bound(n)
                                                        : 0.1 * h * h / room.volume;
        if (!(fabs(off) < bound)) fail_msg("%s: volume off by %g, bound %g", room.name, off, bound);
        r.n_threads = 2;
        other = test_build(*state, &r);
        test_same_bytes(*state, pair[0], other);
        brc_domain_free(&other);
        r.translation[0] = 10.0;
        r.body = 1;
        pair[1] = test_build(*state, &r);
        if (brc_domain_join(*state, 2, (const brc_domain *const *)pair, NULL, BRC_ALONE, &joined) != BRC_OK)
            fail_msg("%s: %s", room.name, brc_context_message(*state));
        if (brc_domain_check(*state, joined) != BRC_OK)
            fail_msg("%s, twice: %s", room.name, brc_context_message(*state));
        assert_int_equal(joined->n_elements, 2 * pair[0]->n_elements);
        assert_int_equal(joined->n_bonds, 2 * pair[0]->n_bonds);
        brc_domain_free(&joined);
        brc_domain_free(&pair[0]);
        brc_domain_free(&pair[1]);
    }
}

/* Bodies face to face, edge to edge, and one in the cavity of another touch and are taken; one inside the other is
 * refused. */
static void bodies_that_touch_are_taken_and_those_inside_each_other_are_not(void **state)
{
    static const double at[4][3] = {{1, 0, 0}, {1, 1, 0}, {0, 0, 1.0}, {0.25, 0.25, 0.25}};
    brc_build_request r = test_box(300, 0.9);
    brc_domain *pair[2], *joined = NULL;
    pair[0] = test_build(*state, &r);
    for (int k = 0; k < 4; ++k) {
        r.fill.seed = 7;
        if (k == 3) r.shape.size[0] = r.shape.size[1] = r.shape.size[2] = 0.5;
        memcpy(r.translation, at[k], sizeof r.translation);
        pair[1] = test_build(*state, &r);
        const brc_status status = brc_domain_join(*state, 2, (const brc_domain *const *)pair, NULL, BRC_ALONE, &joined);
        assert_int_equal(status, k < 3 ? BRC_OK : BRC_BAD_INPUT);
        if (k == 3) test_says(*state, "overlap");
        brc_domain_free(&joined);
        brc_domain_free(&pair[1]);
    }
    brc_domain_free(&pair[0]);
}

static void write_points(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void points_of_a_file_become_cells(void **state)
{
    brc_build_request r = test_box(0, 0.0);
    r.fill = (brc_fill){.kind = BRC_FILL_POINTS, .scale = 1e-2};
    snprintf(r.fill.file, sizeof r.fill.file, "points_%d.csv", (int)getpid());
    write_points(r.fill.file, "x,y,z\n25,50,50\n75,50,50\n50,25,20\n");
    brc_domain *d = test_build(*state, &r);
    check_domain(*state, d, "points");
    assert_int_equal(d->n_elements, 3);
    assert_near(d->quality.volume_cells, 1.0, 1e-14);
    brc_domain_free(&d);
    write_points(r.fill.file, "x,y,z\n25,50,50\n175,50,50\n50,25,20\n50,-1,0\n");
    test_refused(*state, &r, BRC_BAD_INPUT, "2 of 4 points");
    test_says(*state, "the first (point 2) at (1.75, 0.5, 0.5) m");
    r.beams = 4.0;
    write_points(r.fill.file, "x,y,z\n25,50,50\n75,50,50\n50,25,20\n");
    test_refused(*state, &r, BRC_BAD_INPUT, "have no radii");
    remove(r.fill.file);
}

static void fills_that_do_not_go_together_are_refused(void **state)
{
    brc_build_request r = test_box(1000, 0.5);
    r.beams = 6.0;
    test_refused(*state, &r, BRC_BAD_INPUT, "a noisy grid has none");
    r.fill = (brc_fill){.kind = BRC_FILL_PACKING, .n_elements = 100};
    test_refused(*state, &r, BRC_BAD_INPUT, "either a coordination number");
    r.fill.coordination = 6.2;
    r.fill.radius = 0.1;
    test_refused(*state, &r, BRC_BAD_INPUT, "either the number of elements or their mean radius");
    r.fill.radius = 0.0;
    r.fill.radius_spread = 1.5;
    test_refused(*state, &r, BRC_BAD_INPUT, "must be 0 to 0.9");
    brc_radius radii[2] = {{1.0, 0.0}, {0.5, 1.0}};
    r.fill.radius_spread = 0.0;
    r.fill.n_radii = 2;
    r.fill.radii = radii;
    test_refused(*state, &r, BRC_BAD_INPUT, "radius 2 of the table is 0.5 m");
    r.fill.n_elements = (int64_t)1e12;
    r.fill.n_radii = 0;
    test_refused(*state, &r, BRC_BAD_INPUT, "ask for at most");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(packings_become_cells_or_beams_in_any_shape, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_shape_is_packed_turned_and_put_beside_another, test_begin, test_end),
        cmocka_unit_test_setup_teardown(bodies_that_touch_are_taken_and_those_inside_each_other_are_not, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(points_of_a_file_become_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(fills_that_do_not_go_together_are_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
