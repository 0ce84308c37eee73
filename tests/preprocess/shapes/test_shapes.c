/* Every kind of shape filled with cells. What must hold of a domain is checked from its arrays; volumes against
 * formulas. */
#include "shape_case.h"
#include "../support_mesh.h"

#include "../../../host/base/log.h"
#include "../../../preprocess/shapes/solid.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void every_shape_is_filled_with_closed_cells_that_agree(void **state)
{
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        const int64_t n = 2000;
        brc_build_request r = request_for(test_shape_of(k, &room), n);
        brc_domain *d = test_build(*state, &r);
        check_domain(*state, d, room.name);
        const double h = cbrt(room.volume / (double)d->n_elements), off = d->quality.volume_cells / room.volume - 1.0;
        /* concave edges, 1 m long in these shapes, are rounded by cells: a tenth of h^2 along them */
        const double bound = room.wall == TEST_EXACT    ? 1e-9
                             : room.wall == TEST_CURVED ? curved_bound(n)
                                                        : 0.1 * h * h / room.volume;
        if (!(fabs(off) < bound)) fail_msg("%s: volume off by %g, bound %g", room.name, off, bound);
        r.n_threads = 2;
        brc_domain *other = test_build(*state, &r);
        test_same_bytes(*state, d, other);
        brc_domain_free(&other);
        brc_domain_free(&d);
    }
}

static void counts_come_near_to_what_was_asked_for(void **state)
{
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        const brc_build_request r = request_for(test_shape_of(k, &room), 5000);
        int64_t n, bytes;
        if (brc_domain_estimate(*state, &r, &n, &bytes) != BRC_OK)
            fail_msg("%s: %s", room.name, brc_context_message(*state));
        /* between flat walls all round the grid's cells must fit: one layer more or less is a step of 5 %, spread over
         * three axes */
        if (llabs(n - 5000) > 150) fail_msg("%s: %lld elements", room.name, (long long)n);
    }
}

static void curved_walls_by_mirror_images_are_met_to_second_order(void **state)
{
    static const char *const name[] = {"torus", "cone", "box minus ball", "two balls in common"};
    for (int k = 0; k < 4; ++k) {
        test_shape room;
        brc_build_request r = request_for(test_shape_named(name[k], &room), 1250);
        double off[2];
        for (int level = 0; level < 2; ++level, r.fill.n_elements *= 8) { /* half as wide */
            brc_domain *d = test_build(*state, &r);
            off[level] = fabs(d->quality.volume_cells / room.volume - 1.0);
            brc_domain_free(&d);
        }
        assert_true(off[1] < 0.005); /* the asked bound at 10 000 cells */
        /* second order is a factor of 4; a third of it is left to the chance of where seeds lie, and nothing is asked
         * below the accuracy of measured volumes */
        if (!(off[1] < off[0] * 0.375 || off[1] < 1e-5))
            fail_msg("%s: volume off by %g, with cells half as wide %g", name[k], off[0], off[1]);
    }
}

static void a_turned_and_moved_shape_has_the_same_cells(void **state)
{
    test_shape room;
    brc_build_request r = request_for(test_shape_named("box minus cylinder", &room), 1000);
    brc_domain *d = test_build(*state, &r);
    r.rotation[0] = 0.7;
    r.rotation[2] = -0.4;
    r.translation[1] = 3.0;
    brc_domain *posed = test_build(*state, &r);
    check_domain(*state, posed, "posed");
    assert_int_equal(posed->n_elements, d->n_elements);
    assert_int_equal(posed->n_bonds, d->n_bonds);
    assert_memory_equal(posed->volume, d->volume, (size_t)d->n_elements * sizeof(double));
    assert_memory_equal(posed->neighbour, d->neighbour, (size_t)d->n_half_edges * sizeof(int32_t));
    brc_domain_free(&posed);
    brc_domain_free(&d);
}

static void free_faces_know_their_wall(void **state)
{
    test_shape room;
    brc_build_request r = request_for(test_shape_named("box minus cylinder", &room), 3000);
    brc_domain *d = test_build(*state, &r);
    double area[16] = {0.0};
    assert_int_equal(d->n_walls, 9);
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        const double *s = d->free_area_vector + 3 * f;
        area[d->free_wall[f]] += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    }
    const double circle = 0.78539816339744831;
    const double exact[9] = {2, 2, 2, 2, 4 - circle, 4 - circle, 0, 0, 3.1415926535897932};
    /* facets of a curved wall stand in steps; second order in the cell's width over the radius */
    const double second = pow((4.0 - circle) / 3000.0, 2.0 / 3.0) / 0.25;
    for (int w = 0; w < 9; ++w)
        assert_near(area[w], exact[w], w < 4 ? 1e-11 : second * exact[w]);
    assert_string_equal(d->wall_name[8], "hole_side");
    assert_true(d->sets[brc_domain_find_set(d, "hole_side")].n_members > 100);
    brc_domain_free(&d);
}

