#include "crack_factors.h"
#include "../host/base/file.h"
#include "../host/base/memory.h"
#include <stdio.h>

enum { N_PLANES = 3, ROW = 80 };
static const double at_edge = 0.003, elsewhere = 1e6;

static double factor_of(const double *a, const double *b)
{
    for (int k = 1; k <= N_PLANES; ++k) {
        const double plane = (double)k / (N_PLANES + 1);
        if ((a[0] < plane) != (b[0] < plane)) return at_edge + 0.5 * (a[1] + b[1]);
    }
    return elsewhere;
}

brc_status brc_crack_factors_write(brc_context *context, const brc_domain *d, const char *path)
{
    char *text = NULL;
    const size_t room = (size_t)(d->n_bonds + 1) * ROW;
    size_t used;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &text, (int64_t)room, "factors of bonds"));
    used = (size_t)snprintf(text, room, "element_i,element_j,factor\n");
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b], i = d->neighbour[d->twin[h]], j = d->neighbour[h];
        used += (size_t)snprintf(text + used, room - used, "%lld,%lld,%.9g\n", (long long)i, (long long)j,
                                 factor_of(d->position + 3 * i, d->position + 3 * j));
    }
    status = brc_file_write_whole(context, path, text, used);
    brc_memory_free(text);
    return status;
}
