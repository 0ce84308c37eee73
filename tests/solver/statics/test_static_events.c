/* Quasi-static fracture: where every event happens, what it costs, when it ends. */
#include "../effects/fracture/fracture_case.h"
#include "../../../host/base/memory.h"
#include "../../../host/solver/effects/loads/loads.h"
#include "../../../host/solver/run/stage_end.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char CRITERION[] = "{criterion: {virial-principal: {level: 1}}}";
static const char STRENGTH[] = "strength: {tension: 2e-4 Pa}";
#define EVENTS(keys, loads) "stages:\n  - name: crack\n    solver: {static: {" keys "}}\n    loads:\n" loads
#define PULLED(keys, x)                                                                                                \
    EVENTS(keys, "      - element_displacement: {set: x-, x: 0}\n      - element_displacement: {set: x+, x: " x "}\n")
#define PUSHED(keys)                                                                                                   \
    EVENTS(keys, "      - element_displacement: {set: x-, x: 0}\n      - element_force: {set: x+, x: 1e-5 N}\n")

/* What an observer saw at every sample. */
enum { MOST_SAMPLES = 200 };
typedef struct curve {
    int n;
    double load[MOST_SAMPLES], ratio[MOST_SAMPLES], residual[MOST_SAMPLES];
    int64_t broken[MOST_SAMPLES];
    brc_ledger ledger[MOST_SAMPLES];
    int end_at; /* sample at which the observer ends the stage; 0: never */
} curve;

static void take_out(void *self, const brc_prescribed *one)
{
    for (int c = 0; one->face < 0 && c < 3; ++c)
        if (one->motion >> c & 1) ((double *)self)[3 * (int64_t)one->element + c] = 0;
}

/* Largest force on an element that no motion is prescribed for, over the reaction of the wall: 0 in equilibrium. */
static double free_force(brc_simulation *s)
{
    const int64_t n = 3 * s->domain->n_elements;
    double *force = calloc((size_t)n, sizeof *force), most = 0, reaction[3];
    assert_int_equal(brc_simulation_force(s, force), BRC_OK);
    brc_loads_each_prescribed(s, take_out, force);
    for (int64_t k = 0; k < n; ++k)
        most = fmax(most, fabs(force[k]));
    assert_int_equal(brc_simulation_reaction(s, brc_domain_find_set(s->domain, "x-"), reaction), BRC_OK);
    free(force);
    return fabs(reaction[0]) > 0 ? most / fabs(reaction[0]) : 0;
}

static brc_status take(void *self, brc_simulation *s)
{
    curve *c = self;
    assert_true(c->n < MOST_SAMPLES);
    c->load[c->n] = brc_simulation_time(s);
    c->residual[c->n] = free_force(s);
    BRC_TRY(brc_simulation_failure_ratio(s, &c->ratio[c->n]));
    BRC_TRY(brc_simulation_broken(s, &c->broken[c->n]));
    BRC_TRY(brc_simulation_ledger(s, &c->ledger[c->n]));
    if (c->end_at > 0 && c->n == c->end_at) brc_simulation_end_stage(s, "the test has seen enough");
    c->n += 1;
    return BRC_OK;
}

static void run(bench_case *c, fracture_options o, curve *seen)
{
    if (!o.fracture) o.fracture = CRITERION;
    if (!o.strength) o.strength = STRENGTH;
    if (!o.elements) o.elements = 300;
    open_fracture(c, o);
    const brc_observer observer = {.self = seen, .sample = take};
    assert_done(c, brc_simulation_observe(c->simulation, &observer));
    assert_done(c, brc_simulation_run(c->simulation));
}

/* At its load every event stands in equilibrium with the worst element at its limit and nothing beyond it: to 1e-9, the
 * tolerance that puts elements into one event. Residuals: those of the solver, 1e-10 of the largest load, with some
 * room for the sum over a wall against one element. */
