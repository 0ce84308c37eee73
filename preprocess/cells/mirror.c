/* Ghosts are found by runs of seeds, each run in order, so that they do not depend on the threads. */
#include "mirror.h"

#include "../../host/base/memory.h"
#include "../point_grid.h"
#include "polyhedron.h"
#include "voronoi.h"

#include <math.h>
#include <omp.h>
#include <string.h>

enum { RUN = 1024, MOST_FEET = 32 };
/* A ghost must be about as far from the solid as the seed is from its foot; nearer ones would cut cells elsewhere.
 * Measured at concave edges: 0.3 makes faces there twice as uneven as 0.6 to 0.8, 0.95 leaves curved edges open by a
 * third more. */
#define CLEARANCE 0.75
/* Ghosts nearer to one another than this [of the reach] are one. */
#define SAME_GHOST 1e-7
/* Seeds deeper than this [of the spacing] hardly have a face on the wall. */
#define DEEPEST_FIT 1.6
/* Lines across a rough wall begin and end so far from it [of its roughness]. */
#define ACROSS_BUMPS 2.0

typedef struct ghost_record {
    double position[3], foot[4], rough;
    int32_t wall, owner;
    bool flat;
} ghost_record;

typedef struct ghost_run {
    ghost_record *ghost;
    int64_t n, room;
    int64_t outside; /* first seed outside the solid, -1: none */
    bool no_memory;
} ghost_run;

static bool reserve(brc_context *context, ghost_run *run)
{
    if (run->n < run->room) return true;
    const int64_t room = run->room > 0 ? 2 * run->room : RUN / 4;
    brc_status status;
#pragma omp critical(brc_mirror)
    status = brc_memory_resize(context, (void **)&run->ghost, room, sizeof *run->ghost, "mirror images of seeds");
    if (status != BRC_OK) return false;
    run->room = room;
    return true;
}

static void mirror_seed(brc_context *context, const brc_walls *walls, const double *x, int32_t owner, ghost_run *run)
{
    const brc_solid *solid = walls->solid;
    brc_foot feet[MOST_FEET];
    const int32_t found = brc_solid_mirrors(solid, x, walls->reach, feet, MOST_FEET),
                  n = found < MOST_FEET ? found : MOST_FEET;
    if (n == 0 && run->outside < 0 && !brc_solid_inside(solid, x, 0.0)) run->outside = owner;
    for (int32_t f = 0; f < n; ++f) {
        if (feet[f].hull) continue;
        if (!reserve(context, run)) {
            run->no_memory = true;
            return;
        }
        ghost_record *ghost = &run->ghost[run->n];
        for (int d = 0; d < 3; ++d)
            ghost->position[d] = x[d] + 2.0 * feet[f].depth * feet[f].normal[d];
        /* among the bumps of a rough wall a ghost may stand anywhere */
        const double clearance = CLEARANCE * feet[f].depth - feet[f].rough;
        if (clearance > 0.0 && !brc_solid_clear(solid, ghost->position, clearance)) continue;
        memcpy(ghost->foot, feet[f].normal, sizeof feet[f].normal);
        ghost->foot[3] = feet[f].depth;
        ghost->rough = feet[f].rough;
        ghost->wall = feet[f].wall;
        ghost->owner = owner;
        ghost->flat = feet[f].plane;
        ++run->n;
    }
}

/* Drop every ghost that is the same point as an earlier one: on a regular grid two walls at right angles mirror two
 * seeds to one. */
static brc_status drop_doubles(brc_context *context, brc_walls *walls)
{
    const double same = SAME_GHOST * walls->reach;
    brc_point_grid *kept = NULL;
    const int64_t n = walls->n_ghosts;
    BRC_TRY(brc_point_grid_create(context, (const double(*)[3])walls->box, 0.5 * walls->reach, n, &kept));
    for (int64_t g = 0; g < n; ++g) {
        if (brc_point_grid_crowded(kept, walls->ghost + 3 * g, same))
            walls->ghost_owner[g] = -1;
        else
            brc_point_grid_add(kept, walls->ghost + 3 * g);
    }
    brc_point_grid_free(&kept);
    int64_t to = 0;
    for (int64_t g = 0; g < n; ++g) {
        if (walls->ghost_owner[g] < 0) continue;
        memmove(walls->ghost + 3 * to, walls->ghost + 3 * g, 3 * sizeof(double));
        memmove(walls->ghost_foot + 4 * to, walls->ghost_foot + 4 * g, 4 * sizeof(double));
        walls->ghost_wall[to] = walls->ghost_wall[g];
        walls->ghost_flat[to] = walls->ghost_flat[g];
        walls->ghost_rough[to] = walls->ghost_rough[g];
        walls->ghost_owner[to++] = walls->ghost_owner[g];
    }
    walls->n_ghosts = to;
    return BRC_OK;
}

