#include "html.h"
#include "web_file.h"
#include "../pictures/label.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { COLUMNS_MOST = 40 };

void brc_html_file(brc_text *page, const char *name)
{
    const brc_web_file *file = brc_web_file_find(name);
    brc_text_add_bytes(page, (const char *)file->bytes, file->n);
}

void brc_html_words(brc_text *page, const char *words)
{
    for (const char *s = words; *s; ++s) {
        const char *mark = *s == '&' ? "&amp;" : *s == '<' ? "&lt;" : *s == '>' ? "&gt;" : *s == '"' ? "&quot;" : NULL;
        brc_text_add_bytes(page, mark ? mark : s, mark ? strlen(mark) : 1);
    }
}

void brc_html_begin(brc_text *page, const char *title)
{
    brc_text_add(page, "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
                       "content=\"width=device-width\">\n<title>");
    brc_html_words(page, title);
    brc_text_add(page, "</title>\n<style>\n");
    brc_html_file(page, "page.css");
    brc_text_add(page, "</style></head><body>\n");
}

void brc_html_end(brc_text *page)
{
    brc_text_add(page, "</body></html>\n");
}

/* The unit that the name of a value ends in, and the length of the name before it. */
static const char *unit_of(const char *key, size_t *length)
{
    static const char *const unit[][2] = {
        {"_J_per_m2", "J/m^2"}, {"_per_s", "1/s"}, {"_m2", "m^2"}, {"_kg", "kg"}, {"_J", "J"}, {"_m", "m"}, {"_s", "s"},
        {"_bytes", ""},         {"_deg", "deg"}};
    *length = strlen(key);
    for (size_t k = 0; k < sizeof unit / sizeof *unit; ++k) {
        const size_t n = strlen(unit[k][0]);
        if (*length <= n || strcmp(key + *length - n, unit[k][0]) != 0) continue;
        *length -= n;
        return unit[k][1];
    }
    return "";
}

static void add_name(brc_text *page, const char *key, size_t length)
{
    char words[128];
    snprintf(words, sizeof words, "%.*s", (int)(length < 100 ? length : 100), key);
    for (char *s = words; *s; ++s)
        if (*s == '_') *s = ' ';
    brc_html_words(page, words);
}

void brc_html_key(brc_text *page, const char *key)
{
    size_t length;
    unit_of(key, &length);
    add_name(page, key, length);
}

/* Above numbers that share their unit. */
static void add_heading(brc_text *page, const char *key)
{
    size_t length;
    const char *unit = unit_of(key, &length);
    add_name(page, key, length);
    if (unit[0]) brc_text_add(page, " [%s]", unit);
}

static bool is_of_bytes(const char *key)
{
    const size_t length = key ? strlen(key) : 0;
    return length >= 5 && strcmp(key + length - 5, "bytes") == 0;
}

static void add_number(brc_text *page, const char *key, const char *text, double value)
{
    size_t length;
    char shown[64];
    const char *unit = key ? unit_of(key, &length) : "";
    if (is_of_bytes(key))
        snprintf(shown, sizeof shown, "%.4g %s", value / (value < 1e9 ? 1e6 : 1e9), value < 1e9 ? "MB" : "GB");
    else
        brc_label_value(value, unit, 5, shown);
    brc_text_add(page, "<span title=\"%s%s%s\">%s</span>", text, unit[0] ? " " : "", unit, shown);
}

void brc_html_scalar(brc_text *page, const char *key, const char *text)
{
    char *end;
    size_t length;
    const double value = strtod(text, &end);
    const bool is_plain = !key || (!is_of_bytes(key) && !unit_of(key, &length)[0]);
    if (strcmp(text, "null") == 0 || !text[0])
        brc_text_add(page, "&ndash;");
    else if (*end || end == text)
        brc_html_words(page, text);
    else if (is_plain && value == rint(value) && fabs(value) < 1e15 && !strpbrk(text, ".eE"))
        brc_html_words(page, text);
    else
        add_number(page, key, text, value);
}

static bool all_are(const brc_node *node, brc_node_kind kind)
{
    for (const brc_node *child = node->first; child; child = child->next)
        if (child->kind != kind) return false;
    return node->first != NULL;
}

