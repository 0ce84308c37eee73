/* Reading good scenes into structs, and overrides. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>
#include "bad.h"

static void defaults_are_filled_in(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(HEAD "stages: [{name: s, solver: {dynamic: {steps: 10}}}, {name: q, solver: static}]\n");
    assert_int_equal(scene->model.kind, BRC_MODEL_DLSM);
    assert_true(scene->model.compaction);
    assert_true(scene->model.beta == 1.06 && scene->model.tau == 0.15);
    const brc_fill *fill = &scene->bodies[0].fill;
    assert_true(fill->spread == 0.9 && fill->seed == 1 && fill->lloyd_sweeps == 0 && fill->n_elements == 100);
    const brc_stage *dynamic = &scene->stages[0], *quiet = &scene->stages[1];
    assert_int_equal(dynamic->solver, BRC_SOLVER_DYNAMIC);
    assert_int_equal(dynamic->integrator, BRC_VELOCITY_VERLET);
    assert_int_equal(dynamic->time_step_rule, BRC_TIME_STEP_AUTO);
    assert_true(dynamic->safety == 0.8 && dynamic->steps == 10 && dynamic->duration == 0);
    assert_int_equal(quiet->solver, BRC_SOLVER_STATIC);
    assert_true(quiet->finite_strain && quiet->increments == 1 && quiet->tolerance == 0);
    assert_true(scene->output.picture);
    assert_string_equal(scene->output.picture_colour, "von_mises");
    assert_true(scene->output.n_frames == 0 && scene->output.history_every == 0);
    assert_string_equal(scene->folder, "folder");
    assert_false(scene->has_gravity);
    brc_scene_free(&scene);
}

static void words_stand_for_numbers(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(HEAD STAGES "output: {frames: none, picture: false}\n");
    assert_int_equal(scene->output.n_frames, -1);
    assert_false(scene->output.picture);
    assert_string_equal(scene->output.picture_colour, "von_mises"); /* a short form keeps the other defaults */
    brc_scene_free(&scene);
}

static void variants_keep_their_own_keys(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(HEAD "stages: [{name: s, solver: {dynamic: {duration: 2 ms, time_step: 0.5 us, "
                                       "integrator: {tchamwa-wielgosz: {phi: 1.1}}, mass_damping: 3 1/s}}}]\n"
                                       "model: {dlsm-published: {area_weights: true}}\n");
    assert_int_equal(scene->model.kind, BRC_MODEL_DLSM_PUBLISHED);
    assert_true(scene->model.area_weights && scene->model.rotation_stiffness == 1);
    const brc_stage *stage = &scene->stages[0];
    assert_int_equal(stage->integrator, BRC_TCHAMWA_WIELGOSZ);
    assert_int_equal(stage->time_step_rule, BRC_TIME_STEP_FIXED);
    assert_true(stage->phi == 1.1 && stage->time_step == 0.5e-6 && stage->duration == 2e-3 && stage->mass_damping == 3);
    brc_scene_free(&scene);
}

static void without_compaction_beta_is_zero(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(HEAD STAGES "model: {dlsm: {compaction: false}}\n");
    assert_true(!scene->model.compaction && scene->model.beta == 0 && scene->model.tau == 0.15);
    brc_scene_free(&scene);
}

static void loads_prescribe_what_is_written_and_leave_the_rest_free(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(HEAD "stages:\n"
                        "  - name: pull\n"
                        "    solver: {dynamic: {steps: 1}}\n"
                        "    loads:\n"
                        "      - face_displacement: {set: x+, x: 0, table: [[0, 0], [1 ms, 0.5]]}\n"
                        "      - element_velocity: {set: core, gradient: {y: [0, 0, 2 1/s]}, origin: [0, 1 mm, 0]}\n"
                        "      - traction: {set: lid, z: -2 MPa}\n"
                        "      - pressure: {set: y-, value: 3 kPa}\n");
    const brc_load *load = scene->stages[0].loads;
    assert_int_equal(scene->stages[0].n_loads, 4);
    assert_true(load[0].component[0] && !load[0].component[1] && !load[0].component[2]);
    assert_true(load[0].table.n == 2 && load[0].table.time[1] == 1e-3 && load[0].table.value[1] == 0.5);
    assert_int_equal(load[1].kind, BRC_LOAD_ELEMENT_VELOCITY);
    assert_true(!load[1].component[0] && load[1].component[1] && load[1].gradient[1][2] == 2 &&
                load[1].origin[1] == 1e-3);
    assert_true(load[2].component[0] && load[2].component[1] && load[2].value[2] == -2e6);
    assert_true(load[3].kind == BRC_LOAD_PRESSURE && load[3].value[0] == 3e3 && load[3].table.n == 0);
    brc_scene_free(&scene);
}

