/* `breccia export`: what is there is found by looking, so that a killed run exports as far as it came. */
#include "export.h"
#include "export_vtu.h"
#include "frame_file.h"
#include "../h5_read.h"
#include "../text.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

typedef struct job {
    brc_context *context;
    const char *folder, *out; /* borrowed */
    int64_t n_frames;
    double *time; /* [n_frames] as in the index of the run */
    int64_t n_files;
} job;

/* folder/<prefix>NNNNNN<suffix>, freed by brc_memory_free. */
static brc_status frame_path(const job *j, const char *folder, const char *prefix, int64_t frame, const char *suffix,
                             char **out)
{
    char name[64];
    snprintf(name, sizeof name, "%s%06lld%s", prefix, (long long)frame, suffix);
    return brc_file_join(j->context, folder, name, out);
}

static brc_status count_frames(job *j)
{
    for (bool more = true; more; j->n_frames += more) {
        char *path;
        BRC_TRY(frame_path(j, j->folder, "frames/", j->n_frames, ".vtkhdf", &path));
        more = brc_file_exists(path);
        brc_memory_free(path);
    }
    return BRC_OK;
}

/* Times of the index; frames that a killed run had not yet listed follow one apart. */
static brc_status read_times(job *j)
{
    char *path = NULL;
    brc_h5_read h5;
    int64_t listed = 0, columns;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(j->context, &j->time, j->n_frames, "frame times"));
    BRC_TRY_OR(cleanup, brc_file_join(j->context, j->folder, "result.h5", &path));
    if (brc_file_exists(path)) {
        BRC_TRY_OR(cleanup, brc_h5_read_open(j->context, path, &h5));
        status = brc_h5_read_size(&h5, "frames/time", &listed, &columns);
        if (listed > j->n_frames) listed = j->n_frames;
        if (status == BRC_OK) status = brc_h5_read_rows(&h5, "frames/time", H5T_NATIVE_DOUBLE, 0, listed, j->time);
        brc_h5_read_close(&h5);
    }
    for (int64_t k = listed; k < j->n_frames; ++k)
        j->time[k] = k > 0 ? j->time[k - 1] + 1 : 0;
cleanup:
    brc_memory_free(path);
    return status;
}

static brc_status copy_file(job *j, const char *name)
{
    char *from = NULL, *to = NULL, *data = NULL;
    size_t bytes;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_join(j->context, j->folder, name, &from));
    BRC_TRY_OR(cleanup, brc_file_join(j->context, j->out, name, &to));
    BRC_TRY_OR(cleanup, brc_file_read_whole(j->context, from, (size_t)1 << 40, &data, &bytes));
    BRC_TRY_OR(cleanup, brc_file_write_whole(j->context, to, data, bytes));
    ++j->n_files;
cleanup:
    brc_memory_free(from);
    brc_memory_free(to);
    brc_memory_free(data);
    return status;
}

static brc_status make_frames_folder(const job *j)
{
    char *path = NULL;
    BRC_TRY(brc_file_join(j->context, j->out, "frames", &path));
    const brc_status status = brc_file_make_folder(j->context, path);
    brc_memory_free(path);
    return status;
}

