/* Steps of a device that works beside the host: nobody waits in them while nothing breaks, and what breaks is what
 * breaks where the host knows each step. */
#include "../../../../host/base/log.h"
#include "../../../../host/solver/effects/fracture/ahead.h"
#include "../../../skip.h"
#include "../contact/contact_case.h"
#include "fracture_case.h"
#include <stdlib.h>
#include <string.h>

#define DEVICE "opencl:0"
#define MOVE                                                                                                           \
    "  - name: move\n    solver: {dynamic: {steps: 4000}}\n    initial:\n      - velocity: {gradient: {x: [1e-3 1/s, " \
    "0, 0]}}\n"
/* So slowly that surfaces need looking after every 64 steps. */
#define SWING                                                                                                          \
    "  - name: swing\n    solver: {dynamic: {steps: 4000}}\n    initial:\n      - velocity: {gradient: {x: [1e-5 "     \
    "1/s, "                                                                                                            \
    "0, 0]}}\n"
/* Slowly apart, so that bonds break one by one after some hundred steps, with calm in between. */
#define PULL(more)                                                                                                     \
    "  - name: pull\n    solver: {dynamic: {steps: 430, time_step: 0.04 s, mass_damping: 0.2 1/s}}\n    loads:\n     " \
    " - face_displacement: {set: x-, x: 0}\n"                                                                          \
    "      - face_velocity: {set: x+, x: 1e-5 m/s}\n" more
#define PULL_STRENGTH                                                                                                  \
    "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 2e-4 Pa, scatter: {weibull: {modulus: 8}}}}"

/* Work of n steps that are taken at once, after some that are not counted. */
static brc_device_counts work_of(case_options o, int64_t n)
{
    bench_case c;
    o.device = DEVICE;
    open_case(&c, o);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 4 * BRC_AHEAD_MOST));
    const brc_device_counts before = brc_device_counted(c.device);
    assert_done(&c, brc_simulation_advance(c.simulation, n));
    brc_device_counts now = brc_device_counted(c.device);
    close_case(&c);
    now.launches -= before.launches, now.waits -= before.waits, now.read_bytes -= before.read_bytes,
        now.written_bytes -= before.written_bytes;
    now.copied_bytes -= before.copied_bytes;
    return now;
}

enum { STEPS = 4 * BRC_AHEAD_MOST };

/* Passes of a step, and one more that closes the last of a call. */
static void elastic_steps_are_few_launches_and_nobody_waits(void **state)
{
    (void)state;
    const struct {
        const char *model;
        int64_t launches;
    } cases[] = {{"dlsm", 5}, {"dlsm-published", 4}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const brc_device_counts work = work_of((case_options){.model = cases[k].model, .stages = MOVE}, STEPS);
        const int64_t close = strcmp(cases[k].model, "dlsm") == 0 ? 1 : 2;
        assert_int_equal(work.launches, cases[k].launches * STEPS + close);
        assert_int_equal(work.waits, 0);
        assert_int_equal(work.read_bytes + work.written_bytes + work.copied_bytes, 0);
    }
}

/* Held faces: in the passes of their elements, and one launch where what they are held at changes. Prescribed elements
 * of two loads: one launch that moves them, one that books. */
static void loads_on_few_elements_are_few_launches(void **state)
{
    (void)state;
    const struct {
        const char *model, *loads;
        int64_t launches, close;
    } cases[] = {
        {"dlsm", "    loads:\n      - face_displacement: {set: x-, x: 0}\n", 5, 1},
        {"dlsm",
         "    loads:\n      - face_displacement: {set: x-, x: 0}\n      - face_velocity: {set: x+, x: 1e-3 m/s}\n", 6,
         1},
        {"dlsm-published",
         "    loads:\n      - element_displacement: {set: left, x: 0}\n"
         "      - element_velocity: {set: right, x: 1e-3 m/s}\n",
         6, 3}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char stages[400];
        snprintf(stages, sizeof stages, "%s%s", MOVE, cases[k].loads);
        const brc_device_counts work =
            work_of((case_options){.model = cases[k].model,
                                   .stages = stages,
                                   .sets = "sets: {left: {elements: {wall: x-}}, right: {elements: {wall: x+}}}\n"},
                    STEPS);
        assert_int_equal(work.launches, cases[k].launches * STEPS + cases[k].close);
        assert_int_equal(work.waits, 0);
    }
}

