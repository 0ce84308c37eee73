/* Rigid cells that are apart rest until they may have met (contact_cells.cl, contact_rests), and openings
 * follow by the pairs of the cells that open (host/solver/models/dlsm/cell_softening.c): neither changes what comes
 * out. Cells of E 1 Pa and density 1 kg/m^3 (contact_case.h). */
#include "../../../../host/solver/effects/contact/touching.h"
#include "contact_case.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Every bond is pulled past its strength by the first step; the cells fly apart and meet at random. */
#define DUST                                                                                                           \
    "  - name: burst\n    solver: {dynamic: {steps: 100000, time_step: {auto: {safety: 0.4}}}}\n    initial:\n"        \
    "      - velocity: {gradient: {x: [0.02 1/s, 0, 0], y: [0, 0.02 1/s, 0], z: [0, 0, 0.02 1/s]}}\n"                  \
    "      - random: {amplitude: [8 mm/s, 8 mm/s, 8 mm/s], seed: 1}\n"

static const char *const stages[2] = {CONTACT_CRUSH, DUST};
static case_options options_of(int kind)
{
    return (case_options){.fill = kind ? "cells: [5, 5, 5], spread: 90 %, seed: 1"
                                       : "cells: [4, 4, 4], spread: 90 %, seed: 1",
                          .stages = stages[kind],
                          .materials = kind ? CELLS_STRENGTH("1e-12 Pa") : CELLS_STRENGTH("2e-4 Pa"),
                          .sets = CONTACT_KEYS,
                          .n_threads = 1};
}

/* What pairs remember [n][BRC_CONTACT_HISTORY]. */
static double *histories(bench_case *c, int64_t *n)
{
    *n = brc_simulation_contact_report(c->simulation).n_pairs;
    double *history = calloc((size_t)(BRC_CONTACT_HISTORY * *n) + 1, sizeof *history);
    assert_done(c, brc_contact_read_pairs(c->simulation, NULL, history));
    return history;
}
static bool rests(const double *one)
{
    return one[14] > 1;
}

/* No pair rests: all are looked at in the next evaluation. */
static void wake_all(bench_case *c)
{
    int64_t n;
    double *history = histories(c, &n);
    for (int64_t p = 0; p < n; ++p)
        if (rests(history + BRC_CONTACT_HISTORY * p)) history[BRC_CONTACT_HISTORY * p + 14] = 1;
    assert_done(c, brc_contact_write_pairs(c->simulation, history));
    free(history);
}

/* Displacements, velocities, momenta of turning, and what was lost [9 n + 2]; resting: pairs at rest, summed over the
 * steps, listed: all. */
static double *motion(case_options o, bool wake, int64_t steps, int64_t *n, int64_t *resting, int64_t *listed)
{
    bench_case c;
    open_case(&c, o);
    begin_first(&c);
    for (int64_t k = 0; k < steps; ++k) { /* step by step, since where steps are closed costs a rounding */
        int64_t n_pairs;
        if (wake) wake_all(&c);
        assert_done(&c, brc_simulation_advance(c.simulation, 1));
        double *history = histories(&c, &n_pairs);
        for (int64_t p = 0; p < n_pairs; ++p)
            *resting += rests(history + BRC_CONTACT_HISTORY * p);
        *listed += n_pairs;
        free(history);
    }
    const int64_t width = 3 * c.domain->n_elements;
    double *out = calloc((size_t)(3 * width + 2), sizeof *out);
    const brc_ledger ledger = ledger_now(&c);
    assert_true(brc_simulation_contact_report(c.simulation).n_rigid > 3);
    assert_true(ledger.friction > 0 && ledger.impact > 0); /* pieces met */
    assert_done(&c, brc_simulation_displacement(c.simulation, out));
    assert_done(&c, brc_simulation_velocity(c.simulation, out + width));
    assert_done(&c, brc_contact_momenta(c.simulation, out + 2 * width));
    out[3 * width] = ledger.friction, out[3 * width + 1] = ledger.impact;
    *n = 3 * width + 2;
    close_case(&c);
    return out;
}

/* A pair that touched and was thought to rest would show in the motion. */
static void pairs_at_rest_change_no_bit_of_the_motion(void **state)
{
    (void)state;
    static const brc_precision precisions[3] = {BRC_DOUBLE, BRC_SINGLE, BRC_MIXED};
    for (int k = 0; k < 3; ++k) {
        case_options o = options_of(k % 2);
        int64_t n[2], resting[2] = {0, 0}, listed[2] = {0, 0};
        o.precision = precisions[k];
        double *rested = motion(o, false, 300, &n[0], &resting[0], &listed[0]),
               *awake = motion(o, true, 300, &n[1], &resting[1], &listed[1]);
        print_message("%s, %s: %lld of %lld pairs at rest, summed over steps\n", brc_precision_name(precisions[k]),
                      k % 2 ? "dust" : "crushed", (long long)resting[0], (long long)listed[0]);
        assert_true(resting[0] > 0 && listed[0] == listed[1]);
        assert_true(n[0] == n[1]);
        assert_memory_equal(rested, awake, (size_t)n[0] * sizeof *rested);
        free(rested), free(awake);
    }
}

