/* Whole impacts: bodies of beams on a wall, strikers given as meshes, and what is refused. */
#include "contact_case.h"
#include "../fracture/fracture_case.h"
#include "../../core/state_cases.h"
#include "../../../../host/solver/effects/fracture/fragments.h"
#include "../../../../host/solver/effects/strikers/strikers.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A cube of beams thrown on a plane a little below it. Waves run at about 1 m/s. */
#define THROWN(speed, steps)                                                                                           \
    "interactions: {contact: {friction: 0.2}}\nstrikers:\n  wall: {plane: {point: [0, 0, -0.01 m], normal: [0, 0, "    \
    "1]}, material: glass}\n"                                                                                          \
    "stages:\n  - name: hit\n    solver: {dynamic: {steps: " #steps                                                    \
    ", time_step: {auto: {safety: 0.4}}}}\n    initial:\n      - velocity: {velocity: [" #speed " m/s, 0, -" #speed    \
    " m/s]}\n"

typedef struct blow {
    double impulse[3], before[3], after[3], deepest, closure;
    int64_t broken;
} blow;

/* Step by step: the impulse that the wall got, by trapezoids, as Verlet gives it. */
static blow throw_it(fracture_options options, int64_t steps)
{
    bench_case c;
    blow out = {.deepest = 0};
    brc_fragment body;
    brc_striker_now now;
    brc_ledger ledger;
    double last[3] = {0};
    open_fracture(&c, options);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_set_motion(c.simulation, -1, &body));
    const double dt = brc_simulation_time_step(c.simulation).value;
    for (int k = 0; k < 3; ++k)
        out.before[k] = body.mass * body.velocity[k];
    for (int64_t i = 0; i < steps; ++i) {
        assert_done(&c, brc_simulation_advance(c.simulation, 1));
        assert_done(&c, brc_simulation_striker_now(c.simulation, 0, &now));
        for (int k = 0; k < 3; ++k) {
            out.impulse[k] += 0.5 * dt * (last[k] + now.force[k]);
            last[k] = now.force[k];
        }
        out.deepest = fmax(out.deepest, fabs(now.force[2]));
    }
    assert_done(&c, brc_simulation_set_motion(c.simulation, -1, &body));
    for (int k = 0; k < 3; ++k)
        out.after[k] = body.mass * body.velocity[k];
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    out.closure = ledger.closure;
    if (options.fracture) assert_done(&c, brc_simulation_broken(c.simulation, &out.broken));
    close_case(&c);
    return out;
}

/* Forces on the wall and on the spheres are the same numbers, and Verlet changes momentum by the mean force of a step:
 * to the rounding of 2000 steps of 300 sums, 1e-10 of it. */
static void a_body_of_beams_gives_the_wall_the_momentum_it_loses(void **state)
{
    (void)state;
    const blow b = throw_it((fracture_options){.elements = 300, .n_threads = 1, .stages = THROWN(0.02, 2000)}, 2000);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(b.before[k] - b.after[k] - b.impulse[k]) < 1e-10 * fabs(b.before[2]));
    assert_true(b.deepest > 0 && b.after[2] > 0); /* it came back, and not faster */
    assert_true(b.after[0] * b.after[0] + b.after[2] * b.after[2] <
                b.before[0] * b.before[0] + b.before[2] * b.before[2]);
    assert_true(b.after[0] < b.before[0]); /* friction held it */
    assert_true(fabs(b.closure) < 1e-2); /* at 0.4 of the critical step: that of the asked bound for fracture at 0.35 */
}

/* A step with breaks ends with one force and the next begins with another, of surfaces that are new: what is read
 * between is the second, so half a step's difference may be missing each time. Surfaces that a break makes touch
 * nothing but each other, so the wall's is of the order of a step's part of the blow, a thousandth; 1 % is far beyond
 * it. */
