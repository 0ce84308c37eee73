#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/packing/soft_spheres.h"

#include <string.h>

/* n spheres of radius 0.8 to 1.2 m at random points of the solid. */
static void scatter(brc_pack *pack, int64_t n, const brc_solid *solid, uint64_t seed)
{
    double bounds[2][3];
    brc_solid_bounds(solid, bounds);
    for (int64_t i = 0, draw = 0; i < n; ++draw) {
        double u[4], x[3];
        brc_random_uniform4(seed, BRC_RANDOM_TEST, (uint64_t)draw, 0, u);
        for (int c = 0; c < 3; ++c)
            x[c] = bounds[0][c] + u[c] * (bounds[1][c] - bounds[0][c]);
        brc_pack_put(pack, i, x, 0.8 + 0.4 * u[3]);
        i += brc_solid_inside(solid, x, 0.2);
    }
    brc_pack_set_radii(pack, 1.0, 1.2);
}

static void make(brc_context *context, const brc_shape *shape, int64_t n, int n_threads, brc_solid **solid,
                 brc_pack **pack)
{
    if (brc_solid_create(context, shape, n_threads, solid) != BRC_OK) fail_msg("%s", brc_context_message(context));
    assert_int_equal(brc_pack_create(context, *solid, n, n_threads, pack), BRC_OK);
    scatter(*pack, n, *solid, 3);
}

static const brc_shape CAN = {.kind = BRC_SHAPE_CYLINDER, .length = 8.0, .radius = 4.0, .axis = 1};

/* Two unit spheres in a row in a box 0.4 m too short: pair overlap o and wall overlap w balance as o = 2 w, and 2 w + o
 * = 0.4. */
static void two_spheres_in_a_tight_box_rest_where_statics_says(void **state)
{
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {3.6, 2.0, 2.0}};
    brc_solid *solid;
    brc_pack *pack;
    brc_pack_sums sums;
    bool converged;
    make(*state, &box, 2, 1, &solid, &pack);
    const double start[2][4] = {{0.7, 1.1, 0.8, 1.0}, {2.4, 0.7, 1.3, 1.0}};
    for (int i = 0; i < 2; ++i)
        brc_pack_put(pack, i, start[i], start[i][3]);
    assert_int_equal(brc_pack_relax(pack, 1e-9, 100000, &sums, &converged), BRC_OK);
    assert_true(converged);
    /* a residual of 1e-9 of the force 0.2 on springs of stiffness 1 and more */
    const double rest[2][3] = {{0.9, 1.0, 1.0}, {2.7, 1.0, 1.0}};
    for (int i = 0; i < 2; ++i)
        for (int c = 0; c < 3; ++c)
            assert_near(brc_pack_spheres(pack)[i][c], rest[i][c], 1e-8);
    assert_near(sums.energy, 0.5 * 0.2 * 0.2 + 2.0 * 0.1 * 0.1, 1e-8);
    assert_int_equal(sums.contact_ends, 2);
    assert_near(sums.contact_force, 2.0 * 0.2, 1e-8);
    assert_near(sums.overlap, 2.0 * 0.2 / 1.8, 1e-8);
    assert_true(sums.wall_contacts >= 2);
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

static double energy_at(brc_pack *pack, int64_t i, int axis, double x)
{
    brc_pack_spheres(pack)[i][axis] = x;
    assert_int_equal(brc_pack_list(pack, 0.3), BRC_OK); /* every wall is asked anew */
    return brc_pack_forces(pack, NULL).energy;
}

/* Central differences of the energy (about 60 m^2): truncation h^2 times a third derivative of some 10, rounding 60 *
 * 1e-16 / h; together below 1e-8 at h = 1e-5, and contacts that open within h add h: 1e-5. Walls: ends and the curved
 * side of a cylinder. */
static void forces_are_the_gradient_of_the_energy(void **state)
{
    enum { N = 80 };
    const double h = 1e-5;
    brc_solid *solid;
    brc_pack *pack;
    make(*state, &CAN, N, 1, &solid, &pack);
    assert_int_equal(brc_pack_list(pack, 0.3), BRC_OK);
    const double(*now)[3];
    const brc_pack_sums sums = brc_pack_forces(pack, &now);
    assert_true(sums.wall_contacts > 20 && sums.contact_ends > 100);
    double force[N][3];
    memcpy(force, now, sizeof force);
    for (int64_t i = 0; i < N; ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = brc_pack_spheres(pack)[i][c];
            const double slope = (energy_at(pack, i, c, x + h) - energy_at(pack, i, c, x - h)) / (2.0 * h);
            brc_pack_spheres(pack)[i][c] = x;
            assert_near(force[i][c], -slope, 2e-5);
        }
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

static double brute_energy(brc_pack *pack, int64_t n, const brc_solid *solid, int64_t *ends)
{
    double energy = 0.0;
    *ends = 0;
    for (int64_t i = 0; i < n; ++i) {
        const double *const a = brc_pack_spheres(pack)[i];
        for (int64_t j = 0; j < i; ++j) {
            const double *const b = brc_pack_spheres(pack)[j];
            const double d = sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2)), o = a[3] + b[3] - d;
            if (o <= 0.0) continue;
            energy += 0.5 * o * o;
            *ends += 2;
        }
        brc_foot feet[8];
        const int32_t n_feet = brc_solid_feet(solid, a, a[3], feet, 8);
        for (int32_t k = 0; k < n_feet; ++k)
            energy += pow(a[3] - feet[k].depth, 2);
    }
    return energy;
}

