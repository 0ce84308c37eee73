/* Scenes whose parts do not fit together: what needs more than one key to see. Line 9 is where the stages begin. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "bad.h"

#define STATIC "stages:\n  - name: pull\n    solver: static\n    loads:\n"
#define DYNAMIC "stages:\n  - name: pull\n    solver: {dynamic: {duration: 1 ms}}\n    loads:\n"

static void a_good_scene_has_no_errors(void **state)
{
    (void)state;
    assert_int_equal(count_errors(HEAD STAGES), 0);
}

static void missing_keys_are_named_where_their_map_begins(void **state)
{
    (void)state;
    bad_scene("version: 1\nmaterials:\n  glass: {E: 72 GPa, density: 2500 kg/m^3}\nbodies: [{domain: d.h5}]\n" STAGES,
              "3:10", "the key 'nu' is missing in this material: Poisson's ratio, as in nu: 0.23");
    bad_scene("materials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5}]\n" STAGES, "1:1",
              "the key 'version' is missing");
    bad_scene("version: 1\n" STAGES, "1:1", "the key 'bodies' is missing");
}

static void extreme_poisson_ratios_are_refused_with_the_reason(void **state)
{
    (void)state;
    static const char *const bad[] = {"0.5", "-1", "0.5000001", "-2", "3"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        char text[512];
        snprintf(text, sizeof text,
                 "version: 1\nmaterials:\n  g:\n    E: 1 Pa\n    nu: %s\n    density: 1 kg/m^3\n"
                 "bodies: [{domain: d.h5}]\n" STAGES,
                 bad[i]);
        bad_scene(text, "5:9", "it must be in (-1, 0.5): at 0.5 the solid is incompressible");
    }
    static const char *const good[] = {"0.4999", "-0.9999", "0"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; ++i) {
        char text[512];
        snprintf(text, sizeof text,
                 "version: 1\nmaterials: {g: {E: 1 Pa, nu: %s, density: 1 kg/m^3}}\n"
                 "bodies: [{domain: d.h5}]\n" STAGES,
                 good[i]);
        assert_int_equal(count_errors(text), 0);
    }
}

static void misspelt_keys_are_guessed(void **state)
{
    (void)state;
    bad_scene(HEAD STAGES "sensrs: {}\n", "10:1", "did you mean 'sensors'?");
    bad_scene(HEAD "stages: [{name: p, solver: statc}]\n", "9:28", "did you mean 'static'?");
    bad_scene(HEAD "stages: [{name: p, solver: {dynamik: {steps: 1}}}]\n", "9:29", "did you mean 'dynamic'?");
    bad_scene(HEAD STAGES "output: {picture: {colour: vonmises}}\n", "10:28", "did you mean von_mises?");
    bad_scene(HEAD STAGES "xyzzyplugh: 1\n", "10:1", "unknown key 'xyzzyplugh' in a scene; known: version, title");
    bad_scene(HEAD STAGES "interactions: {interface: []}\n", "10:16",
              "unknown key 'interface' in interactions; did you mean 'interfaces'?");
    bad_scene(HEAD STAGES "output: {curve: {x: 80 %, y: 80 %}}\n", "10:21",
              "x: '80 %' is no name: expected 1 to 63 letters, digits or _ + -");
    bad_scene(HEAD STAGES "sensors: {a b: {energy: work}}\n", "10:11", "key a b is no name");
    bad_scene(HEAD STAGES "output: {xyzzyplugh: 1}\n", "10:10", "unknown key 'xyzzyplugh' in an output; known: ");
}

static void walls_and_strikers_need_contact_and_a_free_one_a_shape(void **state)
{
    (void)state;
    static const char plane[] = "strikers: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: glass}}\n";
    char text[1024];
    bad_scene(HEAD STAGES "strikers: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: glass}}\n",
              "10:19", "touches nothing: it needs `interactions: {contact: {}}`");
    snprintf(text, sizeof text, "%sinteractions: {contact: {friction: 0.4}}\n%s", HEAD STAGES, plane);
    assert_int_equal(count_errors(text), 0);
    snprintf(text, sizeof text, "%sinteractions: {contact: {}}\n%s", HEAD STAGES,
             "strikers: {ball: {shape: {sphere: {centre: [0, 0, 2 m], radius: 10 cm}}, material: glass,"
             " motion: {free: {velocity: [0, 0, -5 m/s], spin: [1 rad/s, 0, 0], mass: 2 kg, hold: {x: true}}}}}\n");
    assert_int_equal(count_errors(text), 0);
    bad_scene(HEAD STAGES
              "interactions: {contact: {}}\n"
              "strikers: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: glass, motion: free}}\n",
              "11:91", "an endless plane has no mass");
    bad_scene(HEAD STAGES "sensors: {pairs: {contact: pairs}}\n", "10:28", "this sensor needs `interactions");
    bad_scene(HEAD STAGES "interactions: {contact: {}}\nsensors: {push: {striker: {name: flor, quantity: force}}}\n"
                          "strikers: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: glass}}\n",
              "11:34", "there is no striker 'flor'; did you mean 'floor'?");
}

static void a_prescribed_force_acts_in_dynamic_stages_on_what_may_move(void **state)
{
    (void)state;
#define BALL(motion)                                                                                                   \
    "interactions: {contact: {}}\nstrikers:\n  ball: {shape: {sphere: {centre: [0, 0, 3 m], radius: 10 cm}}, "         \
    "material: glass, motion: {free: {" motion "}}}\n"
#define MOVING "stages: [{name: pull, solver: {dynamic: {steps: 1}}}]\n"
    brc_scene *scene = good_scene(HEAD MOVING BALL("force: [0, 0, -1 N]"));
    assert_true(scene->strikers[0].pushed && scene->strikers[0].force[2] == -1);
    brc_scene_free(&scene);
    bad_scene(HEAD STAGES BALL("force: [0, 0, -1 N]"), "12:105",
              "moves 'ball' in dynamic stages, and the scene has none. At rest, load a wall of the body by `traction`");
    bad_scene(HEAD MOVING BALL("force: [1 N, 0, -1 N], hold: {x: true}"), "12:105",
              "has no effect along x, where `hold` lets the striker not move; expected 0 there");
    bad_scene(HEAD MOVING BALL("table: [[0, 0], [1 s, 1]]"), "12:105",
              "table: is the factor of a prescribed force, and there is none; give `force`");
}

static void with_contact_a_rest_comes_before_what_moves(void **state)
{
    (void)state;
    static const char contact[] = "interactions: {contact: {}}\n", rest[] = "  - {name: rest, solver: static}\n";
    static const char modes[] = "  - {name: hum, solver: {modes: {count: 8}}}\n",
                      move[] = "  - {name: go, solver: {dynamic: {steps: 3}}}\n";
    char text[1200];
    snprintf(text, sizeof text, "%s%sstages:\n%s%s%s", HEAD, contact, rest, modes, move);
    assert_int_equal(count_errors(text), 0);
    snprintf(text, sizeof text, "%s%sstages:\n%s%s%s", HEAD, contact, move, rest, modes);
    bad_scene(text, "12:26", "expected before the first dynamic stage, which is 'go'");
    assert_int_equal(count_errors(text), 2);
    snprintf(text, sizeof text, "%sstages:\n%s%s", HEAD, move, rest); /* without contact in any order */
    assert_int_equal(count_errors(text), 0);
    static const char tear[] = "stages:\n  - {name: tear, solver: {static: {events: 5}}}\n";
    snprintf(text, sizeof text, "%sfracture: {}\n%s%s", HEAD, contact, tear);
    bad_scene(text, "12:44", "events: they know no contact");
    snprintf(
        text, sizeof text,
        "version: 1\nmaterials: {glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3, strength: {tension: 50 MPa}}}\n"
        "bodies: [{shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 100}}}]\nfracture: {}\n%s",
        tear);
    assert_int_equal(count_errors(text), 0);
}

