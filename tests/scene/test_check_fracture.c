/* Scenes in which nothing can break, models and stages that do not fit what breaks: told at their place, before
 * anything is built. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "bad.h"

/* Lines 1 to 6; then keys of the one body (line 7), and what follows. */
#define MATERIALS(strength)                                                                                            \
    "version: 1\n"                                                                                                     \
    "materials:\n"                                                                                                     \
    "  glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3" strength "}\n"                                               \
    "  steel: {E: 210 GPa, nu: 0.3, density: 7800 kg/m^3}\n"                                                           \
    "bodies:\n"
#define CELLS                                                                                                          \
    "  - {name: cube, material: glass, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 100}}"
#define SPHERES                                                                                                        \
    "  - {name: pack, material: glass, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {packing: {elements: 100}}, "      \
    "beams: 8"
#define STRONG ", strength: {tension: 50 MPa}"
#define SOFT ", strength: {tension: 50 MPa, fracture_energy: 8 J/m^2}"
#define STATIC "  - {name: pull, solver: static}\n"
#define DYNAMIC "  - {name: go, solver: {dynamic: {steps: 3}}}\n"
#define EVENTS "  - {name: tear, solver: {static: {events: 5}}}\n"

static char text[4096];
static const char *scene_of(const char *materials, const char *body, const char *own, const char *rest)
{
    snprintf(text, sizeof text, "%s%s%s}\n%s", materials, body, own, rest);
    return text;
}

static void a_scene_whose_stages_break_nothing_is_told_of(void **state)
{
    (void)state;
    char said[2048];
    warned_scene(scene_of(MATERIALS(STRONG), CELLS, "", "fracture: {}\nstages:\n" STATIC), "7:1",
                 "no stage breaks a bond");
    warned_scene(scene_of(MATERIALS(STRONG), CELLS, "", "fracture: {}\nstages:\n" STATIC), "7:1",
                 "or `solver: {static: {events: 100}}`");
    warned_scene(scene_of(MATERIALS(SOFT), CELLS, "", "fracture: {}\nstages:\n" STATIC), "7:1",
                 "use a dynamic stage with mass_damping");
    static const char *const breaks[] = {STATIC DYNAMIC, EVENTS,
                                         "  - {name: to, solver: {static: {to_failure: 80 %}}}\n",
                                         STATIC "sensors: {ratio: {fracture: failure_ratio}}\n"};
    for (size_t k = 0; k < sizeof breaks / sizeof *breaks; ++k) {
        char rest[512];
        snprintf(rest, sizeof rest, "fracture: {}\nstages:\n%s", breaks[k]);
        assert_string_equal(warnings_of(scene_of(MATERIALS(STRONG), CELLS, "", rest), said, sizeof said), "");
    }
}

static void a_scene_without_any_strength_is_refused_where_fracture_stands(void **state)
{
    (void)state;
    bad_scene(scene_of(MATERIALS(""), CELLS, "", "fracture: {}\nstages:\n" DYNAMIC), "7:1",
              "nothing can break: no material of a body has a strength; give one `strength: {tension: 50 MPa}`");
    bad_scene(scene_of(MATERIALS(", strength: {compression: 50 MPa}"), CELLS, "", "fracture: {}\nstages:\n" DYNAMIC),
              "7:1", "in tension, which bonds of cells break by");
    assert_int_equal(count_errors(scene_of(MATERIALS(", strength: {compression: 50 MPa}"), CELLS, "",
                                           "fracture: {criterion: virial-principal}\nstages:\n" DYNAMIC)),
                     0);
    assert_int_equal(
        count_errors(
            scene_of(MATERIALS(""), CELLS, "",
                     "fracture: {criterion: {mohr-coulomb: {cohesion: 1 MPa, friction: 30 deg}}}\nstages:\n" DYNAMIC)),
        0);
    assert_int_equal(count_errors(scene_of(
                         MATERIALS(""), CELLS, ", grains: {number: 5}",
                         "fracture: {}\ninteractions: {interfaces: [{grains: {tension: 1 MPa}}]}\nstages:\n" DYNAMIC)),
                     0);
    assert_int_equal(count_errors(scene_of(MATERIALS(", beam: {radius: 0.4, E: 100 GPa, strength: 60 MPa}"), SPHERES,
                                           "", "model: cbm\nfracture: {}\nstages:\n" DYNAMIC)),
                     0);
    assert_int_equal(count_errors(scene_of(MATERIALS(STRONG), CELLS, ", regions: [{material: steel, where: x-}]",
                                           "fracture: {}\nstages:\n" DYNAMIC)),
                     0);
}

