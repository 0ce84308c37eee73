/* Elastic equilibrium and free vibration modes of small samples against exact answers. */
#include "../support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char pull[] =
    "  - name: pull\n    solver: {static: {increments: %d}}\n    loads:\n      - face_displacement: {set: x-, x: 0}\n"
    "      - face_displacement: {set: y-, y: 0}\n      - face_displacement: {set: z-, z: 0}\n      - "
    "face_displacement: {set: x+, x: %g m}\n";

static int32_t set_index(bench_case *c, const char *name)
{
    const int32_t index = brc_domain_find_set(c->domain, name);
    assert_true(index >= 0);
    return index;
}

/* E and nu of a pulled cube, from the reaction and the side faces, corrected for the finite strain
 * (docs/notebook/theory.md T1): with P the nominal stress and eps the nominal strain, Sigma = P/(1 + eps), Green
 * strains e = eps + eps^2/2. */
static void young_and_poisson(bench_case *c, double *young, double *poisson)
{
    double force[3], mean = 0, area = 0;
    const brc_domain *d = c->domain;
    assert_done(c, brc_simulation_run(c->simulation));
    assert_done(c, brc_simulation_reaction(c->simulation, set_index(c, "x+"), force));
    const brc_set *side = d->sets + set_index(c, "y+");
    double *u = calloc((size_t)(3 * side->n_members), sizeof *u);
    assert_done(c, brc_simulation_face_displacement(c->simulation, side->n_members, side->members, u));
    for (int64_t m = 0; m < side->n_members; ++m) {
        const double s = d->free_area_vector[3 * (int64_t)side->members[m] + 1];
        mean += s * u[3 * m + 1];
        area += s;
    }
    free(u);
    const double eps = c->scene->stages[0].loads[3].value[0], lateral = mean / area;
    const double strain = eps + eps * eps / 2, squeeze = lateral + lateral * lateral / 2;
    *young = force[0] / (1 + eps) / strain;
    *poisson = -squeeze / strain;
}

static void tension_gives_back_young_and_poisson(void **state)
{
    (void)state;
    const struct {
        const char *nu;
        double value;
    } cases[] = {{"0.49", 0.49}, {"0.3", 0.3}, {"0", 0}, {"-0.5", -0.5}, {"-0.95", -0.95}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char stages[700], material[96];
        bench_case c;
        double young, poisson;
        snprintf(stages, sizeof stages, pull, 1, 1e-7);
        snprintf(material, sizeof material, "  stone: {E: 1 Pa, nu: %s, density: 1 kg/m^3}", cases[k].nu);
        open_case(&c, (case_options){.materials = material, .stages = stages});
        young_and_poisson(&c, &young, &poisson);
        /* exact but for the solver's 1e-10 and the conditioning of nearly incompressible or auxetic solids */
        if (!(fabs(young - 1) < 1e-7 && fabs(poisson - cases[k].value) < 1e-7))
            fail_msg("nu %s: E - 1 = %g, nu off by %g", cases[k].nu, young - 1, poisson - cases[k].value);
        close_case(&c);
    }
}

static void large_tension_is_st_venant_kirchhoff(void **state)
{
    (void)state;
    char stages[700];
    bench_case c;
    double young, poisson;
    snprintf(stages, sizeof stages, pull, 4, 0.15);
    open_case(&c, (case_options){.stages = stages});
    young_and_poisson(&c, &young, &poisson);
    /* uniform finite strain is exact too: force over area is (1 + eps) E (eps + eps^2/2) */
    if (!(fabs(young - 1) < 1e-7 && fabs(poisson - 0.2) < 1e-7)) fail_msg("E %g nu %g", young, poisson);
    close_case(&c);
}

