/* Bonds of beams that break: which, when, what happens to force, energy and momentum; and nothing at all without
 * `fracture`. */
#include "fracture_case.h"
#include "../../../../host/base/log.h"
#include "../../../../host/base/memory.h"
#include "../../../../host/solver/laws/beam_law.h"
#include "../../../../host/solver/laws/strength_law.h"
#include "../../../../host/solver/effects/fracture/strengths.h"
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CRITERION(level) "{criterion: {virial-principal: {level: " #level "}}}"
/* That element by element, without beams that bridge a crack (test_beam_bridges). */
#define PAPER(level) "{closure: false, criterion: {virial-principal: {level: " #level "}}}"
static const char *const STRENGTH = "strength: {tension: 2e-4 Pa}";
static const char *const SCATTERED = "strength: {tension: 3e-4 Pa, scatter: {weibull: 4}}";
#define BURST(steps) FRACTURE_BURST(steps)

/* ---- nothing without it ---- */

static void without_fracture_there_is_neither_array_nor_pass(void **state)
{
    (void)state;
    bench_case plain, strong, with;
    open_fracture(&plain, (fracture_options){.stages = BURST(50)});
    open_fracture(&strong, (fracture_options){.stages = BURST(50), .strength = STRENGTH});
    open_fracture(&with, (fracture_options){.stages = BURST(50), .strength = STRENGTH, .fracture = CRITERION(1)});
    fracture_is_nothing_unless_asked(&plain, &strong, &with);
}

static void what_never_breaks_moves_as_without_fracture(void **state)
{
    (void)state;
    bench_case plain, with;
    open_fracture(&plain, (fracture_options){.stages = BURST(50)});
    open_fracture(&with, (fracture_options){
                             .stages = BURST(50), .strength = "strength: {tension: 1 GPa}", .fracture = CRITERION(1)});
    fracture_that_never_comes_moves_nothing(&plain, &with);
}

/* ---- which bonds ---- */

/* Stress of every element as the passes saw it (by id): at level 2 as they left it, else from the virials that they
 * left, over the bonds that were whole. */
static double *judged_stress(bench_case *c, int level, const uint8_t *whole)
{
    const brc_domain *d = c->domain;
    double *stress = calloc((size_t)(6 * d->n_elements), sizeof *stress),
           *record = calloc((size_t)(8 * d->n_elements), sizeof *record);
    assert_done(c, brc_fracture_judged(c->simulation, stress, record));
    for (int64_t e = 0; level < 2 && e < d->n_elements; ++e) {
        double sum[7];
        memcpy(sum, record + 8 * e, sizeof sum);
        for (int64_t h = d->row_start[e]; level > 0 && h < d->row_start[e + 1]; ++h)
            for (int k = 0; whole[h] && k < 7; ++k)
                sum[k] += record[8 * (int64_t)d->neighbour[h] + k];
        for (int k = 0; k < 6; ++k)
            stress[6 * e + k] = 1 / sum[6] * sum[k];
    }
    free(record);
    return stress;
}

/* The largest principal value by LAPACK, its axis. */
static double principal(const double s[6], double axis[3])
{
    double a[9] = {s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]}, value[3];
    assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', 3, a, 3, value), 0);
    for (int c = 0; c < 3; ++c)
        axis[c] = a[3 * c + 2];
    return value[2];
}

/* Bonds that the text of NAH19 section 2.2 breaks in this state: [n_bonds] flags. factor [n_bonds]: a bond of factor f,
 * |cos| c goes at f times (largest |cos|) / c times the limit, the first of the element's to go; NULL: all 1. */