static void a_static_load_grows_with_the_increments(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(HEAD "stages:\n"
                        "  - {name: a, solver: static, loads: [{traction: {set: x+, x: 1 Pa}}]}\n"
                        "  - {name: b, solver: static, loads: [{traction: {set: x+, x: 1 Pa, table: [[0, 1]]}}]}\n");
    const brc_table *table = &scene->stages[0].loads[0].table;
    assert_true(brc_table_value(table, 0) == 0 && brc_table_value(table, 0.25) == 0.25 &&
                brc_table_value(table, 1) == 1);
    assert_true(brc_table_value(&scene->stages[1].loads[0].table, 0) == 1); /* a table of the user's stays */
    brc_scene_free(&scene);
}

static void directions_become_unit_vectors(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(HEAD "stages: [{name: s, solver: {dynamic: {steps: 1}}, initial: [{twist: {rate: 90 deg/m, "
                        "axis: [0, 3e-200, 4e-200]}}, {spin: {angular_velocity: [0, 0, 1 rad/s]}}]}]\n");
    const brc_initial *twist = &scene->stages[0].initials[0];
    assert_true(fabs(twist->axis[1] - 0.6) < 1e-15 && fabs(twist->axis[2] - 0.8) < 1e-15); /* one rounding or two */
    assert_true(fabs(twist->rate - M_PI / 2) < 1e-15);
    assert_true(scene->stages[0].initials[1].value[2] == 1);
    brc_scene_free(&scene);
}

static void names_become_indices_and_predicates_are_kept(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene("version: 1\n"
                   "materials: {a: {E: 1 Pa, nu: 0, density: 1 kg/m^3}, b: {E: 2 Pa, nu: 0, density: 1 kg/m^3}}\n"
                   "bodies:\n"
                   "  - shape: {cylinder: {axis: y, length: 1 m, radius: 1 cm}}\n"
                   "    fill: {noisy_grid: {spacing: 1 mm}}\n"
                   "    material: b\n"
                   "    regions: [{material: a, where: {half_space: {point: [0, 0, 0], normal: [0, 2, 0]}}}]\n"
                   "    pose: {translation: [0, 0, 1 m]}\n"
                   "sets: {rim: {faces: {wall: side, normal: {direction: [1, 0, 0], within: 30 deg}}}}\n" STAGES);
    const brc_body *body = &scene->bodies[0];
    assert_int_equal(body->material, 1);
    assert_int_equal(body->regions[0].material, 0);
    assert_true(body->regions[0].where.has_half_space && !body->regions[0].where.has_wall);
    assert_true(body->regions[0].where.half_space_normal[1] == 1);
    assert_int_equal(body->shape.axis, 1);
    assert_true(body->translation[2] == 1);
    const brc_set_request *set = &scene->sets[0];
    assert_string_equal(set->name, "rim");
    assert_int_equal(set->kind, BRC_SET_FACES);
    assert_true(set->where.has_wall && set->where.has_normal && fabs(set->where.normal_angle - M_PI / 6) < 1e-15);
    brc_scene_free(&scene);
}

static void targets_take_the_unit_of_their_measure(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(
        HEAD STAGES "sensors: {f: {reaction: {set: x+, component: x}}, u: {face_mean: {set: x+, component: x}}}\n"
                    "measure: {k: {slope: {of: f, against: u, target: 3 kN/mm}}, "
                    "m: {mean: {of: u, target: 0, window: [0.5, 1], scale: -1}}}\n");
    assert_true(scene->measures[0].has_target && scene->measures[0].target == 3e6);
    assert_string_equal(brc_measure_unit(scene, &scene->measures[0]), "N/m");
    assert_true(scene->measures[1].has_target && scene->measures[1].target == 0 && scene->measures[1].scale == -1);
    assert_true(scene->measures[1].window[0] == 0.5 && scene->measures[1].window[1] == 1);
    brc_scene_free(&scene);
}

static void overrides_find_their_way_by_index_and_name(void **state)
{
    (void)state;
    brc_scene *scene = good_scene_with(HEAD STAGES, "bodies.0.fill.noisy_grid.elements=1000");
    assert_int_equal(scene->bodies[0].fill.n_elements, 1000);
    brc_scene_free(&scene);
    scene = good_scene_with(HEAD STAGES, "bodies.cube.fill.noisy_grid.seed=7");
    assert_int_equal(scene->bodies[0].fill.seed, 7);
    brc_scene_free(&scene);
    scene = good_scene_with(HEAD STAGES, "materials.glass.nu=0.3");
    assert_true(scene->materials[0].poisson == 0.3);
    brc_scene_free(&scene);
    scene = good_scene_with(HEAD STAGES, "gravity=[0, 0, -9.81 m/s^2]");
    assert_true(scene->has_gravity && scene->gravity[2] == -9.81);
    brc_scene_free(&scene);
}

