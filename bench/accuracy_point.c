/* Points of accuracy and their file. One table of columns drives writing, reading and the rows of figures. */
#include "accuracy_point.h"
#include "../host/base/file.h"
#include "../host/base/memory.h"
#include "../host/output/text.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MOST ((size_t)1 << 28)

typedef struct column {
    const char *name;
    brc_field_kind kind;
    size_t offset, size;
} column;

#define TEXT(name)                                                                                                     \
    {                                                                                                                  \
#name, BRC_FIELD_TEXT, offsetof(brc_accuracy_point, name), sizeof(((brc_accuracy_point *)0)->name)             \
    }
#define NUMBER(name)                                                                                                   \
    {                                                                                                                  \
#name, BRC_FIELD_NUMBER, offsetof(brc_accuracy_point, name), sizeof(double)                                    \
    }
#define INTEGER(name)                                                                                                  \
    {                                                                                                                  \
#name, BRC_FIELD_INTEGER, offsetof(brc_accuracy_point, name), sizeof(int64_t)                                  \
    }
static const column columns[] = {TEXT(problem),
                                 TEXT(model),
                                 TEXT(preparation),
                                 INTEGER(elements),
                                 INTEGER(bonds),
                                 TEXT(precision),
                                 NUMBER(dt_fraction),
                                 TEXT(integrator),
                                 INTEGER(threads),
                                 NUMBER(error),
                                 NUMBER(seconds),
                                 INTEGER(steps),
                                 NUMBER(ns_per_bond_update),
                                 NUMBER(host_bytes), /* the rest explains or refines these */
                                 TEXT(run),
                                 TEXT(sweep),
                                 TEXT(quantity),
                                 NUMBER(coordination),
                                 NUMBER(nu),
                                 NUMBER(spacing_over_length),
                                 NUMBER(phi),
                                 NUMBER(level),
                                 TEXT(variant),
                                 INTEGER(seed),
                                 NUMBER(reference),
                                 NUMBER(ours),
                                 TEXT(cost_of),
                                 NUMBER(build_s),
                                 NUMBER(run_s),
                                 NUMBER(wall_s),
                                 TEXT(clock),
                                 INTEGER(iterations),
                                 NUMBER(bonds_per_element),
                                 NUMBER(steps_per_crossing),
                                 NUMBER(bytes_per_element),
                                 NUMBER(closure),
                                 TEXT(note)};
enum { COLUMNS = sizeof columns / sizeof *columns };

static const void *place(const brc_accuracy_point *point, const column *c)
{
    return (const char *)point + c->offset;
}

brc_accuracy_point brc_accuracy_point_empty(void)
{
    brc_accuracy_point point;
    memset(&point, 0, sizeof point);
    for (int k = 0; k < COLUMNS; ++k)
        if (columns[k].kind == BRC_FIELD_NUMBER) *(double *)(void *)((char *)&point + columns[k].offset) = NAN;
    return point;
}

brc_status brc_accuracy_points_add(brc_accuracy_points *points, const brc_accuracy_point *point)
{
    if (points->n == points->capacity) {
        const int64_t capacity = points->capacity ? 2 * points->capacity : 64;
        BRC_TRY(brc_memory_resize(points->context, (void **)&points->items, capacity, sizeof *points->items,
                                  "points of accuracy"));
        points->capacity = capacity;
    }
    points->items[points->n++] = *point;
    return BRC_OK;
}

void brc_accuracy_points_free(brc_accuracy_points *points)
{
    brc_memory_free(points->items);
    memset(points, 0, sizeof *points);
}

const brc_accuracy_point *brc_accuracy_points_find(const brc_accuracy_points *points, const char *problem,
                                                   const char *run)
{
    for (int64_t k = 0; k < points->n; ++k)
        if (strcmp(points->items[k].problem, problem) == 0 && strcmp(points->items[k].run, run) == 0)
            return &points->items[k];
    return NULL;
}