/* Root mean square of the free faces' distance from the surface, weighted with area, over the spacing. */
static double unevenness(brc_context *context, const brc_shape *shape, const brc_domain *d)
{
    brc_solid *solid = NULL;
    double sum = 0.0, total = 0.0;
    assert_int_equal(brc_solid_create(context, shape, 1, &solid), BRC_OK);
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        const double *s = d->free_area_vector + 3 * f, area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        const double depth = brc_solid_depth(solid, d->free_centroid + 3 * f);
        sum += area * depth * depth;
        total += area;
    }
    brc_solid_free(&solid);
    return sqrt(sum / total) / d->quality.mean_spacing;
}

/* Rings of seeds around a straight concave edge are their own images, so faces lie in the walls but where a seed beyond
 * the rings still reaches one around the edge. Seeds at random (points of a file are not touched) leave faces uneven by
 * a third of a spacing over about a spacing along the edge: 0.01 of these surfaces. A tenth of that is asked for. */
static void faces_at_a_straight_concave_edge_lie_in_its_walls(void **state)
{
    static const char *const name[2] = {"L-shape", "V-notch"};
    for (int k = 0; k < 2; ++k) {
        test_shape room;
        brc_build_request r = request_for(test_shape_named(name[k], &room), 3000);
        for (int lloyd = 0; lloyd <= 2; lloyd += 2) {
            r.fill.lloyd_sweeps = lloyd;
            brc_domain *d = test_build(*state, &r);
            check_domain(*state, d, name[k]);
            const double uneven = unevenness(*state, &r.shape, d);
            if (!(uneven < 1e-3)) fail_msg("%s, %d sweeps: uneven by %g", name[k], lloyd, uneven);
            assert_near(d->quality.volume_cells / room.volume, 1.0, 1e-5);
            brc_domain_free(&d);
        }
    }
}

static void a_gap_narrower_than_the_cells_is_refused_not_bridged(void **state)
{
    test_shape room;
    brc_build_request r = request_for(test_shape_named("L-shape", &room), 3000);
    room.part[0].shape.size[1] = 2.0;
    room.part[1] =
        (brc_shape_part){.role = BRC_PART_REMOVE,
                         .shape = {.kind = BRC_SHAPE_BOX, .origin = {0.99, 1.0, -1.0}, .size = {0.02, 2.0, 3.0}}};
    test_refused(*state, &r, BRC_BAD_INPUT, "a gap there is narrower than the cells");
    test_says(*state, "make a slot of no width a crack");
    room.part[1].shape.size[0] = 1e-5; /* far narrower still */
    test_refused(*state, &r, BRC_BAD_INPUT, "a gap there is narrower than the cells");
    room.part[1].shape.size[0] = 0.5; /* several cells wide */
    brc_domain *d = test_build(*state, &r);
    check_domain(*state, d, "wide slot");
    brc_domain_free(&d);
}

/* Ways between seeds beside a round wall graze it by small faces: no gap is there. Four to six cells across the tube,
 * round one way and hollow the other. */
static void a_thin_ring_is_no_gap(void **state)
{
    static const double tube = 0.04, pi = 3.14159265358979;
    const brc_shape ring = {.kind = BRC_SHAPE_TORUS, .axis = 2, .radius = 1.0, .radius2 = tube};
    for (int n = 5000; n <= 15000; n += 5000) {
        brc_build_request r = request_for(ring, n);
        brc_domain *d = test_build(*state, &r);
        check_domain(*state, d, "thin ring");
        /* facets of a tube of k cells across stand off it by about 1 / (2 k^2) of its radius */
        assert_near(d->quality.volume_cells / (2 * pi * pi * tube * tube), 1.0, 0.03);
        brc_domain_free(&d);
    }
}

/* Build, and what was warned of. */
static brc_domain *build_and_listen(brc_context *context, const brc_build_request *r, char *said, size_t room)
{
    brc_domain *d = NULL;
    brc_log_set_level(context, BRC_LOG_WARNING);
    test_caught caught = test_catch_stderr();
    const brc_status status = brc_domain_build(context, r, &d);
    test_release_stderr(&caught, said, room);
    brc_log_set_level(context, BRC_LOG_ERROR);
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
    return d;
}

