/* Rigid strikers: driven and free motion, with forces put in by hand in place of contact. */
#include "../../support.h"
#include "../../../../host/base/memory.h"
#include "../../../../host/solver/effects/strikers/striker_contact.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A small cube of cells far away from strikers of steel, density 1000 kg/m^3. */
#define STEEL "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}\n  steel: {E: 1 Pa, nu: 0.2, density: 1000 kg/m^3}"
#define FILL "cells: [2, 2, 2], spread: 50 %, seed: 1"
#define STRIKERS(text) "interactions: {contact: {}}\nstrikers:\n" text
#define STAGE(steps) "  - name: move\n    solver: {dynamic: {steps: " steps ", time_step: 1 ms}}\n"

static void open_strikers(bench_case *c, const char *strikers, const char *stages, brc_precision precision)
{
    open_case(c, (case_options){.materials = STEEL,
                                .fill = FILL,
                                .gravity = strikers,
                                .stages = stages,
                                .precision = precision,
                                .n_threads = 1,
                                .no_contact = true});
    assert_done(c, brc_simulation_begin_stage(c->simulation, 0));
}

static brc_striker_now now_of(bench_case *c, int32_t striker)
{
    brc_striker_now now;
    assert_done(c, brc_simulation_striker_now(c->simulation, striker, &now));
    return now;
}

/* What contact would write. */
static void put_load(bench_case *c, const double *load)
{
    assert_done(c, brc_strikers_set_load(c->simulation, load));
}

