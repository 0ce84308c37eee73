/* Status codes and the context that keeps the sentences of failures. */
#include "status.h"
#include "context_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* "All errors in one pass" over a hostile file must not eat the memory: sentences beyond this many bytes are
 * dropped. */
#define MESSAGE_LIMIT ((size_t)1 << 20)

const char *brc_status_text(brc_status status)
{
    switch (status) {
#define BRC_STATUS_CASE(name, exit_code, text)                                                                         \
    case name: return text;
        BRC_STATUS_LIST(BRC_STATUS_CASE)
#undef BRC_STATUS_CASE
    }
    return "unknown status code";
}

int brc_status_exit_code(brc_status status)
{
    switch (status) {
#define BRC_STATUS_CASE(name, exit_code, text)                                                                         \
    case name: return exit_code;
        BRC_STATUS_LIST(BRC_STATUS_CASE)
#undef BRC_STATUS_CASE
    }
    return 3;
}

brc_context *brc_context_create(void)
{
    brc_context *context = calloc(1, sizeof *context);
    if (context) context->level = BRC_LOG_INFO;
    return context;
}

void brc_context_free(brc_context **context)
{
    if (!context || !*context) return;
    free((*context)->message);
    free(*context);
    *context = NULL;
}

const char *brc_context_message(const brc_context *context)
{
    return context && context->message ? context->message : "";
}

void brc_context_clear(brc_context *context)
{
    if (!context || !context->message) return;
    context->message_length = 0;
    context->message[0] = '\0';
}

void brc_context_set_place(brc_context *context, const char *place)
{
    if (context) context->place = place;
}

/* Room for `more` bytes and the NUL; false when memory is exhausted or the limit is reached. */
static bool reserve(brc_context *context, size_t more)
{
    const size_t needed = context->message_length + more + 1;
    if (needed > MESSAGE_LIMIT) return false;
    if (needed <= context->message_capacity) return true;
    size_t capacity = context->message_capacity ? context->message_capacity : 256;
    while (capacity < needed)
        capacity *= 2;
    char *grown = realloc(context->message, capacity);
    if (!grown) return false;
    context->message = grown;
    context->message_capacity = capacity;
    return true;
}

brc_status brc_context_fail(brc_context *context, brc_status code, const char *where, const char *format, ...)
{
    if (!context) return code;
    va_list arguments;
    va_start(arguments, format);
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    const size_t separator = context->message_length > 0 ? 1 : 0;
    const char *place = code == BRC_BAD_INPUT && context->place ? context->place : "";
    const size_t before = separator + strlen(place);
    /* The code is what callers act on: it is returned even where the sentence finds no room. */
    if (length >= 0 && reserve(context, before + (size_t)length)) {
        char *end = context->message + context->message_length;
        if (separator) *end++ = '\n';
        strcpy(end, place);
        end += strlen(place);
        vsnprintf(end, (size_t)length + 1, format, again);
        context->message_length += before + (size_t)length;
        brc_log(context, BRC_LOG_DEBUG, "%s: %s: %s", where, brc_status_text(code), end);
    }
    va_end(again);
    return code;
}
