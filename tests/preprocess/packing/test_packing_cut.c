/* Samples cut out of a larger packing: as many as asked for, inside, and without layers along the walls. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <math.h>
#include "../../../preprocess/packing/packing.h"
#include "../support.h"

static const brc_fill FILL = {.kind = BRC_FILL_PACKING,
                              .n_elements = 2000,
                              .radius_spread = 0.125,
                              .coordination = 6.2,
                              .tolerance = 0.02,
                              .seed = 3};

static void pack(brc_context *context, bool cut, const brc_shape *shape, brc_packing *out)
{
    brc_solid *solid = NULL;
    assert_int_equal(brc_solid_create(context, shape, 1, &solid), BRC_OK);
    assert_int_equal((cut ? brc_packing_cut : brc_packing_make)(context, solid, &FILL, 1, out), BRC_OK);
    for (int64_t e = 0; e < out->n; ++e)
        assert_true(brc_solid_inside(solid, out->position + 3 * e, 0.0));
    brc_solid_free(&solid);
}

/* Share of the centres that lie between 0.4 and 0.6 mean diameters from the faces x = 0 and x = 1 of a unit cube. */
static double share_beside_walls(const brc_packing *p)
{
    double diameter = 0;
    int64_t n = 0;
    for (int64_t e = 0; e < p->n; ++e)
        diameter += 2 * p->radius[e] / (double)p->n;
    for (int64_t e = 0; e < p->n; ++e) {
        const double depth = fmin(p->position[3 * e], 1 - p->position[3 * e]) / diameter;
        n += depth > 0.4 && depth < 0.6;
    }
    return (double)n / (double)p->n / (2 * 0.2 * diameter); /* 1 where centres are spread evenly */
}

static void a_cut_packing_has_no_layer_at_its_walls(void **state)
{
    const brc_shape cube = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    brc_packing touching, cut;
    pack(*state, false, &cube, &touching);
    pack(*state, true, &cube, &cut);
    /* every sphere that touches a wall stands at its radius, 0.44 to 0.56 diameters: a third and more of a layer of one
     * diameter in a fifth of it. Cut by the wall they are spread evenly: 1, give or take three standard deviations of a
     * Poisson count of some 70. */
    assert_true(share_beside_walls(&touching) > 2);
    assert_true(fabs(share_beside_walls(&cut) - 1) < 3 / sqrt(70));
    brc_packing_free(&touching);
    brc_packing_free(&cut);
}

static void a_cut_packing_has_nearly_the_number_asked_for(void **state)
{
    const brc_shape shapes[2] = {{.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}}, {.kind = BRC_SHAPE_SPHERE, .radius = 1}};
    for (int k = 0; k < 2; ++k) {
        brc_packing cut;
        pack(*state, true, &shapes[k], &cut);
        /* what lies within 0.05 diameters of the wall is dropped: 0.05 * 6 * diameter(0.08) = 2.5 %; and the larger
         * packing is denser than its outermost layer, some 3 % */
        assert_true(fabs((double)cut.n / (double)FILL.n_elements - 1) < 0.06);
        brc_packing_free(&cut);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_cut_packing_has_no_layer_at_its_walls, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_cut_packing_has_nearly_the_number_asked_for, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
