/* Text read line by line: lines, fields and numbers, with faults that name their place. What readers of tables
 * share. */
#ifndef BRC_PREPROCESS_LINES_H
#define BRC_PREPROCESS_LINES_H

#include "../host/base/status.h"
#include <locale.h>
#include <stdint.h>

typedef struct brc_lines {
    brc_context *context;
    const char *path;            /* for sentences; borrowed */
    const char *next, *end;      /* the rest of the text; borrowed */
    const char *line, *line_end; /* the current line without its end and blanks before it */
    const char *line_start;      /* its first byte: columns count from here */
    int64_t number;              /* of the current line, from 1 */
    int64_t n_bad;               /* faults found so far */
    locale_t plain;              /* the C locale, whatever the program around us uses */
} brc_lines;

/* Begin with `bytes` bytes of `text`, which must be followed by a NUL and outlive the lines. End with brc_lines_end. */
brc_status brc_lines_begin(brc_context *context, const char *path, const char *text, size_t bytes, brc_lines *lines);
void brc_lines_end(brc_lines *lines);
/* Step to the next line (LF or CRLF); false at the end of the text. */
bool brc_lines_next(brc_lines *lines);
/* Lines that are still to come; the last one needs no end. */
int64_t brc_lines_left(const brc_lines *lines);
/* The next token between blanks at or after *at within [*at, end): *first .. *last; moves *at behind it. False: none
 * left. */
bool brc_lines_token(const char **at, const char *end, const char **first, const char **last);
/* Is the token this word, whatever its case? */
bool brc_lines_is(const char *first, const char *last, const char *word);
/* Read the whole token as a decimal number, finite, without trailing garbage. False: a fault is recorded; `what` names
 * the number. */
bool brc_lines_number(brc_lines *lines, const char *first, const char *last, const char *what, double *out);
/* The same for a whole number of at most 18 digits. */
bool brc_lines_integer(brc_lines *lines, const char *first, const char *last, const char *what, int64_t *out);
/* Record "path:line:column: ..." at `place` of the current line. Twenty are kept in words, further ones are counted. */
void brc_lines_bad(brc_lines *lines, const char *place, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* BRC_OK without faults; otherwise BRC_BAD_INPUT, with one more sentence when there were more than twenty. */
brc_status brc_lines_verdict(brc_lines *lines);

#endif
