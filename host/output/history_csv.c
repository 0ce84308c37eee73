/* Rows go to the file by write(), from where the system brings them to the disk even if this program is killed. */
#include "history_csv.h"
#include "text.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

struct brc_history_csv {
    char *path; /* owned, for sentences */
    int file;
    int64_t bytes;     /* of whole rows in the file */
    int64_t n_samples; /* in the file */
    double begin, last, spent; /* brc_clock_s() at the start and after the last rows; seconds of writing */
};

/* A field of CSV: quoted where it holds what separates fields. */
static void add_field(brc_text *text, const char *name, const char *unit)
{
    const bool quote = strpbrk(name, ",\"\n\r") != NULL;
    if (quote) brc_text_add(text, "\"");
    for (const char *s = name; *s; ++s)
        brc_text_add(text, *s == '"' ? "\"\"" : "%c", *s);
    brc_text_add(text, " [%s]%s", unit, quote ? "\"" : "");
}

static void add_row(brc_text *text, const brc_history *history, int64_t k)
{
    brc_text_add(text, "%d,%lld,%.17g,%.17g", history->stage[k], (long long)history->step[k], history->stage_time[k],
                 history->time[k]);
    for (int32_t s = 0; s < history->n_sensors; ++s) {
        const double value = history->value[k * history->n_sensors + s];
        if (isnan(value))
            brc_text_add(text, ",");
        else
            brc_text_add(text, ",%.17g", value);
    }
    brc_text_add(text, "\n");
}

/* The text behind what is there; where it does not fit, the file stays as it was. */
static brc_status append(brc_context *context, brc_history_csv *csv, const brc_text *text)
{
    BRC_TRY(text->status);
    for (size_t done = 0; done < text->length;) {
        const ssize_t written = write(csv->file, text->data + done, text->length - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const int reason = errno;
            if (ftruncate(csv->file, csv->bytes) == 0) (void)lseek(csv->file, csv->bytes, SEEK_SET);
            return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write: %s%s", csv->path, strerror(reason),
                            reason == ENOSPC ? "; free some space or name another folder" : "");
        }
        done += (size_t)written;
    }
    csv->bytes += (int64_t)text->length;
    return BRC_OK;
}

brc_status brc_history_csv_create(brc_context *context, const brc_scene *scene, const char *path, brc_history_csv **out)
{
    brc_status status = BRC_OK;
    brc_history_csv *csv = NULL;
    brc_text head = {.context = context};
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &csv, 1, "history file"));
    csv->file = -1;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &csv->path, (int64_t)strlen(path) + 1, "path"));
    strcpy(csv->path, path);
    csv->begin = csv->last = brc_clock_s();
    csv->file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (csv->file < 0) {
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot create: %s", path, strerror(errno));
        goto cleanup;
    }
    brc_text_add(&head, "stage,step,stage_time,time_s");
    for (int32_t s = 0; s < scene->n_sensors; ++s) {
        brc_text_add(&head, ",");
        add_field(&head, scene->sensors[s].name, brc_sensor_unit(&scene->sensors[s]));
    }
    brc_text_add(&head, "\n");
    BRC_TRY_OR(cleanup, append(context, csv, &head));
    *out = csv;
    csv = NULL;
cleanup:
    brc_text_free(&head);
    brc_history_csv_free(&csv);
    return status;
}

static brc_status add_all(brc_context *context, brc_history_csv *csv, const brc_history *history)
{
    const double begin = brc_clock_s();
    brc_text rows = {.context = context};
    for (int64_t k = csv->n_samples; k < history->n_samples; ++k)
        add_row(&rows, history, k);
    const brc_status status = append(context, csv, &rows);
    brc_text_free(&rows);
    if (status == BRC_OK) csv->n_samples = history->n_samples;
    csv->last = brc_clock_s();
    csv->spent += csv->last - begin;
    return status;
}

brc_status brc_history_csv_add(brc_context *context, brc_history_csv *csv, const brc_history *history)
{
    const double now = brc_clock_s();
    if (100 * csv->spent > now - csv->begin && now - csv->last < 1) return BRC_OK;
    return add_all(context, csv, history);
}

brc_status brc_history_csv_finish(brc_context *context, brc_history_csv *csv, const brc_history *history)
{
    BRC_TRY(add_all(context, csv, history));
    if (fsync(csv->file) == 0 || errno == EINVAL || errno == EROFS) return BRC_OK; /* some file systems cannot */
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot reach the disk: %s", csv->path, strerror(errno));
}

void brc_history_csv_free(brc_history_csv **handle)
{
    brc_history_csv *const csv = handle ? *handle : NULL;
    if (!csv) return;
    if (csv->file >= 0) close(csv->file);
    brc_memory_free(csv->path);
    brc_memory_free(csv);
    *handle = NULL;
}
