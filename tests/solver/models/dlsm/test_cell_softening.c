/* Cells that soften with a fracture energy (host/solver/models/dlsm/cell_softening.c, softening.cl): what a
 * crack costs, force, energy and momentum. */
#include "../../effects/fracture/cells_case.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A slow pull along x with drag, from a uniform rate. */
#define PULL(duration, safety)                                                                                         \
    "  - name: pull\n    solver: {dynamic: {duration: " duration                                                       \
    " s, mass_damping: 0.5 1/s, time_step: {auto: {safety: " safety "}}}}\n"                                           \
    "    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - face_velocity: {set: x+, x: 1e-4 m/s}\n"        \
    "    initial:\n      - velocity: {gradient: {x: [1e-4 1/s, 0, 0]}}\n"

/* ---- what a crack costs ---- */

/* E G_c / sigma_f^2 is 1 m, six cells. The energy is G_c A with the work of the cohesion taken by the trapezoidal rule
 * over the openings of a step (at the end one step of a thousand reaches beyond) and with what the sweeps leave of
 * the balance of forces, first order in the step, which is a tenth of the critical one: a percent is asked
 * (docs/notebook/fracture.md). */
static void a_flat_crack_costs_its_fracture_energy(void **state)
{
    (void)state;
    const char *law[] = {"linear", "exponential"};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char materials[512];
        snprintf(materials, sizeof materials,
                 "  stone: {E: 1 Pa, nu: 0, density: 1 kg/m^3, strength: {tension: 1 Pa, fracture_energy: 1 J/m^2, "
                 "softening: %s}}\n"
                 "  twin: {E: 1 Pa, nu: 0, density: 1 kg/m^3, strength: {tension: 1 Pa, fracture_energy: 1 J/m^2, "
                 "softening: %s}}",
                 law[k], law[k]);
        open_case(&c, (case_options){.materials = materials,
                                     .regions = CELLS_TWIN_HALF,
                                     .sets = CELLS_WEAK_PLANE("1e-6"),
                                     .fill = "cells: [6, 3, 3], spread: 0 %, seed: 1",
                                     .stages = k ? PULL("90", "0.1") : PULL("60", "0.1")});
        begin_first(&c);
        run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
        const brc_softening_report report = softening_now(&c);
        const brc_ledger ledger = ledger_now(&c);
        print_message("%s: fracture %.6f, spent %.6f of G_c A; closure %.1e\n", law[k], ledger.fracture / 1e-6,
                      report.spent / 1e-6, ledger.closure);
        assert_int_equal(report.n_ended, 9);
        assert_true(fabs(report.area - 1) < 1e-9);
        assert_true(fabs(report.spent / 1e-6 - 1) < 0.01);
        assert_true(fabs(ledger.fracture / 1e-6 - 1) < 0.01);
        const brc_break *events;
        int64_t n;
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
        for (int64_t i = 0; i < n; ++i)
            assert_true(fabs(events[i].energy / (1e-6 * events[i].area) - 1) < 0.02);
        close_case(&c);
    }
}

/* A zig-zag crack costs by its projection: cells of a 90 % noisy grid along a weak plane. The asked ten percent. */
static void a_rough_crack_costs_its_fracture_energy_by_its_projection(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.materials = CELLS_TWINS("0.2"),
                                 .regions = CELLS_TWIN_HALF,
                                 .sets = CELLS_WEAK_PLANE("1e-6"),
                                 .fill = "cells: [6, 5, 5], spread: 90 %, seed: 2",
                                 .stages = PULL("60", "0.8")});
    begin_first(&c);
    run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
    const brc_softening_report report = softening_now(&c);
    double surface = 0;
    for (int64_t b = 0; b < c.domain->n_bonds; ++b) {
        const int64_t h = c.domain->bond_half_edge[b], i = c.domain->neighbour[c.domain->twin[h]],
                      j = c.domain->neighbour[h];
        const double *s = c.domain->area_vector + 3 * h;
        if ((c.domain->position[3 * i] > 0.5) != (c.domain->position[3 * j] > 0.5))
            surface += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    }
    const brc_ledger ledger = ledger_now(&c);
    print_message("surface %.3f, projected %.3f of the section; fracture %.3f of G_c A; closure %.1e\n", surface,
                  report.area, ledger.fracture / 1e-6, ledger.closure);
    assert_true(surface > 1.2);
    assert_true(fabs(ledger.fracture / 1e-6 - 1) < 0.1);
    close_case(&c);
}