static double length(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

#define TUMBLING                                                                                                       \
    STRIKERS("  brick: {shape: {box: {size: [1 m, 2 m, 3 m], origin: [10 m, 0, 0]}}, material: steel, motion: {free: " \
             "{velocity: [1 m/s, 0, 0], spin: [3 rad/s, 1 rad/s, 2 rad/s]}}}\n")

/* Angular momentum is the state itself; the energy is off by roundings alone (test_rigid.c: 2e-10 after 1e5 steps, here
 * 1e4). */
static void a_tumbling_brick_keeps_momentum_and_energy(void **state)
{
    (void)state;
    bench_case c;
    open_strikers(&c, TUMBLING, STAGE("10000"), BRC_DOUBLE);
    const double before = now_of(&c, 0).kinetic, m = 6000, i[3] = {m * 13 / 12, m * 10 / 12, m * 5 / 12};
    assert_true(fabs(before - 0.5 * (m + i[0] * 9 + i[1] + i[2] * 4)) < 1e-14 * before);
    assert_done(&c, brc_simulation_advance(c.simulation, 10000));
    const brc_striker_now now = now_of(&c, 0);
    assert_true(now.momentum[0] == 3 * i[0] && now.momentum[1] == i[1] && now.momentum[2] == 2 * i[2]);
    assert_true(fabs(now.kinetic / before - 1) < 2e-11);
    assert_true(fabs(now.displacement[0] - 10) < 1e4 * 1e-15 * 10 && now.displacement[1] == 0); /* 10 s at 1 m/s */
    assert_true(fabs(now.spin[0] - 3) > 0.1);                                                   /* it does tumble */
    close_case(&c);
}

/* x = F t^2 / 2m, v = F t / m are exact for velocity Verlet under a constant force, but for roundings; likewise the
 * angle about a principal axis. */
static void constant_loads_give_the_parabola(void **state)
{
    (void)state;
    bench_case c;
    open_strikers(&c,
                  STRIKERS("  brick: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [10 m, 0, 0]}}, material: steel, "
                           "motion: {free: {velocity: [0, 0.5 m/s, 0]}}}\n"),
                  STAGE("1000"), BRC_DOUBLE);
    const double load[6] = {200, 0, 0, 0, 0, 50}; /* m = 1000, I = 1000 / 6 */
    put_load(&c, load);
    assert_done(&c, brc_simulation_advance(c.simulation, 1000));
    const brc_striker_now now = now_of(&c, 0);
    const double roundings = 1000 * 1e-16;
    assert_true(fabs(now.displacement[0] - 0.1) < roundings && fabs(now.velocity[0] - 0.2) < roundings);
    assert_true(fabs(now.displacement[1] - 0.5) < roundings);
    assert_true(fabs(now.rotation[2] - 0.15) < roundings && fabs(now.spin[2] - 0.3) < roundings);
    assert_true(now.position[0] == 10.5 + now.displacement[0] && now.force[0] == 200 && now.torque[2] == 50);
    close_case(&c);
}

/* In gravity a free striker falls, one on a rail only along it, and the energy is kept: m g h, exact for Verlet. */
static void free_strikers_fall_and_rails_hold_them(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger before, after;
    open_strikers(&c,
                  "gravity: [3 m/s^2, 0, -10 m/s^2]\n" STRIKERS(
                      "  brick: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [10 m, 0, 0]}}, material: steel, motion: "
                      "{free: {}}}\n"
                      "  sledge: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [20 m, 0, 0]}}, material: steel, "
                      "motion: {free: {mass: 2 kg, hold: {x: true, rotation: true}}}}\n"
                      "  wall: {plane: {point: [0, 0, -9 m], normal: [0, 0, 1]}, material: steel}\n"),
                  STAGE("500"), BRC_DOUBLE);
    assert_done(&c, brc_simulation_ledger(c.simulation, &before));
    const double load[18] = {0, 0, 0, 0, 0, 0, 5, 0, 0, 1, 1, 1, 7, 7, 7, 1, 1, 1};
    put_load(&c, load);
    assert_done(&c, brc_simulation_advance(c.simulation, 500));
    assert_done(&c, brc_simulation_ledger(c.simulation, &after));
    const brc_striker_now brick = now_of(&c, 0), sledge = now_of(&c, 1), wall = now_of(&c, 2);
    assert_true(fabs(brick.displacement[2] + 1.25) < 1e-12 && fabs(brick.displacement[0] - 0.375) < 1e-12);
    assert_true(sledge.displacement[0] == 0 && fabs(sledge.displacement[2] + 1.25) < 1e-12 &&
                length(sledge.rotation) == 0 && length(sledge.spin) == 0);
    assert_true(length(wall.displacement) == 0 && wall.kinetic == 0 && wall.position[2] == -9);
    assert_true(fabs(after.total - before.total) < 1e-12 * after.kinetic && after.kinetic > 1e4);
    close_case(&c);
}

/* Path and turn are integrals of the table, also where a step straddles its corners; the work done is - F x along the
 * way, by trapezoids exact for a constant force. */
static void driven_strikers_follow_their_table_and_their_work_is_booked(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger ledger;
    open_strikers(&c,
                  STRIKERS("  press: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [10 m, 0, 0]}}, material: steel, "
                           "motion: {driven: {velocity: [0, 2 m/s, 0], spin: [0, 0, 4 rad/s], "
                           "table: [[0, 0], [100.5 ms, 1], [200 ms, 1], [300.25 ms, 0]]}}}\n"),
                  STAGE("400"), BRC_DOUBLE);
    const double load[6] = {1, -30, 2, 0, 0, 7}, path = 0.5 * 0.1005 + 0.0995 + 0.5 * 0.10025;
    put_load(&c, load);
    assert_done(&c, brc_force_of_state(c.simulation, BRC_BOOK_START));
    assert_done(&c, brc_simulation_advance(c.simulation, 150));
    brc_striker_now now = now_of(&c, 0);
    assert_true(now.velocity[1] == 2 && now.spin[2] == 4);
    assert_true(fabs(now.displacement[1] - 2 * (0.5 * 0.1005 + 0.0495)) < 1e-15 &&
                fabs(now.rotation[2] - 4 * (0.5 * 0.1005 + 0.0495)) < 1e-15);
    assert_done(&c, brc_simulation_advance(c.simulation, 250));
    now = now_of(&c, 0);
    assert_true(fabs(now.displacement[1] - 2 * path) < 1e-15 && fabs(now.rotation[2] - 4 * path) < 1e-15 &&
                length(now.velocity) == 0);
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(fabs(ledger.work - (30 * 2 * path - 7 * 4 * path)) < 400 * 1e-15);
    close_case(&c);
}

/* Tchamwa-Wielgosz under a constant force: v = F t / m, x = F t (t + (2 phi - 1) dt) / 2m; what it takes from the
 * energy of the force's work is booked. */
static void tchamwa_moves_strikers_as_elements(void **state)
{
    (void)state;
    bench_case c;
    open_strikers(&c,
                  "gravity: [0, 0, -10 m/s^2]\n" STRIKERS("  brick: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [10 "
                                                          "m, 0, 0]}}, material: steel, motion: {free: {}}}\n"),
                  "  - name: move\n    solver: {dynamic: {steps: 100, time_step: 1 ms, integrator: {tchamwa-wielgosz: "
                  "{phi: 1.1}}}}\n",
                  BRC_DOUBLE);
    brc_striker_energies before, after;
    assert_done(&c, brc_strikers_energies(c.simulation, &before));
    assert_done(&c, brc_simulation_advance(c.simulation, 100));
    assert_done(&c, brc_strikers_energies(c.simulation, &after));
    const brc_striker_now now = now_of(&c, 0);
    assert_true(fabs(now.velocity[2] + 1) < 1e-13 && fabs(now.displacement[2] + 10 * 0.1 * (0.1 + 1.2e-3) / 2) < 1e-14);
    assert_true(fabs(after.kinetic + after.potential + after.numerical - before.kinetic - before.potential) <
                1e-10 * after.kinetic);
    assert_true(after.numerical > 0);
    close_case(&c);
}

/* Against sums over small cubes of the shape: with n = 60 across, the volume of a smooth shape is right to about the
 * share of its surface cubes over their number to the half, some 1e-3; bound 5e-3. A ring is filled with some 480
 * cells, which leave out what lies beyond their flat faces: about (1 / cells across the tube)^2, 3 %. The pose turns
 * about the shape's origin. */
static void expect_moments(const char *shape, int inside(const double x[3]), const double low[3], const double high[3],
                           double tolerance)
{
    enum { N = 60 };
    char text[512];
    bench_case c;
    double volume = 0, centre[3] = {0}, second[6] = {0};
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    for (int k = 0; k < N * N * N; ++k) {
        const int at[3] = {k % N, k / N % N, k / N / N};
        double x[3];
        for (int d = 0; d < 3; ++d)
            x[d] = low[d] + (high[d] - low[d]) * (at[d] + 0.5) / N;
        if (!inside(x)) continue;
        volume += 1;
        for (int d = 0; d < 3; ++d)
            centre[d] += x[d];
        for (int d = 0; d < 6; ++d)
            second[d] += x[row[d]] * x[column[d]];
    }
    for (int d = 0; d < 3; ++d)
        centre[d] /= volume;
    for (int d = 0; d < 6; ++d)
        second[d] = second[d] / volume - centre[row[d]] * centre[column[d]];
    const double cube = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]) / (N * N * N),
                 trace = second[0] + second[1] + second[2];
    snprintf(text, sizeof text,
             STRIKERS("  it: {shape: %s, material: steel, motion: {free: {}}, pose: {translation: [50 m, 0, 0]}}\n"
                      "  turned: {shape: %s, material: steel, motion: {free: {mass: 1 kg}}, pose: {translation: [50 m, "
                      "0, 0], rotation: [0, 0, 90 deg]}}\n"),
             shape, shape);
    open_strikers(&c, text, STAGE("1"), BRC_DOUBLE);
    const brc_striker_body *it = brc_simulation_striker_body(c.simulation, 0),
                           *turned = brc_simulation_striker_body(c.simulation, 1);
    assert_true(fabs(it->mass / (1000 * volume * cube) - 1) < tolerance &&
                fabs(it->volume * 1000 / it->mass - 1) < 1e-15);
    for (int d = 0; d < 3; ++d)
        assert_true(fabs(it->centre[d] - centre[d] - (d == 0 ? 50 : 0)) < tolerance);
    for (int d = 0; d < 6; ++d)
        assert_true(fabs(it->inertia[d] / it->mass - ((d < 3 ? trace : 0) - second[d])) < tolerance * trace);
    assert_true(fabs(turned->inertia[0] - it->inertia[1] / it->mass) < 1e-14 * trace &&
                fabs(turned->inertia[2] - it->inertia[2] / it->mass) < 1e-14 * trace);
    close_case(&c);
}
static double square(double x)
{
    return x * x;
}
static int in_box(const double x[3])
{
    return x[0] > 1 && x[0] < 2 && x[1] > 0 && x[1] < 2 && x[2] > 0 && x[2] < 0.5;
}
static int in_ball(const double x[3])
{
    return square(x[0] - 1) + square(x[1]) + square(x[2]) < 0.25;
}
static int in_rod(const double x[3])
{
    return x[1] > 0.5 && x[1] < 2 && square(x[0]) + square(x[2]) < 0.16;
}
static int in_cone(const double x[3])
{
    return x[2] > 0 && x[2] < 2 && square(x[0] - 1) + square(x[1]) < square(0.6 - 0.2 * x[2]);
}
static int in_ring(const double x[3])
{
    return square(sqrt(square(x[1]) + square(x[2])) - 0.8) + square(x[0]) < 0.09;
}
static void mass_and_inertia_are_those_of_the_shape(void **state)
{
    (void)state;
    expect_moments("{box: {size: [1 m, 2 m, 0.5 m], origin: [1 m, 0, 0]}}", in_box, (double[3]){1, 0, 0},
                   (double[3]){2, 2, 0.5}, 5e-3);
    expect_moments("{sphere: {radius: 0.5 m, centre: [1 m, 0, 0]}}", in_ball, (double[3]){0.5, -0.5, -0.5},
                   (double[3]){1.5, 0.5, 0.5}, 5e-3);
    expect_moments("{cylinder: {length: 1.5 m, radius: 0.4 m, axis: y, origin: [0, 0.5 m, 0]}}", in_rod,
                   (double[3]){-0.4, 0.5, -0.4}, (double[3]){0.4, 2, 0.4}, 5e-3);
    expect_moments("{cone: {length: 2 m, radius: 0.6 m, end_radius: 0.2 m, axis: z, origin: [1 m, 0, 0]}}", in_cone,
                   (double[3]){0.4, -0.6, 0}, (double[3]){1.6, 0.6, 2}, 5e-3);
    expect_moments("{torus: {radius: 0.8 m, tube: 0.3 m, axis: x}}", in_ring, (double[3]){-0.3, -1.1, -1.1},
                   (double[3]){0.3, 1.1, 1.1}, 0.03);
}