static void models_are_refused_where_their_bodies_are_of_the_other_kind(void **state)
{
    (void)state;
    bad_scene(scene_of(MATERIALS(""), CELLS, "", "model: cbm\nstages:\n" DYNAMIC), "7:8",
              "model cbm needs spheres joined by beams, and body 'cube' is made of cells; add `beams: 8`");
    bad_scene(scene_of(MATERIALS(""), CELLS, ", model: cbm", "stages:\n" DYNAMIC), "6:118",
              "body 'cube' is made of cells");
    bad_scene(scene_of(MATERIALS(""), SPHERES, "", "stages:\n" DYNAMIC), "6:115",
              "beams: model dlsm needs cells, and body 'pack' is made of spheres");
    bad_scene(scene_of(MATERIALS(""), SPHERES, "", "model: dlsm-published\nstages:\n" DYNAMIC), "6:115",
              "model dlsm-published needs cells");
}

static void criteria_and_energies_are_refused_where_the_model_has_none(void **state)
{
    (void)state;
    bad_scene(
        scene_of(MATERIALS(STRONG), SPHERES, "", "model: cbm\nfracture: {criterion: bond-normal}\nstages:\n" DYNAMIC),
        "8:23", "bond-normal is for cells, and body 'pack' is of model cbm");
    bad_scene(scene_of(MATERIALS(SOFT), CELLS, "", "model: dlsm-published\nfracture: {}\nstages:\n" DYNAMIC), "3:99",
              "the bonds of body 'cube' (model dlsm-published) break at once");
    bad_scene(scene_of(MATERIALS(SOFT), CELLS, "", "fracture: {criterion: virial-principal}\nstages:\n" DYNAMIC),
              "3:99", "(model dlsm, a criterion of elements)");
    bad_scene(scene_of(MATERIALS(STRONG), CELLS, ", grains: {number: 5}",
                       "model: dlsm-published\nfracture: {}\ninteractions: {interfaces: [{grains: {fracture_energy: 1 "
                       "J/m^2}}]}\nstages:\n" DYNAMIC),
              "9:56", "the bonds of body 'cube' (model dlsm-published) break at once");
    bad_scene(scene_of(MATERIALS(", strength: {compression: 9 MPa}"), CELLS,
                       ", regions: [{material: steel, where: x-}]",
                       "fracture: {criterion: virial-principal}\ninteractions: {interfaces: [{materials: {first: "
                       "glass, second: steel, tension: 1 MPa}}]}\nstages:\n" DYNAMIC),
              "8:80", "neither 'glass' nor 'steel' has one");
    bad_scene(scene_of(MATERIALS(STRONG), CELLS, "",
                       "model: {dlsm: {small_rotations: true}}\nfracture: {}\nstages:\n" DYNAMIC),
              "7:33", "a linearised law does not break");
}

#define SLIDES "fracture: {criterion: {mohr-coulomb: {cohesion: 10 MPa, friction: 30 deg}}}\nstages:\n" DYNAMIC
#define SOFT_SHEAR ", strength: {tension: 50 MPa, fracture_energy: 8 J/m^2, shear_fracture_energy: 9 J/m^2}"
static void limits_that_nothing_looks_at_are_told(void **state)
{
    (void)state;
    assert_int_equal(count_errors(scene_of(MATERIALS(SOFT), CELLS, "", SLIDES)), 0);
    assert_int_equal(count_errors(scene_of(MATERIALS(SOFT_SHEAR), CELLS, "", SLIDES)), 0);
    bad_scene(scene_of(MATERIALS(", strength: {tension: 50 MPa, shear_fracture_energy: 9 J/m^2}"), CELLS, "", SLIDES),
              "3:105", "expected `fracture_energy` beside it");
    bad_scene(scene_of(MATERIALS(SOFT_SHEAR), CELLS, "", "fracture: {}\nstages:\n" DYNAMIC), "3:131",
              "body 'cube' (model dlsm) would not look at it; add `fracture: {criterion: {mohr-coulomb:");
    bad_scene(scene_of(MATERIALS(SOFT_SHEAR), SPHERES, "", "model: cbm\n" SLIDES), "3:131",
              "beams and others take their fracture_energy whatever the mode");
    bad_scene(scene_of(MATERIALS(", strength: {tension: 50 MPa, compression: 90 MPa, fracture_energy: 8 J/m^2}"), CELLS,
                       "", SLIDES),
              "3:95", "fail in compression by sliding; this cohesion bears 2 c cos(phi) / (1 - sin(phi)) = 34.64 MPa");
    warned_scene(
        scene_of(MATERIALS(", strength: {tension: 50 MPa, compression: 90 MPa}"), CELLS, "",
                 "fracture: {}\nstages:\n" DYNAMIC),
        "3:95", "bonds of cells break by tension alone (criterion bond-normal), and body 'cube' bears any compression");
    warned_scene(
        scene_of(MATERIALS(SOFT), CELLS, "",
                 "fracture: {criterion: {mohr-coulomb: {cohesion: 10 MPa, friction: 10 deg}}}\nstages:\n" DYNAMIC),
        "7:67", "sides that have slid rub by 0.3, more than the solid's tan(10 deg) = 0.176");
    bad_scene(scene_of(MATERIALS(SOFT), CELLS, "", SLIDES "sensors: {r: {fracture: failure_ratio}}\n"), "10:25",
              "is not known of cells that slide");
}