static void couple_modulus_is_for_dynamic_stages(void **state)
{
    (void)state;
    static const char model[] = "model: {dlsm-published: {couple_modulus: 0.5}}\n",
                      move[] = "  - {name: go, solver: {dynamic: {steps: 3}}}\n";
    char text[1200];
    snprintf(text, sizeof text, "%s%sstages:\n%s", HEAD, model, move);
    assert_int_equal(count_errors(text), 0);
    snprintf(text, sizeof text, "%s%sstages:\n  - {name: rest, solver: static}\n%s", HEAD, model, move);
    bad_scene(text, "9:42", "static stages and modes do not know ('rest' is one)");
    snprintf(text, sizeof text,
             "%smodel: {dlsm-published: {couple_modulus: 0}}\nstages:\n  - {name: rest, solver: static}\n", HEAD);
    assert_int_equal(count_errors(text), 0);
}

static void all_errors_are_told_in_one_pass_in_the_order_of_the_text(void **state)
{
    (void)state;
    static const char text[] = "version: 2\n"
                               "materials:\n"
                               "  glass: {E: 72, nu: nan, density: 2500 kg/m}\n"
                               "bodies: [{domain: d.h5, material: glas}]\n"
                               "stages: [{name: p, solver: {modes: {count: 0}}}]\n"
                               "colour: red\n";
    assert_int_equal(count_errors(text), 7);
    static const char *const places[] = {"1:10", "3:14", "3:22", "3:36", "4:35", "5:44", "6:1"};
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    brc_scene_read_text(context, "s.yaml", text, strlen(text), 0, NULL, &scene);
    const char *at = brc_context_message(context);
    for (int i = 0; i < 7; ++i) {
        char start[32];
        snprintf(start, sizeof start, "s.yaml:%s: error:", places[i]);
        at = at ? strstr(at, start) : NULL;
        if (!at) fail_msg("no or misplaced %s in\n%s", start, brc_context_message(context));
    }
    brc_context_free(&context);
}

