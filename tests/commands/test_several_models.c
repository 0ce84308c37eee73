/* Bodies with models of their own: a bar of cells (dlsm) beside a packing of spheres (cbm), each in its own place and
 * turned. What one simulation for each must give is known exactly: what the two scenes give alone. */
#include "several_models.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/commands/run_scene.h"
#include "../../host/commands/setup.h"
#include "../../host/output/cracks/cracks.h"
#include "../../host/output/h5_read.h"
#include "../../host/scene/scene_reader.h"
#include "../../host/solver/run/lockstep.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void says(const char *part)
{
    const char *text = brc_context_message(context);
    if (!strstr(text, part)) fail_msg("\"%s\" is not in: %s", part, text);
    brc_context_clear(context);
}

typedef struct sample {
    brc_scene *scene;
    brc_setup setup;
} sample;

static const brc_device_request CPU = {.selector = "cpu", .precision = BRC_DOUBLE, .n_threads = 1};

static brc_status prepare(const char *text, sample *out)
{
    *out = (sample){0};
    BRC_TRY(brc_scene_read_text(context, "test", text, strlen(text), 0, NULL, &out->scene));
    BRC_TRY(brc_setup_domains(context, out->scene, NULL, 1, &out->setup));
    return brc_setup_simulations(context, &CPU, &out->setup);
}

static sample ready(const char *text)
{
    sample s;
    must(prepare(text, &s));
    return s;
}

static void release(sample *s)
{
    brc_setup_free(&s->setup);
    brc_scene_free(&s->scene);
}

static void run(sample *s)
{
    must(brc_lockstep_run(s->setup.n, s->setup.assembly.part));
}

/* Positions of the state, of one quantity by element. */
typedef brc_status (*reading)(brc_simulation *, double *);

static void assert_same(brc_simulation *a, brc_simulation *b, reading read)
{
    const int64_t n = brc_simulation_domain(a)->n_elements;
    double *values[2];
    assert_int_equal(n, brc_simulation_domain(b)->n_elements);
    for (int k = 0; k < 2; ++k) {
        must(BRC_ALLOCATE(context, &values[k], 3 * n, "test"));
        must(read(k == 0 ? a : b, values[k]));
    }
    assert_memory_equal(values[0], values[1], 3 * (size_t)n * sizeof(double));
    for (int k = 0; k < 2; ++k)
        brc_memory_free(values[k]);
}

static void assert_parts_are_the_scenes_alone(const char *both, const char *cells, const char *spheres)
{
    sample whole = ready(both), alone[2] = {ready(cells), ready(spheres)};
    assert_int_equal(whole.setup.n, 2);
    run(&whole);
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(alone[k].setup.n, 1);
        run(&alone[k]);
        brc_simulation *a = whole.setup.simulation[k], *b = alone[k].setup.simulation[0];
        assert_same(a, b, brc_simulation_displacement);
        assert_same(a, b, brc_simulation_velocity);
        assert_same(a, b, brc_simulation_force);
        brc_ledger one, other;
        must(brc_simulation_ledger(a, &one));
        must(brc_simulation_ledger(b, &other));
        assert_memory_equal(&one, &other, sizeof one);
        release(&alone[k]);
    }
    release(&whole);
}

static void each_body_moves_bit_for_bit_as_in_a_scene_of_its_own(void **state)
{
    (void)state;
    assert_parts_are_the_scenes_alone(BOTH SPIN QUIET, ALONE_CELLS SPIN QUIET, ALONE_SPHERES SPIN QUIET);
}

/* Static stage of three increments, then a dynamic one that starts from it. */
static void static_stages_are_solved_as_in_a_scene_of_its_own(void **state)
{
    (void)state;
#define STAGES(loads)                                                                                                  \
    "stages:\n  - name: pull\n    solver:\n      static: {increments: 3}\n    loads:\n"                                \
    "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n" loads                                              \
    "  - name: ring\n    solver:\n      dynamic: {steps: 20, time_step: 20 ns}\n"
#define FORCE_UP "      - element_force: {set: upper, x: 1 N, y: 2 N}\n"
#define FORCE_LOW "      - element_force: {set: lower, z: 3 N}\n"
    assert_parts_are_the_scenes_alone(BOTH "sets:\n" ENDS UPPER_SET LOWER_SET STAGES(FORCE_UP FORCE_LOW) QUIET,
                                      ALONE_CELLS "sets:\n" ENDS UPPER_SET STAGES(FORCE_UP) QUIET,
                                      ALONE_SPHERES "sets:\n" ENDS LOWER_SET STAGES(FORCE_LOW) QUIET);
}

