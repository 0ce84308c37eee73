/* Text that grows, and JSON on top of it. */
#include "text.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Room for `more` bytes and the NUL. */
static bool reserve(brc_text *text, size_t more)
{
    if (text->status != BRC_OK) return false;
    const size_t needed = text->length + more + 1;
    if (needed <= text->capacity) return true;
    size_t capacity = text->capacity ? text->capacity : 1024;
    while (capacity < needed)
        capacity *= 2;
    text->status = brc_memory_resize(text->context, (void **)&text->data, (int64_t)capacity, 1, "text of a result");
    if (text->status != BRC_OK) return false;
    text->capacity = capacity;
    return true;
}

void brc_text_add_bytes(brc_text *text, const char *bytes, size_t n)
{
    if (!reserve(text, n)) return;
    memcpy(text->data + text->length, bytes, n);
    text->length += n;
    text->data[text->length] = '\0';
}

void brc_text_add(brc_text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (n >= 0 && reserve(text, (size_t)n)) {
        vsnprintf(text->data + text->length, (size_t)n + 1, format, again);
        text->length += (size_t)n;
    }
    va_end(again);
}

void brc_text_add_number(brc_text *text, double value)
{
    char digits[40];
    int precision = 15;
    do
        snprintf(digits, sizeof digits, "%.*g", precision, value);
    while (++precision <= 17 && strtod(digits, NULL) != value && isfinite(value));
    brc_text_add_bytes(text, digits, strlen(digits));
}

brc_status brc_text_write(brc_text *text, const char *path)
{
    BRC_TRY(text->status);
    return brc_file_write_whole(text->context, path, text->data ? text->data : "", text->length);
}

brc_status brc_text_write_into(brc_text *text, const char *folder, const char *name)
{
    char *path = NULL;
    brc_status status = brc_file_join(text->context, folder, name, &path);
    if (status == BRC_OK) status = brc_text_write(text, path);
    brc_text_free(text);
    brc_memory_free(path);
    return status;
}

void brc_text_free(brc_text *text)
{
    brc_memory_free(text->data);
    *text = (brc_text){.context = text->context};
}

/* Length of the well-formed UTF-8 sequence at s (1..4), 0 where there is none. */
static size_t utf8_length(const unsigned char *s)
{
    if (s[0] < 0x80) return 1;
    const size_t n = s[0] >= 0xF0 && s[0] <= 0xF4  ? 4
                     : s[0] >= 0xE0 && s[0] < 0xF0 ? 3
                     : s[0] >= 0xC2 && s[0] < 0xE0 ? 2
                                                   : 0;
    for (size_t k = 1; k < n; ++k)
        if ((s[k] & 0xC0) != 0x80) return 0; /* also stops at the NUL */
    if (n == 3 && ((s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xED && s[1] > 0x9F))) return 0; /* overlong, surrogate */
    if (n == 4 && ((s[0] == 0xF0 && s[1] < 0x90) || (s[0] == 0xF4 && s[1] > 0x8F))) return 0;
    return n;
}

static void add_json_string(brc_text *text, const char *value)
{
    brc_text_add_bytes(text, "\"", 1);
    for (const unsigned char *s = (const unsigned char *)value; *s;) {
        const size_t n = utf8_length(s);
        if (n == 0)
            brc_text_add(text, "\\ufffd");
        else if (*s == '"' || *s == '\\')
            brc_text_add(text, "\\%c", *s);
        else if (*s == '\n')
            brc_text_add(text, "\\n");
        else if (*s == '\t')
            brc_text_add(text, "\\t");
        else if (*s < 0x20 || *s == 0x7F)
            brc_text_add(text, "\\u%04x", *s);
        else
            brc_text_add_bytes(text, (const char *)s, n);
        s += n ? n : 1;
    }
    brc_text_add_bytes(text, "\"", 1);
}

/* Comma, new line, indentation and key of the next member. */
static void next_member(brc_json *json, const char *key)
{
    if (json->depth > 0) brc_text_add(&json->text, "%s\n%*s", json->empty ? "" : ",", 2 * json->depth, "");
    json->empty = false;
    if (key) {
        add_json_string(&json->text, key);
        brc_text_add(&json->text, ": ");
    }
}

static void begin(brc_json *json, const char *key, char opening, char closing)
{
    next_member(json, key);
    brc_text_add_bytes(&json->text, &opening, 1);
    json->closing[json->depth++] = closing;
    json->empty = true;
}

void brc_json_begin_object(brc_json *json, const char *key)
{
    begin(json, key, '{', '}');
}

void brc_json_begin_array(brc_json *json, const char *key)
{
    begin(json, key, '[', ']');
}

void brc_json_end(brc_json *json)
{
    const char closing = json->closing[--json->depth];
    if (!json->empty) brc_text_add(&json->text, "\n%*s", 2 * json->depth, "");
    brc_text_add_bytes(&json->text, &closing, 1);
    json->empty = false;
}

void brc_json_string(brc_json *json, const char *key, const char *value)
{
    next_member(json, key);
    if (value)
        add_json_string(&json->text, value);
    else
        brc_text_add(&json->text, "null");
}

void brc_json_number(brc_json *json, const char *key, double value)
{
    next_member(json, key);
    if (isfinite(value))
        brc_text_add_number(&json->text, value);
    else
        brc_text_add(&json->text, "null");
}

void brc_json_integer(brc_json *json, const char *key, int64_t value)
{
    next_member(json, key);
    brc_text_add(&json->text, "%lld", (long long)value);
}

void brc_json_boolean(brc_json *json, const char *key, bool value)
{
    next_member(json, key);
    brc_text_add(&json->text, value ? "true" : "false");
}

void brc_json_null(brc_json *json, const char *key)
{
    brc_json_string(json, key, NULL);
}

brc_status brc_json_write(brc_json *json, const char *path)
{
    while (json->depth > 0)
        brc_json_end(json);
    brc_text_add(&json->text, "\n");
    const brc_status status = brc_text_write(&json->text, path);
    brc_text_free(&json->text);
    return status;
}
