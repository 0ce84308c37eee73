/* Each thread takes runs of elements, asks the Voronoi worker for one cell after the other and writes down what the
 * domain needs: the mass of the cell, its shared faces, its free faces and its corners. */
#include "cells_ranks.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include "polyhedron.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/* One face while its cell is being sorted. */
typedef struct face_key {
    int32_t other, face;
} face_key;

enum { MOST_FACES = 4096 };

/* Seeds that relaxation would move by less stay [of the spacing]. */
#define LEAST_MOVE 1e-5
/* Relaxation moves no seed nearer to a mirrored wall [of the spacing]. */
#define WALL_CLEARANCE 0.02

/* What the threads of one computation share. The first failure, by element, is the one reported. */
typedef struct shared {
    brc_context *context;
    const double *position;
    int64_t n;
    const brc_walls *walls;
    brc_voronoi *voronoi;
    bool open;         /* a cell reaches beyond mirrored walls */
    double *farthest;  /* [n_runs] of a corner from its seed, squared [m^2] */
    double face_limit; /* area below which a face may lie anywhere: rounding of a degenerate corner [m^2] */
    brc_status status;
    int64_t failed;
    const char *reason;
} shared;

static void fail(shared *all, brc_status status, int64_t e, const char *reason)
{
#pragma omp critical(brc_cells)
    if (all->status == BRC_OK || e < all->failed) {
        all->status = status;
        all->failed = e;
        all->reason = reason;
    }
}

/* Make room for `more` items of each array of a group; the memory interface and the context are used by one thread at a
 * time. */
typedef struct column {
    void **data;
    size_t size;
} column;

static bool reserve(shared *all, int64_t have, int64_t *room, int64_t more, int64_t first_guess, int n,
                    const column *columns)
{
    if (have + more <= *room) return true;
    int64_t wanted = *room == 0 ? first_guess : *room + *room / 4;
    if (wanted < have + more) wanted = have + more;
    brc_status status = BRC_OK;
#pragma omp critical(brc_cells_memory)
    for (int k = 0; k < n && status == BRC_OK; ++k)
        status = brc_memory_resize(all->context, columns[k].data, wanted, columns[k].size, "Voronoi cells");
    if (status != BRC_OK) return false;
    *room = wanted;
    return true;
}

static bool reserve_cell(shared *all, brc_cell_run *run, const brc_polyhedron *cell)
{
    const column faces[] = {{(void **)&run->neighbour, sizeof(int32_t)},
                            {(void **)&run->area, sizeof(double)},
                            {(void **)&run->centroid, 3 * sizeof(double)}};
    const column free_faces[] = {{(void **)&run->free_wall, sizeof(int32_t)},
                                 {(void **)&run->free_geometry, 6 * sizeof(double)},
                                 {(void **)&run->free_corners, sizeof(int32_t)}};
    const column polygon[] = {{(void **)&run->polygon, sizeof(int32_t)}};
    const column corners[] = {{(void **)&run->vertex, 3 * sizeof(double)}};
    int64_t n_free = 0, n_polygon = 0;
    for (int32_t f = 0; f < cell->n_faces; ++f)
        if (cell->face_other[f] < 0 || cell->face_other[f] >= all->n) {
            ++n_free;
            n_polygon += cell->face_start[f + 1] - cell->face_start[f];
        }
    return reserve(all, run->n_faces, &run->room_faces, cell->n_faces, 16 * BRC_RUN_LENGTH, 3, faces) &&
           reserve(all, run->n_free, &run->room_free, n_free, BRC_RUN_LENGTH / 4, 3, free_faces) &&
           reserve(all, run->n_polygon, &run->room_polygon, n_polygon, BRC_RUN_LENGTH, 1, polygon) &&
           reserve(all, run->n_vertices, &run->room_vertices, cell->n_vertices, 28 * BRC_RUN_LENGTH, 1, corners);
}