/* A row a child, a column a key that any of them has; what is neither fits no column of one line. */
static void add_table_of_maps(brc_text *page, const brc_node *node)
{
    const char *column[COLUMNS_MOST];
    int n = 0;
    for (const brc_node *row = node->first; row; row = row->next)
        for (const brc_node *cell = row->first; cell; cell = cell->next) {
            int k = 0;
            while (k < n && strcmp(column[k], cell->key) != 0)
                ++k;
            if (k == n && n < COLUMNS_MOST) column[n++] = cell->key;
        }
    brc_text_add(page, "<table><tr>%s", node->kind == BRC_NODE_MAP ? "<th></th>" : "");
    for (int k = 0; k < n; ++k) {
        brc_text_add(page, "<th>");
        add_heading(page, column[k]);
        brc_text_add(page, "</th>");
    }
    brc_text_add(page, "</tr>\n");
    for (const brc_node *row = node->first; row; row = row->next) {
        brc_text_add(page, "<tr>");
        if (node->kind == BRC_NODE_MAP) {
            brc_text_add(page, "<th>");
            brc_html_words(page, row->key);
            brc_text_add(page, "</th>");
        }
        for (int k = 0; k < n; ++k) {
            const brc_node *cell = brc_node_find(row, column[k]);
            brc_text_add(page, "<td>");
            if (cell) brc_html_value(page, is_of_bytes(column[k]) ? column[k] : NULL, cell);
            brc_text_add(page, "</td>");
        }
        brc_text_add(page, "</tr>\n");
    }
    brc_text_add(page, "</table>\n");
}

void brc_html_value(brc_text *page, const char *key, const brc_node *node)
{
    if (node->kind == BRC_NODE_SCALAR) {
        brc_html_scalar(page, key, node->text);
    } else if (all_are(node, BRC_NODE_MAP)) {
        add_table_of_maps(page, node);
    } else if (node->kind == BRC_NODE_LIST) {
        for (const brc_node *child = node->first; child; child = child->next) {
            brc_html_value(page, key, child);
            if (child->next) brc_text_add(page, "; ");
        }
    } else {
        brc_text_add(page, "<table>");
        for (const brc_node *child = node->first; child; child = child->next) {
            brc_text_add(page, "<tr><th>");
            brc_html_key(page, child->key);
            brc_text_add(page, "</th><td>");
            brc_html_value(page, child->key, child);
            brc_text_add(page, "</td></tr>\n");
        }
        brc_text_add(page, "</table>\n");
    }
}

/* RFC 4648, section 4. */
static void add_base64(brc_text *page, const unsigned char *bytes, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t k = 0; k < n; k += 3) {
        const unsigned word =
            (unsigned)bytes[k] << 16 | (k + 1 < n ? (unsigned)bytes[k + 1] << 8 : 0) | (k + 2 < n ? bytes[k + 2] : 0);
        const char four[4] = {digit[word >> 18], digit[word >> 12 & 63], k + 1 < n ? digit[word >> 6 & 63] : '=',
                              k + 2 < n ? digit[word & 63] : '='};
        brc_text_add_bytes(page, four, 4);
    }
}

void brc_html_packed(brc_text *page, const char *id, const void *bytes, size_t n)
{
    brc_text_add(page, "<script type=\"text/plain\" id=\"%s\">", id);
    add_base64(page, bytes, n);
    brc_text_add(page, "</script>\n");
}

brc_status brc_html_array(brc_text *page, const char *id, const void *bytes, int64_t n)
{
    void *packed = NULL;
    uLongf room = compressBound((uLong)n);
    BRC_TRY(brc_memory_allocate(page->context, &packed, (int64_t)room, 1, "numbers of a page"));
    if (compress2(packed, &room, bytes, (uLong)n, Z_BEST_COMPRESSION) == Z_OK)
        brc_html_packed(page, id, packed, room);
    else if (page->status == BRC_OK)
        page->status = BRC_FAIL(page->context, BRC_NO_MEMORY, "numbers of a page cannot be packed: out of memory");
    brc_memory_free(packed);
    return page->status;
}

void brc_html_json(brc_text *page, const char *id, brc_json *json)
{
    while (json->depth > 0)
        brc_json_end(json);
    if (page->status == BRC_OK) page->status = json->text.status;
    brc_text_add(page, "<script type=\"application/json\" id=\"%s\">", id);
    const char *s = json->text.data ? json->text.data : "null";
    for (const char *mark; (mark = strchr(s, '<')); s = mark + 1) {
        brc_text_add_bytes(page, s, (size_t)(mark - s));
        brc_text_add(page, "\\u003c");
    }
    brc_text_add(page, "%s</script>\n", s);
    brc_text_free(&json->text);
}

void brc_html_picture(brc_text *page, const char *words, const void *bytes, size_t n)
{
    brc_text_add(page, "<img alt=\"");
    brc_html_words(page, words);
    brc_text_add(page, "\" src=\"data:image/png;base64,");
    add_base64(page, bytes, n);
    brc_text_add(page, "\">");
}
