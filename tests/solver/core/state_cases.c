#include "state_cases.h"
#include "../../skip.h"
#include <stdlib.h>
#include <string.h>

memory_item *memory_store_find(memory_store *m, int32_t part, const char *name)
{
    for (int i = 0; i < m->n; ++i)
        if (m->item[i].part == part && strcmp(m->item[i].name, name) == 0) return &m->item[i];
    return NULL;
}

static brc_status numbers(brc_state_store *store, const char *name, brc_stored_type type, int64_t rows, int32_t columns,
                          void *data)
{
    memory_store *m = store->self;
    memory_item *item = memory_store_find(m, store->part, name);
    const size_t bytes = (size_t)rows * (size_t)columns * (size_t)brc_stored_type_bytes(type);
    if (store->loading) {
        if (!item || item->rows != rows || item->columns != columns || item->type != type)
            return BRC_FAIL(m->context, BRC_BAD_INPUT, "no %s", name);
        if (bytes) memcpy(data, item->data, bytes);
        return BRC_OK;
    }
    assert_null(item); /* every name once */
    assert_true(m->n < (int)(sizeof m->item / sizeof *m->item) && strlen(name) < sizeof m->item->name);
    item = &m->item[m->n++];
    *item = (memory_item){
        .part = store->part, .columns = columns, .type = type, .rows = rows, .data = calloc(1, bytes + 1)};
    strcpy(item->name, name);
    if (bytes) memcpy(item->data, data, bytes);
    return BRC_OK;
}

static brc_status count(brc_state_store *store, const char *name, int64_t *rows)
{
    memory_store *m = store->self;
    const memory_item *item = memory_store_find(m, store->part, name);
    if (!item) return BRC_FAIL(m->context, BRC_BAD_INPUT, "no %s", name);
    *rows = item->rows;
    return BRC_OK;
}

void memory_store_begin(memory_store *m, brc_context *context)
{
    memset(m, 0, sizeof *m);
    m->context = context;
    m->store = (brc_state_store){.self = m, .numbers = numbers, .count = count};
}

void memory_store_free(memory_store *m)
{
    for (int i = 0; i < m->n; ++i)
        free(m->item[i].data);
    m->n = 0;
}

void assert_same_store(const memory_store *a, const memory_store *b)
{
    assert_int_equal(a->n, b->n);
    for (int i = 0; i < a->n; ++i) {
        const memory_item *x = &a->item[i], *y = &b->item[i];
        const size_t bytes = (size_t)x->rows * (size_t)x->columns * (size_t)brc_stored_type_bytes(x->type);
        if (strcmp(x->name, y->name) != 0 || x->rows != y->rows || memcmp(x->data, y->data, bytes) != 0)
            fail_msg("%s differs", x->name);
    }
}

/* An observer that keeps the state of every pause in turn, and one of them for good. */
typedef struct watcher {
    memory_store last, chosen;
    int n, choose;
} watcher;

static brc_status keep(memory_store *m, brc_simulation *simulation)
{
    memory_store_free(m);
    return brc_lockstep_save(1, &simulation, &m->store);
}

static brc_status pause_here(void *self, brc_simulation *simulation, brc_pause why)
{
    watcher *w = self;
    (void)why;
    if (++w->n == w->choose) BRC_TRY(keep(&w->chosen, simulation));
    return keep(&w->last, simulation);
}

static void open_state(bench_case *c, const state_case *of)
{
    if (of->cells)
        open_case(c, *of->cells);
    else
        open_fracture(c, *of->beams);
}

int state_resumes(state_case of, const int *pauses)
{
    int n = 0;
    for (; *pauses > 0; ++pauses) {
        bench_case whole, again;
        static watcher w, v; /* some 100 kB each */
        open_state(&whole, &of);
        w.n = 0;
        w.choose = *pauses;
        memory_store_begin(&w.last, whole.context);
        memory_store_begin(&w.chosen, whole.context);
        assert_done(&whole, brc_simulation_observe(whole.simulation, &(brc_observer){.self = &w, .pause = pause_here}));
        assert_done(&whole, brc_simulation_run(whole.simulation));
        assert_true(w.n > *pauses);
        n = w.n;
        open_state(&again, &of);
        v.n = 0;
        v.choose = 0;
        memory_store_begin(&v.last, again.context);
        memory_store_begin(&v.chosen, again.context);
        w.chosen.context = again.context;
        w.chosen.store.loading = true;
        assert_done(&again, brc_lockstep_load(1, &again.simulation, &w.chosen.store));
        assert_done(&again, brc_simulation_observe(again.simulation, &(brc_observer){.self = &v, .pause = pause_here}));
        assert_done(&again, brc_lockstep_continue(1, &again.simulation, &w.chosen.store));
        assert_int_equal(v.n, w.n - *pauses);
        assert_same_store(&w.last, &v.last);
        memory_store_free(&w.last), memory_store_free(&w.chosen), memory_store_free(&v.last),
            memory_store_free(&v.chosen);
        close_case(&whole);
        close_case(&again);
    }
    return n;
}

