/* Platens, jaws and rollers: what one line of a scene becomes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "../../host/base/memory.h"
#include "bad.h"

#define DISC                                                                                                           \
    "version: 1\n"                                                                                                     \
    "materials: {rock: {E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, strength: 8 MPa}}\n"                                \
    "bodies: [{name: disc, shape: {cylinder: {axis: z, length: 10 mm, diameter: 50 mm}}, fill: {noisy_grid: "          \
    "{spacing: 2 mm}}}]\n"                                                                                             \
    "stages: [{name: press, solver: {dynamic: {duration: 1 ms}}}]\n"
#define BEAM                                                                                                           \
    "version: 1\n"                                                                                                     \
    "materials: {rock: {E: 50 GPa, nu: 0.25, density: 2650 kg/m^3}}\n"                                                 \
    "bodies: [{name: beam, shape: {box: {size: [450 mm, 100 mm, 50 mm]}}, fill: {noisy_grid: {spacing: 10 mm}}}]\n"    \
    "stages: [{name: bend, solver: {dynamic: {duration: 1 ms}}}]\n"

static const brc_striker *striker(const brc_scene *scene, const char *name)
{
    for (int k = 0; k < scene->n_strikers; ++k)
        if (strcmp(scene->strikers[k].name, name) == 0) return &scene->strikers[k];
    fail_msg("no striker %s", name);
    return NULL;
}

static const brc_sensor *sensor(const brc_scene *scene, const char *name)
{
    for (int k = 0; k < scene->n_sensors; ++k)
        if (strcmp(scene->sensors[k].name, name) == 0) return &scene->sensors[k];
    fail_msg("no sensor %s", name);
    return NULL;
}

static void platens_stand_at_both_sides_of_the_body(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(DISC "platens: {axis: y, speed: 0.2 m/s, friction: 0.3}\n");
    const brc_striker *low = striker(scene, "platen_low"), *high = striker(scene, "platen_high");
    assert_int_equal(scene->n_strikers, 2);
    assert_int_equal(low->motion, BRC_STRIKER_FIXED);
    assert_int_equal(high->motion, BRC_STRIKER_DRIVEN);
    assert_true(high->velocity[0] == 0 && high->velocity[1] == -0.2 && high->velocity[2] == 0);
    /* Outside of the disc, nearer than a cell stands out: h^2 / (12 R) is 13 um here. */
    const double top = high->shape.origin[1] - 25e-3, below = -25e-3 - (low->shape.origin[1] + low->shape.size[1]);
    assert_true(top > 0 && top < 20e-6 && fabs(top - below) < 1e-12);
    assert_true(high->shape.origin[0] < -25e-3 && high->shape.origin[0] + high->shape.size[0] > 25e-3);
    assert_true(high->shape.origin[2] < 0 && high->shape.origin[2] + high->shape.size[2] > 10e-3);
    brc_scene_free(&scene);
}

static void tools_bring_steel_contact_sensors_a_measure_and_a_curve(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(DISC "platens: {axis: y, speed: 0.2 m/s, friction: 0.3}\n");
    assert_int_equal(scene->n_materials, 2);
    assert_string_equal(scene->materials[striker(scene, "platen_high")->material].name, "steel");
    assert_true(scene->has_contact && scene->contact.within && scene->contact.law.friction == 0);
    assert_int_equal(scene->contact.n_pairs, 1);
    assert_true(scene->contact.pairs[0].friction == 0.3 && scene->contact.pairs[0].material[0] == 1 &&
                scene->contact.pairs[0].material[1] == 0);
    const brc_sensor *force = sensor(scene, "platens_force"), *way = sensor(scene, "platens_displacement");
    assert_true(force->sign == BRC_SIGN_COMPRESSION && force->component == 1 &&
                strcmp(force->set, "platen_high") == 0 && strcmp(force->term, "force") == 0);
    assert_true(strcmp(way->set, "platen_high") == 0 && strcmp(way->set2, "platen_low") == 0);
    assert_string_equal(sensor(scene, "platens_reaction")->set, "platen_low");
    assert_int_equal(scene->n_measures, 1);
    assert_string_equal(scene->measures[0].name, "platens_peak_force");
    assert_string_equal(scene->output.curve_x, "platens_displacement");
    assert_string_equal(scene->output.curve_y, "platens_force");
    brc_scene_free(&scene);
}

