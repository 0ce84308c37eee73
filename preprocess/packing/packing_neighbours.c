/* Which spheres may touch: a grid of cells, and rows of neighbours that stay good while no sphere has moved by half the
 * skin. */
#include "packing_internal.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>

static int32_t cell_along(const brc_pack *pack, double x, int axis)
{
    const double at = (x - pack->bounds[0][axis]) * pack->cells_per_m[axis];
    if (!(at > 0.0)) return 0;
    return at < pack->n_cells[axis] ? (int32_t)at : pack->n_cells[axis] - 1;
}

static int64_t cell_of(const brc_pack *pack, const double *x)
{
    const int64_t slab = (int64_t)cell_along(pack, x[2], 2) * pack->n_cells[1] + cell_along(pack, x[1], 1);
    return slab * pack->n_cells[0] + cell_along(pack, x[0], 0);
}

/* Cells no smaller than the cutoff, and not many more of them than spheres: a thin or hollow solid fills little of its
 * bounding box. */
static int64_t choose_cells(brc_pack *pack, double cutoff)
{
    double side[3], box = 1.0;
    for (int k = 0; k < 3; ++k) {
        side[k] = pack->bounds[1][k] - pack->bounds[0][k];
        box *= side[k];
    }
    const double width = fmax(cutoff, cbrt(box / (2.0 * (double)pack->n)));
    for (int k = 0; k < 3; ++k) {
        pack->n_cells[k] = (int32_t)fmax(1.0, fmin(floor(side[k] / width), 1e9));
        pack->cells_per_m[k] = pack->n_cells[k] / side[k];
    }
    pack->cutoff = cutoff;
    return (int64_t)pack->n_cells[0] * pack->n_cells[1] * pack->n_cells[2];
}

brc_status brc_pack_sort_cells(brc_pack *pack, double cutoff)
{
    const int64_t n_cells = choose_cells(pack, cutoff);
    if (n_cells + 2 > pack->cell_capacity) {
        brc_memory_free(pack->cell_start);
        pack->cell_start = NULL;
        pack->cell_capacity = 0;
        BRC_TRY(BRC_ALLOCATE(pack->context, &pack->cell_start, n_cells + 2, "cells of the packing"));
        pack->cell_capacity = n_cells + 2;
    }
    int32_t *const start =
        pack->cell_start + 1; /* counted one place on: after the filling the starts stand where they belong */
    memset(pack->cell_start, 0, (size_t)(n_cells + 2) * sizeof *pack->cell_start);
    for (int64_t i = 0; i < pack->n; ++i) {
        pack->place[i] = (int32_t)cell_of(pack, pack->sphere[i]);
        start[pack->place[i] + 1]++;
    }
    for (int64_t c = 0; c < n_cells; ++c)
        start[c + 1] += start[c];
    for (int64_t i = 0; i < pack->n; ++i) {
        const int32_t k = start[pack->place[i]]++;
        pack->member[k] = (int32_t)i;
        pack->place[i] = k;
        for (int c = 0; c < 4; ++c)
            pack->in_cells[c * (pack->n + BRC_PACK_PIECE) + k] = pack->sphere[i][c];
    }
    return BRC_OK;
}

int brc_pack_cells_around(const brc_pack *pack, const double *x, int32_t begin[9], int32_t end[9])
{
    int32_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        const int32_t at = cell_along(pack, x[k], k);
        low[k] = at > 0 ? at - 1 : 0;
        high[k] = at + 1 < pack->n_cells[k] ? at + 1 : at;
    }
    int n = 0;
    for (int32_t z = low[2]; z <= high[2]; ++z)
        for (int32_t y = low[1]; y <= high[1]; ++y) {
            const int64_t row = ((int64_t)z * pack->n_cells[1] + y) * pack->n_cells[0];
            begin[n] = pack->cell_start[row + low[0]];
            end[n++] = pack->cell_start[row + high[0] + 1];
        }
    return n;
}

