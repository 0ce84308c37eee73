/* Runs go from rank to rank a few at a time, so that nobody has them twice. */
#include "cells_ranks.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"

#include <string.h>

enum { AT_ONCE = 16, COUNTS = 4 };

brc_run_range brc_runs_of_rank(int64_t n_runs, int32_t k, int32_t count)
{
    return (brc_run_range){n_runs * k / count, n_runs * (k + 1) / count};
}

brc_run_range brc_runs_here(int64_t n_runs, bool together)
{
    return together ? brc_runs_of_rank(n_runs, brc_ranks_mine(), brc_ranks_count()) : (brc_run_range){0, n_runs};
}

brc_run_range brc_elements_of_rank(int64_t n, int32_t k, int32_t count)
{
    const brc_run_range runs = brc_runs_of_rank((n + BRC_RUN_LENGTH - 1) / BRC_RUN_LENGTH, k, count);
    const int64_t first = runs.first * BRC_RUN_LENGTH, end = runs.end * BRC_RUN_LENGTH;
    return (brc_run_range){first < n ? first : n, end < n ? end : n};
}

brc_status brc_cells_bring_rows(brc_context *context, int64_t n, int64_t bytes, void *rows)
{
    const int32_t count = brc_ranks_count();
    const int64_t mine = brc_elements_of_rank(n, brc_ranks_mine(), count).first;
    BRC_LOCAL(context, count, int64_t, n_of, "rows of ranks");
    for (int32_t k = 0; k < count; ++k) {
        const brc_run_range range = brc_elements_of_rank(n, k, count);
        n_of[k] = range.end - range.first;
    }
    return brc_ranks_gather_all(context, (char *)rows + mine * bytes, bytes, n_of, rows);
}

/* An array of a run. */
typedef struct piece {
    void **data;
    int64_t bytes;
} piece;
enum { PIECES = 8, PIECES_APART = 6 }; /* the first ones come in any case */

static void pieces_of(brc_cell_run *run, piece out[PIECES])
{
    const piece all[PIECES] = {{(void **)&run->neighbour, run->n_faces * (int64_t)sizeof *run->neighbour},
                               {(void **)&run->area, run->n_faces * (int64_t)sizeof *run->area},
                               {(void **)&run->free_wall, run->n_free * (int64_t)sizeof *run->free_wall},
                               {(void **)&run->free_geometry, 6 * run->n_free * (int64_t)sizeof *run->free_geometry},
                               {(void **)&run->free_corners, run->n_free * (int64_t)sizeof *run->free_corners},
                               {(void **)&run->polygon, run->n_polygon * (int64_t)sizeof *run->polygon},
                               {(void **)&run->centroid, 3 * run->n_faces * (int64_t)sizeof *run->centroid},
                               {(void **)&run->vertex, 3 * run->n_vertices * (int64_t)sizeof *run->vertex}};
    memcpy(out, all, sizeof all);
}

/* Whose arrays there are to be: as many as the counts say. */
static brc_status make_room(brc_context *context, const int64_t counts[COUNTS], int n_pieces, brc_cell_run *run)
{
    piece all[PIECES];
    run->n_faces = run->room_faces = counts[0];
    run->n_free = run->room_free = counts[1];
    run->n_polygon = run->room_polygon = counts[2];
    run->n_vertices = run->room_vertices = counts[3];
    pieces_of(run, all);
    for (int k = 0; k < n_pieces; ++k)
        BRC_TRY(brc_memory_allocate(context, all[k].data, all[k].bytes, 1, "Voronoi cells"));
    return BRC_OK;
}

/* Into a message, or out of one. */
static void move(int64_t n, int n_pieces, brc_cell_run *run, bool out, char *message)
{
    for (int64_t r = 0; r < n; ++r) {
        piece all[PIECES];
        pieces_of(&run[r], all);
        for (int k = 0; k < n_pieces; message += all[k++].bytes) {
            if (all[k].bytes == 0) continue;
            if (out)
                memcpy(*all[k].data, message, (size_t)all[k].bytes);
            else
                memcpy(message, *all[k].data, (size_t)all[k].bytes);
        }
    }
}

/* n runs of rank `from`, at most AT_ONCE. */
static brc_status bring_runs(brc_context *context, int32_t from, int64_t n, int n_pieces, brc_cell_run *run)
{
    const bool mine = from == brc_ranks_mine();
    int64_t counts[AT_ONCE][COUNTS] = {{0}}, bytes = 0;
    brc_status status = BRC_OK;
    for (int64_t r = 0; mine && r < n; ++r) {
        const int64_t own[COUNTS] = {run[r].n_faces, run[r].n_free, run[r].n_polygon, run[r].n_vertices};
        memcpy(counts[r], own, sizeof own);
    }
    BRC_TRY(brc_ranks_broadcast(context, from, counts, sizeof counts));
    for (int64_t r = 0; r < n; ++r) {
        piece all[PIECES];
        if (!mine && status == BRC_OK) status = make_room(context, counts[r], n_pieces, &run[r]);
        pieces_of(&run[r], all);
        for (int k = 0; k < n_pieces; ++k)
            bytes += all[k].bytes;
    }
    BRC_FREED char *message = NULL;
    if (status == BRC_OK) status = BRC_ALLOCATE(context, &message, bytes, "Voronoi cells");
    BRC_TRY(brc_ranks_agree(context, status));
    if (mine) move(n, n_pieces, run, false, message);
    BRC_TRY(brc_ranks_broadcast(context, from, message, bytes));
    if (!mine) move(n, n_pieces, run, true, message);
    return BRC_OK;
}

