/* Results of an earlier run, which would mislead beside those of this one. */
#ifndef BRC_OUTPUT_EARLIER_RESULTS_H
#define BRC_OUTPUT_EARLIER_RESULTS_H

#include "../base/status.h"
#include <stdint.h>

/* A file, where it is there. BRC_FILE_FAILED. */
brc_status brc_earlier_remove_file(brc_context *context, const char *path);
/* Frames and what lies beside them, pictures, and what a killed run left of these, from number `first` on: all in a
 * folder, which need not be there. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_earlier_remove_numbered(brc_context *context, const char *folder, int64_t first);

#endif