/* Two more launches in a step, and one question after BRC_AHEAD_MOST of them. */
static void where_nothing_breaks_nobody_waits_but_at_the_end_of_a_stretch(void **state)
{
    (void)state;
    static const char *const models[] = {"dlsm", "dlsm-published"};
    for (size_t k = 0; k < sizeof models / sizeof *models; ++k) {
        const brc_device_counts without = work_of((case_options){.model = models[k], .stages = MOVE}, STEPS);
        const brc_device_counts with = work_of(
            (case_options){
                .model = models[k], .stages = MOVE, .materials = CELLS_STRENGTH("1 Pa"), .sets = CELLS_FRACTURE},
            STEPS);
        assert_int_equal(with.waits, STEPS / BRC_AHEAD_MOST);
        assert_int_equal(with.launches, without.launches + 2 * STEPS + STEPS / BRC_AHEAD_MOST);
    }
}

/* Stretches are as long as the guard takes from look to look: 1000 steps have four of them. What a stretch asks at its
 * end is what broke and how far surfaces moved. */
static void nobody_waits_between_looks_of_the_guard(void **state)
{
    (void)state;
    static const char *const models[] = {"dlsm", "dlsm-published"};
    static const struct {
        const char *keys;
        int64_t waits;
    } cases[] = {{CELLS_FRACTURE, 1}, {"interactions: {contact: {friction: 0.3}}\n", 1}, {CONTACT_KEYS, 2}};
    for (size_t m = 0; m < sizeof models / sizeof *models; ++m)
        for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
            bench_case c;
            open_case(&c, (case_options){.model = models[m],
                                         .device = DEVICE,
                                         .stages = SWING,
                                         .materials = CELLS_STRENGTH("1 Pa"),
                                         .sets = cases[k].keys});
            assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
            assert_done(&c, brc_simulation_advance(c.simulation, 10 * BRC_AHEAD_MOST));
            for (int stretch = 0; stretch < 4; ++stretch) {
                const brc_device_counts before = brc_device_counted(c.device);
                assert_done(&c, brc_simulation_advance(c.simulation, BRC_AHEAD_MOST));
                assert_int_equal(brc_device_counted(c.device).waits - before.waits, cases[k].waits);
            }
            close_case(&c);
        }
}

#define TOUCHING "interactions: {contact: {friction: 0.3}}\n"
#define SWING_BEAMS(rate)                                                                                              \
    TOUCHING "stages:\n  - name: swing\n    solver: {dynamic: {steps: 4000}}\n    initial:\n      - velocity: "        \
             "{gradient: {x: [" rate " 1/s, 0, 0]}}\n"

/* Beams ask what broke and how far surfaces moved, as cells do. */
static void nor_does_anybody_where_beams_may_touch(void **state)
{
    (void)state;
    for (int breaks = 0; breaks < 2; ++breaks) {
        bench_case c;
        fracture_options o = {.device = DEVICE, .stages = SWING_BEAMS("1e-5")};
        if (breaks)
            o.strength = "strength: {tension: 1 Pa}", o.fracture = "{criterion: {virial-principal: {level: 1}}}";
        open_fracture(&c, o);
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
        assert_done(&c, brc_simulation_advance(c.simulation, 10 * BRC_AHEAD_MOST));
        for (int stretch = 0; stretch < 4; ++stretch) {
            const brc_device_counts before = brc_device_counted(c.device);
            assert_done(&c, brc_simulation_advance(c.simulation, BRC_AHEAD_MOST));
            assert_int_equal(brc_device_counted(c.device).waits - before.waits, 1 + breaks);
        }
        close_case(&c);
    }
}

