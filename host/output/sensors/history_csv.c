/* Rows of samples, and how often they go to the file. */
#include "history_csv.h"
#include "../append.h"
#include "../text.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

struct brc_history_csv {
    brc_append *file;
    int64_t n_samples;         /* in the file */
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

brc_status brc_history_csv_create(brc_context *context, const brc_scene *scene, const char *path, brc_history_csv **out)
{
    brc_status status = BRC_OK;
    brc_history_csv *csv = NULL;
    brc_text head = {.context = context};
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &csv, 1, "history file"));
    csv->begin = csv->last = brc_clock_s();
    brc_text_add(&head, "stage,step,stage_time,time_s");
    for (int32_t s = 0; s < scene->n_sensors; ++s) {
        brc_text_add(&head, ",");
        add_field(&head, scene->sensors[s].name, brc_sensor_unit(&scene->sensors[s]));
    }
    brc_text_add(&head, "\n");
    BRC_TRY_OR(cleanup, head.status);
    BRC_TRY_OR(cleanup, brc_append_create(context, path, head.data, &csv->file));
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
    const brc_status status = brc_append_add(context, csv->file, &rows);
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
    return brc_append_finish(context, csv->file);
}

void brc_history_csv_free(brc_history_csv **handle)
{
    brc_history_csv *const csv = handle ? *handle : NULL;
    if (!csv) return;
    brc_append_free(&csv->file);
    brc_memory_free(csv);
    *handle = NULL;
}
