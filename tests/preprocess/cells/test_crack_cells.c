#include "../support.h"

#include <string.h>

/* The cube of 1 m with one crack, built as scenes are. */
static brc_domain *cracked(brc_context *context, int64_t n, double spread, uint64_t seed, const brc_crack *crack)
{
    brc_build_request request = test_box(n * n * n, spread);
    request.fill.seed = seed;
    request.n_cracks = 1;
    request.cracks = crack;
    brc_domain *domain = test_build(context, &request);
    if (brc_domain_check(context, domain) != BRC_OK) fail_msg("%s", brc_context_message(context));
    return domain;
}

static brc_crack through(double height, double slope)
{
    return (brc_crack){.name = "through",
                       .kind = BRC_CRACK_RECTANGLE,
                       .point = {-1.0, -1.0, height - 1.5 * slope},
                       .edge = {{3.0, 0.0, 0.0}, {0.0, 3.0, 3.0 * slope}},
                       .flat = true};
}

static brc_crack penny(double radius)
{
    return (brc_crack){.name = "penny",
                       .kind = BRC_CRACK_DISC,
                       .point = {0.5, 0.5, 0.5},
                       .normal = {0.0, 0.0, 2.0},
                       .radius = radius,
                       .flat = true};
}

/* Where nothing is promised (cracks.h): a seam of one spacing along the rim, and two spacings from walls that the plane
 * meets at a slant. */
static bool in_seam(const brc_crack *crack, double spacing, const double x[3])
{
    if (crack->kind == BRC_CRACK_DISC)
        return hypot(x[0] - crack->point[0], x[1] - crack->point[1]) > crack->radius - spacing;
    return crack->edge[1][2] != 0.0 && (x[1] < 2.0 * spacing || x[1] > 1.0 - 2.0 * spacing);
}

/* Sum of areas of the crack's faces that look up along n. *worst: the largest height over the plane of a face's
 * centroid, and of its rim by its tilt over half a spacing, outside of the seam. */
static double area_of_cut(const brc_domain *d, const brc_crack *crack, double spacing, const double n[3], double *worst)
{
    const brc_set *set = &d->sets[brc_domain_find_set(d, crack->name)];
    double area = 0.0;
    *worst = 0.0;
    assert_true(set->n_members > 0);
    for (int64_t m = 0; m < set->n_members; ++m) {
        const int64_t f = set->members[m];
        const double *s = d->free_area_vector + 3 * f, *x = d->free_centroid + 3 * f;
        const double tilted[3] = {s[1] * n[2] - s[2] * n[1], s[2] * n[0] - s[0] * n[2], s[0] * n[1] - s[1] * n[0]};
        const double size = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        double height = 0.0, up = 0.0, tilt = 0.0;
        for (int k = 0; k < 3; ++k) {
            height += (x[k] - crack->point[k]) * n[k];
            up += s[k] * n[k];
            tilt += tilted[k] * tilted[k];
        }
        if (up > 0.0) area += size;
        if (!in_seam(crack, spacing, x)) *worst = fmax(*worst, fabs(height) + 0.5 * spacing * sqrt(tilt) / size);
    }
    return area;
}

/* Heights to 1e-12 m: images are exact to 1e-16 m, and bisectors of branches of at least 0.05 m tilt by 1e-15. Areas
 * sum to the section to the rounding of corners, 1e-14 of a cell's 1e-2 m^2 each, for some hundred cells. */
static void a_crack_through_a_box_has_all_faces_in_its_plane_and_its_area(void **state)
{
    const double heights[] = {0.5, 0.47, 0.15};
    static const double up[3] = {0.0, 0.0, 1.0};
    for (int k = 0; k < 3; ++k)
        for (uint64_t seed = 0; seed < 3; ++seed) {
            const brc_crack crack = through(heights[k], 0.0);
            brc_domain *d = cracked(*state, 10, seed == 0 ? 0.0 : 0.9, seed, &crack);
            double worst;
            assert_near(area_of_cut(d, &crack, 0.1, up, &worst), 1.0, 1e-12);
            assert_near(worst, 0.0, 1e-12);
            assert_near(test_worst_closure(d), 0.0, 1e-12);
            assert_near(test_worst_first_moment(d), 0.0, 1e-12);
            brc_domain_free(&d);
        }
}

static void a_slanted_crack_is_flat_but_near_the_walls_it_meets_at_a_slant(void **state)
{
    for (uint64_t seed = 0; seed < 3; ++seed) {
        const brc_crack crack = through(0.5, 0.3);
        const double length = sqrt(1.09), normal[3] = {0.0, -0.3 / length, 1.0 / length};
        brc_domain *d = cracked(*state, 10, seed == 0 ? 0.0 : 0.9, seed, &crack);
        double worst;
        const double area = area_of_cut(d, &crack, 0.1, normal, &worst);
        assert_near(worst, 0.0, 1e-12);
        assert_true(area >
                    length * (1.0 - 1e-12)); /* its projection along z is the section, and rough parts only add */
        assert_true(
            area < 1.1 * length); /* faces of the four spacings near walls may be rough, as all are without mirroring */
        brc_domain_free(&d);
    }
}

/* Within one spacing of the rim nothing is promised. The area is that of the cells over the disc, whose rim is a row of
 * 2 pi r / h cells, each in or out as a whole: it is off by a random sum of half cells, about sqrt(2 pi r / h) h^2 / 2,
 * four times that at most; and rough faces of the seam stand off the plane, which adds to their area at most one row of
 * cells. */
