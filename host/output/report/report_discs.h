/* Broken bonds of spheres in the view of the report page: discs between the two spheres. */
#ifndef BRC_OUTPUT_REPORT_DISCS_H
#define BRC_OUTPUT_REPORT_DISCS_H

#include "../csv_read.h"
#include "html.h"
#include "report_skin.h"

/* Adds array view-discs to the page, [n] floats x y z nx ny nz radius [m], then [n] pairs of 32-bit places in
 * skin.element, then [n] 32-bit rows of cracks.csv, and object `discs` (n, every: each one stands for so many) to json;
 * nothing where no bond of spheres broke. BRC_NO_MEMORY. */
brc_status brc_report_discs(brc_context *context, const brc_csv_read *cracks, const brc_report_frame *last,
                            const brc_report_skin *skin, brc_text *page, brc_json *json);

#endif
