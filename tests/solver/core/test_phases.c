/* The watch over the phases of a step. */
#include "../effects/contact/contact_case.h"
#include "../../../host/solver/core/phases.h"

static double sum_of(const brc_simulation *s)
{
    double sum = 0;
    for (int phase = 0; phase < BRC_N_PHASES; ++phase)
        sum += brc_simulation_phase_seconds(s, (brc_step_phase)phase);
    return sum;
}

/* One clock is handed around within another around all of it: the sum cannot be more than the whole, and lacks only
 * what lies between the two outermost readings of the clock, microseconds of some ten milliseconds; half is far beyond
 * what a thread that is put to sleep there takes in most runs of a busy machine. */
static void phases_add_up_to_the_steps(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.materials = CELLS_STRENGTH("4e-4 Pa"),
                                 .fill = "cells: [6, 6, 6], spread: 50 %, seed: 3",
                                 .gravity = CONTACT_KEYS,
                                 .stages = CONTACT_CRUSH,
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_true(sum_of(c.simulation) == 0); /* what comes before the steps is setup */
    assert_done(&c, brc_simulation_advance(c.simulation, 150));
    const double all = brc_simulation_step_seconds(c.simulation), sum = sum_of(c.simulation);
    assert_true(sum <= all && sum > 0.5 * all);
    static const brc_step_phase busy[] = {BRC_PHASE_MOTION, BRC_PHASE_FORCES, BRC_PHASE_SEARCH, BRC_PHASE_PAIRS,
                                          BRC_PHASE_FRACTURE};
    for (size_t k = 0; k < sizeof busy / sizeof *busy; ++k)
        assert_true(brc_simulation_phase_seconds(c.simulation, busy[k]) > 0);
    assert_true(brc_simulation_phase_seconds(c.simulation, BRC_PHASE_OUTPUT) == 0); /* nobody watched */
    close_case(&c);
}

static void what_a_scene_leaves_out_takes_no_time(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.materials = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}",
                                 .fill = "cells: [4, 4, 4], spread: 50 %, seed: 3",
                                 .stages = "  - name: shake\n    solver: {dynamic: {steps: 50}}\n    initial:\n      - "
                                           "velocity: {gradient: {x: [1e-3 1/s, 0, 0]}}\n",
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 50));
    assert_true(brc_simulation_phase_seconds(c.simulation, BRC_PHASE_FORCES) > 0);
    static const brc_step_phase idle[] = {BRC_PHASE_SEARCH, BRC_PHASE_PAIRS, BRC_PHASE_FRACTURE};
    for (size_t k = 0; k < sizeof idle / sizeof *idle; ++k)
        assert_true(brc_simulation_phase_seconds(c.simulation, idle[k]) == 0);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phases_add_up_to_the_steps),
        cmocka_unit_test(what_a_scene_leaves_out_takes_no_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
