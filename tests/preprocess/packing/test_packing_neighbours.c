#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/packing/soft_spheres.h"

#include <stdlib.h>

enum { N = 1300 }; /* more than two blocks, the last one not full */

/* Radii over a factor of ten; a third of the spheres crowd in one corner, so that rows are of very different
 * lengths. */
static void scatter(brc_pack *pack)
{
    for (int64_t i = 0; i < N; ++i) {
        double u[4], x[3];
        brc_random_uniform4(11, BRC_RANDOM_TEST, (uint64_t)i, 0, u);
        for (int c = 0; c < 3; ++c)
            x[c] = (i % 3 ? 1.0 : 0.1) * u[c] * (c == 0 ? 3.0 : 1.0);
        brc_pack_put(pack, i, x, 0.01 + 0.09 * u[3]);
    }
    brc_pack_set_radii(pack, 0.055, 0.1);
}

static int ascending(const void *a, const void *b)
{
    return *(const int32_t *)a - *(const int32_t *)b;
}

static void the_list_holds_every_near_pair_from_both_sides(void **state)
{
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {3.0, 1.0, 1.0}};
    const double skins[3] = {
        0.001, 0.05, 0.4}; /* growing, so that the rows outgrow their room; and so wide that three cells span the box */
    brc_solid *solid;
    brc_pack *pack;
    assert_int_equal(brc_solid_create(*state, &box, 1, &solid), BRC_OK);
    assert_int_equal(brc_pack_create(*state, solid, N, 2, &pack), BRC_OK);
    scatter(pack);
    static int32_t row[N];
    for (int s = 0; s < 3; ++s) {
        assert_int_equal(brc_pack_list(pack, skins[s]), BRC_OK);
        for (int64_t i = 0; i < N; ++i) {
            const int32_t *found;
            int64_t step;
            const int64_t n = brc_pack_neighbours(pack, i, &found, &step);
            assert_in_range(n, 0, N);
            for (int64_t k = 0; k < n; ++k)
                row[k] = found[k * step];
            qsort(row, (size_t)n, sizeof *row, ascending);
            int64_t k = 0;
            for (int64_t j = 0; j < N; ++j) {
                const double *const a = brc_pack_spheres(pack)[i], *const b = brc_pack_spheres(pack)[j];
                const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2], reach = a[3] + skins[s] + b[3];
                if (i == j || x * x + y * y + z * z >= reach * reach) continue;
                if (k >= n || row[k] != j) fail_msg("sphere %d misses %d", (int)i, (int)j);
                ++k;
            }
            assert_int_equal(k, n);
        }
    }
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

static void a_sphere_outside_goes_back_to_where_it_was_inside(void **state)
{
    const brc_shape ball = {.kind = BRC_SHAPE_SPHERE, .radius = 1.0};
    brc_solid *solid;
    brc_pack *pack;
    assert_int_equal(brc_solid_create(*state, &ball, 1, &solid), BRC_OK);
    assert_int_equal(brc_pack_create(*state, solid, 1, 1, &pack), BRC_OK);
    brc_pack_put(pack, 0, (const double[3]){0.97, 0, 0}, 0.1);
    brc_pack_set_radii(pack, 0.1, 0.1);
    brc_pack_spheres(pack)[0][0] = 1.02;
    assert_int_equal(brc_pack_list(pack, 0.01), BRC_OK);
    assert_near(brc_pack_spheres(pack)[0][0], 0.97, 0.0);
    assert_int_equal(brc_pack_wall_contacts(pack, 0), 1);
    /* one plane x = 1, 0.03 away: rounding of 0.07 and its square */
    const double(*force)[3], overlap = 0.1 - (1 - 0.97);
    assert_near(brc_pack_forces(pack, &force).energy, overlap * overlap, 1e-15);
    assert_near(force[0][0], -2 * overlap, 1e-15);
    assert_near(force[0][1], 0.0, 1e-15);
    assert_near(force[0][2], 0.0, 1e-15);
    brc_pack_free(&pack);
    brc_solid_free(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_list_holds_every_near_pair_from_both_sides, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_sphere_outside_goes_back_to_where_it_was_inside, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
