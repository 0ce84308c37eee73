/* What touching costs. */
#include "contact_cost.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/base/random.h"
#include "../host/scene/scene_reader.h"
#include "../host/solver/effects/fracture/fracture.h"
#include "../host/solver/simulation.h"
#include "../host/solver/effects/contact/touching.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 5 };

/* Cells, and packed spheres; all else is in the scenes below. */
#define HEAD                                                                                                           \
    "version: 1\ntitle: cost of contact\nmaterials:\n  glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3, strength: "  \
    "{tension: 7 MPa}}\n"
#define TAIL "output: {frames: none, picture: false}\n"
#define CUBE                                                                                                           \
    "bodies:\n  - {name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 1000, spread: 90 " \
    "%, seed: 1}}, material: glass}\n"
#define BALL                                                                                                           \
    "bodies:\n  - {name: ball, shape: {sphere: {radius: 1 m}}, fill: {noisy_grid: {elements: 1000, spread: 90 %, "     \
    "seed: 1}}, material: glass}\n"
#define TOUCH "interactions: {contact: {friction: 0.3}}\n"
#define SHAKEN                                                                                                         \
    "stages:\n  - name: run\n    solver: {dynamic: {steps: 1000000000}}\n    initial:\n"                               \
    "      - velocity: {gradient: {x: [1e-2 1/s, 2e-3 1/s, 0], y: [0, -3e-3 1/s, 1e-3 1/s], z: [1e-3 1/s, 0, 5e-3 "    \
    "1/s]}}\n"                                                                                                         \
    "      - random: {amplitude: [0.1 mm/s, 0.1 mm/s, 0.1 mm/s], seed: 1}\n"
/* A tenth of the wave speed at the ball's surface: every bond is pulled past its strength by the first step. */
#define BURST                                                                                                          \
    "stages:\n  - name: run\n    solver: {dynamic: {steps: 1000000000}}\n    initial:\n"                               \
    "      - velocity: {gradient: {x: [550 1/s, 0, 0], y: [0, 550 1/s, 0], z: [0, 0, 550 1/s]}}\n"
static const double growth_rate = 550; /* [1/s] as above */
/* A hundredth of the wave speed in all directions [m/s], from when the cells have come off each other: by then the ball
 * has grown to 1 + stirred_at. */
static const double stirring = 55, stirred_at = 0.25, dispersed_at = 1;

typedef struct side {
    brc_scene *scene;
    brc_device *device;
    brc_simulation *simulation;
} side;

static void close_side(side *one)
{
    brc_simulation_free(&one->simulation);
    brc_device_close(&one->device);
    brc_scene_free(&one->scene);
}

static brc_status open_side(brc_context *context, const brc_contact_cost_request *r, const char *text,
                            const brc_domain *domain, side *one)
{
    const brc_device_request open = {.selector = r->device, .precision = r->precision, .n_threads = r->n_threads};
    BRC_TRY(brc_scene_read_text(context, "bench contact", text, strlen(text), 0, NULL, &one->scene));
    BRC_TRY(brc_device_open(context, &open, &one->device));
    BRC_TRY(brc_simulation_create(context, one->scene, domain, one->device, &one->simulation));
    return brc_simulation_begin_stage(one->simulation, 0);
}

static brc_status build(brc_context *context, const char *text, int64_t elements, bool spheres, brc_domain **out)
{
    brc_scene *scene = NULL;
    brc_status status = brc_scene_read_text(context, "bench contact", text, strlen(text), 0, NULL, &scene);
    if (status != BRC_OK) return status;
    brc_build_request request = {.shape = scene->bodies[0].shape, .fill = scene->bodies[0].fill};
    if (spheres) { /* its relaxation is no part of what is measured, so it stops early */
        request.fill = (brc_fill){
            .kind = BRC_FILL_PACKING, .radius_spread = 0.125, .coordination = 6.2, .tolerance = 0.1, .seed = 1};
        request.beams = 10;
    }
    request.fill.n_elements = elements;
    status = brc_domain_build(context, &request, out);
    brc_scene_free(&scene);
    return status;
}