/* Two bodies of cells whose models differ in a parameter; a third of the first model: it belongs to the first part. */
static void models_that_differ_in_a_parameter_are_parts_of_their_own(void **state)
{
    (void)state;
#define CUBE(name, x, model)                                                                                           \
    "  - name: " name                                                                                                  \
    "\n    shape:\n      box: {size: [1 m, 1 m, 1 m]}\n    fill:\n      noisy_grid: {cells: [2, 2, 2], seed: 1}\n"     \
    "    material: glass\n    pose: {translation: [" x ", 0, 0]}\n" model
    sample s = ready(
        MATERIALS "model: dlsm\nbodies:\n" CUBE("a", "0", "") CUBE("b", "2 m", "    model:\n      dlsm: {tau: 0.3}\n")
            CUBE("c", "4 m", "    model: dlsm\n") "stages:\n  - name: rest\n    solver:\n      dynamic: {steps: 1}\n");
    const brc_split *split = s.setup.split;
    assert_int_equal(split->n, 2);
    assert_string_equal(split->part[0].name, "dlsm");
    assert_string_equal(split->part[1].name, "dlsm-2");
    assert_int_equal(split->part[0].n_bodies, 2);
    assert_int_equal(split->part[0].body[1], 2);
    assert_int_equal(split->part[1].body[0], 1);
    assert_true(split->part[1].scene->model.tau == 0.3);
    assert_int_equal(brc_assembly_body(&s.setup.assembly, 0, 0), 0);
    assert_int_equal(brc_assembly_body(&s.setup.assembly, 0, 15), 2);
    assert_int_equal(brc_assembly_body(&s.setup.assembly, 1, 0), 1);
    release(&s);
}

/* Four modes of each of two cubes, 1 m and 0.9 m, that do not touch: the first four of all eight, ascending. */
static void modes_of_all_bodies_are_counted_together(void **state)
{
    (void)state;
#define SOLID(name, size, x)                                                                                           \
    "  - name: " name "\n    shape:\n      box: {size: [" size ", " size ", " size                                     \
    "]}\n    fill:\n      noisy_grid: {cells: [4, 4, 4], seed: 1}\n"                                                   \
    "    material: glass\n    pose: {translation: [" x ", 0, 0]}\n"
#define MODES "stages:\n  - name: ring\n    solver:\n      modes: {count: 4}\n"
    sample whole = ready(MATERIALS "bodies:\n" SOLID("a", "1 m", "0") "    model: dlsm\n" SOLID(
        "b", "90 cm", "2 m") "    model:\n      dlsm: {tau: 0.3}\n" MODES QUIET);
    sample alone[2] = {
        ready(MATERIALS "bodies:\n" SOLID("a", "1 m", "0") "    model: dlsm\n" MODES QUIET),
        ready(MATERIALS "bodies:\n" SOLID("b", "90 cm", "2 m") "    model:\n      dlsm: {tau: 0.3}\n" MODES QUIET)};
    const double *omega[2];
    int32_t n, at[2] = {0, 0};
    run(&whole);
    for (int k = 0; k < 2; ++k) {
        run(&alone[k]);
        omega[k] = brc_simulation_modes(alone[k].setup.simulation[0], &n);
        assert_int_equal(n, 4);
    }
    for (int32_t index = 0; index < 8; ++index) {
        const int k = at[1] == 4 || (at[0] < 4 && omega[0][at[0]] <= omega[1][at[1]]) ? 0 : 1;
        assert_true(brc_assembly_mode(&whole.setup.assembly, index) == omega[k][at[k]]);
        ++at[k];
    }
    assert_true(isnan(brc_assembly_mode(&whole.setup.assembly, 8)));
    release(&whole);
    for (int k = 0; k < 2; ++k)
        release(&alone[k]);
}

