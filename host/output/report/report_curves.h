/* Sensors of a run for the curves of the report page. */
#ifndef BRC_OUTPUT_REPORT_CURVES_H
#define BRC_OUTPUT_REPORT_CURVES_H

#include "html.h"

enum { BRC_REPORT_SAMPLES = 250000 }; /* numbers of all sensors together that a page holds */

/* Adds array histories to the page, [columns][rows] floats, and object `histories` to json: `name` and `unit` of the
 * columns, `rows`, `every` (each shown sample stands for so many; the last one is always shown) and `x`, `y`, the axes
 * that the scene's output.curve names, null where it has none. Nothing where there is no histories.csv or no sample.
 * scene: text of the resolved scene, NULL: not known. BRC_BAD_INPUT: histories.csv is larger than a gigabyte.
 * BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_report_curves(brc_context *context, const char *folder, const char *scene, brc_text *page,
                             brc_json *json);

#endif