static void a_body_of_beams_that_breaks_does_so_too(void **state)
{
    (void)state;
    const blow b = throw_it((fracture_options){.elements = 300,
                                               .n_threads = 1,
                                               .stages = THROWN(0.1, 1500),
                                               .fracture = "{criterion: virial-principal}",
                                               .strength = "strength: {tension: 5e-3 Pa}"},
                            1500);
    assert_true(b.broken > 20);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(b.before[k] - b.after[k] - b.impulse[k]) < 1e-2 * fabs(b.before[2]));
    assert_true(fabs(b.closure) < 5e-2); /* the asked bound for fracture */
}

/* A free slab breaks a cube that lies on nothing: all that the one loses the other has, step by step through the
 * breaks, to the rounding of 1000 steps of 300 sums. */
static void a_free_striker_that_breaks_beams_keeps_momentum(void **state)
{
    (void)state;
    bench_case c;
    brc_fragment body;
    brc_striker_now now;
    int64_t broken;
    open_fracture(&c, (fracture_options){
                          .elements = 300,
                          .n_threads = 1,
                          .fracture = "{criterion: virial-principal}",
                          .strength = "strength: {tension: 5e-3 Pa}",
                          .stages = "interactions: {contact: {friction: 0.2}}\nstrikers:\n  slab: {shape: {box: {size: "
                                    "[1.4 m, 1.4 m, 0.2 m], origin: [-0.2 m, -0.2 m, 1.01 m]}}, material: glass, "
                                    "motion: {free: {velocity: [0.02 m/s, 0, -0.15 m/s]}}}\nstages:\n  - name: hit\n   "
                                    " solver: {dynamic: {steps: 1000, time_step: {auto: {safety: 0.4}}}}\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    const double mass = brc_simulation_striker_body(c.simulation, 0)->mass;
    for (int k = 0; k < 20; ++k) {
        assert_done(&c, brc_simulation_advance(c.simulation, 50));
        assert_done(&c, brc_simulation_set_motion(c.simulation, -1, &body));
        assert_done(&c, brc_simulation_striker_now(c.simulation, 0, &now));
        const double first[3] = {mass * 0.02, 0, -mass * 0.15};
        for (int i = 0; i < 3; ++i)
            assert_true(fabs(body.mass * body.velocity[i] + mass * now.velocity[i] - first[i]) < 1e-10 * mass * 0.15);
    }
    assert_done(&c, brc_simulation_broken(c.simulation, &broken));
    assert_true(broken > 20 && now.velocity[2] > -0.14);
    close_case(&c);
}

/* ---- strikers as meshes ---- */

static void put_corner(FILE *file, int bits, const double from[3], const double to[3])
{
    fprintf(file, "      vertex %.17g %.17g %.17g\n", bits & 1 ? to[0] : from[0], bits & 2 ? to[1] : from[1],
            bits & 4 ? to[2] : from[2]);
}

/* A box as an STL of twelve triangles, in millimetres. */
static void write_box(const char *path, const double from[3], const double to[3])
{
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "solid box\n");
    for (int f = 0; f < 6; ++f)
        for (int half = 0; half < 2; ++half) {
            fprintf(file, "  facet normal 0 0 0\n    outer loop\n");
            put_corner(file, faces[f][0], from, to);
            put_corner(file, faces[f][1 + half], from, to);
            put_corner(file, faces[f][2 + half], from, to);
            fprintf(file, "    endloop\n  endfacet\n");
        }
    fprintf(file, "endsolid box\n");
    fclose(file);
}

#define FREE_BLOCK                                                                                                     \
    "material: steel, motion: {free: {velocity: [0.01 m/s, 0, -0.05 m/s], spin: [0.1 rad/s, 0.2 rad/s, 0]}}}\n"
static void strike(const char *striker, double **u, int64_t *n, brc_striker_now *now)
{
    bench_case c;
    char keys[600];
    snprintf(keys, sizeof keys, "interactions: {contact: {friction: 0.3}}\nstrikers:\n  block: {%s, " FREE_BLOCK,
             striker);
    open_case(&c,
              (case_options){
                  .materials =
                      "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}\n  steel: {E: 10 Pa, nu: 0.2, density: 2 kg/m^3}",
                  .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                  .gravity = keys,
                  .stages = "  - name: hit\n    solver: {dynamic: {steps: 800, time_step: 4 ms}}\n",
                  .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 800));
    *n = 3 * c.domain->n_elements;
    *u = malloc((size_t)*n * sizeof **u);
    assert_done(&c, brc_simulation_displacement(c.simulation, *u));
    assert_done(&c, brc_simulation_striker_now(c.simulation, 0, now));
    close_case(&c);
}

/* The same solid with each face in two triangles: overlaps differ by the rounding of sums of twice as many parts, 1e-15
 * of a push, which 800 steps of a body that does not go unstable carry on to at most a thousand times as much each. */
static void a_box_given_as_a_mesh_strikes_as_the_box(void **state)
{
    (void)state;
    double *as_box, *as_mesh, largest = 0, apart = 0;
    int64_t n, m;
    brc_striker_now box, mesh;
    write_box("block.stl", (double[]){300, 300, 1020}, (double[]){700, 800, 1320});
    strike("shape: {box: {size: [40 cm, 50 cm, 30 cm], origin: [30 cm, 30 cm, 102 cm]}}", &as_box, &n, &box);
    strike("shape: {mesh: {file: block.stl}}", &as_mesh, &m, &mesh);
    assert_int_equal(n, m);
    for (int64_t k = 0; k < n; ++k) {
        largest = fmax(largest, fabs(as_box[k]));
        apart = fmax(apart, fabs(as_box[k] - as_mesh[k]));
    }
    assert_true(box.velocity[2] > -0.05); /* it did strike */
    assert_true(apart < 1e-9 * largest);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(box.velocity[k] - mesh.velocity[k]) < 1e-9 * 0.05);
    free(as_box), free(as_mesh);
    remove("block.stl");
}