static void several_of_one_and_none_of_several_are_refused(void **state)
{
    (void)state;
    bad_scene(HEAD "stages: [{name: p, solver: {dynamic: {steps: 1, duration: 1 s}}}]\n", "9:49",
              "expected only one of");
    bad_scene(HEAD "stages: [{name: p, solver: {dynamic: {}}}]\n", "9:38",
              "expected exactly one of duration, steps; found none");
    bad_scene(HEAD "stages: [{name: p, solver: dynamic}]\n", "9:28",
              "expected exactly one of duration, steps; found none");
    bad_scene(HEAD "stages: [{name: p, solver: {static: {}, modes: {count: 1}}}]\n", "9:28", "expected exactly one of");
    bad_scene(HEAD STAGES "output: {frames: 3, frame_interval: 1 ms}\n", "10:21", "expected only one of");
    bad_scene(HEAD STATIC "      - face_displacement: {set: x+}\n", "13:28",
              "expected at least one of x, y, z, gradient");
}

static void a_shape_needs_a_fill_and_a_file_none(void **state)
{
    (void)state;
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies:\n"
              "  - shape: {sphere: {radius: 1 m}}\n" STAGES,
              "4:5", "the key 'fill' is missing");
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies:\n"
              "  - domain: d.h5\n    fill: {noisy_grid: {elements: 3}}\n" STAGES,
              "4:13", "the file is cut already");
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies:\n"
              "  - fill: {noisy_grid: {elements: 3}}\n" STAGES,
              "4:5", "expected exactly one of shape, domain");
}

static void a_body_names_its_material_where_there_are_several(void **state)
{
    (void)state;
    bad_scene(
        "version: 1\nmaterials: {a: {E: 1 Pa, nu: 0, density: 1 kg/m^3}, b: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\n"
        "bodies:\n  - domain: d.h5\n" STAGES,
        "4:5", "the key 'material' is missing in this body");
}

