/* Log lines and the progress line. On a terminal the progress line is redrawn in place at most five times a second; in
 * a file or a pipe it is one line now and then (after a second, then when 10 s have passed, or 5 % and a second). The
 * last one stays. A task of less than a second leaves none. */
#ifndef BRC_BASE_LOG_H
#define BRC_BASE_LOG_H

#include "status.h"
#include <stdint.h>

typedef enum brc_log_level { BRC_LOG_ERROR, BRC_LOG_WARNING, BRC_LOG_INFO, BRC_LOG_DEBUG } brc_log_level;

void brc_log_set_level(brc_context *context, brc_log_level level);
brc_log_level brc_log_get_level(const brc_context *context);
/* Lines go to `sink` instead of stderr, without prefix and newline, and there are no progress lines; NULL: stderr
 * again. self: borrowed. */
typedef void (*brc_log_sink)(void *self, brc_log_level level, const char *line);
void brc_log_set_sink(brc_context *context, brc_log_sink sink, void *self);
/* Level and sink of another context: for one that does a part of its work. */
void brc_log_follow(brc_context *context, const brc_context *other);
/* One line on stderr (a newline is added); a progress line in the way is cleared first and redrawn later. */
void brc_log(brc_context *context, brc_log_level level, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* A task. what: "stage pull" (copied); total: number of units, 0 when the end is not known (then no percent, no time
 * left); unit_name: "steps" (copied); rate_per_unit, rate_name: what to show as rate, e.g. bonds per step and "bond
 * updates/s" (0 and NULL: units/s). */
typedef struct brc_progress brc_progress;
brc_status brc_progress_create(brc_context *context, brc_progress **out, const char *what, int64_t total,
                               const char *unit_name, double rate_per_unit, const char *rate_name);
/* done: units finished so far. Cheap enough to call every step batch. Shows percent, rate, elapsed, time left. */
void brc_progress_update(brc_progress *progress, int64_t done);
/* Last line and newline if it took a second, free; accepts a pointer to NULL. */
void brc_progress_finish(brc_progress **progress);

/* Monotonic wall clock [s]. */
double brc_clock_s(void);
/* Processor time of all threads of the process [s]: what work takes on a machine that others use too. */
double brc_processor_s(void);

#endif