static void what_the_scene_says_itself_stands(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(
        "version: 1\nmaterials: {rock: {E: 50 GPa, nu: 0.25, density: 2650 kg/m^3}, steel: {E: 200 GPa, nu: 0.3, "
        "density: 7800 kg/m^3}}\n"
        "bodies: [{name: disc, material: rock, shape: {cylinder: {axis: z, length: 10 mm, radius: 25 mm}}, fill: "
        "{noisy_grid: {spacing: 2 mm}}}]\n"
        "interactions: {contact: {friction: 0.5}}\n"
        "platens: {body: disc, axis: y, speed: 0.2 m/s, moves: both, ramp: 1 ms, gap: 1 um, material: rock}\n"
        "sensors: {platens_force: {contact: force}}\nmeasure: {top: {peak: {of: platens_force, target: 6 kN}}}\n"
        "output: {curve: {x: platens_displacement, y: platens_reaction}}\n"
        "stages: [{name: press, solver: {dynamic: {duration: 1 ms}}}]\n");
    assert_int_equal(scene->n_materials, 2);
    assert_int_equal(scene->contact.n_pairs, 0);
    assert_int_equal(sensor(scene, "platens_force")->kind, BRC_SENSOR_CONTACT);
    const brc_striker *low = striker(scene, "platen_low"), *high = striker(scene, "platen_high");
    assert_true(low->velocity[1] == 0.1 && high->velocity[1] == -0.1 && high->material == 0);
    assert_int_equal(high->table.n, 2);
    assert_true(high->table.time[1] == 1e-3 && high->table.value[0] == 0 && high->table.value[1] == 1);
    assert_true(fabs(high->shape.origin[1] - 25e-3 - 1e-6) < 1e-15);
    assert_string_equal(scene->output.curve_y, "platens_reaction");
    brc_scene_free(&scene);
}

/* What moves is free along the axis alone, and pressed; what stays, stays. */
static void tools_are_pressed_by_a_force(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(DISC "platens: {axis: y, force: 6 kN, ramp: 1 ms, mass: 2 kg}\n");
    const brc_striker *low = striker(scene, "platen_low"), *high = striker(scene, "platen_high");
    assert_true(low->motion == BRC_STRIKER_FIXED && high->motion == BRC_STRIKER_FREE && high->pushed && !low->pushed);
    assert_true(high->force[0] == 0 && high->force[1] == -6e3 && high->mass == 2 && high->velocity[1] == 0);
    assert_true(high->held[0] && !high->held[1] && high->held[2] && high->held_rotation);
    assert_true(high->table.n == 2 && high->table.time[1] == 1e-3 && high->table.value[1] == 1);
    assert_int_equal(sensor(scene, "platens_force")->sign, BRC_SIGN_COMPRESSION);
    brc_scene_free(&scene);
    scene = good_scene(DISC "platens: {axis: y, force: 6 kN, moves: both}\n");
    assert_true(striker(scene, "platen_low")->force[1] == 6e3 && striker(scene, "platen_high")->force[1] == -6e3 &&
                striker(scene, "platen_high")->mass == 0);
    brc_scene_free(&scene);
    scene = good_scene(BEAM "rollers: {axis: y, span: 400 mm, diameter: 20 mm, force: 2 kN}\n");
    assert_true(striker(scene, "roller_load")->force[1] == -2e3 &&
                striker(scene, "roller_left")->motion == BRC_STRIKER_FIXED);
    brc_scene_free(&scene);
    bad_scene(DISC "platens: {axis: y, force: 6 kN, speed: 1 m/s}\n", "5:33",
              "expected only one of speed, force; found 2 of them");
    bad_scene(DISC "platens: {axis: y}\n", "5:10", "expected exactly one of speed, force");
    bad_scene(DISC "platens: {axis: y, speed: 1 m/s, mass: 2 kg}\n", "5:40",
              "tools that move with a prescribed speed need none; leave it out, or press them by `force`");
}

