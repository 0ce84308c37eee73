/* Stored rows, and inverses of blocks and of whole matrices. */
#include "rows.h"
#include <lapacke.h>
#include <math.h>
#include <string.h>

static int32_t stored_row(const void *of, int64_t i, int32_t *column, brc_block *block)
{
    const brc_stored_rows *m = of;
    const int32_t n = (int32_t)(m->start[i + 1] - m->start[i]);
    memcpy(column, m->column + m->start[i], (size_t)n * sizeof *column);
    if (block) memcpy(block, m->block + m->start[i], (size_t)n * sizeof *block);
    return n;
}

brc_rows brc_rows_of(const brc_stored_rows *stored)
{
    return (brc_rows){.n = stored->n, .most = stored->most, .of = stored, .row = stored_row};
}

void brc_stored_rows_free(brc_stored_rows *rows)
{
    brc_memory_free(rows->start);
    brc_memory_free(rows->column);
    brc_memory_free(rows->block);
    *rows = (brc_stored_rows){0};
}

/* Of a symmetric matrix [6][6] scaled to a unit diagonal: directions softer than this part of the stiffest count as
 * without stiffness. */
static const double softest = 1e-11;

static bool invert_block(const brc_block k, int free_bits, double inverse[21])
{
    double a[36], scale[6], values[6], work[40];
    for (int c = 0; c < 6; ++c)
        scale[c] = free_bits >> c & 1 && k[7 * c] > 0 ? 1 / sqrt(k[7 * c]) : 0;
    for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c)
            a[6 * r + c] = 0.5 * (k[6 * r + c] + k[6 * c + r]) * scale[r] * scale[c];
    if (LAPACKE_dsyev_work(LAPACK_ROW_MAJOR, 'V', 'U', 6, a, 6, values, work, 40) != 0) return false;
    for (int r = 0, at = 0; r < 6; ++r)
        for (int c = r; c < 6; ++c, ++at) {
            inverse[at] = 0;
            for (int v = 0; v < 6; ++v)
                if (values[v] > softest * values[5]) inverse[at] += a[6 * r + v] * a[6 * c + v] / values[v];
            inverse[at] *= scale[r] * scale[c];
        }
    return true;
}

brc_status brc_invert_blocks(brc_context *context, const brc_rows *rows, const uint8_t *free_bits,
                             double (*inverse)[21])
{
    int failed = 0, short_of_memory = 0;
#pragma omp parallel reduction(+ : failed, short_of_memory)
    {
        int32_t *column = NULL;
        brc_block *block = NULL;
        if (BRC_ALLOCATE(context, &column, rows->most, "blocks") != BRC_OK ||
            BRC_ALLOCATE(context, &block, rows->most, "blocks") != BRC_OK)
            short_of_memory = 1;
#pragma omp for schedule(static)
        for (int64_t i = 0; i < rows->n; ++i) {
            if (short_of_memory) continue;
            rows->row(rows->of, i, column, block);
            failed += !invert_block(block[0], free_bits ? free_bits[i] : 63, inverse[i]);
        }
        brc_memory_free(column);
        brc_memory_free(block);
    }
    if (short_of_memory) return BRC_NO_MEMORY;
    return failed ? BRC_FAIL(context, BRC_INTERNAL, "the eigenvalues of %d blocks did not converge", failed) : BRC_OK;
}

brc_status brc_invert_rows(brc_context *context, const brc_stored_rows *rows, double *inverse, bool *done)
{
    const int n = (int)(6 * rows->n);
    BRC_LOCAL(context, n, double, scale, "coarsest level");
    memset(inverse, 0, (size_t)n * (size_t)n * sizeof *inverse);
    for (int64_t i = 0; i < rows->n; ++i)
        for (int64_t k = rows->start[i]; k < rows->start[i + 1]; ++k)
            for (int r = 0; r < 6; ++r)
                for (int c = 0; c < 6; ++c) {
                    inverse[(6 * i + r) * n + 6 * (int64_t)rows->column[k] + c] = rows->block[k][6 * r + c];
                    if (k == rows->start[i] && r == c)
                        scale[6 * i + r] = rows->block[k][7 * r] > 0 ? 1 / sqrt(rows->block[k][7 * r]) : 0;
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
