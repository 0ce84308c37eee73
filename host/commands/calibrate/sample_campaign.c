/* Campaigns: a packing is bonded once for all that is missing at one coordination number. */
#include "sample_campaign.h"
#include "../../base/memory.h"
#include "ensemble.h"
#include <stdlib.h>
#include <string.h>

/* Contacts of a packing at rest (NAH19 section 2.3). */
#define CONTACTS 6.2
#define CONTACTS_TOLERANCE 0.02

enum { ROW_MOST = 256 }; /* bytes of a row on the stack */

/* A campaign at work. What several threads touch is touched inside `omp critical (brc_sample_campaign)`. */
typedef struct work {
    brc_context *context;
    const brc_sample_campaign_kind *kind;
    const brc_calibration_plan *samples;
    const void *plan;
    brc_beam_sample **sample; /* [n_samples] NULL: nothing left to do with it */
    brc_sample_campaign_rows before, *rows;
    brc_ensemble_file file;
} work;

/* Aligned room for one row. */
typedef union row {
    unsigned char bytes[ROW_MOST];
    double aligned;
    int64_t aligned_too;
} row;

static void *row_at(const work *w, const brc_sample_campaign_rows *rows, int64_t k)
{
    return (char *)rows->row + (size_t)k * w->kind->row_size;
}

static brc_status add_row(brc_context *context, const work *w, brc_sample_campaign_rows *rows, const void *added)
{
    if (rows->n == rows->capacity) {
        const int64_t room = rows->capacity > 0 ? 2 * rows->capacity : 256;
        BRC_TRY(brc_memory_resize(context, &rows->row, room, w->kind->row_size, "results of a campaign"));
        rows->capacity = room;
    }
    memcpy(row_at(w, rows, rows->n++), added, w->kind->row_size);
    return BRC_OK;
}

static bool take_line(void *self, const char *line, brc_status *status)
{
    work *w = self;
    row taken;
    memset(&taken, 0, sizeof taken);
    if (!w->kind->parse(line, &taken)) return false;
    *status = add_row(w->context, w, &w->before, &taken);
    return true;
}

static void key_of(const work *w, int64_t sample, double coordination, int k, row *out)
{
    memset(out, 0, sizeof *out);
    w->kind->key(w->plan, w->samples->seed + (uint64_t)sample, coordination, k, out);
}

static const void *find(const work *w, const void *key)
{
    for (int64_t k = 0; k < w->before.n; ++k)
        if (w->kind->same(row_at(w, &w->before, k), key)) return row_at(w, &w->before, k);
    return NULL;
}

/* Tests of one sample at one coordination number that are not there yet. */
static int count_missing(const work *w, int64_t sample, double coordination)
{
    int n = 0;
    for (int k = 0; k < w->kind->count(w->plan); ++k) {
        row key;
        key_of(w, sample, coordination, k, &key);
        n += !find(w, &key);
    }
    return n;
}

/* The cube of a sample, packed to rest on one thread. */
static brc_status pack(void *self, brc_context *context, brc_device *device, int64_t sample)
{
    work *w = self;
    const brc_calibration_plan *s = w->samples;
    const double edge = w->kind->edge;
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {edge, edge, edge}};
    const brc_fill fill = {.kind = BRC_FILL_PACKING,
                           .n_elements = s->n_elements,
                           .seed = s->seed + (uint64_t)sample,
                           .radius_spread = s->radius_spread,
                           .coordination = CONTACTS,
                           .tolerance = CONTACTS_TOLERANCE};
    int missing = 0;
    (void)device;
    for (int c = 0; c < s->n_coordinations; ++c)
        missing += count_missing(w, sample, s->coordination[c]);
    return missing ? brc_beam_sample_pack(context, &shape, &fill, 1, &w->sample[sample]) : BRC_OK;
}

static brc_status keep(work *w, brc_context *context, const void *result)
{
    char line[512];
    brc_status status;
    w->kind->print(result, line, sizeof line);
#pragma omp critical(brc_sample_campaign)
    {
        status = add_row(context, w, w->rows, result);
        if (status == BRC_OK) status = brc_ensemble_keep(context, &w->file, line);
    }
    return status;
}

