/* Stages that end early, and the regime of a fracture. */
#include "../effects/fracture/fracture_case.h"
#include "../../../host/solver/core/regime.h"
#include "../../../host/solver/run/stage_end.h"
#include <math.h>
#include <string.h>

static const char CRITERION[] = "{criterion: {virial-principal: {level: 1}}}";

static void run(bench_case *c, const char *stages)
{
    open_fracture(
        c, (fracture_options){.fracture = CRITERION, .strength = "strength: {tension: 2e-4 Pa}", .stages = stages});
}

/* The burst breaks a sixth of the bonds in 300 steps: the stage ends at the first sample past a twentieth, and the next
 * one runs. */
static void too_many_broken_bonds_end_a_stage(void **state)
{
    (void)state;
    bench_case c;
    int64_t broken;
    run(&c, "stages:\n  - name: burst\n    solver: {dynamic: {steps: 300, stop_when_broken: 5 %}}\n    initial:\n"
            "      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n  - name: after\n    solver: {dynamic: "
            "{steps: 10}}\n");
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_non_null(strstr(brc_simulation_stage_reason(c.simulation, 0), "stop_when_broken"));
    assert_string_equal(brc_simulation_stage_reason(c.simulation, 1), "");
    assert_string_equal(brc_simulation_stage_reason(c.simulation, 2), "");
    assert_int_equal(brc_simulation_stage(c.simulation), 1);
    assert_true(brc_simulation_total_steps(c.simulation) < 300 && brc_simulation_step(c.simulation) == 10);
    assert_done(&c, brc_simulation_broken(c.simulation, &broken));
    assert_true((double)broken > 0.05 * (double)c.domain->n_bonds);
    close_case(&c);
}

static brc_status end_at_seven(void *self, brc_simulation *simulation)
{
    int *samples = self;
    if (++*samples == 8) brc_simulation_end_stage(simulation, "seven");
    return BRC_OK;
}

static void an_observer_ends_a_dynamic_stage(void **state)
{
    (void)state;
    bench_case c;
    int samples = 0;
    run(&c, "stages:\n  - name: burst\n    solver: {dynamic: {steps: 300}}\n");
    const brc_observer observer = {.self = &samples, .sample = end_at_seven};
    assert_done(&c, brc_simulation_observe(c.simulation, &observer));
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_int_equal(samples, 8); /* at the start and after every step */
    assert_int_equal(brc_simulation_step(c.simulation), 7);
    assert_string_equal(brc_simulation_stage_reason(c.simulation, 0), "seven");
    close_case(&c);
}

/* Kinetic and elastic energy by hand: the first break lies between the second and third sample, the peak is the
 * fourth. */
static void the_regime_is_that_of_the_samples(void **state)
{
    (void)state;
    static const struct {
        double kinetic, elastic;
        bool broken;
    } sample[] = {{1, 0, false}, {1, 100, false}, {3, 150, true}, {8, 200, true}, {100, 50, true}};
    brc_regime r = {0};
    assert_string_equal(brc_regime_name(&r), "");
    for (int k = 0; k < 5; ++k)
        brc_regime_follow(&r, sample[k].kinetic, sample[k].elastic, sample[k].broken);
    assert_true(r.at_first_break == 0.01 && r.at_peak == 0.04 && r.until_peak == 0.04);
    assert_string_equal(brc_regime_name(&r), "quasi-static");
    brc_regime_follow(&r, 30, 300, true);
    assert_true(r.at_peak == 0.1 && r.until_peak == 2); /* 100 / 50 lay before this peak */
    assert_string_equal(brc_regime_name(&r), "dynamic");
}

/* A burst is all motion: its ratio at the first break is what the ledger says there. */
static void a_burst_is_dynamic(void **state)
{
    (void)state;
    bench_case c;
    run(&c, FRACTURE_BURST(200));
    assert_done(&c, brc_simulation_run(c.simulation));
    const brc_regime r = brc_simulation_regime(c.simulation);
    assert_true(r.broke && r.at_first_break > BRC_QUASI_STATIC);
    assert_string_equal(brc_regime_name(&r), "dynamic");
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_many_broken_bonds_end_a_stage),
        cmocka_unit_test(an_observer_ends_a_dynamic_stage),
        cmocka_unit_test(the_regime_is_that_of_the_samples),
        cmocka_unit_test(a_burst_is_dynamic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