void state_is_refused_forged(case_options options, int64_t steps, const char *name, state_forgery forge,
                             const char *words)
{
    static memory_store store;
    bench_case a, b;
    open_case(&a, options);
    assert_done(&a, brc_simulation_begin_stage(a.simulation, 0));
    assert_done(&a, brc_simulation_advance(a.simulation, steps));
    memory_store_begin(&store, a.context);
    assert_done(&a, brc_lockstep_save(1, &a.simulation, &store.store));
    memory_item *item = memory_store_find(&store, 0, name);
    assert_non_null(item);
    forge(item, &a);
    open_case(&b, options);
    store.context = b.context;
    store.store.loading = true;
    assert_int_equal(brc_lockstep_load(1, &b.simulation, &store.store), BRC_BAD_INPUT);
    if (!strstr(brc_context_message(b.context), words))
        fail_msg("'%s' is not in: %s", words, brc_context_message(b.context));
    memory_store_free(&store);
    close_case(&a), close_case(&b);
}

static void rename_it(memory_item *item, const bench_case *of)
{
    (void)of;
    strcpy(item->name, "other");
}

void state_is_refused_without(case_options options, int64_t steps, int n, const char *const *needed)
{
    for (int k = 0; k < n; ++k)
        state_is_refused_forged(options, steps, needed[k], rename_it, needed[k]);
}

/* All kinds of loads of cells, and both integrators: a static stage of three increments, then two dynamic ones. */
static const char *const cells_stages =
    "  - name: load\n    solver: {static: {increments: 3, tolerance: 1e-4}}\n    loads:\n      - face_displacement: "
    "{set: x-, x: 0, y: 0, z: 0}\n"
    "      - traction: {set: x+, x: 1e-4 Pa}\n"
    "  - name: swing\n    solver: {dynamic: {steps: 40, mass_damping: 0.1 1/s}}\n    initial:\n      - random: "
    "{amplitude: [1e-3 m/s, 1e-3 m/s, 0], seed: 3}\n"
    "    loads:\n      - face_velocity: {set: x-, x: 1e-3 m/s}\n      - traction: {set: y+, z: 1e-4 Pa, table: [[0 s, "
    "0], [1 s, 1]]}\n"
    "  - name: hold\n    solver: {dynamic: {steps: 30, integrator: tchamwa-wielgosz}}\n    loads:\n      - "
    "element_velocity: {set: left, x: 1e-3 m/s}\n"
    "      - element_force: {set: right, z: 1e-5 N}\n";

void state_resumes_on(const char *device, brc_precision precision)
{
    case_options cells = {.stages = cells_stages,
                          .gravity = "gravity: [0, 0, -1e-4 m/s^2]\n",
                          .sets = "sets:\n  left:\n    elements: {wall: x-}\n  right:\n    elements: {wall: x+}\n",
                          .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                          .device = device,
                          .precision = precision,
                          .n_threads = 1};
    state_resumes((state_case){.cells = &cells}, precision == BRC_DOUBLE ? (int[]){2, 20, 43, 60, 0} : (int[]){43, 0});
    case_options published = {.model = "dlsm-published",
                              .stages = "  - name: move\n    solver: {dynamic: {steps: 30}}\n    initial:\n      - "
                                        "spin: {angular_velocity: [0, 0, 1e-2 rad/s]}\n",
                              .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                              .device = device,
                              .precision = precision,
                              .n_threads = 1};
    state_resumes((state_case){.cells = &published}, (int[]){10, 0});
    case_options shatter = {.stages = CELLS_BURST(80),
                            .materials = CELLS_STRENGTH("2e-4 Pa"),
                            .sets = CELLS_FRACTURE,
                            .device = device,
                            .precision = precision,
                            .n_threads = 1};
    state_resumes((state_case){.cells = &shatter}, (int[]){50, 0});
    case_options crush = shatter; /* broken faces that are shut */
    crush.stages = CELLS_CRUSH(120, "0.8");
    crush.fill = "cells: [4, 4, 4], spread: 90 %, seed: 1";
    state_resumes((state_case){.cells = &crush}, (int[]){40, 80, 0});
    fracture_options beams = {.fracture = "{criterion: virial-principal}",
                              .strength = "strength: {tension: 2e-4 Pa}",
                              .stages = FRACTURE_BURST(120),
                              .device = device,
                              .precision = precision,
                              .n_threads = 1};
    state_resumes((state_case){.beams = &beams}, (int[]){60, 0});
}

