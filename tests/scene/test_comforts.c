/* Short forms of a scene: diameters, one number for a strength, true and false, bodies as sets; signs and openings of
 * sensors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "../../host/base/memory.h"
#include "bad.h"

#define TOP "version: 1\nmaterials: {glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3, strength: {tension: 60 MPa}}}\n"
#define BALL(shape) TOP "bodies: [{name: ball, shape: {" shape "}, fill: {noisy_grid: {elements: 100}}}]\n"
#define CUBE TOP "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 100}}}]\n"
#define PULL "stages: [{name: pull, solver: static}]\n"
#define GO "stages: [{name: go, solver: {dynamic: {steps: 9}}}]\n"

static void a_diameter_is_twice_a_radius(void **state)
{
    (void)state;
    static const char *const same[][2] = {
        {BALL("sphere: {radius: 5 mm}") PULL, BALL("sphere: {diameter: 1 cm}") PULL},
        {BALL("cylinder: {radius: 5 mm, length: 1 cm}") PULL, BALL("cylinder: {diameter: 1 cm, length: 1 cm}") PULL},
        {BALL("cone: {radius: 5 mm, end_radius: 2 mm, length: 1 cm}") PULL,
         BALL("cone: {diameter: 1 cm, end_diameter: 4 mm, length: 1 cm}") PULL},
        {BALL("cone: {radius: 0, end_radius: 2 mm, length: 1 cm}") PULL,
         BALL("cone: {diameter: 0, end_diameter: 4 mm, length: 1 cm}") PULL},
        {BALL("torus: {radius: 5 mm, tube: 1 mm}") PULL, BALL("torus: {diameter: 1 cm, tube_diameter: 2 mm}") PULL},
        {CUBE PULL "sets: {core: {elements: {sphere: {centre: [0, 0, 0], radius: 5 m}, cylinder: {point: [0, 0, 0], "
                   "axis: [1, 0, 0], radius: 7 m}}}}\n",
         CUBE PULL "sets: {core: {elements: {sphere: {centre: [0, 0, 0], diameter: 10 m}, cylinder: {point: [0, 0, 0], "
                   "axis: [1, 0, 0], diameter: 14 m}}}}\n"},
        {TOP PULL "bodies: [{shape: {sphere: {radius: 1 m}}, fill: {packing: {radius: 1 cm}}}]\n",
         TOP PULL "bodies: [{shape: {sphere: {radius: 1 m}}, fill: {packing: {diameter: 2 cm}}}]\n"},
    };
    brc_context *context = brc_context_create();
    for (size_t k = 0; k < sizeof same / sizeof *same; ++k) {
        char *text[2] = {NULL, NULL};
        for (int side = 0; side < 2; ++side) {
            brc_scene *scene = good_scene(same[k][side]);
            assert_int_equal(brc_scene_to_yaml(context, scene, &text[side]), BRC_OK);
            brc_scene_free(&scene);
        }
        assert_string_equal(text[0], text[1]);
        brc_scene *again = good_scene(text[0]);
        brc_scene_free(&again);
        for (int side = 0; side < 2; ++side)
            brc_memory_free(text[side]);
    }
    brc_context_free(&context);
}

static void a_round_has_a_radius_or_a_diameter(void **state)
{
    (void)state;
    bad_scene(BALL("sphere: {centre: [0, 0, 0]}") PULL, "3:39", "expected exactly one of radius, diameter; found none");
    bad_scene(BALL("sphere: {radius: 5 mm, diameter: 1 cm}") PULL, "3:54",
              "expected only one of radius, diameter; found 2 of them, keep one");
    bad_scene(BALL("sphere: {diameter: 0}") PULL, "3:50", "diameter: '0' is out of range, it must be > 0");
    bad_scene(BALL("cone: {radius: 1 m, end_radius: 1 m, end_diameter: 1 m, length: 1 m}") PULL, "3:68",
              "only one of end_radius, end_diameter");
}

static void one_number_is_a_strength_in_tension(void **state)
{
    (void)state;
    brc_scene *scene = good_scene("version: 1\nmaterials: {rock: {E: 50 GPa, nu: 0.2, density: 2600 kg/m^3, strength: "
                                  "8 MPa}}\nbodies: [{domain: d.h5}]\n" PULL);
    assert_true(scene->materials[0].tension == 8e6 && scene->materials[0].fracture_energy == 0 &&
                scene->materials[0].compression == 0);
    brc_scene_free(&scene);
    bad_scene("version: 1\nmaterials: {rock: {E: 50 GPa, nu: 0.2, density: 2600 kg/m^3, strength: 8}}\nbodies: "
              "[{domain: d.h5}]\n" PULL,
              "2:72", "tension: '8' has no unit; expected a quantity in Pa > 0 such as 50 MPa");
}

static void true_takes_all_defaults_and_false_leaves_out(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(CUBE GO "fracture: true\ninteractions: {contact: true}\n");
    assert_true(scene->has_fracture && scene->fracture.closure && scene->fracture.level == 1 && scene->has_contact &&
                scene->contact.within);
    brc_scene_free(&scene);
    scene = good_scene(CUBE GO "fracture: false\ninteractions: {contact: false}\n");
    assert_true(!scene->has_fracture && !scene->has_contact);
    brc_scene_free(&scene);
    bad_scene(CUBE GO "fracture: yes\n", "5:11", "fracture: expected a map of keys, or true or false; found 'yes'");
    bad_scene(CUBE GO "fracture: false\nsensors: {b: {fracture: broken}}\n", "6:25", "needs `fracture: {}`");
}

static void a_body_is_a_set_of_its_elements(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(CUBE "stages: [{name: go, solver: {dynamic: {steps: 9}}, initial: [{velocity: {set: "
                                       "cube, velocity: [1 m/s, 0, 0]}}]}]\n"
                                       "sensors: {v: {face_mean: {set: cube, component: x}}}\n");
    assert_int_equal(scene->n_sets, 1);
    assert_string_equal(scene->sets[0].name, "cube");
    assert_true(scene->sets[0].kind == BRC_SET_ELEMENTS && scene->sets[0].where.has_body &&
                scene->sets[0].where.body == 0);
    brc_scene_free(&scene);
    scene = good_scene(CUBE PULL); /* nobody names it */
    assert_int_equal(scene->n_sets, 0);
    brc_scene_free(&scene);
    bad_scene(CUBE "stages: [{name: go, solver: {dynamic: {steps: 9}}, initial: [{velocity: {set: cub, velocity: [1 "
                   "m/s, 0, 0]}}]}]\n",
              "4:79", "there is no body or set of elements 'cub'; did you mean 'cube'?");
}

