/* What the recorder holds: recorder.c, and recorder_frames.c for its frames. */
#ifndef BRC_OUTPUT_RECORDER_INTERNAL_H
#define BRC_OUTPUT_RECORDER_INTERNAL_H

#include "recorder.h"
#include "sensors/assembly_sensors.h"
#include "cracks/crack_records.h"
#include "frames/frame_file.h"
#include "sensors/history_csv.h"

/* Files and folders of a run, in the order in which an older run's are removed. */
enum {
    BRC_RECORD_SUMMARY,
    BRC_RECORD_RESULT,
    BRC_RECORD_HISTORIES,
    BRC_RECORD_CRACKS,
    BRC_RECORD_FRAGMENTS,
    BRC_RECORD_PICTURE,
    BRC_RECORD_CURVE,
    BRC_RECORD_SERIES,
    BRC_RECORD_CRACK_SERIES,
    BRC_RECORD_STRIKER_SERIES,
    BRC_RECORD_FRAMES,
    BRC_RECORD_PICTURES,
    BRC_N_RECORDS
};

struct brc_recorder {
    brc_context *context;
    char *path[BRC_N_RECORDS]; /* owned */
    char *folder;              /* owned */
    bool spills;               /* what is held for files lies in a file there: faces and corners of all cells */
    const brc_scene *scene;
    const brc_prediction *prediction;
    int32_t n_domains;
    const brc_domain *const *domains; /* [n_domains] */
    brc_assembly *assembly;
    brc_assembly_sensors *sensors;
    brc_history *history;
    brc_history_csv *csv;
    double *value; /* [n_sensors] of the sample being taken */
    int64_t n_frames;
    double *frame_time; /* [n_frames] for the index: strictly rising */
    brc_measured *measures;
    int32_t n_measures;
    brc_crack_records *cracks; /* NULL: nothing can break */
    brc_frames *frames;        /* NULL: no frames are wanted */
    int n_threads;
    brc_checkpoint_report checkpoints;
    double start, build_s, output_s; /* start: brc_clock_s() then; the others: wall seconds */
};

/* From `begin` on until it is false long blocks lie in a file, where the recorder holds what it writes there. */
void brc_recorder_spill(const brc_recorder *recorder, bool begin);

/* recorder_frames.c */

/* Frames and pictures from number `first` on are removed. */
brc_status brc_recorder_remove_frames(const brc_recorder *recorder, int64_t first);
/* Indices of the frames and of what lies beside them. */
brc_status brc_recorder_write_series(const brc_recorder *recorder);
/* A frame and, where they are wanted, cracks, strikers and a picture beside it, and their indices. */
brc_status brc_recorder_add_frame(brc_recorder *recorder, brc_simulation *simulation);

#endif
