/* The inside of a context: shared by status.c (failures) and log.c (lines and the progress line), nobody else. */
#ifndef BRC_BASE_CONTEXT_INTERNAL_H
#define BRC_BASE_CONTEXT_INTERNAL_H

#include "log.h"
#include "status.h"

struct brc_context {
    brc_log_level level;
    brc_log_sink sink;       /* NULL: stderr */
    void *sink_self;         /* borrowed */
    char *message;           /* sentences of the failures, '\n' between them; NULL: none */
    size_t message_length;   /* without the NUL [byte] */
    size_t message_capacity; /* [byte] */
    const char *place;       /* of wrong input; NULL: none. Borrowed */
    brc_progress *progress;  /* the one whose line may stand on the terminal; NULL: none. Borrowed */
};

#endif