static brc_status take_over(brc_context *context, const ghost_run *run, int64_t n_runs, brc_walls *walls)
{
    int64_t n = 0;
    for (int64_t r = 0; r < n_runs; ++r)
        n += run[r].n;
    void **const old[] = {(void **)&walls->ghost,      (void **)&walls->ghost_wall,  (void **)&walls->ghost_owner,
                          (void **)&walls->ghost_foot, (void **)&walls->ghost_rough, (void **)&walls->ghost_flat};
    for (size_t k = 0; k < sizeof old / sizeof *old; ++k) {
        brc_memory_free(*old[k]);
        *old[k] = NULL;
    }
    walls->n_ghosts = 0;
    BRC_TRY(BRC_ALLOCATE(context, &walls->ghost, 3 * n, "mirror images of seeds"));
    BRC_TRY(BRC_ALLOCATE(context, &walls->ghost_wall, n, "mirror images of seeds"));
    BRC_TRY(BRC_ALLOCATE(context, &walls->ghost_owner, n, "mirror images of seeds"));
    BRC_TRY(BRC_ALLOCATE(context, &walls->ghost_foot, 4 * n, "mirror images of seeds"));
    BRC_TRY(BRC_ALLOCATE(context, &walls->ghost_rough, n, "mirror images of seeds"));
    BRC_TRY(BRC_ALLOCATE(context, &walls->ghost_flat, n, "mirror images of seeds"));
    walls->n_ghosts = n;
    for (int64_t r = 0, g = 0; r < n_runs; ++r)
        for (int64_t k = 0; k < run[r].n; ++k, ++g) {
            const ghost_record *from = &run[r].ghost[k];
            memcpy(walls->ghost + 3 * g, from->position, sizeof from->position);
            memcpy(walls->ghost_foot + 4 * g, from->foot, sizeof from->foot);
            walls->ghost_wall[g] = from->wall;
            walls->ghost_owner[g] = from->owner;
            walls->ghost_flat[g] = from->flat;
            walls->ghost_rough[g] = from->rough;
        }
    return drop_doubles(context, walls);
}

brc_status brc_mirror_make(brc_context *context, const double *position, int64_t n, double reach, int n_threads,
                           brc_walls *walls)
{
    if (!walls->mirrored) return BRC_OK;
    ghost_run *run = NULL;
    const int64_t n_runs = (n + RUN - 1) / RUN;
    brc_walls_set_reach(walls, reach);
    brc_status status = BRC_ALLOCATE(context, &run, n_runs, "mirror images of seeds");
    if (status != BRC_OK) goto cleanup;
#pragma omp parallel for schedule(dynamic, 1) num_threads(n_threads)
    for (int64_t r = 0; r < n_runs; ++r) {
        run[r].outside = -1;
        for (int64_t e = r * RUN; e < n && e < (r + 1) * RUN && !run[r].no_memory; ++e)
            mirror_seed(context, walls, position + 3 * e, (int32_t)e, &run[r]);
    }
    for (int64_t r = 0; r < n_runs; ++r) {
        const double *x = run[r].outside < 0 ? NULL : position + 3 * run[r].outside;
        if (run[r].no_memory)
            status = BRC_NO_MEMORY;
        else if (x)
            status = BRC_FAIL(context, BRC_BAD_INPUT, "seed %lld at (%g, %g, %g) m lies outside the shape",
                              (long long)run[r].outside, x[0], x[1], x[2]);
        if (status != BRC_OK) goto cleanup;
    }
    status = take_over(context, run, n_runs, walls);
cleanup:
    for (int64_t r = 0; run && r < n_runs; ++r)
        brc_memory_free(run[r].ghost);
    brc_memory_free(run);
    return status;
}

/* A wall at a ghost: what heights above it mean. */
typedef struct wall_at {
    const brc_solid *solid;
    const double *normal; /* outward */
    double rough;         /* [m] */
} wall_at;

/* Height of x above the wall. On a rough one that of the surface's mean: what the line across it has of the solid
 * decides, so that the volume is right. */
static double height_of(const wall_at *wall, const double x[3])
{
    if (!(wall->rough > 0.0)) return -brc_solid_depth(wall->solid, x);
    double below[3], above[3];
    const double reach = ACROSS_BUMPS * wall->rough;
    for (int d = 0; d < 3; ++d) {
        below[d] = x[d] - reach * wall->normal[d];
        above[d] = x[d] + reach * wall->normal[d];
    }
    return brc_solid_outside(wall->solid, below, above) - reach;
}