static void jaws_are_hollow_towards_the_disc(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(DISC "jaws: {axis: y, diameter: 75 mm, speed: 0.2 m/s, moves: low}\n");
    const brc_striker *low = striker(scene, "jaw_low"), *high = striker(scene, "jaw_high");
    assert_true(low->velocity[1] == 0.2 && high->motion == BRC_STRIKER_FIXED);
    assert_int_equal(high->shape.n_parts, 2);
    const brc_shape *block = &high->shape.parts[0].shape, *hollow = &high->shape.parts[1].shape;
    assert_int_equal(high->shape.parts[1].role, BRC_PART_REMOVE);
    assert_true(hollow->kind == BRC_SHAPE_CYLINDER && hollow->axis == 2 && hollow->radius == 37.5e-3);
    assert_true(fabs(block->size[0] - 25e-3) < 1e-12 && fabs(block->origin[0] + 12.5e-3) < 1e-12);
    const double apex = hollow->origin[1] + 37.5e-3;
    assert_true(apex > 25e-3 && apex < 25.05e-3 && block->origin[1] < apex);
    brc_scene_free(&scene);
    bad_scene(DISC "jaws: {axis: y, radius: 20 mm, speed: 1 m/s}\n", "5:25",
              "narrower than the body, which is 0.05 m across; expected a radius of 0.025 m or more");
    bad_scene(DISC "jaws: {axis: y, radius: 30 mm, width: 7 cm, speed: 1 m/s}\n", "5:39",
              "expected less than its diameter");
    bad_scene(DISC "jaws: {axis: y, speed: 1 m/s}\n", "5:7", "expected exactly one of radius, diameter");
}

static void rollers_lie_below_and_above_the_beam(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(BEAM "rollers: {axis: y, span: 400 mm, diameter: 20 mm, speed: 20 mm/s}\n");
    const brc_striker *left = striker(scene, "roller_left"), *right = striker(scene, "roller_right"),
                      *load = striker(scene, "roller_load");
    assert_true(left->shape.axis == 2 && left->shape.radius == 10e-3);
    assert_true(fabs(left->shape.origin[0] - 25e-3) < 1e-12 && fabs(right->shape.origin[0] - 425e-3) < 1e-12 &&
                fabs(load->shape.origin[0] - 225e-3) < 1e-12);
    assert_true(load->velocity[1] == -20e-3 && left->motion == BRC_STRIKER_FIXED && right->motion == BRC_STRIKER_FIXED);
    /* Corners of 48 flat faces reach 1.00143 radii; they touch the flat sides of the beam. */
    assert_true(fabs(left->shape.origin[1] + 10.0143e-3) < 1e-7 && fabs(load->shape.origin[1] - 110.0143e-3) < 1e-7);
    assert_string_equal(sensor(scene, "rollers_force")->set, "roller_load");
    brc_scene_free(&scene);
    scene = good_scene(BEAM "rollers: {axis: y, span: 40 mm, radius: 1 mm, speed: 20 mm/s, along: z, moves: low}\n");
    assert_true(striker(scene, "roller_left")->shape.axis == 0 && striker(scene, "roller_load")->velocity[1] == 20e-3);
    assert_true(striker(scene, "roller_left")->shape.origin[1] > 100e-3 &&
                striker(scene, "roller_load")->shape.origin[1] < 0);
    brc_scene_free(&scene);
}

static void tools_that_fit_no_body_are_refused_with_the_cure(void **state)
{
    (void)state;
    bad_scene(BEAM "rollers: {axis: y, span: 500 mm, diameter: 20 mm, speed: 20 mm/s}\n", "5:26",
              "is no less than the body's length, 0.45 m along x, so that supports are not below it; expected less");
    bad_scene(BEAM "rollers: {axis: y, span: 10 mm, diameter: 20 mm, speed: 20 mm/s}\n", "5:26",
              "expected a longer span or thinner rollers");
    bad_scene(BEAM "rollers: {axis: y, along: y, span: 40 mm, diameter: 20 mm, speed: 20 mm/s}\n", "5:27",
              "the span runs across the load");
    bad_scene(BEAM "platens: {speed: 1 m/s}\n", "5:10", "the key 'axis' is missing in this platens");
    bad_scene(BEAM "platens: {axis: y, speed: 20}\n", "5:27", "has no unit");
    bad_scene(BEAM "platens: {axis: y, speed: 1 m/s, body: beem}\n", "5:40",
              "there is no body 'beem'; did you mean 'beam'?");
    bad_scene(BEAM "platens: {axis: y, speed: 1 m/s}\ninteractions: {contact: {}}\nstrikers: {platen_low: {plane: "
                   "{point: [0, 0, 0], normal: [0, 1, 0]}, material: rock}}\n",
              "5:1", "they make a striker 'platen_low', and the scene has one of this name");
    bad_scene("version: 1\nmaterials: {rock: {E: 1 GPa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5}]\nstages: "
              "[{name: go, solver: {dynamic: {steps: 1}}}]\n"
              "platens: {axis: y, speed: 1 m/s}\n",
              "5:1", "it comes from a file, is turned, or is cut by planes; place strikers of your own");
    bad_scene("version: 1\nmaterials: {rock: {E: 1 GPa, nu: 0, density: 1 kg/m^3}}\nstages: [{name: go, solver: "
              "{dynamic: {steps: 1}}}]\n"
              "bodies:\n  - {name: a, shape: {sphere: {radius: 1 m}}, fill: {noisy_grid: {elements: 9}}}\n"
              "  - {name: b, shape: {sphere: {radius: 1 m, centre: [9 m, 0, 0]}}, fill: {noisy_grid: {elements: 9}}}\n"
              "platens: {axis: y, speed: 1 m/s}\n",
              "7:1", "the scene has 2 bodies; expected the one that is pressed, as in body: a");
}

