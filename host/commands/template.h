/* The commented scenes that `breccia new` writes: those of docs/guide/tutorials, as texts inside the program; made at
 * build time (template_files.cmake). */
#ifndef BRC_COMMANDS_TEMPLATE_H
#define BRC_COMMANDS_TEMPLATE_H

#include "../base/status.h"
#include <stddef.h>

typedef struct brc_template {
    const char *name; /* "brazilian", of brazilian.yaml */
    const char *text; /* begins with a comment of one line that says what it is */
    size_t bytes;
} brc_template;

extern const brc_template brc_templates[]; /* by name */
extern const int brc_template_count;

/* The template of this name; NULL with a sentence naming the nearest when there is none. */
const brc_template *brc_template_find(brc_context *context, const char *name);
/* A study, not a scene? */
bool brc_template_is_study(const brc_template *template);

#endif
