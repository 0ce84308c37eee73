#include "least_squares.h"
#include "../../base/memory.h"
#include <lapacke.h>

brc_status brc_equations_create(brc_context *context, int m, int n, brc_equations *out)
{
    *out = (brc_equations){.m = m, .n = n};
    brc_status status = BRC_ALLOCATE(context, &out->a, (int64_t)m * n, "equations of a fit");
    if (status == BRC_OK) status = BRC_ALLOCATE(context, &out->b, m > n ? m : n, "equations of a fit");
    return status;
}

void brc_equations_free(brc_equations *e)
{
    brc_memory_free(e->a);
    brc_memory_free(e->b);
    *e = (brc_equations){0};
}

brc_status brc_equations_solve(brc_context *context, brc_equations *e)
{
    if (e->m < e->n || LAPACKE_dgels(LAPACK_ROW_MAJOR, 'N', e->m, e->n, 1, e->a, e->n, e->b, 1) != 0)
        return BRC_FAIL(context, BRC_INTERNAL, "the %d equations of a fit do not determine its %d coefficients", e->m,
                        e->n);
    return BRC_OK;
}