/* A shared face lies on the bisector of the two seeds: its direction comes from them, not from the corners. */
static void add_shared(const shared *all, brc_cell_run *run, const brc_polyhedron *cell, int64_t e, face_key key)
{
    const double *x = all->position + 3 * e, *y = all->position + 3 * (int64_t)key.other;
    const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
    const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    const double normal[3] = {r[0] / length, r[1] / length, r[2] / length};
    double *c = run->centroid + 3 * run->n_faces;
    brc_polyhedron_face(cell, key.face, normal, 0.5 * length, &run->area[run->n_faces], c);
    for (int d = 0; d < 3; ++d)
        c[d] += x[d];
    run->neighbour[run->n_faces++] = key.other;
}

/* Outward normal, distance from the seed and wall of a free face; wall -1: a side of the box that is no wall of the
 * solid. */
static int32_t free_plane(const shared *all, const double x[3], int32_t other, double normal[3], double *height)
{
    const brc_walls *walls = all->walls;
    const int side = -1 - other;
    if (other >= 0) { /* a ghost: the bisector, as with a neighbour */
        const double *y = walls->ghost + 3 * (int64_t)(other - all->n);
        const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
        const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        for (int d = 0; d < 3; ++d)
            normal[d] = r[d] / length;
        *height = 0.5 * length;
        return walls->ghost_wall[other - all->n];
    }
    if (side < 6) {
        const double sign = side % 2 ? 1.0 : -1.0;
        normal[0] = normal[1] = normal[2] = 0.0;
        normal[side / 2] = sign;
        *height = sign * (walls->box[side % 2][side / 2] - x[side / 2]);
        return walls->side_wall[side];
    }
    const int32_t k = BRC_PLANE(other); /* its own inverse */
    memcpy(normal, brc_walls_normal(walls, k), 3 * sizeof *normal);
    *height = brc_walls_depth(walls, k, x);
    return brc_walls_wall(walls, k);
}

/* A free face lies on its wall; false when it lies on a side of the box that is no wall of the shape. */
static bool add_free(const shared *all, brc_cell_run *run, const brc_polyhedron *cell, int64_t e, face_key key)
{
    const double *x = all->position + 3 * e;
    double normal[3], height, area;
    double *s = run->free_geometry + 6 * run->n_free, *c = s + 3;
    const int side = -1 - key.other;
    const int32_t wall = free_plane(all, x, key.other, normal, &height);
    brc_polyhedron_face(cell, key.face, normal, height, &area, c);
    if (wall < 0) return area <= all->face_limit;
    for (int d = 0; d < 3; ++d) {
        s[d] = area * normal[d];
        c[d] += x[d];
    }
    if (side >= 0 && side < 6) c[side / 2] = all->walls->box[side % 2][side / 2]; /* exactly on the wall */
    run->free_wall[run->n_free] = wall;
    const int32_t first = cell->face_start[key.face], n = cell->face_start[key.face + 1] - first;
    memcpy(run->polygon + run->n_polygon, cell->face_vertex + first, (size_t)n * sizeof(int32_t));
    run->free_corners[run->n_free++] = n;
    run->n_polygon += n;
    return true;
}

