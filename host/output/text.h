/* Text that grows, and JSON on top of it. Failures are kept in the text and reported once, at the end. */
#ifndef BRC_OUTPUT_TEXT_H
#define BRC_OUTPUT_TEXT_H

#include "../base/status.h"
#include <stdint.h>

typedef struct brc_text {
    brc_context *context; /* borrowed */
    char *data;           /* NUL-terminated; NULL while empty */
    size_t length, capacity;
    brc_status status; /* BRC_OK, or BRC_NO_MEMORY: later additions do nothing */
} brc_text;

/* A text starts as {.context = context}. */
void brc_text_add(brc_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Bytes as they are. */
void brc_text_add_bytes(brc_text *text, const char *bytes, size_t n);
/* The shortest decimal number that reads back as `value` ("nan", "inf" where it is not finite). */
void brc_text_add_number(brc_text *text, double value);
/* Status so far; if BRC_OK, the text is written whole to `path`. */
brc_status brc_text_write(brc_text *text, const char *path);
/* The same to `name` in `folder`, and freed whatever comes of it. */
brc_status brc_text_write_into(brc_text *text, const char *folder, const char *name);
void brc_text_free(brc_text *text);

/* JSON: members are added to the innermost open object or array; key is NULL in arrays and at the top. Strings are
 * escaped, bytes that are not UTF-8 become U+FFFD, numbers that are not finite become null. */
typedef struct brc_json {
    brc_text text;
    char closing[16]; /* '}' or ']' of what is open, outermost first */
    int depth;
    bool empty; /* nothing yet in the innermost one */
} brc_json;

void brc_json_begin_object(brc_json *json, const char *key);
void brc_json_begin_array(brc_json *json, const char *key);
void brc_json_end(brc_json *json);
/* value NULL: null. */
void brc_json_string(brc_json *json, const char *key, const char *value);
void brc_json_number(brc_json *json, const char *key, double value);
void brc_json_integer(brc_json *json, const char *key, int64_t value);
void brc_json_boolean(brc_json *json, const char *key, bool value);
void brc_json_null(brc_json *json, const char *key);
/* Ends what is open, adds a newline, writes whole and frees. */
brc_status brc_json_write(brc_json *json, const char *path);

#endif