static void uniform_traction_gives_uniform_strain(void **state)
{
    (void)state;
    bench_case c; /* tension by pressure on both ends, on rollers; ledger: work of dead loads is twice the energy */
    open_case(
        &c, (case_options){
                .stages =
                    "  - name: push\n    solver: {static: {increments: 2}}\n    loads:\n"
                    "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: y-, y: 0}\n"
                    "      - face_displacement: {set: z-, z: 0}\n      - traction: {set: x+, x: 1 uPa, y: 0, z: 0}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    double *strain = calloc((size_t)(6 * c.domain->n_elements), sizeof *strain);
    assert_done(&c, brc_simulation_strain_stress(c.simulation, strain, NULL, NULL));
    for (int64_t e = 0; e < c.domain->n_elements; ++e) {
        assert_true(fabs(strain[6 * e] / 1e-6 - 1) < 3e-6); /* the law's own 1.5 eps, and the solver's 1e-10 */
        assert_true(fabs(strain[6 * e + 1] / 1e-6 + 0.2) < 3e-6);
        assert_true(fabs(strain[6 * e + 5] / 1e-6) < 3e-6);
    }
    brc_ledger ledger;
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(fabs(ledger.closure) < 1e-6);
    free(strain);
    close_case(&c);
}

/* Two layers of `across` cells each, in series, nu/E equal on both sides: uniform stress 1 uPa, strains 1 and 1/4
 * uPa/Pa. Relative errors of the layers' mean strains over the jump of strain (3/4), and of the strain in the cells
 * farthest from the interface over its own. */
static void laminate(int across, double mean_error[2], double *far_error)
{
    bench_case c;
    char fill[64];
    snprintf(fill, sizeof fill, "cells: [%d, 4, 4], spread: 0 %%, seed: 1", 2 * across);
    open_case(
        &c, (case_options){
                .materials =
                    "  stone: {E: 1 Pa, nu: 0.1, density: 1 kg/m^3}\n  steel: {E: 4 Pa, nu: 0.4, density: 1 kg/m^3}",
                .regions = "    regions:\n      - {material: steel, where: {half_space: {point: [50 cm, 0, 0], normal: "
                           "[1, 0, 0]}}}\n",
                .fill = fill,
                .stages =
                    "  - name: push\n    solver: {static: {increments: 1}}\n    loads:\n"
                    "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: y-, y: 0}\n"
                    "      - face_displacement: {set: z-, z: 0}\n      - traction: {set: x+, x: 1 uPa, y: 0, z: 0}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    const int64_t n = c.domain->n_elements;
    double *strain = calloc((size_t)(6 * n), sizeof *strain), force[3];
    assert_done(&c, brc_simulation_strain_stress(c.simulation, strain, NULL, NULL));
    const double exact[2] = {1e-6, 0.25e-6};
    double mean[2] = {0, 0};
    *far_error = 0;
    for (int64_t e = 0; e < n; ++e) {
        const double x = c.domain->position[3 * e];
        const int right = x > 0.5;
        mean[right] += strain[6 * e] / (double)(n / 2);
        if (fabs(x - 0.5) > 0.5 - 0.6 / (2 * across))
            *far_error = fmax(*far_error, fabs(strain[6 * e] / exact[right] - 1));
    }
    for (int k = 0; k < 2; ++k)
        mean_error[k] = fabs(mean[k] - exact[k]) / 0.75e-6;
    assert_done(&c, brc_simulation_reaction(c.simulation, set_index(&c, "x-"), force));
    assert_true(fabs(force[0] / -1e-6 - 1) < 1e-6); /* equilibrium */
    free(strain);
    close_case(&c);
}

static void two_materials_in_series_carry_one_stress(void **state)
{
    (void)state;
    double coarse[2], fine[2], far[2];
    laminate(4, coarse, far);
    laminate(8, fine, far + 1);
    for (int k = 0; k < 2; ++k) {
        /* cells at the interface share gradients with the other side and are off by less than the jump, those behind
         * them by what decays from cell to cell: together less than one cell of the layer off by the whole jump, 1/n of
         * it */
        if (!(coarse[k] < 1.0 / 4 && fine[k] < 1.0 / 8)) fail_msg("side %d: %g, %g of the jump", k, coarse[k], fine[k]);
        /* what is off has a fixed width in cells, so the mean is off by c/n: half with twice the cells, within the
         * decayed tail that four cells cut off (a tenth of a power of two) */
        if (!(fine[k] < pow(0.5, 0.9) * coarse[k])) fail_msg("side %d: %g, then %g", k, coarse[k], fine[k]);
    }
    /* and what decays from cell to cell decays faster than the mean's c/n */
    if (!(far[1] < 0.5 * far[0])) fail_msg("far cells %g, then %g", far[0], far[1]);
}

/* Norm of the forces on components that nothing holds [N], and the sum of their x components; prescribed elements are
 * held in x. */
static double free_residual(bench_case *c, const bool *prescribed, double *sum)
{
    const int64_t n = c->domain->n_elements;
    double *f = calloc((size_t)(3 * n), sizeof *f), squares = 0;
    *sum = 0;
    assert_done(c, brc_simulation_force(c->simulation, f));
    for (int64_t i = 0; i < 3 * n; ++i) {
        if (prescribed[i / 3] && i % 3 == 0) continue;
        squares += f[i] * f[i];
        if (i % 3 == 0) *sum += f[i];
    }
    free(f);
    return sqrt(squares);
}

static void published_tension_is_near_the_given_values(void **state)
{
    (void)state;
    bench_case c;
    open_case(
        &c, (case_options){
                .model = "dlsm-published",
                .fill = "cells: [8, 8, 8], spread: 90 %, lloyd: 3, seed: 1",
                .sets = "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\n",
                .stages =
                    "  - name: pull\n    solver: static\n    loads:\n      - element_displacement: {set: left, x: 0}\n"
                    "      - element_displacement: {set: right, x: 1 um}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    double force[3], back[3];
    const int32_t right = set_index(&c, "right"), left = set_index(&c, "left");
    assert_done(&c, brc_simulation_reaction(c.simulation, right, force));
    assert_done(&c, brc_simulation_reaction(c.simulation, left, back));
    const int64_t n = c.domain->n_elements;
    bool *prescribed = calloc((size_t)n, sizeof *prescribed);
    double *u = calloc((size_t)(3 * n), sizeof *u), left_over, first_left_over;
    for (int k = 0; k < 2; ++k)
        for (int64_t m = 0; m < c.domain->sets[k ? left : right].n_members; ++m) {
            const int32_t e = c.domain->sets[k ? left : right].members[m];
            prescribed[e] = true;
            u[3 * e] = k ? 0 : 1e-6;
        }
    const double residual = free_residual(&c, prescribed, &left_over);
    /* bond forces are opposite, so the reactions differ by exactly what is left on the free elements */
    if (!(fabs(force[0] + back[0] - left_over) < 1e-12 * force[0]))
        fail_msg("reactions %g, %g, left over %g", force[0], back[0], left_over);
    /* which is the solver's tolerance (docs/notebook/theory.md T3): 1e-5 of what the load left unbalanced before
     * anything moved */
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
    const double first = free_residual(&c, prescribed, &first_left_over);
    if (!(residual < 1e-5 * first)) fail_msg("residual %g of the load", residual / first);
    free(u);
    free(prescribed);
    /* stress over prescribed elongation 1e-6: half a cell at each end is rigid, 1/(1 - 1/8) = 1.14, within some percent
     */
    const double apparent = force[0] / 1e-6;
    if (!(apparent > 1.05 && apparent < 1.25)) fail_msg("apparent E %g", apparent);
    close_case(&c);
}

/* Mean displacement of the wall x+ of a bar of 20:1, three cells across, clamped at x-; status: of the run. */
static brc_status bend_bar(int increments, brc_precision precision, double along, double across, double tip[3],
                           char *message, size_t room)
{
    char stages[400];
    bench_case c;
    snprintf(
        stages, sizeof stages,
        "  - name: bend\n    solver: {static: {increments: %d}}\n    loads:\n"
        "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - traction: {set: x+, x: %.17g Pa, z: %.17g "
        "Pa}\n",
        increments, along, across);
    open_case(&c, (case_options){.shape = "{box: {size: [20 m, 1 m, 1 m]}}",
                                 .fill = "cells: [60, 3, 3], spread: 50 %, lloyd: 5, seed: 1",
                                 .precision = precision,
                                 .stages = stages});
    const brc_status status = brc_simulation_run(c.simulation);
    snprintf(message, room, "%s", brc_context_message(c.context));
    const brc_set *end = c.domain->sets + set_index(&c, "x+");
    double *u = calloc((size_t)(3 * end->n_members), sizeof *u), area = 0;
    assert_done(&c, brc_simulation_face_displacement(c.simulation, end->n_members, end->members, u));
    tip[0] = tip[1] = tip[2] = 0;
    for (int64_t m = 0; m < end->n_members; ++m) {
        const double s = c.domain->free_area_vector[3 * (int64_t)end->members[m]];
        area += s;
        for (int k = 0; k < 3; ++k)
            tip[k] += s * u[3 * m + k];
    }
    for (int k = 0; k < 3; ++k)
        tip[k] /= area;
    free(u);
    close_case(&c);
    return status;
}

/* Slender bars pressed and turned far, against the elastica of the bending stiffness that the bar has under a small
 * load. What it leaves out: shear (P / kAG is 0.1 % of Euler's load here, so 0.6 % of the deflection at 0.83 of it),
 * the clamp that holds the width too, and the bar's own strain. */
static void slender_bars_bend_as_the_elastica(void **state)
{
    (void)state;
    enum { LENGTH = 20 };
    const double force = 1e-9, euler = M_PI * M_PI / 12 / (4 * LENGTH * LENGTH);
    const struct {
        int increments;
        brc_precision precision;
        double along, across; /* over Euler's load and over E I / length^2 */
        double most;
    } cases[] = {{4, BRC_DOUBLE, -0.8, 1e-3, 0.02},
                 {1, BRC_DOUBLE, -0.8, 1e-3, 0.02},
                 {4, BRC_MIXED, -0.8, 1e-3, 0.02},
                 {4, BRC_DOUBLE, 0, 2, 0.01},
                 {1, BRC_DOUBLE, 0, 4, 0.01}};
    char said[400];
    double small[3], tip[3], exact[2];
    assert_int_equal(bend_bar(1, BRC_DOUBLE, 0, force, small, said, sizeof said), BRC_OK);
    const double stiffness = force * pow(LENGTH, 3) / (3 * small[2]);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double along = cases[k].along * euler, across = cases[k].across / 12 / (LENGTH * LENGTH);
        if (bend_bar(cases[k].increments, cases[k].precision, along, across, tip, said, sizeof said) != BRC_OK)
            fail_msg("case %zu: %s", k, said);
        elastica_tip(stiffness, LENGTH, along, across, exact);
        if (!(fabs(tip[2] / exact[1] - 1) < cases[k].most))
            fail_msg("case %zu: %g across, elastica %g (%+.4f)", k, tip[2], exact[1], tip[2] / exact[1] - 1);
    }
}

/* Torque of a bar of 10:1 that is clamped at both ends, one of them turned. */
static double torque_of(int increments, double angle)
{
    char stages[600];
    const double axis[3] = {0, 0.5, 0.5};
    double moment[3];
    bench_case c;
    snprintf(
        stages, sizeof stages,
        "  - name: twist\n    solver: {static: {increments: %d}}\n    loads:\n"
        "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - face_displacement: {set: x+, gradient: {y: "
        "[0, %.17g, %.17g], z: [0, %.17g, %.17g]}, origin: [0, 0.5 m, 0.5 m]}\n",
        increments, cos(angle) - 1, -sin(angle), sin(angle), cos(angle) - 1);
    open_case(&c, (case_options){.shape = "{box: {size: [10 m, 1 m, 1 m]}}",
                                 .fill = "cells: [40, 4, 4], spread: 50 %, lloyd: 5, seed: 1",
                                 .stages = stages});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_reaction_moment(c.simulation, set_index(&c, "x+"), axis, moment));
    close_case(&c);
    return moment[0];
}

/* By 60 degrees at once, which wants the way gone in parts, and by increments. The torque is that of a small twist
 * times the angle but for the square of the largest shear, angle / 20, 0.3 %, times a number of order one. */
static void a_bar_is_twisted_far_in_parts(void **state)
{
    (void)state;
    const double angle = M_PI / 3, small = torque_of(1, 1e-4) / 1e-4;
    const double at_once = torque_of(1, angle), slowly = torque_of(8, angle);
    if (!(fabs(at_once / slowly - 1) < 1e-7)) fail_msg("at once %.12g, slowly %.12g", at_once, slowly);
    if (!(fabs(at_once / (small * angle) - 1) < 0.01)) fail_msg("%g of the small one", at_once / (small * angle));
}

/* Under a nominal stress a cube of St. Venant and Kirchhoff's solid is (1 + eps) E (eps + eps^2 / 2) to its strain: it
 * bears no push beyond E / sqrt(27), 0.19245, where eps is 1 / sqrt(3) - 1. */
static void what_gives_way_is_refused(void **state)
{
    (void)state;
    static const char press[] =
        "  - name: press\n    solver: static\n    loads:\n      - face_displacement: {set: x-, x: 0}\n"
        "      - face_displacement: {set: y-, y: 0}\n      - face_displacement: {set: z-, z: 0}\n"
        "      - traction: {set: x+, x: -%g Pa}\n";
    const double pushes[2] = {0.15, 0.3};
    for (int k = 0; k < 2; ++k) {
        char stages[500];
        bench_case c;
        double mean = 0, area = 0;
        snprintf(stages, sizeof stages, press, pushes[k]);
        open_case(&c, (case_options){.fill = "cells: [4, 4, 4], spread: 50 %, seed: 1", .stages = stages});
        const brc_status status = brc_simulation_run(c.simulation);
        const char *said = brc_context_message(c.context);
        if (k == 1 && (status != BRC_PHYSICS_STOPPED || !strstr(said, "the body gives way there")))
            fail_msg("a push beyond the largest: %d, %s", (int)status, said);
        if (k == 0 && status != BRC_OK) fail_msg("a push below the largest: %s", said);
        const brc_set *end = c.domain->sets + set_index(&c, "x+");
        double *u = calloc((size_t)(3 * end->n_members), sizeof *u);
        assert_done(&c, brc_simulation_face_displacement(c.simulation, end->n_members, end->members, u));
        for (int64_t m = 0; m < end->n_members; ++m) {
            const double s = c.domain->free_area_vector[3 * (int64_t)end->members[m]];
            mean += s * u[3 * m], area += s;
        }
        free(u);
        const double eps = mean / area, stress = (1 + eps) * (eps + eps * eps / 2);
        if (k == 0 && !(fabs(stress / -pushes[0] - 1) < 1e-8)) fail_msg("strain %g: stress %.12g", eps, stress);
        close_case(&c);
    }
}

static void loads_that_do_not_balance_are_refused(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [3, 3, 3], spread: 50 %, seed: 1",
                                 .stages = "  - name: push\n    solver: {static: {increments: 1}}\n    loads:\n"
                                           "      - traction: {set: x+, x: 1 uPa, y: 0, z: 0}\n"});
    assert_int_equal(brc_simulation_run(c.simulation), BRC_PHYSICS_STOPPED);
    assert_non_null(strstr(brc_context_message(c.context),
                           "check that the loads balance or the supports hold every motion of the body"));
    close_case(&c);
}

static void overlapping_components_are_refused(void **state)
{
    (void)state;
    bench_case c; /* the overlap is in the sets' members, which only the solver knows */
    open_case(&c, (case_options){
                      .sets = "sets:\n  corner: {faces: {box: {from: [-1 m, -1 m, -1 m], to: [2 m, 0.2 m, 2 m]}}}\n",
                      .stages = "  - name: push\n    solver: {static: {increments: 1}}\n    loads:\n"
                                "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - face_displacement: "
                                "{set: corner, y: 1 mm}\n"});
    assert_int_equal(brc_simulation_begin_stage(c.simulation, 0), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "give each component of a face to one load"));
    close_case(&c);
}

static void cube_modes_are_near_the_exact_ones(void **state)
{
    (void)state;
    /* rad/s for E = rho = L = 1, nu 0.2 (docs/notebook/theory.md T7); 512 relaxed cells: 0.2 to 1.1 % were measured by
     * the prototype at 1000 and 216 cells, 1.5 % is the bound for every single mode here */
    const double exact[8] = {1.8433, 1.8433, 2.4637, 2.4637, 2.4637, 2.5192, 2.5192, 2.5192};
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [8, 8, 8], spread: 90 %, lloyd: 5, seed: 1",
                                 .stages = "  - name: ring\n    solver: {modes: {count: 8}}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    int32_t n;
    const double *modes = brc_simulation_modes(c.simulation, &n);
    assert_int_equal(n, 8);
    for (int k = 0; k < 8; ++k)
        if (!(fabs(modes[k] / exact[k] - 1) < 0.015)) fail_msg("mode %d: %g, exact %g", k, modes[k], exact[k]);
    close_case(&c);
}

/* Rigid motions are exact from the start, and what rounding leaves of them must not grow in the search space, whatever
 * the draw: of twenty-four cubes some used to find no mode at all. 64 cells as they come: those above are twice as
 * fine, relaxed, and held to 1.5 %; second order makes 6 % of that, no relaxation some more. */
static void modes_of_small_cubes_are_found_whatever_the_draw(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 24; ++seed) {
        char fill[64];
        bench_case c;
        snprintf(fill, sizeof fill, "cells: [4, 4, 4], spread: 50 %%, seed: %d", seed);
        open_case(&c, (case_options){.fill = fill, .stages = "  - name: ring\n    solver: {modes: {count: 4}}\n"});
        assert_done(&c, brc_simulation_run(c.simulation));
        int32_t n;
        const double *modes = brc_simulation_modes(c.simulation, &n);
        assert_int_equal(n, 4);
        if (!(fabs(modes[0] / 1.8433 - 1) < 0.15)) fail_msg("seed %d: lowest mode %g, exact 1.8433", seed, modes[0]);
        close_case(&c);
    }
}

