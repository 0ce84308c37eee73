/* Bonds of cells that break (dlsm): when, which, what happens to force, energy and momentum; and nothing at all without
 * `fracture`. */
#include "cells_case.h"
#include "fracture_case.h"
#include "../../../../host/solver/effects/fracture/cell_breaks.h"
#include "../../../../host/base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- nothing without it ---- */

static void without_fracture_there_is_neither_array_nor_pass(void **state)
{
    (void)state;
    bench_case plain, strong, with;
    open_case(&plain, (case_options){.stages = CELLS_BURST(50)});
    open_case(&strong, (case_options){.stages = CELLS_BURST(50), .materials = CELLS_STRENGTH("2e-4 Pa")});
    open_case(&with, (case_options){
                         .stages = CELLS_BURST(50), .materials = CELLS_STRENGTH("2e-4 Pa"), .sets = CELLS_FRACTURE});
    fracture_is_nothing_unless_asked(&plain, &strong, &with);
}

static void what_never_breaks_moves_as_without_fracture(void **state)
{
    (void)state;
    bench_case plain, with;
    open_case(&plain, (case_options){.stages = CELLS_BURST(50)});
    open_case(&with,
              (case_options){.stages = CELLS_BURST(50), .materials = CELLS_STRENGTH("1 GPa"), .sets = CELLS_FRACTURE});
    fracture_that_never_comes_moves_nothing(&plain, &with);
}

/* ---- when and which ---- */

/* nu 0 and a velocity that grows along x: every cell is stretched alike, P = E (1 + e)(e + e^2/2) with e = t du/dx, and
 * all bonds across x break in the step in which it first exceeds the strength; the face loads hold the ends in the same
 * motion. */
static void regular_cells_break_at_exactly_the_strength(void **state)
{
    (void)state;
    const double strength = 1e-3, rate = 1e-3;
    bench_case c;
    const brc_break *events;
    int64_t n, torn = 0;
    open_case(&c,
              (case_options){.materials = "  stone: {E: 1 Pa, nu: 0, density: 1 kg/m^3, strength: {tension: 1e-3 Pa}}",
                             .sets = CELLS_FRACTURE,
                             .fill = "cells: [6, 4, 4], spread: 0 %, seed: 1",
                             .stages = "  - name: pull\n    solver: {dynamic: {steps: 1000, time_step: 0.0317 s}}\n"
                                       "    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - "
                                       "face_velocity: {set: x+, x: 1e-3 m/s}\n"
                                       "    initial:\n      - velocity: {gradient: {x: [1e-3 1/s, 0, 0]}}\n"});
    begin_first(&c);
    const double dt = brc_simulation_time_step(c.simulation).value;
    int64_t expected = 1;
    while ((1 + rate * dt * (double)expected) *
               (rate * dt * (double)expected + 0.5 * pow(rate * dt * (double)expected, 2)) <=
           strength)
        ++expected;
    run_steps(&c, expected - 1);
    assert_int_equal(count_broken(&c), 0);
    run_steps(&c, 1);
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    for (int64_t k = 0; k < n; ++k) {
        assert_int_equal(events[k].step, expected);
        if (events[k].mode == BRC_BREAK_DETACHED) continue;
        const double e = rate * dt * (double)expected;
        ++torn;
        assert_true(fabs(events[k].normal[0]) > 1 - 1e-12);
        assert_true(fabs(events[k].stress - (1 + e) * (e + 0.5 * e * e)) <
                    1e-12 * events[k].stress); /* rounding of u over e L */
    }
    assert_int_equal(torn, 5 * 4 * 4);
    close_case(&c);
}

/* The asked half percent; the load grows by 0.2 % of the strength a step. */
static void random_cells_start_to_break_within_half_a_percent_of_the_strength(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 2; ++seed) {
        bench_case c;
        char fill[96];
        double force[3] = {0, 0, 0};
        snprintf(fill, sizeof fill, "cells: [6, 6, 6], spread: 90 %%, seed: %d", seed);
        open_case(&c,
                  (case_options){
                      .materials = CELLS_STRENGTH("1e-3 Pa"),
                      .sets = CELLS_FRACTURE,
                      .fill = fill,
                      .stages =
                          "  - name: pull\n    solver: {dynamic: {steps: 10000, time_step: {auto: {safety: 0.5}}}}\n"
                          "    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - face_velocity: {set: x+, "
                          "x: 5e-5 m/s}\n"
                          "    initial:\n      - velocity: {gradient: {x: [5e-5 1/s, 0, 0]}}\n"});
        begin_first(&c);
        const int32_t wall = brc_domain_find_set(c.domain, "x+");
        while (count_broken(&c) == 0) {
            assert_done(&c, brc_simulation_reaction(c.simulation, wall, force));
            run_steps(&c, 1);
            assert_true(brc_simulation_step(c.simulation) < 2000);
        }
        print_message("seed %d: force over area at the last step without breaks %.5f of the strength\n", seed,
                      force[0] / 1e-3);
        assert_true(fabs(force[0] / 1e-3 - 1) < 0.005);
        close_case(&c);
    }
}