static int64_t should_break(bench_case *c, const double *stress, const uint8_t *whole, const double *factor, bool *bond)
{
    const brc_domain *d = c->domain;
    double *u = calloc((size_t)(3 * d->n_elements), sizeof *u);
    int64_t n = 0;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    memset(bond, 0, (size_t)d->n_bonds * sizeof *bond);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double axis[3], best = -1, nearest = 0;
        int64_t chosen = -1;
        const double ratio = principal(stress + 6 * e, axis) / brc_simulation_element_strength(c->simulation, e);
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            double x[3], product = 0, square = 0;
            if (!whole[h]) continue;
            for (int k = 0; k < 3; ++k) {
                const int64_t j = d->neighbour[h];
                x[k] = d->position[3 * j + k] + u[3 * j + k] - d->position[3 * e + k] - u[3 * e + k];
                product += x[k] * axis[k];
                square += x[k] * x[k];
            }
            const double cosine = fabs(product) / sqrt(square), counts = cosine / (factor ? factor[d->bond[h]] : 1);
            if (cosine > nearest) nearest = cosine;
            if (counts > best) best = counts, chosen = d->bond[h];
        }
        if (chosen >= 0 && ratio * best >= nearest && !bond[chosen]) bond[chosen] = true, ++n;
    }
    free(u);
    return n;
}

/* Some elements that are soft and weak, in a body that is not: their mean over neighbours comes to their limit by what
 * these bear, who are far from their own (fracture_near). */
#define SPOT(x, y, z) "{material: soft, where: {sphere: {centre: [" #x " m, " #y " m, " #z " m], radius: 100 mm}}}"
static const char *const SPOTS = "[" SPOT(0.25, 0.25, 0.25) ", " SPOT(0.75, 0.25, 0.3) ", " SPOT(
    0.3, 0.75, 0.7) ", " SPOT(0.7, 0.7, 0.25) ", " SPOT(0.5, 0.5, 0.75) "]";
static const char *const SOFT = "soft: {E: 0.02 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.4, E: 0.16 Pa}, "
                                "strength: {tension: 6e-5 Pa}}";

/* At every level, with strengths that scatter at two, and with soft spots: stresses against the host's own averages
 * (sums in another order: 1e-12), and the bonds against the text of the paper. */
static void elements_at_their_limit_lose_the_bond_nearest_to_the_pull(void **state)
{
    (void)state;
    static const struct {
        int level;
        const char *criterion, *strength, *more, *regions;
    } kinds[] = {{0, PAPER(0), STRENGTH, NULL, NULL},  {1, PAPER(1), STRENGTH, NULL, NULL},
                 {2, PAPER(2), STRENGTH, NULL, NULL},  {1, PAPER(1), SCATTERED, NULL, NULL},
                 {2, PAPER(2), SCATTERED, NULL, NULL}, {1, PAPER(1), STRENGTH, SOFT, SPOTS}};
    for (int kind = 0; kind < 6; ++kind) {
        const int level = kinds[kind].level;
        bench_case c;
        brc_strengths strengths;
        open_fracture(&c, (fracture_options){.stages = BURST(400),
                                             .strength = kinds[kind].strength,
                                             .fracture = kinds[kind].criterion,
                                             .more = kinds[kind].more,
                                             .regions = kinds[kind].regions});
        assert_done(&c,
                    brc_strengths_create(c.context, c.scene, c.domain, c.simulation->material_of_element, &strengths));
        assert_true(c.simulation->wants.weighted == (kinds[kind].strength == SCATTERED));
        const brc_domain *d = c.domain;
        bool *bond = calloc((size_t)d->n_bonds, sizeof *bond);
        double *expected = calloc((size_t)(6 * d->n_elements), sizeof *expected);
        int64_t total = 0, steps_with_breaks = 0;
        begin_first(&c);
        for (int step = 0; step < 150; ++step) {
            uint8_t *whole = NULL;
            const brc_break *events;
            int64_t n_events, before = total;
            assert_done(&c, brc_fracture_whole(c.simulation, &whole));
            run_steps(&c, 1); /* ends with breaks, in the state that it leaves */
            double *stress = judged_stress(&c, level, whole);
            total += should_break(&c, stress, whole, strengths.factor, bond);
            assert_done(&c, brc_simulation_breaks(c.simulation, &n_events, &events));
            assert_int_equal(n_events, total);
            for (int64_t k = before; k < total; ++k) {
                assert_true(bond[events[k].bond]);
                assert_int_equal(events[k].step, step + 1);
                assert_int_equal(events[k].mode, BRC_BREAK_TENSION);
                const double strength = fmin(brc_simulation_element_strength(c.simulation, events[k].element_i),
                                             brc_simulation_element_strength(c.simulation, events[k].element_j)) *
                                        strengths.factor[events[k].bond];
                assert_true(events[k].stress >= strength && events[k].energy > 0);
            }
            steps_with_breaks += total > before;
            if (total == before && total > 0) { /* the state after the step is the one that was judged */
                assert_done(&c, brc_simulation_virial_stress(c.simulation, level, expected));
                double largest = 0;
                for (int64_t k = 0; k < 6 * d->n_elements; ++k)
                    largest = fmax(largest, fabs(expected[k]));
                for (int64_t k = 0; k < 6 * d->n_elements; ++k)
                    assert_true(fabs(stress[k] - expected[k]) < 1e-12 * largest);
            }
            free(stress);
            brc_memory_free(whole);
        }
        assert_true(steps_with_breaks > 5 && total > 20); /* it tested something */
        brc_strengths_free(&strengths);
        free(bond), free(expected);
        close_case(&c);
    }
}

