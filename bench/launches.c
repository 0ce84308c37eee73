#include "launches.h"
#include "cube.h"
#include "../host/base/log.h"
#include "../host/device/device_bandwidth.h"
#include "../host/solver/simulation.h"
#include <math.h>
#include <stdlib.h>

enum { WARM_STEPS = 600, TRIAL_LAUNCHES = 2000, TRIAL_WAITS = 200, SMALL = 4000, SMALL_STEPS = 256 };
/* Elements of a body that fills a GPU. */
enum { MANY = 300000 };
/* Constants and steps by turns, so that what other programs take from one they take from all. Odd: the round in the
 * middle counts. */
enum { ROUNDS = 7 };
/* Strength that nothing reaches [Pa]. */
static const double endless = 1e15;
/* An NVIDIA H200, as measured (bench/results/2026-11-26-nvidia-h200). */
static const brc_device_price h200 = {
    .launch_s = 6.5e-6, .wait_s = 10e-6, .copy_bandwidth = 3.8e12, .pass_bandwidth = 2.27e12, .overlaps = true};

typedef struct effect {
    const char *name;
    bool fracture, contact;
} effect;
static const effect effects[] = {{"elastic", false, false},
                                 {"fracture", true, false},
                                 {"contact", false, true},
                                 {"fracture and contact", true, true}};

static double price_of(const brc_device_price *p, double launches, double waits, double bytes)
{
    const double launching = launches * p->launch_s,
                 passing = p->latency_s + bytes / fmin(p->copy_bandwidth, p->pass_bandwidth);
    return waits * p->wait_s + (p->overlaps ? fmax(launching, passing) : launching + passing);
}

/* One thread: processor time, which other programs on the machine do not lengthen. */
static double now(const brc_launches_request *r)
{
    return r->n_threads == 1 ? brc_processor_s() : brc_clock_s();
}

/* The constants of an open device but for its bandwidths, which are those of a model and a body: infinite. */
static brc_status measure_constants(const brc_launches_request *r, brc_device *device, brc_device_price *out)
{
    brc_status status = BRC_OK;
    brc_buffer *x = NULL, *y = NULL;
    brc_kernel *copy = NULL;
    double number[8];
    out->copy_bandwidth = out->pass_bandwidth = INFINITY;
    out->latency_s = 0;
    out->overlaps = brc_device_get_info(device)->is_gpu;
    BRC_TRY_OR(cleanup, brc_buffer_create(device, &x, sizeof number, "bench numbers"));
    BRC_TRY_OR(cleanup, brc_buffer_create(device, &y, sizeof number, "bench numbers"));
    BRC_TRY_OR(cleanup, brc_kernel_find(device, "vector_copy", &copy));
    for (int trial = 0; trial < 2; ++trial) { /* the first makes the kernel ready */
        double start = now(r);
        for (int k = 0; k < TRIAL_LAUNCHES; ++k)
            BRC_TRY_OR(cleanup, BRC_LAUNCH(copy, 1, BRC_INT(1), BRC_BUF(x), BRC_BUF(y)));
        BRC_TRY_OR(cleanup, brc_device_wait(device));
        out->launch_s = (now(r) - start) / TRIAL_LAUNCHES;
        start = now(r);
        for (int k = 0; k < TRIAL_WAITS; ++k) {
            BRC_TRY_OR(cleanup, BRC_LAUNCH(copy, 1, BRC_INT(1), BRC_BUF(x), BRC_BUF(y)));
            BRC_TRY_OR(cleanup, brc_buffer_read(y, 0, number, 4));
        }
        out->wait_s = fmax(0, (now(r) - start) / TRIAL_WAITS - out->launch_s);
    }
cleanup:
    brc_buffer_free(&x);
    brc_buffer_free(&y);
    return status;
}

/* A body under an effect. */
typedef struct body {
    brc_cube cube; /* lives as long as the simulation */
    brc_simulation *simulation;
    double floor_bytes; /* of a step */
} body;

static brc_status body_make(brc_context *context, brc_device *device, const brc_domain *domain, brc_model_kind model,
                            const effect *e, body *out)
{
    brc_cube *const c = &out->cube;
    brc_cube_make(c, model);
    if (e->fracture) {
        c->scene.has_fracture = true;
        c->scene.fracture = (brc_fracture){.level = 1, .closure = true, .side_friction = -1}; /* as scenes have it */
        c->material.tension = endless;
    }
    if (e->contact) {
        c->scene.has_contact = true;
        c->scene.contact = (brc_contact){.within = true, .rotation = true};
    }
    BRC_TRY(brc_simulation_create(context, &c->scene, domain, device, &out->simulation));
    out->floor_bytes = brc_simulation_floor_bytes(out->simulation);
    BRC_TRY(brc_simulation_begin_stage(out->simulation, 0));
    return brc_simulation_advance(out->simulation, WARM_STEPS); /* stretches of ahead.h have their length */
}

