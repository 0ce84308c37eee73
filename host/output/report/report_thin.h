/* Fewer faces where a body has burst into so many pieces that the page would be too large. */
#ifndef BRC_OUTPUT_REPORT_THIN_H
#define BRC_OUTPUT_REPORT_THIN_H

#include "report_skin.h"

/* What points and faces take before they are packed, with two displacements of each point. */
int64_t brc_report_skin_bytes(const brc_report_skin *skin);
/* Drops faces of cells that cracks have opened until points and faces take `bytes` or fewer before they are packed, of
 * cells one after another, evenly over the body: what is left of a cell beside is what is open in the first frame,
 * which is never dropped, however much it is; nor are spheres. Cells with such a face keep their cracks before others
 * do. births: as of the first frame, 0 or -1, which is what they are afterwards. *n_dropped: faces. BRC_NO_MEMORY. */
brc_status brc_report_skin_thin(brc_context *context, brc_report_skin *skin, int64_t bytes, int64_t *n_dropped);

#endif
