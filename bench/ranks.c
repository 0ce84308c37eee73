#include "ranks.h"
#include "cube.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/base/ranks.h"
#include "../host/device/device_list.h"
#include "../host/solver/core/layout.h"
#include "../host/solver/simulation.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SLICE = 8, MOST_RANKS = 4096, SAMPLES = 5, WARM_STEPS = 20 };
/* Numbers of a row that its neighbours gather in a step of dlsm: displacement; gradient, stress and flux. */
enum { STATE_NUMBERS = 3, COEFF_NUMBERS = 27, EXCHANGES = 4 };

static brc_status close_row(const brc_ranks_request *r, brc_rows *rows)
{
    brc_rows_stamp(rows);
    if (rows->status != BRC_OK || brc_ranks_mine() != 0) return rows->status;
    return r->row ? r->row(r->self, rows) : BRC_OK;
}

static void begin_row(brc_rows *rows, const char *quantity, int64_t n_ranks)
{
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "ranks");
    brc_rows_text(rows, "quantity", quantity);
    brc_rows_integer(rows, "ranks", n_ranks);
}

/* ---- ranges of the storage order ---- */

/* Bonds in storage order. */
typedef struct order {
    const brc_domain *domain;
    const brc_layout *layout;
    int64_t n_blocks;
    int32_t *ghost_of, *seen; /* [elements] last rank that counted this one; [ranks] likewise */
} order;

/* First row of rank k of n. */
static int64_t first_row(const order *o, int64_t n, int64_t k)
{
    const int64_t row = o->n_blocks * k / n * BRC_RANKS_BLOCK;
    return row < o->domain->n_elements ? row : o->domain->n_elements;
}

static int32_t owner_of(const order *o, int64_t n, int64_t row)
{
    int64_t k = row / BRC_RANKS_BLOCK * n / o->n_blocks;
    while (first_row(o, n, k + 1) <= row)
        ++k;
    return (int32_t)k;
}

typedef struct surface {
    int64_t rows, ghosts, neighbours, inside; /* inside: own rows that gather no ghost */
    int64_t meanwhile;                        /* own rows that are computed while ghosts are on their way */
} surface;

/* Ranges of slices inside, the longest of them (host/device/shares_rows.c). */
typedef struct ranges {
    int64_t least, now, longest[16];
} ranges;

static void end_range(ranges *r)
{
    const int n = (int)(sizeof r->longest / sizeof *r->longest);
    int shortest = 0;
    for (int k = 1; k < n; ++k)
        if (r->longest[k] < r->longest[shortest]) shortest = k;
    if (r->now >= r->least && r->now > r->longest[shortest]) r->longest[shortest] = r->now;
    r->now = 0;
}

static int64_t rows_of(const ranges *r)
{
    int64_t sum = 0;
    for (size_t k = 0; k < sizeof r->longest / sizeof *r->longest; ++k)
        sum += r->longest[k];
    return sum * SLICE;
}

static surface look_at(order *o, int64_t n, int32_t rank)
{
    const brc_domain *d = o->domain;
    const int64_t first = first_row(o, n, rank), end = first_row(o, n, rank + 1);
    surface s = {.rows = end - first};
    ranges r = {.least = s.rows / SLICE / 64 + 1};
    bool slice_inside = true;
    for (int64_t row = first; row < end; ++row) {
        const int32_t e = o->layout->element_of_row[row];
        bool inside = true;
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const int32_t j = d->neighbour[h];
            const int64_t there = o->layout->row_of_element[j];
            if (there >= first && there < end) continue;
            inside = false;
            const int32_t owner = owner_of(o, n, there);
            s.ghosts += o->ghost_of[j] != rank;
            s.neighbours += o->seen[owner] != rank;
            o->ghost_of[j] = o->seen[owner] = rank;
        }
        s.inside += inside;
        slice_inside &= inside;
        if (row % SLICE < SLICE - 1 && row < end - 1) continue;
        r.now += slice_inside;
        if (!slice_inside) end_range(&r);
        slice_inside = true;
    }
    end_range(&r);
    s.meanwhile = rows_of(&r) < s.rows ? rows_of(&r) : s.rows;
    return s;
}

