/* The size of samples of spheres by their walls, on positions that are counted by hand. */
#include "../support.h"
#include "../../../host/output/sensors/sphere_box.h"
#include <math.h>

/* Eight corners of a box 3 x 4 x 5 m of centres, the x- side pulled in by 0.1 m at one corner, spheres of 0.5 and 0.7 m
 * in turn: mean diameter 1.2 m. Two more are the "side" of a cylinder along x. */
enum { N = 8 };
static double position[3 * N], radius[N];
static int32_t member[6][4], side_member[N] = {0, 1, 2, 3, 4, 5, 6, 7};
static char names[6][3] = {"x-", "x+", "y-", "y+", "z-", "z+"};
static char side[] = "side";
static brc_set sets[6];
static int64_t row_start[N + 1];

static brc_domain make(bool cylinder)
{
    for (int k = 0; k < N; ++k) {
        for (int c = 0; c < 3; ++c) {
            const int high = k >> c & 1;
            position[3 * k + c] = high * (3 + c);
            member[2 * c + high][(c == 0 ? k >> 1 : c == 1 ? (k & 1) + (k >> 2) * 2 : k & 3)] = k;
        }
        radius[k] = k % 2 ? 0.7 : 0.5;
    }
    position[0] = 0.1;
    for (int k = 0; k <= N; ++k)
        row_start[k] = k; /* a bond each */
    for (int s = 0; s < 6; ++s)
        sets[s] = (brc_set){.name = names[s], .kind = BRC_SET_ELEMENTS, .n_members = 4, .members = member[s]};
    if (cylinder) sets[2] = (brc_set){.name = side, .kind = BRC_SET_ELEMENTS, .n_members = N, .members = side_member};
    return (brc_domain){.element_kind = BRC_ELEMENT_SPHERE,
                        .n_elements = N,
                        .position = position,
                        .radius = radius,
                        .row_start = row_start,
                        .n_sets = cylinder ? 3 : 6,
                        .sets = sets};
}

static void a_length_is_the_distance_of_mean_positions_and_a_mean_diameter(void **state)
{
    (void)state;
    const brc_domain d = make(false);
    assert_true(fabs(brc_sphere_mean_diameter(&d) - 1.2) < 1e-15);
    assert_true(fabs(brc_sphere_box_length(&d, 1, 0, 0) - (3 - 0.025 + 1.2)) < 1e-14);
    assert_true(fabs(brc_sphere_box_length(&d, 0, 1, 0) + (3 - 0.025 + 1.2)) <
                1e-14); /* the other way round: negative */
}

/* The sphere that was pulled in has no bond: the x- side stands where the other three are. The mean diameter counts
 * all. */
static void spheres_without_bonds_count_in_no_wall(void **state)
{
    (void)state;
    const brc_domain d = make(false);
    for (int k = 1; k <= N; ++k)
        row_start[k] = k - 1;
    assert_false(brc_sphere_is_bonded(&d, 0));
    assert_int_equal(brc_sphere_count_bonded(&d, &sets[0]), 3);
    assert_int_equal(brc_sphere_count_bonded(&d, &sets[1]), 4);
    assert_true(fabs(brc_sphere_box_length(&d, 1, 0, 0) - (3 + 1.2)) < 1e-14);
}

static void the_section_of_a_box_is_that_of_its_other_walls(void **state)
{
    (void)state;
    const brc_domain d = make(false);
    for (int end = 0; end < 2; ++end)
        assert_true(fabs(brc_sphere_box_section(&d, end) - (4 + 1.2) * (5 + 1.2)) < 1e-13);
    assert_true(fabs(brc_sphere_box_section(&d, 2) - (3 - 0.025 + 1.2) * (5 + 1.2)) < 1e-13);
}

static void the_section_of_a_cylinder_is_round(void **state)
{
    (void)state;
    const brc_domain d = make(true);
    const double r = hypot(2, 2.5) + 0.6;
    assert_true(fabs(brc_sphere_box_section(&d, 1) - M_PI * r * r) < 1e-12);
}

static void what_is_no_end_wall_has_no_section(void **state)
{
    (void)state;
    const brc_domain round = make(true);
    assert_true(isnan(brc_sphere_box_section(&round, 2)));
    assert_true(isnan(brc_sphere_box_section(&round, -1)));
    brc_domain d = make(false);
    sets[1].name = (char[]){"core"};
    assert_true(isnan(brc_sphere_box_section(&d, 1)));
    sets[1].name = (char[]){"x+"};
    d.n_sets = 4; /* the z walls are not there */
    assert_true(isnan(brc_sphere_box_section(&d, 1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_length_is_the_distance_of_mean_positions_and_a_mean_diameter),
        cmocka_unit_test(spheres_without_bonds_count_in_no_wall),
        cmocka_unit_test(the_section_of_a_box_is_that_of_its_other_walls),
        cmocka_unit_test(the_section_of_a_cylinder_is_round),
        cmocka_unit_test(what_is_no_end_wall_has_no_section),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