/* Pieces of all strikers stand in one list, in their own frames; a plane is one face through its point, a ball keeps
 * its radius, a ring is many pieces. */
static void pieces_of_all_strikers_stand_in_one_list(void **state)
{
    (void)state;
    bench_case c;
    open_strikers(
        &c,
        STRIKERS("  wall: {plane: {point: [0, 0, -2 m], normal: [0, 3, 4]}, material: steel}\n"
                 "  brick: {shape: {box: {size: [1 m, 2 m, 3 m], origin: [10 m, 0, 0]}}, material: steel, pose: "
                 "{rotation: [0, 0, 90 deg]}}\n"
                 "  ball: {shape: {sphere: {radius: 1 m, centre: [30 m, 0, 0]}}, facets: 20, material: steel, motion: "
                 "{free: {}}}\n"
                 "  ring: {shape: {torus: {radius: 2 m, tube: 0.5 m, centre: [50 m, 0, 0]}}, material: steel}\n"),
        STAGE("1"), BRC_DOUBLE);
    const brc_convex *p = c.simulation->wants.pieces;
    brc_striker_piece piece[5];
    for (int k = 0; k < 4; ++k)
        piece[k] = brc_striker_piece_of(c.simulation, k);
    piece[4] = brc_striker_piece_of(c.simulation, p->n - 1);
    assert_true(p->n > 20 && piece[2].striker == 2 && piece[3].striker == 3 && piece[4].striker == 3);
    assert_true(piece[0].kind == BRC_PIECE_PLANE && piece[1].kind == BRC_PIECE_CONVEX &&
                piece[2].kind == BRC_PIECE_SPHERE && piece[3].kind == BRC_PIECE_CONVEX);
    assert_true(p->face_start[1] == 1 && p->corner_start[1] == 0 && fabs(p->plane[1] - 0.6) < 1e-15 &&
                fabs(p->plane[2] - 0.8) < 1e-15 && p->plane[3] == 0);
    assert_true(piece[2].radius == 1 && piece[1].radius == 0 && p->radius[2] > 1 && p->radius[2] < 1.2);
    double high[3] = {0}; /* the brick lies 2 x 1 x 3 after its quarter turn */
    for (int32_t k = p->corner_start[1]; k < p->corner_start[2]; ++k)
        for (int d = 0; d < 3; ++d)
            high[d] = fmax(high[d], p->corner[3 * k + d]);
    assert_true(fabs(high[0] - 1) < 1e-14 && fabs(high[1] - 0.5) < 1e-14 && fabs(high[2] - 1.5) < 1e-14);
    assert_done(&c, brc_convex_check(c.context,
                                     &(brc_convex){.n = 1,
                                                   .corner_start = p->corner_start + 2,
                                                   .corner = p->corner,
                                                   .face_start = p->face_start + 2,
                                                   .plane = p->plane,
                                                   .loop_start = p->loop_start,
                                                   .loop = p->loop,
                                                   .radius = p->radius + 2},
                                     1e-12));
    const brc_striker_body *body = brc_simulation_striker_body(c.simulation, 0);
    assert_true(body[0].surface.n_faces == 1 && body[1].surface.n_faces == 6 && body[3].surface.n_faces > 100 &&
                body[0].volume == 0);
    for (int k = 0; k < 4; ++k) { /* the square lies in the plane, around the cube */
        const double *x = body[0].surface.corner + 3 * k;
        assert_true(fabs(0.6 * x[1] + 0.8 * x[2]) < 1e-14 && length(x) > 1);
    }
    close_case(&c);
}