static void published_modes_lock_near_incompressibility(void **state)
{
    (void)state;
    const double exact[8] = {1.6549, 1.6549, 2.2517, 2.2517, 2.2517, 2.2724, 2.2724, 2.2724};
    const struct {
        const char *model, *fill;
    } cases[3] = {{"dlsm", "cells: [6, 6, 6], spread: 90 %, lloyd: 5, seed: 1"},
                  {"dlsm", "cells: [8, 8, 8], spread: 90 %, lloyd: 5, seed: 1"},
                  {"dlsm-published", "cells: [6, 6, 6], spread: 90 %, lloyd: 5, seed: 1"}};
    double rms[3], mean[3];
    for (int k = 0; k < 3; ++k) {
        bench_case c;
        open_case(&c, (case_options){.model = cases[k].model,
                                     .materials = "  stone: {E: 1 Pa, nu: 0.49, density: 1 kg/m^3}",
                                     .fill = cases[k].fill,
                                     .stages = "  - name: ring\n    solver: {modes: {count: 8}}\n"});
        assert_done(&c, brc_simulation_run(c.simulation));
        int32_t n;
        const double *modes = brc_simulation_modes(c.simulation, &n);
        rms[k] = mean[k] = 0;
        for (int i = 0; i < 8; ++i) {
            rms[k] += pow(modes[i] / exact[i] - 1, 2) / 8;
            mean[k] += (modes[i] / exact[i] - 1) / 8;
        }
        rms[k] = sqrt(rms[k]);
        close_case(&c);
    }
    /* the conservative law converges with order 1.7 or better (the bound of cube-vibration) */
    if (!(rms[1] < rms[0] * pow(6.0 / 8, 1.7))) fail_msg("dlsm %g, refined %g", rms[0], rms[1]);
    /* the published law locks: too stiff, so modes are too high, and by more than half of its error is bias, while the
     * conservative one at equal cells is less than half as wrong */
    if (!(mean[2] > 0.5 * rms[2] && rms[2] > 2 * rms[0]))
        fail_msg("dlsm %g, published %g (mean %g)", rms[0], rms[2], mean[2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tension_gives_back_young_and_poisson),
        cmocka_unit_test(large_tension_is_st_venant_kirchhoff),
        cmocka_unit_test(uniform_traction_gives_uniform_strain),
        cmocka_unit_test(two_materials_in_series_carry_one_stress),
        cmocka_unit_test(published_tension_is_near_the_given_values),
        cmocka_unit_test(slender_bars_bend_as_the_elastica),
        cmocka_unit_test(a_bar_is_twisted_far_in_parts),
        cmocka_unit_test(what_gives_way_is_refused),
        cmocka_unit_test(loads_that_do_not_balance_are_refused),
        cmocka_unit_test(overlapping_components_are_refused),
        cmocka_unit_test(cube_modes_are_near_the_exact_ones),
        cmocka_unit_test(modes_of_small_cubes_are_found_whatever_the_draw),
        cmocka_unit_test(published_modes_lock_near_incompressibility),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
