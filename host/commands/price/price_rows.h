/* Rows of a CSV text with a header line, by the names of their columns: bench/results/accuracy-curves.csv, inside the
 * program. No quotes in it. */
#ifndef BRC_COMMANDS_PRICE_ROWS_H
#define BRC_COMMANDS_PRICE_ROWS_H

#include <stdbool.h>

enum { BRC_PRICE_COLUMNS_MOST = 64 };

/* A place between two rows; all of it is borrowed but the copy of the present line. */
typedef struct brc_price_rows {
    const char *at, *const *names;
    int n, column[BRC_PRICE_COLUMNS_MOST]; /* -1: no such column */
    char line[2048];
} brc_price_rows;

/* Before the first row of `text`. names: [n] columns looked at, n at most BRC_PRICE_COLUMNS_MOST; both must outlive
 * *rows. */
void brc_price_rows_begin(brc_price_rows *rows, const char *text, int n, const char *const *names);
/* The next row's values, [n], "" where it has none, valid until the next call. False: there is none left. */
bool brc_price_rows_next(brc_price_rows *rows, const char **value);

#endif