static void stages_are_refused_where_bonds_that_soften_cannot_follow(void **state)
{
    (void)state;
    bad_scene(scene_of(MATERIALS(SOFT), CELLS, "",
                       "fracture: {}\nstages:\n  - {name: go, solver: {dynamic: {steps: 3, noise_damping: 2 %}}}\n"),
              "9:60", "it would drag on faces that open against cohesion; leave out noise_damping or fracture_energy");
    bad_scene(scene_of(MATERIALS(SOFT), CELLS, "", "fracture: {}\nstages:\n" EVENTS), "9:44",
              "they break bonds at once, and those of this scene soften; remove `fracture_energy`");
    bad_scene(scene_of(MATERIALS(""), SPHERES, "",
                       "model: cbm\nstages:\n  - {name: go, solver: {dynamic: {steps: 3, noise_damping: 2 %}}}\n"),
              "9:60", "made of the bonds of model dlsm, and body 'pack' is of model cbm");
    warned_scene(scene_of(MATERIALS(SOFT), CELLS, "", "fracture: {}\nstages:\n" DYNAMIC STATIC), "10:26",
                 "refused if a bond has opened against its cohesion in stage 'go' or later");
    char said[2048];
    assert_string_equal(
        warnings_of(scene_of(MATERIALS(SOFT), CELLS, "", "fracture: {}\nstages:\n" STATIC DYNAMIC), said, sizeof said),
        "");
    assert_string_equal(warnings_of(scene_of(MATERIALS(STRONG), CELLS, "", "fracture: {}\nstages:\n" DYNAMIC STATIC),
                                    said, sizeof said),
                        "");
}

static void all_of_them_are_told_in_one_pass(void **state)
{
    (void)state;
    assert_int_equal(count_errors(scene_of(MATERIALS(SOFT), CELLS, "",
                                           "model: dlsm-published\nfracture: {}\nstages:\n" EVENTS
                                           "  - {name: go, solver: {dynamic: {steps: 3, noise_damping: 2 %}}}\n")),
                     4);
}

static void friction_of_sides_is_for_scenes_in_which_they_touch(void **state)
{
    (void)state;
    char said[2048];
    bad_scene(scene_of(MATERIALS(STRONG), CELLS, "",
                       "fracture: {friction: 0.4}\ninteractions: {contact: {friction: 0.2}}\nstages:\n" DYNAMIC),
              "7:22", "surfaces of this scene rub by `interactions: {contact: {friction: ...}}`");
    bad_scene(scene_of(MATERIALS(STRONG), CELLS, "", "fracture: {closure: false, friction: 0}\nstages:\n" DYNAMIC),
              "7:38", "with `closure: false` the sides of broken faces do not touch; remove friction, or closure");
    static const char *const taken[] = {"fracture: {friction: 0.4}\nstages:\n" DYNAMIC,
                                        "fracture: {friction: auto}\ninteractions: {contact: {}}\nstages:\n" DYNAMIC};
    for (int k = 0; k < 2; ++k)
        assert_string_equal(warnings_of(scene_of(MATERIALS(STRONG), CELLS, "", taken[k]), said, sizeof said), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_whose_stages_break_nothing_is_told_of),
        cmocka_unit_test(a_scene_without_any_strength_is_refused_where_fracture_stands),
        cmocka_unit_test(models_are_refused_where_their_bodies_are_of_the_other_kind),
        cmocka_unit_test(criteria_and_energies_are_refused_where_the_model_has_none),
        cmocka_unit_test(limits_that_nothing_looks_at_are_told),
        cmocka_unit_test(stages_are_refused_where_bonds_that_soften_cannot_follow),
        cmocka_unit_test(all_of_them_are_told_in_one_pass),
        cmocka_unit_test(friction_of_sides_is_for_scenes_in_which_they_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