/* Surfaces that move a hundred times as fast, too fast to be left for 64 steps: each look is one wait, and what it
 * allows is taken at once. */
static void moving_surfaces_are_looked_at_once_in_many_steps(void **state)
{
    (void)state;
    for (int beams = 0; beams < 2; ++beams) {
        bench_case c;
        if (beams)
            open_fracture(&c, (fracture_options){.device = DEVICE, .stages = SWING_BEAMS("1e-3")});
        else
            open_case(&c, (case_options){.device = DEVICE, .stages = MOVE, .sets = TOUCHING});
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
        assert_done(&c, brc_simulation_advance(c.simulation, 1000));
        const brc_device_counts before = brc_device_counted(c.device);
        const int64_t lists = brc_contact_lists(c.simulation);
        assert_done(&c, brc_simulation_advance(c.simulation, 1000));
        const int64_t waits = brc_device_counted(c.device).waits - before.waits;
        assert_int_equal(brc_contact_lists(c.simulation), lists);
        assert_true(waits > 1000 / BRC_AHEAD_MOST && waits <= 1000 / BRC_AHEAD_FEWEST);
        close_case(&c);
    }
}

typedef struct outcome {
    int64_t n, again;
    brc_break *events;
    double *position; /* [n_elements][3] displacements, then velocities */
    int64_t n_numbers;
    brc_ledger ledger;
} outcome;

static void count_again(void *self, brc_log_level level, const char *line)
{
    (void)level;
    *(int64_t *)self += strstr(line, "are taken again") != NULL;
}

/* Who looks after every step leaves none to be taken ahead. */
static int64_t next_look(void *self, const brc_simulation *simulation, int64_t step)
{
    (void)self;
    (void)simulation;
    return step + 1;
}

static brc_status look(void *self, brc_simulation *simulation)
{
    (void)self;
    (void)simulation;
    return BRC_OK;
}

/* Cells, or, where `cells` is NULL, beams. */
static outcome run(const case_options *cells, const fracture_options *beams, bool looked_at)
{
    bench_case c;
    outcome out = {0};
    const brc_break *events = NULL;
    if (cells)
        open_case(&c, *cells);
    else
        open_fracture(&c, *beams);
    c.scene->output.history_every = 1000; /* no samples, which end batches */
    brc_log_set_level(c.context, BRC_LOG_DEBUG);
    brc_log_set_sink(c.context, count_again, &out.again);
    if (looked_at)
        assert_done(&c, brc_simulation_observe(c.simulation, &(brc_observer){.next_look = next_look, .look = look}));
    assert_done(&c, brc_simulation_run(c.simulation));
    if (c.scene->has_fracture) assert_done(&c, brc_simulation_breaks(c.simulation, &out.n, &events));
    out.events = malloc((size_t)(out.n + 1) * sizeof *out.events);
    out.n_numbers = 3 * c.domain->n_elements;
    out.position = malloc(2 * (size_t)out.n_numbers * sizeof *out.position);
    assert_true(out.events && out.position);
    if (out.n > 0) memcpy(out.events, events, (size_t)out.n * sizeof *events);
    assert_done(&c, brc_simulation_displacement(c.simulation, out.position));
    assert_done(&c, brc_simulation_velocity(c.simulation, out.position + out.n_numbers));
    assert_done(&c, brc_simulation_ledger(c.simulation, &out.ledger));
    close_case(&c);
    return out;
}

static void assert_same_either_way(const case_options *cells, const fracture_options *beams, int64_t breaks,
                                   int64_t again)
{
    const outcome known = run(cells, beams, true), ahead = run(cells, beams, false);
    assert_int_equal(known.again, 0);
    assert_true(ahead.again >= again); /* calm, and a break after it, more than once */
    assert_true(known.n >= breaks);
    assert_int_equal(known.n, ahead.n);
    if (known.n > 0) assert_memory_equal(known.events, ahead.events, (size_t)known.n * sizeof *known.events);
    assert_memory_equal(known.position, ahead.position, 2 * (size_t)known.n_numbers * sizeof *known.position);
    assert_memory_equal(&known.ledger, &ahead.ledger, sizeof known.ledger);
    free(known.events);
    free(known.position);
    free(ahead.events);
    free(ahead.position);
}