static brc_status add_surface(const brc_ranks_request *r, order *o, int64_t n, brc_rows *rows)
{
    surface sum = {0}, most = {0};
    double inside_least = 1, meanwhile_least = 1;
    memset(o->ghost_of, -1, (size_t)o->domain->n_elements * sizeof *o->ghost_of);
    memset(o->seen, -1, MOST_RANKS * sizeof *o->seen);
    for (int32_t k = 0; k < n; ++k) {
        const surface s = look_at(o, n, k);
        sum.rows += s.rows, sum.ghosts += s.ghosts, sum.neighbours += s.neighbours;
        if (s.rows > most.rows) most.rows = s.rows;
        if (s.ghosts > most.ghosts) most.ghosts = s.ghosts;
        if (s.neighbours > most.neighbours) most.neighbours = s.neighbours;
        inside_least = fmin(inside_least, (double)s.inside / (double)s.rows);
        meanwhile_least = fmin(meanwhile_least, (double)s.meanwhile / (double)s.rows);
    }
    const double ranks = (double)n, ghosts = (double)sum.ghosts / ranks, own = (double)sum.rows / ranks;
    begin_row(rows, "surface", n);
    brc_rows_integer(rows, "elements", o->domain->n_elements);
    brc_rows_integer(rows, "bonds", o->domain->n_bonds);
    brc_rows_number(rows, "ours", ghosts / own);
    brc_rows_number(rows, "rows_per_rank", own);
    brc_rows_integer(rows, "rows_most", most.rows);
    brc_rows_number(rows, "ghosts_per_rank", ghosts);
    brc_rows_integer(rows, "ghosts_most", most.ghosts);
    brc_rows_number(rows, "surface_constant", ghosts / pow(own, 2.0 / 3.0));
    brc_rows_number(rows, "neighbours_per_rank", (double)sum.neighbours / ranks);
    brc_rows_integer(rows, "neighbours_most", most.neighbours);
    brc_rows_number(rows, "inside_least", inside_least);
    brc_rows_number(rows, "meanwhile_least", meanwhile_least);
    brc_rows_integer(rows, "exchanged_bytes_most", most.ghosts * (STATE_NUMBERS + COEFF_NUMBERS) * 8);
    return close_row(r, rows);
}

static brc_status measure_surface(brc_context *context, const brc_ranks_request *r, int64_t size, brc_rows *rows)
{
    brc_domain *domain = NULL;
    brc_layout *layout = NULL;
    order o = {0};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_cube_build(context, size, false, &domain));
    BRC_TRY_OR(cleanup, brc_layout_create(context, domain, SLICE, &layout));
    o = (order){
        .domain = domain, .layout = layout, .n_blocks = (domain->n_elements + BRC_RANKS_BLOCK - 1) / BRC_RANKS_BLOCK};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &o.ghost_of, domain->n_elements, "ghosts"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &o.seen, MOST_RANKS, "neighbours"));
    for (int64_t n = 2; n <= o.n_blocks && n <= MOST_RANKS; n *= 2)
        BRC_TRY_OR(cleanup, add_surface(r, &o, n, rows));
cleanup:
    brc_memory_free(o.ghost_of);
    brc_memory_free(o.seen);
    brc_layout_free(&layout);
    brc_domain_free(&domain);
    return status;
}

/* ---- messages ---- */

typedef struct ring {
    char *out[2], *in[2];
    brc_exchange *exchange;
    int64_t *ones, *all; /* [ranks] */
} ring;

static brc_status make_ring(brc_context *context, int64_t bytes, ring *x)
{
    const int32_t n = brc_ranks_count(), mine = brc_ranks_mine(), sides = n > 2 ? 2 : n - 1;
    const int32_t rank[2] = {(mine + 1) % n, (mine + n - 1) % n};
    brc_neighbour neighbour[2];
    for (int k = 0; k < sides; ++k) {
        BRC_TRY(BRC_ALLOCATE(context, &x->out[k], bytes, "messages"));
        BRC_TRY(BRC_ALLOCATE(context, &x->in[k], bytes, "messages"));
        neighbour[k] = (brc_neighbour){rank[k], x->out[k], bytes, x->in[k], bytes};
    }
    BRC_TRY(BRC_ALLOCATE(context, &x->ones, n, "messages"));
    BRC_TRY(BRC_ALLOCATE(context, &x->all, n, "messages"));
    for (int32_t k = 0; k < n; ++k)
        x->ones[k] = 1;
    return brc_exchange_create(context, sides, neighbour, &x->exchange);
}

