#include "price_rows.h"
#include <stdio.h>
#include <string.h>

/* The next line of the text, split in place; a field may be empty. Returns the number of its fields, 0: the text has
 * ended. */
static int next_line(brc_price_rows *rows, const char **field)
{
    int n = 0;
    if (!rows->at || !*rows->at) return 0;
    const char *end = strchr(rows->at, '\n');
    snprintf(rows->line, sizeof rows->line, "%.*s", (int)(end ? end - rows->at : (long)strlen(rows->at)), rows->at);
    rows->at = end ? end + 1 : NULL;
    for (char *at = rows->line; at && n < BRC_PRICE_COLUMNS_MOST;) {
        field[n++] = at;
        at = strchr(at, ',');
        if (at) *at++ = '\0';
    }
    return n;
}

void brc_price_rows_begin(brc_price_rows *rows, const char *text, int n, const char *const *names)
{
    const char *field[BRC_PRICE_COLUMNS_MOST];
    *rows = (brc_price_rows){.at = text, .names = names, .n = n};
    for (int k = 0; k < n; ++k)
        rows->column[k] = -1;
    const int n_fields = next_line(rows, field);
    for (int c = 0; c < n_fields; ++c)
        for (int k = 0; k < n; ++k)
            if (strcmp(field[c], names[k]) == 0) rows->column[k] = c;
}

bool brc_price_rows_next(brc_price_rows *rows, const char **value)
{
    const char *field[BRC_PRICE_COLUMNS_MOST];
    const int n_fields = next_line(rows, field);
    for (int k = 0; k < rows->n; ++k)
        value[k] = rows->column[k] >= 0 && rows->column[k] < n_fields ? field[rows->column[k]] : "";
    return n_fields > 0;
}