/* All bodies have one model of their own: it is the scene's, which stays whole. */
static void a_scene_of_one_model_is_its_own_only_part(void **state)
{
    (void)state;
    sample s =
        ready(MATERIALS "bodies:\n" CELLS
                        "    model: dlsm-published\nstages:\n  - name: rest\n    solver:\n      dynamic: {steps: 1}\n");
    assert_int_equal(s.setup.n, 1);
    assert_ptr_equal(s.setup.split->part[0].scene, s.scene);
    assert_int_equal(s.scene->model.kind, BRC_MODEL_DLSM_PUBLISHED);
    assert_null(s.setup.assembly.split);
    release(&s);
}

#define AUTO "stages:\n  - name: fly\n    solver:\n      dynamic: {duration: 5 us}\n"
static void all_take_the_shortest_of_the_automatic_steps_and_end_together(void **state)
{
    (void)state;
    sample whole = ready(BOTH AUTO QUIET), cells = ready(ALONE_CELLS AUTO QUIET),
           spheres = ready(ALONE_SPHERES AUTO QUIET);
    double least = INFINITY;
    sample *const alone[2] = {&cells, &spheres};
    for (int k = 0; k < 2; ++k) {
        brc_time_step step;
        must(brc_simulation_find_time_step(alone[k]->setup.simulation[0], 0, &step));
        least = fmin(least, step.value);
    }
    run(&whole);
    const brc_time_step shared = brc_assembly_time_step(&whole.setup.assembly);
    assert_true(shared.value == least);
    assert_true(fabs(shared.safety - 0.8) < 1e-12); /* the default of the part that governs */
    for (int k = 0; k < 2; ++k) {
        assert_true(brc_simulation_time_step(whole.setup.simulation[k]).value == least);
        assert_int_equal(brc_simulation_total_steps(whole.setup.simulation[k]), (int64_t)ceil(5e-6 / least - 1e-9));
    }
    release(&whole);
    release(&cells);
    release(&spheres);
}

/* 5 N over all elements by number, 3 N by mass: sums and single forces. */
static void a_total_force_over_both_models_is_shared_out(void **state)
{
    (void)state;
    sample s =
        ready(BOTH "sets:\n" ALL_SET
                   "stages:\n  - name: push\n    solver:\n      dynamic: {steps: 1, time_step: 1 ns}\n    loads:\n"
                   "      - element_force: {set: everything, x: 5 N}\n      - element_force: {set: everything, y: 3 N, "
                   "share: mass}\n" QUIET);
    run(&s);
    const int64_t n = brc_setup_n_elements(&s.setup);
    double sum[3] = {0}, mass = 0;
    for (int k = 0; k < 2; ++k)
        mass += brc_split_mass(&s.setup.split->part[k], s.setup.domain[k]);
    for (int k = 0; k < 2; ++k) {
        const brc_domain *d = s.setup.domain[k];
        double *f;
        must(BRC_ALLOCATE(context, &f, 3 * d->n_elements, "test"));
        must(brc_simulation_applied_force(s.setup.simulation[k], f));
        for (int64_t e = 0; e < d->n_elements; ++e) {
            const double m = d->volume[e] * (k == 0 ? 2500 : 7800);
            assert_near(f[3 * e], 5.0 / (double)n, 1e-14); /* rounding of two quotients of order 0.01 */
            assert_near(f[3 * e + 1], 3.0 * m / mass, 1e-14);
            for (int c = 0; c < 3; ++c)
                sum[c] += f[3 * e + c];
        }
        brc_memory_free(f);
    }
    assert_near(sum[0], 5, 1e-12);
    assert_near(sum[1], 3, 1e-12);
    assert_true(sum[2] == 0);
    release(&s);
}

/* A region that ends 5 cm behind the edge of b, whose faces are 50 cm wide: it has none of their middles, and presses
 * what it covers of them. */