/* Seconds of n steps: of the processor where that is what works, so that other programs on the machine count less. */
static brc_status time_steps(side *one, bool processor, int64_t n, double *seconds)
{
    const clock_t before = clock();
    const double start = brc_clock_s();
    BRC_TRY(brc_simulation_advance(one->simulation, n));
    BRC_TRY(brc_simulation_wait(one->simulation));
    *seconds = processor ? (double)(clock() - before) / CLOCKS_PER_SEC : brc_clock_s() - start;
    return BRC_OK;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Both sides in turns: seconds a step of either, ratios of b over a in ascending order. */
typedef struct turns {
    double a[ROUNDS], b[ROUNDS], ratio[ROUNDS];
    int64_t n_steps;
} turns;

static brc_status take_turns(const brc_contact_cost_request *r, side *a, side *b, turns *out)
{
    const bool processor = strcmp(r->device, "cpu") == 0;
    double seconds = 0;
    out->n_steps = 4;
    BRC_TRY(time_steps(b, processor, out->n_steps, &seconds)); /* pages are touched */
    BRC_TRY(time_steps(a, processor, out->n_steps, &seconds));
    while (seconds < r->sample_s) {
        const double wanted = ceil((double)out->n_steps * 1.1 * r->sample_s / fmax(seconds, r->sample_s / 9));
        out->n_steps = out->n_steps + 1 > (int64_t)wanted ? out->n_steps + 1 : (int64_t)wanted;
        BRC_TRY(time_steps(a, processor, out->n_steps, &seconds));
    }
    for (int k = 0; k < ROUNDS; ++k) {
        BRC_TRY(time_steps(a, processor, out->n_steps, &out->a[k]));
        BRC_TRY(time_steps(b, processor, out->n_steps, &out->b[k]));
        out->ratio[k] = out->b[k] / out->a[k];
        out->a[k] /= (double)out->n_steps;
        out->b[k] /= (double)out->n_steps;
    }
    qsort(out->a, ROUNDS, sizeof *out->a, ascending);
    qsort(out->b, ROUNDS, sizeof *out->b, ascending);
    qsort(out->ratio, ROUNDS, sizeof *out->ratio, ascending);
    return BRC_OK;
}

static void begin_row(const brc_contact_cost_request *r, const char *quantity, const char *model, const char *unit,
                      double bound, const brc_domain *domain, brc_rows *rows)
{
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "contact");
    brc_rows_text(rows, "quantity", quantity);
    brc_rows_text(rows, "model", model);
    brc_rows_text(rows, "unit", unit);
    brc_rows_number(rows, "bound", bound);
    brc_rows_number(rows, "ours", NAN);
    brc_rows_integer(rows, "elements", domain->n_elements);
    brc_rows_text(rows, "precision", brc_precision_name(r->precision));
    brc_rows_text(rows, "device", r->device);
    brc_rows_integer(rows, "threads", r->n_threads);
}

static brc_status end_row(const brc_contact_cost_request *r, const turns *t, brc_rows *rows)
{
    brc_rows_number(rows, "least", t->ratio[0]);
    brc_rows_number(rows, "most", t->ratio[ROUNDS - 1]);
    brc_rows_number(rows, "seconds_without", t->a[ROUNDS / 2]);
    brc_rows_number(rows, "seconds", t->b[ROUNDS / 2]);
    brc_rows_integer(rows, "steps_per_sample", t->n_steps);
    brc_rows_stamp(rows);
    BRC_TRY(rows->status);
    return r->row ? r->row(r->self, rows) : BRC_OK;
}

static brc_status measure_nothing_near(brc_context *context, const brc_contact_cost_request *r, bool spheres,
                                       brc_rows *rows)
{
    const char *without = spheres ? HEAD "model: cbm\n" CUBE SHAKEN TAIL : HEAD "model: dlsm\n" CUBE SHAKEN TAIL;
    const char *with =
        spheres ? HEAD "model: cbm\n" CUBE TOUCH SHAKEN TAIL : HEAD "model: dlsm\n" CUBE TOUCH SHAKEN TAIL;
    side a = {0}, b = {0};
    brc_domain *domain = NULL;
    turns t;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, build(context, without, r->elements, spheres, &domain));
    BRC_TRY_OR(cleanup, open_side(context, r, without, domain, &a));
    BRC_TRY_OR(cleanup, open_side(context, r, with, domain, &b));
    BRC_TRY_OR(cleanup, take_turns(r, &a, &b, &t));
    begin_row(r, "nothing-near", spheres ? "cbm" : "dlsm", "-", 1.05, domain, rows);
    brc_rows_number(rows, "ours", t.ratio[ROUNDS / 2]);
    BRC_TRY_OR(cleanup, end_row(r, &t, rows));
cleanup:
    close_side(&a);
    close_side(&b);
    brc_domain_free(&domain);
    return status;
}

/* What is done to the ball before its steps are measured. */
typedef brc_status prepare_dust(brc_context *context, side *dust, const brc_domain *domain);

/* Until no bond is left. */
static brc_status burst(brc_context *context, side *dust, const brc_domain *domain)
{
    int64_t broken = 0;
    for (int64_t steps = 0; broken < domain->n_bonds; steps += 16) {
        if (steps > 4000)
            return BRC_FAIL(context, BRC_INTERNAL,
                            "bench contact: after %lld steps %lld of %lld bonds of the ball are broken, expected all",
                            (long long)steps, (long long)broken, (long long)domain->n_bonds);
        BRC_TRY(brc_simulation_advance(dust->simulation, 16));
        BRC_TRY(brc_simulation_broken(dust->simulation, &broken));
    }
    return BRC_OK;
}

static brc_status fly(side *dust, double growth)
{
    while (growth_rate * brc_simulation_time(dust->simulation) < growth)
        BRC_TRY(brc_simulation_advance(dust->simulation, 16));
    return BRC_OK;
}

