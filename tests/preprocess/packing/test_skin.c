#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/packing/beams.h"
#include "../../../preprocess/packing/packing.h"
#include "../../../preprocess/packing/skin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void require(brc_context *context, brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

/* Spheres of diameter 1 on a simple cubic lattice that fills a box of SIDE^3, each joined to its six neighbours. */
enum { SIDE = 12 };

static brc_solid *lattice(brc_context *context, brc_domain **out)
{
    const int64_t n = SIDE * SIDE * SIDE, bonds = 3 * SIDE * SIDE * (SIDE - 1);
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {SIDE, SIDE, SIDE}};
    double *position, *radius;
    brc_solid *solid;
    brc_domain *domain;
    require(context, brc_solid_create(context, &box, 1, &solid));
    require(context, BRC_ALLOCATE(context, &position, 3 * n, "test"));
    require(context, BRC_ALLOCATE(context, &radius, n, "test"));
    require(context, BRC_ALLOCATE(context, &domain, 1, "test"));
    for (int64_t e = 0; e < n; ++e) {
        position[3 * e] = 0.5 + (double)(e % SIDE);
        position[3 * e + 1] = 0.5 + (double)(e / SIDE % SIDE);
        position[3 * e + 2] = 0.5 + (double)(e / (SIDE * SIDE));
        radius[e] = 0.5;
    }
    require(context,
            brc_beams_build(context, solid, position, radius, n, 2.0 * (double)bonds / (double)n, false, 1, domain));
    *out = domain;
    return solid;
}

/* Tolerance: sums of some 1e4 numbers of equal size, and random points that fall into the right cells whatever they
 * are. */
static void lattice_has_the_stiffness_that_can_be_counted_by_hand(void **state)
{
    static const double rounding = 1e-9;
    brc_context *context = *state;
    brc_domain *domain;
    brc_skin skin;
    brc_solid *solid = lattice(context, &domain);
    require(context, brc_skin_measure(context, solid, domain, 1, &skin));
    assert_near(skin.diameter, 1, rounding);
    /* What no second wall is near to is a square of 7 by 7, on whose rim spheres stand: 8 lines of beams 7 long each
     * way in a layer of spheres, in the quarter of a diameter that begins at its depth, with 3/8 of n_t^4 each; 8 by 8
     * lines across everywhere below the first spheres. The core, 7 by 7 by 7, has 3 by 8 by 8 lines; of its length
     * n_t^4 without a preferred direction is 1/5. */
    const double dense = 3.0 * 8 * 8 * 7 / (7 * 7 * 7), along = 2 * 8 * 7 * 3.0 / 8 / (7 * 7 * 0.25) / (dense / 5),
                 across = 8.0 * 8 / (7 * 7) / (dense / 5);
    for (int k = 0; k < BRC_SKIN_LAYERS; ++k) {
        const bool holds = k == 2 || k == 6; /* depths 0.5 and 1.5; 2.5 is the core's */
        const brc_skin_layer *layer = &skin.layer[k];
        assert_near(layer->volume, 6 * 7 * 7 * 0.25, rounding); /* no second wall within 2.5 */
        assert_int_equal(layer->n_elements, holds ? 6 * 8 * 8 : 0);
        assert_near(layer->coordination, !holds ? 0 : k == 2 ? 5 : 6, rounding);
        assert_near(layer->stiffness[BRC_SKIN_ALONG], holds ? along : 0, rounding);
        assert_near(layer->stiffness[BRC_SKIN_SHEAR], 0, rounding);
        assert_near(layer->stiffness[BRC_SKIN_ACROSS], k < 2 ? 0 : across, rounding);
    }
    assert_near(skin.missing[BRC_SKIN_ALONG], 2.5 - 2 * 0.25 * along, rounding);
    assert_near(skin.missing[BRC_SKIN_ACROSS], 2.5 - 8 * 0.25 * across, rounding);
    assert_int_equal(skin.core.n_elements, 8 * 8 * 8);
    assert_near(skin.core.volume, 7 * 7 * 7, rounding);
    brc_domain_free(&domain);
    brc_solid_free(&solid);
}

/* A sphere that touches a wall has a share (3 h^2 - 2 h^3), h its depth in diameters, below the depth h. Points sort
 * what lies at the rim wrongly: 1 / 8 of a diameter apart, by some 1 % of the sphere. */