static void assert_same(case_options o)
{
    o.device = DEVICE;
    assert_same_either_way(&o, NULL, 20, 2);
}

static void steps_ahead_have_the_bits_of_steps_that_are_known(void **state)
{
    (void)state;
    assert_same((case_options){.stages = PULL(""), .materials = PULL_STRENGTH, .sets = CELLS_FRACTURE});
    assert_same((case_options){.stages = PULL("      - traction: {set: y+, y: 1e-6 Pa}\n"),
                               .materials = PULL_STRENGTH,
                               .sets = "fracture: {criterion: {virial-principal: {level: 1}}}\n"});
    assert_same((case_options){.model = "dlsm-published",
                               .materials = PULL_STRENGTH,
                               .sets = CELLS_FRACTURE
                               "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\n",
                               .stages = "  - name: pull\n    solver: {dynamic: {steps: 430, time_step: 0.04 s}}\n    "
                                         "loads:\n      - element_displacement: {set: left, x: 0}\n"
                                         "      - element_velocity: {set: right, x: 1e-5 m/s}\n"});
}

#define PULL_BEAMS(keys)                                                                                               \
    keys "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\nstages:\n  - name: pull\n    "       \
         "solver: "                                                                                                    \
         "{dynamic: {steps: 900}}\n    loads:\n      - element_displacement: {set: left, x: 0}\n      - "              \
         "element_velocity: {set: right, x: 1e-5 m/s}\n"
#define BEAMS                                                                                                          \
    .device = DEVICE, .strength = "strength: {tension: 2e-4 Pa, scatter: {weibull: {modulus: 8}}}",                    \
    .fracture = "{criterion: {virial-principal: {level: 1}}}"

/* Surfaces remember friction and impacts, strikers where they are. */
static void so_they_have_where_surfaces_touch(void **state)
{
    (void)state;
    assert_same((case_options){
        .stages = PULL(""),
        .materials = PULL_STRENGTH,
        .sets = CONTACT_KEYS,
        .gravity =
            "strikers:\n  ball: {shape: {sphere: {radius: 0.25 m, centre: [0.5 m, 0.45 m, 1.2505 m]}}, facets: 24, "
            "material: stone, motion: {free: {velocity: [0, 1e-4 m/s, -1e-3 m/s]}}}\n"});
    const fracture_options beams = {
        BEAMS, .stages = PULL_BEAMS("interactions: {contact: {friction: 0.3, restitution: 0.7}}\n")};
    assert_same_either_way(NULL, &beams, 20, 2);
}

/* Nothing breaks; a ball comes down after calm. */
static void so_have_those_before_surfaces_meet(void **state)
{
    (void)state;
    const case_options meeting = {
        .device = DEVICE,
        .stages = "  - name: fall\n    solver: {dynamic: {steps: 1200, time_step: 0.04 s}}\n",
        .sets = "interactions: {contact: {friction: 0.3, restitution: 0.7}}\n",
        .gravity = "strikers:\n  ball: {shape: {sphere: {radius: 0.25 m, centre: [0.5 m, 0.45 m, 1.28 m]}}, facets: "
                   "24, material: stone, motion: {free: {velocity: [0, 1e-4 m/s, -1e-3 m/s]}}}\n"};
    assert_same_either_way(&meeting, NULL, 0, 1);
}

/* Broken beams bear from the first one on: passes that a stretch before it leaves out. */
static void so_have_those_before_the_first_beam_breaks(void **state)
{
    (void)state;
    const fracture_options beams = {BEAMS, .stages = PULL_BEAMS("")};
    assert_same_either_way(NULL, &beams, 20, 1);
}

