/* The view in three dimensions of the report page: surface, cracks and rigid bodies at some of the frames of a run,
 * small enough to lie inside the page. */
#ifndef BRC_OUTPUT_REPORT_VIEW_H
#define BRC_OUTPUT_REPORT_VIEW_H

#include "../csv_read.h"
#include "html.h"

/* Frames of the folder that the page shows: evenly among all, the first and the last with them. */
typedef struct brc_report_frames {
    int64_t n_all, n;
    int64_t *number; /* [n] ascending; owned */
} brc_report_frames;

/* Adds the arrays of the view to the page and object `view` to json. Arrays (elements of the page, packed by zlib):
 *   view-surface  places of points and outlines of faces
 *   view-K        displacements and fields at shown frame K
 *   view-discs    broken beams, view-rigid and view-rigid-K rigid bodies, where there are any
 * Each number is quantised: places and displacements to 16 bits, fields to 8. cracks: cracks.csv, without columns where
 * nothing can break. frames: of those shown; n 0: the run has no frames, and nothing is added. Owned by the caller.
 * BRC_BAD_INPUT: a damaged frame. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_report_view(brc_context *context, const char *folder, const brc_csv_read *cracks, brc_text *page,
                           brc_json *json, brc_report_frames *frames);
void brc_report_frames_free(brc_report_frames *frames);

#endif
