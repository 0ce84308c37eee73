/* Directions of cracks and sizes of fragments for the charts of the report page. */
#ifndef BRC_OUTPUT_REPORT_CRACKS_H
#define BRC_OUTPUT_REPORT_CRACKS_H

#include "../csv_read.h"
#include "html.h"
#include "report_view.h"

enum { BRC_REPORT_ROSE = 18 }; /* sectors of a half circle, ten degrees each */

/* A crack rose: area of broken faces by the direction of their trace in the plane across axis c, seen along it: a face
 * counts with the part of its area that stands across the plane. Angles from the next axis (x for c = z) towards the
 * one after it, 0 to 180 degrees. [m^2] */
void brc_report_cracks_rose(const brc_csv_read *cracks, int c, double out[BRC_REPORT_ROSE]);

/* Adds array `roses` to json, one for each axis; nothing where nothing broke. */
void brc_report_cracks_add_roses(const brc_csv_read *cracks, brc_json *json);
/* Adds array fragment-masses to the page, floats [kg], the heaviest first, and object `fragments` to json: `frame`,
 * numbers of frames, -1 for the end of the run, and `start`, where the masses of each begin and, last, where all end.
 * Of the shown frames, or of all where none are shown. Nothing where nothing can break. BRC_NO_MEMORY. */
brc_status brc_report_cracks_add_fragments(brc_context *context, const brc_csv_read *fragments,
                                           const brc_report_frames *frames, brc_text *page, brc_json *json);

#endif