/* What a builder of cells says of a shape stands beside the striker's name and what to change. */
static void a_shape_that_cannot_be_made_is_named(void **state)
{
    (void)state;
    bench_case c;
    const brc_status status = try_case(
        &c, (case_options){.no_contact = true,
                           .materials = STEEL,
                           .fill = FILL,
                           .stages = STAGE("1"),
                           .gravity = STRIKERS("  ring: {shape: {parts: [{role: add, shape: {torus: {radius: 2 m, "
                                               "tube: 0.5 m, centre: [50 m, 0, 0]}}}]}, facets: 12, material: "
                                               "steel}\n")});
    assert_int_equal(status, BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "striker 'ring'"));
    assert_non_null(strstr(brc_context_message(c.context), "more facets"));
    close_case(&c);
}

/* Single precision: the same path to its roundings, also far from the origin, as displacements are kept and not
 * positions. */
static void single_precision_keeps_small_steps_far_from_the_origin(void **state)
{
    (void)state;
    bench_case c;
    open_strikers(&c,
                  STRIKERS("  brick: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [1000 m, 0, 0]}}, material: steel, "
                           "motion: {free: {velocity: [1 um/s, 0, 0]}}}\n"),
                  STAGE("1000"), BRC_SINGLE);
    assert_done(&c, brc_simulation_advance(c.simulation, 1000));
    assert_true(fabs(now_of(&c, 0).displacement[0] / 1e-6 - 1) < 1000 * 6e-8);
    close_case(&c);
}

