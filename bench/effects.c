#include "effects.h"
#include "crack_factors.h"
#include "cube.h"
#include "../host/base/file.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/solver/effects/fracture/fracture.h"
#include "../host/solver/effects/guard.h"
#include "../host/solver/simulation.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 9,
    MOST_VARIANTS = 10,
    TRIAL_STEPS = 10,
    N_TRIALS = 3,
    WARM_STEPS = 3,
    AGAIN_STEPS = 1,
    MOST_STEPS = 1000, /* of a sample: in all rounds fewer than dlsm-published takes to run away (13 000) */
    GUARD_LOOKS = 50
};
/* Strength of a bond whose factor is 1, where bonds are to break [Pa]. */
static const double strength = 1e8;
/* Share of the bonds that break in a trial step. */
static const double trial_rate = 1e-3;
/* Mean stress, over the strength, to which what is to swing below limits of shear does: a third of them in corners. */
static const double swing = 1.5;

/* An effect. rate: share of the bonds that break, or faces that open, in each step; bound: asked for, over the
 * elastic step, 0: none. */
typedef struct effect {
    const char *name;
    bool fracture, contact, softens;
    double rate, bound;
    int64_t most_steps; /* of a sample: the rate holds for some dozens of steps */
    bool cracks;        /* bonds break along three planes (crack_factors.h), else anywhere */
    bool shears;        /* limits of shear, too, which the cube stays below as it swings, pulled and pressed */
} effect;
static const effect effects[] = {
    {"elastic, again", false, false, false, 0, 0, INT64_MAX, false, false},
    {"fracture, nothing breaks", true, false, false, 0, 1.15, INT64_MAX, false, false},
    {"fracture, 1 % of the bonds break in 100 steps", true, false, false, 1e-4, 1.3, 10, false, false},
    {"the same along three cracks that run", true, false, false, 1e-4, 1.3, 10, true, false},
    {"fracture, 1 % of the bonds break in every step", true, false, false, 1e-2, 0, 2, false, false},
    {"fracture energy, no face open", true, false, true, 0, 0, INT64_MAX, false, false},
    {"fracture energy, 1 % of the faces open in 100 steps", true, false, true, 1e-4, 0, 10, false, false},
    {"fracture energy with limits of shear, no face open", true, false, true, 0, 0, INT64_MAX, false, true},
    {"contact, nothing near", false, true, false, 0, 1.05, INT64_MAX, false, false}};
enum { N_EFFECTS = sizeof effects / sizeof effects[0] };

