/* The one text an OpenCL program is compiled from. */
#ifndef BRC_PROGRAM_SOURCE_H
#define BRC_PROGRAM_SOURCE_H

#include "../base/status.h"

/* Kernels that a program is to have. */
typedef struct brc_program_part {
    int n;
    const char *const *kernels;
} brc_program_part;

/* Paste kernels.h and all it includes into one text, each file once, with #line marks so that a compiler's log names
 * the right file, and with a hash of the content in front: driver caches have returned stale kernels for changed
 * includes. folder: NULL for the embedded texts, else files of these names there (BRC_BAD_INPUT when one is missing).
 * part: kernels, all others are left out; NULL: all. *out is freed with brc_memory_free. */
brc_status brc_program_source(brc_context *context, const char *folder, const brc_program_part *part, char **out);

#endif
