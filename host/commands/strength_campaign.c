/* The fracture tests of a campaign: a packing is bonded once for all that is missing at one coordination number. */
#include "strength_campaign.h"
#include "../base/memory.h"
#include "ensemble.h"
#include "strength_test.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The paper's cube [m], and nu_m, which hardly matters (0.3 % of E from 0 to 0.45). */
#define EDGE 2e-3
#define BEAM_POISSON 0.3

static const char header[] = "elements,radius_spread,seed,axis,cn,r_m,E_m_Pa,sigma_m_Pa,passages,k,k_first,strain,bonds,loose,broken,steps,seconds\n";

void brc_strength_rows_free(brc_strength_rows *rows)
{
    brc_memory_free(rows->rows);
    memset(rows, 0, sizeof *rows);
}

static brc_status add_row(brc_context *context, brc_strength_rows *rows, const brc_strength_row *row)
{
    if (rows->n == rows->capacity) {
        const int64_t room = rows->capacity > 0 ? 2 * rows->capacity : 256;
        BRC_TRY(brc_memory_resize(context, (void **)&rows->rows, room, sizeof *rows->rows, "results of a campaign"));
        rows->capacity = room;
    }
    rows->rows[rows->n++] = *row;
    return BRC_OK;
}

static void print_line(char *out, size_t room, const brc_strength_row *r)
{
    snprintf(out, room, "%lld,%.17g,%llu,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%lld,%lld,%lld,%lld,%.3f\n", (long long)r->n_elements,
             r->radius_spread, (unsigned long long)r->seed, r->axis, r->coordination, r->radius, r->beam_young, r->limit, r->passages, r->ratio, r->first,
             r->strain, (long long)r->n_bonds, (long long)r->n_loose, (long long)r->n_broken, (long long)r->n_steps, r->seconds);
}

static bool parse_line(const char *line, brc_strength_row *r)
{
    long long elements, bonds, loose, broken, steps;
    unsigned long long seed;
    int end = 0;
    const int n = sscanf(line, "%lld,%lf,%llu,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lld,%lld,%lld,%lld,%lf%n", &elements, &r->radius_spread, &seed, &r->axis,
                         &r->coordination, &r->radius, &r->beam_young, &r->limit, &r->passages, &r->ratio, &r->first, &r->strain, &bonds, &loose, &broken,
                         &steps, &r->seconds, &end);
    r->n_elements = elements;
    r->seed = seed;
    r->n_bonds = bonds;
    r->n_loose = loose;
    r->n_broken = broken;
    r->n_steps = steps;
    return n == 17 && line[end] == '\0' && isfinite(r->ratio) && isfinite(r->first);
}

/* A campaign at work. What several threads touch is touched inside `omp critical (brc_strength)`. */
typedef struct work {
    brc_context *context;
    const brc_strength_plan *plan;
    brc_beam_sample **sample; /* [n_samples] NULL: nothing left to do with it */
    brc_strength_rows before;
    brc_strength_rows *rows;
    brc_ensemble_file file;
} work;

static bool take_line(void *self, const char *line, brc_status *status)
{
    work *w = self;
    brc_strength_row row;
    if (!parse_line(line, &row)) return false;
    *status = add_row(w->context, &w->before, &row);
    return true;
}

/* Test k of a sample and a coordination number, with its keys alone. */
static int n_each(const brc_strength_plan *plan) { return plan->samples.n_axes * plan->samples.n_radii * plan->samples.n_youngs * plan->n_limits; }

static brc_strength_row test_of(const brc_strength_plan *plan, int sample, double coordination, int k)
{
    const brc_calibration_plan *s = &plan->samples;
    const int limit = k % plan->n_limits, young = k / plan->n_limits % s->n_youngs, radius = k / plan->n_limits / s->n_youngs % s->n_radii;
    return (brc_strength_row){.n_elements = s->n_elements, .radius_spread = s->radius_spread, .seed = s->seed + (uint64_t)sample,
                              .axis = k / plan->n_limits / s->n_youngs / s->n_radii, .coordination = coordination, .radius = s->radius[radius],
                              .beam_young = s->young[young], .limit = plan->limit[limit], .passages = plan->passages};
}

static const brc_strength_row *find(const work *w, const brc_strength_row *key)
{
    for (int64_t k = 0; k < w->before.n; ++k) {
        const brc_strength_row *row = &w->before.rows[k];
        if (row->n_elements == key->n_elements && row->radius_spread == key->radius_spread && row->seed == key->seed && row->axis == key->axis &&
            row->coordination == key->coordination && row->radius == key->radius && row->beam_young == key->beam_young && row->limit == key->limit &&
            row->passages == key->passages)
            return row;
    }
    return NULL;
}

static int count_missing(const work *w, int sample, double coordination)
{
    int n = 0;
    for (int k = 0; k < n_each(w->plan); ++k) {
        const brc_strength_row key = test_of(w->plan, sample, coordination, k);
        n += !find(w, &key);
    }
    return n;
}