static void unknown_names_are_refused_with_the_nearest(void **state)
{
    (void)state;
    bad_scene("version: 1\nmaterials: {glass: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5, material: "
              "glas}]\n" STAGES,
              "3:35", "there is no material 'glas'; did you mean 'glass'?");
    bad_scene(HEAD STATIC "      - face_displacement: {set: lidd, x: 0}\n", "13:34",
              "there is no wall, body or set of faces 'lidd'; did you mean 'lid'?");
    bad_scene(HEAD STATIC "      - face_displacement: {set: core, x: 0}\n", "13:34",
              "(that name is a set of elements)");
    bad_scene(HEAD STATIC "      - element_displacement: {set: x-, x: 0}\n", "13:37", "(that name is a set of faces)");
    bad_scene(HEAD STAGES "sensors: {s: {reaction: {set: side, component: x}}}\n", "10:31",
              "there is no wall, body or set 'side'");
    bad_scene(HEAD STAGES "output: {curve: {x: nobody, y: nobody}}\n", "10:21",
              "there is no sensor 'nobody'; define it under sensors");
    bad_scene(HEAD STAGES "sensors: {s: {energy: work}}\nmeasure: {m: {mean: {of: s, stage: pul}}}\n", "11:36",
              "there is no stage 'pul'; did you mean 'pull'?");
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\n"
              "bodies: [{shape: {sphere: {radius: 1 m}}, fill: {noisy_grid: {elements: 9}}}]\nsets: {a: {faces: "
              "x-}}\n" STAGES,
              "4:19", "there is no wall 'x-'; known: surface");
}

static void names_in_a_domain_file_are_not_judged(void **state)
{
    (void)state;
    assert_int_equal(
        count_errors(
            "version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5}]\n" STATIC
            "      - face_displacement: {set: whatever, x: 0}\n"),
        0);
}

static void sets_are_not_named_like_walls(void **state)
{
    (void)state;
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5}]\n"
              "sets:\n  side: {faces: {wall: x-}}\n" STAGES,
              "5:9", "the set 'side' has the name of a wall");
}

static void predicates_that_hold_nowhere_are_refused(void **state)
{
    (void)state;
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5}]\n"
              "sets:\n  s: {faces: {box: {from: [0, 1 m, 0], to: [1 m, 0, 1 m]}}}\n" STAGES,
              "5:44", "lies before `from` in y");
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5}]\n"
              "sets:\n  s: {elements: {normal: {direction: [0, 0, 1]}}}\n" STAGES,
              "5:38", "elements have no outward normal");
}

static void overlapping_prescribed_components_are_refused(void **state)
{
    (void)state;
    bad_scene(HEAD STATIC "      - face_displacement: {set: x+, x: 1 um}\n"
                          "      - face_displacement: {set: x+, x: 2 um, y: 0}\n",
              "14:34", "the x component of 'x+' is prescribed by an earlier load");
    bad_scene(HEAD DYNAMIC "      - face_displacement: {set: x+, y: 1 um}\n"
                           "      - face_velocity: {set: x+, gradient: {y: [0, 1 1/s, 0]}}\n",
              "14:30", "the y component of 'x+'");
    bad_scene(HEAD STATIC "      - traction: {set: lid, z: 1 Pa}\n"
                          "      - face_displacement: {set: lid, z: 0}\n",
              "14:34", "a traction along z has no effect");
    assert_int_equal(count_errors(HEAD STATIC "      - face_displacement: {set: x+, x: 1 um}\n"
                                              "      - face_displacement: {set: x+, y: 0, z: 0}\n"
                                              "      - traction: {set: lid, z: 1 Pa}\n"
                                              "      - face_displacement: {set: lid, x: 0}\n"),
                     0);
}

static void a_static_stage_has_no_velocities_and_ends_at_one(void **state)
{
    (void)state;
    bad_scene(HEAD STATIC "      - face_velocity: {set: x+, x: 1 m/s}\n", "13:9", "a static stage has no velocities");
    bad_scene(HEAD STATIC "      - traction: {set: x+, x: 1 Pa, table: [[0, 0], [2, 1]]}\n", "13:55",
              "it must be in [0, 1]");
    bad_scene(HEAD STATIC "      - traction: {set: x+, x: 1 Pa, table: [[0, 0], [1 s, 1]]}\n", "13:55", "another kind");
    bad_scene(HEAD DYNAMIC "      - traction: {set: x+, x: 1 Pa, table: [[0, 0], [0.5, 1]]}\n", "13:55", "has no unit");
}

