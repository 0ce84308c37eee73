/* A text file that only grows: rows go to it by write(), from where the system brings them to the disk even if this
 * program is killed. Ranks that do not write (file.h) count the bytes alone. */
#ifndef BRC_OUTPUT_APPEND_H
#define BRC_OUTPUT_APPEND_H

#include "text.h"

typedef struct brc_append brc_append;

/* A new file that begins with `head`. Caller frees. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_append_create(brc_context *context, const char *path, const char *head, brc_append **out);
/* The first `bytes` bytes of a file that is there; what is behind them goes. BRC_BAD_INPUT where it is missing or
 * shorter. */
brc_status brc_append_reopen(brc_context *context, const char *path, int64_t bytes, brc_append **out);
/* Bytes that it has. */
int64_t brc_append_bytes(const brc_append *file);
/* The text behind what is there; where it does not fit, the file stays as it was and the same may be tried again. The
 * text's own failure, or BRC_FILE_FAILED. */
brc_status brc_append_add(brc_context *context, brc_append *file, const brc_text *text);
/* The same once the text has grown beyond 64 kB, and empties it: for tables of any length. End with brc_append_add. */
brc_status brc_append_piece(brc_context *context, brc_append *file, brc_text *text);
/* Back to its first `bytes` bytes, after pieces of what did not come to its end. */
void brc_append_cut(brc_append *file, int64_t bytes);
/* See it to the disk. */
brc_status brc_append_finish(brc_context *context, brc_append *file);
/* Accepts NULL and a pointer to NULL. */
void brc_append_free(brc_append **file);

#endif
