/* The elastic tests of a campaign: one thread a solve, since a solve of 10 000 spheres is too small to share; results into a file line by line. */
#include "calibrate.h"
#include "../base/memory.h"
#include "../../preprocess/domain.h"
#include "ensemble.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Contacts of a packing at rest (NAH19 section 2.3). */
#define CONTACTS 6.2
#define CONTACTS_TOLERANCE 0.02
#define BEAM_POISSON 0.3

static const char header[] = "elements,radius_spread,seed,axis,cn,r_m,E_m_Pa,E_ratio,nu,nu_y,nu_z,inner,bonds,loose,iterations,seconds\n";

void brc_calibration_rows_free(brc_calibration_rows *rows)
{
    brc_memory_free(rows->rows);
    memset(rows, 0, sizeof *rows);
}

static brc_status add_row(brc_context *context, brc_calibration_rows *rows, const brc_calibration_row *row)
{
    if (rows->n == rows->capacity) {
        const int64_t room = rows->capacity > 0 ? 2 * rows->capacity : 256;
        BRC_TRY(brc_memory_resize(context, (void **)&rows->rows, room, sizeof *rows->rows, "results of a campaign"));
        rows->capacity = room;
    }
    rows->rows[rows->n++] = *row;
    return BRC_OK;
}

static void print_line(char *out, size_t room, const brc_calibration_row *r)
{
    snprintf(out, room, "%lld,%.17g,%llu,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%lld,%lld,%lld,%.3f\n", (long long)r->n_elements,
                    r->radius_spread, (unsigned long long)r->seed, r->axis, r->coordination, r->radius, r->beam_young, r->young, r->poisson, r->lateral[0],
                    r->lateral[1], r->inner, (long long)r->n_bonds, (long long)r->n_loose, (long long)r->iterations, r->seconds);
}

static bool parse_line(const char *line, brc_calibration_row *r)
{
    long long elements, bonds, loose, iterations;
    unsigned long long seed;
    int end = 0;
    const int n = sscanf(line, "%lld,%lf,%llu,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lld,%lld,%lld,%lf%n", &elements, &r->radius_spread, &seed, &r->axis,
                         &r->coordination, &r->radius, &r->beam_young, &r->young, &r->poisson, &r->lateral[0], &r->lateral[1], &r->inner, &bonds, &loose, &iterations, &r->seconds, &end);
    r->n_elements = elements;
    r->seed = seed;
    r->n_bonds = bonds;
    r->n_loose = loose;
    r->iterations = iterations;
    return n == 16 && line[end] == '\0' && isfinite(r->young) && isfinite(r->poisson);
}

/* A campaign at work. What several threads touch is touched inside `omp critical (brc_calibrate)`. */
typedef struct work {
    brc_context *context;
    const brc_calibration_plan *plan;
    brc_beam_sample **sample; /* [n_samples] NULL: nothing left to do with it */
    brc_calibration_rows before;
    brc_calibration_rows *rows;
    brc_ensemble_file file;
} work;

static bool take_line(void *self, const char *line, brc_status *status)
{
    work *w = self;
    brc_calibration_row row;
    if (!parse_line(line, &row)) return false;
    *status = add_row(w->context, &w->before, &row);
    return true;
}

static bool same(const work *w, int sample, int axis, double coordination, double radius, double young, const brc_calibration_row *row)
{
    return row->n_elements == w->plan->n_elements && row->radius_spread == w->plan->radius_spread && row->seed == w->plan->seed + (uint64_t)sample &&
           row->axis == axis && row->coordination == coordination && row->radius == radius && row->beam_young == young;
}

static const brc_calibration_row *find(const work *w, int sample, int axis, double coordination, double radius, double young)
{
    for (int64_t k = 0; k < w->before.n; ++k)
        if (same(w, sample, axis, coordination, radius, young, &w->before.rows[k])) return &w->before.rows[k];
    return NULL;
}

/* Solves of one sample and one coordination number that are not there yet. */
static int count_missing(const work *w, int sample, double coordination)
{
    int n = 0;
    for (int axis = 0; axis < w->plan->n_axes; ++axis)
        for (int r = 0; r < w->plan->n_radii; ++r)
            for (int y = 0; y < w->plan->n_youngs; ++y) n += !find(w, sample, axis, coordination, w->plan->radius[r], w->plan->young[y]);
    return n;
}

static brc_status keep(work *w, brc_context *context, const brc_calibration_row *row)
{
    char line[512];
    brc_status status;
    print_line(line, sizeof line, row);
#pragma omp critical(brc_calibrate)
    {
        status = add_row(context, w->rows, row);
        if (status == BRC_OK) status = brc_ensemble_keep(context, &w->file, line);
    }
    return status;
}

brc_status brc_calibrate_pack(brc_context *context, const brc_calibration_plan *plan, int64_t sample, double edge, brc_beam_sample **out)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {edge, edge, edge}};
    const brc_fill fill = {.kind = BRC_FILL_PACKING, .n_elements = plan->n_elements, .seed = plan->seed + (uint64_t)sample,
                           .radius_spread = plan->radius_spread, .coordination = CONTACTS, .tolerance = CONTACTS_TOLERANCE};
    return brc_beam_sample_pack(context, &shape, &fill, 1, out);
}