/* Write down one cell; the reason when it is not a proper one. Free faces: by wall and plane, those to ghosts last. */
static const char *add_cell(shared *all, brc_cells *cells, brc_cell_run *run, const brc_polyhedron *cell, int64_t e)
{
    const double *x = all->position + 3 * e;
    face_key key[MOST_FACES];
    if (cell->n_faces > MOST_FACES) return "its cell has more than 4096 faces";
    for (int32_t f = 0; f < cell->n_faces; ++f) { /* insertion: cells have about fifteen faces */
        const face_key fresh = {cell->face_other[f], f};
        int32_t at = f;
        for (; at > 0 && key[at - 1].other > fresh.other; --at)
            key[at] = key[at - 1];
        key[at] = fresh;
    }
    brc_polyhedron_mass(cell, &cells->volume[e], cells->centroid + 3 * e, cells->inertia + 6 * e);
    if (!(cells->volume[e] > 0.0)) return "its cell has no volume";
    for (int d = 0; d < 3; ++d)
        cells->centroid[3 * e + d] += x[d];
    const int64_t faces_before = run->n_faces, free_before = run->n_free;
    int32_t n_outer = 0, first_ghost = cell->n_faces;
    while (n_outer < cell->n_faces && key[n_outer].other < 0)
        ++n_outer;
    while (first_ghost > 0 && key[first_ghost - 1].other >= all->n)
        --first_ghost;
    for (int32_t f = n_outer; f < first_ghost; ++f)
        add_shared(all, run, cell, e, key[f]);
    for (int32_t f = n_outer - 1; f >= 0; --f) /* downwards: -1 is the first side, -7 the first plane */
        if (!add_free(all, run, cell, e, key[f])) {
            if (!all->walls->mirrored) return "its cell reaches beyond the curved wall";
#pragma omp atomic write
            all->open = true;
        }
    for (int32_t f = first_ghost; f < cell->n_faces; ++f)
        add_free(all, run, cell, e, key[f]);
    cells->n_faces[e] = (int32_t)(run->n_faces - faces_before);
    cells->n_free[e] = (int32_t)(run->n_free - free_before);
    cells->n_corners[e] = cell->n_vertices;
    double *v = run->vertex + 3 * run->n_vertices;
    for (int32_t p = 0; p < cell->n_vertices; ++p) {
        const double *r = cell->vertex + 3 * p;
        all->farthest[e / BRC_RUN_LENGTH] =
            fmax(all->farthest[e / BRC_RUN_LENGTH], r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        for (int d = 0; d < 3; ++d)
            v[3 * p + d] = r[d] + x[d];
    }
    run->n_vertices += cell->n_vertices;
    return NULL;
}

static void compute_run(shared *all, brc_cells *cells, brc_voronoi_worker *worker, int64_t r)
{
    brc_cell_run *run = &cells->run[r];
    const int64_t end = (r + 1) * BRC_RUN_LENGTH < cells->n_elements ? (r + 1) * BRC_RUN_LENGTH : cells->n_elements;
    for (int64_t e = r * BRC_RUN_LENGTH; e < end; ++e) {
        brc_polyhedron cell;
        const brc_status status = brc_voronoi_cell(worker, e, &cell);
        if (status != BRC_OK) {
            fail(all, status, e,
                 status == BRC_NO_MEMORY ? "no memory for a cell in Voro++; use fewer elements"
                                         : "Voro++ gave it no cell");
            return;
        }
        if (!reserve_cell(all, run, &cell)) {
            fail(all, BRC_NO_MEMORY, e, "no memory for the faces; use fewer elements");
            return;
        }
        const char *reason = add_cell(all, cells, run, &cell, e);
        if (reason) {
            fail(all, BRC_INTERNAL, e, reason);
            return;
        }
    }
}

static brc_status allocate(brc_context *context, brc_cells *cells, int64_t n)
{
    cells->n_elements = n;
    cells->n_runs = (n + BRC_RUN_LENGTH - 1) / BRC_RUN_LENGTH;
    BRC_TRY(BRC_ALLOCATE(context, &cells->run, cells->n_runs, "runs of cells"));
    BRC_TRY(BRC_ALLOCATE(context, &cells->n_faces, n, "faces per cell"));
    BRC_TRY(BRC_ALLOCATE(context, &cells->n_free, n, "free faces per cell"));
    BRC_TRY(BRC_ALLOCATE(context, &cells->n_corners, n, "corners per cell"));
    BRC_TRY(BRC_ALLOCATE(context, &cells->volume, n, "cell volumes"));
    if (cells->together == BRC_APART) {
        BRC_TRY(
            brc_memory_allocate_sparse(context, (void **)&cells->centroid, 3 * n, sizeof(double), "cell centroids"));
        return brc_memory_allocate_sparse(context, (void **)&cells->inertia, 6 * n, sizeof(double), "cell inertia");
    }
    BRC_TRY(BRC_ALLOCATE(context, &cells->centroid, 3 * n, "cell centroids"));
    return BRC_ALLOCATE(context, &cells->inertia, 6 * n, "cell inertia");
}

static brc_status report(const shared *all, int64_t n)
{
    if (all->status == BRC_OK) return BRC_OK;
    if (all->status == BRC_NO_MEMORY) return BRC_FAIL(all->context, BRC_NO_MEMORY, "Voronoi cells: %s", all->reason);
    const double *x = all->position + 3 * all->failed;
    return BRC_FAIL(all->context, all->status,
                    "seed %lld of %lld at (%g, %g, %g) m: %s; use another seed of the fill, or a little more spread",
                    (long long)all->failed, (long long)n, x[0], x[1], x[2], all->reason);
}

static int64_t elements_of(brc_run_range range, int64_t n)
{
    const int64_t first = range.first * BRC_RUN_LENGTH, end = range.end * BRC_RUN_LENGTH;
    return (end < n ? end : n) - (first < n ? first : n);
}

brc_status brc_cells_compute(brc_context *context, const double *position, int64_t n, const brc_walls *walls,
                             double spacing, int n_threads, brc_together together, brc_cells *cells)
{
    *cells = (brc_cells){.together = together};
    shared all = {.context = context,
                  .position = position,
                  .n = n,
                  .walls = walls,
                  .status = BRC_OK,
                  .face_limit = 1e-12 * spacing * spacing};
    brc_progress *progress = NULL;
    brc_status status = allocate(context, cells, n);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &all.farthest, cells->n_runs, "farthest corners"));
    BRC_TRY_OR(cleanup, brc_voronoi_create(context, position, n, walls, spacing, &all.voronoi));
    BRC_TRY_OR(cleanup, brc_progress_create(context, &progress, "Voronoi cells", n, "cells", 0.0, NULL));
    const brc_run_range here = brc_runs_here(cells->n_runs, together);
    const int64_t some = elements_of(here, n);
    int64_t done = 0;
