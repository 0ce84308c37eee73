/* One frame in another format. */
#ifndef BRC_OUTPUT_EXPORT_VTU_H
#define BRC_OUTPUT_EXPORT_VTU_H

#include "../../base/status.h"

/* Frame (VTKHDF) to VTU (vtu.h), read and written in blocks, but for the faces of polyhedra, which are held in memory.
 * BRC_BAD_INPUT: damaged frame; BRC_FILE_FAILED: cannot write. */
brc_status brc_export_vtu_frame(brc_context *context, const char *frame, const char *path);

#endif