/* Where faces are wanted a body is all of its free faces, under a name that nothing else has; where both are wanted, it
 * is both. */
static void a_body_is_a_set_of_its_faces(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(CUBE "stages: [{name: go, solver: static, loads: [{pressure: {set: cube, value: 1 Pa}}]}]\n");
    assert_int_equal(scene->n_sets, 1);
    assert_string_equal(scene->stages[0].loads[0].set, "cube_faces");
    assert_string_equal(scene->sets[0].name, "cube_faces");
    assert_true(scene->sets[0].kind == BRC_SET_FACES && scene->sets[0].where.has_body &&
                scene->sets[0].where.body == 0);
    brc_scene_free(&scene);
    scene =
        good_scene(CUBE "sets: {cube_faces: {faces: {wall: x+}}}\nsensors: {s: {stress: {set: cube, component: xx}}}\n"
                        "stages: [{name: go, solver: static, loads: [{traction: {set: cube, x: 1 Pa}}, {pressure: "
                        "{set: cube, value: 1 Pa}}]}]\n");
    assert_int_equal(scene->n_sets, 3);
    assert_true(scene->sets[1].kind == BRC_SET_ELEMENTS && strcmp(scene->sets[1].name, "cube") == 0 &&
                strcmp(scene->sensors[0].set, "cube") == 0);
    assert_true(scene->sets[2].kind == BRC_SET_FACES && strcmp(scene->sets[2].name, "cube_faces_1") == 0);
    for (int l = 0; l < 2; ++l)
        assert_string_equal(scene->stages[0].loads[l].set, "cube_faces_1");
    brc_scene_free(&scene);
    bad_scene(CUBE "stages: [{name: go, solver: static, loads: [{pressure: {set: cub, value: 1 Pa}}]}]\n", "4:62",
              "there is no wall, body or set of faces 'cub'; did you mean 'cube'?");
    bad_scene(TOP "bodies: [{name: ball, shape: {sphere: {radius: 1 m}}, beams: 6, fill: {packing: {elements: "
                  "90}}}]\nmodel: cbm\n"
                  "stages: [{name: go, solver: static, loads: [{pressure: {set: ball, value: 1 Pa}}]}]\n",
              "5:62", "(that body is of spheres, which have no faces: load its elements)");
}

static void sets_choose_by_body_too(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(CUBE PULL "sets: {skin: {faces: {body: cube, normal: {direction: [1, 0, 0]}}}}\n");
    assert_true(scene->sets[0].where.has_body && scene->sets[0].where.body == 0);
    brc_scene_free(&scene);
    bad_scene(CUBE PULL "sets: {skin: {faces: {body: cub}}}\n", "5:29", "there is no body 'cub'; did you mean 'cube'?");
    bad_scene(TOP PULL "bodies: [{shape: {sphere: {radius: 1 m}}, fill: {noisy_grid: {elements: 9}}, regions: "
                       "[{material: glass, where: {body: body}}]}]\n",
              "4:120", "a region is a part of the body that it stands in");
    warned_scene(CUBE PULL "sets: {cube: {elements: {wall: x+}}}\n", "5:14", "the set 'cube' has the name of a body");
}

