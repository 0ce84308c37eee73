/* What a run tells of its checkpoints, for summary.json; apart from their files, so that the public header needs no
 * HDF5. */
#ifndef BRC_OUTPUT_CHECKPOINT_REPORT_H
#define BRC_OUTPUT_CHECKPOINT_REPORT_H

#include <stdint.h>

/* What was done about checkpoints (checkpoint.h). */
typedef struct brc_checkpoint_report {
    int64_t n_written;
    double seconds;    /* wall seconds of writing all of them */
    int64_t bytes;     /* of the last one */
    const char *last;  /* path of the last good one; "": none is there */
    const char *from;  /* path of the one that the run goes on from; "": it began */
    int64_t from_step; /* total steps then */
} brc_checkpoint_report;

#endif