static void bounds_are_those_of_what_is_added_and_moved(void **state)
{
    (void)state;
    brc_scene *scene = good_scene("version: 1\nmaterials: {rock: {E: 1 GPa, nu: 0, density: 1 kg/m^3}}\nstages: "
                                  "[{name: go, solver: {dynamic: {steps: 1}}}]\n"
                                  "bodies:\n  - fill: {noisy_grid: {elements: 9}}\n    pose: {translation: [0, 0, 5 "
                                  "m]}\n    shape:\n      parts:\n"
                                  "        - {role: add, shape: {torus: {radius: 3 m, tube: 1 m}}}\n        - {role: "
                                  "add, shape: {sphere: {radius: 2 m}}, pose: {translation: [0, 0, 1 m]}}\n"
                                  "        - {role: remove, shape: {box: {size: [1 m, 1 m, 9 m]}}}\nplatens: {axis: z, "
                                  "speed: 1 m/s, gap: 1 mm}\n");
    const brc_striker *low = striker(scene, "platen_low"), *high = striker(scene, "platen_high");
    assert_true(fabs(high->shape.origin[2] - 8.001) < 1e-12 &&
                fabs(low->shape.origin[2] + low->shape.size[2] - 3.999) < 1e-12); /* sphere: -1 to 3 m, 5 m up */
    assert_true(fabs(low->shape.origin[0] + 4.8) < 1e-12 && fabs(low->shape.size[0] - 9.6) < 1e-12);
    brc_scene_free(&scene);
}

/* What is written with strikers, sensors and contact reads back as the same scene. */
static void expanded_scenes_read_back(void **state)
{
    (void)state;
    static const char *const text[] = {DISC "platens: {axis: y, speed: 0.2 m/s, friction: 0.3}\n",
                                       DISC "platens: {axis: y, force: 6 kN, ramp: 1 us}\n",
                                       DISC "jaws: {axis: y, radius: 30 mm, speed: 0.2 m/s, ramp: 1 us}\n",
                                       BEAM "rollers: {axis: y, span: 400 mm, diameter: 20 mm, speed: 20 mm/s}\n"};
    brc_context *context = brc_context_create();
    for (size_t k = 0; k < sizeof text / sizeof *text; ++k) {
        char *first = NULL, *second = NULL;
        brc_scene *scene = good_scene(text[k]);
        assert_int_equal(brc_scene_to_yaml(context, scene, &first), BRC_OK);
        brc_scene_free(&scene);
        assert_null(strstr(first, "\nplatens:"));
        scene = good_scene(first);
        assert_int_equal(brc_scene_to_yaml(context, scene, &second), BRC_OK);
        assert_string_equal(first, second);
        brc_scene_free(&scene);
        brc_memory_free(first);
        brc_memory_free(second);
    }
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(platens_stand_at_both_sides_of_the_body),
        cmocka_unit_test(tools_bring_steel_contact_sensors_a_measure_and_a_curve),
        cmocka_unit_test(what_the_scene_says_itself_stands),
        cmocka_unit_test(tools_are_pressed_by_a_force),
        cmocka_unit_test(jaws_are_hollow_towards_the_disc),
        cmocka_unit_test(rollers_lie_below_and_above_the_beam),
        cmocka_unit_test(tools_that_fit_no_body_are_refused_with_the_cure),
        cmocka_unit_test(bounds_are_those_of_what_is_added_and_moved),
        cmocka_unit_test(expanded_scenes_read_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