static void a_part_whose_faces_are_only_cut_is_pressed_on_what_the_region_covers(void **state)
{
    (void)state;
#define REGION(to)                                                                                                     \
    "sets:\n  top:\n    faces:\n      wall: z+\n      box: {from: [25 cm, -1 m, 0], to: [" to ", 2 m, 2 m]}\n"
#define TWO_CUBES                                                                                                      \
    MATERIALS "model: dlsm\nbodies:\n" CUBE("a", "0", "") CUBE("b", "2 m", "    model:\n      dlsm: {tau: 0.3}\n")
#define PRESS                                                                                                          \
    "stages:\n  - name: press\n    solver:\n      dynamic: {steps: 1, time_step: 1 ns}\n    loads:\n      - "          \
    "pressure: {set: top, value: 4 Pa}\n"
    sample s = ready(TWO_CUBES REGION("2.05 m") PRESS QUIET);
    const double covered[2] = {0.75, 0.05};
    const brc_domain *second = s.setup.domain[1];
    assert_int_equal(second->sets[brc_domain_find_set(second, "top")].n_members, 0);
    must(brc_lockstep_begin_stage(2, s.setup.assembly.part, 0));
    for (int k = 0; k < 2; ++k) {
        const int64_t n = s.setup.domain[k]->n_elements;
        double *f, sum[3] = {0};
        must(BRC_ALLOCATE(context, &f, 3 * n, "test"));
        must(brc_simulation_force(s.setup.simulation[k], f));
        for (int64_t i = 0; i < 3 * n; ++i)
            sum[i % 3] += f[i];
        assert_near(sum[0], 0, 1e-9);
        assert_near(sum[1], 0, 1e-9);
        assert_near(sum[2], -4 * covered[k], 1e-9);
        brc_memory_free(f);
    }
    release(&s);
    /* what takes whole faces goes to a alone, and a region that ends before b loads nothing of it */
    s = ready(TWO_CUBES REGION(
        "2.05 m") "stages:\n  - name: pull\n    solver:\n      dynamic: {steps: 1, time_step: 1 ns}\n    loads:\n"
                  "      - face_velocity: {set: top, z: 1 m/s}\nsensors:\n  pull:\n    reaction: {set: top, component: "
                  "z}\n" QUIET);
    assert_int_equal(s.setup.split->part[0].scene->stages[0].n_loads, 1);
    assert_int_equal(s.setup.split->part[1].scene->stages[0].n_loads, 0);
    run(&s);
    release(&s);
    s = ready(TWO_CUBES REGION("1.95 m") PRESS QUIET);
    assert_int_equal(brc_domain_find_set(s.setup.domain[1], "top"), -1);
    assert_int_equal(s.setup.split->part[1].scene->stages[0].n_loads, 0);
    release(&s);
}

static void refused(const char *text, const char *part)
{
    sample s;
    assert_int_equal(prepare(text, &s), BRC_BAD_INPUT);
    release(&s);
    says(part);
}

