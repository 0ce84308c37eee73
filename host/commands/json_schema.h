/* The scene format as a JSON Schema (draft 2020-12), from the same table as the reader and
 * docs/reference/scene/README.md, for editors that complete and check YAML. */
#ifndef BRC_COMMANDS_JSON_SCHEMA_H
#define BRC_COMMANDS_JSON_SCHEMA_H

#include "../base/status.h"
#include <stdio.h>

/* Accepts what the reader accepts but for what lies beyond one key and the next: names that must exist, ranges of
 * numbers with a unit, dimensions of units. BRC_NO_MEMORY, BRC_FILE_FAILED. */
brc_status brc_json_schema_write(brc_context *context, FILE *file);

#endif
