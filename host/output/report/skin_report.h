/* The skin of a packed body, as a table and as lines for a person. */
#ifndef BRC_OUTPUT_SKIN_REPORT_H
#define BRC_OUTPUT_SKIN_REPORT_H

#include "../../../preprocess/packing/skin.h"

/* Print the layers to stdout and write them to `path` as CSV: a row a layer, then the core (its `to_diameters` is
 * empty). BRC_FILE_FAILED. */
brc_status brc_skin_report(brc_context *context, const brc_skin *skin, const char *path);

#endif
