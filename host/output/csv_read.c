#include "csv_read.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* "name [unit]" is taken apart in place. */
static const char *take_unit(char *head)
{
    char *bracket = strrchr(head, '['), *end = bracket ? strchr(bracket, ']') : NULL;
    if (!bracket || !end || bracket == head) return "";
    bracket[-1] = *end = '\0';
    return bracket + 1;
}

static brc_status read_head(brc_context *context, const char *path, char *line, brc_csv_read *out)
{
    for (char *rest = line; rest;) {
        char *head = strsep(&rest, ",");
        if (out->n_columns == BRC_CSV_COLUMNS)
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: more than %d columns", path, BRC_CSV_COLUMNS);
        out->unit[out->n_columns] = take_unit(head);
        out->name[out->n_columns++] = head;
    }
    return BRC_OK;
}

static int64_t count_lines(const char *text)
{
    int64_t n = 0;
    for (const char *s = strchr(text, '\n'); s; s = strchr(s + 1, '\n'))
        ++n;
    return n;
}

/* One row of a line that ends; false where a cell is missing. */
static bool read_row(const char *line, const char *end, int n_columns, double *value)
{
    for (int k = 0; k < n_columns; ++k) {
        const char *comma = memchr(line, ',', (size_t)(end - line));
        const char *last = comma ? comma : end;
        if ((comma == NULL) != (k == n_columns - 1)) return false;
        char *stop;
        value[k] = last > line ? strtod(line, &stop) : NAN;
        if (last > line && stop != last) value[k] = NAN;
        line = last + 1;
    }
    return true;
}

brc_status brc_csv_read_open(brc_context *context, const char *folder, const char *name, brc_csv_read *out)
{
    char *path = NULL;
    size_t bytes;
    brc_status status = BRC_OK;
    *out = (brc_csv_read){0};
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, name, &path));
    if (!brc_file_exists(path)) goto cleanup;
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, path, (size_t)1 << 30, &out->text, &bytes));
    char *rows = strchr(out->text, '\n');
    if (!rows) goto cleanup;
    *rows++ = '\0';
    BRC_TRY_OR(cleanup, read_head(context, path, out->text, out));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->value, count_lines(rows) * out->n_columns, "rows of a table"));
    for (char *end; (end = strchr(rows, '\n')); rows = end + 1)
        out->n_rows += read_row(rows, end, out->n_columns, out->value + out->n_rows * out->n_columns);
cleanup:
    brc_memory_free(path);
    if (status != BRC_OK) brc_csv_read_free(out);
    return status;
}

void brc_csv_read_free(brc_csv_read *csv)
{
    brc_memory_free(csv->text);
    brc_memory_free(csv->value);
    *csv = (brc_csv_read){0};
}

int brc_csv_read_column(const brc_csv_read *csv, const char *name)
{
    for (int k = 0; k < csv->n_columns; ++k)
        if (strcmp(csv->name[k], name) == 0) return k;
    return -1;
}