/* Powers of two: the same digits all through. */
static void bonds_of_half_the_strength_break_as_those_of_half_the_limit(void **state)
{
    (void)state;
    fracture_compare(
        (fracture_options){.stages = BURST(400),
                           .strength = "strength: {tension: 4e-4 Pa, scatter: {table: [{below: 0, factor: 50 %}, "
                                       "{below: 1, factor: 50 %}]}}",
                           .fracture = CRITERION(1),
                           .exact = true},
        (fracture_options){.stages = BURST(400), .strength = STRENGTH, .fracture = CRITERION(1), .exact = true});
}

/* The first twentieth of all bonds to break, of grains whose boundaries bear a third: a fair draw of n bonds would hold
 * n p of them, and three in four with a chance below 1e-9 for p < 0.5 and n > 100. */
static void weak_grain_boundaries_break_first(void **state)
{
    (void)state;
    bench_case c;
    const brc_break *events;
    int64_t n = 0, on_boundary = 0, all = 0;
    open_fracture(
        &c, (fracture_options){.stages = "interactions:\n  interfaces:\n    - grains: {factor: 33 %}\n" BURST(400),
                               .strength = STRENGTH,
                               .fracture = CRITERION(1),
                               .elements = 2000,
                               .grains = "{number: 12, seed: 1}"});
    const brc_domain *d = c.domain;
    for (int64_t h = 0; h < d->n_half_edges; ++h)
        all += d->grain[d->neighbour[h]] != d->grain[d->neighbour[d->twin[h]]];
    assert_true(all > 0 && all < d->n_bonds); /* half-edges: less than half of the bonds */
    begin_first(&c);
    while (n < d->n_bonds / 20) {
        run_steps(&c, 1);
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    }
    for (int64_t k = 0; k < n; ++k)
        on_boundary += d->grain[events[k].element_i] != d->grain[events[k].element_j];
    printf("%lld of %lld broken bonds are of grain boundaries, %lld of %lld of all\n", (long long)on_boundary,
           (long long)n, (long long)all / 2, (long long)d->n_bonds);
    assert_true(n > 100 && (double)on_boundary > 0.75 * (double)n);
    close_case(&c);
}

/* ---- energy and momentum ---- */

/* Closure after `time` at a fraction of the critical step; *count: bonds broken. */
static double closure_at(double safety, double duration, int64_t *count)
{
    bench_case c;
    brc_ledger ledger;
    char stages[512];
    snprintf(stages, sizeof stages,
             "stages:\n  - name: burst\n    solver: {dynamic: {duration: %.17g s, time_step: {auto: {safety: %g}}}}\n"
             "    initial:\n      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n",
             duration, safety);
    open_fracture(
        &c, (fracture_options){.stages = stages, .strength = STRENGTH, .fracture = CRITERION(1), .elements = 1000});
    begin_first(&c);
    const brc_time_step step = brc_simulation_time_step(c.simulation);
    run_steps(&c, brc_simulation_planned_steps(c.simulation, 0, step.value));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(ledger.fracture > 0.02 * ledger.initial); /* what is tested is a part of the whole */
    *count = count_broken(&c);
    close_case(&c);
    return ledger.closure;
}

/* Asked: 5 % at 0.8 and 1 % at 0.35 of the critical step, second order. Different steps break different bonds at
 * different moments, so the order shows in the whole, not in the last digit: from 0.8 to 0.2 the error falls sixteen
 * times, and at least eight times is asked. */