static brc_status write_pvd(job *j)
{
    brc_text text = {.context = j->context};
    char *path = NULL;
    brc_status status = BRC_OK;
    brc_text_add(&text, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n");
    for (int64_t k = 0; k < j->n_frames; ++k) {
        brc_text_add(&text, "<DataSet timestep=\"");
        brc_text_add_number(&text, j->time[k]);
        brc_text_add(&text, "\" file=\"frames/%06lld.vtu\"/>\n", (long long)k);
    }
    brc_text_add(&text, "</Collection>\n</VTKFile>\n");
    BRC_TRY_OR(cleanup, brc_file_join(j->context, j->out, "frames.pvd", &path));
    BRC_TRY_OR(cleanup, brc_text_write(&text, path));
    ++j->n_files;
cleanup:
    brc_memory_free(path);
    brc_text_free(&text);
    return status;
}

/* One frame by a function of (frame, path). */
static brc_status convert(job *j, const char *prefix, const char *suffix,
                          brc_status (*one)(brc_context *, const char *, const char *))
{
    for (int64_t k = 0; k < j->n_frames; ++k) {
        char *from = NULL, *to = NULL;
        brc_status status = frame_path(j, j->folder, "frames/", k, ".vtkhdf", &from);
        if (status == BRC_OK) status = frame_path(j, j->out, prefix, k, suffix, &to);
        if (status == BRC_OK) status = one(j->context, from, to);
        brc_memory_free(from);
        brc_memory_free(to);
        BRC_TRY(status);
        ++j->n_files;
    }
    return BRC_OK;
}

static brc_status write_series(job *j, int64_t n, const char *suffix, const char *name)
{
    char *path = NULL;
    BRC_TRY(brc_file_join(j->context, j->out, name, &path));
    const brc_status status = brc_frame_write_series(j->context, n, j->time, suffix, path);
    brc_memory_free(path);
    j->n_files += status == BRC_OK;
    return status;
}

/* A file of the run as it is, where it is there. */
static brc_status copy_if_there(job *j, const char *name, bool *there)
{
    char *path = NULL;
    BRC_TRY(brc_file_join(j->context, j->folder, name, &path));
    *there = brc_file_exists(path);
    brc_memory_free(path);
    return *there ? copy_file(j, name) : BRC_OK;
}

/* Crack surfaces are VTU already. */
static brc_status copy_crack_surfaces(job *j)
{
    int64_t n = 0;
    for (bool there = true; there && n < j->n_frames; n += there) {
        char name[48];
        snprintf(name, sizeof name, "frames/%06lld.cracks.vtu", (long long)n);
        BRC_TRY(copy_if_there(j, name, &there));
    }
    return n > 0 ? write_series(j, n, ".cracks.vtu", "cracks.vtu.series") : BRC_OK;
}

static brc_status export_vtu(job *j)
{
    BRC_TRY(make_frames_folder(j));
    BRC_TRY(convert(j, "frames/", ".vtu", brc_export_vtu_frame));
    BRC_TRY(copy_crack_surfaces(j));
    return write_pvd(j);
}

static brc_status export_vtkhdf(job *j)
{
    BRC_TRY(make_frames_folder(j));
    for (int64_t k = 0; k < j->n_frames; ++k) {
        char name[48];
        snprintf(name, sizeof name, "frames/%06lld.vtkhdf", (long long)k);
        BRC_TRY(copy_file(j, name));
    }
    BRC_TRY(copy_crack_surfaces(j));
    return write_series(j, j->n_frames, ".vtkhdf", "frames.vtkhdf.series");
}

/* Columns of an element's row: dataset of the frame and the names of its columns. */
static const struct {
    const char *name;
    int columns;
    const char *suffix[6];
} COLUMN[] = {
    {"position", 3, {"_x [m]", "_y [m]", "_z [m]"}},
    {"displacement", 3, {"_x [m]", "_y [m]", "_z [m]"}},
    {"velocity", 3, {"_x [m/s]", "_y [m/s]", "_z [m/s]"}},
    {"stress", 6, {"_xx [Pa]", "_yy [Pa]", "_zz [Pa]", "_xy [Pa]", "_yz [Pa]", "_xz [Pa]"}},
    {"strain", 6, {"_xx [-]", "_yy [-]", "_zz [-]", "_xy [-]", "_yz [-]", "_xz [-]"}},
    {"von_mises", 1, {" [Pa]"}},
};
enum { N_COLUMNS = sizeof COLUMN / sizeof COLUMN[0] };

static brc_status csv_rows(brc_context *context, const brc_h5_read *h5, brc_text *text)
{
    double *data[N_COLUMNS] = {NULL};
    int64_t n = 0, columns;
    brc_status status = BRC_OK;
    brc_text_add(text, "element_id");
    for (int c = 0; c < N_COLUMNS; ++c) {
        char path[64];
        snprintf(path, sizeof path, "VTKHDF/CellData/%s", COLUMN[c].name);
        int64_t rows;
        BRC_TRY_OR(cleanup, brc_h5_read_size(h5, path, &rows, &columns));
        if (c == 0) n = rows;
        if (rows != n || columns != COLUMN[c].columns) {
            status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: %s is %lld x %lld, %lld x %d are expected", h5->path, path,
                              (long long)rows, (long long)columns, (long long)n, COLUMN[c].columns);
            goto cleanup;
        }
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &data[c], rows * columns, "fields of a frame"));
        BRC_TRY_OR(cleanup, brc_h5_read_rows(h5, path, H5T_NATIVE_DOUBLE, 0, rows, data[c]));
        for (int k = 0; k < COLUMN[c].columns; ++k)
            brc_text_add(text, ",%s%s", COLUMN[c].name, COLUMN[c].suffix[k]);
    }
    for (int64_t e = 0; e < n && text->status == BRC_OK; ++e) {
        brc_text_add(text, "\n%lld", (long long)e);
        for (int c = 0; c < N_COLUMNS; ++c)
            for (int k = 0; k < COLUMN[c].columns; ++k) {
                brc_text_add(text, ",");
                brc_text_add_number(text, data[c][e * COLUMN[c].columns + k]);
            }
    }
    brc_text_add(text, "\n");