/* Candidates for neighbours of one sphere, from several runs of cells one after the other: a loop over all of them has
 * an end that a processor foresees, loops over runs of three to ten do not. */
typedef struct candidates {
    int32_t n, id[BRC_PACK_CANDIDATES];
    int64_t near[BRC_PACK_CANDIDATES]; /* -1: near enough; else 0 */
} candidates;

/* Appends places first .. end - 1 of the cells, at most BRC_PACK_PIECE. near: to a, by own + their radius. */
BRC_PACK_INLINE void append(const brc_pack *pack, const double *a, double own, int32_t first, int32_t end,
                            candidates *to)
{
    const int64_t stride = pack->n + BRC_PACK_PIECE;
    const double *const x = pack->in_cells + first, *const y = x + stride, *const z = y + stride, *const r = z + stride;
    int64_t *const near = to->near + to->n;
    /* a fixed number: what is beyond the end is written over by the next piece */
    for (int k = 0; k < BRC_PACK_PIECE; ++k) {
        const double dx = x[k] - a[0], dy = y[k] - a[1], dz = z[k] - a[2], reach = own + r[k];
        near[k] = dx * dx + dy * dy + dz * dz < reach * reach ? -1 : 0;
    }
    memcpy(to->id + to->n, pack->member + first, BRC_PACK_PIECE * sizeof *to->id);
    to->n += end - first;
}

/* The near ones, n of them before, into every BRC_PACK_LANES-th entry of the list; past `room` they are only counted.
 * Written whether near or not, and kept if so: most are not, in no order a processor could foresee. Returns how many
 * there are now. */
BRC_PACK_INLINE int64_t keep_near(candidates *from, int32_t *list, int64_t room, int64_t n, int64_t *need)
{
    const int64_t at_most = (n + from->n) * BRC_PACK_LANES;
    const bool fits = at_most <= room;
    *need = at_most > *need ? at_most : *need;
    for (int32_t k = 0; k < from->n && fits; ++k) {
        list[n * BRC_PACK_LANES] = from->id[k];
        n -= from->near[k];
    }
    for (int32_t k = 0; k < from->n && !fits; ++k)
        n -= from->near[k];
    from->n = 0;
    return n;
}

/* The neighbours of sphere i at list[0], list[BRC_PACK_LANES], ...; returns how many. *need: entries of the list up to
 * where candidates are written. */
BRC_PACK_INLINE int64_t list_sphere(const brc_pack *pack, int64_t i, int32_t *list, int64_t room, int64_t *need)
{
    const double *const a = pack->sphere[i];
    const double own = a[3] + pack->skin;
    const int32_t place = pack->place[i];
    int32_t begin[9], end[9];
    const int n_runs = brc_pack_cells_around(pack, a, begin, end);
    candidates found;
    int64_t n = 0;
    found.n = 0;
    for (int run = 0; run < n_runs; ++run)
        for (int32_t first = begin[run]; first < end[run]; first += BRC_PACK_PIECE) {
            const int32_t last = end[run] < first + BRC_PACK_PIECE ? end[run] : first + BRC_PACK_PIECE;
            append(pack, a, own, first, last, &found);
            if (place >= first && place < last) found.near[found.n - last + place] = 0; /* itself */
            if (found.n > BRC_PACK_CANDIDATES - BRC_PACK_PIECE) n = keep_near(&found, list, room, n, need);
        }
    return keep_near(&found, list, room, n, need);
}