brc_status brc_accuracy_points_write(const brc_accuracy_points *points, const char *path)
{
    brc_text text = {.context = points->context};
    for (int k = 0; k < COLUMNS; ++k)
        brc_text_add(&text, "%s%s", k ? "," : "", columns[k].name);
    brc_text_add(&text, "\n");
    for (int64_t p = 0; p < points->n; ++p) {
        for (int k = 0; k < COLUMNS; ++k) {
            const void *at = place(&points->items[p], &columns[k]);
            if (k) brc_text_add(&text, ",");
            if (columns[k].kind == BRC_FIELD_TEXT) {
                for (const char *c = at; *c; ++c)
                    brc_text_add(&text, "%c", *c == ',' || *c == '"' || *c == '\n' ? ';' : *c);
            } else if (columns[k].kind == BRC_FIELD_INTEGER) {
                brc_text_add(&text, "%lld", (long long)*(const int64_t *)at);
            } else if (!isnan(*(const double *)at)) {
                brc_text_add_number(&text, *(const double *)at);
            }
        }
        brc_text_add(&text, "\n");
    }
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

/* The next field of a line, ended in place; *line moves behind it, NULL after the last. */
static char *next_field(char **line)
{
    char *field = *line, *comma = strchr(field, ',');
    if (comma) *comma = '\0';
    *line = comma ? comma + 1 : NULL;
    return field;
}

/* False: not a value of this column. */
static bool take(brc_accuracy_point *point, const column *c, const char *field)
{
    char *end = NULL, *to = (char *)point + c->offset;
    if (c->kind == BRC_FIELD_TEXT) {
        snprintf(to, c->size, "%s", field);
        return strlen(field) < c->size;
    }
    if (!*field) return c->kind == BRC_FIELD_NUMBER;
    if (c->kind == BRC_FIELD_INTEGER)
        *(int64_t *)(void *)to = strtoll(field, &end, 10);
    else
        *(double *)(void *)to = strtod(field, &end);
    return end != field && !*end;
}

/* Which column stands at each place of a line; -1: unknown. */
static int read_header(char *line, int *order, int most)
{
    int n = 0;
    while (line && n < most) {
        const char *name = next_field(&line);
        int k = 0;
        while (k < COLUMNS && strcmp(columns[k].name, name) != 0)
            ++k;
        order[n++] = k < COLUMNS ? k : -1;
    }
    return n;
}

brc_status brc_accuracy_points_read(brc_accuracy_points *points, const char *path)
{
    char *text = NULL;
    size_t bytes;
    int order[2 * COLUMNS], n_fields = 0;
    brc_status status = BRC_OK;
    BRC_TRY(brc_file_read_whole(points->context, path, BYTES_MOST, &text, &bytes));
    char *line = text;
    for (long long number = 1; line && *line; ++number) {
        char *end = strchr(line, '\n'), *rest = line;
        if (end) *end = '\0';
        line = end ? end + 1 : NULL;
        if (number == 1) {
            n_fields = read_header(rest, order, 2 * COLUMNS);
            continue;
        }
        brc_accuracy_point point = brc_accuracy_point_empty();
        for (int f = 0; f < n_fields; ++f) {
            if (!rest)
                BRC_TRY_OR(cleanup,
                           BRC_FAIL(points->context, BRC_BAD_INPUT,
                                    "%s:%lld: %d fields, expected %d as in its first line", path, number, f, n_fields));
            const char *field = next_field(&rest);
            if (order[f] >= 0 && !take(&point, &columns[order[f]], field))
                BRC_TRY_OR(cleanup,
                           BRC_FAIL(points->context, BRC_BAD_INPUT, "%s:%lld: '%.60s' is no value of the column %s",
                                    path, number, field, columns[order[f]].name));
        }
        if (!point.problem[0] || !point.run[0])
            BRC_TRY_OR(cleanup, BRC_FAIL(points->context, BRC_BAD_INPUT,
                                         "%s:%lld: no problem or no run; expected a file of `breccia bench accuracy`",
                                         path, number));
        BRC_TRY_OR(cleanup, brc_accuracy_points_add(points, &point));
    }
    if (n_fields == 0)
        status = BRC_FAIL(points->context, BRC_BAD_INPUT, "%s: empty, expected a line of column names", path);
cleanup:
    brc_memory_free(text);
    return status;
}

void brc_accuracy_points_rows(const brc_accuracy_points *points, brc_rows *rows)
{
    for (int64_t p = 0; p < points->n; ++p) {
        const brc_accuracy_point *point = &points->items[p];
        brc_rows_begin(rows);
        brc_rows_text(rows, "case", point->problem);
        for (int k = 1; k < COLUMNS; ++k) {
            const void *at = place(point, &columns[k]);
            if (columns[k].kind == BRC_FIELD_TEXT)
                brc_rows_text(rows, columns[k].name, at);
            else if (columns[k].kind == BRC_FIELD_INTEGER)
                brc_rows_integer(rows, columns[k].name, *(const int64_t *)at);
            else
                brc_rows_number(rows, columns[k].name, *(const double *)at);
        }
        brc_rows_stamp(rows);
    }
}
