/* Sizes of fragments: no state, sums in order of mass. */
#include "fragments.h"
#include "../../../base/memory.h"
#include <stdlib.h>

typedef struct size {
    double mass;
    int64_t index;
} size;

static int by_mass(const void *a, const void *b)
{
    const size *x = a, *y = b;
    if (x->mass != y->mass) return x->mass < y->mass ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

brc_status brc_fragment_sizes_of(brc_context *context, int64_t n, const brc_fragment *fragment, brc_fragment_sizes *out,
                                 double *below)
{
    double square = 0, sum = 0;
    *out = (brc_fragment_sizes){0};
    BRC_LOCAL(context, n, size, order, "sizes of fragments");
    for (int64_t i = 0; i < n; ++i) {
        order[i] = (size){fragment[i].mass, i};
        out->mass += fragment[i].mass;
    }
    if (n > 0) qsort(order, (size_t)n, sizeof *order, by_mass);
    for (int64_t i = 0, first = 0; i < n; ++i) {
        sum += order[i].mass;
        square += order[i].mass * order[i].mass;
        if (i + 1 < n && order[i + 1].mass == order[i].mass) continue; /* equal ones have the same share */
        for (; below && first <= i; ++first)
            below[order[first].index] = i + 1 == n ? 1 : sum / out->mass;
        first = i + 1;
    }
    if (n > 0) {
        out->largest_share = order[n - 1].mass / out->mass;
        out->mean_mass = square / out->mass;
    }
    return BRC_OK;
}