#pragma omp parallel num_threads(n_threads)
    {
        brc_voronoi_worker *worker = brc_voronoi_worker_create(all.voronoi);
        if (!worker) fail(&all, BRC_NO_MEMORY, 0, "no memory for the search; use fewer threads");
#pragma omp for schedule(dynamic, 1)
        for (int64_t r = here.first; r < here.end; ++r) {
            if (worker) compute_run(&all, cells, worker, r);
#pragma omp atomic
            done += BRC_RUN_LENGTH;
            if (omp_get_thread_num() == 0) { /* the log belongs to one thread */
                int64_t now;
#pragma omp atomic read
                now = done;
                brc_progress_update(progress, now < some ? now : some);
            }
        }
        brc_voronoi_worker_free(&worker);
    }
    status = report(&all, n);
    if (status == BRC_OK) brc_progress_update(progress, some);
    for (int64_t r = 0; r < cells->n_runs; ++r)
        cells->farthest_corner = fmax(cells->farthest_corner, sqrt(all.farthest[r]));
    if (all.open) cells->farthest_corner = HUGE_VAL;
    brc_voronoi_free(&all.voronoi); /* before more cells come */
    if (together) status = brc_ranks_agree(context, status);
    if (together && status == BRC_OK) status = brc_cells_bring(context, cells);
cleanup:
    brc_progress_finish(&progress);
    brc_voronoi_free(&all.voronoi);
    brc_memory_free(all.farthest);
    if (status != BRC_OK) brc_cells_free(cells);
    return status;
}

/* Turn the move of a seed into its new place. Moves of nearly nothing, far inside a regular grid, are not made: they
 * would split the corners of the cubes into faces as small as Voro++'s tolerance, where it goes wrong. Nor are moves
 * out of a solid whose concave edges cells may overlap. */
static void settle(const brc_walls *walls, const double x[3], double spacing, double move[3])
{
    const double square = move[0] * move[0] + move[1] * move[1] + move[2] * move[2];
    const bool still = square < LEAST_MOVE * LEAST_MOVE * spacing * spacing;
    for (int d = 0; d < 3; ++d)
        move[d] = still ? x[d] : x[d] + move[d];
    if (walls->mirrored && !still && !brc_walls_inside(walls, move, WALL_CLEARANCE * spacing))
        memcpy(move, x, 3 * sizeof *move);
}

