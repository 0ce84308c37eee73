#include "../support.h"

#include "../../../preprocess/shapes/convex.h"

#include <string.h>

static void cells_keep_their_volume_and_centre(void **state)
{
    brc_build_request request = test_cylinder(3000, 0.9);
    brc_domain *domain = test_build(*state, &request);
    brc_convex convex;
    assert_int_equal(brc_convex_of_domain(*state, domain, 0, &convex), BRC_OK);
    assert_int_equal(convex.n, domain->n_elements);
    for (int32_t e = 0; e < convex.n; ++e) {
        brc_rigid cell;
        brc_convex_mass(&convex, e, &cell);
        /* outlines match areas to 1e-9 of a cell's size squared; a cell is a third of that cube or less */
        assert_near(cell.volume, domain->volume[e], 1e-8 * domain->volume[e]);
        for (int k = 0; k < 3; ++k)
            assert_near(cell.centre[k] + domain->position[3 * e + k], domain->centroid[3 * e + k],
                        1e-8 * convex.radius[e]);
        for (int k = 0; k < 6; ++k)
            assert_near(cell.inertia[k], domain->inertia[6 * e + k], 1e-8 * domain->inertia[6 * e]);
    }
    brc_convex_free(&convex);
    brc_domain_free(&domain);
}

/* What the kernel's room is made for. */
static void random_cells_stay_far_below_the_limits(void **state)
{
    brc_build_request request = test_box(20000, 0.9);
    brc_domain *domain = test_build(*state, &request);
    brc_convex convex;
    assert_int_equal(brc_convex_of_domain(*state, domain, 0, &convex), BRC_OK);
    int faces[BRC_CONVEX_FACES + 1] = {0}, corners[BRC_CONVEX_CORNERS + 1] = {0}, most_corners = 0, most_faces = 0;
    for (int32_t e = 0; e < convex.n; ++e) {
        const int n = convex.face_start[e + 1] - convex.face_start[e];
        ++faces[n];
        most_faces = n > most_faces ? n : most_faces;
    }
    for (int32_t f = 0; f < convex.face_start[convex.n]; ++f) {
        const int n = convex.loop_start[f + 1] - convex.loop_start[f];
        ++corners[n];
        most_corners = n > most_corners ? n : most_corners;
    }
    for (int k = 0; k <= most_faces; ++k)
        printf("%d faces: %d cells\n", k, faces[k]);
    for (int k = 0; k <= most_corners; ++k)
        printf("%d corners: %d faces\n", k, corners[k]);
    assert_true(most_faces <= BRC_CONVEX_FACES / 2 && most_corners <= BRC_CONVEX_CORNERS / 2);
    brc_convex_free(&convex);
    brc_domain_free(&domain);
}

static void threads_do_not_change_a_number(void **state)
{
    brc_build_request request = test_sphere(800, 0.7);
    brc_domain *domain = test_build(*state, &request);
    brc_convex one, many;
    assert_int_equal(brc_convex_of_domain(*state, domain, 1, &one), BRC_OK);
    assert_int_equal(brc_convex_of_domain(*state, domain, 5, &many), BRC_OK);
    assert_memory_equal(one.corner, many.corner, 24 * (size_t)one.corner_start[one.n]);
    assert_memory_equal(one.plane, many.plane, 32 * (size_t)one.face_start[one.n]);
    assert_memory_equal(one.loop_start, many.loop_start, 4 * (size_t)one.face_start[one.n]);
    assert_memory_equal(one.loop, many.loop, 4 * (size_t)one.loop_start[one.face_start[one.n]]);
    brc_convex_free(&one);
    brc_convex_free(&many);
    brc_domain_free(&domain);
}

/* Two cells that share a face have one plane, opposed, to rounding of positions. */
static void shared_faces_lie_in_one_plane(void **state)
{
    brc_build_request request = test_box(500, 0.9);
    brc_domain *d = test_build(*state, &request);
    brc_convex convex;
    assert_int_equal(brc_convex_of_domain(*state, d, 0, &convex), BRC_OK);
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const int64_t other = d->neighbour[h], back = d->twin[h] - d->row_start[other];
            const double *p = convex.plane + 4 * (convex.face_start[e] + h - d->row_start[e]),
                         *q = convex.plane + 4 * (convex.face_start[other] + back);
            double sum = p[3] + q[3];
            for (int k = 0; k < 3; ++k) {
                assert_true(p[k] == -q[k]);
                sum += p[k] * (d->position[3 * e + k] - d->position[3 * other + k]);
            }
            assert_near(sum, 0.0, 1e-15);
        }
    brc_convex_free(&convex);
    brc_domain_free(&d);
}

static brc_convex made;
static brc_rigid rigid, pieces;

