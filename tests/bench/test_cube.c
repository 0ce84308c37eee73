/* Large packings of the bench are mirror images of a small one (bench/cube.c). */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include "../../bench/cube.h"

static void a_large_packing_is_as_dense_and_as_well_joined_as_the_one_it_mirrors(void **unused)
{
    (void)unused;
    enum { PART = 13500, TILES = 8 };
    brc_context *context = brc_context_create();
    brc_domain *large = NULL, *part = NULL;
    assert_int_equal(brc_cube_build(context, TILES * PART, true, &large), BRC_OK);
    assert_int_equal(brc_cube_build(context, PART, true, &part), BRC_OK);
    assert_int_equal(part->n_elements, PART);
    assert_int_equal(large->n_elements, TILES * PART);
    assert_int_equal(large->n_bonds, 5 * large->n_elements); /* ten beams a sphere */
    /* The same packing, half as large: spheres with their images, and as many at each wall of the whole as of a part.
     */
    for (int64_t e = 0; e < PART; ++e) {
        for (int t = 0; t < TILES; ++t) {
            assert_true(fabs(large->radius[e + t * PART] - 0.5 * part->radius[e]) < 1e-12);
            for (int k = 0; k < 3; ++k) {
                const double x = 0.5 * part->position[3 * e + k], *at = large->position + 3 * (e + t * PART);
                assert_true(fabs(at[k] - (t >> k & 1 ? 1 - x : x)) < 1e-12);
            }
        }
    }
    /* A sphere at a wall inside meets its image, so the longest bond of as many a sphere is shorter, if anything. */
    assert_in_range(1e6 * large->quality.growth, 1e6 * 0.97 * part->quality.growth, 1e6 * part->quality.growth);
    brc_domain_free(&large);
    brc_domain_free(&part);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_large_packing_is_as_dense_and_as_well_joined_as_the_one_it_mirrors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