/* The force pass says who looks (cell_normal.h); a share of the limits other than 1 lets all look. Wild states of six
 * sizes, from a bond here and there to most of them; a bond within 1e-7 of its limit would be the other answer's, of
 * 1200 whose stresses spread over the size of the strength. */
static void elements_that_do_not_look_overlook_nothing(void **state)
{
    (void)state;
    int64_t broken[6];
    for (int k = 0; k < 12; ++k) {
        bench_case c[2];
        int64_t n[2];
        const brc_break *events[2];
        const double size = 2e-4 * pow(1.7, k / 2);
        for (int side = 0; side < 2; ++side) {
            open_case(&c[side], (case_options){.materials = CELLS_STRENGTH("1e-3 Pa, scatter: {weibull: {modulus: 2}}"),
                                               .sets = CELLS_FRACTURE,
                                               .precision = k % 2 ? BRC_MIXED : BRC_DOUBLE});
            const int64_t n_elements = c[side].domain->n_elements;
            double *u = calloc((size_t)(3 * n_elements), sizeof *u);
            for (int64_t e = 0; e < n_elements; ++e) {
                const double *x = c[side].domain->position + 3 * e;
                u[3 * e] = size * (x[0] + 0.3 * x[1] * x[1]), u[3 * e + 1] = -0.4 * size * x[1] * x[2],
                      u[3 * e + 2] = 0.2 * size * sin(9 * x[0]);
                for (int j = 0; j < 3; ++j)
                    u[3 * e + j] += 0.02 * size * random_at((uint64_t)(3 * e + j));
            }
            begin_first(&c[side]);
            run_steps(&c[side], 1); /* breaks are known by their step, from 1 on */
            assert_done(&c[side], brc_simulation_set_state(c[side].simulation, u, NULL));
            assert_done(&c[side], brc_cell_breaks_step(c[side].simulation, 0, side ? 1 - 1e-7 : 1));
            assert_done(&c[side], brc_simulation_breaks(c[side].simulation, &n[side], &events[side]));
            free(u);
        }
        assert_int_equal(n[0], n[1]);
        if (k > 5) assert_true(n[0] > 20);
        broken[k / 2] = n[0];
        for (int64_t b = 0; b < n[0]; ++b)
            assert_int_equal(events[0][b].bond, events[1][b].bond);
        close_case(&c[0]), close_case(&c[1]);
    }
    print_message("broken bonds: %lld, %lld, %lld, %lld, %lld, %lld\n", (long long)broken[0], (long long)broken[1],
                  (long long)broken[2], (long long)broken[3], (long long)broken[4], (long long)broken[5]);
}

static void no_bond_breaks_twice_and_damage_counts_them(void **state)
{
    (void)state;
    bench_case c;
    const brc_break *events;
    int64_t n;
    open_case(
        &c, (case_options){.stages = CELLS_BURST(200), .materials = CELLS_STRENGTH("6e-4 Pa"), .sets = CELLS_FRACTURE});
    const brc_domain *d = c.domain;
    begin_first(&c);
    run_steps(&c, 100);
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    print_message("%lld of %lld bonds broken\n", (long long)n, (long long)d->n_bonds);
    assert_true(n > 100 && n < d->n_bonds);
    int *times = calloc((size_t)d->n_bonds, sizeof *times);
    double *damage = calloc((size_t)d->n_elements, sizeof *damage), *lost = calloc((size_t)d->n_elements, sizeof *lost);
    double energy = 0;
    for (int64_t k = 0; k < n; ++k) {
        assert_int_equal(++times[events[k].bond], 1);
        assert_true(events[k].mode == BRC_BREAK_DETACHED || events[k].stress > 6e-4);
        lost[events[k].element_i] += 1, lost[events[k].element_j] += 1;
        energy += events[k].energy;
        const int64_t h = d->bond_half_edge[events[k].bond];
        assert_memory_equal(events[k].position, d->face_centroid + 3 * h, sizeof events[k].position);
    }
    assert_done(&c, brc_simulation_damage(c.simulation, damage));
    for (int64_t e = 0; e < d->n_elements; ++e)
        assert_true(damage[e] == lost[e] / (double)(d->row_start[e + 1] - d->row_start[e]));
    brc_ledger ledger;
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(fabs(energy - ledger.fracture) < 1e-12 * ledger.fracture); /* the events share the ledger's term */
    free(times), free(damage), free(lost);
    close_case(&c);
}

