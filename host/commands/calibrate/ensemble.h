/* Many small runs, one thread each: too small to share threads, many enough to fill them. And the file that keeps their
 * results line by line, so that a campaign that was stopped or killed goes on where it was. */
#ifndef BRC_COMMANDS_ENSEMBLE_H
#define BRC_COMMANDS_ENSEMBLE_H

#include "../../base/log.h"
#include "../../device/device.h"
#include <stdint.h>
#include <stdio.h>

/* One run of n; the context and the device (one CPU thread) are the thread's own. */
typedef brc_status (*brc_ensemble_task)(void *self, brc_context *context, brc_device *device, int64_t task);

/* All tasks on n_threads threads, in order of their numbers as threads become free. After the first failure no further
 * task begins; it is returned, with its sentence in `context`. Threads are silent but for errors. What tasks share they
 * guard themselves. */
brc_status brc_ensemble_each(brc_context *context, int n_threads, int64_t n_tasks, brc_ensemble_task run, void *self);

/* Results as lines of text below a header. */
typedef struct brc_ensemble_file {
    char *path; /* owned */
    FILE *file;
    brc_progress *progress; /* one unit a line; NULL: not shown. Owned */
    int64_t n_done;         /* lines kept since it was opened */
} brc_ensemble_file;

/* A whole line without its newline; false: it is no result. */
typedef bool (*brc_ensemble_line)(void *self, const char *line, brc_status *status);

/* Make `folder`, and open the file there to append to it. header: its first line, with newline. A file that is there is
 * refused unless `resume`; then each of its whole lines is given to `take`, and a torn last line is cut off.
 * BRC_BAD_INPUT: another header, a line that is no result. */
brc_status brc_ensemble_open(brc_context *context, const char *folder, const char *name, const char *header,
                             bool resume, brc_ensemble_line take, void *self, brc_ensemble_file *out);
/* Append a line (newline included) and bring it to the disk's care at once. Call it from one thread at a time. */
brc_status brc_ensemble_keep(brc_context *context, brc_ensemble_file *file, const char *line);
/* Accepts a file that was not opened. */
brc_status brc_ensemble_close(brc_context *context, brc_ensemble_file *file);

#endif