static void openings_say_what_they_are_between(void **state)
{
    (void)state;
    static const char NOTCHED[] =
        TOP "bodies: [{shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 100}}, "
            "cracks: [{name: notch, patch: {rectangle: {corner: [50 cm, 0, 0], edge: [0, 50 cm, 0], other_edge: [0, 0, "
            "1 m]}}}]}]\n" PULL "sensors: {o: {opening: {%s}}}\n";
    static const char *const good[] = {
        "crack: notch", "crack: notch, at: [50 cm, 0, 50 cm], within: 20 cm", "from: [0, 0, 0], to: [1 m, 0, 0]",
        "from: [0, 0, 0], to: [1 m, 1 m, 0], direction: [1, 0, 0]", "set: x+, against: x-, direction: [1, 0, 0]"};
    static const char *const bad[][3] = {
        {"direction: [1, 0, 0]", "5:24", "expected exactly one of set, from, crack; found none"},
        {"crack: notch, from: [0, 0, 0], to: [1 m, 0, 0]", "5:39", "only one of set, from, crack"},
        {"set: x+, direction: [1, 0, 0]", "5:30", "has one side; expected the other one too"},
        {"set: x+, against: x-", "5:30", "needs a direction, as in direction: [1, 0, 0]"},
        {"from: [0, 0, 0]", "5:31", "expected `to` beside `from`"},
        {"from: [0, 0, 1 m], to: [0, 0, 1 m]", "5:48", "is the same point as `from`"},
        {"crack: x+", "5:32", "'x+' is a wall, not a crack"},
        {"crack: notsh", "5:32", "there is no wall 'notsh'; did you mean 'notch'?"},
        {"crack: notch, at: [50 cm, 0, 50 cm]", "5:43", "expected both, as in at:"},
        {"crack: notch, within: 1 cm", "5:47", "expected both, as in at:"},
        {"set: x+, against: x-, direction: [1, 0, 0], within: 1 cm", "5:77", "give `crack` too, or leave them out"},
    };
    char text[1200];
    for (size_t k = 0; k < sizeof good / sizeof *good; ++k) {
        snprintf(text, sizeof text, NOTCHED, good[k]);
        assert_int_equal(count_errors(text), 0);
    }
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        snprintf(text, sizeof text, NOTCHED, bad[k][0]);
        bad_scene(text, bad[k][1], bad[k][2]);
    }
}

static void signs_are_words_that_fit_the_sensor(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(CUBE PULL "sensors: {a: {reaction: {set: x+, component: x}}, b: {stress: {component: xx, sign: "
                             "compression}}, c: {face_mean: {set: x+, component: x, sign: compression}}}\n");
    assert_true(scene->sensors[0].sign == BRC_SIGN_AXIS && scene->sensors[1].sign == BRC_SIGN_COMPRESSION &&
                scene->sensors[2].sign == BRC_SIGN_COMPRESSION);
    brc_scene_free(&scene);
    bad_scene(CUBE PULL "sensors: {b: {stress: {component: xx, sign: compressive}}}\n", "5:45",
              "is none of the words (did you mean compression?); expected one of tension, compression");
    bad_scene(CUBE GO "interactions: {contact: true}\nstrikers: {p: {plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}, "
                      "material: glass}}\n"
                      "sensors: {b: {striker: {name: p, quantity: spin, sign: compression}}}\n",
              "7:56", "sign: spin of a striker is neither compression nor tension");
    bad_scene(CUBE GO "interactions: {contact: true}\nstrikers: {p: {plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}, "
                      "material: glass}}\n"
                      "sensors: {b: {striker: {name: p, quantity: displacement, against: p}}}\n",
              "7:67", "is the same striker");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_diameter_is_twice_a_radius),
        cmocka_unit_test(a_round_has_a_radius_or_a_diameter),
        cmocka_unit_test(one_number_is_a_strength_in_tension),
        cmocka_unit_test(true_takes_all_defaults_and_false_leaves_out),
        cmocka_unit_test(a_body_is_a_set_of_its_elements),
        cmocka_unit_test(a_body_is_a_set_of_its_faces),
        cmocka_unit_test(sets_choose_by_body_too),
        cmocka_unit_test(openings_say_what_they_are_between),
        cmocka_unit_test(signs_are_words_that_fit_the_sensor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