/* ---- what is left is the law of a body with more free faces ---- */

/* A strained, turned state with noise of a tenth of the spacing: u [n][3] [m]. */
static double *wild_state(const brc_domain *d)
{
    double *u = calloc((size_t)(3 * d->n_elements), sizeof *u);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = d->position + 3 * e;
        const double bent[3] = {x[0] + 0.2 * x[1] + 0.1 * sin(3 * x[2]), 1.1 * x[1] + 0.05 * x[0] * x[2],
                                0.9 * x[2] - 0.1 * x[0]};
        const double turned[3] = {0.8 * bent[0] - 0.6 * bent[1], 0.6 * bent[0] + 0.8 * bent[1], bent[2]};
        for (int k = 0; k < 3; ++k)
            u[3 * e + k] = turned[k] - x[k] + 0.01 * random_at((uint64_t)(3 * e + k));
    }
    return u;
}

static double energy_at(bench_case *c, const double *u)
{
    brc_ledger ledger;
    assert_done(c, brc_simulation_set_state(c->simulation, u, NULL));
    assert_done(c, brc_simulation_ledger(c->simulation, &ledger));
    return ledger.elastic + ledger.stabilisation;
}

/* Five-point differences are exact for the energy's quartic dependence on one component; 1e-9: rounding of W, 1e-16 of
 * a sum some thousand forces times the step, over that step (as tests/solver/core/test_force.c). */
static void force_is_the_gradient_of_the_energy_of_a_broken_body(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){
                      .stages = CELLS_BURST(200),
                      .materials = CELLS_STRENGTH("6e-4 Pa"),
                      .sets = "fracture: {criterion: bond-normal, closure: false}\n",
                      .fill = "cells: [5, 5, 5], spread: 90 %, seed: 3"}); /* with closed faces: test_closed_faces.c */
    const brc_domain *d = c.domain;
    begin_first(&c);
    run_steps(&c, 60);
    const int64_t n_broken = count_broken(&c);
    print_message("%lld of %lld bonds broken\n", (long long)n_broken, (long long)d->n_bonds);
    assert_true(n_broken > 20 && n_broken < d->n_bonds * 3 / 4);
    double *u = wild_state(d), *f = calloc((size_t)(3 * d->n_elements), sizeof *f), worst = 0, largest = 0;
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    for (int64_t i = 0; i < 3 * d->n_elements; ++i)
        largest = fmax(largest, fabs(f[i]));
    const double h = 2e-3 * cbrt(d->volume[0]);
    for (int64_t i = 0; i < 3 * d->n_elements; i += 3 * d->n_elements / 40 + 1) {
        const double at[4] = {-2, -1, 1, 2}, weight[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}, middle = u[i];
        double slope = 0;
        for (int k = 0; k < 4; ++k) {
            u[i] = middle + at[k] * h;
            slope += weight[k] * energy_at(&c, u) / h;
        }
        u[i] = middle;
        worst = fmax(worst, fabs(slope + f[i]) / largest);
    }
    assert_int_equal(count_broken(&c), n_broken);
    if (!(worst < 1e-9)) fail_msg("%g", worst);
    free(u), free(f);
    close_case(&c);
}

/* A plane of weak bonds opens; under stress along it a linear field is still in equilibrium (sigma N = 0 on the cut),
 * to rounding: forces of E S e each, of which the sum of fourteen keeps 1e-14. */
