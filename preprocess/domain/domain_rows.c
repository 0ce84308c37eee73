/* Faces come window by window of ids, so that messages stay small beside what they fill: those that want some say
 * which, those whose home they are answer. */
#include "domain_rows.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WINDOW = 1 << 12, FACE = 6 };

bool brc_domain_mine(const brc_domain *d, int64_t e)
{
    const int32_t mine = brc_ranks_mine();
    return !d->here || (e >= d->home[mine] && e < d->home[mine + 1]);
}

/* Whose home has element e. */
static int32_t rank_of(const brc_domain *d, int64_t e)
{
    int32_t low = 0, high = brc_ranks_count() - 1;
    while (low < high) {
        const int32_t middle = (low + high) / 2;
        if (e < d->home[middle + 1])
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* ---- a cell as a row of numbers ---- */

static int64_t numbers_of(const brc_domain *d, int64_t e)
{
    return FACE * (d->row_start[e + 1] - d->row_start[e]);
}

/* Into a message, or out of one; returns where the next begins. */
static double *move(const brc_domain *d, int64_t e, bool out, double *message)
{
    const int64_t h = d->row_start[e], n = 3 * (d->row_start[e + 1] - h);
    double *const piece[] = {d->area_vector + 3 * h, d->face_centroid + 3 * h};
    for (int k = 0; k < 2 && n > 0; ++k, message += n)
        memcpy(out ? piece[k] : message, out ? message : piece[k], (size_t)n * sizeof *message);
    return message;
}

/* Pages that only cells [first, end) have something in. */
static void forget(const brc_domain *d, int64_t first, int64_t end)
{
    const int64_t h = 3 * d->row_start[first], bytes = (3 * d->row_start[end] - h) * (int64_t)sizeof(double);
    brc_memory_forget(d->area_vector + h, bytes);
    brc_memory_forget(d->face_centroid + h, bytes);
}

/* ---- a window ---- */

/* Ids that this rank asks each other one for, one after another. */
static void list_wanted(const brc_domain *d, const uint8_t *wanted, int64_t first, int64_t end, int64_t *place,
                        int32_t *id)
{
    for (int64_t e = first; e < end; ++e)
        if (wanted[e] && !d->here[e]) {
            const int32_t from = rank_of(d, e);
            if (id) id[place[from]] = (int32_t)e;
            ++place[from];
        }
}

/* The rows of ids, some from each rank. bytes: of ids there, of rows after this. */
static brc_status pack(brc_context *context, const brc_domain *d, const int32_t *id, int64_t *bytes, double **out)
{
    const int32_t count = brc_ranks_count();
    int64_t n = 0;
    const int32_t *at = id;
    for (int32_t k = 0; k < count; ++k) {
        const int64_t n_ids = bytes[k] / (int64_t)sizeof *id;
        int64_t numbers = 0;
        for (int64_t i = 0; i < n_ids; ++i)
            numbers += numbers_of(d, at[i]);
        at += n_ids;
        n += numbers;
        bytes[k] = numbers * (int64_t)sizeof **out;
    }
    BRC_TRY(BRC_ALLOCATE(context, out, n, "faces of ranks"));
    double *to = *out;
    for (const int32_t *one = id; one < at; ++one)
        to = move(d, *one, false, to);
    return BRC_OK;
}

static brc_status bring_window(brc_context *context, const brc_domain *d, const uint8_t *wanted, int64_t first,
                               int64_t end)
{
    const int32_t count = brc_ranks_count();
    BRC_FREED int32_t *asked = NULL;
    BRC_FREED double *rows = NULL;
    BRC_FREED double *received = NULL;
    int64_t n = 0;
    BRC_LOCAL(context, count, int64_t, n_of, "faces of ranks");
    BRC_LOCAL(context, count, int64_t, bytes, "faces of ranks");
    BRC_LOCAL(context, count, int64_t, place, "faces of ranks");
    list_wanted(d, wanted, first, end, n_of, NULL);
    for (int32_t k = 0; k < count; ++k) {
        place[k] = n;
        n += n_of[k];
        n_of[k] *= (int64_t)sizeof *asked;
    }
    BRC_LOCAL(context, n, int32_t, id, "faces of ranks");
    list_wanted(d, wanted, first, end, place, id);
    BRC_TRY(brc_ranks_trade(context, id, n_of, (void **)&asked, bytes));
    BRC_TRY(pack(context, d, asked, bytes, &rows));
    BRC_TRY(brc_ranks_trade(context, rows, bytes, (void **)&received, n_of));
    double *from = received;
    for (int64_t k = 0; k < n; ++k) {
        from = move(d, id[k], true, from);
        d->here[id[k]] = 1;
    }
    return BRC_OK;
}

brc_status brc_domain_bring(brc_context *context, const brc_domain *d, const uint8_t *wanted)
{
    for (int64_t first = 0; first < d->n_elements; first += WINDOW)
        BRC_TRY(
            bring_window(context, d, wanted, first, first + WINDOW < d->n_elements ? first + WINDOW : d->n_elements));
    return BRC_OK;
}

void brc_domain_keep_home(const brc_domain *d)
{
    const int64_t first = d->home[brc_ranks_mine()], end = d->home[brc_ranks_mine() + 1];
    memset(d->here, 0, (size_t)first);
    memset(d->here + end, 0, (size_t)(d->n_elements - end));
    forget(d, 0, first);
    forget(d, end, d->n_elements);
}

static brc_status bring_all(brc_context *context, const brc_domain *d, bool mine)
{
    BRC_LOCAL(context, d->n_elements, uint8_t, wanted, "faces of a rank");
    memset(wanted, mine, (size_t)d->n_elements);
    return brc_domain_bring(context, d, wanted);
}

/* ---- corners ---- */

static int64_t corners_before(const brc_domain *d, int32_t rank)
{
    return d->vertex_start[d->home[rank]];
}

/* To rank 0. */
static brc_status bring_corners(brc_context *context, const brc_domain *d)
{
    const int32_t count = brc_ranks_count(), mine = brc_ranks_mine();
    const int64_t place = 3 * (int64_t)sizeof *d->vertex, first = corners_before(d, mine);
    BRC_LOCAL(context, count, int64_t, bytes, "corners of ranks");
    for (int32_t k = 1; k < count; ++k) /* those of rank 0 are where they stay */
        bytes[k] = place * (corners_before(d, k + 1) - corners_before(d, k));
    BRC_TRY(brc_ranks_gather_first(context, d->vertex + 3 * first, bytes, d->vertex + 3 * corners_before(d, 1)));
    if (mine > 0) brc_memory_forget(d->vertex + 3 * first, bytes[mine]);
    return BRC_OK;
}

brc_status brc_domain_bring_to_first(brc_context *context, const brc_domain *d)
{
    if (d->home[1] == d->n_elements) return BRC_OK;
    BRC_TRY(bring_all(context, d, brc_ranks_mine() == 0));
    BRC_TRY(bring_corners(context, d));
    for (int32_t k = 1; k <= brc_ranks_count(); ++k)
        d->home[k] = d->n_elements;
    brc_domain_keep_home(d);
    return BRC_OK;
}

brc_status brc_domain_bring_whole(brc_context *context, brc_domain *d)
{
    const int32_t count = brc_ranks_count();
    BRC_TRY(bring_all(context, d, true));
    BRC_LOCAL(context, count, int64_t, n_of, "corners of ranks");
    for (int32_t k = 0; k < count; ++k)
        n_of[k] = corners_before(d, k + 1) - corners_before(d, k);
    BRC_TRY(brc_ranks_gather_all(context, d->vertex + 3 * corners_before(d, brc_ranks_mine()), 3 * sizeof *d->vertex,
                                 n_of, d->vertex));
    BRC_TRY(brc_domain_elements(context, d, 3, d->centroid));
    BRC_TRY(brc_domain_elements(context, d, 6, d->inertia));
    void **const block[] = {(void **)&d->here, (void **)&d->home, (void **)&d->free_corner};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k) {
        brc_memory_free(*block[k]);
        *block[k] = NULL;
    }
    return BRC_OK;
}

/* ---- how much ---- */

typedef struct amount {
    char node[128];
    bool is_first;
    double common, own; /* bytes that the ranks of a machine have once, and those of this rank */
} amount;

static brc_status add_block(void *self, void **block)
{
    if (*block) *(double *)self += (double)brc_memory_block_bytes(*block);
    return BRC_OK;
}

brc_status brc_domain_tell(brc_context *context, brc_domain *d)
{
    const brc_ranks_place here = brc_ranks_here();
    void *const alone[] = {d->here, d->home}, **part[BRC_DOMAIN_PARTS];
    double whole = 0, most = 0;
    amount own = {.is_first = here.local == 0};
    BRC_LOCAL(context, here.count, amount, all, "memory of ranks");
    BRC_LOCAL(context, here.count, int64_t, ones, "memory of ranks");
    BRC_TRY(brc_domain_each_block(d, false, add_block, &whole));
    own.common = whole;
    brc_domain_parts(d, part);
    for (int k = 0; k < BRC_DOMAIN_PARTS; ++k) {
        own.common -= (double)brc_memory_block_bytes(*part[k]);
        own.own += (double)brc_memory_sparse_resident(*part[k]);
    }
    for (int k = 0; k < 2; ++k) {
        own.common -= (double)brc_memory_block_bytes(alone[k]);
        own.own += (double)brc_memory_block_bytes(alone[k]);
    }
    snprintf(own.node, sizeof own.node, "%s", here.node);
    for (int32_t k = 0; k < here.count; ++k)
        ones[k] = 1;
    BRC_TRY(brc_ranks_gather_all(context, &own, sizeof own, ones, all));
    for (int32_t k = 0; k < here.count; ++k) {
        double sum = all[k].common;
        for (int32_t other = 0; other < here.count && all[k].is_first; ++other)
            if (strcmp(all[other].node, all[k].node) == 0) sum += all[other].own;
        if (all[k].is_first) most = fmax(most, sum);
    }
    brc_log(context, BRC_LOG_INFO, "of a domain of %.4g MB a machine has %.4g MB at most, %.4g MB of them of all cells",
            1e-6 * whole, 1e-6 * most, 1e-6 * own.common);
    return BRC_OK;
}

/* ---- faces ---- */

static int32_t rank_of_face(const brc_domain *d, int64_t half_edge)
{
    return rank_of(d, d->neighbour[d->twin[half_edge]]);
}

brc_status brc_domain_faces(brc_context *context, const brc_domain *d, int64_t n, const int32_t *half_edge, double *out)
{
    const int32_t count = brc_ranks_count();
    if (!d->here) {
        for (int64_t k = 0; k < n; ++k) {
            memcpy(out + FACE * k, d->area_vector + 3 * (int64_t)half_edge[k], 3 * sizeof *out);
            memcpy(out + FACE * k + 3, d->face_centroid + 3 * (int64_t)half_edge[k], 3 * sizeof *out);
        }
        return BRC_OK;
    }
    BRC_LOCAL(context, count, int64_t, n_of, "faces of ranks");
    BRC_LOCAL(context, count + 1, int64_t, place, "faces of ranks");
    BRC_LOCAL(context, FACE * n, double, all, "faces of ranks");
    for (int64_t k = 0; k < n; ++k)
        ++n_of[rank_of_face(d, half_edge[k])];
    for (int32_t k = 0; k < count; ++k)
        place[k + 1] = place[k] + n_of[k];
    double *const mine = all + FACE * place[brc_ranks_mine()];
    int64_t some = 0;
    for (int64_t k = 0; k < n; ++k) {
        const int64_t h = half_edge[k];
        if (rank_of_face(d, h) != brc_ranks_mine()) continue;
        memcpy(mine + FACE * some, d->area_vector + 3 * h, 3 * sizeof *out);
        memcpy(mine + FACE * some++ + 3, d->face_centroid + 3 * h, 3 * sizeof *out);
    }
    BRC_TRY(brc_ranks_gather_all(context, mine, FACE * sizeof *out, n_of, all));
    for (int64_t k = 0; k < n; ++k) {
        const int32_t from = rank_of_face(d, half_edge[k]);
        memcpy(out + FACE * k, all + FACE * place[from]++, FACE * sizeof *out);
    }
    return BRC_OK;
}

brc_status brc_domain_elements(brc_context *context, const brc_domain *d, int64_t width, double *value)
{
    const int32_t count = brc_ranks_count();
    BRC_LOCAL(context, count, int64_t, n_of, "numbers of ranks");
    for (int32_t k = 0; k < count; ++k)
        n_of[k] = d->home[k + 1] - d->home[k];
    return brc_ranks_gather_all(context, value + width * d->home[brc_ranks_mine()], width * (int64_t)sizeof *value,
                                n_of, value);
}

static int32_t rank_of_bond(const brc_domain *d, int64_t bond)
{
    return rank_of_face(d, d->bond_half_edge[bond]);
}

brc_status brc_domain_bonds(brc_context *context, const brc_domain *d, double *value)
{
    const int32_t count = brc_ranks_count(), mine = brc_ranks_mine();
    BRC_LOCAL(context, count, int64_t, n_of, "bonds of ranks");
    BRC_LOCAL(context, count + 1, int64_t, place, "bonds of ranks");
    BRC_LOCAL(context, d->n_bonds, double, all, "bonds of ranks");
    for (int64_t b = 0; b < d->n_bonds; ++b)
        ++n_of[rank_of_bond(d, b)];
    for (int32_t k = 0; k < count; ++k)
        place[k + 1] = place[k] + n_of[k];
    for (int64_t b = 0, at = place[mine]; b < d->n_bonds; ++b)
        if (rank_of_bond(d, b) == mine) all[at++] = value[b];
    BRC_TRY(brc_ranks_gather_all(context, all + place[mine], sizeof *all, n_of, all));
    for (int64_t b = 0; b < d->n_bonds; ++b)
        value[b] = all[place[rank_of_bond(d, b)]++];
    return BRC_OK;
}

void brc_domain_parts(brc_domain *d, void **out[BRC_DOMAIN_PARTS])
{
    void **const all[BRC_DOMAIN_PARTS] = {(void **)&d->area_vector, (void **)&d->face_centroid, (void **)&d->vertex,
                                          (void **)&d->centroid, (void **)&d->inertia};
    memcpy(out, all, sizeof all);
}

brc_status brc_domain_make_room(brc_context *context, brc_domain *d)
{
    const int64_t n = d->n_elements, h = 3 * d->n_half_edges,
                  numbers[BRC_DOMAIN_PARTS] = {h, h, 3 * d->vertex_start[n], 3 * n, 6 * n};
    void **part[BRC_DOMAIN_PARTS];
    brc_domain_parts(d, part);
    BRC_TRY(BRC_ALLOCATE(context, &d->here, n, "faces of a rank"));
    for (int k = 0; k < BRC_DOMAIN_PARTS; ++k)
        BRC_TRY(brc_memory_allocate_sparse(context, part[k], numbers[k], sizeof(double), "cells of a rank"));
    return BRC_OK;
}
