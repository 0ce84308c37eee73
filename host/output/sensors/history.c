/* The table of samples. */
#include "history.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

brc_status brc_history_create(brc_context *context, int32_t n_sensors, brc_history **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "history"));
    (*out)->n_sensors = n_sensors;
    return BRC_OK;
}

void brc_history_free(brc_history **history)
{
    if (!history || !*history) return;
    brc_memory_free((*history)->stage);
    brc_memory_free((*history)->step);
    brc_memory_free((*history)->stage_time);
    brc_memory_free((*history)->time);
    brc_memory_free((*history)->value);
    brc_memory_free(*history);
    *history = NULL;
}

/* Capacity only rises when every array has grown, so that a refused sample leaves a whole table. */
static brc_status grow(brc_context *context, brc_history *h)
{
    const int64_t n = h->capacity ? 2 * h->capacity : 512;
    BRC_TRY(brc_memory_resize(context, (void **)&h->stage, n, sizeof *h->stage, "history"));
    BRC_TRY(brc_memory_resize(context, (void **)&h->step, n, sizeof *h->step, "history"));
    BRC_TRY(brc_memory_resize(context, (void **)&h->stage_time, n, sizeof *h->stage_time, "history"));
    BRC_TRY(brc_memory_resize(context, (void **)&h->time, n, sizeof *h->time, "history"));
    BRC_TRY(brc_memory_resize(context, (void **)&h->value, n * h->n_sensors, sizeof *h->value, "history"));
    h->capacity = n;
    return BRC_OK;
}

brc_status brc_history_add(brc_context *context, brc_history *history, int32_t stage, int64_t step, double stage_time,
                           double time, const double *value)
{
    if (history->n_samples == history->capacity) BRC_TRY(grow(context, history));
    const int64_t k = history->n_samples++;
    history->stage[k] = stage;
    history->step[k] = step;
    history->stage_time[k] = stage_time;
    history->time[k] = time;
    if (history->n_sensors > 0)
        memcpy(history->value + k * history->n_sensors, value, (size_t)history->n_sensors * sizeof *value);
    return BRC_OK;
}

void brc_history_range(const brc_history *history, int32_t sensor, double *last, double *smallest, double *largest)
{
    *last = *smallest = *largest = NAN;
    for (int64_t k = 0; k < history->n_samples; ++k) {
        *last = history->value[k * history->n_sensors + sensor];
        *smallest = fmin(*smallest, *last); /* of a number and NAN these give the number */
        *largest = fmax(*largest, *last);
    }
}

brc_status brc_history_store(brc_context *context, brc_history *h, brc_state_store *store)
{
    int64_t n = h->n_samples;
    BRC_TRY(brc_store_array(context, store, "history.stage", BRC_STORED_INT32, 1, &n, (void **)&h->stage));
    BRC_TRY(brc_store_array(context, store, "history.step", BRC_STORED_INT64, 1, &n, (void **)&h->step));
    BRC_TRY(brc_store_array(context, store, "history.stage_time", BRC_STORED_DOUBLE, 1, &n, (void **)&h->stage_time));
    BRC_TRY(brc_store_array(context, store, "history.time", BRC_STORED_DOUBLE, 1, &n, (void **)&h->time));
    if (h->n_sensors > 0)
        BRC_TRY(
            brc_store_array(context, store, "history.value", BRC_STORED_SAMPLE, h->n_sensors, &n, (void **)&h->value));
    if (store->loading) h->n_samples = h->capacity = n;
    return BRC_OK;
}