static void what_no_model_can_do_is_refused(void **state)
{
    (void)state;
    static const char *const REST = "stages:\n  - name: rest\n    solver:\n      dynamic: {steps: 1}\n";
    char text[4096];
    /* a body of cells moved by beams */
    snprintf(text, sizeof text, "%s%s", MATERIALS "bodies:\n" CELLS "    model: cbm\n" SPHERES "    model: dlsm\n",
             REST);
    sample s;
    assert_int_equal(prepare(text, &s), BRC_BAD_INPUT);
    release(&s);
    says("model cbm needs spheres joined by beams");
    /* the bar turned the other way and moved down into the packing */
    snprintf(text, sizeof text, "%s%s",
             BOTH "  - name: wall\n    shape:\n      box: {size: [50 mm, 15 mm, 5 mm]}\n    fill:\n"
                  "      noisy_grid: {cells: [10, 3, 2]}\n    material: glass\n    model: dlsm\n    pose: "
                  "{translation: [0, -40 mm, 0]}\n",
             REST);
    refused(text, "bodies 'wall' and 'ball' overlap");
    /* sets nobody has */
    snprintf(text, sizeof text, "%s%s",
             BOTH "sets:\n  far:\n    elements:\n      sphere: {centre: [1 km, 0, 0], radius: 1 m}\n", REST);
    refused(text, "set 'far' is empty");
    /* surfaces meet within a model */
    snprintf(text, sizeof text, "%s%s", BOTH "interactions:\n  contact: {}\n", REST);
    refused(text, "contact: bodies of 2 models are in the scene");
    /* faces of spheres: the cells' alone count */
    s = ready(BOTH "sets:\n  ends:\n    faces: {wall: x+}\nstages:\n  - name: rest\n    solver:\n      dynamic: "
                   "{steps: 1}\n    loads:\n"
                   "      - traction: {set: ends, x: 1 Pa}\n");
    assert_int_equal(brc_domain_find_set(s.setup.domain[1], "ends"), -1);
    assert_int_equal(s.setup.split->part[0].scene->stages[0].n_loads, 1);
    assert_int_equal(s.setup.split->part[1].scene->stages[0].n_loads, 0);
    release(&s);
    /* a wall of both: faces here, spheres there */
    s = ready(BOTH "stages:\n  - name: pull\n    solver:\n      dynamic: {steps: 1}\n    loads:\n      - "
                   "face_displacement: {set: x+, x: 1 um}\n");
    assert_int_equal(brc_lockstep_begin_stage(2, s.setup.assembly.part, 0), BRC_BAD_INPUT);
    release(&s);
    says("a face load names the set 'x+', which is of elements; name a set of faces");
    /* means over two kinds */
    snprintf(text, sizeof text, "%s%s%s", BOTH "sets:\n" ALL_SET, REST,
             "sensors:\n  s:\n    stress: {set: everything, component: xx}\n");
    refused(text, "sensor s: the set \"everything\" spans bodies of 2 models");
    snprintf(text, sizeof text, "%s%s%s", BOTH, REST, "sensors:\n  s:\n    stress: {component: xx}\n");
    refused(text, "sensor s: it averages over the bodies of 2 models");
    snprintf(text, sizeof text, "%s%s%s", BOTH "sets:\n" UPPER_SET LOWER_SET, REST,
             "sensors:\n  s:\n    face_strain: {set: upper, against: lower, component: y}\n");
    refused(text, "sensor s: \"upper\" and \"lower\" lie in bodies of different models");
    /* one simulation for a scene that was not split */
    s = ready(ALONE_CELLS "stages:\n  - name: rest\n    solver:\n      dynamic: {steps: 1}\n");
    brc_simulation *simulation;
    s.scene->bodies[0].has_model = true;
    s.scene->bodies[0].model = s.scene->model;
    s.scene->bodies[0].model.tau = 0.5;
    assert_int_equal(brc_simulation_create(context, s.scene, s.setup.domain[0], s.setup.device[0], &simulation),
                     BRC_BAD_INPUT);
    says("body 'bar' has a model of its own");
    release(&s);
    /* one file for the elements of two models */
    snprintf(text, sizeof text, "%s",
             BOTH
             "stages:\n  - name: rest\n    initial:\n      - file: start.h5\n    solver:\n      dynamic: {steps: 1}\n");
    refused(text, "stage 'rest': a file of initial values has a row for every element of one model");
}

static void a_part_that_runs_away_names_its_model(void **state)
{
    (void)state;
    /* 1 us is far above the critical step of both; the cells' bar alone is pushed, so it is the cells that run away */
    sample s = ready(BOTH "sets:\n" UPPER_SET "stages:\n  - name: boom\n    initial:\n      - random: {set: upper, "
                          "amplitude: [1 m/s, 1 m/s, 1 m/s], seed: 1}\n"
                          "    solver:\n      dynamic: {steps: 400, time_step: 3 us}\n" QUIET);
    assert_int_equal(brc_lockstep_run(2, s.setup.assembly.part), BRC_PHYSICS_STOPPED);
    says("in the bodies of model dlsm");
    release(&s);
}

/* ---- what breaks ---- */

#define BRITTLE                                                                                                        \
    "version: 1\nfracture: {}\nmaterials:\n"                                                                           \
    "  glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3, beam: {radius: 0.5, E: 200 GPa, strength: 50 MPa}}\n"
#define BLOCK(name, seed, y, model)                                                                                    \
    "  - name: " name                                                                                                  \
    "\n    shape:\n      box: {size: [30 mm, 20 mm, 20 mm]}\n    fill:\n      packing: {elements: 150, seed: " seed    \
    "}\n"                                                                                                              \
    "    material: glass\n    beams: 9\n    pose: {translation: [0, " y ", 0]}\n" model
/* Both fly apart along x, at 4000 1/s: a strain of 1.6 % in all, many times what their beams bear. */
#define BURST                                                                                                          \
    "stages:\n  - name: burst\n    initial:\n      - velocity: {gradient: {x: [4000 1/s, 0, 0]}, origin: [15 mm, 0, "  \
    "0]}\n"                                                                                                            \
    "    solver:\n      dynamic: {steps: 40, time_step: 100 ns}\n"
#define SOFT "    model:\n      cbm: {nu: 0.1}\n"