cleanup:
    for (int c = 0; c < N_COLUMNS; ++c)
        brc_memory_free(data[c]);
    return status;
}

static brc_status csv_frame(brc_context *context, const char *frame, const char *path)
{
    brc_h5_read h5;
    brc_text text = {.context = context};
    BRC_TRY(brc_h5_read_open(context, frame, &h5));
    brc_status status = csv_rows(context, &h5, &text);
    if (status == BRC_OK) status = brc_text_write(&text, path);
    brc_h5_read_close(&h5);
    brc_text_free(&text);
    return status;
}

static brc_status export_csv(job *j)
{
    static const char *const TABLES[] = {"histories.csv", "cracks.csv", "fragments.csv"};
    bool there;
    for (size_t k = 0; k < sizeof TABLES / sizeof TABLES[0]; ++k)
        BRC_TRY(copy_if_there(j, TABLES[k], &there));
    return convert(j, "elements_", ".csv", csv_frame);
}

static brc_status look(job *j)
{
    char *index = NULL;
    BRC_TRY(brc_file_join(j->context, j->folder, "result.h5", &index));
    const bool indexed = brc_file_exists(index);
    brc_memory_free(index);
    BRC_TRY(count_frames(j));
    if (indexed || j->n_frames > 0) return read_times(j);
    return BRC_FAIL(j->context, BRC_BAD_INPUT,
                    "%s: holds neither result.h5 nor frames/000000.vtkhdf; name the folder that `breccia run` wrote",
                    j->folder);
}

brc_status brc_export(brc_context *context, const char *folder, const char *format, const char *out_folder,
                      int64_t *n_files)
{
    static const struct {
        const char *name;
        brc_status (*run)(job *);
    } known[] = {{"vtu", export_vtu}, {"vtkhdf", export_vtkhdf}, {"csv", export_csv}};
    brc_status (*run)(job *) = NULL;
    char *own = NULL;
    job j = {.context = context, .folder = folder, .out = out_folder};
    brc_status status = BRC_OK;
    for (size_t k = 0; k < sizeof known / sizeof known[0]; ++k)
        if (strcmp(known[k].name, format) == 0) run = known[k].run;
    if (!run)
        return BRC_FAIL(context, BRC_BAD_INPUT, "\"%s\" is no format of export; known are vtu, vtkhdf, csv", format);
    BRC_TRY_OR(cleanup, look(&j));
    if (!out_folder) {
        BRC_TRY_OR(cleanup, brc_file_join(context, folder, "export", &own));
        j.out = own;
    }
    BRC_TRY_OR(cleanup, brc_file_make_folder(context, j.out));
    BRC_TRY_OR(cleanup, run(&j));
cleanup:
    if (n_files) *n_files = j.n_files;
    brc_memory_free(own);
    brc_memory_free(j.time);
    return status;
}
