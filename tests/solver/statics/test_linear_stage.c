/* Static stages without finite strain: energies, strains, stresses, reactions and what bonds fail by are those of the
 * linearised law, however far the body turns; a stage by the full law behind them says where that is another energy. */
#include "../effects/fracture/cells_case.h"
#include "../effects/fracture/fracture_case.h"
#include "../../../host/base/log.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a stage leaves. */
typedef struct answer {
    int64_t n;           /* numbers in each of the three */
    double *values[3];   /* strain, stress, Cauchy stress [n_elements][6] */
    double energy, work; /* [J] */
    double reaction[3];  /* of the held end [N] */
    double ratio;        /* to failure */
} answer;

static void take_answer(bench_case *c, const char *held, answer *a)
{
    const brc_ledger ledger = ledger_now(c);
    a->n = 6 * c->domain->n_elements;
    for (int k = 0; k < 3; ++k)
        a->values[k] = calloc((size_t)a->n, sizeof *a->values[k]);
    assert_done(c, brc_simulation_strain_stress(c->simulation, a->values[0], a->values[1], a->values[2]));
    a->energy = ledger.elastic + ledger.stabilisation, a->work = ledger.work;
    assert_done(c, brc_simulation_reaction(c->simulation, brc_domain_find_set(c->domain, held), a->reaction));
    assert_done(c, brc_simulation_failure_ratio(c->simulation, &a->ratio));
}

typedef void (*run_moved)(answer *a, const char *moved);

/* A bar of 10:1 whose end is moved aside. */
static void run_cells(answer *a, const char *moved, const char *model, const char *fracture)
{
    static const char ends[] = "sets: {left: {elements: {wall: x-}}, right: {elements: {wall: x+}}}\n";
    char stages[400], sets[200];
    bench_case c;
    const char *load = model ? "element_displacement" : "face_displacement";
    snprintf(sets, sizeof sets, "%s%s", fracture, model ? ends : "");
    snprintf(stages, sizeof stages,
             "  - name: bend\n    solver: {static: {finite_strain: false, tolerance: 1e-13}}\n    loads:\n"
             "      - %s: {set: %s, x: 0, y: 0, z: 0}\n      - %s: {set: %s, z: %s}\n",
             load, model ? "left" : "x-", load, model ? "right" : "x+", moved);
    open_case(&c, (case_options){.model = model,
                                 .materials = CELLS_STRENGTH("1e-2 Pa"),
                                 .shape = "{box: {size: [10 m, 1 m, 1 m]}}",
                                 .fill = "cells: [30, 3, 3], spread: 50 %",
                                 .sets = sets,
                                 .stages = stages});
    assert_done(&c, brc_simulation_run(c.simulation));
    take_answer(&c, model ? "left" : "x-", a);
    close_case(&c);
}
static void run_bonds(answer *a, const char *moved)
{
    run_cells(a, moved, NULL, CELLS_FRACTURE);
}
static void run_elements(answer *a, const char *moved)
{
    run_cells(a, moved, NULL, "fracture: {criterion: virial-principal}\n");
}
static void run_published(answer *a, const char *moved)
{
    run_cells(a, moved, "dlsm-published", CELLS_FRACTURE);
}
static void run_beams(answer *a, const char *moved)
{
    char stages[400];
    bench_case c;
    snprintf(stages, sizeof stages,
             "stages:\n  - name: bend\n    solver: {static: {finite_strain: false, tolerance: 1e-13}}\n    loads:\n"
             "      - element_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - element_displacement: {set: x+, z: "
             "%s}\n",
             moved);
    open_fracture(&c, (fracture_options){.fracture = "{criterion: {virial-principal: {level: 1}}}",
                                         .strength = "strength: {tension: 1e-2 Pa}",
                                         .elements = 300,
                                         .stages = stages});
    assert_done(&c, brc_simulation_run(c.simulation));
    take_answer(&c, "x-", a);
    close_case(&c);
}

/* 2e5 times the load: 2e5 times all that is linear, and its square times the energy. Solves end 1e-13 of the largest
 * force away from equilibrium, that of an end which moves alone: thousands of times what the bent bar bears. What is
 * moved by a fifth of the length turns by as much: a strain of 2 % by the full law, beside 3 % of bending. */