static brc_status pack(void *self, brc_context *context, brc_device *device, int64_t sample)
{
    work *w = self;
    int missing = 0;
    (void)device;
    for (int c = 0; c < w->plan->n_coordinations; ++c) missing += count_missing(w, (int)sample, w->plan->coordination[c]);
    return missing ? brc_calibrate_pack(context, w->plan, sample, 1, &w->sample[sample]) : BRC_OK;
}

/* All that is missing at one coordination number of one sample: bonded once. Few bonds first: their solves take longest. */
static brc_status solve_all(void *self, brc_context *context, brc_device *device, int64_t task)
{
    work *w = self;
    const brc_calibration_plan *plan = w->plan;
    const int sample = (int)(task % plan->n_samples);
    const double coordination = plan->coordination[task / plan->n_samples];
    brc_domain *domain = NULL;
    brc_status status = BRC_OK;
    if (count_missing(w, sample, coordination) == 0) return BRC_OK;
    BRC_TRY(brc_beam_sample_bond(context, w->sample[sample], coordination, 1, &domain));
    for (int k = 0; k < plan->n_axes * plan->n_radii; ++k)
        for (int y = 0; y < plan->n_youngs; ++y) {
            brc_beam_answer answer;
            const int axis = k / plan->n_radii, r = k % plan->n_radii;
            if (find(w, sample, axis, coordination, plan->radius[r], plan->young[y])) continue;
            const brc_beam_pull pull = {.axis = axis, .radius = plan->radius[r], .beam_poisson = BEAM_POISSON, .beam_young = plan->young[y]};
            BRC_TRY_OR(cleanup, brc_beam_sample_pull(context, device, domain, &pull, &answer));
            const brc_calibration_row row = {.n_elements = plan->n_elements, .radius_spread = plan->radius_spread,
                                             .seed = plan->seed + (uint64_t)sample, .axis = axis, .coordination = coordination, .radius = plan->radius[r],
                                             .beam_young = plan->young[y], .young = answer.young, .poisson = answer.poisson,
                                             .lateral = {answer.lateral[0], answer.lateral[1]}, .inner = answer.inner, .n_bonds = answer.n_bonds, .n_loose = answer.n_loose,
                                             .iterations = answer.iterations, .seconds = answer.seconds};
            BRC_TRY_OR(cleanup, keep(w, context, &row));
        }
cleanup:
    brc_domain_free(&domain);
    return status;
}

static int compare(const void *left, const void *right)
{
    const brc_calibration_row *a = left, *b = right;
    const double keys[2][5] = {{a->coordination, a->radius, a->beam_young, (double)a->seed, a->axis},
                               {b->coordination, b->radius, b->beam_young, (double)b->seed, b->axis}};
    for (int k = 0; k < 5; ++k)
        if (keys[0][k] != keys[1][k]) return keys[0][k] < keys[1][k] ? -1 : 1;
    return 0;
}

/* Solves of the plan that were there already go to the rows of this campaign. */
static brc_status take_finished(work *w, int64_t *missing)
{
    const brc_calibration_plan *plan = w->plan;
    *missing = 0;
    for (int s = 0; s < plan->n_samples; ++s)
        for (int c = 0; c < plan->n_coordinations; ++c)
            for (int r = 0; r < plan->n_radii; ++r)
                for (int y = 0; y < plan->n_youngs * plan->n_axes; ++y) {
                    const brc_calibration_row *row = find(w, s, y % plan->n_axes, plan->coordination[c], plan->radius[r], plan->young[y / plan->n_axes]);
                    if (row) BRC_TRY(add_row(w->context, w->rows, row));
                    else ++*missing;
                }
    return BRC_OK;
}

brc_status brc_calibrate_campaign(brc_context *context, const brc_calibration_plan *plan, const char *folder, bool resume, brc_calibration_rows *out)
{
    brc_status status = BRC_OK;
    int64_t missing = 0;
    work w = {.context = context, .plan = plan, .rows = out};
    memset(out, 0, sizeof *out);
    BRC_TRY_OR(cleanup, brc_ensemble_open(context, folder, "solves.csv", header, resume, take_line, &w, &w.file));
    BRC_TRY_OR(cleanup, take_finished(&w, &missing));
    if (out->n > 0) brc_log(context, BRC_LOG_INFO, "%s: %lld solves are there, %lld to go", w.file.path, (long long)out->n, (long long)missing);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.sample, plan->n_samples, "samples of a campaign"));
    if (missing > 0) {
        BRC_TRY_OR(cleanup, brc_ensemble_each(context, plan->n_threads, plan->n_samples, pack, &w));
        BRC_TRY_OR(cleanup, brc_progress_create(context, &w.file.progress, "calibration", missing, "solves", 0, NULL));
        BRC_TRY_OR(cleanup, brc_ensemble_each(context, plan->n_threads, (int64_t)plan->n_samples * plan->n_coordinations, solve_all, &w));
    }
    qsort(out->rows, (size_t)out->n, sizeof *out->rows, compare);
cleanup:
    if (status == BRC_OK) status = brc_ensemble_close(context, &w.file);
    else brc_ensemble_close(context, &w.file);
    for (int k = 0; w.sample && k < plan->n_samples; ++k) brc_beam_sample_free(&w.sample[k]);
    brc_memory_free(w.sample);
    brc_calibration_rows_free(&w.before);
    if (status != BRC_OK) brc_calibration_rows_free(out);
    return status;
}
