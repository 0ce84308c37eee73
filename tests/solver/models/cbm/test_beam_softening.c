/* Beams that soften with a fracture energy (host/solver/models/cbm/beam_softening.c, beam_softening.cl): what a
 * beam costs, force, energy and momentum. */
#include "../../../../host/base/memory.h"
#include "../../../../host/solver/effects/fracture/bond_area.h"
#include "beams_case.h"
#include "../../effects/fracture/fracture_case.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ELEMENT "{criterion: {virial-principal: {level: 0}}}"
#define NEIGHBOURS "{criterion: {virial-principal: {level: 1}}}"

/* ---- one beam ---- */

/* Two spheres joined by a beam of E S = 0.01 pi N that fly apart, so that nothing but the beam acts; strength: {...}
 * and beam: {... strength}. The body's box is far larger than the spheres, so areas are large: only their products with
 * strength and energy count. */
static void open_pair(bench_case *c, const char *strength, const char *velocity, const char *device,
                      brc_precision precision)
{
    static const double x[6] = {1, 1, 1, 2, 1, 1};
    char materials[512], stages[512];
    snprintf(materials, sizeof materials,
             "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.2, E: 1 Pa, strength: 1e-9 Pa}, "
             "strength: {%s}}",
             strength);
    snprintf(stages, sizeof stages,
             "fracture: " ELEMENT "\nstages:\n  - name: fly\n    solver: {dynamic: {steps: 100000, time_step: 2 ms}}\n "
             "   initial:\n      - velocity: {gradient: {%s}, origin: [1.5 m, 1 m, 1 m]}\n",
             velocity);
    open_beams(c, (beams_options){.n = 2,
                                  .position = x,
                                  .radius = 0.5,
                                  .coordination = 1,
                                  .materials = materials,
                                  .stages = stages,
                                  .device = device,
                                  .precision = precision});
}

static double area_of_pair(void)
{
    bench_case c;
    double area;
    open_pair(&c, "tension: 1 Pa", "x: [1e-2 1/s, 0, 0]", NULL, BRC_DOUBLE);
    assert_int_equal(c.domain->n_bonds, 1);
    assert_done(&c, brc_bond_areas_closed(c.context, c.domain, &area));
    close_case(&c);
    return area;
}

/* The beam opens at 3e-4 N, a hundredth of its length long, and its cohesion ends at an opening five times that, some
 * 2500 steps later, or longer: the trapezoidal rule leaves the square of that, and the opening begins and ends within a
 * step, some 1e-3 each of a force that is nearly even: 2e-3. In single the energy of a step is a difference of 1e-3 of
 * what it is taken from, 1e-7 / 1e-3 a step, as often up as down: 1e-2. */
static void a_beam_costs_its_fracture_energy(void **state)
{
    (void)state;
    const double area = area_of_pair();
    for (int k = 0; k < 4; ++k) {
        bench_case c;
        char strength[256];
        const brc_break *events;
        int64_t n;
        snprintf(strength, sizeof strength, "tension: %.17g Pa, fracture_energy: %.17g J/m^2, softening: %s",
                 3e-4 / area, 7.5e-6 / area, k % 2 ? "exponential" : "linear");
        open_pair(&c, strength, "x: [2e-2 1/s, 0, 0]", NULL, k < 2 ? BRC_DOUBLE : BRC_SINGLE);
        begin_first(&c);
        run_steps(&c, 9000);
        const brc_softening_report report = softening_now(&c);
        const brc_ledger ledger = ledger_now(&c);
        print_message("spent %.6f, fracture %.6f of G_c A; closure %.1e\n", report.spent / 7.5e-6,
                      ledger.fracture / 7.5e-6, ledger.closure);
        assert_true(report.n_opened == 1 && report.n_ended == 1 && report.unfinished == 0);
        assert_true(fabs(report.area / area - 1) < 1e-6);
        assert_true(fabs(report.spent / 7.5e-6 - 1) < (k < 2 ? 2e-3 : 1e-2));
        assert_true(fabs(ledger.fracture / report.spent - 1) < 1e-6);
        if (k < 2)
            assert_true(fabs(ledger.initial - ledger.kinetic - ledger.fracture) < 1e-3 * ledger.fracture &&
                        ledger.elastic == 0);
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
        assert_true(n == 1 && events[0].mode == BRC_BREAK_TENSION && fabs(events[0].energy / report.spent - 1) < 1e-6);
        close_case(&c);
    }
}

