/* report.html: one page, with everything inside it, of what a folder of results holds. */
#ifndef BRC_OUTPUT_REPORT_H
#define BRC_OUTPUT_REPORT_H

#include "../../base/status.h"

/* folder: of `breccia run` (summary.json, and what else is there of histories.csv, cracks.csv, fragments.csv, frames,
 * result.h5, pictures) or of `reproduce` and `bench` (rows.json, pictures). path: of the page; NULL:
 * folder/report.html. Of a run the page tells how it ended, tables measures and figures of fracture, shows solid,
 * cracks and rigid bodies in three dimensions over time (report_view.h), draws any sensor against any, sizes of
 * fragments and a crack rose, and holds the resolved scene, cost, ledger and, folded away, everything else of
 * summary.json. A killed run is shown as far as it came. Pictures beyond 64 MB, or 0.5 MB beside a view, are left out,
 * with a sentence. BRC_BAD_INPUT: no results in the folder, or a damaged summary.json, rows.json or result.h5 (with its
 * place). BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_report_write(brc_context *context, const char *folder, const char *path);

#endif
