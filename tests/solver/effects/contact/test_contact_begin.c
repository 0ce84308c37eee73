/* What contact knows when a stage begins. */
#include "contact_case.h"
#include <stdlib.h>

/* The search for the time step moves cells at random in the arrays that the search for pairs reads: cells must not
 * reach farther for it. The list of a body at rest is that of its own state, and made again it is the same. */
static void a_stage_begins_with_the_pairs_of_its_own_state(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.materials = CELLS_STRENGTH("1 Pa"),
                                 .fill = "cells: [6, 6, 6], spread: 90 %, seed: 3",
                                 .gravity = CONTACT_KEYS,
                                 .stages = "  - name: rest\n    solver: {dynamic: {steps: 10}}\n",
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    const int32_t begun = brc_simulation_contact_report(c.simulation).n_pairs;
    assert_done(&c, brc_contact_search(c.simulation));
    assert_int_equal(brc_simulation_contact_report(c.simulation).n_pairs, begun);
    assert_done(&c, brc_simulation_advance(c.simulation, 1)); /* at rest: every H is zero */
    assert_done(&c, brc_contact_search(c.simulation));
    assert_int_equal(brc_simulation_contact_report(c.simulation).n_pairs, begun);
    close_case(&c);
}

/* The same after a state is given: a cube torn apart reaches far, put back it does not. */
static void a_state_that_is_given_decides_who_is_near(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.materials = CELLS_STRENGTH("1 Pa"),
                                 .fill = "cells: [6, 6, 6], spread: 90 %, seed: 3",
                                 .gravity = CONTACT_KEYS,
                                 .stages = "  - name: rest\n    solver: {dynamic: {steps: 10}}\n",
                                 .n_threads = 1});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    const int32_t begun = brc_simulation_contact_report(c.simulation).n_pairs;
    double *u = calloc((size_t)(3 * c.domain->n_elements), sizeof *u),
           *home = calloc((size_t)(3 * c.domain->n_elements), sizeof *u);
    for (int64_t e = 0; e < c.domain->n_elements; ++e)
        u[3 * e] = 3 * c.domain->position[3 * e];
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL));
    assert_done(&c, brc_simulation_set_state(c.simulation, home, NULL));
    assert_int_equal(brc_simulation_contact_report(c.simulation).n_pairs, begun);
    free(u), free(home);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stage_begins_with_the_pairs_of_its_own_state),
        cmocka_unit_test(a_state_that_is_given_decides_who_is_near),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