/* A simulation of the cube that is stepped. */
typedef struct variant {
    brc_cube cube;
    brc_device *device;
    brc_simulation *simulation;
    double ratio[ROUNDS], per_step[ROUNDS];
    int64_t n_steps, n_events, steps;
} variant;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const double *x, int n)
{
    double sorted[ROUNDS];
    memcpy(sorted, x, (size_t)n * sizeof *x);
    qsort(sorted, (size_t)n, sizeof *sorted, ascending);
    return n % 2 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

/* Of one thread of the cpu processor time, which other programs on the machine do not lengthen; else that of the wall
 * [s]. */
static bool counts_processor(const brc_effects_request *r)
{
    return r->n_threads == 1 && strcmp(r->device, "cpu") == 0;
}
static double clock_s(const brc_effects_request *r)
{
    return counts_processor(r) ? brc_processor_s() : brc_clock_s();
}

/* Each sample follows AGAIN_STEPS without a clock: a simulation whose turn it is finds caches and pages full of the one
 * before, which costs its first step half to all of another one, and is no part of what an effect costs a run. Samples
 * of ten steps would bear four times as much of it as those of the elastic cube. */
static brc_status time_steps(const brc_effects_request *r, brc_simulation *simulation, int64_t n, double *seconds)
{
    BRC_TRY(brc_simulation_advance(simulation, AGAIN_STEPS));
    BRC_TRY(brc_simulation_wait(simulation));
    const double start = clock_s(r);
    BRC_TRY(brc_simulation_advance(simulation, n));
    BRC_TRY(brc_simulation_wait(simulation));
    *seconds = clock_s(r) - start;
    return BRC_OK;
}

/* Bonds that are broken, or faces that have opened. */
static brc_status count_events(brc_simulation *simulation, const effect *e, int64_t *out)
{
    brc_softening_report report;
    *out = 0;
    if (e->softens) {
        BRC_TRY(brc_simulation_softening(simulation, &report));
        *out = report.n_opened;
        return BRC_OK;
    }
    return e->fracture ? brc_simulation_broken(simulation, out) : BRC_OK;
}

static void free_variant(variant *v)
{
    brc_simulation_free(&v->simulation);
    brc_device_close(&v->device);
}

/* The cube at rest, whose points fly apart so that the strain of all of it grows by the same in every step. Strengths
 * follow 1 - exp(-f), so that a steady share of the bonds breaks, `rate` in a step where scale is 1. */
static brc_status make_variant(brc_context *context, const brc_effects_request *r, const brc_domain *domain,
                               brc_model_kind model, const effect *e, double rate, double scale, variant *v)
{
    brc_status status = BRC_OK;
    double *velocity = NULL;
    const brc_device_request open = {.selector = r->device, .precision = r->precision, .n_threads = r->n_threads};
    brc_cube_make(&v->cube, model);
    v->cube.stage.n_initials = 0;
    brc_material *m = &v->cube.material;
    if (e->fracture) {
        v->cube.scene.has_fracture = true;
        v->cube.scene.fracture =
            (brc_fracture){.level = 1, .closure = true, .side_friction = -1}; /* as scenes have it */
        m->tension = rate > 0 ? strength : 1e6 * strength;
        if (e->shears) {
            v->cube.scene.fracture.kind = BRC_CRITERION_MOHR_COULOMB;
            v->cube.scene.fracture.cohesion = 2.5 * strength, v->cube.scene.fracture.friction = acos(sqrt(0.75));
        }
        if (rate > 0)
            m->scatter = (brc_scatter){.kind = e->cracks ? BRC_SCATTER_FILE : BRC_SCATTER_WEIBULL, .modulus = 1};
        if (e->cracks) {
            BRC_TRY_OR(cleanup, brc_file_make_folder(context, r->folder));
            snprintf(m->scatter.file, sizeof m->scatter.file, "%s/crack_factors.csv", r->folder);
            BRC_TRY_OR(cleanup, brc_crack_factors_write(context, domain, m->scatter.file));
        }
        /* twenty cells of E G_c / strength^2: faces that open stay open */
        if (e->softens)
            m->fracture_energy = 20 * m->tension * m->tension / m->young * cbrt(1.0 / (double)domain->n_elements);
    }
    if (e->contact) {
        v->cube.scene.has_contact = true;
        v->cube.scene.contact = (brc_contact){.within = true, .rotation = true};
    }
    BRC_TRY_OR(cleanup, brc_device_open(context, &open, &v->device));
    BRC_TRY_OR(cleanup, brc_simulation_create(context, &v->cube.scene, domain, v->device, &v->simulation));
    BRC_TRY_OR(cleanup, brc_simulation_begin_stage(v->simulation, 0));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &velocity, 3 * domain->n_elements, "velocities"));
    const double three_bulk = m->young / (1 - 2 * m->poisson), dt = brc_simulation_time_step(v->simulation).value;
    const double steps_to_centre = 0.5 * sqrt(m->density / m->young) / dt;
    const double in_step = e->shears ? swing / steps_to_centre : (rate > 0 ? rate : trial_rate) * scale;
    for (int64_t k = 0; k < 3 * domain->n_elements; ++k)
        velocity[k] = in_step * strength / three_bulk / dt * (domain->position[k] - 0.5);
    status = brc_simulation_set_state(v->simulation, NULL, velocity);
cleanup:
    if (m->scatter.file[0]) remove(m->scatter.file);
    brc_memory_free(velocity);
    return status;
}

/* What to multiply the speed with, so that the rate is the one that is wanted: a short trial says what share of the
 * bonds breaks, three over the steps of the measurement correct it. */
static brc_status find_scale(brc_context *context, const brc_effects_request *r, const brc_domain *domain,
                             brc_model_kind model, const effect *e, double *scale)
{
    *scale = 1;
    for (int trial = 0; e->rate > 0 && trial <= N_TRIALS; ++trial) {
        variant v = {0};
        int64_t before = 0, n = 0;
        const double rate = trial == 0 ? trial_rate : e->rate;
        const int64_t start = trial == 0 ? 0 : AGAIN_STEPS + WARM_STEPS,
                      steps = trial == 0 ? TRIAL_STEPS
                                         : (AGAIN_STEPS + e->most_steps) * ROUNDS; /* as `alternate` counts them */
        brc_status status = make_variant(context, r, domain, model, e, rate, *scale, &v);
        if (status == BRC_OK && start > 0) status = brc_simulation_advance(v.simulation, start);
        if (status == BRC_OK) status = count_events(v.simulation, e, &before);
        if (status == BRC_OK) status = brc_simulation_advance(v.simulation, steps);
        if (status == BRC_OK) status = count_events(v.simulation, e, &n);
        free_variant(&v);
        BRC_TRY(status);
        n -= before;
        if (n == 0)
            *scale *= 10; /* too slow to reach the weakest */
        else
            *scale *= fmin(trial ? 4 : 100,
                           fmax(trial ? 0.25 : 0.01, rate * (double)steps * (double)domain->n_bonds / (double)n));
    }
    return BRC_OK;
}