static void the_ledger_closes_through_breaking_to_second_order(void **state)
{
    (void)state;
    int64_t n[3];
    const double coarse = closure_at(0.8, 1, &n[0]), middle = closure_at(0.35, 1, &n[1]),
                 fine = closure_at(0.2, 1, &n[2]);
    print_message("closure %.2e %.2e %.2e at 0.8, 0.35, 0.2 of the critical step; %lld %lld %lld bonds broken\n",
                  coarse, middle, fine, (long long)n[0], (long long)n[1], (long long)n[2]);
    assert_true(fabs(coarse) < 0.05 && fabs(middle) < 0.01);
    assert_true(fabs(fine) < fabs(coarse) / 8);
}

/* What a bond takes away it takes from both ends: sums of some ten thousand terms over a hundred steps stay within
 * 1e-12 of their size. */
static void breaking_keeps_momentum_and_angular_momentum(void **state)
{
    (void)state;
    bench_case c;
    double before[6], after[6], size = 0;
    open_fracture(&c, (fracture_options){.stages = BURST(400), .strength = STRENGTH, .fracture = CRITERION(1)});
    begin_first(&c);
    fracture_momenta(&c, before);
    run_steps(&c, 200);
    fracture_momenta(&c, after);
    assert_true(count_broken(&c) > 50);
    for (int k = 0; k < 6; ++k)
        size = fmax(size, fabs(before[k]));
    for (int k = 0; k < 6; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-12 * size);
    close_case(&c);
}

/* A body blown apart: the strength is far below what the burst asks for, so every bond breaks, every element is a
 * fragment and keeps its velocity from then on. */
static void elements_without_bonds_fly_freely(void **state)
{
    (void)state;
    bench_case c;
    brc_ledger ledger;
    open_fracture(&c, (fracture_options){.strength = STRENGTH,
                                         .beam = "{radius: 0.4, E: 8 Pa, strength: 1e-9 Pa}",
                                         .fracture = "{closure: false, criterion: {virial-principal: {level: 0}}}",
                                         .stages = BURST(100)});
    const int64_t n = c.domain->n_elements;
    int32_t *fragment = calloc((size_t)n, sizeof *fragment);
    double *v = calloc((size_t)(6 * n), sizeof *v), *damage = calloc((size_t)n, sizeof *damage);
    int64_t n_fragments;
    begin_first(&c);
    assert_done(&c, brc_simulation_fragments(c.simulation, fragment, &n_fragments));
    const int64_t at_start = n_fragments;
    assert_true(at_start < n / 10);
    run_steps(&c, 90);
    assert_done(&c, brc_simulation_fragments(c.simulation, fragment, &n_fragments));
    assert_int_equal(count_broken(&c), c.domain->n_bonds);
    assert_int_equal(n_fragments, n);
    for (int64_t e = 0; e < n; ++e)
        assert_int_equal(fragment[e], e);
    assert_done(&c, brc_simulation_damage(c.simulation, damage));
    for (int64_t e = 0; e < n; ++e)
        assert_true(damage[e] == (c.domain->row_start[e + 1] > c.domain->row_start[e] ? 1 : 0));
    assert_done(&c, brc_simulation_velocity(c.simulation, v));
    run_steps(&c, 10);
    assert_done(&c, brc_simulation_velocity(c.simulation, v + 3 * n));
    /* The force keeps the rounding of what was added and taken off again. */
    for (int64_t k = 0; k < 3 * n; ++k)
        assert_true(fabs(v[k] - v[k + 3 * n]) < 1e-12 * 2e-3);
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_true(ledger.elastic == 0 && fabs(ledger.closure) < 0.05);
    free(fragment), free(v), free(damage);
    close_case(&c);
}

/* ---- the same everywhere ---- */

static void the_same_bonds_break_for_any_number_of_threads_and_lanes(void **state)
{
    (void)state;
    static const char *const criteria[] = {CRITERION(1), CRITERION(2),
                                           "{criterion: {mohr-coulomb: {cohesion: 3e-4 Pa, friction: 30 deg}}}"};
    for (int k = 0; k < 3; ++k) {
        const fracture_options one = {
            .stages = BURST(400), .strength = STRENGTH, .fracture = criteria[k], .n_threads = 1, .exact = true};
        fracture_options other = one;
        other.n_threads = 2;
        fracture_compare(one, other);
        other.lanes = 8;
        fracture_compare(one, other);
    }
    const fracture_options one = {
        .stages = BURST(400), .strength = SCATTERED, .fracture = CRITERION(1), .n_threads = 1, .exact = true};
    fracture_options other = one;
    other.n_threads = 2;
    other.lanes = 8;
    fracture_compare(one, other);
}

