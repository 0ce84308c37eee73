/* Reading the CSV tables of a run: histories.csv, cracks.csv, fragments.csv. */
#ifndef BRC_OUTPUT_CSV_READ_H
#define BRC_OUTPUT_CSV_READ_H

#include "../base/status.h"
#include <stdint.h>

enum { BRC_CSV_COLUMNS = 512 };

/* Owned; brc_csv_read_free. */
typedef struct brc_csv_read {
    char *text; /* of the file; names and units lie in it */
    int n_columns;
    const char *name[BRC_CSV_COLUMNS];
    const char *unit[BRC_CSV_COLUMNS]; /* "" where the head has none */
    int64_t n_rows;
    double *value; /* [n_rows][n_columns]; NAN where a cell is empty or a word */
} brc_csv_read;

/* folder/name; a file that is not there, or has no head line yet, gives no column. A last row that is not whole is left
 * out. BRC_BAD_INPUT: larger than a gigabyte, or more than BRC_CSV_COLUMNS columns. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_csv_read_open(brc_context *context, const char *folder, const char *name, brc_csv_read *out);
void brc_csv_read_free(brc_csv_read *csv);
/* Index of the column of this name, -1 where there is none. */
int brc_csv_read_column(const brc_csv_read *csv, const char *name);

#endif