/* All that is missing at one coordination number of one sample. Few bonds first: their tests take longest. */
static brc_status test_all(void *self, brc_context *context, brc_device *device, int64_t task)
{
    work *w = self;
    const int64_t sample = task % w->samples->n_samples;
    const double coordination = w->samples->coordination[task / w->samples->n_samples];
    brc_domain *domain = NULL;
    void *kept = NULL;
    brc_status status = BRC_OK;
    int missing = count_missing(w, sample, coordination);
    if (missing == 0) return BRC_OK;
    BRC_TRY(brc_beam_sample_bond(context, w->sample[sample], coordination, false, 1, &domain));
    for (int k = 0; missing > 0; ++k) {
        row now;
        key_of(w, sample, coordination, k, &now);
        const bool there = find(w, &now) != NULL;
        if (there && !w->kind->forget) continue;
        BRC_TRY_OR(cleanup, w->kind->test(context, device, domain, &now, &kept));
        if (there) continue;
        BRC_TRY_OR(cleanup, keep(w, context, &now));
        --missing;
    }
cleanup:
    if (kept) w->kind->forget(&kept);
    brc_domain_free(&domain);
    return status;
}

/* Tests of the plan that were there already go to the rows of this campaign. */
static brc_status take_finished(work *w, int64_t *missing)
{
    *missing = 0;
    for (int sample = 0; sample < w->samples->n_samples; ++sample)
        for (int c = 0; c < w->samples->n_coordinations; ++c)
            for (int k = 0; k < w->kind->count(w->plan); ++k) {
                row key;
                key_of(w, sample, w->samples->coordination[c], k, &key);
                const void *there = find(w, &key);
                if (there)
                    BRC_TRY(add_row(w->context, w, w->rows, there));
                else
                    ++*missing;
            }
    return BRC_OK;
}

brc_status brc_sample_campaign_run(brc_context *context, const brc_sample_campaign_kind *kind,
                                   const brc_calibration_plan *samples, const void *plan, const char *folder,
                                   bool resume, brc_sample_campaign_rows *out)
{
    work w = {.context = context, .kind = kind, .samples = samples, .plan = plan, .rows = out};
    brc_status status = BRC_OK;
    int64_t missing = 0;
    memset(out, 0, sizeof *out);
    if (kind->row_size > ROW_MOST)
        return BRC_FAIL(context, BRC_INTERNAL, "a row of %s has %zu bytes, campaigns have room for %d", kind->file,
                        kind->row_size, ROW_MOST);
    BRC_TRY_OR(cleanup, brc_ensemble_open(context, folder, kind->file, kind->header, resume, take_line, &w, &w.file));
    BRC_TRY_OR(cleanup, take_finished(&w, &missing));
    if (out->n > 0)
        brc_log(context, BRC_LOG_INFO, "%s: %lld %s are there, %lld to go", w.file.path, (long long)out->n, kind->unit,
                (long long)missing);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.sample, samples->n_samples, "samples of a campaign"));
    if (missing > 0) {
        BRC_TRY_OR(cleanup, brc_ensemble_each(context, samples->n_threads, samples->n_samples, pack, &w));
        BRC_TRY_OR(cleanup, brc_progress_create(context, &w.file.progress, kind->title, missing, kind->unit, 0, NULL));
        BRC_TRY_OR(cleanup, brc_ensemble_each(context, samples->n_threads,
                                              (int64_t)samples->n_samples * samples->n_coordinations, test_all, &w));
    }
    if (out->n > 0) qsort(out->row, (size_t)out->n, kind->row_size, kind->compare);
cleanup:
    if (status == BRC_OK)
        status = brc_ensemble_close(context, &w.file);
    else
        brc_ensemble_close(context, &w.file);
    for (int k = 0; w.sample && k < samples->n_samples; ++k)
        brc_beam_sample_free(&w.sample[k]);
    brc_memory_free(w.sample);
    brc_memory_free(w.before.row);
    if (status != BRC_OK) {
        brc_memory_free(out->row);
        memset(out, 0, sizeof *out);
    }
    return status;
}
