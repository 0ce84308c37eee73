/* How fast the laws go. */
#include "throughput.h"
#include "cube.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/device/device_bandwidth.h"
#include "../host/solver/simulation.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES 5

/* What was measured of one combination. A machine whose memory changes its speed while it runs would be held against
 * what it was before: each sample lies between two copies, and its fraction is of their mean. */
typedef struct sampling {
    double seconds[SAMPLES];    /* of a step, ascending */
    double copies[SAMPLES + 1]; /* [byte/s], ascending */
    double fractions[SAMPLES];  /* of the mean of the copies before and after, ascending */
    int64_t n_steps;            /* a sample */
} sampling;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Seconds of n steps, the device idle before and after. */
static brc_status time_steps(brc_simulation *simulation, int64_t n, double *seconds)
{
    const double start = brc_clock_s();
    BRC_TRY(brc_simulation_advance(simulation, n));
    BRC_TRY(brc_simulation_wait(simulation));
    *seconds = brc_clock_s() - start;
    return BRC_OK;
}

/* Steps of a sample: as many as take `least` seconds. */
static brc_status choose_steps(brc_simulation *simulation, double least, int64_t *n_steps)
{
    double seconds;
    BRC_TRY(time_steps(simulation, 3, &seconds)); /* kernels are built, pages touched */
    int64_t n = 1;
    BRC_TRY(time_steps(simulation, n, &seconds));
    while (seconds < least) {
        /* At most tenfold at once: the first steps are no good guide. */
        const double wanted = ceil((double)n * 1.1 * least / fmax(seconds, least / 9));
        n = n + 1 > (int64_t)wanted ? n + 1 : (int64_t)wanted;
        BRC_TRY(time_steps(simulation, n, &seconds));
    }
    *n_steps = n;
    return BRC_OK;
}

static brc_status sample(const brc_throughput_request *request, brc_device *device, brc_simulation *simulation,
                         sampling *out)
{
    const double floor_bytes = brc_simulation_floor_bytes(simulation);
    BRC_TRY(brc_simulation_begin_stage(simulation, 0));
    BRC_TRY(choose_steps(simulation, request->sample_s, &out->n_steps));
    for (int k = 0; k <= SAMPLES; ++k) {
        BRC_TRY(brc_device_copy_bandwidth(device, request->bandwidth_bytes, brc_clock_s, &out->copies[k]));
        if (k > 0)
            out->fractions[k - 1] = floor_bytes / out->seconds[k - 1] / (0.5 * (out->copies[k - 1] + out->copies[k]));
        if (k == SAMPLES) break;
        BRC_TRY(time_steps(simulation, out->n_steps, &out->seconds[k]));
        out->seconds[k] /= (double)out->n_steps;
    }
    qsort(out->seconds, SAMPLES, sizeof *out->seconds, ascending);
    qsort(out->copies, SAMPLES + 1, sizeof *out->copies, ascending);
    qsort(out->fractions, SAMPLES, sizeof *out->fractions, ascending);
    return BRC_OK;
}

static void add_figures(brc_rows *rows, const brc_domain *domain, const brc_simulation *simulation,
                        int64_t device_bytes, const sampling *s)
{
    const double per_step = s->seconds[SAMPLES / 2], floor_bytes = brc_simulation_floor_bytes(simulation);
    const double bonds = (double)domain->n_bonds, elements = (double)domain->n_elements;
    brc_rows_number(rows, "ours", bonds / per_step);
    brc_rows_number(rows, "seconds", per_step);
    brc_rows_integer(rows, "elements", domain->n_elements);
    brc_rows_integer(rows, "bonds", domain->n_bonds);
    brc_rows_number(rows, "bond_updates_per_s", bonds / per_step);
    brc_rows_number(rows, "bond_updates_per_s_min", bonds / s->seconds[SAMPLES - 1]);
    brc_rows_number(rows, "bond_updates_per_s_max", bonds / s->seconds[0]);
    brc_rows_number(rows, "element_updates_per_s", elements / per_step);
    brc_rows_integer(rows, "steps_per_sample", s->n_steps);
    brc_rows_integer(rows, "samples", SAMPLES);
    brc_rows_number(rows, "floor_bytes_per_step", floor_bytes);
    brc_rows_number(rows, "floor_bytes_per_bond", floor_bytes / bonds);
    brc_rows_number(rows, "copy_bandwidth", 0.5 * (s->copies[SAMPLES / 2] + s->copies[SAMPLES / 2 + 1]));
    brc_rows_number(rows, "copy_bandwidth_min", s->copies[0]);
    brc_rows_number(rows, "copy_bandwidth_max", s->copies[SAMPLES]);
    brc_rows_number(rows, "bandwidth_fraction", s->fractions[SAMPLES / 2]);
    brc_rows_number(rows, "bandwidth_fraction_min", s->fractions[0]);
    brc_rows_number(rows, "bandwidth_fraction_max", s->fractions[SAMPLES - 1]);
    brc_rows_number(rows, "device_bytes_per_element", (double)device_bytes / elements);
}

