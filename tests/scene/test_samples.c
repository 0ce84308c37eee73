/* Bodies of any shape and fill: what is kept of them, and what does not fit together. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "../../host/scene/scene_reader.h"
#include "../../preprocess/cells/seeds.h"
#include "bad.h"

#define TOP                                                                                                            \
    "version: 1\nmaterials:\n  a: {E: 72 GPa, nu: 0.2, density: 2500 kg/m^3}\n  b: {E: 7 GPa, nu: 0.3, density: 1500 " \
    "kg/m^3}\n"
#define GRID "    fill: {noisy_grid: {elements: 1000}}\n"
#define PACKED "    fill: {packing: {elements: 1000}}\n"
#define BODY "bodies:\n  - material: a\n"
#define END "stages: [{name: pull, solver: static}]\n"

static void parts_keep_their_order_role_pose_and_sizes(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(
        TOP BODY GRID "    shape:\n      parts:\n"
                      "        - {role: add, name: base, shape: {box: {size: [10 mm, 10 mm, 2 mm]}}}\n"
                      "        - {role: remove, name: hole, shape: {cylinder: {axis: z, length: 4 mm, radius: 1 mm}}, "
                      "pose: {translation: [5 mm, 5 mm, -1 mm], rotation: [0, 30 deg, 0]}}\n"
                      "        - {role: keep, shape: {half_space: {point: [9 mm, 0, 0], normal: [2, 0, 0]}}}\n"
                      "sets: {rim: {faces: {wall: hole_side}}}\n" END);
    const brc_shape *shape = &scene->bodies[0].shape;
    assert_int_equal(shape->kind, BRC_SHAPE_PARTS);
    assert_int_equal(shape->n_parts, 3);
    assert_int_equal(shape->parts[0].role, BRC_PART_ADD);
    assert_int_equal(shape->parts[1].role, BRC_PART_REMOVE);
    assert_int_equal(shape->parts[2].role, BRC_PART_KEEP);
    assert_int_equal(shape->parts[1].shape.kind, BRC_SHAPE_CYLINDER);
    assert_true(shape->parts[1].shape.axis == 2 && shape->parts[1].shape.radius == 1e-3);
    assert_true(shape->parts[1].translation[2] == -1e-3 && shape->parts[1].rotation[1] > 0.52);
    assert_true(shape->parts[2].shape.normal[0] == 1 && shape->parts[2].shape.origin[0] == 9e-3);
    assert_string_equal(shape->parts[0].name, "base");
    brc_scene_free(&scene);
}

static void walls_of_parts_carry_the_name_of_the_part(void **state)
{
    (void)state;
    bad_scene(TOP BODY GRID
              "    shape:\n      parts:\n        - {role: add, name: base, shape: {box: {size: [1 m, 1 m, 1 m]}}}\n"
              "sets: {rim: {faces: {wall: x-}}}\n" END,
              "11:28", "there is no wall 'x-'");
    bad_scene(TOP BODY GRID "    shape: {cone: {length: 1 m, radius: 1 m}}\nsets: {rim: {faces: {wall: x+}}}\n" END,
              "9:28", "there is no wall 'x+'");
}

static void a_packing_stops_at_the_usual_coordination_unless_told_otherwise(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_scene *scene = good_scene(TOP BODY "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n" PACKED END);
    const brc_fill *fill = &scene->bodies[0].fill;
    assert_int_equal(fill->kind, BRC_FILL_PACKING);
    assert_true(fill->coordination == 6.2 && fill->volume_fraction == 0 && fill->radius_spread == 0.125);
    assert_int_equal(fill->n_elements, 1000);
    brc_scene_free(&scene);
    scene = good_scene(TOP BODY "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n"
                                "    fill: {packing: {radius: 2 cm, volume_fraction: 60 %, radii: [{radius: 1 mm, "
                                "below: 0}, {radius: 2 mm, below: 1}]}}\n" END);
    fill = &scene->bodies[0].fill;
    assert_true(fill->coordination == 0 && fill->volume_fraction == 0.6 && fill->n_radii == 2 &&
                fill->radii[1].radius == 2e-3);
    assert_true(fill->radius_spread == 0); /* not the default of the key that the table replaces */
    assert_int_equal(brc_fill_check(context, fill), BRC_OK);
    brc_scene_free(&scene);
    brc_context_free(&context);
}

static void grains_cracks_beams_and_limits_are_kept(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(
        TOP BODY
        "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n" PACKED "    beams: 8\n    model: cbm\n"
        "    grains: {number: 12, seed: 4, phases: [{material: b, fraction: 40 %}]}\n"
        "    cracks:\n      - {name: notch, flat: false, patch: {rectangle: {corner: [0, 0, 50 cm], edge: [20 cm, 0, "
        "0], other_edge: [0, 1 m, 0]}}}\n"
        "      - {name: penny, patch: {disc: {centre: [50 cm, 50 cm, 50 cm], normal: [0, 0, 3], radius: 10 cm}}}\n"
        "quality: {volume_error: {warn: 0.1 %, refuse: 1 %}}\n" END);
    const brc_body *body = &scene->bodies[0];
    assert_true(body->beams == 8 && body->grains.n == 12 && body->grains.seed == 4 && body->n_phases == 1);
    assert_int_equal(brc_body_n_regions(body), 1);
    assert_int_equal(brc_body_material(body, 0), 0);
    assert_int_equal(brc_body_material(body, 1), 1);
    assert_int_equal(body->n_cracks, 2);
    assert_true(body->cracks[0].kind == BRC_CRACK_RECTANGLE && !body->cracks[0].flat &&
                body->cracks[0].edge[1][1] == 1);
    assert_true(body->cracks[1].kind == BRC_CRACK_DISC && body->cracks[1].flat && body->cracks[1].normal[2] == 1);
    assert_true(scene->n_limits == 1 && scene->limits[0].has_warn && scene->limits[0].refuse == 0.01);
    assert_string_equal(scene->limits[0].number, "volume_error");
    brc_scene_free(&scene);
}