/* The neighbours of the spheres of block b, group after group, into its part of the list. Returns the room it takes. */
BRC_PACK_INLINE int64_t list_block(brc_pack *pack, int64_t b)
{
    const int64_t end_of_block = (b + 1) * BRC_PACK_BLOCK < pack->n ? (b + 1) * BRC_PACK_BLOCK : pack->n;
    const int64_t room = pack->block_list[b + 1] - pack->block_list[b];
    int32_t *const list = pack->neighbour + pack->block_list[b];
    int64_t *start = pack->group_start + b * (BRC_PACK_BLOCK / BRC_PACK_LANES + 1), n = 0, need = 0;
    for (int64_t first = b * BRC_PACK_BLOCK; first < end_of_block; first += BRC_PACK_LANES) {
        int64_t own[BRC_PACK_LANES] = {0}, longest = 0, group_need = 0;
        for (int l = 0; l < BRC_PACK_LANES && first + l < end_of_block; ++l) {
            own[l] = list_sphere(pack, first + l, list + n + l, room - n, &group_need);
            longest = own[l] > longest ? own[l] : longest;
        }
        need = n + group_need > need ? n + group_need : need;
        for (int l = 0; l < BRC_PACK_LANES && need <= room; ++l)
            for (int64_t k = own[l]; k < longest; ++k)
                list[n + k * BRC_PACK_LANES + l] = brc_pack_in_lane(pack, first / BRC_PACK_LANES, l);
        *start++ = pack->block_list[b] + n;
        n += longest * BRC_PACK_LANES;
    }
    *start = pack->block_list[b] + n;
    return need;
}

static int64_t list_block_anywhere(brc_pack *pack, int64_t b)
{
    return list_block(pack, b);
}

BRC_PACK_AVX2 static int64_t list_block_avx2(brc_pack *pack, int64_t b)
{
    return list_block(pack, b);
}

/* All blocks; true if every one had room. */
static bool list_blocks(brc_pack *pack)
{
    int64_t (*const list)(brc_pack *, int64_t) = brc_pack_has_avx2() ? list_block_avx2 : list_block_anywhere;
    int64_t n_short = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(pack->n_threads) reduction(+ : n_short)
    for (int64_t b = 0; b < pack->n_blocks; ++b) {
        pack->block_need[b] = list(pack, b);
        n_short += pack->block_need[b] > pack->block_list[b + 1] - pack->block_list[b];
    }
    return n_short == 0;
}

/* Room for what was needed and some more: the next lists will be about as long. */
static brc_status make_room(brc_pack *pack)
{
    for (int64_t b = 0; b < pack->n_blocks; ++b)
        pack->block_list[b + 1] = pack->block_list[b] + pack->block_need[b] + pack->block_need[b] / 16;
    if (pack->block_list[pack->n_blocks] <= pack->list_capacity) return BRC_OK;
    /* freed first, so that both are never held */
    brc_memory_free(pack->neighbour);
    pack->neighbour = NULL;
    pack->list_capacity = 0;
    BRC_TRY(
        BRC_ALLOCATE(pack->context, &pack->neighbour, pack->block_list[pack->n_blocks], "neighbours of the packing"));
    pack->list_capacity = pack->block_list[pack->n_blocks];
    return BRC_OK;
}

int64_t brc_pack_neighbours(const brc_pack *pack, int64_t i, const int32_t **out, int64_t *step)
{
    const int64_t *const part = pack->group_start + i / BRC_PACK_LANES + i / BRC_PACK_BLOCK;
    int64_t n = (part[1] - part[0]) / BRC_PACK_LANES;
    *out = pack->neighbour + part[0] + i % BRC_PACK_LANES;
    *step = BRC_PACK_LANES;
    while (n > 0 && (*out)[(n - 1) * *step] == i)
        --n; /* filled up */
    return n;
}

brc_status brc_pack_list(brc_pack *pack, double skin)
{
    pack->skin = skin;
    BRC_TRY(brc_pack_list_walls(pack));
#pragma omp parallel for schedule(static) num_threads(pack->n_threads)
    for (int64_t i = 0; i < pack->n; ++i)
        memcpy(pack->listed[i], pack->sphere[i], sizeof pack->listed[i]);
    BRC_TRY(brc_pack_sort_cells(pack, 2.0 * pack->largest_radius + skin));
    while (!list_blocks(pack))
        BRC_TRY(make_room(pack));
    return BRC_OK;
}