/* It is pulled to a part of its opening and swings back: what it took stays taken, it unloads to no force at no
 * stretch, and a push finds the whole axial stiffness. Positions by hand: no step comes between. */
static void a_beam_unloads_to_its_origin_and_bears_a_push_whole(void **state)
{
    (void)state;
    bench_case c;
    char strength[256];
    const double area = area_of_pair(), stiffness = 0.01 * M_PI;
    double u[6] = {0}, f[6], still[6] = {0};
    snprintf(strength, sizeof strength, "tension: %.17g Pa, fracture_energy: %.17g J/m^2", 3e-4 / area, 7.5e-6 / area);
    open_pair(&c, strength, "x: [2e-2 1/s, 0, 0]", NULL, BRC_DOUBLE);
    begin_first(&c);
    run_steps(&c, 1000);
    const brc_softening_report report = softening_now(&c);
    assert_true(report.n_opened == 1 && report.n_ended == 0 && report.unfinished > 1e-6);
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    /* on the law: F = start (1 - w / end) with w = stretch - F / k, start = 3e-4 N within the stretch of a step (4e-5
     * of 1e-2 m), end = 2 energy / start */
    const double stretch = u[3] - u[0], w = stretch - f[0] / stiffness, end = 0.05;
    print_message("stretch %.5f m, opening %.5f m, force %.3e N\n", stretch, w, f[0]);
    assert_true(w > 0.2 * end && w < 0.8 * end);
    assert_true(fabs(f[0] / (3e-4 * (1 - w / end)) - 1) < 1e-2);
    const double secant = f[0] / stretch;
    for (int k = 0; k <= 4; ++k) { /* k / 4 of the stretch */
        const double at[6] = {0, 0, 0, 0.25 * k * stretch, 0, 0};
        assert_done(&c, brc_simulation_set_state(c.simulation, at, still));
        assert_done(&c, brc_simulation_force(c.simulation, f));
        assert_true(fabs(f[0] - secant * at[3]) < 1e-12 && fabs(f[0] + f[3]) < 1e-18);
    }
    const double pushed[6] = {0, 0, 0, -0.01, 0, 0};
    assert_done(&c, brc_simulation_set_state(c.simulation, pushed, still));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    assert_true(fabs(f[0] / (-0.01 * stiffness) - 1) < 1e-12);
    assert_true(fabs(ledger_now(&c).elastic / (0.5 * stiffness * 1e-4) - 1) < 1e-12);
    close_case(&c);
}

/* Broken, and pressed together again by hand: the axial spring, 1e-12 for rounding; pulled apart, nothing. At once
 * broken by its element (no fracture energy) and at the end of its cohesion. */
static void a_broken_beam_bears_a_push(void **state)
{
    (void)state;
    const double area = area_of_pair(), stiffness = 0.01 * M_PI;
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char strength[256];
        int64_t broken;
        double f[6];
        const double still[6] = {0}, pushed[6] = {0, 0, 0, -0.01, 0, 0}, pulled_apart[6] = {0, 0, 0, 0.01, 0, 0};
        snprintf(strength, sizeof strength, k ? "tension: %.17g Pa, fracture_energy: %.17g J/m^2" : "tension: %.17g Pa",
                 3e-4 / area, 7e-7 / area * (k ? 3.0 : 1.0));
        open_pair(&c, strength, "x: [2e-2 1/s, 0, 0]", NULL, BRC_DOUBLE);
        begin_first(&c);
        for (int i = 0; i < 100; ++i) { /* until it breaks, before its ends stand clear at 0.05 of its length */
            assert_done(&c, brc_simulation_broken(c.simulation, &broken));
            if (broken) break;
            run_steps(&c, 10);
        }
        assert_int_equal(broken, 1);
        assert_done(&c, brc_simulation_set_state(c.simulation, pushed, still));
        assert_done(&c, brc_simulation_force(c.simulation, f));
        assert_true(fabs(f[0] / (-0.01 * stiffness) - 1) < 1e-12 && fabs(f[0] + f[3]) < 1e-18);
        assert_true(fabs(ledger_now(&c).elastic / (0.5 * stiffness * 1e-4) - 1) < 1e-12);
        assert_done(&c, brc_simulation_set_state(c.simulation, pulled_apart, still));
        assert_done(&c, brc_simulation_force(c.simulation, f));
        assert_true(f[0] == 0 && f[3] == 0);
        close_case(&c);
    }
}