static void walls_of_spheres_are_sets_of_elements(void **state)
{
    (void)state;
    static const char head[] =
        TOP BODY "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n" PACKED "    beams: 8\n    model: cbm\n";
    char text[2048];
    snprintf(text, sizeof text,
             "%sstages: [{name: p, solver: static, loads: [{element_displacement: {set: x-_layer, x: 0}}]}]\n", head);
    assert_int_equal(count_errors(text), 0);
    snprintf(text, sizeof text,
             "%sstages: [{name: p, solver: static, loads: [{face_displacement: {set: x-, x: 0}}]}]\n", head);
    bad_scene(text, "11:70", "(that name is a set of elements)");
}

static void shapes_that_cannot_be_are_refused(void **state)
{
    (void)state;
    bad_scene(TOP BODY GRID "    shape: {torus: {radius: 1 cm, tube: 2 cm}}\n" END, "8:41",
              "not below the radius of the centre line");
    bad_scene(TOP BODY GRID "    shape: {cone: {length: 1 m, radius: 0}}\n" END, "8:41",
              "both ends of the cone are tips");
    bad_scene(TOP BODY GRID "    shape:\n      parts:\n        - {role: keep, shape: {sphere: {radius: 1 m}}}\n" END,
              "10:18", "the first part has nothing before it");
    bad_scene(TOP BODY GRID "    shape:\n      parts:\n        - {role: add, shape: {sphere: {radius: 1 m}}}\n"
                            "        - {role: add, shape: {half_space: {point: [0, 0, 0], normal: [1, 0, 0]}}}\n" END,
              "11:18", "a half-space has no end");
}

static void fills_that_contradict_themselves_are_refused(void **state)
{
    (void)state;
    static const char shape[] = TOP BODY "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n";
    static const char *const bad[][3] = {
        {"    fill: {packing: {elements: 100, radii: [{radius: 2 mm, below: 0}, {radius: 1 mm, below: 1}]}}\n", "8:80",
         "radii that grow"},
        {"    fill: {packing: {elements: 100, radii: [{radius: 1 mm, below: 10 %}, {radius: 2 mm, below: 1}]}}\n",
         "8:67", "shares that grow from 0"},
        {"    fill: {packing: {elements: 100, coordination: 6, volume_fraction: 0.6}}\n", "8:54",
         "expected only one of"},
        {"    fill: {packing: {radius_spread: 10 %}}\n", "8:21", "expected exactly one of elements, radius"},
        {"    fill: {noisy_grid: {elements: 100}}\n    beams: 8\n", "9:12", "a noisy grid has no spheres"},
        {"    fill: {packing: {elements: 100, lloyd: 2}}\n    beams: 8\n", "8:44", "expected 0 with beams"},
        {"    fill: {points: {scale: 1 m}}\n", "8:20", "the key 'file' is missing"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s%s", shape, bad[i][0], END);
        bad_scene(text, bad[i][1], bad[i][2]);
    }
}

static void cracks_and_phases_that_cannot_be_are_refused(void **state)
{
    (void)state;
    static const char body[] = TOP BODY GRID "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n";
    static const char *const bad[][3] = {
        {"    cracks: [{name: c, patch: {rectangle: {corner: [0, 0, 0], edge: [1 m, 0, 0], other_edge: [2 m, 0, "
         "0]}}}]\n",
         "9:94", "spans no area"},
        {"    cracks:\n      - {name: c, patch: {disc: {centre: [0, 0, 0], normal: [0, 0, 1], radius: 1 m}}}\n"
         "      - {name: c, patch: {disc: {centre: [0, 0, 0], normal: [0, 0, 1], radius: 1 m}}}\n",
         "11:16", "another crack is called 'c' too"},
        {"    grains: {number: 3, phases: [{material: b, fraction: 60 %}, {material: a, fraction: 50 %}]}\n", "9:89",
         "sum to 1.1"},
        {"    grains: {number: 3, size: 1 cm}\n", "9:25", "expected only one of number, size"},
        {"quality: {volume_eror: {warn: 1}}\n", "9:24", "did you mean 'volume_error'?"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        char text[2048];
        snprintf(text, sizeof text, "%s%s%s", body, bad[i][0], END);
        bad_scene(text, bad[i][1], bad[i][2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_keep_their_order_role_pose_and_sizes),
        cmocka_unit_test(walls_of_parts_carry_the_name_of_the_part),
        cmocka_unit_test(a_packing_stops_at_the_usual_coordination_unless_told_otherwise),
        cmocka_unit_test(grains_cracks_beams_and_limits_are_kept),
        cmocka_unit_test(walls_of_spheres_are_sets_of_elements),
        cmocka_unit_test(shapes_that_cannot_be_are_refused),
        cmocka_unit_test(fills_that_contradict_themselves_are_refused),
        cmocka_unit_test(cracks_and_phases_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
