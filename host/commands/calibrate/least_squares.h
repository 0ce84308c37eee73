/* Equations that are linear in their unknowns, by LAPACK. */
#ifndef BRC_COMMANDS_LEAST_SQUARES_H
#define BRC_COMMANDS_LEAST_SQUARES_H

#include "../../base/status.h"

/* m equations of n <= m unknowns. */
typedef struct brc_equations {
    int m, n;
    double *a; /* [m][n], owned; overwritten by the solution */
    double *b; /* [m] right sides, owned; the n unknowns after the solution */
} brc_equations;

brc_status brc_equations_create(brc_context *context, int m, int n, brc_equations *out);
void brc_equations_free(brc_equations *e);
/* The unknowns that leave the least sum of squares. BRC_INTERNAL: the equations do not determine them. */
brc_status brc_equations_solve(brc_context *context, brc_equations *e);

#endif