/* As bonds without a fracture energy: 0.5 % of the strength at the last step before something opens. */
static void faces_open_within_half_a_percent_of_the_strength(void **state)
{
    (void)state;
    bench_case c;
    double force[3] = {0, 0, 0};
    open_case(&c,
              (case_options){
                  .materials = CELLS_SOFT("0.2", "tension: 1e-3 Pa, fracture_energy: 1e-6 J/m^2"),
                  .sets = CELLS_FRACTURE,
                  .stages = "  - name: pull\n    solver: {dynamic: {steps: 10000, time_step: {auto: {safety: 0.5}}}}\n"
                            "    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - face_velocity: {set: "
                            "x+, x: 5e-5 m/s}\n"
                            "    initial:\n      - velocity: {gradient: {x: [5e-5 1/s, 0, 0]}}\n"});
    begin_first(&c);
    const int32_t wall = brc_domain_find_set(c.domain, "x+");
    while (softening_now(&c).n_opened == 0) {
        assert_done(&c, brc_simulation_reaction(c.simulation, wall, force));
        run_steps(&c, 1);
        assert_true(brc_simulation_step(c.simulation) < 2000);
    }
    print_message("force over area %.5f of the strength\n", force[0] / 1e-3);
    assert_true(fabs(force[0] / 1e-3 - 1) < 0.005);
    close_case(&c);
}

/* ---- the law ---- */

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
    assert_done(c, brc_simulation_set_state(c->simulation, u, NULL));
    const brc_ledger ledger = ledger_now(c);
    return ledger.elastic + ledger.stabilisation;
}

/* At fixed openings; five-point differences as in test_cells_break.c: 1e-9 for their rounding. With one material and
 * with two. */
static void force_is_the_gradient_of_the_energy_whatever_is_open(void **state)
{
    (void)state;
    const char *materials[] = {
        CELLS_SOFT("0.2", "tension: 6e-4 Pa, fracture_energy: 2e-6 J/m^2"),
        CELLS_SOFT("0.2", "tension: 6e-4 Pa, fracture_energy: 2e-6 J/m^2") "\n  other: {E: 3 Pa, nu: -0.3, density: 1 "
                                                                           "kg/m^3, strength: {tension: 1e-3 Pa, "
                                                                           "fracture_energy: 1e-6 J/m^2}}"};
    for (int many = 0; many < 2; ++many) {
        bench_case c;
        open_case(&c, (case_options){.stages = CELLS_BURST(200),
                                     .materials = materials[many],
                                     .sets = CELLS_FRACTURE,
                                     .regions = many ? "    regions:\n      - {where: {box: {from: [-1 m, 0.5 m, -1 "
                                                       "m], to: [2 m, 2 m, 2 m]}}, material: other}\n"
                                                     : NULL,
                                     .fill = "cells: [5, 5, 5], spread: 90 %, seed: 3"});
        const brc_domain *d = c.domain;
        begin_first(&c);
        run_steps(&c, 60);
        const brc_softening_report report = softening_now(&c);
        print_message("%lld faces opened, %lld of them ended\n", (long long)report.n_opened, (long long)report.n_ended);
        assert_true(report.n_opened > 100 && report.unfinished > 0);
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
        if (!(worst < 1e-9)) fail_msg("%g", worst);
        free(u), free(f);
        close_case(&c);
    }
}

/* Openings of faces are jumps, not strains: a plane of open faces, the two sides moved apart by just their opening and
 * stretched alike, is as a body that is whole: no force on any cell three layers from the loaded ends. The openings of
 * the plane's faces agree to the rounding of a few hundred steps. */