static void free_ring(ring *x)
{
    brc_exchange_free(&x->exchange);
    for (int k = 0; k < 2; ++k) {
        brc_memory_free(x->out[k]);
        brc_memory_free(x->in[k]);
    }
    brc_memory_free(x->ones);
    brc_memory_free(x->all);
}

typedef enum call { EXCHANGE, GATHER, REDUCE, BARRIER, N_CALLS } call;
static const char *const call_names[N_CALLS] = {"exchange", "gather", "reduce", "barrier"};

static brc_status call_once(brc_context *context, call what, ring *x)
{
    int64_t number = 1;
    switch (what) {
    case EXCHANGE: BRC_TRY(brc_exchange_begin(context, x->exchange)); return brc_exchange_finish(context, x->exchange);
    case GATHER: return brc_ranks_gather_all(context, &number, sizeof number, x->ones, x->all);
    case REDUCE: return brc_ranks_reduce(context, BRC_SUM, 1, &number);
    default: return brc_ranks_barrier(context);
    }
}

/* Least seconds of one of several samples, of the slowest rank. */
static brc_status time_call(brc_context *context, call what, int64_t n, ring *x, double *seconds)
{
    *seconds = INFINITY;
    for (int sample = 0; sample < SAMPLES; ++sample) {
        BRC_TRY(brc_ranks_barrier(context));
        const double start = brc_clock_s();
        for (int64_t k = 0; k < n; ++k)
            BRC_TRY(call_once(context, what, x));
        double took = (brc_clock_s() - start) / (double)n;
        BRC_TRY(brc_ranks_most(context, 1, &took));
        *seconds = fmin(*seconds, took);
    }
    return BRC_OK;
}

static brc_status measure_calls(brc_context *context, const brc_ranks_request *r, brc_rows *rows)
{
    static const int64_t lengths[] = {8, 512, 4096, 32768, 262144, 2097152};
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; ++k)
        for (call what = EXCHANGE; what < (k == 0 ? N_CALLS : GATHER); ++what) {
            ring x = {0};
            double seconds = 0;
            brc_status status = make_ring(context, lengths[k], &x);
            if (status == BRC_OK) status = time_call(context, what, lengths[k] > 100000 ? 100 : 1000, &x, &seconds);
            free_ring(&x);
            BRC_TRY(status);
            begin_row(rows, call_names[what], brc_ranks_count());
            brc_rows_number(rows, "ours", seconds);
            brc_rows_number(rows, "seconds", seconds);
            if (what == EXCHANGE) {
                brc_rows_integer(rows, "message_bytes", lengths[k]);
                brc_rows_number(rows, "exchange_bandwidth", (double)lengths[k] / seconds);
            }
            brc_rows_text(rows, "engine", brc_ranks_here().engine);
            BRC_TRY(close_row(r, rows));
        }
    return BRC_OK;
}

/* ---- steps ---- */

/* What the steps of the best sample cost, of the rank that has most. */
static brc_status add_step(brc_context *context, const brc_ranks_request *r, const brc_domain *d,
                           const brc_device *device, double seconds, const brc_ranks_cost *cost, brc_rows *rows)
{
    const double n = (double)r->n_steps;
    int64_t sum = cost->bytes;
    double most[] = {(double)cost->messages / n,    (double)cost->bytes / n,         (double)cost->calls / n,
                     cost->exchange_wait_s / n,     cost->call_wait_s / n,           cost->flight_s / n,
                     (double)brc_memory_resident(), (double)brc_device_bytes(device)};
    BRC_TRY(brc_ranks_most(context, sizeof most / sizeof *most, most));
    BRC_TRY(brc_ranks_reduce(context, BRC_SUM, 1, &sum));
    begin_row(rows, "step", brc_ranks_count());
    brc_rows_text(rows, "model", brc_model_name(r->model));
    brc_rows_integer(rows, "elements", d->n_elements);
    brc_rows_integer(rows, "bonds", d->n_bonds);
    brc_rows_text(rows, "device", r->device);
    brc_rows_text(rows, "precision", brc_precision_name(r->precision));
    brc_rows_integer(rows, "threads", r->n_threads);
    brc_rows_number(rows, "ours", seconds);
    brc_rows_number(rows, "seconds", seconds);
    brc_rows_number(rows, "messages_per_step", most[0]);
    brc_rows_number(rows, "exchanged_bytes_most", most[1]);
    brc_rows_number(rows, "exchanged_bytes_per_step", (double)sum / n);
    brc_rows_number(rows, "calls_per_step", most[2]);
    brc_rows_number(rows, "exchange_wait_s", most[3]);
    brc_rows_number(rows, "call_wait_s", most[4]);
    brc_rows_number(rows, "flight_s", most[5]);
    brc_rows_number(rows, "overlap", most[5] + most[3] > 0 ? most[5] / (most[5] + most[3]) : NAN);
    brc_rows_number(rows, "most_resident_bytes", most[6]);
    brc_rows_number(rows, "device_bytes_per_element", most[7] * brc_ranks_count() / (double)d->n_elements);
    return close_row(r, rows);
}

