/* Looks at steps of an observer's own choice: what it sees, and that the run never knows. */
#include "../effects/fracture/fracture_case.h"
#include "../../../host/solver/run/stage_end.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct looker {
    int64_t every, n, last, end_at;
    double *velocity; /* [n_elements][3] at the last look, NULL: not wanted */
} looker;

static int64_t next_look(void *self, const brc_simulation *simulation, int64_t step)
{
    (void)simulation;
    const looker *l = self;
    return (step < 0 ? -1 : step / l->every) * l->every + l->every;
}

/* Reads what changes most when it is asked for: the ledger keeps peaks, stresses take the place of fluxes. */
static brc_status look(void *self, brc_simulation *simulation)
{
    looker *l = self;
    const int64_t n = brc_simulation_domain(simulation)->n_elements;
    brc_ledger ledger;
    double *stress = malloc(sizeof(double) * 6 * (size_t)n);
    brc_status status = brc_simulation_strain_stress(simulation, NULL, NULL, stress);
    if (status == BRC_OK) status = brc_simulation_ledger(simulation, &ledger);
    if (status == BRC_OK && l->velocity) status = brc_simulation_velocity(simulation, l->velocity);
    free(stress);
    l->n += 1;
    l->last = brc_simulation_step(simulation);
    if (l->end_at == l->last) brc_simulation_end_stage(simulation, "seen enough");
    return status;
}

static double *velocities(bench_case *c)
{
    double *v = malloc(sizeof(double) * 3 * (size_t)c->domain->n_elements);
    assert_non_null(v);
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    return v;
}

/* Both cases, opened, are run, the second one looked at every three steps; state, ledger and breaks agree to the last
 * bit. They are closed. */
static void assert_unmoved(bench_case *left_alone, bench_case *looked_at, int64_t steps)
{
    looker l = {.every = 3};
    const brc_observer observer = {.self = &l, .next_look = next_look, .look = look};
    assert_done(looked_at, brc_simulation_observe(looked_at->simulation, &observer));
    bench_case *both[2] = {left_alone, looked_at};
    for (int k = 0; k < 2; ++k) {
        both[k]->scene->output.history_every = 40; /* batches of many steps, between whose ends it looks */
        assert_done(both[k], brc_simulation_run(both[k]->simulation));
    }
    assert_int_equal(l.n, steps / 3);
    const size_t bytes = sizeof(double) * 3 * (size_t)left_alone->domain->n_elements;
    double *v[2] = {velocities(left_alone), velocities(looked_at)};
    assert_memory_equal(v[0], v[1], bytes);
    brc_ledger ledger[2] = {ledger_now(left_alone), ledger_now(looked_at)};
    assert_memory_equal(&ledger[0], &ledger[1], sizeof ledger[0]);
    for (int k = 0; k < 2; ++k) {
        free(v[k]);
        close_case(both[k]);
    }
}

static void cells_that_are_looked_at_move_as_if_left_alone(void **state)
{
    (void)state;
    static const char stages[] = "  - name: swing\n    solver: {dynamic: {steps: 100}}\n    initial: [velocity: "
                                 "{gradient: {x: [1e-3 1/s, 4e-4 1/s, 0]}}]\n";
    static const char *const models[] = {"dlsm", "dlsm-published"};
    for (int m = 0; m < 2; ++m) {
        bench_case a, b;
        open_case(&a, (case_options){.model = models[m], .stages = stages});
        open_case(&b, (case_options){.model = models[m], .stages = stages});
        assert_unmoved(&a, &b, 100);
    }
}

static void what_breaks_while_looked_at_is_what_breaks_alone(void **state)
{
    (void)state;
    bench_case a, b;
    const fracture_options options = {
        .fracture = "{}", .strength = "strength: {tension: 2e-4 Pa}", .stages = FRACTURE_BURST(200)};
    open_fracture(&a, options);
    open_fracture(&b, options);
    int64_t n_bonds = a.domain->n_bonds;
    assert_true(n_bonds > 0);
    assert_unmoved(&a, &b, 200);
}

/* The velocity between two batches is that of the whole step: what stepping by hand gives, to rounding; half a step
 * earlier differs by far more. */
static void velocities_are_those_of_the_whole_step(void **state)
{
    (void)state;
    static const char stages[] = "  - name: swing\n    solver: {dynamic: {steps: 50}}\n    initial: [velocity: "
                                 "{gradient: {x: [1e-3 1/s, 4e-4 1/s, 0]}}]\n";
    bench_case run, by_hand;
    open_case(&run, (case_options){.stages = stages});
    open_case(&by_hand, (case_options){.stages = stages});
    looker l = {.every = 47, .velocity = velocities(&run)};
    run.scene->output.history_every = 50;
    const brc_observer observer = {.self = &l, .next_look = next_look, .look = look};
    assert_done(&run, brc_simulation_observe(run.simulation, &observer));
    assert_done(&run, brc_simulation_run(run.simulation));
    assert_true(l.n == 1 && l.last == 47);
    begin_first(&by_hand);
    run_steps(&by_hand, 47);
    double *v = velocities(&by_hand), *after = velocities(&run), worst = 0, apart = 0, largest = 0;
    for (int64_t i = 0; i < 3 * run.domain->n_elements; ++i) {
        worst = fmax(worst, fabs(v[i] - l.velocity[i]));
        apart = fmax(apart, fabs(after[i] - l.velocity[i]));
        largest = fmax(largest, fabs(v[i]));
    }
    assert_true(worst < 1e-13 * largest && apart > 1e-3 * largest);
    free(v);
    free(after);
    free(l.velocity);
    close_case(&run);
    close_case(&by_hand);
}

static void a_look_ends_a_stage_at_its_step(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.stages = "  - name: swing\n    solver: {dynamic: {steps: 500}}\n  - name: after\n    "
                                           "solver: {dynamic: {steps: 5}}\n"});
    looker l = {.every = 37, .end_at = 74};
    c.scene->output.history_every = 500;
    const brc_observer observer = {.self = &l, .next_look = next_look, .look = look};
    assert_done(&c, brc_simulation_observe(c.simulation, &observer));
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_true(l.n == 2 && brc_simulation_total_steps(c.simulation) == 79);
    assert_string_equal(brc_simulation_stage_reason(c.simulation, 0), "seen enough");
    close_case(&c);
}

static void increments_are_looked_at_and_ended_too(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.stages = "  - name: pull\n    solver: {static: {increments: 6}}\n"
                                           "    loads: [face_displacement: {set: x+, x: 0, y: 0, z: 1e-4 m}, "
                                           "face_displacement: {set: x-, x: 0, y: 0, z: 0}]\n"});
    looker l = {.every = 2, .end_at = 4};
    const brc_observer observer = {.self = &l, .next_look = next_look, .look = look};
    assert_done(&c, brc_simulation_observe(c.simulation, &observer));
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_true(l.n == 2 && brc_simulation_step(c.simulation) == 4);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_that_are_looked_at_move_as_if_left_alone),
        cmocka_unit_test(what_breaks_while_looked_at_is_what_breaks_alone),
        cmocka_unit_test(velocities_are_those_of_the_whole_step),
        cmocka_unit_test(a_look_ends_a_stage_at_its_step),
        cmocka_unit_test(increments_are_looked_at_and_ended_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