/* The shape as one polyhedron: its own mass properties in `pieces`, those of the smooth shape in `rigid`. */
static void make(void **state, const brc_shape *shape, int32_t facets)
{
    assert_int_equal(brc_convex_of_shape(*state, shape, facets, 0, 1, &made, &rigid), BRC_OK);
    assert_int_equal(made.n, 1);
    brc_convex_mass(&made, 0, &pieces);
    assert_near(pieces.volume, rigid.volume, 1e-12 * rigid.volume);
    for (int k = 0; k < 3; ++k)
        assert_near(pieces.centre[k], 0.0, 1e-12 * made.radius[0]);
}

static void box_is_itself(void **state)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .origin = {1, 2, 3}, .size = {0.5, 0.25, 2}};
    make(state, &shape, 8);
    assert_int_equal(made.face_start[1], 6);
    assert_near(rigid.centre[2], 4.0, 0.0);
    for (int k = 0; k < 6; ++k)
        assert_near(pieces.inertia[k], rigid.inertia[k], 1e-15);
    brc_convex_free(&made);
}

/* A regular n-gon of the circle's area has theta (2 + cos theta) / (3 sin theta) of its polar moment, theta = 2 pi / n:
 * 1 + 8.7 / n^4; a body that is turned on it has no larger a share about any axis. Spheres have at least 0.9 n faces
 * around, whose solid angles differ by up to 2 (icosphere.h halves flat triangles), so sizes by 1.4. */
static void curved_shapes_keep_volume_and_nearly_inertia(void **state)
{
    const brc_shape shapes[4] = {
        {.kind = BRC_SHAPE_CYLINDER, .origin = {1, 0, 0}, .length = 0.7, .radius = 0.3, .axis = 0},
        {.kind = BRC_SHAPE_CONE, .origin = {0, 1, 0}, .length = 0.7, .radius = 0.3, .radius2 = 0.1, .axis = 1},
        {.kind = BRC_SHAPE_CONE, .origin = {0, 0, 1}, .length = 0.7, .radius = 0, .radius2 = 0.3, .axis = 2},
        {.kind = BRC_SHAPE_SPHERE, .origin = {-1, 2, 0.5}, .radius = 0.4}};
    for (int s = 0; s < 4; ++s)
        for (int n = 8; n <= 400; n += n < 64 ? 28 : 336) {
            make(state, shapes + s, n);
            const double theta = 2 * 3.14159265358979323846 / (s == 3 ? 0.9 / 1.4 * n : n),
                         share = theta * (2 + cos(theta)) / (3 * sin(theta));
            for (int k = 0; k < 3; ++k)
                assert_true(pieces.inertia[k] > rigid.inertia[k] * (1 - 1e-12) &&
                            pieces.inertia[k] < rigid.inertia[k] * (share + 1e-12));
            if (s == 0) assert_near(pieces.inertia[0], share * rigid.inertia[0], 1e-12 * rigid.inertia[0]);
            for (int32_t f = 0; f < made.face_start[1]; ++f)
                assert_true(made.loop_start[f + 1] - made.loop_start[f] <= BRC_CONVEX_PART);
            if (n == 64)
                printf("shape %d, %d around: %d faces, inertia over the smooth shape's %.6f %.6f %.6f\n", s, n,
                       made.face_start[1], pieces.inertia[0] / rigid.inertia[0], pieces.inertia[1] / rigid.inertia[1],
                       pieces.inertia[2] / rigid.inertia[2]);
            brc_convex_free(&made);
        }
}

/* A ring of n straight pieces. About its axis the polygon of the pieces has 1 + 2/3 (pi / n)^2 of the circle's moment
 * to the leading order, as it has the ring's volume, and the tubes 8.7 / n^4 more of theirs. */
