/* Rigid parts beside diagonal blocks, and solves that begin from known states. */
#include "../models/cbm/beams_case.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Held at one side, pulled and pressed aside at the other; and one that may slide and turn as a whole. */
#define SETS_AND_STAGE                                                                                                 \
    "sets:\n  left: {elements: {box: {from: [0 m, 0 m, 0 m], to: [1.2 m, 20 m, 20 m]}}}\n"                             \
    "  right: {elements: {box: {from: [8.2 m, 0 m, 0 m], to: [20 m, 20 m, 20 m]}}}\n"                                  \
    "stages:\n  - name: pull\n    solver: {static: {finite_strain: false, tolerance: 1e-10}}\n    loads:\n"
static const char held[] = SETS_AND_STAGE "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n"
                                          "      - element_displacement: {set: right, x: 1 mm, z: 2 mm}\n";
static const char sliding[] = SETS_AND_STAGE "      - element_displacement: {set: left, x: 0}\n"
                                             "      - element_displacement: {set: right, x: 1 mm}\n";

/* Displacements and rotations of a run, the caller's; its iterations. */
static double *run(const char *stages, brc_preconditioner_kind kind, int n_threads, int32_t n_known,
                   const double *const *known, int64_t *n, int64_t *iterations)
{
    beams_case c;
    open_lattice(&c, 9, (beams_options){.coordination = 6, .stages = stages, .n_threads = n_threads});
    c.scene->stages[0].preconditioner = kind;
    brc_simulation_know_states(c.simulation, n_known, known);
    beams_done(&c, brc_simulation_run(c.simulation));
    *n = 6 * c.domain->n_elements;
    double *state = calloc((size_t)*n, sizeof *state);
    beams_done(&c, brc_simulation_static_state(c.simulation, state));
    *iterations = brc_simulation_static_report(c.simulation).iterations;
    close_beams(&c);
    return state;
}

/* The largest difference of every `step`-th of n numbers. */
static double farthest(int64_t n, int64_t step, const double *a, const double *b)
{
    double most = 0;
    for (int64_t i = 0; i < n; i += step)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* Residuals are 1e-10 of the load, the condition of the stiffness some 1e3. */
static void parts_give_the_answer_of_blocks_in_fewer_iterations(void **state)
{
    (void)state;
    int64_t n, iterations[2];
    double *a = run(held, BRC_PRECONDITIONER_BLOCKS, 1, 0, NULL, &n, &iterations[0]),
           *b = run(held, BRC_PRECONDITIONER_PARTS, 1, 0, NULL, &n, &iterations[1]);
    assert_true(farthest(n, 1, a, b) < 1e-7 * 2e-3);
    if (!(1.5 * (double)iterations[1] < (double)iterations[0]))
        fail_msg("%lld iterations, blocks %lld", (long long)iterations[1], (long long)iterations[0]);
    free(a), free(b);
}

/* Sliding across and turning about x cost nothing: along x the answers agree, across nothing goes far. */
static void motions_that_nothing_holds_are_left_out(void **state)
{
    (void)state;
    int64_t n, iterations[2];
    double *a = run(sliding, BRC_PRECONDITIONER_BLOCKS, 1, 0, NULL, &n, &iterations[0]),
           *b = run(sliding, BRC_PRECONDITIONER_PARTS, 1, 0, NULL, &n, &iterations[1]);
    assert_true(farthest(n, 6, a, b) < 1e-7 * 1e-3);
    assert_true(farthest(n, 1, a, b) < 1e-3);
    assert_true(iterations[1] < iterations[0]);
    free(a), free(b);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    int64_t n, iterations[2];
    double *a = run(held, BRC_PRECONDITIONER_PARTS, 1, 0, NULL, &n, &iterations[0]),
           *b = run(held, BRC_PRECONDITIONER_PARTS, 2, 0, NULL, &n, &iterations[1]);
    assert_int_equal(iterations[0], iterations[1]);
    assert_memory_equal(a, b, (size_t)n * sizeof *a);
    free(a), free(b);
}

/* The answer itself is a beginning that needs no iteration; twice over, or halves that mix to it, too. */
static void a_solve_begins_from_what_is_known(void **state)
{
    (void)state;
    int64_t n, first, again;
    double *a = run(held, BRC_PRECONDITIONER_PARTS, 1, 0, NULL, &n, &first), *other = calloc((size_t)n, sizeof *other);
    for (int64_t i = 0; i < n; ++i)
        other[i] = a[i] * (1 + 0.5 * random_at((uint64_t)i));
    double *b = run(held, BRC_PRECONDITIONER_PARTS, 1, 3, (const double *const[]){other, a, a}, &n, &again);
    assert_true(first > 10);
    assert_int_equal(again, 0);
    assert_true(farthest(n, 1, a, b) < 1e-7 * 2e-3);
    free(a), free(b), free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_give_the_answer_of_blocks_in_fewer_iterations),
        cmocka_unit_test(motions_that_nothing_holds_are_left_out),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(a_solve_begins_from_what_is_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