#define BEAMS                                                                                                          \
    "version: 1\nmodel: cbm\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies:\n  - name: cube\n    "       \
    "shape: "                                                                                                          \
    "{box: {size: [1 m, 1 m, 1 m]}}\n    fill: {packing: {radius: 60 mm}}\n    beams: 8\n"

/* What no model of the scene can do is told of before anything is built. */
static void stages_ask_of_models_what_they_can_do(void **state)
{
    (void)state;
    bad_scene(HEAD DYNAMIC "      - face_displacement: {set: x+, x: 1 um}\nmodel: dlsm-published\n", "13:9",
              "model dlsm-published moves whole elements; use element_displacement");
    bad_scene(HEAD DYNAMIC "      - face_velocity: {set: x+, x: 1 m/s}\nmodel: dlsm-published\n", "13:9",
              "use element_velocity");
    bad_scene(HEAD DYNAMIC "      - element_rotation: {set: cube, x: 0}\n", "13:9",
              "elements of model dlsm have no rotations of their own");
    bad_scene(HEAD STATIC "      - element_rotation: {set: cube, x: 0}\nmodel: dlsm-published\n", "13:9",
              "are not solved for in this stage");
    bad_scene(BEAMS "stages: [{name: a, solver: {dynamic: {steps: 3, time_step: published}}}]\n", "9:60",
              "the published rule is one for cells, model cbm has none");
    bad_scene(HEAD "gravity: [0, 0, -9.81 m/s^2]\nstages:\n  - name: pull\n    solver: {static: {events: {most: 3}}}\n",
              "12:38", "gravity does not follow");
    assert_int_equal(count_errors(HEAD DYNAMIC "      - element_rotation: {set: cube, x: 0}\nmodel: dlsm-published\n"),
                     0);
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: d.h5, model: "
              "dlsm-published}]\n" DYNAMIC "      - face_velocity: {set: x+, x: 1 m/s}\n",
              "8:9", "model dlsm-published moves whole elements"); /* the body's, not the scene's */
    assert_int_equal(count_errors("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\n" DYNAMIC
                                  "      - element_rotation: {set: cube, x: 0}\n"),
                     1); /* no bodies: that alone */
    assert_int_equal(count_errors(BEAMS STATIC "      - element_rotation: {set: cube, x: 0}\n"), 0);
}

static void names_of_stages_and_bodies_are_unique(void **state)
{
    (void)state;
    bad_scene(HEAD "stages: [{name: a, solver: static}, {name: a, solver: static}]\n", "9:44",
              "another stage is called 'a' too");
    bad_scene("version: 1\nmaterials: {g: {E: 1 Pa, nu: 0, density: 1 kg/m^3}}\nbodies: [{domain: a.h5}, {domain: "
              "b.h5}]\n" STAGES,
              "3:26", "another body is called 'body' too");
}

static void modes_that_are_not_computed_have_no_sensor(void **state)
{
    (void)state;
    bad_scene(HEAD STAGES "sensors: {s: {mode: 0}}\n", "10:21", "0 is not computed");
    bad_scene(HEAD "stages: [{name: m, solver: {modes: {count: 3}}}]\nsensors: {s: {mode: 3}}\n", "10:21",
              "computes 3");
    assert_int_equal(count_errors(HEAD "stages: [{name: m, solver: {modes: {count: 3}}}]\nsensors: {s: {mode: 2}}\n"),
                     0);
}

#define SENSORS                                                                                                        \
    "sensors: {f: {reaction: {set: x+, component: x}}, s: {stress: {component: xx}}, e: {strain: {component: xx}}}\n"

static void measures_ask_for_fitting_sensors(void **state)
{
    (void)state;
    bad_scene(HEAD STAGES SENSORS "measure: {m: {E: {load: f, strain: e}}}\n", "11:25", "a reaction needs `area`");
    bad_scene(HEAD STAGES SENSORS "measure: {m: {E: {load: s, strain: e, area: x+}}}\n", "11:25", "expected N");
    bad_scene(HEAD STAGES SENSORS "measure: {m: {nu: {lateral: f, axial: e}}}\n", "11:29",
              "gives values in N; expected -");
    bad_scene(HEAD STAGES SENSORS "measure: {m: {mean: {of: f, target: 3 m}}}\n", "11:37", "expected a quantity in N");
    bad_scene(HEAD STAGES SENSORS "measure: {m: {mean: {of: f, window: [1, 0.5]}}}\n", "11:37",
              "ends before it begins");
    bad_scene(HEAD STAGES SENSORS "measure: {m: {frequency: {of: f}}}\n", "11:14", "the stage 'pull' is not dynamic");
}

