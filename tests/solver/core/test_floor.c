/* The least that a step moves, from the markers of its passes, against counts by hand (docs/notebook/performance.md).
 */
#include "../support.h"

typedef struct expected {
    const char *model;
    double half_edge, element; /* double precision [B] */
} expected;

static void the_floor_of_a_step_is_what_its_passes_say(void **state)
{
    (void)state;
    static const expected all[] = {
        /* four passes: neighbour and s; and d; and d, q; and q. u, A^-1, H; H, 1/V, P; H, P, A^-1, 1/V, B; u, B, f; and
         * in each the list of what is asked for ahead */
        {"dlsm", 4 * 4 + 8 * (3 + 6 + 7 + 4), 8 * (18 + 19 + 34 + 15 + 16) + 4 * 4},
        /* two: neighbour and R, those and S. u, q, A^-1, strain; u, q, strain, f, t; and what turns */
        {"dlsm-published", 2 * 4 + 8 * (3 + 4), 8 * (19 + 19 + 16 + 18) + 2 * 4},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        bench_case c;
        open_case(&c, (case_options){.model = all[k].model,
                                     .fill = "cells: [5, 4, 3], spread: 50 %, seed: 3",
                                     .stages = "  - name: go\n    solver: {dynamic: {steps: 1}}\n",
                                     .n_threads = 1});
        const double by_hand =
            all[k].half_edge * (double)c.domain->n_half_edges + all[k].element * (double)c.domain->n_elements;
        assert_true(brc_simulation_floor_bytes(c.simulation) == by_hand);
        close_case(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_floor_of_a_step_is_what_its_passes_say)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
