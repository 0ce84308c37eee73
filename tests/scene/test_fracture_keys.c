/* Keys of fracture: what is kept of them, and what does not fit together. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "../../host/scene/scene_reader.h"
#include "bad.h"

#define TOP "version: 1\nmaterials:\n"
#define BODY "bodies: [{material: a, domain: d.h5}]\n"
#define A "  a: {E: 72 GPa, nu: 0.2, density: 2500 kg/m^3, strength: "
#define B "  b: {E: 7 GPa, nu: 0.3, density: 1500 kg/m^3}\n"
#define END "stages: [{name: pull, solver: static}]\n"

static void strengths_keep_energy_softening_and_scatter(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(
        TOP A
        "{tension: 50 MPa, fracture_energy: 8 J/m^2, softening: exponential, scatter: {weibull: {modulus: 10, volume: "
        "2 mm^3}}}}\n"
        "  b: {E: 7 GPa, nu: 0.3, density: 1500 kg/m^3, strength: {tension: 5 MPa, scatter: {table: [{below: 0, "
        "factor: 0.5}, {below: 1, factor: 2}]}}}\n"
        "  c: {E: 7 GPa, nu: 0.3, density: 1500 kg/m^3, strength: {tension: 5 MPa, scatter: {file: f.csv}}}\n" BODY
            END);
    const brc_material *a = &scene->materials[0], *b = &scene->materials[1];
    assert_true(a->fracture_energy == 8 && a->softening == BRC_SOFTENING_EXPONENTIAL);
    assert_int_equal(a->scatter.kind, BRC_SCATTER_WEIBULL);
    assert_true(a->scatter.modulus == 10 && a->scatter.volume > 1.99e-9 && a->scatter.volume < 2.01e-9);
    assert_int_equal(b->scatter.kind, BRC_SCATTER_TABLE);
    assert_int_equal(b->softening, BRC_SOFTENING_LINEAR);
    assert_int_equal(b->scatter.n_quantiles, 2);
    assert_true(b->scatter.quantiles[1].below == 1 && b->scatter.quantiles[1].factor == 2);
    assert_int_equal(scene->materials[2].scatter.kind, BRC_SCATTER_FILE);
    assert_string_equal(scene->materials[2].scatter.file, "f.csv");
    brc_scene_free(&scene);
}

static void interfaces_keep_their_sides_and_order(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(TOP A "{tension: 50 MPa}}\n" B BODY "fracture: {criterion: bond-normal, seed: 7}\n"
                         "interactions:\n  interfaces:\n    - grains: {factor: 50 %}\n"
                         "    - materials: {first: b, second: a, tension: 3 MPa, fracture_energy: 1 N/m}\n" END);
    assert_int_equal(scene->n_interfaces, 2);
    assert_int_equal(scene->interfaces[0].kind, BRC_INTERFACE_GRAINS);
    assert_true(scene->interfaces[0].factor == 0.5 && scene->interfaces[0].tension == 0);
    assert_int_equal(scene->interfaces[1].kind, BRC_INTERFACE_MATERIALS);
    assert_int_equal(scene->interfaces[1].material[0], 1);
    assert_int_equal(scene->interfaces[1].material[1], 0);
    assert_true(scene->interfaces[1].factor == 0 && scene->interfaces[1].fracture_energy == 1);
    assert_int_equal(scene->fracture.kind, BRC_CRITERION_BOND_NORMAL);
    assert_int_equal(scene->fracture.seed, 7);
    brc_scene_free(&scene);
}

static void criterion_follows_the_model_unless_given(void **state)
{
    (void)state;
    const brc_fracture by_model = {.kind = BRC_CRITERION_AUTO}, given = {.kind = BRC_CRITERION_PRINCIPAL};
    assert_int_equal(brc_criterion_of(&by_model, BRC_MODEL_DLSM), BRC_CRITERION_BOND_NORMAL);
    assert_int_equal(brc_criterion_of(&by_model, BRC_MODEL_DLSM_PUBLISHED), BRC_CRITERION_BOND_NORMAL);
    assert_int_equal(brc_criterion_of(&by_model, BRC_MODEL_CBM), BRC_CRITERION_PRINCIPAL);
    assert_int_equal(brc_criterion_of(&given, BRC_MODEL_DLSM), BRC_CRITERION_PRINCIPAL);
}

static void bodies_keep_their_own_model(void **state)
{
    (void)state;
    brc_scene *scene = good_scene(
        TOP A
        "{tension: 50 MPa}}\n"
        "model: {dlsm: {tau: 0.2}}\n"
        "bodies:\n  - {name: one, domain: d.h5}\n  - {name: two, domain: e.h5, model: {dlsm: {compaction: false}}}\n"
        "  - {name: three, domain: f.h5, model: cbm}\n" END);
    assert_false(scene->bodies[0].has_model);
    assert_true(scene->bodies[1].has_model && scene->bodies[1].model.kind == BRC_MODEL_DLSM &&
                scene->bodies[1].model.beta == 0);
    assert_true(scene->bodies[2].has_model && scene->bodies[2].model.kind == BRC_MODEL_CBM &&
                scene->bodies[2].model.beam_poisson == 0.3);
    brc_scene_free(&scene);
}

static void strengths_keep_the_test_they_come_from(void **state)
{
    (void)state;
    brc_scene *scene =
        good_scene(TOP A "{tension: 50 MPa, measured_by: brazilian}}\n" B "model: cbm\nfracture: {}\n" BODY END);
    assert_int_equal(scene->materials[0].measured_by, BRC_STRENGTH_BY_BRAZILIAN);
    assert_int_equal(scene->materials[1].measured_by, BRC_STRENGTH_BY_TENSION);
    brc_scene_free(&scene);
    scene = good_scene(TOP A "{tension: 50 MPa, measured_by: either}}\n"
                             "model: cbm\nfracture: {}\n" BODY END);
    assert_int_equal(scene->materials[0].measured_by, BRC_STRENGTH_BY_EITHER);
    brc_scene_free(&scene);
}

static void what_does_not_fit_is_refused(void **state)
{
    (void)state;
    static const char *const bad[][3] = {
        {TOP A "{compression: 50 MPa, fracture_energy: 8 J/m^2}}\n" BODY END, "3:98", "expected `tension` beside it"},
        {TOP A "{tension: 50 MPa, scatter: {table: [{below: 0, factor: 1}]}}}\n" BODY END, "3:103", "has one entry"},
        {TOP A "{tension: 50 MPa, scatter: {table: [{below: 0, factor: 2}, {below: 1, factor: 1}]}}}\n" BODY END,
         "3:137", "is smaller than the one before"},
        {TOP A "{tension: 50 MPa, scatter: {table: [{below: 10 %, factor: 1}, {below: 1, factor: 2}]}}}\n" BODY END,
         "3:103", "grow from 0 at the first"},
        {TOP A "{tension: 50 MPa, fracture_energy: 8 J}}\n" BODY END, "3:94", "J/m^2"},
        {TOP A "{compression: 50 MPa, measured_by: brazilian}}\n"
               "model: cbm\n" BODY END,
         "3:94", "expected `tension` beside it"},
        {TOP A "{tension: 50 MPa, fracture_energy: 8 J/m^2, measured_by: brazilian}}\n"
               "model: cbm\n" BODY END,
         "3:116", "give the strength in tension"},
        {TOP A "{tension: 50 MPa, measured_by: brazilian}, beam: {strength: 60 MPa}}\n"
               "model: cbm\n" BODY END,
         "3:90", "leave out one of them"},
        {TOP A "{tension: 50 MPa, measured_by: brazilian}}\n" BODY END, "3:90", "is made of cells"},
        {TOP A "{tension: 50 MPa, measured_by: either}}\n" BODY END, "3:90", "is made of cells"},
        {TOP B A "{tension: 50 MPa, measured_by: brazilian}}\n"
                 "model: cbm\nbodies: [{name: one, material: b, domain: d.h5}, {name: two, material: a, domain: e.h5, "
                 "model: dlsm}]\n" END,
         "4:90", "body 'two' is made of cells"},
        {TOP A "{tension: 50 MPa, measured_by: brazilian}}\n" B "model: cbm\n" BODY END
               "interactions: {interfaces: [{materials: {first: a, second: b, fracture_energy: 1 J/m^2}}]}\n",
         "3:90", "interface number 1 has a fracture_energy"},
        {TOP A "{tension: 50 MPa, measured_by: splitting}}\n"
               "model: cbm\n" BODY END,
         "3:90", "brazilian"},
        {TOP A "{tension: 50 MPa}}\n" BODY "stages: [{name: pull, solver: {static: {events: 5}}}]\n", "5:49",
         "needs `fracture: {}`"},
        {TOP A "{tension: 50 MPa}}\n" BODY
               "fracture: {}\nstages: [{name: pull, solver: {static: {events: 5, increments: 3}}}]\n",
         "6:49", "they find the load themselves"},
        {TOP A "{tension: 50 MPa}}\n" BODY END "sensors: {n: {fracture: broken}}\n", "6:25", "needs `fracture: {}`"},
        {TOP A "{tension: 50 MPa}}\n" BODY END "sensors: {n: {crack_tip: {direction: [1, 0, 0]}}}\n", "6:14",
         "needs `fracture: {}`"},
        {TOP A "{tension: 50 MPa}}\n" BODY END
               "sensors: {n: {energy: work}}\nmeasure: {m: {at_first_break: {of: n}}}\n",
         "7:14", "needs `fracture: {}`"},
        {TOP A "{tension: 50 MPa}}\n" BODY END "sensors: {n: {energy: work}}\nmeasure: {m: {rate: {of: n}}}\n", "7:14",
         "is not dynamic"},
        {TOP A "{tension: 50 MPa}}\n" BODY END "interactions: {interfaces: [{grains: {}}]}\n", "6:38",
         "at least one of factor, tension, fracture_energy"},
        {TOP A "{tension: 50 MPa}}\n" BODY END "interactions: {interfaces: [{grains: {factor: 1, tension: 1 Pa}}]}\n",
         "6:50", "only one of factor, tension"},
        {TOP A "{tension: 50 MPa}}\n" BODY END
               "interactions: {interfaces: [{materials: {first: a, second: c, factor: 1}}]}\n",
         "6:60", "no material 'c'"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        bad_scene(bad[i][0], bad[i][1], bad[i][2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strengths_keep_energy_softening_and_scatter),
        cmocka_unit_test(interfaces_keep_their_sides_and_order),
        cmocka_unit_test(criterion_follows_the_model_unless_given),
        cmocka_unit_test(bodies_keep_their_own_model),
        cmocka_unit_test(strengths_keep_the_test_they_come_from),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
