/* Sparse matrices of blocks between nodes, on the host. A node has six unknowns, a displacement before a rotation, or
 * seven, then its swelling. */
#ifndef BRC_SOLVER_MULTIGRID_ROWS_H
#define BRC_SOLVER_MULTIGRID_ROWS_H

#include "../../../base/memory.h"

enum { BRC_MOST_UNKNOWNS = 7, BRC_MOST_BLOCK = BRC_MOST_UNKNOWNS * BRC_MOST_UNKNOWNS };

/* A symmetric matrix, seen row by row: `row` writes the columns of row i, i itself first, and (block not NULL) its
 * blocks [unknowns][unknowns]; returns how many, at most `most`. */
typedef struct brc_rows {
    int64_t n;
    int32_t most;
    int unknowns; /* of a node */
    const void *of;
    int32_t (*row)(const void *of, int64_t i, int32_t *column, double *block);
} brc_rows;

/* One that is stored. */
typedef struct brc_stored_rows {
    int64_t n;
    int32_t most;
    int unknowns;
    int64_t *start;  /* [n + 1] */
    int32_t *column; /* the diagonal first, then ascending */
    double *block;   /* [start[n]][unknowns][unknowns] */
} brc_stored_rows;

brc_rows brc_rows_of(const brc_stored_rows *stored);
void brc_stored_rows_free(brc_stored_rows *rows);

/* The nodes of a level. */
typedef struct brc_nodes {
    int64_t n;
    double (*place)[3]; /* [n] [m] */
    int32_t *body;      /* [n] */
    int unknowns;       /* of each */
    uint8_t *free_bits; /* [n] bits 1 2 4 of displacements, 8 16 32 of rotations that are free; NULL: all */
} brc_nodes;

/* Boxes of about `size` [m], cut into parts that the matrix joins: aggregate [n] of each node, -1 of those that nothing
 * joins to another; coarse: the aggregates as nodes at their means, of so many unknowns, the caller's (brc_nodes_free).
 * spacing [m]: how far the outermost nodes are from the surface, twice. size, spacing: [bodies]. */
brc_status brc_aggregate(brc_context *context, const brc_rows *rows, const brc_nodes *nodes, const double *size,
                         const double *spacing, int unknowns, int32_t *aggregate, brc_nodes *coarse);
void brc_nodes_free(brc_nodes *nodes);

/* Numbers of the upper triangle of a block, and where row r <= c has its column c: that of six by rows, then the column
 * of swelling. */
static inline int brc_triangle(int unknowns)
{
    return unknowns * (unknowns + 1) / 2;
}
static inline int brc_in_triangle(int r, int c)
{
    return c == 6 ? 21 + r : r * (11 - r) / 2 + c;
}

/* Inverses of diagonal blocks between their free components, zero in the others: upper triangles [n][21] or [n][28].
 * Directions without stiffness get none. */
brc_status brc_invert_blocks(brc_context *context, const brc_rows *rows, const uint8_t *free_bits, double *inverse);

/* P between a level and its aggregates, with the places of its blocks by columns. */
typedef struct brc_prolongation {
    int64_t n, n_coarse;
    int unknowns, coarse_unknowns; /* of a node */
    int64_t *start;                /* [n + 1] */
    int32_t *column;               /* ascending in a row */
    float *block;                  /* [start[n]][unknowns][coarse_unknowns] */
    int64_t *column_start;         /* [n_coarse + 1] */
    int32_t (*entry)[2];           /* block and row, by columns */
} brc_prolongation;

/* P = (1 - weight D^-1 A) T, T the rigid motions of aggregates, and their swelling where they have one, in the free
 * components. */
brc_status brc_prolongation_create(brc_context *context, const brc_rows *rows, const brc_nodes *nodes,
                                   const int32_t *aggregate, const brc_nodes *coarse, double weight,
                                   const double *inverse, brc_prolongation *out);
void brc_prolongation_free(brc_prolongation *p);

/* P^T A P. */
brc_status brc_coarse_rows(brc_context *context, const brc_rows *rows, const brc_prolongation *p, brc_stored_rows *out);
/* Inverse of a matrix [unknowns n][unknowns n]; directions without stiffness count as rigid. false in *done: it is not
 * positive. */
brc_status brc_invert_rows(brc_context *context, const brc_stored_rows *rows, double *inverse, bool *done);

#endif
