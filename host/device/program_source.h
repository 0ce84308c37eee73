/* The one text an OpenCL program is compiled from. */
#ifndef BRC_PROGRAM_SOURCE_H
#define BRC_PROGRAM_SOURCE_H

#include "../base/status.h"

/* Paste kernels.h and all it includes into one text, each file once, with #line marks so that a compiler's log names
 * the right file, and with a hash of the content in front: driver caches have returned stale kernels for changed
 * includes. folder: NULL for the embedded texts, else files of these names there (BRC_BAD_INPUT when one is missing).
 * *out is freed with brc_memory_free. */
brc_status brc_program_source(brc_context *context, const char *folder, char **out);

#endif