static void beams_that_do_not_break_are_two_launches_more(void **state)
{
    (void)state;
    fracture_options o = {.device = DEVICE, .stages = PULL_BEAMS("")};
    int64_t launches[2];
    for (int with = 0; with < 2; ++with) {
        bench_case c;
        if (with) o.strength = "strength: {tension: 1 Pa}", o.fracture = "{criterion: {virial-principal: {level: 1}}}";
        open_fracture(&c, o);
        assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
        const int64_t before = brc_device_counted(c.device).launches;
        assert_done(&c, brc_simulation_advance(c.simulation, STEPS));
        launches[with] = brc_device_counted(c.device).launches - before;
        close_case(&c);
    }
    assert_in_range(launches[1] - launches[0], 2 * STEPS, 2 * STEPS + 8 * (STEPS / BRC_AHEAD_MOST));
}

/* Steps by which bonds break one after another: the least and the most waits of one in which some do, without the one
 * that tells how many broke. */
static void waits_of_breaks(const case_options *o, int64_t *least, int64_t *most)
{
    bench_case c;
    const brc_break *events = NULL;
    int64_t n = 0;
    *least = INT64_MAX;
    *most = 0;
    open_case(&c, *o);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    for (int step = 0; step < 430; ++step) {
        const int64_t before = brc_device_counted(c.device).waits, had = n;
        assert_done(&c, brc_simulation_advance(c.simulation, 1));
        const int64_t waits = brc_device_counted(c.device).waits - before;
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
        if (n == had) continue;
        *least = waits < *least ? waits : *least;
        *most = waits > *most ? waits : *most;
    }
    assert_true(n > 20);
    close_case(&c);
}

/* What broke and its rings, what is left and the rings around it, and all sums: a wait each. Where nothing broke in the
 * step before, one more tells that something does; where elements come off with the bonds they have left, three more
 * for each time. Contact looks for surfaces. */
static void steps_in_which_bonds_break_wait_three_times(void **state)
{
    (void)state;
    const struct {
        case_options o;
        int64_t least, most;
    } cases[] = {
        {{.device = DEVICE, .stages = PULL(""), .materials = PULL_STRENGTH, .sets = CELLS_FRACTURE}, 3, 7},
        {{.device = DEVICE,
          .model = "dlsm-published",
          .materials = PULL_STRENGTH,
          .sets = CELLS_FRACTURE "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\n",
          .stages = "  - name: pull\n    solver: {dynamic: {steps: 430, time_step: 0.04 s}}\n    loads:\n      - "
                    "element_displacement: {set: left, x: 0}\n      - element_velocity: {set: right, x: 1e-5 "
                    "m/s}\n"},
         3,
         4},
        {{.device = DEVICE, .stages = PULL(""), .materials = PULL_STRENGTH, .sets = CONTACT_KEYS}, 12, 28}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        int64_t least, most;
        waits_of_breaks(&cases[k].o, &least, &most);
        assert_int_equal(least, cases[k].least);
        assert_int_equal(most, cases[k].most);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(elastic_steps_are_few_launches_and_nobody_waits),
                                       cmocka_unit_test(loads_on_few_elements_are_few_launches),
                                       cmocka_unit_test(where_nothing_breaks_nobody_waits_but_at_the_end_of_a_stretch),
                                       cmocka_unit_test(steps_ahead_have_the_bits_of_steps_that_are_known),
                                       cmocka_unit_test(so_they_have_where_surfaces_touch),
                                       cmocka_unit_test(nobody_waits_between_looks_of_the_guard),
                                       cmocka_unit_test(nor_does_anybody_where_beams_may_touch),
                                       cmocka_unit_test(moving_surfaces_are_looked_at_once_in_many_steps),
                                       cmocka_unit_test(so_have_those_before_surfaces_meet),
                                       cmocka_unit_test(steps_in_which_bonds_break_wait_three_times),
                                       cmocka_unit_test(so_have_those_before_the_first_beam_breaks),
                                       cmocka_unit_test(beams_that_do_not_break_are_two_launches_more)};
    if (!device_is_there(DEVICE)) return test_skip("there is no such device with double precision");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
