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
    for (int64_t i = 0; i < pack->n; ++i)
        start[cell_of(pack, pack->sphere[i]) + 1]++;
    for (int64_t c = 0; c < n_cells; ++c)
        start[c + 1] += start[c];
    for (int64_t i = 0; i < pack->n; ++i)
        pack->member[start[cell_of(pack, pack->sphere[i])]++] = (int32_t)i;
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

/* The neighbours of the spheres of block b, row after row, into its part of the list; past its end they are only
 * counted. Returns the room it takes. */
static int64_t list_block(brc_pack *pack, int64_t b)
{
    const int64_t first = b * BRC_PACK_BLOCK,
                  end_of_block = first + BRC_PACK_BLOCK < pack->n ? first + BRC_PACK_BLOCK : pack->n;
    const int64_t room = pack->block_list[b + 1] - pack->block_list[b];
    int32_t *const list = pack->neighbour + pack->block_list[b];
    int64_t n = 0, need = 0;
    for (int64_t i = first; i < end_of_block; ++i) {
        const double *const a = pack->sphere[i];
        const double own = a[3] + pack->skin;
        int32_t begin[9], end[9];
        const int n_runs = brc_pack_cells_around(pack, a, begin, end);
        pack->row_start[i + b] = pack->block_list[b] + n;
        for (int run = 0; run < n_runs; ++run) {
            /* written whether a neighbour or not, and kept if so: most candidates are none, in no order a processor
             * could foresee */
            const int64_t at_most = n + (end[run] - begin[run]);
            const bool fits = at_most <= room;
            need = at_most > need ? at_most : need;
            for (int32_t k = begin[run]; k < end[run]; ++k) {
                const int32_t j = pack->member[k];
                const double *const c = pack->sphere[j];
                const double x = c[0] - a[0], y = c[1] - a[1], z = c[2] - a[2], reach = own + c[3];
                if (fits) list[n] = j;
                n += (x * x + y * y + z * z < reach * reach) & (j != i);
            }
        }
    }
    pack->row_start[end_of_block + b] = pack->block_list[b] + n;
    return need;
}

/* All blocks; true if every one had room. */
static bool list_blocks(brc_pack *pack)
{
    int64_t n_short = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(pack->n_threads) reduction(+ : n_short)
    for (int64_t b = 0; b < pack->n_blocks; ++b) {
        pack->block_need[b] = list_block(pack, b);
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

int64_t brc_pack_neighbours(const brc_pack *pack, int64_t i, const int32_t **out)
{
    const int64_t *const row = pack->row_start + i + i / BRC_PACK_BLOCK;
    *out = pack->neighbour + row[0];
    return row[1] - row[0];
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
