/* The guard: what is not finite, too fast or off in the ledger stops the run with where and why. */
#include "../support.h"
#include "../../../host/solver/effects/guard.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHAKE(step)                                                                                                    \
    "  - name: shake\n    solver: {dynamic: {steps: 2000, time_step: " step "}}\n    initial:\n"                       \
    "      - random: {amplitude: [1 mm/s, 1 mm/s, 1 mm/s], seed: 3}\n"

static void expect(bench_case *c, brc_status status, const char *words)
{
    assert_int_equal(status, BRC_PHYSICS_STOPPED);
    if (!strstr(brc_context_message(c->context), words))
        fail_msg("'%s' is not in: %s", words, brc_context_message(c->context));
}

static void a_step_above_the_critical_one_is_stopped_and_named(void **state)
{
    (void)state;
    for (brc_precision p = BRC_DOUBLE; p <= BRC_SINGLE; ++p) {
        bench_case c; /* 216 cells of 1 m, wave speed about 1 m/s: the critical step is some 0.06 s */
        open_case(&c, (case_options){.stages = SHAKE("0.2 s"), .precision = p});
        expect(&c, brc_simulation_run(c.simulation), "Likely cause: the time step is");
        const char *text = brc_context_message(c.context);
        assert_non_null(strstr(text, "stage 'shake' stopped at step"));
        assert_non_null(strstr(text, "First seen between steps"));
        assert_non_null(strstr(text, "m when undeformed, body"));
        close_case(&c);
    }
}

/* A value at one number of the state; looked at once. */
static void look_at(int64_t e, int component, double value, brc_status expected)
{
    bench_case c;
    char words[64];
    open_case(
        &c, (case_options){.fill = "cells: [11, 11, 11], spread: 90 %, seed: 1"}); /* 1331 cells: two blocks of rows */
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_guard_begin_stage(c.simulation));
    double *v = calloc((size_t)(3 * c.domain->n_elements), sizeof *v);
    const int64_t at = e < 0 ? c.domain->n_elements + e : e;
    v[3 * at + component] = value;
    assert_done(&c, brc_simulation_set_state(c.simulation, NULL, v));
    free(v);
    assert_done(&c, brc_guard_step(c.simulation));
    const brc_status status = brc_guard_read(c.simulation, false, NULL);
    snprintf(words, sizeof words, "element %lld is faster than", (long long)at);
    if (expected == BRC_OK)
        assert_done(&c, status);
    else
        expect(&c, status, words);
    close_case(&c);
}

static void every_bad_number_is_found_wherever_it_is(void **state)
{
    (void)state;
    const int64_t elements[] = {0, 1000, 1200, -1};
    const double bad[] = {NAN, INFINITY, -INFINITY, NAN};
    for (int k = 0; k < 4; ++k)
        look_at(elements[k], k % 3, bad[k], BRC_PHYSICS_STOPPED);
    /* E 1, nu 0.2, density 1: the wave speed is sqrt(0.8 / (1.2 * 0.6)) = 1.054 m/s, thirty times it 31.6 m/s */
    look_at(700, 2, -31.7, BRC_PHYSICS_STOPPED);
    look_at(700, 2, 31.5, BRC_OK);
}

static void a_ledger_beyond_its_limit_stops_the_run(void **state)
{
    (void)state;
    bench_case c; /* Verlet's own oscillation at 0.8 of the critical step is some percent */
    open_case(&c, (case_options){.stages = SHAKE("{auto: {safety: 0.8}}"),
                                 .gravity = "guard: {every: 100, closure: 0.01 %}\n"});
    expect(&c, brc_simulation_run(c.simulation), "stopped at step 100,");
    assert_non_null(strstr(brc_context_message(c.context), "guard.closure is 0.01 %"));
    assert_non_null(strstr(brc_context_message(c.context), "velocity Verlet's own oscillation"));
    close_case(&c);
}

/* The ledger of a run at rest with one loss of its own; 1 J was put in. */
static brc_status read_ledger(double friction, double impact, double damping)
{
    bench_case c;
    open_case(&c, (case_options){.stages = SHAKE("auto")});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_guard_begin_stage(c.simulation));
    brc_ledger ledger = {.initial = 1,
                         .kinetic = 1 - friction - impact - damping,
                         .peak_kinetic = 1,
                         .friction = friction,
                         .impact = impact,
                         .damping = damping};
    brc_ledger_close(&ledger);
    assert_true(fabs(ledger.closure) < 1e-15); /* it closes: closure alone would not tell */
    const brc_status status = brc_guard_read(c.simulation, false, &ledger);
    if (status != BRC_OK) expect(&c, status, "can only take energy and gave some back");
    close_case(&c);
    return status;
}

static void a_loss_that_gives_energy_stops_the_run(void **state)
{
    (void)state;
    assert_int_equal(read_ledger(-0.06, 0, 0), BRC_PHYSICS_STOPPED);
    assert_int_equal(read_ledger(0, -0.06, 0), BRC_PHYSICS_STOPPED);
    assert_int_equal(read_ledger(0, 0, -0.06), BRC_PHYSICS_STOPPED);
    assert_int_equal(read_ledger(-0.04, 0, 0), BRC_OK);
    assert_int_equal(read_ledger(0.5, 0.2, 0.2), BRC_OK);
}

static void a_sound_run_is_left_alone_and_its_looks_are_counted(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.stages = SHAKE("auto")});
    assert_int_equal(brc_simulation_guard_report(c.simulation).every, 0);
    assert_done(&c, brc_simulation_run(c.simulation));
    const brc_guard_report report = brc_simulation_guard_report(c.simulation);
    assert_int_equal(report.every, 256);
    assert_int_equal(report.ledger_every, 1024);
    assert_true(report.probes >= 2000 / 256); /* and one at every sample */
    assert_true(report.ledgers >= 2 &&
                report.ledgers < 50); /* at 1024 and at the end; samples every 4 steps have none */
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_above_the_critical_one_is_stopped_and_named),
        cmocka_unit_test(every_bad_number_is_found_wherever_it_is),
        cmocka_unit_test(a_ledger_beyond_its_limit_stops_the_run),
        cmocka_unit_test(a_loss_that_gives_energy_stops_the_run),
        cmocka_unit_test(a_sound_run_is_left_alone_and_its_looks_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
