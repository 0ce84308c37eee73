/* `breccia export`: the frames and histories of a finished (or killed) run in other formats. */
#ifndef BRC_OUTPUT_EXPORT_H
#define BRC_OUTPUT_EXPORT_H

#include "../../base/status.h"
#include <stdint.h>

/* folder: of a run. out_folder: where to write (made); NULL: `folder`/export.
 *   "vtu"     frames/NNNNNN.vtu (polyhedra, appended raw data) and frames.pvd
 *   "vtkhdf"  the frames and their index again, copied
 *   "csv"     histories.csv and elements_NNNNNN.csv, a row for each element of a frame; cracks.csv and fragments.csv
 * Both of the first take crack surfaces along (frames/NNNNNN.cracks.vtu, cracks.vtu.series).
 * The vtkhdf copies hold a whole frame in memory, the others a block, or the faces or element fields of a frame.
 * BRC_BAD_INPUT: unknown format (the sentence lists the known ones), a folder without results, a damaged frame.
 * BRC_FILE_FAILED: cannot write. *n_files (may be NULL): files written. */
brc_status brc_export(brc_context *context, const char *folder, const char *format, const char *out_folder,
                      int64_t *n_files);

#endif