static void ring_is_cut_into_straight_pieces(void **state)
{
    const double pi = 3.14159265358979323846, big = 1, small = 0.4, volume = 2 * pi * pi * big * small * small;
    const brc_shape torus = {.kind = BRC_SHAPE_TORUS, .origin = {1, 2, 3}, .radius = big, .radius2 = small, .axis = 1};
    for (int n = 8; n <= 400; n += n < 64 ? 28 : 336) {
        assert_int_equal(brc_convex_of_shape(*state, &torus, n, 0, 1, &made, &rigid), BRC_OK);
        assert_int_equal(made.n, n);
        assert_near(rigid.volume, volume, 1e-14 * volume);
        assert_near(rigid.inertia[1], volume * (big * big + 0.75 * small * small), 1e-14 * volume);
        assert_near(rigid.inertia[0], volume * (0.5 * big * big + 0.625 * small * small), 1e-14 * volume);
        double sum = 0, first[3] = {0, 0, 0}, about = 0;
        for (int32_t p = 0; p < n; ++p) {
            brc_convex_mass(&made, p, &pieces);
            sum += pieces.volume;
            about += pieces.inertia[1] +
                     pieces.volume * (pieces.centre[0] * pieces.centre[0] + pieces.centre[2] * pieces.centre[2]);
            for (int k = 0; k < 3; ++k)
                first[k] += pieces.volume * pieces.centre[k];
        }
        assert_near(sum, volume, 1e-12 * volume);
        for (int k = 0; k < 3; ++k)
            assert_near(first[k], 0, 1e-12 * volume);
        printf("ring, %d around: moment about its axis %.6f of the smooth one's\n", n, about / rigid.inertia[1]);
        assert_true(about > rigid.inertia[1] && about < rigid.inertia[1] * (1 + 2 * pi * pi / n / n));
        /* corners of the tube stand off it as those of a polygon of its area do, and the ring's beyond that */
        for (int32_t k = 0; k < made.corner_start[n]; ++k) {
            const double *x = made.corner + 3 * k, off = hypot(hypot(x[0], x[2]) - big, x[1]) - small;
            assert_true(fabs(off) < 8 * pi * pi / n / n * big / 6 + pi * pi / n / n * small);
        }
        brc_convex_free(&made);
    }
}

/* A ring as the only part of a shape of parts. */
static void what_is_not_convex_is_cut_into_cells(void **state)
{
    brc_shape_part part = {
        .shape = {.kind = BRC_SHAPE_TORUS, .origin = {1, 2, 3}, .radius = 1, .radius2 = 0.4, .axis = 2}};
    const brc_shape torus = {.kind = BRC_SHAPE_PARTS, .n_parts = 1, .parts = &part};
    assert_int_equal(brc_convex_of_shape(*state, &torus, 48, 400, 1, &made, &rigid), BRC_OK);
    assert_true(made.n > 200);
    const double pi = 3.14159265358979323846, volume = 2 * pi * pi * 0.16;
    printf("torus: %d pieces, volume %.4f, inertia about its axis %.4f of the exact\n", made.n, rigid.volume / volume,
           rigid.inertia[2] / (volume * (1 + 0.75 * 0.16)));
    /* tangent planes of 400 cells: what the domain builder promises of curved walls is a percent or two */
    assert_near(rigid.volume, volume, 0.05 * volume);
    assert_near(rigid.inertia[2], volume * (1 + 0.75 * 0.16), 0.08 * volume);
    for (int k = 0; k < 3; ++k)
        assert_near(rigid.centre[k], part.shape.origin[k], 0.01);
    brc_convex_free(&made);
}

static void wrong_input_is_refused(void **state)
{
    const brc_shape shape = {.kind = BRC_SHAPE_SPHERE, .radius = 1}, flat = {.kind = BRC_SHAPE_BOX, .size = {1, 0, 1}};
    assert_int_equal(brc_convex_of_shape(*state, &shape, 7, 0, 1, &made, &rigid), BRC_BAD_INPUT);
    test_says(*state, "at least 8");
    assert_int_equal(brc_convex_of_shape(*state, &flat, 8, 0, 1, &made, &rigid), BRC_BAD_INPUT);
    brc_build_request request = test_sphere(300, 0.5);
    request.fill = (brc_fill){.kind = BRC_FILL_PACKING, .n_elements = 300, .volume_fraction = 0.3, .seed = 1};
    request.beams = 8;
    brc_domain *domain = test_build(*state, &request);
    assert_int_equal(brc_convex_of_domain(*state, domain, 1, &made), BRC_BAD_INPUT);
    test_says(*state, "spheres have no faces");
    brc_domain_free(&domain);
}

/* A cube with one corner pushed in by a tenth. */
static void what_is_not_convex_is_found(void **state)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    make(state, &shape, 8);
    assert_int_equal(brc_convex_check(*state, &made, 1e-15), BRC_OK);
    made.corner[0] += 0.1;
    assert_int_equal(brc_convex_check(*state, &made, 1e-6), BRC_INTERNAL);
    brc_convex_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cells_keep_their_volume_and_centre, test_begin, test_end),
        cmocka_unit_test_setup_teardown(random_cells_stay_far_below_the_limits, test_begin, test_end),
        cmocka_unit_test_setup_teardown(threads_do_not_change_a_number, test_begin, test_end),
        cmocka_unit_test_setup_teardown(shared_faces_lie_in_one_plane, test_begin, test_end),
        cmocka_unit_test_setup_teardown(box_is_itself, test_begin, test_end),
        cmocka_unit_test_setup_teardown(curved_shapes_keep_volume_and_nearly_inertia, test_begin, test_end),
        cmocka_unit_test_setup_teardown(ring_is_cut_into_straight_pieces, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_is_not_convex_is_cut_into_cells, test_begin, test_end),
        cmocka_unit_test_setup_teardown(wrong_input_is_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_is_not_convex_is_found, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