static void every_event_happens_where_one_element_is_at_its_limit(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {0};
    run(&c, (fracture_options){.stages = PULLED("events: 12", "10 um")}, &seen);
    assert_int_equal(seen.n, 14); /* no load, 12 events, what would come next */
    assert_true(seen.load[0] == 0);
    for (int k = 1; k < seen.n; ++k) {
        assert_true(seen.ratio[k] >= 1 && seen.ratio[k] <= 1 + 1e-9);
        assert_true(seen.broken[k] >= k - 1 && seen.broken[k] > seen.broken[k - 1] - (k == 1));
        if (!(seen.residual[k] < 1e-8)) fail_msg("residual %g at event %d", seen.residual[k], k);
    }
    const brc_break *list;
    int64_t n;
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &list));
    for (int64_t k = 0; k < n; ++k) {
        assert_true(list[k].step >= 1 && list[k].step <= 12 && list[k].time == 0 && list[k].stage == 0);
        assert_true(list[k].load == seen.load[list[k].step]);
        assert_true(list[k].energy > 0 && list[k].area > 0);
    }
    close_case(&c);
}

/* The first event of the linear law against the load that a plain static stage asks for, by another path: the failure
 * ratio at a load far below, in proportion. Both solves end within 1e-10 of the
 * load. */
static void the_first_event_is_the_elastic_limit(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {0}, elastic = {0};
    run(&c, (fracture_options){.stages = PULLED("events: 1, finite_strain: false", "10 um")}, &seen);
    close_case(&c);
    run(&c, (fracture_options){.stages = PULLED("finite_strain: false", "1 um")}, &elastic);
    assert_true(fabs(0.1 / elastic.ratio[1] / seen.load[1] - 1) < 1e-8);
    close_case(&c);
}

/* Ten times the load: the same bonds in the same order at a tenth of its factor. Both solves end within 1e-10 of the
 * load. */
static void the_unit_of_the_load_does_not_matter(void **state)
{
    (void)state;
    bench_case a, b;
    curve x = {0}, y = {0};
    const brc_break *p, *q;
    int64_t n, m;
    run(&a, (fracture_options){.stages = PULLED("events: 8", "10 um")}, &x);
    run(&b, (fracture_options){.stages = PULLED("events: 8", "100 um")}, &y);
    assert_done(&a, brc_simulation_breaks(a.simulation, &n, &p));
    assert_done(&b, brc_simulation_breaks(b.simulation, &m, &q));
    assert_int_equal(n, m);
    for (int64_t k = 0; k < n; ++k)
        assert_int_equal(p[k].bond, q[k].bond);
    for (int k = 1; k < x.n; ++k)
        assert_true(fabs(10 * y.load[k] / x.load[k] - 1) < 1e-7);
    close_case(&a), close_case(&b);
}

/* Events are a matter of whole sums in a fixed order: equal bytes. */
static void threads_do_not_matter(void **state)
{
    (void)state;
    bench_case c;
    brc_break *first = NULL;
    int64_t n_first = 0;
    for (int k = 0; k < 2; ++k) {
        curve seen = {0};
        const brc_break *list;
        int64_t n;
        run(&c,
            (fracture_options){.stages = PULLED("events: 4, finite_strain: false, tolerance: 1e-8", "10 um"),
                               .n_threads = k + 1,
                               .exact = true},
            &seen);
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &list));
        if (k == 0) {
            n_first = n;
            first = calloc((size_t)n, sizeof *first);
            memcpy(first, list, (size_t)n * sizeof *first);
        }
        assert_int_equal(n, n_first);
        assert_memory_equal(list, first, (size_t)n * sizeof *first);
        close_case(&c);
    }
    free(first);
}

/* What breaking and coming to rest set free is booked, so the ledger of the full law closes as that of a static load
 * does: to the trapezoidal rule over the paths between the events, whose forces are straight to the strain, 2e-4 at
 * failure. Energy is only ever lost. */
