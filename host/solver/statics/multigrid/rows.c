/* Stored rows, and inverses of blocks and of whole matrices. */
#include "rows.h"
#include <lapacke.h>
#include <math.h>
#include <string.h>

static int32_t stored_row(const void *of, int64_t i, int32_t *column, double *block)
{
    const brc_stored_rows *m = of;
    const int32_t n = (int32_t)(m->start[i + 1] - m->start[i]);
    memcpy(column, m->column + m->start[i], (size_t)n * sizeof *column);
    const int64_t size = (int64_t)m->unknowns * m->unknowns;
    if (block) memcpy(block, m->block + size * m->start[i], (size_t)(size * n) * sizeof *block);
    return n;
}

brc_rows brc_rows_of(const brc_stored_rows *stored)
{
    return (brc_rows){
        .n = stored->n, .most = stored->most, .unknowns = stored->unknowns, .of = stored, .row = stored_row};
}

void brc_stored_rows_free(brc_stored_rows *rows)
{
    brc_memory_free(rows->start);
    brc_memory_free(rows->column);
    brc_memory_free(rows->block);
    *rows = (brc_stored_rows){0};
}

/* Of a symmetric matrix scaled to a unit diagonal: directions softer than this part of the stiffest count as
 * without stiffness. */
static const double softest = 1e-11;

static bool invert_block(int n, const double *k, int free_bits, double *inverse)
{
    double a[BRC_MOST_BLOCK], scale[BRC_MOST_UNKNOWNS], values[BRC_MOST_UNKNOWNS], work[40];
    for (int c = 0; c < n; ++c)
        scale[c] = free_bits >> c & 1 && k[(n + 1) * c] > 0 ? 1 / sqrt(k[(n + 1) * c]) : 0;
    for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c)
            a[n * r + c] = 0.5 * (k[n * r + c] + k[n * c + r]) * scale[r] * scale[c];
    if (LAPACKE_dsyev_work(LAPACK_ROW_MAJOR, 'V', 'U', n, a, n, values, work, 40) != 0) return false;
    for (int r = 0; r < n; ++r)
        for (int c = r; c < n; ++c) {
            double *to = inverse + brc_in_triangle(r, c);
            *to = 0;
            for (int v = 0; v < n; ++v)
                if (values[v] > softest * values[n - 1]) *to += a[n * r + v] * a[n * c + v] / values[v];
            *to *= scale[r] * scale[c];
        }
    return true;
}

brc_status brc_invert_blocks(brc_context *context, const brc_rows *rows, const uint8_t *free_bits, double *inverse)
{
    const int n = rows->unknowns, all = (1 << n) - 1;
    int failed = 0, short_of_memory = 0;
#pragma omp parallel reduction(+ : failed, short_of_memory)
    {
        int32_t *column = NULL;
        double *block = NULL;
        if (BRC_ALLOCATE(context, &column, rows->most, "blocks") != BRC_OK ||
            BRC_ALLOCATE(context, &block, (int64_t)n * n * rows->most, "blocks") != BRC_OK)
            short_of_memory = 1;
#pragma omp for schedule(static)
        for (int64_t i = 0; i < rows->n; ++i) {
            if (short_of_memory) continue;
            rows->row(rows->of, i, column, block);
            failed += !invert_block(n, block, free_bits ? free_bits[i] : all, inverse + brc_triangle(n) * i);
        }
        brc_memory_free(column);
        brc_memory_free(block);
    }
    if (short_of_memory) return BRC_NO_MEMORY;
    return failed ? BRC_FAIL(context, BRC_INTERNAL, "the eigenvalues of %d blocks did not converge", failed) : BRC_OK;
}

brc_status brc_invert_rows(brc_context *context, const brc_stored_rows *rows, double *inverse, bool *done)
{
    const int each = rows->unknowns, n = (int)(each * rows->n);
    BRC_LOCAL(context, n, double, scale, "coarsest level");
    memset(inverse, 0, (size_t)n * (size_t)n * sizeof *inverse);
    for (int64_t i = 0; i < rows->n; ++i)
        for (int64_t k = rows->start[i]; k < rows->start[i + 1]; ++k)
            for (int r = 0; r < each; ++r)
                for (int c = 0; c < each; ++c) {
                    const double value = rows->block[each * each * k + each * r + c];
                    inverse[(each * i + r) * n + each * (int64_t)rows->column[k] + c] = value;
                    if (k == rows->start[i] && r == c) scale[each * i + r] = value > 0 ? 1 / sqrt(value) : 0;
                }
    for (int64_t r = 0; r < n; ++r)
        for (int64_t c = 0; c < n; ++c)
            inverse[r * n + c] = (r == c ? softest : 0) +
                                 (scale[r] > 0 && scale[c] > 0 ? inverse[r * n + c] * scale[r] * scale[c] : r == c);
    *done = LAPACKE_dpotrf(LAPACK_ROW_MAJOR, 'U', n, inverse, n) == 0 &&
            LAPACKE_dpotri(LAPACK_ROW_MAJOR, 'U', n, inverse, n) == 0;
    for (int64_t r = 0; *done && r < n; ++r)
        for (int64_t c = r; c < n; ++c)
            inverse[c * n + r] = inverse[r * n + c] *= scale[r] * scale[c];
    return BRC_OK;
}