/* Pulled across its axis as much as along: half of the area along the opening, cos 60 degrees, is the least; here 1 /
 * sqrt 2. Both spheres are held from turning by nothing, so the beam bends; its direction at the end says what it cost:
 * within the two percent that it turns by. */
static void a_beam_costs_by_its_projection_along_the_opening(void **state)
{
    (void)state;
    bench_case c;
    char strength[256];
    const double area = area_of_pair();
    snprintf(strength, sizeof strength, "tension: %.17g Pa, fracture_energy: %.17g J/m^2", 3e-4 / area, 7.5e-6 / area);
    open_pair(&c, strength, "x: [4e-2 1/s, 0, 0], y: [4e-2 1/s, 0, 0]", NULL, BRC_DOUBLE);
    begin_first(&c);
    run_steps(&c, 3000);
    const brc_softening_report report = softening_now(&c);
    const brc_ledger ledger = ledger_now(&c);
    print_message("spent %.4f of G_c A, projected %.4f of A; closure %.1e\n", report.spent / 7.5e-6, report.area / area,
                  ledger.closure);
    assert_int_equal(report.n_ended, 1);
    assert_true(report.area < 0.9 * area && report.area > 0.5 * area);
    assert_true(fabs(report.spent / 7.5e-6 / (report.area / area) - 1) < 0.1);
    close_case(&c);
}

/* ---- the law in a body ---- */

/* At fixed damage; five-point differences as in test_cell_softening.c, fourth order: 1e-9 for their rounding. A beam
 * that begins to push, or to pull along its crack, has a kink in its stiffness: where differences of half the width say
 * another slope, by more than the fourth order does, there is one between them, and that place is left out; the beams
 * are stretched or pushed by a fifth so that most places have none. sides: stretches along x, y and z. */
static void check_gradient(bench_case *c, const double sides[3])
{
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
    const brc_domain *d = c->domain;
    const int64_t n = 3 * d->n_elements;
    double *u = calloc((size_t)n, sizeof *u), *f = calloc((size_t)n, sizeof *f), worst = 0, largest = 0;
    int n_seen = 0, n_smooth = 0;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    for (int64_t k = 0; k < n; ++k)
        u[k] += 0.02 * random_at((uint64_t)k) * cbrt(d->volume[0]) + sides[k % 3] * d->position[k] +
                0.05 * d->position[k - k % 3 + (k + 1) % 3];
    assert_done(c, brc_simulation_set_state(c->simulation, u, NULL));
    assert_done(c, brc_simulation_force(c->simulation, f));
    for (int64_t k = 0; k < n; ++k)
        largest = fmax(largest, fabs(f[k]));
    for (int64_t k = 0; k < n; k += n / 40 + 1) {
        const double middle = u[k];
        double slope[2] = {0};
        for (int width = 0; width < 2; ++width) {
            const double h = (width ? 1e-3 : 2e-3) * cbrt(d->volume[0]);
            for (int i = 0; i < 4; ++i) {
                u[k] = middle + at[i] * h;
                assert_done(c, brc_simulation_set_state(c->simulation, u, NULL));
                slope[width] += weight[i] * ledger_now(c).elastic / h;
            }
        }
        u[k] = middle;
        n_seen += 1;
        if (fabs(slope[0] - slope[1]) > 1e-9 * largest) continue;
        n_smooth += 1;
        worst = fmax(worst, fabs(slope[0] + f[k]) / largest);
    }
    print_message("%d of %d places without a kink, %.1e\n", n_smooth, n_seen, worst);
    if (!(worst < 1e-9) || 2 * n_smooth < n_seen) fail_msg("%g, %d of %d", worst, n_smooth, n_seen);
    free(u), free(f);
}

static const double pulled[3] = {0.2, 0.2, 0.2}, pushed[3] = {-0.4, -0.4, -0.4},
                    /* from where the pull left it */ biaxial[3] = {0.4, -0.1, 0.3};

