/* Rows of figures: what `breccia reproduce` and `breccia bench` write as rows.json and rows.csv. */
#ifndef BRC_BENCH_ROWS_H
#define BRC_BENCH_ROWS_H

#include "../host/base/status.h"
#include <stdint.h>

typedef enum brc_field_kind { BRC_FIELD_NUMBER, BRC_FIELD_INTEGER, BRC_FIELD_TEXT } brc_field_kind;

typedef struct brc_field {
    char key[32];
    brc_field_kind kind;
    double number; /* NAN: null */
    int64_t integer;
    char text[160];
} brc_field;

#define BRC_FIELDS_MOST 48

typedef struct brc_row {
    int n_fields;
    brc_field fields[BRC_FIELDS_MOST];
} brc_row;

typedef struct brc_rows {
    brc_context *context; /* borrowed */
    int64_t n_rows, capacity;
    brc_row *rows;     /* owned */
    brc_status status; /* the first failure; later additions do nothing */
} brc_rows;

/* Rows start as {.context = context} and take fields in the order they are to be read. A new row is the last one. */
void brc_rows_begin(brc_rows *rows);
/* Add to the last row, or replace the field of this key. Texts are cut to what a field holds; NULL is left out. */
void brc_rows_number(brc_rows *rows, const char *key, double value);
void brc_rows_integer(brc_rows *rows, const char *key, int64_t value);
void brc_rows_text(brc_rows *rows, const char *key, const char *value);
/* The field of a row, NULL when it has none of this key. */
const brc_field *brc_row_find(const brc_row *row, const char *key);
/* Number or whole number of a field, NAN where it has none; text of a field, "" where it has none. */
double brc_row_number(const brc_row *row, const char *key);
const char *brc_row_text(const brc_row *row, const char *key);
/* version, commit, compiler and date (UTC) into the last row: what makes a figure repeatable. */
void brc_rows_stamp(brc_rows *rows);
/* Make `folder` and write rows.json (an array of objects) and rows.csv (columns: all keys in order of appearance). */
brc_status brc_rows_write(const brc_rows *rows, const char *folder);
void brc_rows_free(brc_rows *rows);

#endif