static brc_status pack(void *self, brc_context *context, brc_device *device, int64_t sample)
{
    work *w = self;
    const brc_calibration_plan *s = &w->plan->samples;
    int missing = 0;
    (void)device;
    for (int c = 0; c < s->n_coordinations; ++c) missing += count_missing(w, (int)sample, s->coordination[c]);
    return missing ? brc_calibrate_pack(context, s, sample, EDGE, &w->sample[sample]) : BRC_OK;
}

static brc_status keep(work *w, brc_context *context, const brc_strength_row *row)
{
    char line[512];
    brc_status status;
    print_line(line, sizeof line, row);
#pragma omp critical(brc_strength)
    {
        status = add_row(context, w->rows, row);
        if (status == BRC_OK) status = brc_ensemble_keep(context, &w->file, line);
    }
    return status;
}

/* All that is missing at one coordination number of one sample. Few bonds first: their tests take longest. */
static brc_status test_all(void *self, brc_context *context, brc_device *device, int64_t task)
{
    work *w = self;
    const brc_calibration_plan *s = &w->plan->samples;
    const int sample = (int)(task % s->n_samples);
    const double coordination = s->coordination[task / s->n_samples];
    brc_domain *domain = NULL;
    brc_status status = BRC_OK;
    if (count_missing(w, sample, coordination) == 0) return BRC_OK;
    BRC_TRY(brc_beam_sample_bond(context, w->sample[sample], coordination, 1, &domain));
    for (int k = 0; k < n_each(w->plan); ++k) {
        brc_strength_row row = test_of(w->plan, sample, coordination, k);
        brc_strength_answer answer;
        if (find(w, &row)) continue;
        const brc_strength_pull pull = {.axis = row.axis, .radius_spread = row.radius_spread, .radius = row.radius, .beam_poisson = BEAM_POISSON,
                                        .beam_young = row.beam_young, .limit = row.limit, .passages = row.passages};
        BRC_TRY_OR(cleanup, brc_strength_test(context, device, domain, &pull, &answer));
        row.ratio = answer.ratio;
        row.first = answer.first;
        row.strain = answer.strain;
        row.n_bonds = answer.n_bonds;
        row.n_loose = answer.n_loose;
        row.n_broken = answer.n_broken;
        row.n_steps = answer.n_steps;
        row.seconds = answer.seconds;
        BRC_TRY_OR(cleanup, keep(w, context, &row));
    }
cleanup:
    brc_domain_free(&domain);
    return status;
}

static int compare(const void *left, const void *right)
{
    const brc_strength_row *a = left, *b = right;
    const double keys[2][6] = {{a->coordination, a->radius, a->beam_young, a->limit, (double)a->seed, a->axis},
                               {b->coordination, b->radius, b->beam_young, b->limit, (double)b->seed, b->axis}};
    for (int k = 0; k < 6; ++k)
        if (keys[0][k] != keys[1][k]) return keys[0][k] < keys[1][k] ? -1 : 1;
    return 0;
}

/* Tests of the plan that were there already go to the rows of this campaign. */
static brc_status take_finished(work *w, int64_t *missing)
{
    const brc_calibration_plan *s = &w->plan->samples;
    *missing = 0;
    for (int sample = 0; sample < s->n_samples; ++sample)
        for (int c = 0; c < s->n_coordinations; ++c)
            for (int k = 0; k < n_each(w->plan); ++k) {
                const brc_strength_row key = test_of(w->plan, sample, s->coordination[c], k), *row = find(w, &key);
                if (row) BRC_TRY(add_row(w->context, w->rows, row));
                else ++*missing;
            }
    return BRC_OK;
}

brc_status brc_strength_campaign(brc_context *context, const brc_strength_plan *plan, const char *folder, bool resume, brc_strength_rows *out)
{
    const brc_calibration_plan *s = &plan->samples;
    work w = {.context = context, .plan = plan, .rows = out};
    brc_status status = BRC_OK;
    int64_t missing = 0;
    memset(out, 0, sizeof *out);
    BRC_TRY_OR(cleanup, brc_ensemble_open(context, folder, "tests.csv", header, resume, take_line, &w, &w.file));
    BRC_TRY_OR(cleanup, take_finished(&w, &missing));
    if (out->n > 0) brc_log(context, BRC_LOG_INFO, "%s: %lld tests are there, %lld to go", w.file.path, (long long)out->n, (long long)missing);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.sample, s->n_samples, "samples of a campaign"));
    if (missing > 0) {
        BRC_TRY_OR(cleanup, brc_ensemble_each(context, s->n_threads, s->n_samples, pack, &w));
        BRC_TRY_OR(cleanup, brc_progress_create(context, &w.file.progress, "fracture tests", missing, "tests", 0, NULL));
        BRC_TRY_OR(cleanup, brc_ensemble_each(context, s->n_threads, (int64_t)s->n_samples * s->n_coordinations, test_all, &w));
    }
    qsort(out->rows, (size_t)out->n, sizeof *out->rows, compare);
cleanup:
    if (status == BRC_OK) status = brc_ensemble_close(context, &w.file);
    else brc_ensemble_close(context, &w.file);
    for (int k = 0; w.sample && k < s->n_samples; ++k) brc_beam_sample_free(&w.sample[k]);
    brc_memory_free(w.sample);
    brc_strength_rows_free(&w.before);
    if (status != BRC_OK) brc_strength_rows_free(out);
    return status;
}