static void an_override_turns_a_word_into_its_map(void **state)
{
    (void)state;
    brc_scene *scene = good_scene_with(HEAD STAGES, "stages.pull.solver.static.increments=4");
    assert_int_equal(scene->stages[0].increments, 4);
    brc_scene_free(&scene);
    scene = good_scene_with(HEAD STAGES, "stages.0.solver.dynamic={duration: 1 ms}");
    assert_int_equal(scene->stages[0].solver, BRC_SOLVER_DYNAMIC);
    brc_scene_free(&scene);
    scene = good_scene_with(HEAD STAGES "model: dlsm\n", "model.dlsm.beta=0.75");
    assert_true(scene->model.beta == 0.75);
    brc_scene_free(&scene);
    scene = good_scene_with(HEAD STAGES, "model=dlsm-published");
    assert_int_equal(scene->model.kind, BRC_MODEL_DLSM_PUBLISHED);
    brc_scene_free(&scene);
}

static void bad_overrides_are_refused_by_name(void **state)
{
    (void)state;
    bad_override(HEAD STAGES, "materials.glass.mu=3", "unknown key 'mu'");
    bad_override(HEAD STAGES, "bodies.7.name=a", "the list has no item '7'");
    bad_override(HEAD STAGES, "bodies.sphere.name=a", "the list has no item 'sphere'");
    bad_override(HEAD STAGES, "bodies.cube.nam=a", "did you mean 'name'?");
    bad_override(HEAD STAGES, "materials.glass.E=3", "has no unit");
    bad_override(HEAD STAGES, "materials.glass.E=", "no value after '='");
    bad_override(HEAD STAGES, "materials.glass.E", "expected dotted.path=value");
    bad_override(HEAD STAGES, "=3", "expected dotted.path=value");
    bad_override(HEAD STAGES, "gravity=[0, 0", "not YAML");
    bad_override(HEAD STAGES, "a..b=1", "unknown key 'a'");
    bad_override(HEAD STAGES, "gravity={a: 1, a: 2}", "duplicate key 'a'");
}

static void views_of_pictures_are_a_side_or_two_points(void **state)
{
    (void)state;
    const char *const text = HEAD STAGES "output: {picture: {view: -z}}\n";
    brc_scene *scene = good_scene(text);
    assert_string_equal(scene->output.picture_view, "-z");
    assert_false(scene->output.has_picture_camera);
    brc_scene_free(&scene);
    scene = good_scene(HEAD STAGES "output: {picture: {camera: {from: [1 mm, 2 m, 3 m], towards: [0, 0, 1 cm]}}}\n");
    assert_string_equal(scene->output.picture_view, "corner");
    assert_true(scene->output.has_picture_camera && scene->output.picture_from[0] == 1e-3 &&
                scene->output.picture_towards[2] == 1e-2);
    brc_scene_free(&scene);
    bad_scene(HEAD STAGES "output: {picture: {view: above}}\n", "10:26", "'above'");
    bad_scene(HEAD STAGES "output: {picture: {camera: {towards: [0, 0, 1]}}}\n", "10:28", "from");
    bad_scene(HEAD STAGES "output: {picture: {view: z, camera: {from: [0, 0, 1]}}}\n", "10:26",
              "leave out one of them");
    bad_scene(HEAD STAGES "output: {picture: {camera: {from: [0, 0, 0]}}}\n", "10:35", "which gives no direction");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_filled_in),
        cmocka_unit_test(words_stand_for_numbers),
        cmocka_unit_test(variants_keep_their_own_keys),
        cmocka_unit_test(without_compaction_beta_is_zero),
        cmocka_unit_test(loads_prescribe_what_is_written_and_leave_the_rest_free),
        cmocka_unit_test(a_static_load_grows_with_the_increments),
        cmocka_unit_test(directions_become_unit_vectors),
        cmocka_unit_test(names_become_indices_and_predicates_are_kept),
        cmocka_unit_test(targets_take_the_unit_of_their_measure),
        cmocka_unit_test(overrides_find_their_way_by_index_and_name),
        cmocka_unit_test(an_override_turns_a_word_into_its_map),
        cmocka_unit_test(bad_overrides_are_refused_by_name),
        cmocka_unit_test(views_of_pictures_are_a_side_or_two_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
