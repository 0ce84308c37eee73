/* After breaks only the rings of elements around them are evaluated: forces, velocities, energy and the breaks that
 * follow are those of an evaluation of the whole body. */
#include "../../../host/solver/effects/fracture/breaking.h"
#include "../../../host/solver/effects/contact/touching.h"
#include "../effects/contact/contact_case.h"
#include <math.h>
#include <stdlib.h>

#define PLANES                                                                                                         \
    "  - name: burst\n    solver: {dynamic: {steps: 400}}\n    loads:\n      - face_displacement: {set: x-, x: 0 m, "  \
    "y: 0 m, z: 0 m}\n"                                                                                                \
    "      - traction: {set: x+, x: 1e-4 Pa}\n    initial:\n      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, "    \
    "0]}}\n"
#define GRAVITY "gravity: [0 m/s^2, -1e-4 m/s^2, 0 m/s^2]\n"

static brc_rings *rings_of(bench_case *c)
{
    return brc_cell_breaks_rings(c->simulation);
}
static double *rows(bench_case *c, brc_buffer *buffer)
{
    double *x = calloc((size_t)(3 * c->domain->n_elements), sizeof *x);
    assert_done(c, brc_state_from_rows(c->simulation, buffer, x, 3));
    return x;
}

static double energy(bench_case *c)
{
    brc_ledger l;
    assert_done(c, brc_simulation_ledger(c->simulation, &l));
    return l.elastic + l.stabilisation + l.contact;
}

static double lost(bench_case *c)
{
    double x;
    assert_done(c, brc_fracture_lost(c->simulation, &x));
    return x;
}

static double farthest(const double *a, const double *b, int64_t n)
{
    double worst = 0, largest = 0;
    for (int64_t k = 0; k < n; ++k) {
        worst = fmax(worst, fabs(a[k] - b[k]));
        largest = fmax(largest, fabs(b[k]));
    }
    assert_true(largest > 0);
    return worst / largest;
}

/* Breaks some bonds of a body that has moved for some steps: every bond above `share` of the stress of the one nearest
 * to its limit. Sums of some hundred products are rounded to 1e-14; the energy released is a hundredth of the whole, of
 * which both sides keep 1e-15. */
static void one_break(case_options o, int64_t steps, double share)
{
    bench_case c;
    const double half_kick = 0.01;
    open_case(&c, o);
    begin_first(&c);
    run_steps(&c, steps);
    brc_simulation *s = c.simulation;
    const int64_t n = 3 * c.domain->n_elements;
    int64_t before, after;
    double ratio;
    assert_done(&c, brc_simulation_broken(s, &before));
    assert_done(&c, brc_simulation_failure_ratio(s, &ratio));
    double *f_old = rows(&c, brc_force_of(s)), *v_old = rows(&c, brc_velocity_of(s)),
           *w_old = brc_torque_of(s) ? rows(&c, brc_spin_of(s)) : NULL,
           *t_old = brc_torque_of(s) ? rows(&c, brc_torque_of(s)) : NULL;
    brc_touching touch = {0};
    if (s->contact) assert_done(&c, brc_simulation_touching(s, &touch));
    if (s->contact) print_message("%lld pairs touch\n", (long long)touch.pairs);
    assert_true(!s->contact || touch.pairs > 0);
    const double e_old = energy(&c), lost_old = lost(&c);
    assert_done(&c, brc_cell_breaks_step(s, half_kick, share * ratio));
    assert_done(&c, brc_simulation_broken(s, &after));
    const brc_ring_list *list = brc_rings_around(rings_of(&c));
    print_message("%lld bonds broken before, %lld now; rings of %d, %d, %d, %d of %lld elements\n", (long long)before,
                  (long long)(after - before), (int)list->n[0], (int)list->n[1], (int)list->n[2], (int)list->n[3],
                  (long long)c.domain->n_elements);
    assert_true(after > before && list->n[0] > 0 && list->n[1] > list->n[0]);
    double *f = rows(&c, brc_force_of(s)), *v = rows(&c, brc_velocity_of(s)),
           *t = brc_torque_of(s) ? rows(&c, brc_torque_of(s)) : NULL,
           *w = brc_torque_of(s) ? rows(&c, brc_spin_of(s)) : NULL;
    assert_done(&c, brc_force_of_state(s, BRC_BOOK_NOTHING)); /* of the whole body */
    double *f_whole = rows(&c, brc_force_of(s)), *t_whole = brc_torque_of(s) ? rows(&c, brc_torque_of(s)) : NULL;
    assert_true(farthest(f, f_whole, n) < 1e-12);
    if (t) assert_true(farthest(t, t_whole, n) < 1e-12);
    for (int64_t e = 0; e < c.domain->n_elements; ++e)
        for (int k = 0; k < 3; ++k) {
            const double m = c.domain->volume[e];
            v_old[3 * e + k] += half_kick * (f_old[3 * e + k] - f_whole[3 * e + k]) / m;
        }
    assert_true(farthest(v, v_old, n) < 1e-12);
    if (t) {
        double *inertia = calloc((size_t)(n / 3), sizeof *inertia);
        assert_done(&c, brc_state_from_rows(s, brc_inertia_of(s), inertia, 1));
        for (int64_t i = 0; i < n; ++i)
            w_old[i] += half_kick * (t_old[i] - t_whole[i]) / inertia[i / 3];
        assert_true(farthest(w, w_old, n) < 1e-12);
        free(inertia);
    }
    const double released = e_old - energy(&c);
    print_message("released %.17g J, booked %.17g J, of %.3g J\n", released, lost(&c) - lost_old, e_old);
    assert_true(released != 0 && fabs(lost(&c) - lost_old - released) < 1e-13 * e_old);
    free(f_old), free(v_old), free(w_old), free(t_old), free(f), free(v), free(t), free(w), free(f_whole),
        free(t_whole);
    close_case(&c);
}