static void an_open_plane_does_not_disturb_a_uniform_state(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.materials = CELLS_TWINS("0"),
                                 .regions = CELLS_TWIN_HALF,
                                 .sets = CELLS_WEAK_PLANE("1e-6"),
                                 .fill = "cells: [8, 3, 3], spread: 0 %, seed: 1",
                                 .stages = PULL("14", "0.5")});
    const brc_domain *d = c.domain;
    begin_first(&c);
    run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value));
    brc_softening_report report = softening_now(&c);
    assert_true(report.n_opened == 9 && report.n_ended == 0 && report.unfinished > 1e-8);
    double *u = calloc((size_t)(3 * d->n_elements), sizeof *u), *f = calloc((size_t)(3 * d->n_elements), sizeof *f);
    const double e = 1e-3;
    double opening = 1, least = 0; /* the one at which nothing pushes, by secants: forces are all but linear in it */
    for (int k = 0; k < 30; ++k) {
        double push[2];
        for (int side = 0; side < 2; ++side) {
            const double w = (k == 0 ? 1e-3 : least) * (1 + 0.01 * side) + 1e-7 * side;
            for (int64_t i = 0; i < d->n_elements; ++i)
                u[3 * i] = e * d->position[3 * i] + (d->position[3 * i] > 0.5 ? w : 0);
            assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
            assert_done(&c, brc_simulation_force(c.simulation, f));
            push[side] = 0;
            for (int64_t i = 0; i < d->n_elements; ++i)
                if (fabs(d->position[3 * i] - 0.4375) < 0.01) push[side] += f[3 * i];
            if (side) {
                const double w0 = k == 0 ? 1e-3 : least, slope = (push[1] - push[0]) / (0.01 * w0 + 1e-7);
                opening = w0 - push[0] / slope;
            }
        }
        if (fabs(opening - least) < 1e-16) break;
        least = opening;
    }
    assert_true(least > 1e-4);
    for (int64_t i = 0; i < d->n_elements; ++i)
        u[3 * i] = e * d->position[3 * i] + (d->position[3 * i] > 0.5 ? least : 0);
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    double worst = 0;
    for (int64_t i = 0; i < d->n_elements; ++i)
        if (d->position[3 * i] > 0.3 && d->position[3 * i] < 0.7)
            for (int k = 0; k < 3; ++k)
                worst = fmax(worst, fabs(f[3 * i + k]) * 9 / e); /* of E e S */
    print_message("opening %.4e m: largest force %.1e of E e S\n", least, worst);
    assert_true(worst < 1e-9);
    free(u), free(f);
    close_case(&c);
}

/* ---- energy and momentum ---- */

/* The asked bounds, through the fracture of a bar; and a quarter of the step leaves less than a quarter of the
 * error. */
static void the_ledger_closes_through_fracture_with_softening(void **state)
{
    (void)state;
    const char *safety[] = {"0.8", "0.35"};
    const double bound[] = {0.05, 0.01};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        char stages[512];
        double worst = 0, rubbed = 0;
        snprintf(
            stages, sizeof stages,
            "  - name: pull\n    solver: {dynamic: {duration: 20 s, time_step: {auto: {safety: %s}}}}\n"
            "    loads:\n      - face_displacement: {set: x-, x: 0 m}\n      - face_velocity: {set: x+, x: 3e-4 m/s}\n"
            "    initial:\n      - velocity: {gradient: {x: [1.5e-4 1/s, 0, 0]}}\n",
            safety[k]);
        open_case(&c,
                  (case_options){
                      .stages = stages,
                      .materials = CELLS_SOFT(
                          "0.2", "tension: 1e-3 Pa, fracture_energy: 3e-7 J/m^2, scatter: {weibull: {modulus: 30}}"),
                      .sets = CELLS_FRACTURE,
                      .shape = "{box: {size: [2 m, 1 m, 1 m]}}",
                      .fill = "cells: [10, 5, 5], spread: 90 %, seed: 1"});
        begin_first(&c);
        const int64_t steps =
            brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value);
        for (int64_t i = 0; i < steps; i += 8) {
            run_steps(&c, steps - i < 8 ? steps - i : 8);
            const brc_ledger l = ledger_now(&c);
            if (l.fracture > 0)
                worst = fmax(worst, fabs((l.total - l.work + l.fracture + l.friction - l.initial) / l.peak_elastic)),
                rubbed = fmax(rubbed, fabs(l.friction / l.peak_elastic));
        }
        int64_t broken;
        assert_done(&c, brc_simulation_broken(c.simulation, &broken));
        print_message(
            "%s of the critical step: %.2e of the peak elastic energy, friction %.2e of it, %lld bonds broken\n",
            safety[k], worst, rubbed, (long long)broken);
        assert_true(broken > 50);
        assert_true(worst < bound[k]);
        assert_true(rubbed < 0.2); /* what sides of rough cracks hold against sliding, and what sweeps leave of sides
                                      that fly apart: 0.08 at 0.8; 0.45 where these do not coast */
        close_case(&c);
    }
}

