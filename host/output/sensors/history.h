/* What the sensors read, sample after sample: a table in memory that grows as needed. */
#ifndef BRC_OUTPUT_HISTORY_H
#define BRC_OUTPUT_HISTORY_H

#include "../../scene/scene.h"
#include "../../solver/core/state_store.h"

typedef struct brc_history {
    int32_t n_sensors;
    int64_t n_samples;
    int64_t capacity;   /* samples that the arrays below have room for */
    int32_t *stage;     /* [n_samples] index of the stage */
    int64_t *step;      /* [n_samples] step of the stage (static: increment) */
    double *stage_time; /* [n_samples] since the start of the stage [s]; static: load factor 0..1 [-] */
    double *time;       /* [n_samples] physical time of all stages so far [s] */
    double *value;      /* [n_samples][n_sensors] in the sensor's unit; NAN: the sensor does not apply there */
} brc_history;

/* Empty history of `n_sensors` columns. Caller frees. */
brc_status brc_history_create(brc_context *context, int32_t n_sensors, brc_history **out);
void brc_history_free(brc_history **history);
/* Add a sample; value: [n_sensors], copied. BRC_NO_MEMORY refuses it. */
brc_status brc_history_add(brc_context *context, brc_history *history, int32_t stage, int64_t step, double stage_time,
                           double time, const double *value);
/* The table, kept or filled (state_store.h). */
brc_status brc_history_store(brc_context *context, brc_history *history, brc_state_store *store);
/* Last sample, smallest and largest of a column; NAN where there is none (NAN samples do not count for the latter). */
void brc_history_range(const brc_history *history, int32_t sensor, double *last, double *smallest, double *largest);

#endif