static void forces_velocities_and_energy_after_a_break_are_those_of_the_whole_body(void **state)
{
    (void)state;
    one_break((case_options){.stages = CELLS_BURST(60),
                             .materials = CELLS_STRENGTH("1 Pa"),
                             .sets = CELLS_FRACTURE,
                             .fill = "cells: [12, 9, 9], spread: 90 %, seed: 2"},
              20, 0.97);
    one_break((case_options){.stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("1 Pa"), .sets = CELLS_FRACTURE},
              20, 0.5);
    one_break((case_options){.stages = CELLS_BURST(60),
                             .materials = CELLS_STRENGTH("1 Pa") "\n  steel: {E: 30 Pa, nu: 0.3, density: 1 kg/m^3, "
                                                                 "strength: {tension: 30 Pa}}",
                             .regions =
                                 "    regions:\n      - {where: {box: {from: [0.5 m, -1 m, -1 m], to: [2 m, 2 m, "
                                 "2 m]}}, material: steel}\n",
                             .sets = CELLS_FRACTURE,
                             .fill = "cells: [12, 9, 9], spread: 90 %, seed: 2"},
              20, 0.97);
}

static void held_faces_tractions_and_gravity_stay(void **state)
{
    (void)state;
    one_break((case_options){.stages = PLANES,
                             .gravity = GRAVITY,
                             .materials = CELLS_STRENGTH("1 Pa"),
                             .sets = CELLS_FRACTURE,
                             .fill = "cells: [12, 9, 9], spread: 90 %, seed: 2"},
              20, 0.97);
}

static void the_published_law_too(void **state)
{
    (void)state;
    one_break((case_options){.model = "dlsm-published",
                             .stages = CELLS_BURST(60),
                             .materials = CELLS_STRENGTH("1 Pa"),
                             .sets = CELLS_FRACTURE,
                             .fill = "cells: [12, 9, 9], spread: 90 %, seed: 2"},
              20, 0.97);
}

