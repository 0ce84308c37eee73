/* Files that survive a crash: written aside, fsynced, renamed. Of several ranks (ranks.h) the first one writes: on the
 * others what makes, writes, renames or removes here returns BRC_OK and does nothing. */
#ifndef BRC_BASE_FILE_H
#define BRC_BASE_FILE_H

#include "status.h"
#include <stdint.h>

/* Is this the rank that writes? Asked by what writes files in other ways. */
bool brc_file_writes(void);
/* Create a folder and its parents (existing ones are fine). BRC_FILE_FAILED with path and reason. */
brc_status brc_file_make_folder(brc_context *context, const char *path);
/* Write `bytes` bytes to `path` so that the file is either the old one or the whole new one. */
brc_status brc_file_write_whole(brc_context *context, const char *path, const void *data, size_t bytes);
/* Read a whole file; *out is NUL-terminated beyond *bytes and freed by brc_memory_free. Refuses (BRC_BAD_INPUT) files
 * above `limit` bytes, folders and unreadable paths, with a sentence. */
brc_status brc_file_read_whole(brc_context *context, const char *path, size_t limit, char **out, size_t *bytes);
/* Begin and end of writing aside with a foreign library: `aside` receives "<path>.part" (caller frees with
 * brc_memory_free); commit fsyncs it and renames it to `path`; discard removes it. */
brc_status brc_file_aside(brc_context *context, const char *path, char **aside);
brc_status brc_file_commit(brc_context *context, const char *aside, const char *path);
void brc_file_discard(const char *aside);
/* Can a file be written at `path`? Asked before long work: BRC_FILE_FAILED where its folder is missing or may not be
 * written to, or a folder is in its place. */
brc_status brc_file_check_place(brc_context *context, const char *path);
/* folder + "/" + name, freed by brc_memory_free. */
brc_status brc_file_join(brc_context *context, const char *folder, const char *name, char **out);
/* Does the path exist? */
bool brc_file_exists(const char *path);

#endif
