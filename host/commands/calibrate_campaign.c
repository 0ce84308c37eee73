/* The elastic tests of a campaign: one thread a solve, since a solve of 10 000 spheres is too small to share; results into a file line by line. */
#include "calibrate.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../solver/beam_sample.h"
#include "../../preprocess/domain.h"
#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Contacts of a packing at rest (NAH19 section 2.3). */
#define CONTACTS 6.2
#define CONTACTS_TOLERANCE 0.02
#define BEAM_POISSON 0.3
#define FILE_BYTES_MOST ((size_t)1 << 30)

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
        if (!rows->rows) BRC_TRY(BRC_ALLOCATE(context, &rows->rows, room, "results of a campaign"));
        else BRC_TRY(brc_memory_resize(context, (void **)&rows->rows, room, sizeof *rows->rows, "results of a campaign"));
        rows->capacity = room;
    }
    rows->rows[rows->n++] = *row;
    return BRC_OK;
}

static int print_line(char *out, size_t room, const brc_calibration_row *r)
{
    return snprintf(out, room, "%lld,%.17g,%llu,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%lld,%lld,%lld,%.3f\n", (long long)r->n_elements,
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
    return n == 16 && line[end] == '\n' && isfinite(r->young) && isfinite(r->poisson);
}

/* Whole lines of an earlier campaign; a torn last line is left out and cut off the file. */
static brc_status read_file(brc_context *context, const char *path, brc_calibration_rows *rows)
{
    char *text = NULL;
    size_t bytes;
    brc_status status = BRC_OK;
    BRC_TRY(brc_file_read_whole(context, path, FILE_BYTES_MOST, &text, &bytes));
    const char *line = text + strlen(header);
    if (strncmp(text, header, strlen(header)) != 0)
        BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_BAD_INPUT, "%s: not a file of `breccia calibrate` of this version; choose another folder", path));
    for (int64_t number = 2; *line; ++number) {
        const char *next = strchr(line, '\n');
        brc_calibration_row row;
        if (!next) break;
        if (!parse_line(line, &row))
            BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_BAD_INPUT, "%s:%lld: not a result; remove the line to have it solved again", path, (long long)number));
        BRC_TRY_OR(cleanup, add_row(context, rows, &row));
        line = next + 1;
    }
    if (*line) status = brc_file_write_whole(context, path, text, (size_t)(line - text));
cleanup:
    brc_memory_free(text);
    return status;
}

/* A campaign at work. What several threads touch is touched inside `omp critical (brc_calibrate)`. */
typedef struct work {
    brc_context *context;
    const brc_calibration_plan *plan;
    brc_beam_sample **sample; /* [n_samples] NULL: nothing left to do with it */
    const brc_calibration_rows *before;
    brc_calibration_rows *rows;
    FILE *file;
    const char *path;
    brc_progress *progress;
    int64_t n_done;
    brc_status status; /* the first failure */
} work;

static bool same(const work *w, int sample, int axis, double coordination, double radius, double young, const brc_calibration_row *row)
{
    return row->n_elements == w->plan->n_elements && row->radius_spread == w->plan->radius_spread && row->seed == w->plan->seed + (uint64_t)sample &&
           row->axis == axis && row->coordination == coordination && row->radius == radius && row->beam_young == young;
}

static const brc_calibration_row *find(const work *w, int sample, int axis, double coordination, double radius, double young)
{
    for (int64_t k = 0; k < w->before->n; ++k)
        if (same(w, sample, axis, coordination, radius, young, &w->before->rows[k])) return &w->before->rows[k];
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

static void fail(work *w, brc_status status, const char *message)
{
#pragma omp critical(brc_calibrate)
    if (w->status == BRC_OK) w->status = BRC_FAIL(w->context, status, "%s", message);
}

static bool stopped(work *w)
{
    brc_status status;
#pragma omp critical(brc_calibrate)
    status = w->status;
    return status != BRC_OK;
}

static brc_status keep(work *w, const brc_calibration_row *row)
{
    char line[512];
    const int length = print_line(line, sizeof line, row);
    brc_status status;
#pragma omp critical(brc_calibrate)
    {
        status = add_row(w->context, w->rows, row);
        if (status == BRC_OK && (fwrite(line, 1, (size_t)length, w->file) != (size_t)length || fflush(w->file) != 0))
            status = BRC_FAIL(w->context, BRC_FILE_FAILED, "%s cannot be written: %s", w->path, strerror(errno));
        if (w->status == BRC_OK) w->status = status;
        if (w->progress) brc_progress_update(w->progress, ++w->n_done);
    }
    return status;
}

static brc_status pack(work *w, brc_context *context, int sample, int n_threads)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    const brc_fill fill = {.kind = BRC_FILL_PACKING, .n_elements = w->plan->n_elements, .seed = w->plan->seed + (uint64_t)sample,
                           .radius_spread = w->plan->radius_spread, .coordination = CONTACTS, .tolerance = CONTACTS_TOLERANCE};
    return brc_beam_sample_pack(context, &shape, &fill, n_threads, &w->sample[sample]);
}

