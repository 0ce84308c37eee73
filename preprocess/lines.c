/* A number is taken only where the whole token is one: "1,5", "0x10", "nan" and "3 m" are faults, not 1, 16, nan and
 * 3. */
#include "lines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_FAULTS = 20, LONGEST_QUOTE = 40, SENTENCE = 512 };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

brc_status brc_lines_begin(brc_context *context, const char *path, const char *text, size_t bytes, brc_lines *lines)
{
    *lines = (brc_lines){.context = context, .path = path, .next = text, .end = text + bytes};
    if (bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        lines->next += 3; /* spreadsheets write this mark of UTF-8 */
    lines->line = lines->line_end = lines->line_start = lines->next;
    lines->plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!lines->plain) return BRC_FAIL(context, BRC_NO_MEMORY, "%s: no memory to read numbers", path);
    return BRC_OK;
}

void brc_lines_end(brc_lines *lines)
{
    if (lines->plain) freelocale(lines->plain);
    lines->plain = (locale_t)0;
}

bool brc_lines_next(brc_lines *lines)
{
    if (lines->next >= lines->end) return false;
    const char *stop = memchr(lines->next, '\n', (size_t)(lines->end - lines->next));
    lines->line = lines->line_start = lines->next;
    lines->line_end = stop ? stop : lines->end;
    lines->next = stop ? stop + 1 : lines->end;
    lines->number++;
    if (lines->line_end > lines->line && lines->line_end[-1] == '\r') --lines->line_end;
    while (lines->line < lines->line_end && is_blank(*lines->line))
        ++lines->line;
    return true;
}

int64_t brc_lines_left(const brc_lines *lines)
{
    int64_t n = 0;
    for (const char *c = lines->next; c < lines->end; ++n) {
        const char *stop = memchr(c, '\n', (size_t)(lines->end - c));
        c = stop ? stop + 1 : lines->end;
    }
    return n;
}

bool brc_lines_token(const char **at, const char *end, const char **first, const char **last)
{
    while (*at < end && is_blank(**at))
        ++*at;
    if (*at >= end) return false;
    *first = *at;
    while (*at < end && !is_blank(**at))
        ++*at;
    *last = *at;
    return true;
}

bool brc_lines_is(const char *first, const char *last, const char *word)
{
    const size_t length = strlen(word);
    return (size_t)(last - first) == length && strncasecmp(first, word, length) == 0;
}

void brc_lines_bad(brc_lines *lines, const char *place, const char *format, ...)
{
    if (lines->n_bad++ >= MOST_FAULTS) return;
    char sentence[SENTENCE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    for (char *c = sentence; *c; ++c) /* what is quoted from a binary file must not reach a terminal */
        if ((unsigned char)*c < ' ' || (unsigned char)*c > '~') *c = '?';
    BRC_FAIL(lines->context, BRC_BAD_INPUT, "%s:%lld:%lld: %s", lines->path,
             (long long)(lines->number > 0 ? lines->number : 1), (long long)(place - lines->line_start) + 1, sentence);
}

static int shown(const char *first, const char *last)
{
    return last - first < LONGEST_QUOTE ? (int)(last - first) : LONGEST_QUOTE;
}

bool brc_lines_number(brc_lines *lines, const char *first, const char *last, const char *what, double *out)
{
    if (first == last) {
        brc_lines_bad(lines, first, "%s is empty, expected a number", what);
        return false;
    }
    bool plain = true;
    for (const char *c = first; c < last && plain; ++c)
        plain = is_digit(*c) || *c == '.' || *c == '-' || *c == '+' || *c == 'e' || *c == 'E';
    char *stop = NULL;
    const double value = plain ? strtod_l(first, &stop, lines->plain) : 0.0;
    if (!plain || stop != last) {
        brc_lines_bad(lines, first, "%s is '%.*s', expected a number%s", what, shown(first, last), first,
                      memchr(first, ',', (size_t)(last - first)) ? " with a decimal point" : "");
        return false;
    }
    if (!isfinite(value)) {
        brc_lines_bad(lines, first, "%s is '%.*s', expected a number that a double holds", what, shown(first, last),
                      first);
        return false;
    }
    *out = value;
    return true;
}

bool brc_lines_integer(brc_lines *lines, const char *first, const char *last, const char *what, int64_t *out)
{
    const char *c = first;
    const bool negative = c < last && *c == '-';
    if (c < last && (*c == '-' || *c == '+')) ++c;
    bool good = c < last && last - c <= 18;
    int64_t value = 0;
    for (; c < last && good; ++c) {
        good = is_digit(*c);
        value = 10 * value + (*c - '0');
    }
    if (!good) {
        brc_lines_bad(lines, first, "%s is '%.*s', expected a whole number", what, shown(first, last), first);
        return false;
    }
    *out = negative ? -value : value;
    return true;
}

brc_status brc_lines_verdict(brc_lines *lines)
{
    if (lines->n_bad == 0) return BRC_OK;
    if (lines->n_bad > MOST_FAULTS)
        BRC_FAIL(lines->context, BRC_BAD_INPUT, "%s: %lld more bad lines", lines->path,
                 (long long)(lines->n_bad - MOST_FAULTS));
    return BRC_BAD_INPUT;
}
