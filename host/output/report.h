/* report.html: one page, with everything inside it, of what a folder of results holds. */
#ifndef BRC_OUTPUT_REPORT_H
#define BRC_OUTPUT_REPORT_H

#include "../base/status.h"

/* folder: of `breccia run` (summary.json, histories.csv, pictures) or of `reproduce` and `bench` (rows.json, pictures). path: of the page; NULL: folder/report.html.
 * The page names version, commit, device and how the run ended, shows every picture of the folder and of folder/pictures (a sequence with a slider), draws every sensor
 * over time through gnuplot (sensors of one unit share a figure; a sentence where gnuplot is missing), and tables measures, ledger, timing, memory, effects and
 * whatever else summary.json has. Pictures beyond 64 MB are left out, with a sentence. A killed run is shown as far as it came.
 * BRC_BAD_INPUT: no results in the folder, or a damaged summary.json or rows.json (with its place). BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_report_write(brc_context *context, const char *folder, const char *path);

#endif
