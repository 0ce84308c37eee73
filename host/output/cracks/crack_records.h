/* The files of a fracture, as a run goes on: cracks.csv and fragments.csv grow at every frame, crack surfaces lie
 * beside it. */
#ifndef BRC_OUTPUT_CRACK_RECORDS_H
#define BRC_OUTPUT_CRACK_RECORDS_H

#include "crack_report.h"
#include "fragments_file.h"
#include "../../solver/core/state_store.h"

typedef struct brc_crack_records brc_crack_records;

/* What is known, as of the last frame or the end. */
typedef struct brc_crack_state {
    brc_cracks cracks;
    brc_fragment_table fragments;
    brc_crack_report report;
} brc_crack_state;

/* Of a scene with fracture. assembly is borrowed until free. Begins both files. */
brc_status brc_crack_records_create(brc_context *context, const brc_assembly *assembly, const char *cracks_path,
                                    const char *fragments_path, brc_crack_records **out);
/* Its part of a checkpoint, all that was written being on the disk; `part` of the store is the run (-1). */
brc_status brc_crack_records_save(brc_context *context, brc_crack_records *records, brc_state_store *store);
/* As create, going on with the files as they were then: the parts of the assembly have their states again. What broke
 * is read once more. */
brc_status brc_crack_records_resume(brc_context *context, const brc_assembly *assembly, const char *cracks_path,
                                    const char *fragments_path, brc_state_store *store, brc_crack_records **out);
/* Accepts NULL and a pointer to NULL. */
void brc_crack_records_free(brc_crack_records **records);
/* At frame number `frame`: read what broke, add to the files. surface: path of the crack surface, NULL: none is
 * wanted. */
brc_status brc_crack_records_frame(brc_context *context, brc_crack_records *records, int64_t frame,
                                   const char *surface);
/* At the end: what is missing, and all to the disk. alive: the simulation can still be asked, else what the last frame
 * had is kept. Fragments that moved on since the last frame get rows with frame -1. */
brc_status brc_crack_records_finish(brc_context *context, brc_crack_records *records, bool alive);
/* Borrowed; NULL before the first frame. */
const brc_crack_state *brc_crack_records_state(const brc_crack_records *records);

#endif
