/* What one rank and MPI share. */
#include "memory.h"
#include "ranks.h"
#include <string.h>

int32_t brc_ranks_mine(void)
{
    return brc_ranks_here().mine;
}

int32_t brc_ranks_count(void)
{
    return brc_ranks_here().count;
}

/* Integers in the order of the numbers whose bits they are; there and back. */
static int64_t ordered(int64_t bits)
{
    return bits < 0 ? bits ^ INT64_MAX : bits;
}

static brc_status reduce(brc_context *context, brc_reduction reduction, int64_t n, double *values)
{
    int64_t *keys = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &keys, n, "numbers of ranks"));
    memcpy(keys, values, (size_t)n * sizeof *keys);
    for (int64_t k = 0; k < n; ++k)
        keys[k] = values[k] != values[k] ? INT64_MAX : ordered(keys[k]); /* a NAN again on the way back */
    const brc_status status = brc_ranks_reduce(context, reduction, n, keys);
    for (int64_t k = 0; k < n; ++k)
        keys[k] = ordered(keys[k]);
    if (status == BRC_OK) memcpy(values, keys, (size_t)n * sizeof *keys);
    brc_memory_free(keys);
    return status;
}

brc_status brc_ranks_least(brc_context *context, int64_t n, double *values)
{
    return brc_ranks_count() == 1 ? BRC_OK : reduce(context, BRC_LEAST, n, values);
}

brc_status brc_ranks_most(brc_context *context, int64_t n, double *values)
{
    return brc_ranks_count() == 1 ? BRC_OK : reduce(context, BRC_MOST, n, values);
}