static void a_flat_penny_lies_in_its_plane_and_has_its_area_but_for_the_rim(void **state)
{
    for (int64_t n = 10; n <= 20; n += 10) {
        const brc_crack crack = penny(0.3);
        const double h = 1.0 / (double)n, normal[3] = {0.0, 0.0, 1.0}, exact = 3.14159265358979 * 0.09,
                     row = 6.283185307 * 0.3 / h;
        brc_domain *d = cracked(*state, n, 0.9, 5, &crack);
        double worst;
        const double area = area_of_cut(d, &crack, h, normal, &worst);
        assert_near(worst, 0.0, 1e-12);
        assert_true(area > exact - 2.0 * sqrt(row) * h * h);
        assert_true(area < exact + 2.0 * sqrt(row) * h * h + row * h * h);
        print_message("%lld cells, spacing %.3g: area of the penny off by %+.1f %%\n", (long long)d->n_elements, h,
                      100.0 * (area / exact - 1.0));
        brc_domain_free(&d);
    }
}

/* A section of a cylinder and a great circle of a sphere, with the body turned and moved: cracks are given where it
 * stands then. */
static void cracks_in_turned_and_round_bodies_are_flat(void **state)
{
    for (int k = 0; k < 2; ++k) {
        brc_build_request request = k ? test_sphere(4000, 0.9) : test_cylinder(4000, 0.9);
        const double radius = k ? 0.5 : 0.3, turn = 0.7, far = 20.0;
        request.rotation[2] = turn;
        request.translation[0] = far;
        brc_crack crack = {
            .name = "slit", .kind = BRC_CRACK_DISC, .normal = {cos(turn), sin(turn), 0.0}, .radius = 1.0, .flat = true};
        crack.point[0] =
            far + (k ? 0.0 : 0.5 * cos(turn)); /* the cylinder begins at its end and lies along x before it is turned */
        crack.point[1] = k ? 0.0 : 0.5 * sin(turn);
        request.n_cracks = 1;
        request.cracks = &crack;
        brc_domain *d = test_build(*state, &request);
        if (brc_domain_check(*state, d) != BRC_OK) fail_msg("%s", brc_context_message(*state));
        const brc_set *set = &d->sets[brc_domain_find_set(d, "slit")];
        double area = 0.0, height = 0.0;
        int64_t n_off = 0;
        for (int64_t m = 0; m < set->n_members; ++m) {
            const double *s = d->free_area_vector + 3 * (int64_t)set->members[m],
                         *x = d->free_centroid + 3 * (int64_t)set->members[m];
            area += 0.5 * sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
            const double off =
                fabs((x[0] - crack.point[0]) * crack.normal[0] + (x[1] - crack.point[1]) * crack.normal[1]);
            n_off += off > 1e-12;
            if (k && hypot(hypot(x[0] - crack.point[0], x[1] - crack.point[1]), x[2]) > radius - 0.051)
                continue; /* a spacing: see cracks.h */
            height = fmax(height, off);
        }
        print_message("%s: %lld of %lld faces are off the plane of the crack\n", k ? "sphere" : "cylinder",
                      (long long)n_off, (long long)set->n_members);
        assert_near(height, 0.0, 1e-12); /* rounding of positions of 20 m is 4e-15 m */
        /* the section of the planes that stand for the curved wall: they have the body's volume, and are at least 32
         * round it (docs/reference/domain.md): a regular polygon of 32 sides reaches from 0.995 to 1.005 of the
         * radius */
        assert_near(area / (3.14159265358979 * radius * radius), 1.0, 0.01);
        brc_domain_free(&d);
    }
}

static void cracks_and_grains_do_not_depend_on_the_number_of_threads(void **state)
{
    const double share[1] = {0.4};
    const brc_crack crack = penny(0.3);
    brc_build_request request = test_box(3000, 0.9);
    request.n_cracks = 1;
    request.cracks = &crack;
    request.grains = (brc_grains){.n = 40, .seed = 2, .n_phases = 1, .fraction = share};
    brc_domain *one = test_build(*state, &request);
    request.n_threads = 3;
    brc_domain *three = test_build(*state, &request);
    const size_t n = (size_t)one->n_elements, faces = (size_t)one->n_free_faces;
    assert_int_equal(three->n_elements, n);
    assert_int_equal(three->n_free_faces, faces);
    assert_int_equal(three->n_bonds, one->n_bonds);
    assert_memory_equal(one->position, three->position, 3 * n * sizeof(double));
    assert_memory_equal(one->grain, three->grain, n * sizeof(int32_t));
    assert_memory_equal(one->region, three->region, n * sizeof(int32_t));
    assert_memory_equal(one->free_area_vector, three->free_area_vector, 3 * faces * sizeof(double));
    assert_memory_equal(one->free_wall, three->free_wall, faces * sizeof(int32_t));
    assert_memory_equal(one->free_polygon, three->free_polygon,
                        (size_t)one->free_polygon_start[faces] * sizeof(int32_t));
    brc_domain_free(&one);
    brc_domain_free(&three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_crack_through_a_box_has_all_faces_in_its_plane_and_its_area, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(a_slanted_crack_is_flat_but_near_the_walls_it_meets_at_a_slant, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(a_flat_penny_lies_in_its_plane_and_has_its_area_but_for_the_rim, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(cracks_in_turned_and_round_bodies_are_flat, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cracks_and_grains_do_not_depend_on_the_number_of_threads, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