static void the_ledger_closes_and_energy_is_only_lost(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {0};
    run(&c, (fracture_options){.stages = PULLED("events: 20", "10 um")}, &seen);
    for (int k = 1; k < seen.n; ++k) {
        if (!(fabs(seen.ledger[k].closure) < 2e-4)) fail_msg("closure %g at event %d", seen.ledger[k].closure, k);
        if (k == 1) continue;
        assert_true(seen.ledger[k].fracture > seen.ledger[k - 1].fracture);
        assert_true(seen.ledger[k].damping >= seen.ledger[k - 1].damping);
    }
    assert_true(seen.ledger[seen.n - 1].damping > 0);
    close_case(&c);
}

/* A dead load's failing load is its factor: the stage ends when that has fallen, or when the body comes apart, which is
 * then left without load. */
static void dead_loads_break_a_body_to_the_end(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {0};
    double most = 0;
    run(&c,
        (fracture_options){.stages = PUSHED("events: {most: 100000, below: 60 %}, tolerance: 1e-8"), .elements = 100},
        &seen);
    for (int k = 0; k < seen.n; ++k)
        most = fmax(most, seen.load[k]);
    const char *reason = brc_simulation_stage_reason(c.simulation, 0);
    if (strstr(reason, "below 60 %"))
        assert_true(seen.load[seen.n - 1] < 0.6 * most && seen.load[seen.n - 2] >= 0.6 * most);
    else
        assert_true(strstr(reason, "came apart") && brc_simulation_time(c.simulation) == 0);
    close_case(&c);
}

/* A pulled body breaks in two: its load falls to nothing and the stage ends by itself with the two ends in different
 * fragments. */
static void a_pulled_body_breaks_in_two(void **state)
{
    (void)state;
    bench_case c;
    static curve seen;
    seen = (curve){0};
    run(&c, (fracture_options){.stages = PULLED("events: 180, tolerance: 1e-8", "10 um"), .elements = 120}, &seen);
    const char *reason = brc_simulation_stage_reason(c.simulation, 0);
    assert_non_null(strstr(reason, "carries no load"));
    int32_t *fragment = calloc((size_t)c.domain->n_elements, sizeof *fragment);
    int64_t n;
    assert_done(&c, brc_simulation_fragments(c.simulation, fragment, &n));
    const brc_set *left = &c.domain->sets[brc_domain_find_set(c.domain, "x-")],
                  *right = &c.domain->sets[brc_domain_find_set(c.domain, "x+")];
    for (int64_t i = 0; i < left->n_members; ++i)
        for (int64_t j = 0; j < right->n_members; ++j)
            assert_true(fragment[left->members[i]] != fragment[right->members[j]]);
    free(fragment);
    close_case(&c);
}

static void an_observer_may_end_the_stage(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {.end_at = 4};
    run(&c, (fracture_options){.stages = PULLED("events: 12", "10 um")}, &seen);
    assert_int_equal(seen.n, 5);
    assert_string_equal(brc_simulation_stage_reason(c.simulation, 0), "the test has seen enough");
    close_case(&c);
}

/* Breaks of a dynamic stage after events come later in the stream, with their own times. */
static void a_dynamic_stage_breaks_on(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {0};
    run(&c,
        (fracture_options){
            .stages = PULLED("events: 5", "10 um") "  - name: burst\n    solver: {dynamic: {steps: 60}}\n    initial:\n"
                                                   "      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n"},
        &seen);
    const brc_break *list;
    int64_t n, events = 0;
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &list));
    for (int64_t k = 0; k < n; ++k) {
        events += list[k].stage == 0;
        if (k > 0) assert_true(list[k].step >= list[k - 1].step && list[k].time >= list[k - 1].time);
        if (list[k].stage == 1) assert_true(list[k].load == 0 && list[k].step > 5 && list[k].time > 0);
    }
    assert_true(events >= 5 && n > events);
    close_case(&c);
}

/* Lower precisions meet the limit to their rounding and break the same kind of bonds: the first load to 1e-4, single
 * precision's strain at the failing load over its rounding. */
