/* Rows that several ranks own (ranks.h), in files: each rank has some rows of a whole, by id; rank 0 has them brought
 * to it, piece by piece and in the order of ids, and writes them as one rank would. So a file's bytes do not depend on
 * the number of ranks, and no rank holds more than its own rows and a piece. */
#ifndef BRC_OUTPUT_RANK_ROWS_H
#define BRC_OUTPUT_RANK_ROWS_H

#include "h5.h"
#include "h5_read.h"

typedef struct brc_rank_rows {
    int64_t all;       /* rows of the whole */
    int64_t n;         /* own; may be 0 */
    const int32_t *id; /* [n] ascending, of 0 .. all - 1; every row of the whole has one owner */
} brc_rank_rows;

/* Rows of `width` bytes that are moved at once: as many whole blocks (BRC_H5_BLOCK) as 32 MB have, one at least. */
int64_t brc_rank_rows_piece(int64_t width);
/* All ranks. Rows first .. first + n - 1, of `width` bytes each, come to stand in `whole` of rank 0 (elsewhere not
 * touched). own: [rows->n]. BRC_INTERNAL where some row has no owner or several; BRC_NO_MEMORY. */
brc_status brc_rank_rows_gather(brc_context *context, const brc_rank_rows *rows, int64_t first, int64_t n,
                                int64_t width, const void *own, void *whole);
/* All ranks. The whole into rows first .. of a dataset that is there, of brc_h5_packed where it is packed; `type` is
 * that of the file, `columns` 1 or more. A file that failed stays as it is, and the ranks together. What fails in the
 * file is kept by it, as always; returned is what fails between ranks. */
brc_status brc_rank_rows_write(brc_h5 *h5, const char *name, hid_t type, int64_t columns, bool packed,
                               const brc_rank_rows *rows, int64_t first, const void *own, int n_threads);
/* This rank's rows of the whole that stands in rows first .. of a dataset, each rank for itself: what lies between its
 * ids is read too, a piece at a time. own: [rows->n][columns] of `type`. BRC_BAD_INPUT: damaged; BRC_NO_MEMORY. */
brc_status brc_rank_rows_read(const brc_h5_read *h5, const char *name, hid_t type, int64_t columns,
                              const brc_rank_rows *rows, int64_t first, void *own);

#endif
