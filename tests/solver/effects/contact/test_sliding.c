/* Cells that fail in shear with a fracture energy (sliding.h, docs/notebook/theory.md T11): strength against
 * Mohr-Coulomb, what a slide costs and what it rubs off, energy and momentum. */
#include "../fracture/cells_case.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* cohesion [Pa] with 30 degrees. */
#define SLIDES(cohesion, more)                                                                                         \
    "fracture: {criterion: {mohr-coulomb: {cohesion: " cohesion " Pa, friction: 30 deg}}" more "}\n"
#define STONE(name, strength) "  " name ": {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {" strength "}}"

/* ---- a joint ---- */

static const double cohesion = 1e-4, energy = 1.25e-8, rubs = 0.3; /* of the joint [Pa] [J/m^2] [-] */

/* Two layers of cells, each moved as one, the upper one pressed down and then drawn along x, with nothing but faces
 * that slide between them, so that the push stays; the joint between them has a thousandth of all that the cells
 * bear. */
static void open_joint(bench_case *c, const char *softening, brc_precision precision)
{
    char materials[640];
    const char *strength = "tension: 1 Pa, fracture_energy: 1e-4 J/m^2, shear_fracture_energy: 1.25e-5 J/m^2";
    snprintf(materials, sizeof materials,
             "  stone: {E: 1 Pa, nu: 0, density: 1 kg/m^3, strength: {%s, softening: %s}}\n"
             "  twin: {E: 1 Pa, nu: 0, density: 1 kg/m^3, strength: {%s, softening: %s}}",
             strength, softening, strength, softening);
    open_case(
        c, (case_options){
               .materials = materials,
               .shape = "{box: {size: [1 m, 0.5 m, 1 m]}}",
               .fill = "cells: [4, 2, 4], spread: 0 %, seed: 1",
               .regions = "    regions:\n      - {where: {half_space: {point: [0, 0.25 m, 0], normal: [0, 1, 0]}}, "
                          "material: twin}\n",
               .sets = SLIDES(
                   "0.1",
                   ", friction: 0.3") "interactions: {interfaces: [{materials: {first: stone, second: twin, factor: "
                                      "0.1 %}}]}\n"
                                      "sets:\n  low: {elements: {half_space: {point: [0, 0.25 m, 0], normal: [0, -1, "
                                      "0]}}}\n"
                                      "  high: {elements: {half_space: {point: [0, 0.25 m, 0], normal: [0, 1, 0]}}}\n",
               .stages =
                   "  - name: shear\n    solver: {dynamic: {duration: 620 s, mass_damping: 0.5 1/s, time_step: {fixed: "
                   "0.1 s}}}\n    loads:\n"
                   "      - element_displacement: {set: low, x: 0, y: 0, z: 0}\n"
                   "      - element_velocity: {set: high, y: -1.25e-6 m/s, table: [[0, 1], [20 s, 1], [20.1 s, 0]]}\n"
                   "      - element_velocity: {set: high, x: 1e-6 m/s, table: [[19.9 s, 0], [20 s, 1]]}\n",
               .precision = precision});
}

/* Peak, residual force and dissipation of two layers under pressure: (c + p tan phi) A, mu p A; G_II A, and mu p A
 * times the slip, which is what was travelled less what the force strains. Every face is alike, so that no face waits
 * for another. A step adds a hundredth of the friction, of which the sweeps leave some, and strains of 1e-4 turn the
 * faces: 1 % of the peak, half a percent of the friction. What is spent is the area below the law by the openings that
 * there were: to rounding. */
