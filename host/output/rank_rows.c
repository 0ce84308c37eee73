/* Rows of ranks to and from files. */
#include "rank_rows.h"
#include "h5_pack.h"
#include "../base/memory.h"
#include "../base/ranks.h"
#include <string.h>

enum { PIECE_BYTES = 32 << 20 };

int64_t brc_rank_rows_piece(int64_t width)
{
    const int64_t blocks = PIECE_BYTES / (width * BRC_H5_BLOCK);
    return (blocks > 1 ? blocks : 1) * BRC_H5_BLOCK;
}

/* Own rows whose ids are below `id`. */
static int64_t count_below(const brc_rank_rows *rows, int64_t id)
{
    int64_t low = 0, high = rows->n;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (rows->id[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* What rank 0 gets: ids and rows, one rank after another. */
typedef struct received {
    int32_t *id;
    char *row;
    int64_t *n_of, *bytes_of; /* [ranks]: rows, then bytes of what is moved */
} received;

static void free_received(received *r)
{
    brc_memory_free(r->id);
    brc_memory_free(r->row);
    brc_memory_free(r->n_of);
    brc_memory_free(r->bytes_of);
}

/* mine: own rows of the piece. */
static brc_status count_rows(brc_context *context, int64_t mine, int64_t n, int64_t width, received *r)
{
    const int32_t ranks = brc_ranks_count();
    int64_t *one = NULL, sum = 0;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &r->n_of, ranks, "rows of ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &r->bytes_of, ranks, "rows of ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &one, ranks, "rows of ranks"));
    for (int32_t k = 0; k < ranks; ++k)
        one[k] = 1;
    BRC_TRY_OR(cleanup, brc_ranks_gather_all(context, &mine, sizeof mine, one, r->n_of));
    for (int32_t k = 0; k < ranks; ++k)
        sum += r->n_of[k];
    if (sum != n)
        status = BRC_FAIL(context, BRC_INTERNAL, "%lld rows of a file have %lld owners", (long long)n, (long long)sum);
    if (status != BRC_OK || brc_ranks_mine() != 0) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &r->id, n, "ids of ranks"));
    BRC_TRY_OR(cleanup, brc_memory_allocate(context, (void **)&r->row, n, (size_t)width, "rows of ranks"));
cleanup:
    brc_memory_free(one);
    return status;
}

static brc_status gather(brc_context *context, received *r, int64_t width, const void *mine, void *all)
{
    for (int32_t k = 0; k < brc_ranks_count(); ++k)
        r->bytes_of[k] = r->n_of[k] * width;
    return brc_ranks_gather_first(context, mine, r->bytes_of, all);
}

brc_status brc_rank_rows_gather(brc_context *context, const brc_rank_rows *rows, int64_t first, int64_t n,
                                int64_t width, const void *own, void *whole)
{
    const int64_t low = count_below(rows, first), mine = count_below(rows, first + n) - low;
    const char *const from = (const char *)own + low * width;
    received r = {0};
    brc_status status = BRC_OK;
    if (mine == n && brc_ranks_count() == 1) {
        memcpy(whole, from, (size_t)(n * width));
        return BRC_OK;
    }
    BRC_TRY_OR(cleanup, count_rows(context, mine, n, width, &r));
    BRC_TRY_OR(cleanup, gather(context, &r, (int64_t)sizeof *rows->id, rows->id + low, r.id));
    BRC_TRY_OR(cleanup, gather(context, &r, width, from, r.row));
    for (int64_t k = 0; r.id && k < n; ++k)
        memcpy((char *)whole + (r.id[k] - first) * width, r.row + k * width, (size_t)width);
cleanup:
    free_received(&r);
    return status;
}

brc_status brc_rank_rows_write(brc_h5 *h5, const char *name, hid_t type, int64_t columns, bool packed,
                               const brc_rank_rows *rows, int64_t first, const void *own, int n_threads)
{
    const int64_t width = (int64_t)H5Tget_size(type) * columns, piece = brc_rank_rows_piece(width);
    char *whole = NULL;
    brc_status status = BRC_OK;
    if (brc_ranks_mine() == 0)
        BRC_TRY(brc_memory_allocate(h5->context, (void **)&whole, piece < rows->all ? piece : rows->all, (size_t)width,
                                    "rows of ranks"));
    for (int64_t at = 0; status == BRC_OK && at < rows->all; at += piece) {
        const int64_t n = rows->all - at < piece ? rows->all - at : piece;
        status = brc_rank_rows_gather(h5->context, rows, at, n, width, own, whole);
        if (status == BRC_OK && packed)
            brc_h5_pack_rows(h5, name, type, first + at, n, whole, n_threads);
        else if (status == BRC_OK)
            brc_h5_rows(h5, name, type, first + at, n, whole);
    }
    brc_memory_free(whole);
    return status;
}

brc_status brc_rank_rows_read(const brc_h5_read *h5, const char *name, hid_t type, int64_t columns,
                              const brc_rank_rows *rows, int64_t first, void *own)
{
    const int64_t width = (int64_t)H5Tget_size(type) * columns, piece = brc_rank_rows_piece(width);
    char *some = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(brc_memory_allocate(h5->context, (void **)&some, piece < rows->all ? piece : rows->all, (size_t)width,
                                "rows of ranks"));
    for (int64_t at = 0, k = 0, end; status == BRC_OK && at < rows->all; at += piece, k = end) {
        end = count_below(rows, at + piece);
        if (end == k) continue;
        const int64_t low = rows->id[k];
        status = brc_h5_read_rows(h5, name, type, first + low, rows->id[end - 1] - low + 1, some);
        for (int64_t i = k; status == BRC_OK && i < end; ++i)
            memcpy((char *)own + i * width, some + (rows->id[i] - low) * width, (size_t)width);
    }
    brc_memory_free(some);
    return status;
}
