/* Volumes of materials in a body of cells against those of the scene, where both are known exactly. */
#include "../support.h"
#include "../../../host/commands/price/material_volume.h"
#include "../../../host/scene/scene_reader.h"
#include <stdio.h>
#include <string.h>

#define HEAD                                                                                                           \
    "version: 1\nmaterials:\n  rock: {E: 40 GPa, nu: 0.2, density: 3000 kg/m^3}\n  clay: {E: 2 GPa, nu: 0.2, "         \
    "density: 1000 kg/m^3}\nmodel: dlsm\nbodies:\n"                                                                    \
    "  - name: ground\n    shape: {box: {size: [0.4 m, 0.4 m, 1 m]}}\n    material: rock\n"
#define TAIL                                                                                                           \
    "stages: [{name: rest, solver: {static: {}}, loads: [{face_displacement: {set: z-, x: 0, y: 0, z: "                \
    "0}}]}]\noutput: {frames: none, picture: false}\n"

/* The means of a body with a share of clay, in the order E, 1 / E, density. */
static double mean(double clay, int which)
{
    return which == 0   ? 40 * (1 - clay) + 2 * clay
           : which == 1 ? (1 - clay) / 40 + clay / 2
                        : 3000 * (1 - clay) + 1000 * clay;
}

/* What a body with `made` instead of `wanted` of clay is off by. */
static double off(double made, double wanted)
{
    double worst = 0;
    for (int which = 0; which < 3; ++which)
        worst = fmax(worst, fabs(mean(made, which) / mean(wanted, which) - 1));
    return worst;
}

/* The error as told, and the share of clay that the cells have. */
static double told(const char *text, double *made)
{
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    brc_setup setup = {0};
    double whole = 0;
    assert_non_null(context);
    if (brc_scene_read_text(context, "scene", text, strlen(text), 0, NULL, &scene) != BRC_OK ||
        brc_setup_domains(context, scene, NULL, 1, &setup) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    const brc_domain *d = setup.domain[0];
    *made = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        whole += d->volume[e];
        if (d->region[e] == 1) *made += d->volume[e];
    }
    *made /= whole;
    const double error = brc_material_volume_error(&setup);
    brc_setup_free(&setup);
    brc_scene_free(&scene);
    brc_context_free(&context);
    return error;
}

/* Ten layers of cubes: a boundary at 0.5 m runs between two of them, so that nothing is off but for rounding. */
static void a_boundary_along_faces_is_met(void **state)
{
    double made;
    (void)state;
    const double error = told(HEAD "    fill: {noisy_grid: {cells: [4, 4, 10], spread: 0 %}}\n    regions: [{material: "
                                   "clay, where: {half_space: {point: [0, 0, 0.5 m], normal: [0, 0, 1]}}}]\n" TAIL,
                              &made);
    assert_near(made, 0.5, 1e-12);
    assert_near(error, 0, 1e-12);
}

/* At 0.515 m 0.15 of the sixth layer is rock in the scene, and the layer is all clay. In a cube the points of the side
 * faces lie 0.75 times a quarter of the edge above and below its middle (0.53125, 0.56875 m), those of the lower face
 * 0.75 of half the edge below (0.5125 m): the lower pyramid alone is found to be rock, a sixth of the layer instead of
 * 0.15 of it, and what is told is right to that, 0.0017 of the body (a tenth more, as the means it is relative to are
 * not those at 0.5). */
static void layers_that_are_too_thick_are_told(void **state)
{
    double made;
    (void)state;
    const double error = told(HEAD "    fill: {noisy_grid: {cells: [4, 4, 10], spread: 0 %}}\n    regions: [{material: "
                                   "clay, where: {half_space: {point: [0, 0, 0.515 m], normal: [0, 0, 1]}}}]\n" TAIL,
                              &made);
    assert_near(made, 0.5, 1e-12);
    assert_near(error, off(0.5, 0.5 - 0.1 / 6), 1e-9);
    assert_near(error, off(0.5, 0.485), 1.1 * off(0.5, 0.5 - 0.1 * (1. / 6 - 0.15)));
}

/* Relaxed cells of noise: a cut cell's share is found to a tenth of its volume at worst on average, some 100 of 1000
 * cells are cut, their errors are independent: 0.1 sqrt(100) / 1000 = 0.001 of the volume; three times that. */
static void a_boundary_through_random_cells_is_told(void **state)
{
    double made;
    (void)state;
    const double error =
        told(HEAD "    fill: {noisy_grid: {elements: 1000, spread: 90 %, lloyd: 2, seed: 3}}\n    regions: [{material: "
                  "clay, where: {half_space: {point: [0, 0, 0.63 m], normal: [0, 0, 1]}}}]\n" TAIL,
             &made);
    assert_near(error, off(made, 0.37), off(0.373, 0.37));
}

static void one_material_is_never_off(void **state)
{
    double made;
    (void)state;
    assert_true(told(HEAD "    fill: {noisy_grid: {cells: [4, 4, 10], spread: 50 %}}\n" TAIL, &made) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_boundary_along_faces_is_met), cmocka_unit_test(layers_that_are_too_thick_are_told),
        cmocka_unit_test(a_boundary_through_random_cells_is_told), cmocka_unit_test(one_material_is_never_off)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