/* Cost of the guard over a step of this many seconds: its looks, readings and ledgers apart, each over the steps
 * between two of them. */
static brc_status guard_cost(const brc_effects_request *r, brc_simulation *s, double per_step, double *out)
{
    double look, read, ledger_s, start;
    brc_ledger ledger;
    BRC_TRY(brc_guard_begin_stage(s));
    const brc_guard_report every = brc_simulation_guard_report(s);
    const int64_t probe_every = 16; /* docs/notebook/stability.md */
    BRC_TRY(brc_simulation_advance(s, probe_every - brc_simulation_step(s) % probe_every));
    BRC_TRY(brc_simulation_wait(s));
    start = clock_s(r);
    for (int k = 0; k < GUARD_LOOKS; ++k)
        BRC_TRY(brc_guard_step(s));
    BRC_TRY(brc_simulation_wait(s));
    look = (clock_s(r) - start) / GUARD_LOOKS;
    start = clock_s(r);
    for (int k = 0; k < GUARD_LOOKS; ++k)
        BRC_TRY(brc_guard_read(s, false, NULL));
    read = (clock_s(r) - start) / GUARD_LOOKS;
    start = clock_s(r);
    for (int k = 0; k < WARM_STEPS; ++k)
        BRC_TRY(brc_simulation_ledger(s, &ledger));
    ledger_s = (clock_s(r) - start) / WARM_STEPS;
    *out = (look / (double)probe_every + read / (double)every.every + ledger_s / (double)every.ledger_every) / per_step;
    return BRC_OK;
}

typedef struct figures {
    const char *name;
    double ratio, low, high, bound, per_step, per_hundred;
} figures;

static brc_status add_row(const brc_effects_request *r, const brc_domain *domain, brc_model_kind model,
                          const brc_device *device, const figures *f, brc_rows *rows)
{
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "effects");
    brc_rows_text(rows, "quantity", f->name);
    brc_rows_text(rows, "model", brc_model_name(model));
    brc_rows_text(rows, "unit", "-");
    brc_rows_number(rows, "reference", NAN);
    brc_rows_number(rows, "paper", NAN);
    brc_rows_number(rows, "ours", f->ratio);
    brc_rows_number(rows, "ours_min", f->low);
    brc_rows_number(rows, "ours_max", f->high);
    brc_rows_number(rows, "bound", f->bound > 0 ? f->bound : NAN);
    brc_rows_text(rows, "verdict", !(f->bound > 0) ? "no bound" : f->ratio <= f->bound ? "met" : "missed");
    brc_rows_number(rows, "seconds", f->per_step);
    brc_rows_number(rows, "share_in_100_steps", f->per_hundred);
    brc_rows_integer(rows, "elements", domain->n_elements);
    brc_rows_integer(rows, "bonds", domain->n_bonds);
    brc_rows_text(rows, "precision", brc_precision_name(r->precision));
    brc_rows_text(rows, "device", r->device);
    brc_rows_text(rows, "clock", counts_processor(r) ? "processor" : "wall");
    brc_rows_integer(rows, "threads", brc_device_get_info(device)->compute_units);
    brc_rows_text(rows, "device_name", brc_device_get_info(device)->name);
    brc_rows_stamp(rows);
    return rows->status != BRC_OK ? rows->status : r->row ? r->row(r->self, rows) : BRC_OK;
}