/* The cells of the burst ball meet each other at random until it has grown to twice its size. */
static brc_status disperse(brc_context *context, side *dust, const brc_domain *domain)
{
    double *velocity = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(burst(context, dust, domain));
    BRC_TRY(fly(dust, stirred_at));
    BRC_TRY(BRC_ALLOCATE(context, &velocity, 3 * domain->n_elements, "velocities"));
    BRC_TRY_OR(cleanup, brc_simulation_velocity(dust->simulation, velocity));
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        double u[4];
        brc_random_uniform4(1, BRC_RANDOM_INITIAL_FIELD, (uint64_t)e, 0, u);
        for (int c = 0; c < 3; ++c)
            velocity[3 * e + c] += stirring * (2 * u[c] - 1);
    }
    BRC_TRY_OR(cleanup, brc_simulation_set_state(dust->simulation, NULL, velocity));
    status = fly(dust, dispersed_at);
cleanup:
    brc_memory_free(velocity);
    return status;
}

/* The ball bursts, and every cell flies back to the middle; half of it on, so that the pressed ball stays pressed for a
 * while. */
static brc_status press(brc_context *context, side *dust, const brc_domain *domain)
{
    double *velocity = NULL;
    BRC_TRY(burst(context, dust, domain));
    BRC_TRY(BRC_ALLOCATE(context, &velocity, 3 * domain->n_elements, "velocities"));
    for (int64_t k = 0; k < 3 * domain->n_elements; ++k)
        velocity[k] = -0.2 * growth_rate * domain->position[k];
    brc_status status = brc_simulation_set_state(dust->simulation, NULL, velocity);
    brc_memory_free(velocity);
    const double until = brc_simulation_time(dust->simulation) + 0.02 / (0.2 * growth_rate);
    while (status == BRC_OK && brc_simulation_time(dust->simulation) < until)
        status = brc_simulation_advance(dust->simulation, 16);
    return status;
}

#define WHOLE_BALL HEAD "model: dlsm\n" BALL SHAKEN TAIL
#define BROKEN_BALL HEAD "model: dlsm\n" BALL TOUCH "fracture: {criterion: bond-normal}\n" BURST TAIL

/* How many pairs touch, before and after what is done between two calls. */
static brc_status look(side *dust, double *touching)
{
    brc_touching now;
    BRC_TRY(brc_simulation_touching(dust->simulation, &now));
    *touching += 0.5 * now.pairs;
    return BRC_OK;
}

/* The ball after what `prepare` does to it, beside the whole one; how many pairs touch is the mean of before and
 * after. */
static brc_status measure_broken(brc_context *context, const brc_contact_cost_request *r, const brc_domain *domain,
                                 prepare_dust *prepare, side *intact, brc_rows *rows)
{
    side dust = {0};
    double touching = 0;
    turns t;
    brc_status status = BRC_OK;
    const bool dispersed = prepare == disperse;
    BRC_TRY_OR(cleanup, open_side(context, r, BROKEN_BALL, domain, &dust));
    BRC_TRY_OR(cleanup, prepare(context, &dust, domain));
    BRC_TRY_OR(cleanup, look(&dust, &touching));
    BRC_TRY_OR(cleanup, take_turns(r, intact, &dust, &t));
    BRC_TRY_OR(cleanup, look(&dust, &touching));
    begin_row(r, dispersed ? "dust" : "dense", "dlsm", dispersed ? "-" : "us", dispersed ? 3 : NAN, domain, rows);
    brc_rows_number(rows, "ours",
                    dispersed ? t.ratio[ROUNDS / 2] : 1e6 * (t.b[ROUNDS / 2] - t.a[ROUNDS / 2]) / touching);
    brc_rows_number(rows, "touching", touching);
    if (dispersed) brc_rows_number(rows, "grown", 1 + growth_rate * brc_simulation_time(dust.simulation));
    status = end_row(r, &t, rows);
cleanup:
    close_side(&dust);
    return status;
}

static brc_status measure_dust(brc_context *context, const brc_contact_cost_request *r, brc_rows *rows)
{
    side intact = {0};
    brc_domain *domain = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, build(context, WHOLE_BALL, r->elements, false, &domain));
    BRC_TRY_OR(cleanup, open_side(context, r, WHOLE_BALL, domain, &intact));
    if (r->dust) BRC_TRY_OR(cleanup, measure_broken(context, r, domain, disperse, &intact, rows));
    if (r->dense) BRC_TRY_OR(cleanup, measure_broken(context, r, domain, press, &intact, rows));
cleanup:
    close_side(&intact);
    brc_domain_free(&domain);
    return status;
}

brc_status brc_contact_cost_measure(brc_context *context, const brc_contact_cost_request *request, brc_rows *rows)
{
    if (request->cells && request->nothing_near) BRC_TRY(measure_nothing_near(context, request, false, rows));
    if (request->cells && (request->dust || request->dense)) BRC_TRY(measure_dust(context, request, rows));
    return request->spheres && request->nothing_near ? measure_nothing_near(context, request, true, rows) : BRC_OK;
}
