/* A folder for what a command writes only to learn from it, below TMPDIR (else /tmp). */
#ifndef BRC_COMMANDS_SCRATCH_H
#define BRC_COMMANDS_SCRATCH_H

#include "../base/status.h"
#include <stdint.h>

#define BRC_SCRATCH 512

/* Make one; its path goes into folder. BRC_FILE_FAILED where none can be made. */
brc_status brc_scratch_create(brc_context *context, char folder[BRC_SCRATCH]);
/* Bytes of one of its files, or (name NULL) of all that is in it and in the folders in it; 0 of what is not there. */
int64_t brc_scratch_bytes(brc_context *context, const char *folder, const char *name);
/* Remove it with all that is in it. */
void brc_scratch_remove(brc_context *context, const char *folder);

#endif