/* One combination, into the last row. */
static brc_status measure(brc_context *context, const brc_throughput_request *request, const brc_domain *domain,
                          brc_model_kind model, const char *selector, brc_precision precision, int n_threads,
                          brc_rows *rows)
{
    brc_status status = BRC_OK;
    brc_device *device = NULL;
    brc_simulation *simulation = NULL;
    brc_cube c;
    brc_cube_make(&c, model);
    const brc_device_request open = {
        .selector = selector, .precision = precision, .n_threads = n_threads, .exact = request->exact};
    sampling s;
    BRC_TRY_OR(cleanup, brc_device_open(context, &open, &device));
    const brc_device_info *info = brc_device_get_info(device);
    brc_rows_text(rows, "device_name", info->name);
    brc_rows_text(rows, "driver", info->driver);
    brc_rows_integer(rows, "lanes", brc_device_lanes(device));
    BRC_TRY_OR(cleanup, brc_simulation_create(context, &c.scene, domain, device, &simulation));
    const int64_t device_bytes = brc_device_bytes(device);
    BRC_TRY_OR(cleanup, sample(request, device, simulation, &s));
    add_figures(rows, domain, simulation, device_bytes, &s);
cleanup:
    brc_simulation_free(&simulation);
    brc_device_close(&device);
    return status;
}

/* Measure one combination and keep going where a device is not there or too small. */
static brc_status add_row(brc_context *context, const brc_throughput_request *request, const brc_domain *domain,
                          brc_model_kind model, const char *selector, brc_precision precision, int n_threads,
                          brc_rows *rows)
{
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "throughput");
    brc_rows_text(rows, "quantity", "bond_updates_per_s");
    brc_rows_text(rows, "model", brc_model_name(model));
    brc_rows_text(rows, "unit", "1/s");
    brc_rows_number(rows, "reference", NAN);
    brc_rows_number(rows, "paper", NAN);
    brc_rows_number(rows, "ours", NAN);
    brc_rows_text(rows, "precision", brc_precision_name(precision));
    brc_rows_text(rows, "device", selector);
    brc_rows_integer(rows, "threads", n_threads);
    brc_rows_text(rows, "contraction", request->exact ? "off" : "allowed");
    brc_status status = measure(context, request, domain, model, selector, precision, n_threads, rows);
    if (status == BRC_BAD_INPUT || status == BRC_DEVICE_FAILED || status == BRC_NO_MEMORY) {
        brc_log(context, BRC_LOG_WARNING, "throughput on %s: %s", selector, brc_context_message(context));
        brc_rows_text(rows, "note", brc_context_message(context));
        brc_context_clear(context);
        status = BRC_OK;
    }
    brc_rows_stamp(rows);
    if (status == BRC_OK) status = rows->status;
    if (status == BRC_OK && request->row) status = request->row(request->self, rows);
    return status;
}

static brc_status measure_domain(brc_context *context, const brc_throughput_request *r, const brc_domain *domain,
                                 bool spheres, brc_rows *rows)
{
    for (int m = 0; m < r->n_models; ++m)
        for (int d = 0; d < r->n_devices; ++d)
            for (int p = 0; p < r->n_precisions; ++p)
                for (int t = 0; t < r->n_threads; ++t) {
                    if (brc_cube_is_of_spheres(r->models[m]) != spheres) continue;
                    const bool cpu = strcmp(r->devices[d], "cpu") == 0;
                    if (!cpu && t > 0) continue; /* other devices choose their threads themselves */
                    BRC_TRY(add_row(context, r, domain, r->models[m], r->devices[d], r->precisions[p],
                                    cpu ? r->threads[t] : 0, rows));
                }
    return BRC_OK;
}

brc_status brc_throughput_measure(brc_context *context, const brc_throughput_request *request, brc_rows *rows)
{
    for (int s = 0; s < request->n_sizes; ++s)
        for (int spheres = 0; spheres < 2; ++spheres) {
            bool wanted = false;
            for (int m = 0; m < request->n_models; ++m)
                wanted |= brc_cube_is_of_spheres(request->models[m]) == (spheres == 1);
            if (!wanted) continue;
            brc_domain *domain;
            BRC_TRY(brc_cube_build(context, request->sizes[s], spheres == 1, &domain));
            const brc_status status = measure_domain(context, request, domain, spheres == 1, rows);
            brc_domain_free(&domain);
            if (status != BRC_OK) return status;
        }
    return BRC_OK;
}