/* Relaxing moves spheres by their own size; the lists must have been renewed whenever needed. In a box every wall is a
 * plane, so that nothing but rounding may differ from a sum over all pairs and walls. Energy falls. */
static void lists_stay_good_while_spheres_move(void **state)
{
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {14.0, 12.0, 10.0}};
    brc_solid *solid;
    brc_pack *pack;
    make(*state, &box, 700, 1, &solid, &pack);
    int64_t ends;
    double before = brute_energy(pack, 700, solid, &ends);
    for (int64_t most = 1; most < 200; most *= 4) {
        brc_pack_sums sums;
        bool converged;
        assert_int_equal(brc_pack_relax(pack, 1e-12, most, &sums, &converged), BRC_OK);
        assert_false(converged);
        const brc_pack_sums now = brc_pack_forces(pack, NULL);
        const double energy = brute_energy(pack, 700, solid, &ends);
        assert_near(now.energy / energy, 1.0, 1e-12);
        assert_int_equal(now.contact_ends, ends);
        assert_true(energy < before);
        before = energy;
    }
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

/* Curved walls are planes through their feet, asked again after 0.02 R: the depth is off by at most (0.02 R)^2 / (2 * 4
 * R), 5e-5 R, so the overlaps of about 0.1 R with the wall are within a part in a thousand, and energies within two. */
static void curved_walls_are_followed(void **state)
{
    brc_solid *solid;
    brc_pack *pack;
    brc_pack_sums sums;
    bool converged;
    make(*state, &CAN, 100, 1, &solid, &pack);
    for (int k = 0; k < 5; ++k) {
        assert_int_equal(brc_pack_relax(pack, 1e-12, 17, &sums, &converged), BRC_OK);
        int64_t ends;
        assert_near(brc_pack_forces(pack, NULL).energy / brute_energy(pack, 100, solid, &ends), 1.0, 2e-3);
    }
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

static void the_sum_of_inner_forces_is_zero(void **state)
{
    const brc_shape room = {.kind = BRC_SHAPE_SPHERE, .radius = 20.0};
    brc_solid *solid;
    brc_pack *pack;
    make(*state, &room, 3000, 1, &solid, &pack);
    for (int64_t i = 0; i < 3000; ++i) /* nobody near the wall */
        for (int c = 0; c < 3; ++c)
            brc_pack_spheres(pack)[i][c] *= 0.9;
    assert_int_equal(brc_pack_list(pack, 0.1), BRC_OK);
    const double(*force)[3];
    const brc_pack_sums sums = brc_pack_forces(pack, &force);
    assert_int_equal(sums.wall_contacts, 0);
    double sum[3] = {0.0};
    for (int64_t i = 0; i < 3000; ++i)
        for (int c = 0; c < 3; ++c)
            sum[c] += force[i][c];
    /* rounding of some 10^4 terms of size 1 */
    for (int c = 0; c < 3; ++c)
        assert_near(sum[c], 0.0, 1e-11);
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

static void spheres_that_do_not_touch_are_at_rest_at_once(void **state)
{
    const brc_shape room = {.kind = BRC_SHAPE_SPHERE, .radius = 20.0};
    brc_solid *solid;
    brc_pack *pack;
    brc_pack_sums sums;
    bool converged;
    make(*state, &room, 2, 1, &solid, &pack);
    const double x[2][4] = {{-2.0, 0.0, 0.0, 1.0}, {2.0, 0.0, 0.0, 1.0}};
    for (int i = 0; i < 2; ++i)
        brc_pack_put(pack, i, x[i], x[i][3]);
    assert_int_equal(brc_pack_relax(pack, 1e-3, 1, &sums, &converged), BRC_OK);
    assert_true(converged);
    assert_memory_equal(brc_pack_spheres(pack), x, sizeof x);
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(two_spheres_in_a_tight_box_rest_where_statics_says, test_begin, test_end),
        cmocka_unit_test_setup_teardown(forces_are_the_gradient_of_the_energy, test_begin, test_end),
        cmocka_unit_test_setup_teardown(lists_stay_good_while_spheres_move, test_begin, test_end),
        cmocka_unit_test_setup_teardown(curved_walls_are_followed, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_sum_of_inner_forces_is_zero, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_that_do_not_touch_are_at_rest_at_once, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
