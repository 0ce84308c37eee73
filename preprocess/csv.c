#include "csv.h"
#include <string.h>

/* The next field of a line at or after *at, which is NULL once the last one was given. Blanks and a pair of quotes
 * around a field are no part of it; a separator within quotes separates nothing. */
static bool next_field(char separator, const char **at, const char *end, const char **first, const char **last)
{
    if (!*at) return false;
    if (separator == ' ') return brc_lines_token(at, end, first, last);
    const char *c = *at;
    while (c < end && *c == ' ')
        ++c;
    const bool quoted = c < end && *c == '"';
    *first = c;
    if (quoted)
        for (++c; c < end && *c != '"';)
            ++c;
    while (c < end && *c != separator)
        ++c;
    *at = c < end ? c + 1 : NULL;
    while (c > *first && c[-1] == ' ')
        --c;
    *last = c;
    if (quoted && c - *first >= 2 && c[-1] == '"') {
        ++*first;
        --*last;
    }
    return true;
}

bool brc_csv_next(brc_lines *lines)
{
    while (brc_lines_next(lines))
        if (lines->line < lines->line_end && *lines->line != '#') return true;
    return false;
}

static char separator_of(const brc_lines *lines)
{
    const size_t length = (size_t)(lines->line_end - lines->line);
    static const char known[] = ",;\t";
    for (const char *c = known; *c; ++c)
        if (memchr(lines->line, *c, length)) return *c;
    return ' ';
}

static bool has_any_required(const brc_csv *csv)
{
    for (int k = 0; k < csv->n_required; ++k)
        if (csv->column[k] >= 0) return true;
    return false;
}

bool brc_csv_header(brc_lines *lines, brc_csv *csv)
{
    for (int k = 0; k < csv->n_roles; ++k)
        csv->column[k] = -1;
    csv->n_columns = 0;
    if (!brc_csv_next(lines)) {
        brc_lines_bad(lines, lines->line_start, "no row found, expected %s", csv->wanted);
        return false;
    }
    csv->separator = separator_of(lines);
    const int64_t bad_before = lines->n_bad;
    const char *first, *last, *at = lines->line;
    while (next_field(csv->separator, &at, lines->line_end, &first, &last)) {
        for (int k = 0; k < csv->n_roles; ++k) {
            if (!brc_lines_is(first, last, csv->role[k])) continue;
            if (csv->column[k] >= 0) brc_lines_bad(lines, first, "a second column '%s', expected one", csv->role[k]);
            csv->column[k] = csv->n_columns;
        }
        csv->n_columns++;
    }
    if (lines->n_bad > bad_before) return false;
    if (!has_any_required(csv)) {
        brc_lines_bad(lines, lines->line, "'%.*s' names no %s, expected %s (a row behind '#' is a comment)",
                      (int)(lines->line_end - lines->line < 60 ? lines->line_end - lines->line : 60), lines->line,
                      csv->what, csv->wanted);
        return false;
    }
    for (int k = 0; k < csv->n_required; ++k)
        if (csv->column[k] < 0)
            brc_lines_bad(lines, lines->line, "no column '%s', expected %s", csv->role[k], csv->wanted);
    return lines->n_bad == bad_before;
}

bool brc_csv_row(brc_lines *lines, const brc_csv *csv, double *value, const char **place)
{
    const char *first, *last, *at = csv->separator == '\t' ? lines->line_start : lines->line;
    int64_t column = 0;
    for (; next_field(csv->separator, &at, lines->line_end, &first, &last); ++column) {
        if (column >= csv->n_columns && first == last && !at) break; /* a separator at the end of the row */
        if (column >= csv->n_columns) {
            brc_lines_bad(lines, first, "more fields than the %lld names of the header%s", (long long)csv->n_columns,
                          csv->separator == ',' ? "; numbers need a decimal point, not a comma" : "");
            return false;
        }
        for (int k = 0; k < csv->n_roles; ++k) {
            if (column != csv->column[k]) continue;
            if (!brc_lines_number(lines, first, last, csv->role[k], &value[k])) return false;
            if (place) place[k] = first;
        }
    }
    if (column >= csv->n_columns) return true;
    brc_lines_bad(lines, lines->line_end, "%lld fields, expected the %lld of the header", (long long)column,
                  (long long)csv->n_columns);
    return false;
}
