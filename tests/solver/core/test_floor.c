/* The least that a step moves, from the markers of its passes, against counts by hand (docs/notebook/performance.md).
 */
#include "../effects/fracture/fracture_case.h"

typedef struct expected {
    const char *model, *fracture;
    double half_edge, element; /* double precision [B] */
} expected;

static void assert_floor(bench_case *c, double half_edge, double element)
{
    const double by_hand = half_edge * (double)c->domain->n_half_edges + element * (double)c->domain->n_elements;
    assert_true(brc_simulation_floor_bytes(c->simulation) == by_hand);
    close_case(c);
}

#define BY_BOND "fracture: {criterion: bond-normal}\n"
#define BY_ELEMENT "fracture: {criterion: {virial-principal: {level: 1}}}\n"
/* dlsm has four passes: neighbour and s; and d; and d, q; and q. u, A^-1, H; H, 1/V, P; H, P, A^-1, 1/V, B; u, B, f;
 * and in each the list of what is asked for ahead. */
#define DLSM_ROWS (4 * 4 + 8 * (3 + 6 + 7 + 4))
#define DLSM_ELEMENT (8 * (18 + 19 + 34 + 15 + 16) + 4 * 4)
/* dlsm-published two: neighbour and R, those and S. u, q, A^-1, strain; u, q, strain, f, t; and what turns. */
#define PUBLISHED_ROWS (2 * 4 + 8 * (3 + 4))
#define PUBLISHED_ELEMENT (8 * (19 + 19 + 16 + 18) + 2 * 4)

static void the_floor_of_a_step_is_what_its_passes_say(void **state)
{
    (void)state;
    static const expected all[] = {
        {"dlsm", NULL, DLSM_ROWS, DLSM_ELEMENT},
        {"dlsm-published", NULL, PUBLISHED_ROWS, PUBLISHED_ELEMENT},
        /* limits of bonds; H, P, lambda + 2 mu */
        {"dlsm", BY_BOND, DLSM_ROWS + 8, DLSM_ELEMENT + 8 * 19},
        /* limits of bonds; the directions spanned, and the largest ratio, written and read */
        {"dlsm-published", BY_BOND, PUBLISHED_ROWS + 8, PUBLISHED_ELEMENT + 8 * (6 + 2)},
        /* H, P, the record and the bound; neighbours, bound, margin, weight and the choice; the choice and the mark */
        {"dlsm", BY_ELEMENT, DLSM_ROWS + 4, DLSM_ELEMENT + 8 * (9 + 9 + 16 + 1) + 8 * 3 + 4 + 4 + 8},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        bench_case c;
        open_case(
            &c, (case_options){.model = all[k].model,
                               .fill = "cells: [5, 4, 3], spread: 50 %, seed: 3",
                               .materials = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}",
                               .sets = all[k].fracture,
                               .stages = "  - name: go\n    solver: {dynamic: {steps: 1}}\n",
                               .n_threads = 1});
        assert_floor(&c, all[k].half_edge, all[k].element);
    }
}

/* One pass of beams: neighbour, x_ij, 1 / L. u, q, f, t; the list of what is asked for ahead; and what turns. */
static void so_is_that_of_beams(void **state)
{
    (void)state;
    const double half_edge = 4 + 8 * 4, element = 8 * (3 + 4 + 6 + 16 + 18) + 4;
    bench_case c;
    open_fracture(&c, (fracture_options){.stages = FRACTURE_BURST(1)});
    assert_floor(&c, half_edge, element);
    open_fracture(&c, (fracture_options){.stages = FRACTURE_BURST(1),
                                         .fracture = "{criterion: {virial-principal: {level: 1}}}",
                                         .strength = "strength: {tension: 1 Pa}"});
    /* the record and the bound; neighbours, bound, margin, weight and the choice */
    assert_floor(&c, half_edge + 4, element + 8 * (16 + 1) + 8 * 3 + 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_floor_of_a_step_is_what_its_passes_say),
                                       cmocka_unit_test(so_is_that_of_beams)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