/* Sides of a crack that runs slowly between two cantilevers slide against what is carried along it, and only lose by
 * that. Faces whose push along the crack is below a tenth of what the cohesion held coast along the face too, and give
 * some of it back (0.5 to 1.4 % of what is released; 5 % are borne). Where all broken faces coasted so they gave back
 * five times what friction took; three sweeps by less than 0.7 of the stiffness let the body fly apart
 * (bench/results/2026-11-29-sweeps.md). */
static void slow_cracks_gain_no_energy_by_friction(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){
                      .stages = "  - name: pull\n    solver: {dynamic: {duration: 2800 s, mass_damping: 1e-3 1/s}}\n"
                                "    loads:\n      - face_velocity: {set: up, y: 2e-6 m/s}\n"
                                "      - face_velocity: {set: down, y: -2e-6 m/s}\n",
                      .materials = CELLS_TWINS("0.2"),
                      .regions = "    regions:\n      - {where: {half_space: {point: [0, 1 m, 0], normal: [0, 1, 0]}}, "
                                 "material: twin}\n    cracks:\n      - {name: slot, patch: {rectangle: {corner: [-1 "
                                 "m, 1 m, -1 m], edge: [4 m, 0, 0], other_edge: [0, 0, 4 m]}}}\n",
                      .sets = CELLS_FRACTURE
                      "interactions: {interfaces: [{materials: {first: stone, second: twin, tension: 1e-4 Pa, "
                      "fracture_energy: 1e-8 J/m^2}}]}\n"
                      "sets:\n  up: {faces: {wall: x-, box: {from: [-1 m, 1 m, -1 m], to: [1 m, 3 m, 1 m]}}}\n"
                      "  down: {faces: {wall: x-, box: {from: [-1 m, -1 m, -1 m], to: [1 m, 1 m, 1 m]}}}\n",
                      .shape = "{box: {size: [6 m, 2 m, 0.4 m]}}",
                      .fill = "cells: [30, 10, 2], spread: 90 %, seed: 3"});
    begin_first(&c);
    const int64_t steps = brc_simulation_planned_steps(c.simulation, 0, brc_simulation_time_step(c.simulation).value);
    double most = 0, gained = 0, released = 0;
    for (int64_t i = 0; i < steps; i += 50) {
        run_steps(&c, steps - i < 50 ? steps - i : 50);
        const brc_ledger l = ledger_now(&c);
        most = fmax(most, l.friction), gained = fmax(gained, most - l.friction), released = l.fracture;
    }
    int64_t broken;
    assert_done(&c, brc_simulation_broken(c.simulation, &broken));
    print_message("%lld bonds broken, friction up to %.2e of what is released, then less by %.2e\n", (long long)broken,
                  most / released, gained / released);
    assert_true(broken > 20);
    assert_true(released > 0 && gained < 0.05 * released);
    close_case(&c);
}

/* Rings two to three cells thick, whose cells at the round walls hang on by three or four faces, burst: a cell whose
 * faces are all open takes no energy from the sweeps, which leave (1 - x / 0.7)^4 of what its openings lack
 * (bench/results/2026-11-29-sweeps.md; three sweeps by 0.6 of stiffnesses without soft_together: 2 to 18 percent in
 * three of these). The ledger's own error at this step is 1e-4 of the energy: five times that. */