static void features_smaller_than_a_cell_are_warned_of_by_name_and_size(void **state)
{
    test_shape room;
    char said[4096];
    brc_build_request r = request_for(test_shape_named("box minus ball", &room), 1000); /* cells of 0.2 m */
    brc_domain_free(&(brc_domain *){build_and_listen(*state, &r, said, sizeof said)});
    assert_string_equal(said, "");
    room.part[1].shape.radius = 0.05;
    brc_domain_free(&(brc_domain *){build_and_listen(*state, &r, said, sizeof said)});
    assert_non_null(strstr(said, "part 2 ('void') is 0.1 m thick, less than one of the cells of 0.2 m"));
    room.part[1].shape.origin[0] = 5.0; /* far away: no part of the solid ends there */
    brc_domain_free(&(brc_domain *){build_and_listen(*state, &r, said, sizeof said)});
    assert_string_equal(said, "");
    r.fill = (brc_fill){.kind = BRC_FILL_PACKING, .n_elements = 500, .radius_spread = 0.1, .coordination = 6.2};
    r.beams = 8.0;
    room.part[1].shape.origin[0] = 1.0;
    brc_domain_free(&(brc_domain *){build_and_listen(*state, &r, said, sizeof said)});
    assert_non_null(strstr(said, "part 2 ('void') is 0.1 m thick, less than one of the spheres"));
}

static void a_wall_without_a_face_is_warned_of_by_name_and_size(void **state)
{
    test_shape room;
    char said[4096];
    brc_build_request r = request_for(test_shape_named("wedge", &room), 1000);
    room.part[1] =
        (brc_shape_part){.role = BRC_PART_REMOVE,
                         .name = "corner", /* cuts 0.03 m off a corner, cells are 0.1 m */
                         .shape = {.kind = BRC_SHAPE_HALF_SPACE, .origin = {0.97, 1.0, 1.0}, .normal = {-1, -1, -1}}};
    brc_domain_free(&(brc_domain *){build_and_listen(*state, &r, said, sizeof said)});
    /* a plane with the whole solid on one side cuts the cells itself, so it is met whatever its size */
    assert_string_equal(said, "");
    room.part[1] = (brc_shape_part){.role = BRC_PART_REMOVE,
                                    .name = "dent", /* a cap 0.02 m deep of a large ball */
                                    .shape = {.kind = BRC_SHAPE_SPHERE, .origin = {0.5, 0.5, 1.48}, .radius = 0.5}};
    brc_domain *d = build_and_listen(*state, &r, said, sizeof said);
    const int32_t set = brc_domain_find_set(d, "dent_surface");
    assert_true((set >= 0 && d->sets[set].n_members > 0) ||
                strstr(said, "no cell has a face on the wall 'dent_surface', which is 0.3") != NULL);
    brc_domain_free(&d);
}

static void cells_too_coarse_for_the_shape_are_refused(void **state)
{
    test_shape room;
    brc_build_request r = request_for(test_shape_named("torus", &room), 300);
    r.shape.radius2 = 0.1; /* a ring of wire, two cubes across */
    r.fill.spread = 0.0;
    test_refused(*state, &r, BRC_BAD_INPUT, "ask for more elements");
}

/* A mesh of flat sides is met exactly, to the mesh's own volume; faces of an L carry a concave edge as the L of parts
 * does. */
static void meshes_are_filled_like_shapes(void **state)
{
    const double low[3] = {0.0, 0.0, 0.0}, high[3] = {1.0, 2.0, 0.5};
    const double volume[3] = {1.0, 0.0, 3.0 * 0.8};
    for (int k = 0; k < 3; ++k) {
        test_mesh mesh = {0};
        brc_shape shape = {.kind = BRC_SHAPE_MESH, .scale = 1.0};
        snprintf(shape.file, sizeof shape.file, "shapes_%d.stl", (int)getpid());
        if (k == 0) test_mesh_box(&mesh, low, high, 3);
        if (k == 1) test_mesh_torus(&mesh, 1.0, 0.4, 80, 40);
        if (k == 2) test_mesh_l_profile(&mesh, 0.8);
        if (k < 2) test_mesh_turn(&mesh, 0.4, low);
        test_mesh_write_binary(&mesh, shape.file);
        const brc_build_request r = request_for(shape, 2000);
        brc_domain *d = test_build(*state, &r);
        check_domain(*state, d, shape.file);
        const double exact = volume[k] > 0.0 ? volume[k] : d->quality.volume_shape;
        /* single precision of the file: 6e-8 of the size on every side */
        assert_near(d->quality.volume_cells / exact, 1.0,
                    k == 0   ? 1e-6
                    : k == 1 ? curved_bound(2000)
                             : 0.1 * pow(exact / 2000.0, 2.0 / 3.0) * 0.8 / exact);
        brc_domain_free(&d);
        test_mesh_free(&mesh);
        remove(shape.file);
    }
}