void softening_resumes_on(const char *device, brc_precision precision)
{
    case_options cells = {.stages = CELLS_BURST(80),
                          .materials = CELLS_STRENGTH("2e-4 Pa, fracture_energy: 2e-8 J/m^2"),
                          .sets = CELLS_FRACTURE,
                          .device = device,
                          .precision = precision,
                          .n_threads = 1};
    state_resumes((state_case){.cells = &cells}, (int[]){30, 60, 0});
    case_options slide = cells;
    slide.stages = CELLS_CRUSH(80, "0.8");
    slide.materials = CELLS_STRENGTH("3e-4 Pa, fracture_energy: 1e-7 J/m^2, shear_fracture_energy: 3e-7 J/m^2");
    slide.sets = "fracture: {criterion: {mohr-coulomb: {cohesion: 3e-4 Pa, friction: 30 deg}}}\n";
    slide.fill = "cells: [4, 4, 4], spread: 90 %, seed: 1";
    state_resumes((state_case){.cells = &slide}, (int[]){40, 0});
    cells.model = "dlsm-published";
    cells.materials = CELLS_STRENGTH("2e-4 Pa");
    state_resumes((state_case){.cells = &cells}, (int[]){50, 0});
    fracture_options beams = {.fracture = "{criterion: virial-principal}",
                              .strength = "strength: {tension: 2e-4 Pa, fracture_energy: 1e-8 J/m^2}",
                              .stages = FRACTURE_BURST(120),
                              .device = device,
                              .precision = precision,
                              .n_threads = 1};
    state_resumes((state_case){.beams = &beams}, (int[]){40, 80, 0});
}

void contact_resumes_on(const char *device, brc_precision precision)
{
    /* fragments of cells that meet, rub and turn; and of spheres by Hertz */
    case_options cells = {
        .stages =
            "  - name: burst\n    solver: {dynamic: {steps: 300, time_step: {auto: {safety: 0.4}}}}\n    initial:\n"
            "      - velocity: {gradient: {x: [-4e-3 1/s, 1e-3 1/s, 0], y: [-2e-3 1/s, 3e-3 1/s, 1e-3 1/s], z: [0, 0, "
            "5e-3 1/s]}}\n",
        .sets = "fracture: {criterion: bond-normal}\ninteractions: {contact: {friction: 0.3, restitution: 0.7}}\n",
        .materials = CELLS_STRENGTH("2e-4 Pa"),
        .fill = "cells: [4, 4, 4], spread: 90 %, seed: 1",
        .device = device,
        .precision = precision,
        .n_threads = 1};
    state_resumes((state_case){.cells = &cells}, (int[]){200, 0});
    fracture_options beams = {.fracture = "{criterion: virial-principal}",
                              .strength = "strength: {tension: 2e-4 Pa}",
                              .device = device,
                              .precision = precision,
                              .n_threads = 1,
                              .elements = 300,
                              .stages = "interactions: {contact: {friction: 0.3, restitution: 0.7}}\nstages:\n  - "
                                        "name: burst\n    solver: {dynamic: {steps: 200}}\n    initial:\n"
                                        "      - velocity: {gradient: {x: [-4e-3 1/s, 1e-3 1/s, 0], y: [-2e-3 1/s, "
                                        "3e-3 1/s, 1e-3 1/s], z: [0, 0, 5e-3 1/s]}}\n"};
    state_resumes((state_case){.beams = &beams}, (int[]){120, 0});
}

static const char *tested_device;

static void it_goes_on_in_double(void **state)
{
    (void)state;
    state_resumes_on(tested_device, BRC_DOUBLE);
}
static void it_goes_on_in_mixed(void **state)
{
    (void)state;
    state_resumes_on(tested_device, BRC_MIXED);
}
static void it_goes_on_in_single(void **state)
{
    (void)state;
    state_resumes_on(tested_device, BRC_SINGLE);
}

static void softening_goes_on_in_all_precisions(void **state)
{
    (void)state;
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        softening_resumes_on(tested_device, (brc_precision)p);
}
static void contact_goes_on_in_all_precisions(void **state)
{
    (void)state;
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        contact_resumes_on(tested_device, (brc_precision)p);
}

int state_cases_run(const char *device)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_goes_on_in_double), cmocka_unit_test(it_goes_on_in_mixed),
                                       cmocka_unit_test(it_goes_on_in_single),
                                       cmocka_unit_test(softening_goes_on_in_all_precisions),
                                       cmocka_unit_test(contact_goes_on_in_all_precisions)};
    if (!device_is_there(device)) return test_skip("the device is not there, or has no double precision");
    tested_device = device;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