static void a_joint_slides_at_its_strength(brc_precision precision, double rounding)
{
    const char *law[] = {"linear", "exponential"};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        double peak = 0, pressure = 0, force[3] = {0, 0, 0}, stiffness = 0, before = 0, wanted = 0, slid = 0;
        open_joint(&c, law[k], precision);
        begin_first(&c);
        const double dt = brc_simulation_time_step(c.simulation).value;
        const int32_t high = brc_domain_find_set(c.domain, "high");
        const int64_t steps = brc_simulation_planned_steps(c.simulation, 0, dt);
        while (brc_simulation_step(c.simulation) < steps) {
            run_steps(&c,
                      steps - brc_simulation_step(c.simulation) < 10 ? steps - brc_simulation_step(c.simulation) : 10);
            assert_done(&c, brc_simulation_reaction(c.simulation, high, force));
            const double t = (double)brc_simulation_step(c.simulation) * dt, travelled = 1e-6 * (t - 20);
            if (t > 30 && !(stiffness > 0)) stiffness = force[0] / travelled;
            if (force[0] > peak) peak = force[0], pressure = -force[1];
            const double slip = stiffness > 0 ? travelled - force[0] / stiffness : 0;
            wanted += rubs * -force[1] * (slip - slid);
            slid = slip;
            const brc_ledger now = ledger_now(&c);
            assert_true(now.friction >= before - 1e-3 * energy); /* a slide takes energy, and gives none */
            before = now.friction;
        }
        const brc_ledger l = ledger_now(&c);
        const brc_softening_report report = softening_now(&c);
        const double strength = cohesion + pressure * tan(M_PI / 6), residual = rubs * -force[1];
        print_message("%s: pressed by %.4e Pa at the peak, %.4e Pa in the end: peak %.4f of c + p tan phi, residual "
                      "%.4f of mu p, spent %.6f of G_II, friction %.4f of the sum of mu p times slip; closure %.1e\n",
                      law[k], pressure, -force[1], peak / strength, force[0] / residual, l.fracture / energy,
                      l.friction / wanted, l.closure);
        assert_true(fabs(peak / strength - 1) < 0.01);
        assert_true(fabs(force[0] / residual - 1) < 0.005);
        assert_true(fabs(l.fracture / energy - 1) < rounding);
        assert_true(fabs(report.spent / energy - 1) < rounding);
        assert_true(fabs(l.friction / wanted - 1) < 0.005);
        assert_true(fabs((l.total - l.work + l.fracture + l.friction + l.damping - l.initial) / energy) <
                    0.01); /* work in = work spent */
        const brc_break *events;
        int64_t n;
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
        assert_int_equal(n, 16);
        for (int64_t i = 0; i < n; ++i) {
            assert_int_equal(events[i].mode, BRC_BREAK_SHEAR);
            assert_true(fabs(events[i].energy / (energy * events[i].area) - 1) < rounding);
        }
        close_case(&c);
    }
}
static void a_joint_slides_at_its_strength_and_costs_its_energy(void **state)
{
    (void)state;
    a_joint_slides_at_its_strength(BRC_DOUBLE, 1e-9);
}

/* ---- a block ---- */

/* Largest push over the section of a block of noisy cells, pressed at its sides; *left: the last one over it, of which
 * mode. */
static double crush(const char *side, double *left, double *shear, double *closure)
{
    bench_case c;
    char stages[900];
    double peak = 0, force[3] = {0, 0, 0};
    snprintf(stages, sizeof stages,
             "  - name: crush\n    solver: {dynamic: {duration: 240 s, mass_damping: 0.5 1/s}}\n    loads:\n"
             "      - face_displacement: {set: y-, y: 0}\n      - face_displacement: {set: x-, x: 0}\n      - "
             "face_displacement: {set: z-, z: 0}\n"
             "      - pressure: {set: x+, value: %s, table: [[0, 0], [40 s, 1]]}\n      - pressure: {set: z+, value: "
             "%s, table: [[0, 0], [40 s, 1]]}\n"
             "      - face_velocity: {set: y+, y: -1e-4 m/s, table: [[0, 0], [20 s, 1]]}\n",
             side, side);
    open_case(&c, (case_options){
                      .materials = STONE(
                          "stone", "tension: 5e-4 Pa, fracture_energy: 1e-6 J/m^2, shear_fracture_energy: 2e-6 J/m^2"),
                      .shape = "{box: {size: [1 m, 1.6 m, 1 m]}}",
                      .fill = "cells: [5, 8, 5], spread: 90 %, lloyd: 3, seed: 1",
                      .sets = SLIDES("1e-3", ""),
                      .stages = stages});
    begin_first(&c);
    const int64_t steps = brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value);
    const int32_t wall = brc_domain_find_set(c.domain, "y-");
    while (brc_simulation_step(c.simulation) + 10 <= steps) {
        run_steps(&c, 10);
        assert_done(&c, brc_simulation_reaction(c.simulation, wall, force));
        peak = fmax(peak, fabs(force[1]));
    }
    const brc_ledger l = ledger_now(&c);
    const brc_break *events;
    int64_t n, sheared = 0;
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    for (int64_t i = 0; i < n; ++i)
        sheared += events[i].mode == BRC_BREAK_SHEAR;
    *left = fabs(force[1]) / peak;
    *shear = n > 0 ? (double)sheared / (double)n : 0;
    *closure = l.closure;
    close_case(&c);
    return peak;
}