brc_status brc_cells_relax(brc_context *context, double *position, int64_t n, const brc_walls *walls, double spacing,
                           int n_threads, bool together, const char *what)
{
    shared all = {.context = context, .position = position, .n = n, .walls = walls, .status = BRC_OK};
    double *fresh = NULL;
    brc_progress *progress = NULL;
    brc_status status = BRC_ALLOCATE(context, &fresh, 3 * n, "relaxed seeds");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, brc_voronoi_create(context, position, n, walls, spacing, &all.voronoi));
    BRC_TRY_OR(cleanup, brc_progress_create(context, &progress, what, n, "cells", 0.0, NULL));
    const brc_run_range here = brc_runs_here((n + BRC_RUN_LENGTH - 1) / BRC_RUN_LENGTH, together);
    const int64_t first = here.first * BRC_RUN_LENGTH, some = elements_of(here, n);
    int64_t done = 0;
#pragma omp parallel num_threads(n_threads)
    {
        brc_voronoi_worker *worker = brc_voronoi_worker_create(all.voronoi);
        if (!worker) fail(&all, BRC_NO_MEMORY, 0, "no memory for the search; use fewer threads");
#pragma omp for schedule(dynamic, BRC_RUN_LENGTH)
        for (int64_t e = first; e < first + some; ++e) {
            brc_polyhedron cell;
            const brc_status cell_status = worker ? brc_voronoi_cell(worker, e, &cell) : BRC_NO_MEMORY;
            if (cell_status != BRC_OK) {
                fail(&all, cell_status, e,
                     cell_status == BRC_NO_MEMORY ? "no memory during relaxation" : "Voro++ gave it no cell");
                continue;
            }
            double volume, inertia[6];
            brc_polyhedron_mass(&cell, &volume, fresh + 3 * e, inertia);
            settle(walls, position + 3 * e, spacing, fresh + 3 * e);
            if (e % BRC_RUN_LENGTH != 0) continue;
#pragma omp atomic
            done += BRC_RUN_LENGTH;
            if (omp_get_thread_num() == 0) {
                int64_t now;
#pragma omp atomic read
                now = done;
                brc_progress_update(progress, now < some ? now : some);
            }
        }
        brc_voronoi_worker_free(&worker);
    }
    status = report(&all, n);
    if (status == BRC_OK) brc_progress_update(progress, some);
    if (together) status = brc_ranks_agree(context, status);
    if (together && status == BRC_OK) status = brc_cells_bring_rows(context, n, 3 * sizeof *fresh, fresh);
    if (status == BRC_OK) memcpy(position, fresh, 3 * (size_t)n * sizeof *fresh);
cleanup:
    brc_progress_finish(&progress);
    brc_voronoi_free(&all.voronoi);
    brc_memory_free(fresh);
    return status;
}

void brc_cell_run_free_faces(brc_cell_run *run)
{
    brc_memory_free(run->neighbour);
    brc_memory_free(run->area);
    brc_memory_free(run->centroid);
    run->neighbour = NULL;
    run->area = run->centroid = NULL;
}

void brc_cell_run_free(brc_cell_run *run)
{
    void *const block[] = {run->free_wall, run->free_geometry, run->free_corners, run->polygon, run->vertex};
    brc_cell_run_free_faces(run);
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
    memset(run, 0, sizeof *run);
}

void brc_cells_free(brc_cells *cells)
{
    if (!cells) return;
    for (int64_t r = 0; cells->run && r < cells->n_runs; ++r)
        brc_cell_run_free(&cells->run[r]);
    void *const block[] = {cells->run,    cells->n_faces,  cells->n_free, cells->n_corners,
                           cells->volume, cells->centroid, cells->inertia};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
    memset(cells, 0, sizeof *cells);
}
