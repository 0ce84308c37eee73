/* Rigid bodies in the view of the report page, from the files striker_file.h writes. */
#ifndef BRC_OUTPUT_REPORT_RIGID_H
#define BRC_OUTPUT_REPORT_RIGID_H

#include "html.h"

/* Adds to the page view-rigid, [n_points][3] floats [m] and then [n_triangles][3] 32-bit corners, and for each of the n
 * frames view-rigid-K, [n_points][3] floats of displacement [m]; to json object `rigid` (n_points, n_triangles).
 * Nothing where the run has no rigid bodies. BRC_BAD_INPUT: a damaged or missing file. BRC_FILE_FAILED,
 * BRC_NO_MEMORY. */
brc_status brc_report_rigid(brc_context *context, const char *folder, int64_t n, const int64_t *number, brc_text *page,
                            brc_json *json);

#endif