static void force_is_the_gradient_of_the_energy_whatever_is_open(void **state)
{
    (void)state;
    bench_case c;
    open_fracture(&c, (fracture_options){.stages = FRACTURE_BURST(400),
                                         .strength = "strength: {tension: 2e-4 Pa, fracture_energy: 4e-8 J/m^2}",
                                         .fracture = NEIGHBOURS});
    begin_first(&c);
    run_steps(&c, 60);
    const brc_softening_report report = softening_now(&c);
    print_message("%lld beams opened, %lld of them ended\n", (long long)report.n_opened, (long long)report.n_ended);
    assert_true(report.n_opened > 100 && report.unfinished > 0);
    check_gradient(&c, pulled);
    check_gradient(&c, pushed);
    check_gradient(&c, biaxial);
    close_case(&c);
    open_lattice(&c, 4,
                 (beams_options){.coordination = 6,
                                 .materials =
                                     "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.2, E: 1 Pa, "
                                     "strength: 1e-6 Pa}, strength: {tension: 1e-6 Pa, fracture_energy: 1e-6 J/m^2}}\n"
                                     "  steel: {E: 4 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.4, E: 4 Pa, "
                                     "strength: 4e-6 Pa}, strength: {tension: 4e-6 Pa, fracture_energy: 2e-6 J/m^2}}",
                                 .regions = "    regions:\n      - {material: steel, where: {half_space: {point: [2 m, "
                                            "0, 0], normal: [1, 0, 0]}}}\n",
                                 .stages = "fracture: " ELEMENT "\n" FRACTURE_BURST(4000)});
    begin_first(&c);
    run_steps(&c, 60);
    const brc_softening_report two = softening_now(&c);
    print_message("two materials: %lld beams opened, %lld of them ended\n", (long long)two.n_opened,
                  (long long)two.n_ended);
    assert_true(two.n_opened > 10 && two.n_opened > two.n_ended);
    check_gradient(&c, pulled);
    check_gradient(&c, pushed);
    check_gradient(&c, biaxial);
    close_case(&c);
}

/* The asked bounds, all along the fracture of a cube that a burst tears (1.15 % at 0.35 of the critical step where it
 * has 1.6 times the energy). */
static void the_ledger_closes_through_fracture_with_softening(void **state)
{
    (void)state;
    const char *safety[] = {"0.35", "0.8"};
    const double bound[] = {0.01, 0.05};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char stages[512];
        double worst = 0;
        snprintf(
            stages, sizeof stages,
            "stages:\n  - name: burst\n    solver: {dynamic: {duration: 1.26 s, time_step: {auto: {safety: %s}}}}\n"
            "    initial:\n      - velocity: {gradient: {x: [1.58e-3 1/s, 3.95e-4 1/s, 0]}}\n",
            safety[k]);
        open_fracture(&c, (fracture_options){.stages = stages,
                                             .strength = "strength: {tension: 2e-4 Pa, fracture_energy: 1e-8 J/m^2}",
                                             .fracture = NEIGHBOURS,
                                             .elements = 1000});
        begin_first(&c);
        const int64_t steps =
            brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value);
        for (int64_t i = 0; i < steps; i += 4) {
            run_steps(&c, steps - i < 4 ? steps - i : 4);
            const brc_ledger l = ledger_now(&c);
            if (l.fracture > 0) worst = fmax(worst, fabs((l.total - l.work + l.fracture - l.initial) / l.peak_elastic));
        }
        int64_t broken;
        assert_done(&c, brc_simulation_broken(c.simulation, &broken));
        const brc_softening_report report = softening_now(&c);
        print_message("%s of the critical step: %.2e of the peak elastic energy, %lld beams opened, %lld broken\n",
                      safety[k], worst, (long long)report.n_opened, (long long)broken);
        assert_true(report.n_opened > 300 && broken > 50);
        assert_true(worst < bound[k]);
        close_case(&c);
    }
}

/* D scales what both ends feel, moments too: as breaking in test_fracture.c. */
static void opening_keeps_momentum_and_angular_momentum(void **state)
{
    (void)state;
    bench_case c;
    double before[6], after[6], size = 0;
    open_fracture(&c, (fracture_options){.stages = FRACTURE_BURST(400),
                                         .strength = "strength: {tension: 2e-4 Pa, fracture_energy: 2e-8 J/m^2}",
                                         .fracture = NEIGHBOURS});
    begin_first(&c);
    fracture_momenta(&c, before);
    run_steps(&c, 200);
    fracture_momenta(&c, after);
    const brc_softening_report report = softening_now(&c);
    assert_true(report.n_opened > 300 && report.n_ended > 20);
    for (int k = 0; k < 6; ++k)
        size = fmax(size, fabs(before[k]));
    for (int k = 0; k < 6; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-12 * size);
    close_case(&c);
}

