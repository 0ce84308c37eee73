/* From the homes of the cells of a body to those that they have among all bodies, window by window of cells. Homes
 * ascend, so what goes to ranks, and what comes, lies in the order of cells. */
#include "domain_rows.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"

#include <string.h>

enum { WINDOW = 1 << 14 };

/* Cells [first, end). */
typedef struct span {
    int64_t first, end;
} span;

/* Of a, what is in b too; with nothing in it at the beginning of a. */
static span common_of(span a, span b)
{
    const int64_t first = a.first > b.first ? a.first : b.first, end = a.end < b.end ? a.end : b.end;
    return end > first ? (span){first, end} : (span){a.first, a.first};
}

/* Cells of `from` that are at home on rank k in `to`. */
static span settles_on(const brc_domain *to, int64_t at, int32_t k)
{
    return (span){to->home[k] - at, to->home[k + 1] - at};
}

/* Where what cell e has in part p begins [numbers]. */
static int64_t begin_of(const brc_domain *d, int p, int64_t e)
{
    const int64_t begin[BRC_DOMAIN_PARTS] = {3 * d->row_start[e], 3 * d->row_start[e], 3 * d->vertex_start[e], 3 * e,
                                             6 * e};
    return begin[p];
}

static double *part_of(const brc_domain *d, int p)
{
    double *const part[BRC_DOMAIN_PARTS] = {d->area_vector, d->face_centroid, d->vertex, d->centroid, d->inertia};
    return part[p];
}

/* Part p of the cells of a window. */
static brc_status settle_part(brc_context *context, const brc_domain *from, int64_t at, const brc_domain *to, int p,
                              span window)
{
    const int32_t count = brc_ranks_count(), mine = brc_ranks_mine();
    const span comes = common_of(window, settles_on(to, at, mine));
    double *const place = part_of(to, p) + begin_of(to, p, at + comes.first);
    const size_t bytes_here = (size_t)(begin_of(from, p, comes.end) - begin_of(from, p, comes.first)) * sizeof *place;
    if (!from->here) {
        memcpy(place, part_of(from, p) + begin_of(from, p, comes.first), bytes_here);
        return BRC_OK;
    }
    BRC_FREED double *received = NULL;
    const span own = common_of(window, (span){from->home[mine], from->home[mine + 1]});
    BRC_LOCAL(context, count, int64_t, bytes, "cells of ranks");
    BRC_LOCAL(context, count, int64_t, come, "cells of ranks");
    for (int32_t k = 0; k < count; ++k) {
        const span goes = common_of(own, settles_on(to, at, k));
        bytes[k] = (begin_of(from, p, goes.end) - begin_of(from, p, goes.first)) * (int64_t)sizeof *place;
    }
    double *const left = part_of(from, p) + begin_of(from, p, own.first);
    BRC_TRY(brc_ranks_trade(context, left, bytes, (void **)&received, come));
    memcpy(place, received, bytes_here);
    brc_memory_forget(left, (begin_of(from, p, own.end) - begin_of(from, p, own.first)) * (int64_t)sizeof *left);
    return BRC_OK;
}

brc_status brc_domain_settle(brc_context *context, const brc_domain *from, int64_t at, const brc_domain *to)
{
    for (int64_t first = 0; first < from->n_elements; first += WINDOW) {
        const span window = common_of((span){first, first + WINDOW}, (span){0, from->n_elements});
        for (int p = 0; p < BRC_DOMAIN_PARTS; ++p)
            BRC_TRY(settle_part(context, from, at, to, p, window));
    }
    return BRC_OK;
}