static brc_ranks_cost difference(const brc_ranks_cost *a, const brc_ranks_cost *b)
{
    return (brc_ranks_cost){a->messages - b->messages,      a->bytes - b->bytes,
                            a->exchanges - b->exchanges,    a->calls - b->calls,
                            a->flight_s - b->flight_s,      a->exchange_wait_s - b->exchange_wait_s,
                            a->call_wait_s - b->call_wait_s};
}

static brc_status time_steps(brc_context *context, brc_simulation *simulation, int64_t n, double *seconds,
                             brc_ranks_cost *cost)
{
    BRC_TRY(brc_simulation_begin_stage(simulation, 0));
    BRC_TRY(brc_simulation_advance(simulation, WARM_STEPS));
    *seconds = INFINITY;
    for (int sample = 0; sample < SAMPLES; ++sample) {
        BRC_TRY(brc_simulation_wait(simulation));
        BRC_TRY(brc_ranks_barrier(context));
        const brc_ranks_cost before = brc_ranks_cost_so_far();
        const double start = brc_clock_s();
        BRC_TRY(brc_simulation_advance(simulation, n));
        BRC_TRY(brc_simulation_wait(simulation));
        const brc_ranks_cost after = brc_ranks_cost_so_far();
        double took = (brc_clock_s() - start) / (double)n;
        BRC_TRY(brc_ranks_most(context, 1, &took));
        if (took < *seconds) *cost = difference(&after, &before);
        *seconds = fmin(*seconds, took);
    }
    return BRC_OK;
}

static brc_status measure_step(brc_context *context, const brc_ranks_request *r, int64_t size, brc_rows *rows)
{
    brc_domain *domain = NULL;
    brc_device *device = NULL;
    brc_simulation *simulation = NULL;
    brc_cube c;
    brc_ranks_cost cost = {0};
    double seconds;
    brc_status status = BRC_OK;
    brc_cube_make(&c, r->model);
    BRC_TRY_OR(cleanup, brc_cube_build(context, size, brc_cube_is_of_spheres(r->model), &domain));
    const brc_device_request open = {.selector = r->device, .precision = r->precision, .n_threads = r->n_threads};
    BRC_TRY_OR(cleanup, brc_device_open(context, &open, &device));
    BRC_TRY_OR(cleanup, brc_device_log_places(context, device));
    BRC_TRY_OR(cleanup, brc_simulation_create(context, &c.scene, domain, device, &simulation));
    BRC_TRY_OR(cleanup, time_steps(context, simulation, r->n_steps, &seconds, &cost));
    status = add_step(context, r, domain, device, seconds, &cost, rows);
cleanup:
    brc_simulation_free(&simulation);
    brc_device_close(&device);
    brc_domain_free(&domain);
    return status;
}

brc_status brc_ranks_measure(brc_context *context, const brc_ranks_request *request, brc_rows *rows)
{
    if (request->surface && brc_ranks_count() > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench ranks: surfaces are counted by one process; start one");
    if (request->exchange) BRC_TRY(measure_calls(context, request, rows));
    for (int k = 0; k < request->n_sizes; ++k) {
        if (request->surface) BRC_TRY(measure_surface(context, request, request->sizes[k], rows));
        if (request->step) BRC_TRY(measure_step(context, request, request->sizes[k], rows));
    }
    return BRC_OK;
}