/* All that is missing at one coordination number of one sample: bonded once. */
static brc_status solve(work *w, brc_context *context, brc_device *device, int sample, double coordination)
{
    const brc_calibration_plan *plan = w->plan;
    brc_domain *domain = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(brc_beam_sample_bond(context, w->sample[sample], coordination, 1, &domain));
    for (int k = 0; k < plan->n_axes * plan->n_radii && !stopped(w); ++k)
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
            BRC_TRY_OR(cleanup, keep(w, &row));
        }
cleanup:
    brc_domain_free(&domain);
    return status;
}

/* A context of its own for a thread, silent: what fails is handed to the campaign's. */
static brc_context *thread_context(work *w)
{
    brc_context *context = brc_context_create();
    if (context) brc_log_set_level(context, BRC_LOG_ERROR);
    else fail(w, BRC_NO_MEMORY, "no memory for the threads of a campaign");
    return context;
}

static void pack_all(work *w)
{
    const int n = w->plan->n_samples, together = n >= w->plan->n_threads ? w->plan->n_threads : 1;
#pragma omp parallel for schedule(dynamic, 1) num_threads(together)
    for (int k = 0; k < n; ++k) {
        int missing = 0;
        for (int c = 0; c < w->plan->n_coordinations; ++c) missing += count_missing(w, k, w->plan->coordination[c]);
        brc_context *context = missing && !stopped(w) ? thread_context(w) : NULL;
        if (!context) continue;
        const brc_status status = pack(w, context, k, together > 1 ? 1 : w->plan->n_threads);
        if (status != BRC_OK) fail(w, status, brc_context_message(context));
        brc_context_free(&context);
    }
}

static void solve_all(work *w)
{
    const int n_tasks = w->plan->n_samples * w->plan->n_coordinations;
#pragma omp parallel num_threads(w->plan->n_threads)
    {
        brc_context *context = thread_context(w);
        brc_device *device = NULL;
        brc_status status = context ? brc_device_open(context, &(brc_device_request){.selector = "cpu", .n_threads = 1}, &device) : BRC_NO_MEMORY;
        if (context && status != BRC_OK) fail(w, status, brc_context_message(context));
#pragma omp for schedule(dynamic, 1)
        for (int task = 0; task < n_tasks; ++task) { /* few bonds first: their solves take longest */
            const int sample = task % w->plan->n_samples;
            const double coordination = w->plan->coordination[task / w->plan->n_samples];
            if (stopped(w) || count_missing(w, sample, coordination) == 0) continue;
            status = solve(w, context, device, sample, coordination);
            if (status != BRC_OK) fail(w, status, brc_context_message(context));
        }
        brc_device_close(&device);
        brc_context_free(&context);
    }
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
    brc_calibration_rows before = {0};
    char *path = NULL;
    brc_status status = BRC_OK;
    int64_t missing = 0;
    work w = {.context = context, .plan = plan, .before = &before, .rows = out};
    memset(out, 0, sizeof *out);
    BRC_TRY(brc_file_make_folder(context, folder));
    BRC_TRY(brc_file_join(context, folder, "solves.csv", &path));
    w.path = path;
    const bool there = brc_file_exists(path);
    if (there && !resume)
        BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_BAD_INPUT, "%s is there already; --resume goes on with it, or choose another folder", path));
    if (there) BRC_TRY_OR(cleanup, read_file(context, path, &before));
    BRC_TRY_OR(cleanup, take_finished(&w, &missing));
    if (out->n > 0) brc_log(context, BRC_LOG_INFO, "%s: %lld solves are there, %lld to go", path, (long long)out->n, (long long)missing);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.sample, plan->n_samples, "samples of a campaign"));
    w.file = fopen(path, "a");
    if (!w.file || (!there && fputs(header, w.file) < 0))
        BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_FILE_FAILED, "%s cannot be written: %s", path, strerror(errno)));
    if (missing > 0) {
        pack_all(&w);
        BRC_TRY_OR(cleanup, w.status);
        BRC_TRY_OR(cleanup, brc_progress_create(context, &w.progress, "calibration", missing, "solves", 0, NULL));
        solve_all(&w);
        brc_progress_finish(&w.progress);
        BRC_TRY_OR(cleanup, w.status);
    }
    qsort(out->rows, (size_t)out->n, sizeof *out->rows, compare);
cleanup:
    if (w.file && fclose(w.file) != 0 && status == BRC_OK) status = BRC_FAIL(context, BRC_FILE_FAILED, "%s cannot be written: %s", path, strerror(errno));
    for (int k = 0; w.sample && k < plan->n_samples; ++k) brc_beam_sample_free(&w.sample[k]);
    brc_memory_free(w.sample);
    brc_memory_free(path);
    brc_calibration_rows_free(&before);
    if (status != BRC_OK) brc_calibration_rows_free(out);
    return status;
}