/* s1 = ((1 + sin) / (1 - sin)) s3 + 2 c cos / (1 - sin): 3 s3 + 3.464 c. The stress is even until the first face
 * slides, so the peak is that of the criterion but for what the load overshoots while faces soften: 2 %. */
static void a_block_fails_by_mohr_coulomb(void **state)
{
    (void)state;
    const double side[] = {0, 1e-3};
    for (int k = 0; k < 2; ++k) {
        double left, shear, closure;
        const double reference = 3 * side[k] + 2e-3 * sqrt(3),
                     peak = crush(k ? "1e-3 Pa" : "0 Pa", &left, &shear, &closure);
        print_message("pressed at its sides by %g Pa: peak %.4f of Mohr-Coulomb, %.2f of it left, %.0f %% of the "
                      "breaks by shear; closure %.1e\n",
                      side[k], peak / reference, left, 100 * shear, closure);
        assert_true(fabs(peak / reference - 1) < 0.02);
        assert_true(left < (k ? 0.8 : 0.6));
        assert_true(shear > 0.5);
        assert_true(fabs(closure) < 0.01);
    }
}

/* ---- energy and momentum ---- */

#define CRUSHED STONE("stone", "tension: 3e-4 Pa, fracture_energy: 1e-7 J/m^2, shear_fracture_energy: 3e-7 J/m^2")

/* Cells pressed together at speed, of the energy that moves: a tenth of the bounds of softening
 * (test_cell_softening.c); and momentum to rounding. */
static void the_ledger_closes_while_faces_slide(void **state)
{
    (void)state;
    const double bound[] = {0.005, 0.001};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        double before[6], after[6], size = 0;
        open_case(&c, (case_options){.stages = k ? CELLS_CRUSH(250, "0.35") : CELLS_CRUSH(110, "0.8"),
                                     .materials = CRUSHED,
                                     .sets = SLIDES("4e-4", "")});
        begin_first(&c);
        cell_momenta(&c, before);
        run_steps(&c, k ? 240 : 105);
        cell_momenta(&c, after);
        const brc_ledger l = ledger_now(&c);
        const brc_break *events;
        int64_t n, sheared = 0;
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
        for (int64_t i = 0; i < n; ++i)
            sheared += events[i].mode == BRC_BREAK_SHEAR;
        print_message("closure %.2e; %lld breaks, %lld by shear\n", l.closure, (long long)n, (long long)sheared);
        assert_true(sheared > 20);
        assert_true(fabs(l.closure) < bound[k]);
        for (int i = 0; i < 6; ++i)
            size = fmax(size, fabs(before[i]));
        for (int i = 0; i < 3; ++i)
            assert_true(fabs(after[i] - before[i]) < 1e-12 * size);
        close_case(&c);
    }
}

static void the_same_faces_slide_for_any_number_of_threads(void **state)
{
    (void)state;
    const case_options one = {.stages = CELLS_CRUSH(60, "0.8"),
                              .materials = CRUSHED,
                              .sets = SLIDES("4e-4", ""),
                              .n_threads = 1,
                              .exact = true};
    case_options two = one;
    two.n_threads = 2;
    cells_compare(one, two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_joint_slides_at_its_strength_and_costs_its_energy),
        cmocka_unit_test(a_block_fails_by_mohr_coulomb),
        cmocka_unit_test(the_ledger_closes_while_faces_slide),
        cmocka_unit_test(the_same_faces_slide_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