static void a_mesh_that_stands_in_a_body_is_refused(void **state)
{
    (void)state;
    bench_case c;
    write_box("inside.stl", (double[]){300, 300, 900}, (double[]){700, 800, 1200});
    assert_int_equal(try_case(&c, (case_options){.gravity = "interactions: {contact: {}}\nstrikers:\n  block: {shape: "
                                                            "{mesh: {file: inside.stl}}, material: stone}\n",
                                                 .stages = "  - name: hit\n    solver: {dynamic: {steps: 1}}\n"}),
                     BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "striker 'block' stands 0.1 m deep"));
    close_case(&c);
    remove("inside.stl");
}

/* ---- going on without what pairs remember ---- */

static const case_options crushed = {.n_threads = 1,
                                     .materials = CELLS_STRENGTH("2e-4 Pa"),
                                     .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                                     .stages = CONTACT_CRUSH,
                                     .gravity = CONTACT_KEYS};

static void a_checkpoint_without_the_friction_of_its_pairs_is_refused(void **state)
{
    (void)state;
    state_is_refused_without(crushed, 150, 3,
                             (const char *const[]){"contact.pairs", "contact.history", "contact.friction"});
}

static void change_the_last(memory_item *pairs, const bench_case *of)
{
    (void)of;
    ((int32_t *)pairs->data)[2 * pairs->rows - 1] += 1;
}

static void a_checkpoint_with_another_pair_is_refused(void **state)
{
    (void)state;
    state_is_refused_forged(crushed, 150, "contact.pairs", change_the_last,
                            "contact.pairs: the history that was kept has elements");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_of_beams_gives_the_wall_the_momentum_it_loses),
        cmocka_unit_test(a_body_of_beams_that_breaks_does_so_too),
        cmocka_unit_test(a_free_striker_that_breaks_beams_keeps_momentum),
        cmocka_unit_test(a_box_given_as_a_mesh_strikes_as_the_box),
        cmocka_unit_test(a_mesh_that_stands_in_a_body_is_refused),
        cmocka_unit_test(a_checkpoint_without_the_friction_of_its_pairs_is_refused),
        cmocka_unit_test(a_checkpoint_with_another_pair_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