/* Steps of the elastic cube and of each variant by turns. */
static brc_status alternate(const brc_effects_request *r, const effect *const *which, variant *base, int n, variant *v)
{
    double seconds;
    int64_t before[MOST_VARIANTS], after;
    BRC_TRY(time_steps(r, base->simulation, WARM_STEPS, &seconds));
    BRC_TRY(time_steps(r, base->simulation, WARM_STEPS, &seconds));
    base->n_steps = (int64_t)fmin(MOST_STEPS, fmax(1, ceil(r->sample_s * WARM_STEPS / seconds)));
    for (int k = 0; k < n; ++k) {
        BRC_TRY(time_steps(r, v[k].simulation, WARM_STEPS, &seconds)); /* kernels are built, pages touched */
        v[k].n_steps = base->n_steps < which[k]->most_steps ? base->n_steps : which[k]->most_steps;
        BRC_TRY(count_events(v[k].simulation, which[k], &before[k]));
    }
    for (int round = 0; round < ROUNDS; ++round) {
        BRC_TRY(time_steps(r, base->simulation, base->n_steps, &seconds));
        base->per_step[round] = seconds / (double)base->n_steps;
        for (int k = 0; k < n; ++k) {
            BRC_TRY(time_steps(r, v[k].simulation, v[k].n_steps, &seconds));
            v[k].per_step[round] = seconds / (double)v[k].n_steps;
            v[k].ratio[round] = v[k].per_step[round] / base->per_step[round];
            v[k].steps += AGAIN_STEPS + v[k].n_steps;
        }
    }
    for (int k = 0; k < n; ++k) {
        BRC_TRY(count_events(v[k].simulation, which[k], &after));
        v[k].n_events = after - before[k];
    }
    return BRC_OK;
}

static brc_status measure_model(brc_context *context, const brc_effects_request *r, brc_model_kind model,
                                brc_rows *rows)
{
    brc_status status = BRC_OK;
    static const effect elastic = {"elastic", false, false, false, 0, 0, INT64_MAX, false, false};
    brc_domain *domain = NULL;
    variant base = {0}, *v = NULL;
    const effect *which[MOST_VARIANTS];
    int n = 0;
    double scale, cost;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &v, MOST_VARIANTS, "variants of the cube"));
    BRC_TRY_OR(cleanup, brc_cube_build(context, r->size, brc_cube_is_of_spheres(model), &domain));
    BRC_TRY_OR(cleanup, make_variant(context, r, domain, model, &elastic, 0, 1, &base));
    for (int k = 0; k < N_EFFECTS; ++k) {
        if (effects[k].softens && !brc_model_traits_of(model)->cohesion) continue;
        which[n] = &effects[k];
        BRC_TRY_OR(cleanup, find_scale(context, r, domain, model, &effects[k], &scale));
        BRC_TRY_OR(cleanup, make_variant(context, r, domain, model, &effects[k], effects[k].rate, scale, &v[n++]));
    }
    BRC_TRY_OR(cleanup, alternate(r, which, &base, n, v));
    const double per_step = median(base.per_step, ROUNDS);
    const figures plain = {.name = elastic.name, .ratio = 1, .low = 1, .high = 1, .per_step = per_step};
    BRC_TRY_OR(cleanup, add_row(r, domain, model, base.device, &plain, rows));
    for (int k = 0; k < n; ++k) {
        figures f = {.name = which[k]->name,
                     .ratio = median(v[k].ratio, ROUNDS),
                     .bound = which[k]->bound,
                     .per_step = median(v[k].per_step, ROUNDS),
                     .per_hundred = 100 * (double)v[k].n_events / (double)v[k].steps / (double)domain->n_bonds};
        f.low = INFINITY;
        for (int round = 0; round < ROUNDS; ++round)
            f.low = fmin(f.low, v[k].ratio[round]), f.high = fmax(f.high, v[k].ratio[round]);
        BRC_TRY_OR(cleanup, add_row(r, domain, model, base.device, &f, rows));
    }
    BRC_TRY_OR(cleanup, guard_cost(r, base.simulation, per_step, &cost));
    const figures guard = {.name = "guard",
                           .ratio = 1 + cost,
                           .low = 1 + cost,
                           .high = 1 + cost,
                           .bound = 1.01,
                           .per_step = per_step * (1 + cost)};
    BRC_TRY_OR(cleanup, add_row(r, domain, model, base.device, &guard, rows));
cleanup:
    for (int k = 0; v && k < n; ++k)
        free_variant(&v[k]);
    free_variant(&base);
    brc_memory_free(v);
    brc_domain_free(&domain);
    return status;
}

brc_status brc_effects_measure(brc_context *context, const brc_effects_request *request, brc_rows *rows)
{
    for (int k = 0; k < request->n_models; ++k)
        BRC_TRY(measure_model(context, request, request->models[k], rows));
    return BRC_OK;
}