/* ---- what the scene asks ---- */

static void refused(fracture_options o, const char *sentence)
{
    bench_case c;
    assert_int_equal(try_fracture(&c, o), BRC_BAD_INPUT);
    if (!strstr(brc_context_message(c.context), sentence)) fail_msg("%s", brc_context_message(c.context));
    close_case(&c);
}

static void scenes_that_cannot_break_are_refused_with_the_cure(void **state)
{
    (void)state;
    refused((fracture_options){.fracture = CRITERION(1)}, "nothing can break: no material of a body has a strength");
    refused((fracture_options){.fracture = CRITERION(1), .strength = STRENGTH, .beam = "{radius: 3, E: 1 Pa}"},
            "beam: {strength: ...}");
}

/* Half of a packing is of a material without a strength: none of its own beams breaks, those to the other half do. */
static void a_material_without_a_strength_does_not_break(void **state)
{
    (void)state;
    bench_case c;
    const brc_break *events;
    int64_t n, n_between = 0;
    open_fracture(&c, (fracture_options){.stages = BURST(400),
                                         .fracture = CRITERION(1),
                                         .strength = "strength: {tension: 3e-4 Pa}}\n  steel: {E: 1 Pa, nu: 0.2, "
                                                     "density: 1 kg/m^3, beam: {radius: 0.4, E: 8 Pa}"});
    brc_simulation_free(&c.simulation);
    brc_device_close(&c.device);
    brc_body *body = &c.scene->bodies[0];
    assert_done(&c, BRC_ALLOCATE(c.context, &body->regions, 1, "regions"));
    body->n_regions = 1;
    body->regions[0].material = 1;
    for (int64_t e = 0; e < c.domain->n_elements; ++e)
        c.domain->region[e] = c.domain->position[3 * e] > 0.5;
    assert_done(
        &c, brc_device_open(c.context, &(brc_device_request){.selector = "cpu", .many_materials = true}, &c.device));
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    const brc_status status = brc_simulation_create(c.context, c.scene, c.domain, c.device, &c.simulation);
    assert_non_null(strstr(heard(), "fracture: no strength is given for 'steel', which does not break"));
    brc_log_set_level(c.context, BRC_LOG_ERROR);
    assert_done(&c, status);
    begin_first(&c);
    run_steps(&c, 400);
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    for (int64_t k = 0; k < n; ++k) {
        const int sides = c.domain->region[events[k].element_i] + c.domain->region[events[k].element_j];
        assert_true(sides < 2);
        n_between += sides == 1;
    }
    print_message("%lld beams broke, %lld of them to the material without a strength\n", (long long)n,
                  (long long)n_between);
    assert_true(n > 20 && n_between > 0);
    close_case(&c);
}

static void a_strength_for_beams_is_taken_as_given(void **state)
{
    (void)state;
    bench_case c;
    open_fracture(&c, (fracture_options){.fracture = CRITERION(1), .beam = "{radius: 0.4, E: 1 Pa, strength: 3 Pa}"});
    assert_true(brc_simulation_element_strength(c.simulation, 0) == 3);
    close_case(&c);
}

/* Limits are larger by what discs read less, or by half of that in a logarithm; a compressive strength is no result of
 * discs. */