/* Of pieces that touch each other, with friction, and a floor under them. */
static void pairs_that_touch_too(void **state)
{
    (void)state;
    static const char floor[] =
        CONTACT_KEYS "strikers:\n  floor: {plane: {point: [0, 0, -1 mm], normal: [0, 0, 1]}, material: stone}\n";
    static const char *const models[2] = {"dlsm", "dlsm-published"};
    for (int k = 0; k < 2; ++k)
        one_break((case_options){.model = models[k],
                                 .fill = "cells: [8, 7, 7], spread: 90 %, seed: 2",
                                 .stages = CONTACT_CRUSH,
                                 .materials = CELLS_STRENGTH("1.2e-3 Pa"),
                                 .sets = k ? CONTACT_KEYS : floor,
                                 .gravity = k ? NULL : "gravity: [0 m/s^2, 0 m/s^2, -1e-3 m/s^2]\n"},
                  200, 0.97);
}

/* Every force of 150 steps in which bonds break one after the other stays that of the whole body: nothing piles up. */
static void nothing_piles_up(case_options o)
{
    bench_case c;
    int64_t broken;
    open_case(&c, o);
    begin_first(&c);
    run_steps(&c, 150);
    assert_done(&c, brc_simulation_broken(c.simulation, &broken));
    assert_true(broken > 50);
    double *f = rows(&c, brc_force_of(c.simulation));
    assert_done(&c, brc_force_of_state(c.simulation, BRC_BOOK_NOTHING));
    double *whole = rows(&c, brc_force_of(c.simulation));
    assert_true(farthest(f, whole, 3 * c.domain->n_elements) < 1e-12);
    free(f), free(whole);
    close_case(&c);
}

static void nothing_piles_up_in_a_run(void **state)
{
    (void)state;
    nothing_piles_up(
        (case_options){.stages = CELLS_BURST(200), .materials = CELLS_STRENGTH("6e-4 Pa"), .sets = CELLS_FRACTURE});
    nothing_piles_up((case_options){.stages = CELLS_BURST(200),
                                    .materials = CELLS_STRENGTH("6e-4 Pa"),
                                    .sets = "fracture: {criterion: virial-principal}\n"});
    nothing_piles_up(
        (case_options){.stages = CONTACT_CRUSH, .materials = CELLS_STRENGTH("8e-4 Pa"), .sets = CONTACT_KEYS});
}

/* The same bonds in the same steps; the velocities of a whole evaluation are kicked there and back, a rounding each
 * step, which a hundred steps carry on, and stresses show it. */
static void the_same_bonds_break_as_with_whole_evaluations(case_options o)
{
    bench_case c[2];
    const brc_break *events[2];
    int64_t n[2];
    for (int k = 0; k < 2; ++k) {
        open_case(&c[k], o);
        begin_first(&c[k]);
        if (k == 1) brc_rings_make_whole(rings_of(&c[k]));
        run_steps(&c[k], 60);
        assert_done(&c[k], brc_simulation_breaks(c[k].simulation, &n[k], &events[k]));
    }
    assert_true(n[0] > 20 && n[0] == n[1]);
    for (int64_t k = 0; k < n[0]; ++k) {
        const brc_break *a = events[0] + k, *b = events[1] + k;
        assert_true(a->bond == b->bond && a->step == b->step && a->mode == b->mode);
        assert_true(fabs(a->stress - b->stress) <= 1e-9 * fabs(b->stress));
        assert_true(fabs(a->energy - b->energy) <= 1e-9 * lost(&c[1]));
    }
    close_case(&c[0]), close_case(&c[1]);
}

static void the_same_bonds_break(void **state)
{
    (void)state;
    the_same_bonds_break_as_with_whole_evaluations(
        (case_options){.stages = CELLS_BURST(60), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE});
    the_same_bonds_break_as_with_whole_evaluations((case_options){.model = "dlsm-published",
                                                                  .stages = CELLS_BURST(60),
                                                                  .materials = CELLS_STRENGTH("2e-4 Pa"),
                                                                  .sets = CELLS_FRACTURE});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_velocities_and_energy_after_a_break_are_those_of_the_whole_body),
        cmocka_unit_test(held_faces_tractions_and_gravity_stay),
        cmocka_unit_test(the_published_law_too),
        cmocka_unit_test(pairs_that_touch_too),
        cmocka_unit_test(nothing_piles_up_in_a_run),
        cmocka_unit_test(the_same_bonds_break),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
