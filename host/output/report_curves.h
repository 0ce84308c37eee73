/* Curves of a report: the columns of histories.csv over time, columns of one unit in one figure. */
#ifndef BRC_OUTPUT_REPORT_CURVES_H
#define BRC_OUTPUT_REPORT_CURVES_H

#include "text.h"

/* Adds the figures of folder/histories.csv to the page; nothing where there is no such file or no sample. *drawn: false where gnuplot could not draw.
 * BRC_FILE_FAILED, BRC_NO_MEMORY; BRC_BAD_INPUT where the file is larger than a gigabyte. */
brc_status brc_report_curves(brc_context *context, const char *folder, brc_text *page, int *n_figures, bool *drawn);

#endif