static void a_mesh_may_be_a_part(void **state)
{
    const double low[3] = {0.5, 0.5, -0.5}, high[3] = {1.5, 1.5, 1.5};
    test_mesh mesh = {0};
    test_shape room;
    brc_build_request r = request_for(test_shape_named("box minus cylinder", &room), 2000);
    room.part[1].shape = (brc_shape){.kind = BRC_SHAPE_MESH, .scale = 1.0};
    char *file = room.part[1].shape.file;
    snprintf(file, sizeof room.part[1].shape.file, "part_%d.stl", (int)getpid());
    test_mesh_box(&mesh, low, high, 1);
    test_mesh_write_binary(&mesh, file);
    brc_domain *d = test_build(*state, &r);
    check_domain(*state, d, "box minus mesh");
    /* a square hole of 1 m^2; lines along an axis of the mesh meet its sides edge-on: one line in 1000 may be counted
     * or not, some cancel */
    assert_near(d->quality.volume_shape, 3.0, 1e-4);
    assert_near(d->quality.volume_cells, 3.0, 4.0 * 0.1 * pow(3.0 / 2000.0, 2.0 / 3.0)); /* four concave edges of 1 m */
    brc_domain_free(&d);
    test_mesh_free(&mesh);
    remove(file);
}

static void relaxed_cells_fill_the_shape_too(void **state)
{
    test_shape room;
    brc_build_request r = request_for(test_shape_named("torus", &room), 2000);
    r.fill.lloyd_sweeps = 3;
    brc_domain *d = test_build(*state, &r);
    check_domain(*state, d, "relaxed");
    assert_near(d->quality.volume_cells / room.volume, 1.0, curved_bound(2000));
    assert_true(d->quality.support_smallest > 0.2);
    brc_domain_free(&d);
}

static void cubes_in_a_shape_with_concave_edges_are_proper_cells(void **state)
{
    static const char *const name[] = {"L-shape", "torus", "box minus cylinder"};
    for (int k = 0; k < 3; ++k) {
        test_shape room;
        brc_build_request r = request_for(test_shape_named(name[k], &room), 1500);
        r.fill.spread = 0.0;
        brc_domain *d = test_build(*state, &r);
        check_domain(*state, d, name[k]);
        brc_domain_free(&d);
    }
}

/* The table of docs/reference/domain.md: test_shapes table [elements]. */
static int print_table(int64_t n)
{
    brc_context *context = brc_context_create();
    printf("| shape | cells | volume error | worst closure | worst twin | uneven by | free faces a cell | s |\n| --- | "
           "--- | --- | --- | --- | --- | --- | --- |\n");
    brc_log_set_level(context, BRC_LOG_ERROR);
    for (int k = 0; k < test_n_shapes(); ++k) {
        test_shape room;
        brc_build_request r = request_for(test_shape_of(k, &room), n);
        r.n_threads = 0;
        brc_domain *d = NULL;
        const double start = brc_clock_s();
        if (brc_domain_build(context, &r, &d) != BRC_OK) {
            printf("| %s | %s |\n", room.name, brc_context_message(context));
            continue;
        }
        printf("| %s | %lld | %.1e | %.0e | %.0e | %.4f | %.2f | %.2f |\n", room.name, (long long)d->n_elements,
               d->quality.volume_cells / room.volume - 1.0, test_worst_closure(d), d->quality.twin_area_worst,
               unevenness(context, &r.shape, d), (double)d->n_free_faces / (double)d->n_elements,
               brc_clock_s() - start);
        brc_domain_free(&d);
    }
    brc_context_free(&context);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "table") == 0) return print_table(argc > 2 ? atoll(argv[2]) : 10000);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_shape_is_filled_with_closed_cells_that_agree, test_begin, test_end),
        cmocka_unit_test_setup_teardown(counts_come_near_to_what_was_asked_for, test_begin, test_end),
        cmocka_unit_test_setup_teardown(curved_walls_by_mirror_images_are_met_to_second_order, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_turned_and_moved_shape_has_the_same_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(free_faces_know_their_wall, test_begin, test_end),
        cmocka_unit_test_setup_teardown(faces_at_a_straight_concave_edge_lie_in_its_walls, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_gap_narrower_than_the_cells_is_refused_not_bridged, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_thin_ring_is_no_gap, test_begin, test_end),
        cmocka_unit_test_setup_teardown(features_smaller_than_a_cell_are_warned_of_by_name_and_size, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(a_wall_without_a_face_is_warned_of_by_name_and_size, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cells_too_coarse_for_the_shape_are_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(meshes_are_filled_like_shapes, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_mesh_may_be_a_part, test_begin, test_end),
        cmocka_unit_test_setup_teardown(relaxed_cells_fill_the_shape_too, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cubes_in_a_shape_with_concave_edges_are_proper_cells, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