static void single_precision_finds_the_same_first_load(void **state)
{
    (void)state;
    bench_case c;
    curve a = {0}, b = {0};
    run(&c, (fracture_options){.stages = PULLED("events: 5", "10 um")}, &a);
    close_case(&c);
    run(&c, (fracture_options){.stages = PULLED("events: 5", "10 um"), .precision = BRC_SINGLE}, &b);
    assert_true(fabs(b.load[1] / a.load[1] - 1) < 1e-3);
    assert_int_equal(b.n, 7);
    close_case(&c);
}

/* Cells with a strength that scatters, so that no two bonds fail together: the same promises. Each bond's own limit,
 * 2e-4 of E: the first event lies near the strain of its weakest bond, below that without scatter. The ledger closes to
 * the strain, and what fails in tension looks along the pull, within 60 degrees. */
static void bonds_of_cells_break_one_by_one(void **state)
{
    (void)state;
    bench_case c;
    curve seen = {0};
    const brc_break *list;
    int64_t n;
    open_case(&c,
              (case_options){
                  .materials = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 2e-4 Pa, scatter: "
                               "{weibull: {modulus: 20}}}}",
                  .gravity = "fracture: {}\n",
                  .shape = "{box: {size: [1 m, 0.5 m, 0.5 m]}}",
                  .fill = "cells: [8, 4, 4], spread: 50 %, seed: 3",
                  .stages =
                      "  - name: crack\n    solver: {static: {events: 12, tolerance: 1e-9}}\n    loads:\n"
                      "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: x+, x: 100 um}\n"});
    const brc_observer observer = {.self = &seen, .sample = take};
    assert_done(&c, brc_simulation_observe(c.simulation, &observer));
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_int_equal(seen.n, 14);
    assert_true(seen.load[1] > 1 && seen.load[1] < 2);
    for (int k = 1; k < seen.n; ++k) {
        assert_true(seen.ratio[k] >= 1 && seen.ratio[k] <= 1 + 1e-9);
        assert_true(fabs(seen.ledger[k].closure) < 1e-3);
    }
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &list));
    assert_true(n >= 12);
    for (int64_t k = 0; k < n; ++k) {
        assert_true(list[k].load == seen.load[list[k].step] && list[k].area > 0);
        if (list[k].mode == BRC_BREAK_TENSION) assert_true(fabs(list[k].normal[0]) > 0.5);
    }
    close_case(&c);
}

static void refuse(const char *stages, const char *sentence)
{
    bench_case c;
    open_fracture(&c,
                  (fracture_options){.fracture = CRITERION, .strength = STRENGTH, .stages = stages, .elements = 100});
    assert_int_equal(brc_simulation_run(c.simulation), BRC_BAD_INPUT);
    if (!strstr(brc_context_message(c.context), sentence)) fail_msg("%s", brc_context_message(c.context));
    close_case(&c);
}

static void loads_that_do_not_scale_are_refused(void **state)
{
    (void)state;
    refuse(EVENTS("events: 5", "      - element_displacement: {set: x-, x: 0}\n"
                               "      - element_displacement: {set: x+, x: 1 um, table: [[0, 0], [0.5, 1], [1, 1]]}\n"),
           "cannot follow a table");
    refuse(PULLED("events: 5", "0 m"), "comes nearer to failure");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_event_happens_where_one_element_is_at_its_limit),
        cmocka_unit_test(the_first_event_is_the_elastic_limit),
        cmocka_unit_test(the_unit_of_the_load_does_not_matter),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(the_ledger_closes_and_energy_is_only_lost),
        cmocka_unit_test(dead_loads_break_a_body_to_the_end),
        cmocka_unit_test(a_pulled_body_breaks_in_two),
        cmocka_unit_test(an_observer_may_end_the_stage),
        cmocka_unit_test(a_dynamic_stage_breaks_on),
        cmocka_unit_test(single_precision_finds_the_same_first_load),
        cmocka_unit_test(bonds_of_cells_break_one_by_one),
        cmocka_unit_test(loads_that_do_not_scale_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
