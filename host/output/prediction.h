/* What a run was expected to cost, for summary.json beside what it did. */
#ifndef BRC_OUTPUT_PREDICTION_H
#define BRC_OUTPUT_PREDICTION_H

#include <stdbool.h>
#include <stdint.h>

/* What `breccia check` told of the whole run. */
typedef struct brc_prediction_told {
    bool known;                                  /* else the rest says nothing */
    bool processor_time;                         /* seconds are those of the processor, else of the clock */
    double seconds, least_seconds, most_seconds; /* [s] and its range */
    double step_seconds, steps;                  /* of seconds, those of dynamic steps without output, and how many */
    double host_bytes, device_bytes, resident_bytes, disk_bytes; /* [byte] */
} brc_prediction_told;

/* NAN and 0 where nothing was predicted. Seconds are those of dynamic stages, sampling and frames in between
 * included. */
typedef struct brc_prediction {
    int64_t after_steps;          /* steps that had been made when the (last) stage was predicted */
    double seconds, took_seconds; /* [s] */
    int64_t host_bytes;   /* most so far at the first pause of the (last) dynamic stage; where there is none, before the
                             first step */
    int64_t device_bytes; /* from counts alone */
    brc_prediction_told told;
} brc_prediction;

#endif