static void check_proportion(run_moved run)
{
    static const double times = 2e5, most = 1e-9;
    answer small = {0}, large = {0};
    run(&small, "1e-5 m"), run(&large, "2 m");
    assert_int_equal(small.n, large.n);
    for (int k = 0; k < 3; ++k) {
        double size = 0, off = 0;
        for (int64_t i = 0; i < small.n; ++i) {
            size = fmax(size, fabs(large.values[k][i]));
            off = fmax(off, fabs(large.values[k][i] - times * small.values[k][i]));
        }
        assert_true(size > 0);
        if (!(off < most * size)) fail_msg("values %d: %g of %g", k, off, size);
        free(small.values[k]), free(large.values[k]);
    }
    for (int c = 0; c < 3; ++c)
        assert_true(fabs(large.reaction[c] - times * small.reaction[c]) < most * fabs(large.reaction[2]));
    assert_true(large.energy > 0 && fabs(large.energy / (times * times * small.energy) - 1) < most);
    assert_true(small.ratio > 0 && fabs(large.ratio / (times * small.ratio) - 1) < most);
}
static void cells_answer_in_proportion(void **state)
{
    (void)state;
    check_proportion(run_bonds);
}
static void cells_that_fail_by_their_stress_answer_in_proportion(void **state)
{
    (void)state;
    check_proportion(run_elements);
}
static void published_cells_answer_in_proportion(void **state)
{
    (void)state;
    check_proportion(run_published);
}
static void beams_answer_in_proportion(void **state)
{
    (void)state;
    check_proportion(run_beams);
}

/* Of laws with a potential the ledger closes, however far the body turned: the work of the loads is what it holds. */
static void the_ledger_closes(void **state)
{
    (void)state;
    static const run_moved with_potential[] = {run_bonds, run_elements, run_beams};
    for (int k = 0; k < 3; ++k) {
        answer a = {0};
        with_potential[k](&a, "2 m");
        if (!(fabs(a.work / a.energy - 1) < 1e-9)) fail_msg("case %d: %g off", k, a.work / a.energy - 1);
        for (int i = 0; i < 3; ++i)
            free(a.values[i]);
    }
}

/* What is told of two stages of which the second starts where the first ends; solver: of both. */
static const char *told(const char *first, const char *second, const char *moved)
{
    char stages[700];
    bench_case c;
    snprintf(stages, sizeof stages,
             "  - name: bend\n    solver: {%s}\n    loads:\n"
             "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - face_displacement: {set: x+, z: %s}\n"
             "  - name: hold\n    solver: {%s}\n    loads:\n"
             "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - face_displacement: {set: x+, z: %s}\n",
             first, moved, second, moved);
    open_case(&c, (case_options){.shape = "{box: {size: [10 m, 1 m, 1 m]}}",
                                 .fill = "cells: [30, 3, 3], spread: 50 %",
                                 .stages = stages});
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    const brc_status status = brc_simulation_run(c.simulation);
    const char *said = heard();
    assert_done(&c, status);
    close_case(&c);
    return said;
}
static void a_change_of_law_is_warned_of_where_parts_turned_far(void **state)
{
    (void)state;
    static const char warning[] = "warning: stage 'hold' begins with an elastic energy of ";
    static const char linear[] = "static: {finite_strain: false}", full[] = "static: {increments: 2}",
                      steps[] = "dynamic: {steps: 1}";
    assert_non_null(strstr(told(linear, steps, "2 m"), warning));
    assert_non_null(strstr(told(full, linear, "2 m"), warning));
    assert_null(strstr(told(linear, steps, "0.1 mm"), warning));
    assert_null(strstr(told(full, linear, "0.1 mm"), warning));
    assert_null(strstr(told(full, steps, "2 m"), warning));
    assert_null(strstr(told(linear, linear, "2 m"), warning)); /* and is in equilibrium from the start */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_answer_in_proportion),
        cmocka_unit_test(cells_that_fail_by_their_stress_answer_in_proportion),
        cmocka_unit_test(published_cells_answer_in_proportion),
        cmocka_unit_test(beams_answer_in_proportion),
        cmocka_unit_test(the_ledger_closes),
        cmocka_unit_test(a_change_of_law_is_warned_of_where_parts_turned_far),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