static void spheres_fill_layers_by_the_volume_of_their_caps(void **state)
{
    brc_context *context = *state;
    brc_domain *domain;
    brc_skin skin;
    brc_solid *solid = lattice(context, &domain);
    require(context, brc_skin_measure(context, solid, domain, 1, &skin));
    for (int k = 0; k < BRC_SKIN_LAYERS; ++k) {
        const double from = fmod(k * 0.25, 1), to = from + 0.25;
        const double share = 3 * to * to - 2 * to * to * to - 3 * from * from + 2 * from * from * from;
        assert_near(skin.layer[k].solid, share * M_PI / 6 / 0.25, 0.01 * M_PI / 6 / 0.25);
    }
    brc_domain_free(&domain);
    brc_solid_free(&solid);
}

static brc_solid *packed(brc_context *context, const brc_shape *shape, int64_t n, double coordination, brc_domain **out)
{
    const brc_fill fill = {.kind = BRC_FILL_PACKING,
                           .n_elements = n,
                           .seed = 1,
                           .radius_spread = 0.125,
                           .coordination = 6.2,
                           .tolerance = 0.02};
    brc_packing packing;
    brc_solid *solid;
    brc_domain *domain;
    require(context, brc_solid_create(context, shape, 1, &solid));
    require(context, brc_packing_make(context, solid, &fill, 1, &packing));
    require(context, BRC_ALLOCATE(context, &domain, 1, "test"));
    require(context,
            brc_beams_build(context, solid, packing.position, packing.radius, n, coordination, false, 1, domain));
    packing.position = packing.radius = NULL;
    brc_packing_free(&packing);
    *out = domain;
    return solid;
}

/* Where a packing ends there are no beams in the outermost half diameter but for few, so shear against the inside and
 * stretching across lack about that; along the wall the first layer of spheres makes up for most of it. Bounds: a
 * quarter and a whole diameter around the half; along the wall less than half of the others. */
static void walls_of_a_packing_lack_half_a_diameter_across_and_little_along(void **state)
{
    static const brc_shape shapes[] = {{.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}},
                                       {.kind = BRC_SHAPE_SPHERE, .radius = 0.6}};
    brc_context *context = *state;
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; ++k) {
        brc_domain *domain;
        brc_skin skin, again;
        brc_solid *solid = packed(context, &shapes[k], 3000, 10, &domain);
        require(context, brc_skin_measure(context, solid, domain, 1, &skin));
        assert_true(skin.missing[BRC_SKIN_SHEAR] > 0.25 && skin.missing[BRC_SKIN_SHEAR] < 1);
        assert_true(skin.missing[BRC_SKIN_ACROSS] > 0.25 && skin.missing[BRC_SKIN_ACROSS] < 1);
        assert_true(fabs(skin.missing[BRC_SKIN_ALONG]) < skin.missing[BRC_SKIN_SHEAR] / 2);
        require(context, brc_skin_measure(context, solid, domain, 2, &again));
        assert_memory_equal(&skin, &again, sizeof skin);
        brc_domain_free(&domain);
        brc_solid_free(&solid);
    }
}

static void bodies_without_an_inside_are_refused(void **state)
{
    static const brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    brc_context *context = *state;
    brc_domain *domain;
    brc_skin skin;
    brc_solid *solid = packed(context, &box, 200, 8, &domain);
    assert_int_equal(brc_skin_measure(context, solid, domain, 1, &skin), BRC_BAD_INPUT);
    test_says(context, "deeper than 2.5 diameters");
    domain->element_kind = BRC_ELEMENT_CELL;
    assert_int_equal(brc_skin_measure(context, solid, domain, 1, &skin), BRC_BAD_INPUT);
    test_says(context, "made of cells");
    domain->element_kind = BRC_ELEMENT_SPHERE;
    brc_domain_free(&domain);
    brc_solid_free(&solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lattice_has_the_stiffness_that_can_be_counted_by_hand, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_fill_layers_by_the_volume_of_their_caps, test_begin, test_end),
        cmocka_unit_test_setup_teardown(walls_of_a_packing_lack_half_a_diameter_across_and_little_along, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(bodies_without_an_inside_are_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