static void a_linear_field_along_an_open_cut_is_in_equilibrium(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){
                      .materials = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}\n"
                                   "  twin: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}",
                      .regions = "    regions:\n      - {where: {box: {from: [-1 m, 0.5 m, -1 m], to: [2 m, 2 m, 2 "
                                 "m]}}, material: twin}\n",
                      .sets = CELLS_FRACTURE
                      "interactions: {interfaces: [{materials: {first: stone, second: twin, tension: 1e-6 Pa}}]}\n",
                      .fill = "cells: [6, 6, 6], spread: 0 %, seed: 1",
                      .stages = "  - name: open\n    solver: {dynamic: {steps: 100}}\n    initial:\n      - velocity: "
                                "{gradient: {y: [0, 1e-3 1/s, 0]}}\n"});
    const brc_domain *d = c.domain;
    begin_first(&c);
    run_steps(&c, 20);
    assert_int_equal(count_broken(&c), 36);
    const double e = 1e-3, across = -0.2 * e;
    double *u = calloc((size_t)(3 * d->n_elements), sizeof *u), *f = calloc((size_t)(3 * d->n_elements), sizeof *f);
    for (int64_t k = 0; k < d->n_elements; ++k)
        for (int i = 0; i < 3; ++i)
            u[3 * k + i] = (i == 0 ? e : across) * d->position[3 * k + i];
    /* the full law: lateral strain of vanishing lateral stress, (1 + a)^2 = 1 - nu ((1 + e)^2 - 1) */
    const double lateral = sqrt(1 - 0.2 * ((1 + e) * (1 + e) - 1)) - 1;
    for (int64_t k = 0; k < d->n_elements; ++k)
        for (int i = 1; i < 3; ++i)
            u[3 * k + i] = lateral * d->position[3 * k + i];
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    const double scale = e / 36; /* E e S */
    for (int64_t k = 0; k < d->n_elements; ++k)
        if (d->position[3 * k] > 0.4 && d->position[3 * k] < 0.6) /* three cells from the loaded ends */
            for (int i = 0; i < 3; ++i)
                assert_true(fabs(f[3 * k + i]) < 1e-12 * scale);
    free(u), free(f);
    close_case(&c);
}

/* ---- energy and momentum ---- */

typedef struct closure {
    double error, worst; /* at the end, largest on the way, over the peak of the elastic energy [-] */
    double counted;      /* the largest where what breaks cost the integrator counts, `numerical` [-] */
    int64_t broken, detached;
} closure;

static closure closure_of(const char *stages, const char *strength, const char *fracture, const char *shape,
                          const char *fill, int64_t every)
{
    bench_case c;
    brc_ledger ledger;
    closure out = {0};
    const brc_break *events;
    open_case(&c,
              (case_options){.stages = stages, .materials = strength, .sets = fracture, .shape = shape, .fill = fill});
    begin_first(&c);
    const brc_time_step step = brc_simulation_time_step(c.simulation);
    const int64_t steps = brc_simulation_planned_steps(c.simulation, 0, step.value);
    for (int64_t k = 0; k < steps; k += every) {
        run_steps(&c, steps - k < every ? steps - k : every);
        assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
        out.error =
            (ledger.total - ledger.work + ledger.fracture + ledger.friction - ledger.initial) / ledger.peak_elastic;
        if (ledger.fracture > 0) out.worst = fmax(out.worst, fabs(out.error));
        if (ledger.fracture > 0)
            out.counted = fmax(out.counted, fabs(out.error + ledger.numerical / ledger.peak_elastic));
    }
    assert_done(&c, brc_simulation_breaks(c.simulation, &out.broken, &events));
    for (int64_t k = 0; k < out.broken; ++k)
        out.detached += events[k].mode == BRC_BREAK_DETACHED;
    print_message("%.2f of the critical step: closure %.2e at the end, %.2e at worst, %.2e with numerical, of the peak "
                  "elastic energy %.3e J; %lld of %lld bonds broken, %lld of them detached\n",
                  step.safety, out.error, out.worst, out.counted, ledger.peak_elastic, (long long)out.broken,
                  (long long)c.domain->n_bonds, (long long)out.detached);
    close_case(&c);
    return out;
}

static closure closure_of_bar(double safety, const char *fracture, const char *relaxed)
{
    char stages[512], fill[128];
    snprintf(stages, sizeof stages,
             "  - name: pull\n    solver: {dynamic: {duration: 14 s, time_step: {auto: {safety: %g}}}}\n"
             "    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - face_velocity: {set: x+, x: 2e-4 m/s}\n"
             "    initial:\n      - velocity: {gradient: {x: [1e-4 1/s, 0, 0]}}\n",
             safety);
    snprintf(fill, sizeof fill, "cells: [10, 5, 5], spread: 90 %%, seed: 1%s", relaxed);
    return closure_of(stages, CELLS_STRENGTH("1e-3 Pa"), fracture, "{box: {size: [2 m, 1 m, 1 m]}}", fill, 4);
}

/* Of breaks alone: sides that meet are kinks of the force, whose errors are their own (test_closed_faces.c). */
#define FREE_SIDES "fracture: {criterion: bond-normal, closure: false}\n"
static const double bar_safety[] = {0.8, 0.35}, bar_bound[] = {0.05, 0.01}; /* asked */

/* A bar pulled apart: a third of its bonds go. */
static void the_ledger_of_a_bar_closes_through_its_fracture(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        const closure out = closure_of_bar(bar_safety[k], CELLS_FRACTURE, "");
        assert_true(out.broken > 300);
        assert_true(out.worst < bar_bound[k]);
    }
}