static void broken_bonds_of_both_are_one_stream_by_step(void **state)
{
    (void)state;
    sample whole =
        ready(BRITTLE "bodies:\n" BLOCK("a", "2", "0", "    model: cbm\n") BLOCK("b", "3", "50 mm", SOFT) BURST QUIET);
    sample alone[2] = {ready(BRITTLE "bodies:\n" BLOCK("a", "2", "0", "    model: cbm\n") BURST QUIET),
                       ready(BRITTLE "bodies:\n" BLOCK("b", "3", "50 mm", SOFT) BURST QUIET)};
    brc_cracks all = {0}, own[2] = {{0}, {0}};
    int64_t at[2] = {0, 0};
    assert_string_equal(whole.setup.split->part[1].name, "cbm-2");
    run(&whole);
    must(brc_cracks_take(context, &whole.setup.assembly, &all));
    for (int k = 0; k < 2; ++k) {
        run(&alone[k]);
        must(brc_cracks_take(context, &alone[k].setup.assembly, &own[k]));
        assert_true(own[k].n_broken > 10);
    }
    assert_int_equal(all.n_broken, own[0].n_broken + own[1].n_broken);
    assert_int_equal(all.n_fragments, own[0].n_fragments + own[1].n_fragments);
    for (int64_t b = 0; b < all.n_broken; ++b) {
        const brc_break *found = &all.breaks[b];
        const int k = found->element_i >= 150;
        const brc_break *alike = &own[k].breaks[at[k]++];
        assert_true(b == 0 || found->step >= found[-1].step);
        assert_int_equal(found->element_i, alike->element_i + 150 * k);
        assert_int_equal(found->element_j, alike->element_j + 150 * k);
        assert_int_equal(found->bond, alike->bond + (k ? alone[0].setup.domain[0]->n_bonds : 0));
        assert_true(found->step == alike->step && found->time == alike->time && found->energy == alike->energy);
    }
    brc_cracks_free(&all);
    for (int k = 0; k < 2; ++k) {
        brc_cracks_free(&own[k]);
        release(&alone[k]);
    }
    release(&whole);
}

static brc_status interrupt_at_first_increment(void *self, brc_simulation *simulation)
{
    (void)self;
    if (brc_simulation_step(simulation) == 1) brc_simulation_interrupt(simulation);
    return BRC_OK;
}

/* Asked while the first increment is sampled: the second part stops in its next one, though it was the first that was
 * asked. */
static void an_interrupt_reaches_every_part(void **state)
{
    (void)state;
    sample s = ready(
        BOTH "sets:\n" ENDS
             "stages:\n  - name: pull\n    solver:\n      static: {increments: 2, finite_strain: false}\n    loads:\n"
             "      - element_displacement: {set: left, x: 0, y: 0, z: 0}\n      - element_displacement: {set: right, "
             "x: 1 um}\n" QUIET);
    const brc_observer observer = {.sample = interrupt_at_first_increment};
    must(brc_simulation_observe(s.setup.simulation[0], &observer));
    assert_int_equal(brc_lockstep_run(2, s.setup.assembly.part), BRC_INTERRUPTED);
    assert_int_equal(brc_simulation_step(s.setup.simulation[1]), 1); /* the increment under way is not done */
    brc_context_clear(context);
    assert_int_equal(brc_simulation_run(s.setup.simulation[1]), BRC_INTERRUPTED); /* it was told and keeps it */
    brc_context_clear(context);
    release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_body_moves_bit_for_bit_as_in_a_scene_of_its_own),
        cmocka_unit_test(static_stages_are_solved_as_in_a_scene_of_its_own),
        cmocka_unit_test(models_that_differ_in_a_parameter_are_parts_of_their_own),
        cmocka_unit_test(modes_of_all_bodies_are_counted_together),
        cmocka_unit_test(a_scene_of_one_model_is_its_own_only_part),
        cmocka_unit_test(all_take_the_shortest_of_the_automatic_steps_and_end_together),
        cmocka_unit_test(a_total_force_over_both_models_is_shared_out),
        cmocka_unit_test(a_part_whose_faces_are_only_cut_is_pressed_on_what_the_region_covers),
        cmocka_unit_test(what_no_model_can_do_is_refused),
        cmocka_unit_test(a_part_that_runs_away_names_its_model),
        cmocka_unit_test(broken_bonds_of_both_are_one_stream_by_step),
        cmocka_unit_test(an_interrupt_reaches_every_part),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