static void cells_that_hang_on_by_little_take_no_energy(void **state)
{
    (void)state;
    const int seed[] = {16, 28, 29, 36};
    for (int k = 0; k < 4; ++k) {
        bench_case c;
        char fill[64];
        snprintf(fill, sizeof fill, "spacing: 1 m, spread: 90 %%, seed: %d", seed[k]);
        open_case(&c, (case_options){
                          .materials = CELLS_SOFT("0.22", "tension: 7.14e-4 Pa, fracture_energy: 9.5e-6 J/m^2"),
                          .sets = CELLS_FRACTURE,
                          .shape = "{parts: [{role: add, name: ring, shape: {cylinder: {axis: z, length: 3 m, radius: "
                                   "15.3333 m}}}, {role: remove, name: hole, shape: {cylinder: {axis: z, length: 9 m, "
                                   "radius: 12.3333 m}}, pose: {translation: [0, 0, -3 m]}}]}",
                          .fill = fill,
                          .stages = "  - name: burst\n    solver: {dynamic: {steps: 300}}\n    initial:\n      - "
                                    "velocity: {gradient: {x: [8.5e-5 1/s, 0, 0], y: [0, 8.5e-5 1/s, 0]}}\n"});
        begin_first(&c);
        run_steps(&c, 300);
        const brc_ledger ledger = ledger_now(&c);
        const brc_softening_report report = softening_now(&c);
        print_message("filling %d: %lld faces open, closure %.1e\n", seed[k], (long long)report.n_opened,
                      ledger.closure);
        assert_true(report.n_opened > 1000);
        assert_true(fabs(ledger.closure) < 5e-4);
        close_case(&c);
    }
}

/* Momentum to rounding: what pulls one side pulls the other. */
static void opening_keeps_momentum(void **state)
{
    (void)state;
    bench_case c;
    double before[6], after[6], size = 0;
    open_case(&c, (case_options){.stages = CELLS_BURST(200),
                                 .materials = CELLS_SOFT("0.2", "tension: 3e-4 Pa, fracture_energy: 1e-7 J/m^2"),
                                 .sets = CELLS_FRACTURE});
    begin_first(&c);
    cell_momenta(&c, before);
    run_steps(&c, 150);
    cell_momenta(&c, after);
    assert_true(softening_now(&c).n_opened > 100);
    for (int k = 0; k < 6; ++k)
        size = fmax(size, fabs(before[k]));
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-12 * size);
    print_message("angular momentum moved by %.1e, %.1e, %.1e of it\n", (after[3] - before[3]) / size,
                  (after[4] - before[4]) / size, (after[5] - before[5]) / size);
    close_case(&c);
}

static void the_same_faces_open_for_any_number_of_threads(void **state)
{
    (void)state;
    const case_options one = {
        .stages = CELLS_BURST(60),
        .materials = CELLS_SOFT("0.2", "tension: 2e-4 Pa, fracture_energy: 2e-8 J/m^2, softening: exponential"),
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
    brc_status status = try_case(&c, o);
    if (status == BRC_OK) status = brc_simulation_begin_stage(c.simulation, 0);
    assert_int_equal(status, BRC_BAD_INPUT);
    if (!strstr(brc_context_message(c.context), sentence)) fail_msg("%s", brc_context_message(c.context));
    close_case(&c);
}

static void what_cannot_soften_is_refused(void **state)
{
    (void)state;
    const char *soft = CELLS_SOFT("0.2", "tension: 1e-3 Pa, fracture_energy: 1e-6 J/m^2");
    refused(
        (case_options){
            .sets = CELLS_FRACTURE,
            .materials = soft,
            .stages = "  - name: events\n    solver: {static: {events: {most: 5}}}\n    loads:\n"
                      "      - face_displacement: {set: x-, x: 0 m}\n      - face_displacement: {set: x+, x: 1 mm}\n"},
        "events: they break bonds at once");
    refused((case_options){.sets = CELLS_FRACTURE, .materials = soft, .model = "dlsm-published"},
            "(model dlsm-published) break at once");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_crack_costs_its_fracture_energy),
        cmocka_unit_test(a_rough_crack_costs_its_fracture_energy_by_its_projection),
        cmocka_unit_test(faces_open_within_half_a_percent_of_the_strength),
        cmocka_unit_test(force_is_the_gradient_of_the_energy_whatever_is_open),
        cmocka_unit_test(an_open_plane_does_not_disturb_a_uniform_state),
        cmocka_unit_test(the_ledger_closes_through_fracture_with_softening),
        cmocka_unit_test(slow_cracks_gain_no_energy_by_friction),
        cmocka_unit_test(cells_that_hang_on_by_little_take_no_energy),
        cmocka_unit_test(opening_keeps_momentum),
        cmocka_unit_test(the_same_faces_open_for_any_number_of_threads),
        cmocka_unit_test(what_cannot_soften_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