/* Relaxed cells: the step is half as long again, and over half of the bonds go. What the ledger then lacks is Verlet's:
 * with the part of it that is booked, that of the forces (rings.cl), it closes within the bounds, and what is
 * left, the part of the velocities, is less than that. */
static void what_breaks_cost_the_integrator_is_booked(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        const closure out = closure_of_bar(bar_safety[k], FREE_SIDES, ", lloyd: 5");
        assert_true(out.broken > 500);
        assert_true(out.counted < bar_bound[k] && out.counted < 0.5 * out.worst);
    }
}

/* A quarter of the step, a sixteenth of the error. Other steps break other bonds at other moments, so the order shows
 * in the whole, not in the last digit: an eighth is asked, a first order gives a quarter. */
static void the_error_of_the_ledger_is_of_second_order(void **state)
{
    (void)state;
    closure out[2];
    for (int k = 0; k < 2; ++k) {
        char stages[512];
        snprintf(stages, sizeof stages,
                 "  - name: burst\n    solver: {dynamic: {duration: 1 s, time_step: {auto: {safety: %g}}}}\n"
                 "    initial:\n      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n",
                 k ? 0.0875 : 0.35);
        out[k] = closure_of(stages, CELLS_STRENGTH("4e-4 Pa"), FREE_SIDES, NULL,
                            "cells: [6, 6, 6], spread: 90 %, seed: 1", k ? 8 : 2);
        assert_true(out[k].broken > 200 && out[k].worst < 0.01);
    }
    assert_true(fabs(out[1].error) < fabs(out[0].error) / 8);
}

/* Sums of some thousand terms over a hundred steps stay within 1e-12 of their size. Without friction, which turns cells
 * without bonds (test_closed_faces.c). */
static void breaking_keeps_momentum_and_angular_momentum(void **state)
{
    (void)state;
    bench_case c;
    double before[6], after[6], size = 0;
    open_case(&c, (case_options){.stages = CELLS_BURST(200),
                                 .materials = CELLS_STRENGTH("3e-4 Pa"),
                                 .sets = "fracture: {criterion: bond-normal, friction: 0}\n"});
    begin_first(&c);
    cell_momenta(&c, before);
    run_steps(&c, 150);
    cell_momenta(&c, after);
    assert_true(count_broken(&c) > 100);
    for (int k = 0; k < 6; ++k)
        size = fmax(size, fabs(before[k]));
    for (int k = 0; k < 6; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-12 * size);
    close_case(&c);
}

static void the_same_bonds_break_for_any_number_of_threads(void **state)
{
    (void)state;
    const case_options one = {.stages = CELLS_BURST(60),
                              .materials = CELLS_STRENGTH("2e-4 Pa"),
                              .sets = CELLS_FRACTURE,
                              .n_threads = 1,
                              .exact = true};
    case_options two = one;
    two.n_threads = 2;
    cells_compare(one, two);
}

/* ---- refusals ---- */

static void refused(case_options o, const char *sentence)
{
    bench_case c;
    assert_int_equal(try_case(&c, o), BRC_BAD_INPUT);
    if (!strstr(brc_context_message(c.context), sentence)) fail_msg("%s", brc_context_message(c.context));
    close_case(&c);
}

static void scenes_without_any_strength_are_refused(void **state)
{
    (void)state;
    refused((case_options){.sets = CELLS_FRACTURE}, "nothing can break");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_fracture_there_is_neither_array_nor_pass),
        cmocka_unit_test(what_never_breaks_moves_as_without_fracture),
        cmocka_unit_test(regular_cells_break_at_exactly_the_strength),
        cmocka_unit_test(random_cells_start_to_break_within_half_a_percent_of_the_strength),
        cmocka_unit_test(elements_that_do_not_look_overlook_nothing),
        cmocka_unit_test(no_bond_breaks_twice_and_damage_counts_them),
        cmocka_unit_test(force_is_the_gradient_of_the_energy_of_a_broken_body),
        cmocka_unit_test(a_linear_field_along_an_open_cut_is_in_equilibrium),
        cmocka_unit_test(the_ledger_of_a_bar_closes_through_its_fracture),
        cmocka_unit_test(what_breaks_cost_the_integrator_is_booked),
        cmocka_unit_test(the_error_of_the_ledger_is_of_second_order),
        cmocka_unit_test(breaking_keeps_momentum_and_angular_momentum),
        cmocka_unit_test(the_same_bonds_break_for_any_number_of_threads),
        cmocka_unit_test(scenes_without_any_strength_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