/* n steps, counted and timed. */
typedef struct step_work {
    brc_device_counts counts;
    double seconds; /* of a step */
} step_work;

static brc_status take_steps(const brc_launches_request *r, brc_device *device, const body *b, int64_t n,
                             step_work *out)
{
    BRC_TRY(brc_simulation_wait(b->simulation));
    const brc_device_counts before = brc_device_counted(device);
    const double start = now(r);
    BRC_TRY(brc_simulation_advance(b->simulation, n));
    const brc_device_counts after = brc_device_counted(device);
    BRC_TRY(brc_simulation_wait(b->simulation));
    out->seconds = (now(r) - start) / (double)n;
    out->counts = (brc_device_counts){after.launches - before.launches, after.waits - before.waits,
                                      after.read_bytes - before.read_bytes, after.written_bytes - before.written_bytes,
                                      after.copied_bytes - before.copied_bytes};
    return BRC_OK;
}

/* What a round found. */
typedef struct bench_round {
    brc_device_price price;
    step_work work;
    double told; /* seconds of a step by the model */
} bench_round;

static int by_ratio(const void *a, const void *b)
{
    const bench_round *x = a, *y = b;
    const double left = x->told / x->work.seconds, right = y->told / y->work.seconds;
    return left < right ? -1 : left > right;
}

/* What passes reach and how long they take of a few elements: on a GPU by two elastic bodies, for it waits as long for
 * memory with one element a work-item as with many; else by a small one under the same effect, in cache, for passes of
 * a CPU wait for arithmetic, of which effects do more for each byte, and searches of contact are in no count of bytes.
 */
static brc_status measure_passes(const brc_launches_request *r, brc_device *device, const body *small, const body *many,
                                 brc_device_price *price)
{
    step_work few, full;
    BRC_TRY(take_steps(r, device, small, SMALL_STEPS, &few));
    if (!many->simulation) {
        const double asking =
            ((double)few.counts.launches * price->launch_s + (double)few.counts.waits * price->wait_s) / SMALL_STEPS;
        if (few.seconds > asking) price->pass_bandwidth = small->floor_bytes / (few.seconds - asking);
        return BRC_OK;
    }
    BRC_TRY(take_steps(r, device, many, SMALL_STEPS, &full));
    if (full.seconds > few.seconds)
        price->pass_bandwidth = (many->floor_bytes - small->floor_bytes) / (full.seconds - few.seconds);
    price->latency_s = fmax(0, few.seconds - small->floor_bytes / price->pass_bandwidth);
    return BRC_OK;
}

static brc_status measure_round(const brc_launches_request *r, brc_device *device, const body *small, const body *many,
                                const body *large, bench_round *out)
{
    const int64_t moved = (int64_t)large->floor_bytes / 2; /* a copy reads and writes */
    const double n = (double)r->n_steps;
    brc_device_price *price = &out->price;
    BRC_TRY(measure_constants(r, device, price));
    BRC_TRY(brc_device_copy_bandwidth(device,
                                      price->overlaps || moved > r->bandwidth_bytes ? r->bandwidth_bytes : moved,
                                      r->n_threads == 1 ? brc_processor_s : brc_clock_s, &price->copy_bandwidth));
    BRC_TRY(measure_passes(r, device, small, many, price));
    BRC_TRY(take_steps(r, device, large, r->n_steps, &out->work));
    out->told =
        price_of(price, (double)out->work.counts.launches / n, (double)out->work.counts.waits / n, large->floor_bytes);
    return BRC_OK;
}