static void the_same_beams_open_for_any_number_of_threads_and_lanes(void **state)
{
    (void)state;
    static const char *const criteria[] = {ELEMENT, NEIGHBOURS, "{criterion: {virial-principal: {level: 2}}}"};
    for (int k = 0; k < 3; ++k) {
        const fracture_options one = {.stages = FRACTURE_BURST(400),
                                      .fracture = criteria[k],
                                      .n_threads = 1,
                                      .exact = true,
                                      .strength = "strength: {tension: 2e-4 Pa, fracture_energy: 1e-8 J/m^2, "
                                                  "softening: exponential, scatter: {weibull: {modulus: 10}}}"};
        fracture_options other = one;
        other.n_threads = 2;
        other.lanes = 8;
        fracture_compare(one, other);
    }
}

/* A fracture energy that nothing reaches: the same numbers, to the last bit, as without one. */
static void a_body_that_does_not_open_is_as_without_a_fracture_energy(void **state)
{
    (void)state;
    bench_case plain, with;
    open_fracture(&plain, (fracture_options){.stages = FRACTURE_BURST(100),
                                             .strength = "strength: {tension: 1 Pa}",
                                             .fracture = NEIGHBOURS});
    open_fracture(&with, (fracture_options){.stages = FRACTURE_BURST(100),
                                            .strength = "strength: {tension: 1 Pa, fracture_energy: 1 J/m^2}",
                                            .fracture = NEIGHBOURS});
    const int64_t n = 3 * plain.domain->n_elements;
    double *u = calloc((size_t)(2 * n), sizeof *u);
    begin_first(&plain), begin_first(&with);
    run_steps(&plain, 50), run_steps(&with, 50);
    assert_done(&plain, brc_simulation_displacement(plain.simulation, u));
    assert_done(&with, brc_simulation_displacement(with.simulation, u + n));
    assert_memory_equal(u, u + n, (size_t)n * sizeof *u);
    free(u);
    close_case(&plain), close_case(&with);
}

/* ---- refusals ---- */

static void what_cannot_soften_is_refused(void **state)
{
    (void)state;
    bench_case c;
    const char *strength = "strength: {tension: 1e-4 Pa, fracture_energy: 1e-6 J/m^2}";
    assert_int_equal(
        try_fracture(&c,
                     (fracture_options){
                         .fracture = NEIGHBOURS,
                         .strength = strength,
                         .stages = "stages:\n  - name: events\n    solver: {static: {events: {most: 5}}}\n    loads:\n"
                                   "      - element_displacement: {set: x-, x: 0 m}\n      - element_displacement: "
                                   "{set: x+, x: 1 mm}\n"}),
        BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "events: they break bonds at once"));
    close_case(&c);
    open_fracture(&c,
                  (fracture_options){.fracture = NEIGHBOURS,
                                     .strength = strength,
                                     .stages = FRACTURE_BURST(100) "  - name: rest\n    solver: static\n    loads:\n   "
                                                                   "   - element_displacement: {set: x-, x: 0 m}\n"});
    begin_first(&c);
    run_steps(&c, 100);
    assert_true(softening_now(&c).n_opened > 0);
    assert_int_equal(brc_simulation_begin_stage(c.simulation, 1), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "bonds have opened against their cohesion"));
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_beam_costs_its_fracture_energy),
        cmocka_unit_test(a_beam_unloads_to_its_origin_and_bears_a_push_whole),
        cmocka_unit_test(a_broken_beam_bears_a_push),
        cmocka_unit_test(a_beam_costs_by_its_projection_along_the_opening),
        cmocka_unit_test(force_is_the_gradient_of_the_energy_whatever_is_open),
        cmocka_unit_test(the_ledger_closes_through_fracture_with_softening),
        cmocka_unit_test(opening_keeps_momentum_and_angular_momentum),
        cmocka_unit_test(the_same_beams_open_for_any_number_of_threads_and_lanes),
        cmocka_unit_test(a_body_that_does_not_open_is_as_without_a_fracture_energy),
        cmocka_unit_test(what_cannot_soften_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