static void a_strength_by_discs_raises_the_limit_in_tension_alone(void **state)
{
    (void)state;
    static const char *const tests[] = {"strength: {tension: 2e-4 Pa, compression: 9e-4 Pa}",
                                        "strength: {tension: 2e-4 Pa, compression: 9e-4 Pa, measured_by: brazilian}",
                                        "strength: {tension: 2e-4 Pa, compression: 9e-4 Pa, measured_by: either}"};
    double limit[3][3], ratio = 0;
    for (int t = 0; t < 3; ++t) {
        bench_case c;
        brc_beam_body bonds;
        open_fracture(&c, (fracture_options){.fracture = CRITERION(1), .strength = tests[t]});
        assert_done(&c, brc_beam_body_of(c.context, c.domain, 0, &bonds));
        assert_done(&c, brc_strength_law_disc(c.context, brc_beam_law_coordination(brc_beam_law_for(0.125), &bonds),
                                              0.4, &ratio));
        for (int k = 0; k < 3; ++k)
            limit[t][k] = brc_fracture_limits(c.simulation)[k];
        close_case(&c);
    }
    assert_true(ratio < 0.99 && sqrt(ratio) > 1 / 1.037);
    for (int k = 0; k < 3; ++k) {
        assert_true(fabs(limit[1][k] * (k == 0 ? ratio : 1) - limit[0][k]) <= 1e-12 * limit[0][k]);
        assert_true(fabs(limit[2][k] * (k == 0 ? sqrt(ratio) : 1) - limit[0][k]) <= 1e-12 * limit[0][k]);
    }
}

/* NAH19 Tables 9 and 10 give sigma_m = sigma_M / k for glass (50 MPa) and alumina (380 MPa); r_m of Tables 5 and 6.
 * 0.05 %: the rounding of the printed coefficients. */
static void eq_22_gives_the_strengths_of_the_papers_tables(void **state)
{
    (void)state;
    static const double glass[8][2] = {{0.506, 78.08}, {0.461, 70.58}, {0.417, 65.79}, {0.380, 62.43},
                                       {0.348, 60.08}, {0.320, 58.44}, {0.298, 57.37}, {0.283, 56.80}};
    const brc_strength_law *law = brc_strength_law_published();
    for (int k = 0; k < 8; ++k)
        assert_true(fabs(50 / brc_strength_law_ratio(law, 6 + k, glass[k][0]) / glass[k][1] - 1) < 5e-4);
    assert_true(fabs(380 / brc_strength_law_ratio(law, 6, 0.478) / 601.22 - 1) < 5e-4);
    assert_true(fabs(380 / brc_strength_law_ratio(law, 13, 0.189) / 435.00 - 1) < 5e-4);
}

/* Limits see strains of second order, which do not grow as the load: in proportion to the load that was measured the
 * worst element would miss by some of its strain, 2e-4. The solver goes on until the part is met to 1e-6. */
static void a_static_stage_goes_to_the_asked_part_of_failure(void **state)
{
    (void)state;
    bench_case c;
    double ratio;
    open_fracture(
        &c,
        (fracture_options){
            .fracture = CRITERION(1),
            .strength = STRENGTH,
            .stages =
                "stages:\n  - name: load\n    solver: {static: {to_failure: 80 %, finite_strain: false}}\n    loads:\n"
                "      - element_displacement: {set: x-, x: 0}\n      - element_displacement: {set: x+, x: 10 um}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_failure_ratio(c.simulation, &ratio));
    assert_true(fabs(ratio / 0.8 - 1) <= 1.001e-6);
    assert_int_equal(count_broken(&c), 0);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_fracture_there_is_neither_array_nor_pass),
        cmocka_unit_test(what_never_breaks_moves_as_without_fracture),
        cmocka_unit_test(elements_at_their_limit_lose_the_bond_nearest_to_the_pull),
        cmocka_unit_test(bonds_of_half_the_strength_break_as_those_of_half_the_limit),
        cmocka_unit_test(weak_grain_boundaries_break_first),
        cmocka_unit_test(the_ledger_closes_through_breaking_to_second_order),
        cmocka_unit_test(breaking_keeps_momentum_and_angular_momentum),
        cmocka_unit_test(elements_without_bonds_fly_freely),
        cmocka_unit_test(the_same_bonds_break_for_any_number_of_threads_and_lanes),
        cmocka_unit_test(scenes_that_cannot_break_are_refused_with_the_cure),
        cmocka_unit_test(a_material_without_a_strength_does_not_break),
        cmocka_unit_test(a_strength_for_beams_is_taken_as_given),
        cmocka_unit_test(a_strength_by_discs_raises_the_limit_in_tension_alone),
        cmocka_unit_test(eq_22_gives_the_strengths_of_the_papers_tables),
        cmocka_unit_test(a_static_stage_goes_to_the_asked_part_of_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