/* Mean height of a face of the cell above the wall: second-order quadrature on the triangles around its middle. */
static double mean_height(const wall_at *wall, const brc_polyhedron *cell, int32_t face, const double x[3])
{
    const int32_t *corner = cell->face_vertex + cell->face_start[face];
    const int32_t n = cell->face_start[face + 1] - cell->face_start[face];
    double middle[3] = {0.0, 0.0, 0.0}, sum = 0.0, total = 0.0;
    for (int32_t k = 0; k < n; ++k)
        for (int d = 0; d < 3; ++d)
            middle[d] += cell->vertex[3 * corner[k] + d] / n;
    double last[3], first_spoke = 0.0, spoke = 0.0;
    for (int d = 0; d < 3; ++d)
        last[d] = x[d] + 0.5 * (middle[d] + cell->vertex[3 * corner[0] + d]);
    first_spoke = spoke = height_of(wall, last);
    for (int32_t k = 0; k < n; ++k) {
        const double *p = cell->vertex + 3 * corner[k], *q = cell->vertex + 3 * corner[(k + 1) % n];
        double a[3], b[3], c[3], rim[3], half[3];
        for (int d = 0; d < 3; ++d) {
            a[d] = p[d] - middle[d];
            b[d] = q[d] - middle[d];
            rim[d] = x[d] + 0.5 * (p[d] + q[d]);
            half[d] = x[d] + 0.5 * (middle[d] + q[d]);
        }
        for (int d = 0; d < 3; ++d)
            c[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
        const double area = 0.5 * sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        const double next = k + 1 < n ? height_of(wall, half) : first_spoke;
        sum += area * (spoke + next + height_of(wall, rim)) / 3.0;
        total += area;
        spoke = next;
    }
    return total > 0.0 ? sum / total : 0.0;
}

/* Fit the ghosts first .. last of one seed. */
static brc_status fit_seed(const brc_walls *walls, brc_voronoi_worker *worker, const double *x, int64_t n,
                           int64_t first, int64_t last, double *shift)
{
    brc_polyhedron cell;
    BRC_TRY(brc_voronoi_cell(worker, walls->ghost_owner[first], &cell));
    for (int32_t f = 0; f < cell.n_faces; ++f) {
        const int64_t g = cell.face_other[f] - n;
        if (cell.face_other[f] < 0 || g < first || g >= last || walls->ghost_flat[g]) continue;
        const wall_at wall = {
            .solid = walls->solid, .normal = walls->ghost_foot + 4 * g, .rough = walls->ghost_rough[g]};
        shift[g] = mean_height(&wall, &cell, f, x);
    }
    return BRC_OK;
}

brc_status brc_mirror_fit(brc_context *context, const double *position, int64_t n, double spacing, int n_threads,
                          brc_walls *walls)
{
    double *shift = NULL;
    brc_voronoi *voronoi = NULL;
    int32_t failed = INT32_MAX; /* the first seed whose cell could not be made, and why */
    brc_status status = BRC_OK, reason = BRC_OK;
    bool curved = false;
    for (int64_t g = 0; g < walls->n_ghosts; ++g)
        curved = curved || !walls->ghost_flat[g];
    if (!curved) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &shift, walls->n_ghosts, "shifts of mirror images"));
    BRC_TRY_OR(cleanup, brc_voronoi_create(context, position, n, walls, spacing, &voronoi));
#pragma omp parallel num_threads(n_threads)
    {
        brc_voronoi_worker *worker = brc_voronoi_worker_create(voronoi);
#pragma omp for schedule(dynamic, 256)
        for (int64_t g = 0; g < walls->n_ghosts; ++g) {
            const int32_t owner = walls->ghost_owner[g];
            if (g > 0 && walls->ghost_owner[g - 1] == owner) continue; /* with the owner's first ghost */
            int64_t last = g;
            bool wanted = false;
            for (; last < walls->n_ghosts && walls->ghost_owner[last] == owner; ++last)
                wanted =
                    wanted || (!walls->ghost_flat[last] && walls->ghost_foot[4 * last + 3] < DEEPEST_FIT * spacing);
            const brc_status seed_status =
                !wanted   ? BRC_OK
                : !worker ? BRC_NO_MEMORY
                          : fit_seed(walls, worker, position + 3 * (int64_t)owner, n, g, last, shift);
            if (seed_status == BRC_OK) continue;
#pragma omp critical(brc_mirror)
            if (owner < failed) {
                failed = owner;
                reason = seed_status;
            }
        }
        brc_voronoi_worker_free(&worker);
    }
    if (reason == BRC_NO_MEMORY) {
        status = BRC_FAIL(
            context, reason,
            "mirror images: no memory for the cells of %lld seeds and their %lld images; use fewer elements or threads",
            (long long)n, (long long)walls->n_ghosts);
        goto cleanup;
    }
    if (reason != BRC_OK) {
        const double *x = position + 3 * (int64_t)failed;
        status = BRC_FAIL(context, reason,
                          "seed %d of %lld at (%g, %g, %g) m, which is mirrored at a wall: Voro++ gave it no cell; use "
                          "another seed of the fill, or a little more spread",
                          failed, (long long)n, x[0], x[1], x[2]);
        goto cleanup;
    }
    for (int64_t g = 0; g < walls->n_ghosts; ++g) {
        double *foot = walls->ghost_foot + 4 * g;
        foot[3] -= fmin(shift[g], 0.5 * foot[3]); /* a seed stays inside its wall */
        const double *x = position + 3 * (int64_t)walls->ghost_owner[g];
        if (shift[g] != 0.0)
            for (int d = 0; d < 3; ++d)
                walls->ghost[3 * g + d] = x[d] + 2.0 * foot[3] * foot[d];
    }
cleanup:
    brc_voronoi_free(&voronoi);
    brc_memory_free(shift);
    return status;
}