static void add_figures(const brc_launches_request *r, const brc_domain *domain, const body *b,
                        const bench_round *found, brc_rows *rows)
{
    const brc_device_counts *const work = &found->work.counts;
    const brc_device_price *const price = &found->price;
    const double n = (double)r->n_steps, launches = (double)work->launches / n, waits = (double)work->waits / n;
    brc_rows_number(rows, "ours", launches);
    brc_rows_number(rows, "launches_per_step", launches);
    brc_rows_number(rows, "waits_per_1000_steps", 1000 * waits);
    brc_rows_number(rows, "read_bytes_per_step", (double)work->read_bytes / n);
    brc_rows_number(rows, "written_bytes_per_step", (double)work->written_bytes / n);
    brc_rows_number(rows, "copied_bytes_per_step", (double)work->copied_bytes / n);
    brc_rows_number(rows, "floor_bytes_per_step", b->floor_bytes);
    brc_rows_number(rows, "launch_s", price->launch_s);
    brc_rows_number(rows, "wait_s", price->wait_s);
    brc_rows_number(rows, "copy_bandwidth", price->copy_bandwidth);
    brc_rows_number(rows, "pass_bandwidth", price->pass_bandwidth);
    brc_rows_number(rows, "latency_s", price->latency_s);
    brc_rows_number(rows, "seconds", found->work.seconds);
    brc_rows_number(rows, "seconds_by_model", found->told);
    brc_rows_number(rows, "model_over_seconds", found->told / found->work.seconds);
    brc_rows_number(rows, "h200_seconds_by_model", price_of(&h200, launches, waits, b->floor_bytes));
    brc_rows_integer(rows, "elements", domain->n_elements);
    brc_rows_integer(rows, "bonds", domain->n_bonds);
}

/* few: of the small body; many: without a simulation but on a GPU. */
static brc_status measure(brc_context *context, const brc_launches_request *r, brc_device *device,
                          const brc_domain *few, const body *many, const brc_domain *domain, brc_model_kind model,
                          const effect *e, brc_rows *rows)
{
    brc_status status = BRC_OK;
    body large = {0}, small = {0};
    bench_round rounds[ROUNDS];
    BRC_TRY_OR(cleanup, body_make(context, device, few, model, many->simulation ? &effects[0] : e, &small));
    BRC_TRY_OR(cleanup, body_make(context, device, domain, model, e, &large));
    for (int k = 0; k < ROUNDS; ++k)
        BRC_TRY_OR(cleanup, measure_round(r, device, &small, many, &large, &rounds[k]));
    qsort(rounds, ROUNDS, sizeof *rounds, by_ratio);
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "launches");
    brc_rows_text(rows, "quantity", e->name);
    brc_rows_text(rows, "model", brc_model_name(model));
    brc_rows_text(rows, "unit", "1/step");
    add_figures(r, domain, &large, &rounds[ROUNDS / 2], rows);
    brc_rows_text(rows, "precision", brc_precision_name(r->precision));
    brc_rows_text(rows, "device", r->device);
    brc_rows_text(rows, "device_name", brc_device_get_info(device)->name);
    brc_rows_integer(rows, "threads", brc_device_get_info(device)->compute_units);
    brc_rows_stamp(rows);
    status = rows->status != BRC_OK ? rows->status : r->row ? r->row(r->self, rows) : BRC_OK;
cleanup:
    brc_simulation_free(&large.simulation);
    brc_simulation_free(&small.simulation);
    return status;
}

static brc_status measure_model(brc_context *context, const brc_launches_request *r, brc_model_kind model,
                                brc_rows *rows)
{
    brc_status status = BRC_OK;
    brc_domain *domain = NULL, *few = NULL, *full = NULL;
    brc_device *device = NULL;
    body many = {0};
    const bool spheres = brc_cube_is_of_spheres(model);
    const brc_device_request open = {.selector = r->device, .precision = r->precision, .n_threads = r->n_threads};
    BRC_TRY_OR(cleanup, brc_device_open(context, &open, &device));
    BRC_TRY_OR(cleanup, brc_cube_build(context, SMALL, spheres, &few));
    if (brc_device_get_info(device)->is_gpu) {
        BRC_TRY_OR(cleanup, brc_cube_build(context, MANY, spheres, &full));
        BRC_TRY_OR(cleanup, body_make(context, device, full, model, &effects[0], &many));
    }
    BRC_TRY_OR(cleanup, brc_cube_build(context, r->size, spheres, &domain));
    for (size_t k = 0; k < sizeof effects / sizeof effects[0]; ++k)
        BRC_TRY_OR(cleanup, measure(context, r, device, few, &many, domain, model, &effects[k], rows));
cleanup:
    brc_simulation_free(&many.simulation);
    brc_domain_free(&domain);
    brc_domain_free(&full);
    brc_domain_free(&few);
    brc_device_close(&device);
    return status;
}

brc_status brc_launches_measure(brc_context *context, const brc_launches_request *request, brc_rows *rows)
{
    for (int m = 0; m < request->n_models; ++m)
        BRC_TRY(measure_model(context, request, request->models[m], rows));
    return BRC_OK;
}
