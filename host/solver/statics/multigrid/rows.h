/* Sparse matrices of 6 x 6 blocks between nodes, on the host: a node has a displacement before a rotation. */
#ifndef BRC_SOLVER_MULTIGRID_ROWS_H
#define BRC_SOLVER_MULTIGRID_ROWS_H

#include "../../../base/memory.h"

typedef double brc_block[36]; /* by rows */
typedef float brc_narrow[36];

/* A symmetric matrix, seen row by row: `row` writes the columns of row i, i itself first, and (block not NULL) its
 * blocks; returns how many, at most `most`. */
typedef struct brc_rows {
    int64_t n;
    int32_t most;
    const void *of;
    int32_t (*row)(const void *of, int64_t i, int32_t *column, brc_block *block);
} brc_rows;

/* One that is stored. */
typedef struct brc_stored_rows {
    int64_t n;
    int32_t most;
    int64_t *start;  /* [n + 1] */
    int32_t *column; /* the diagonal first, then ascending */
    brc_block *block;
} brc_stored_rows;

brc_rows brc_rows_of(const brc_stored_rows *stored);
void brc_stored_rows_free(brc_stored_rows *rows);

/* The nodes of a level. */
typedef struct brc_nodes {
    int64_t n;
    double (*place)[3]; /* [n] [m] */
    int32_t *body;      /* [n] */
    uint8_t *free_bits; /* [n] bits 1 2 4 of displacements, 8 16 32 of rotations that are free; NULL: all */
} brc_nodes;

/* Boxes of about `size` [m], cut into parts that the matrix joins: aggregate [n] of each node, -1 of those that nothing
 * joins to another; coarse: the aggregates as nodes at their means, the caller's (brc_nodes_free). spacing [m]: how far
 * the outermost nodes are from the surface, twice. size, spacing: [bodies]. */
brc_status brc_aggregate(brc_context *context, const brc_rows *rows, const brc_nodes *nodes, const double *size,
                         const double *spacing, int32_t *aggregate, brc_nodes *coarse);
void brc_nodes_free(brc_nodes *nodes);

/* Inverses of diagonal blocks between their free components, zero in the others: upper triangles [n][21]. Directions
 * without stiffness get none. */
brc_status brc_invert_blocks(brc_context *context, const brc_rows *rows, const uint8_t *free_bits,
                             double (*inverse)[21]);

/* P between a level and its aggregates, with the places of its blocks by columns. */
typedef struct brc_prolongation {
    int64_t n, n_coarse;
    int64_t *start;        /* [n + 1] */
    int32_t *column;       /* ascending in a row */
    brc_narrow *block;     /* by rows */
    int64_t *column_start; /* [n_coarse + 1] */
    int32_t (*entry)[2];   /* block and row, by columns */
} brc_prolongation;

/* P = (1 - weight D^-1 A) T, T the rigid motions of aggregates in the free components. */
brc_status brc_prolongation_create(brc_context *context, const brc_rows *rows, const brc_nodes *nodes,
                                   const int32_t *aggregate, const brc_nodes *coarse, double weight,
                                   const double (*inverse)[21], brc_prolongation *out);
void brc_prolongation_free(brc_prolongation *p);

/* P^T A P. */
brc_status brc_coarse_rows(brc_context *context, const brc_rows *rows, const brc_prolongation *p, brc_stored_rows *out);
/* Inverse of a matrix [6 n][6 n]; directions without stiffness count as rigid. false in *done: it is not positive. */
brc_status brc_invert_rows(brc_context *context, const brc_stored_rows *rows, double *inverse, bool *done);

#endif