/* What dust costs is the pairs that are looked at: of those listed, fewer than half when the cells have come apart
 * (`breccia bench contact` measures the time). */
static void most_pairs_of_dispersed_dust_rest(void **state)
{
    (void)state;
    bench_case c;
    int64_t n, resting = 0, touching = 0;
    case_options o = options_of(1);
    o.fill = "cells: [7, 7, 7], spread: 90 %, seed: 1";
    open_case(&c, o);
    begin_first(&c);
    while (0.02 * brc_simulation_time(c.simulation) < 1)
        run_steps(&c, 16); /* twice its size */
    double *history = histories(&c, &n);
    for (int64_t p = 0; p < n; ++p) {
        resting += rests(history + BRC_CONTACT_HISTORY * p);
        touching += history[BRC_CONTACT_HISTORY * p + 12] > 0;
        assert_false(rests(history + BRC_CONTACT_HISTORY * p) && history[BRC_CONTACT_HISTORY * p + 12] > 0);
    }
    print_message("%lld cells, all loose: %lld pairs listed, %lld at rest, %lld touch\n",
                  (long long)c.domain->n_elements, (long long)n, (long long)resting, (long long)touching);
    assert_true((int64_t)brc_simulation_contact_report(c.simulation).n_rigid == c.domain->n_elements);
    assert_true(n > 50 && 2 * resting > n);
    free(history);
    close_case(&c);
}

/* Displacements and velocities of a cube that opens against its cohesion, breaks and is pressed together; */
static double *softened(bool whole, int64_t *n, int64_t *broken, double *spent)
{
    bench_case c;
    /* without closure surfaces meet in contact from the step on in which their bond breaks */
    open_case(&c, (case_options){.fill = "cells: [6, 6, 6], spread: 90 %, seed: 1",
                                 .stages = CONTACT_CRUSH,
                                 .sets = "fracture: {criterion: bond-normal, closure: false}\ninteractions: {contact: "
                                         "{friction: 0.3, restitution: 0.7}}\n",
                                 .n_threads = 1,
                                 .materials = CELLS_STRENGTH("4e-4 Pa, fracture_energy: 2e-7 J/m^2")});
    begin_first(&c);
    brc_contact_always_whole(c.simulation, whole);
    run_steps(&c, 400);
    *n = 6 * c.domain->n_elements;
    *broken = count_broken(&c);
    *spent = softening_now(&c).unfinished;
    assert_true(ledger_now(&c).friction > 0);
    double *out = calloc((size_t)*n, sizeof *out);
    assert_done(&c, brc_simulation_displacement(c.simulation, out));
    assert_done(&c, brc_simulation_velocity(c.simulation, out + *n / 2));
    close_case(&c);
    return out;
}

/* Fluxes of the cells that open take what presses on them, at the gradients of whoever does: a pair left out, or one
 * with an old gradient, would show in the openings. */
static void openings_follow_by_the_pairs_around_them_as_by_all(void **state)
{
    (void)state;
    int64_t n[2], broken[2];
    double spent[2];
    double *listed = softened(false, &n[0], &broken[0], &spent[0]),
           *whole = softened(true, &n[1], &broken[1], &spent[1]);
    print_message("%lld bonds broken, %.3g J spent in faces that are still open\n", (long long)broken[0], spent[0]);
    assert_true(broken[0] > 20 && spent[0] > 0 && broken[0] == broken[1]);
    assert_memory_equal(listed, whole, (size_t)n[0] * sizeof *listed);
    free(listed), free(whole);
}

/* Arrays of pairs as they are after breaks; they grow by a quarter at once, from what pairs there were, and results on
 * their way are of those that touch, few here: a third at least. */
static void pairs_take_no_more_than_is_said(void **state)
{
    (void)state;
    bench_case c;
    int64_t most = 0;
    open_case(&c, options_of(0));
    begin_first(&c);
    for (int k = 0; k < 25; ++k) {
        run_steps(&c, 16);
        const int64_t now = brc_simulation_contact_report(c.simulation).n_pairs;
        most = now > most ? now : most;
    }
    const int64_t bytes = brc_simulation_contact_report(c.simulation).pair_bytes;
    const int64_t said = brc_simulation_pair_bytes(c.simulation) * most;
    print_message("%lld pairs at most: %lld bytes of %lld\n", (long long)most, (long long)bytes, (long long)said);
    assert_true(bytes > 0 && bytes <= said && 3 * bytes > said);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_at_rest_change_no_bit_of_the_motion),
        cmocka_unit_test(most_pairs_of_dispersed_dust_rest),
        cmocka_unit_test(openings_follow_by_the_pairs_around_them_as_by_all),
        cmocka_unit_test(pairs_take_no_more_than_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
