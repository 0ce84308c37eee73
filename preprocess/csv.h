/* CSV: a row of names with the columns wanted, in any order and case, then rows of numbers. Separated by commas,
 * semicolons, tabs or blanks (found in the row of names); '#' begins a comment line; LF or CRLF; fields may stand in
 * quotes; further columns are ignored. */
#ifndef BRC_PREPROCESS_CSV_H
#define BRC_PREPROCESS_CSV_H

#include "lines.h"

enum { BRC_CSV_ROLES = 8 };

/* What is read from the columns, filled by brc_csv_header. */
typedef struct brc_csv {
    int n_roles, n_required; /* set by the caller: names known, of which the first must be there */
    const char *const *role; /* [n_roles] names of columns; borrowed */
    const char *what;        /* what no name at all lacks: "coordinate"; borrowed */
    const char *wanted;      /* what the row of names should be, for sentences; borrowed */
    char separator;          /* ' ': any run of blanks and tabs */
    int64_t n_columns;
    int64_t column[BRC_CSV_ROLES]; /* index of each role, -1: none */
} brc_csv;

/* Read the row of names. False: faults were recorded, and reading on would only repeat them. */
bool brc_csv_header(brc_lines *lines, brc_csv *csv);
/* Step to the next line that holds something. */
bool brc_csv_next(brc_lines *lines);
/* The numbers of the current line; roles without a column keep theirs. place [n_roles]: where each stands, for
 * brc_lines_bad; or NULL. False: faults were recorded. */
bool brc_csv_row(brc_lines *lines, const brc_csv *csv, double *value, const char **place);

#endif