/* A prescribed force adds a kick to a velocity 1000 times: half a unit in the last place each, 6e-8. */
static void single_precision_pushes_too(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger ledger;
    open_strikers(&c,
                  STRIKERS("  brick: {shape: {box: {size: [1 m, 1 m, 1 m], origin: [10 m, 0, 0]}}, material: steel, "
                           "motion: {free: {force: [200 N, 0, 0]}}}\n"),
                  STAGE("1000"), BRC_SINGLE);
    assert_done(&c, brc_simulation_advance(c.simulation, 1000));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(fabs(now_of(&c, 0).velocity[0] / 0.2 - 1) < 1000 * 6e-8);
    assert_true(fabs(ledger.work / 20 - 1) < 1000 * 6e-8);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tumbling_brick_keeps_momentum_and_energy),
        cmocka_unit_test(constant_loads_give_the_parabola),
        cmocka_unit_test(free_strikers_fall_and_rails_hold_them),
        cmocka_unit_test(driven_strikers_follow_their_table_and_their_work_is_booked),
        cmocka_unit_test(tchamwa_moves_strikers_as_elements),
        cmocka_unit_test(mass_and_inertia_are_those_of_the_shape),
        cmocka_unit_test(pieces_of_all_strikers_stand_in_one_list),
        cmocka_unit_test(a_shape_that_cannot_be_made_is_named),
        cmocka_unit_test(single_precision_keeps_small_steps_far_from_the_origin),
        cmocka_unit_test(single_precision_pushes_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