brc_status brc_cells_bring(brc_context *context, brc_cells *cells)
{
    const int64_t n = cells->n_elements;
    const int n_pieces = cells->together == BRC_APART ? PIECES_APART : PIECES;
    const struct {
        int64_t bytes;
        void *rows;
    } all[] = {{sizeof *cells->n_faces, cells->n_faces},       {sizeof *cells->n_free, cells->n_free},
               {sizeof *cells->n_corners, cells->n_corners},   {sizeof *cells->volume, cells->volume},
               {3 * sizeof *cells->centroid, cells->centroid}, {6 * sizeof *cells->inertia, cells->inertia}};
    for (size_t k = 0; k < sizeof all / sizeof *all - (cells->together == BRC_APART ? 2 : 0); ++k)
        BRC_TRY(brc_cells_bring_rows(context, n, all[k].bytes, all[k].rows));
    BRC_TRY(brc_ranks_most(context, 1, &cells->farthest_corner));
    for (int32_t k = 0; k < brc_ranks_count(); ++k) {
        const brc_run_range range = brc_runs_of_rank(cells->n_runs, k, brc_ranks_count());
        for (int64_t r = range.first; r < range.end; r += AT_ONCE)
            BRC_TRY(
                bring_runs(context, k, range.end - r < AT_ONCE ? range.end - r : AT_ONCE, n_pieces, &cells->run[r]));
    }
    return BRC_OK;
}

/* ---- what stays apart ---- */

brc_status brc_cells_mark_apart(brc_context *context, brc_domain *domain)
{
    const int64_t n = domain->n_elements;
    if (!domain->here) BRC_TRY(BRC_ALLOCATE(context, &domain->here, n, "cells of a rank"));
    BRC_TRY(BRC_ALLOCATE(context, &domain->home, brc_ranks_count() + 1, "cells of ranks"));
    for (int32_t k = 0; k < brc_ranks_count(); ++k) {
        const brc_run_range range = brc_elements_of_rank(n, k, brc_ranks_count());
        domain->home[k + 1] = range.end;
        if (k == brc_ranks_mine()) memset(domain->here + range.first, 1, (size_t)(range.end - range.first));
    }
    return BRC_OK;
}

/* Centroids of faces between elements of `from` and larger ones of `to`, in their order: into a message, or out of one.
 * Returns their number; message NULL: that alone. */
static int64_t move_centroids(const brc_domain *d, brc_run_range from, brc_run_range to, bool out, double *message)
{
    int64_t n = 0;
    for (int64_t e = from.first; e < from.end; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const int64_t j = d->neighbour[h];
            if (j < e || j < to.first || j >= to.end) continue;
            double *const here = d->face_centroid + 3 * (out ? d->twin[h] : h);
            if (message) memcpy(out ? here : message + 3 * n, out ? message + 3 * n : here, 3 * sizeof *here);
            ++n;
        }
    return n;
}

brc_status brc_cells_bring_centroids(brc_context *context, brc_domain *d)
{
    const int32_t count = brc_ranks_count(), mine = brc_ranks_mine();
    const brc_run_range own = brc_elements_of_rank(d->n_elements, mine, count);
    BRC_FREED double *send = NULL;
    BRC_FREED double *received = NULL;
    int64_t n = 0;
    BRC_LOCAL(context, count, int64_t, bytes, "faces of ranks");
    BRC_LOCAL(context, count, int64_t, come, "faces of ranks");
    for (int32_t k = mine + 1; k < count; ++k) {
        const int64_t some = move_centroids(d, own, brc_elements_of_rank(d->n_elements, k, count), false, NULL);
        bytes[k] = 3 * some * (int64_t)sizeof *send;
        n += some;
    }
    BRC_TRY(BRC_ALLOCATE(context, &send, 3 * n, "faces of ranks"));
    n = 0;
    for (int32_t k = mine + 1; k < count; ++k)
        n += move_centroids(d, own, brc_elements_of_rank(d->n_elements, k, count), false, send + 3 * n);
    BRC_TRY(brc_ranks_trade(context, send, bytes, (void **)&received, come));
    n = 0;
    for (int32_t k = 0; k < mine; ++k)
        n += move_centroids(d, brc_elements_of_rank(d->n_elements, k, count), own, true, received + 3 * n);
    return BRC_OK;
}

brc_status brc_cells_bring_free_corners(brc_context *context, brc_domain *d)
{
    const int32_t count = brc_ranks_count();
    const int64_t n = d->free_polygon_start[d->n_free_faces];
    int64_t first = 0;
    BRC_LOCAL(context, count, int64_t, n_of, "corners of ranks");
    for (int32_t k = 0; k < count; ++k) {
        const brc_run_range range = brc_elements_of_rank(d->n_elements, k, count);
        const int64_t from = d->free_polygon_start[d->free_start[range.first]];
        n_of[k] = d->free_polygon_start[d->free_start[range.end]] - from;
        if (k == brc_ranks_mine()) first = from;
    }
    double *place = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &place, 3 * n, "corners of free faces"));
    d->free_corner = place;
    for (int64_t k = first; k < first + n_of[brc_ranks_mine()]; ++k)
        memcpy(place + 3 * k, d->vertex + 3 * (int64_t)d->free_polygon[k], 3 * sizeof *place);
    return brc_ranks_gather_all(context, place + 3 * first, 3 * sizeof *place, n_of, place);
}