/* The area vectors of a wall that goes all the way round sum to zero: a load over the area across them would be a load
 * over rounding. */
static void the_area_of_a_measure_is_of_a_wall_that_has_sides(void **state)
{
    (void)state;
    static const struct {
        const char *shape, *area, *sets;
        int is_refused;
    } wall[] = {
        {"cylinder: {axis: z, length: 1 m, radius: 1 m}", "side", "", 1},
        {"cylinder: {axis: z, length: 1 m, radius: 1 m}", "mantle", "sets: {mantle: {faces: {wall: side}}}\n", 1},
        {"cylinder: {axis: z, length: 1 m, radius: 1 m}", "half",
         "sets: {half: {faces: {wall: side, normal: {direction: [1, 0, 0], within: 80 deg}}}}\n", 0},
        {"cylinder: {axis: z, length: 1 m, radius: 1 m}", "z+", "", 0},
        {"sphere: {radius: 1 m}", "surface", "", 1},
        {"cone: {axis: z, length: 1 m, radius: 1 m, end_radius: 2 m}", "side", "", 0}};
    for (size_t k = 0; k < sizeof wall / sizeof *wall; ++k) {
        char text[1024];
        snprintf(text, sizeof text,
                 "version: 1\nmaterials: {glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}}\nbodies: [{name: b, "
                 "shape: {%s}, fill: {noisy_grid: {elements: 100}}}]\n" STAGES
                 "sensors: {f: {stress: {component: xx}}}\nmeasure: {m: {peak: {of: f, area: %s}}}\n%s",
                 wall[k].shape, wall[k].area, wall[k].sets);
        if (wall[k].is_refused)
            bad_scene(text, "6:35", "goes all the way round");
        else
            assert_int_equal(count_errors(text), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_good_scene_has_no_errors),
        cmocka_unit_test(missing_keys_are_named_where_their_map_begins),
        cmocka_unit_test(extreme_poisson_ratios_are_refused_with_the_reason),
        cmocka_unit_test(misspelt_keys_are_guessed),
        cmocka_unit_test(walls_and_strikers_need_contact_and_a_free_one_a_shape),
        cmocka_unit_test(a_prescribed_force_acts_in_dynamic_stages_on_what_may_move),
        cmocka_unit_test(with_contact_a_rest_comes_before_what_moves),
        cmocka_unit_test(couple_modulus_is_for_dynamic_stages),
        cmocka_unit_test(all_errors_are_told_in_one_pass_in_the_order_of_the_text),
        cmocka_unit_test(several_of_one_and_none_of_several_are_refused),
        cmocka_unit_test(a_shape_needs_a_fill_and_a_file_none),
        cmocka_unit_test(a_body_names_its_material_where_there_are_several),
        cmocka_unit_test(unknown_names_are_refused_with_the_nearest),
        cmocka_unit_test(names_in_a_domain_file_are_not_judged),
        cmocka_unit_test(sets_are_not_named_like_walls),
        cmocka_unit_test(predicates_that_hold_nowhere_are_refused),
        cmocka_unit_test(overlapping_prescribed_components_are_refused),
        cmocka_unit_test(a_static_stage_has_no_velocities_and_ends_at_one),
        cmocka_unit_test(stages_ask_of_models_what_they_can_do),
        cmocka_unit_test(names_of_stages_and_bodies_are_unique),
        cmocka_unit_test(modes_that_are_not_computed_have_no_sensor),
        cmocka_unit_test(measures_ask_for_fitting_sensors),
        cmocka_unit_test(the_area_of_a_measure_is_of_a_wall_that_has_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
