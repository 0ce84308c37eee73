/* The way from a request to a domain, in the order of the steps: check, solid and walls, seeds, relaxation, cells and
 * half-edges (or spheres and beams), pose, cracks, regions, grains, sets, quality. */
#include "build.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../packing/beams.h"
#include "../../host/base/ranks.h"
#include "../cells/cells_ranks.h"
#include "../cells/conform.h"
#include "cracks.h"
#include "describe.h"
#include "../cells/edges.h"
#include "estimate.h"
#include "../shapes/features.h"
#include "grains.h"
#include "../cells/halfedge.h"
#include "../packing/packing.h"
#include "../points.h"
#include "pose.h"
#include "quality.h"
#include "../cells/seeds.h"
#include "sets.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Faces this small carry nothing, and dropping one leaves its two cells open by less than the patch test notices. */
#define DEFAULT_TINY_FACE 1e-12
/* Cells whose volumes sum to something this far from the shape's are refused even if nothing else is asked for. */
#define WORST_VOLUME_ERROR 0.05
/* And beyond this it is worth a warning: smooth shapes keep below it at 10 000 cells (docs/reference/domain.md). */
#define DOUBTFUL_VOLUME_ERROR 0.005
/* Where walls are exact, volumes sum to the shape's but for rounding; what is more was lost. */
#define LOST_VOLUME 1e-8

/* What building holds besides the domain. */
typedef struct work {
    const brc_build_request *request;
    int n_threads;
    brc_solid *solid;
    brc_walls walls;
    brc_grid grid;
    double *position, *radius; /* of the seeds, or spheres; radius NULL: seeds only */
    int64_t n;
    double spacing; /* of the seeds [m] */
} work;

static void work_free(work *w)
{
    brc_memory_free(w->position);
    brc_memory_free(w->radius);
    brc_walls_free(&w->walls);
    brc_solid_free(&w->solid);
}

static brc_status check_request(brc_context *context, const brc_build_request *request)
{
    BRC_TRY(brc_fill_check(context, &request->fill));
    for (int k = 0; k < 3; ++k)
        if (!isfinite(request->translation[k]) || !isfinite(request->rotation[k]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "pose: translation and rotation must be finite");
    if (!(request->tiny_face_threshold >= 0.0 && request->tiny_face_threshold < 1e-3))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "tiny faces: the threshold %g of the mean area must be 0 (default) or below 1e-3",
                        request->tiny_face_threshold);
    if (request->n_threads < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%d threads, must be 0 (default) or more", request->n_threads);
    if (!(request->beams >= 0.0 && isfinite(request->beams)))
        return BRC_FAIL(context, BRC_BAD_INPUT, "beams: the coordination number is %g, must be 0 (cells) or more",
                        request->beams);
    if (request->beams > 0.0 && request->fill.kind == BRC_FILL_NOISY_GRID)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "beams join spheres, and a noisy grid has none: fill with a packing, or with points that have radii");
    if (request->beams > 0.0 && request->fill.lloyd_sweeps > 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: Lloyd sweeps even out cells; spheres have none, leave them out");
    return brc_cracks_check(context, request->n_cracks, request->cracks);
}

/* The points of the request, as a file would give them. */
static brc_status take_points(brc_context *context, const brc_build_request *request, work *w)
{
    const brc_fill *const fill = &request->fill;
    if (request->n_points == 0) {
        BRC_TRY(brc_points_read(context, fill->file, fill->scale, &w->position, &w->radius, &w->n));
        return w->n > 0 ? BRC_OK : BRC_FAIL(context, BRC_BAD_INPUT, "fill: %s has no points", fill->file);
    }
    w->n = request->n_points;
    BRC_TRY(BRC_ALLOCATE(context, &w->position, 3 * w->n, "points"));
    memcpy(w->position, request->points, sizeof *w->position * 3 * (size_t)w->n);
    if (!request->radii) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &w->radius, w->n, "radii of points"));
    memcpy(w->radius, request->radii, sizeof *w->radius * (size_t)w->n);
    return BRC_OK;
}

/* What building holds here of what it holds where one rank does all of it: 0.2 have all of several machines, the rest
 * lies apart (bench/results/2026-11-27-ranks-apart.md). */
static double share_of(const brc_build_request *request)
{
    return request->together == BRC_APART ? 0.2 + 0.8 / brc_ranks_count() : 1.0;
}

/* Everything known before a seed is placed: solid, walls, grid. What is held is the caller's to free in any case. */
static brc_status plan(brc_context *context, const brc_build_request *request, work *w)
{
    memset(w, 0, sizeof *w);
    w->request = request;
    w->n_threads = request->n_threads > 0 ? request->n_threads : omp_get_max_threads();
    BRC_TRY(check_request(context, request));
    BRC_TRY(brc_solid_create(context, &request->shape, w->n_threads, &w->solid));
    if (request->fill.kind == BRC_FILL_POINTS) {
        BRC_TRY(take_points(context, request, w));
    } else {
        /* before anything is allocated by the number of elements */
        const double n = brc_estimate_elements(w->solid, &request->fill);
        if (n > 1e12)
            return BRC_FAIL(context, BRC_BAD_INPUT, "fill: a spacing of %g m gives %.3g elements; use larger cells",
                            brc_fill_spacing(w->solid, &request->fill), n);
        BRC_TRY(
            brc_estimate_check_memory(context, n, share_of(request) * brc_estimate_bytes(w->solid, request, n) / 2.0));
        w->n = (int64_t)fmax(1.0, n);
    }
    w->spacing = cbrt(brc_solid_volume(w->solid, NULL) / (double)w->n);
    if (request->fill.kind == BRC_FILL_NOISY_GRID) w->spacing = brc_fill_spacing(w->solid, &request->fill);
    BRC_TRY(brc_walls_create(context, w->solid, w->spacing, &w->walls));
    if (request->fill.kind == BRC_FILL_NOISY_GRID) {
        BRC_TRY(brc_grid_plan(context, &request->fill, &w->walls, w->n_threads, &w->grid));
        w->n = w->grid.n_inside;
    }
    return brc_estimate_check_memory(context, (double)w->n,
                                     share_of(request) * brc_estimate_bytes(w->solid, request, (double)w->n));
}

brc_status brc_domain_estimate(brc_context *context, const brc_build_request *request, int64_t *n_elements,
                               int64_t *bytes)
{
    work w;
    const brc_status status = plan(context, request, &w);
    if (status == BRC_OK) {
        *n_elements = w.n;
        *bytes = (int64_t)brc_estimate_bytes(w.solid, request, (double)w.n);
    }
    work_free(&w);
    return status;
}

/* Points come from elsewhere: all must lie in the shape, and in places of their own. */
static brc_status check_points(brc_context *context, const work *w)
{
    int64_t outside = 0, first = -1;
    for (int64_t e = 0; e < w->n; ++e) {
        if (brc_solid_inside(w->solid, w->position + 3 * e, 0.0)) continue;
        if (first < 0) first = e;
        ++outside;
    }
    if (outside == 0) return BRC_OK;
    const double *x = w->position + 3 * first;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "fill: %lld of %lld points of %s lie outside the shape, the first (point %lld) at (%g, %g, %g) m; "
                    "check scale, origin and size",
                    (long long)outside, (long long)w->n, w->request->fill.file, (long long)first + 1, x[0], x[1], x[2]);
}

static brc_status place_seeds(brc_context *context, work *w, brc_quality *quality)
{
    const brc_fill *fill = &w->request->fill;
    brc_packing packing;
    quality->n_seeds_requested = fill->n_elements > 0 ? fill->n_elements : w->n;
    switch (fill->kind) {
    case BRC_FILL_NOISY_GRID:
        return brc_seeds_draw(context, &w->grid, fill, &w->walls, &w->position, &w->n, &quality->n_seeds_duplicate);
    case BRC_FILL_PACKING:
        BRC_TRY((fill->cut ? brc_packing_cut : brc_packing_make)(context, w->solid, fill, w->n_threads, &packing));
        w->position = packing.position;
        w->radius = packing.radius;
        w->n = packing.n;
        return BRC_OK;
    case BRC_FILL_POINTS: return check_points(context, w);
    }
    return BRC_FAIL(context, BRC_INTERNAL, "fill: kind %d was not refused", (int)fill->kind);
}

/* A crack in the coordinates of the shape, before the pose. */
static brc_crack turned_back(const brc_crack *crack, const brc_build_request *request)
{
    double m[3][3];
    brc_crack out = *crack;
    const double *const vector[3] = {crack->normal, crack->edge[0], crack->edge[1]};
    double *const turned[3] = {out.normal, out.edge[0], out.edge[1]};
    const double *origin = request->shape.origin;
    brc_pose_matrix(request->rotation, m);
    for (int i = 0; i < 3; ++i) {
        out.point[i] = origin[i];
        for (int k = 0; k < 3; ++k)
            out.point[i] += m[k][i] * (crack->point[k] - request->translation[k] - origin[k]);
        for (int v = 0; v < 3; ++v)
            turned[v][i] = m[0][i] * vector[v][0] + m[1][i] * vector[v][1] + m[2][i] * vector[v][2];
    }
    return out;
}

/* Seeds next to flat cracks become mirror images of one another; images outside the solid are dropped. */
static brc_status mirror_at_cracks(brc_context *context, work *w)
{
    const brc_build_request *request = w->request;
    brc_crack *crack = NULL;
    brc_status status = BRC_OK;
    bool flat = false;
    for (int32_t k = 0; k < request->n_cracks; ++k)
        flat = flat || request->cracks[k].flat;
    if (!flat) return BRC_OK;
    const int64_t room = 2 * w->n, before = w->n;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &crack, request->n_cracks, "cracks"));
    for (int32_t k = 0; k < request->n_cracks; ++k)
        crack[k] = turned_back(&request->cracks[k], request);
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&w->position, 3 * room, sizeof(double), "seeds at cracks"));
    BRC_TRY_OR(cleanup,
               brc_cracks_mirror_seeds(context, request->n_cracks, crack, w->spacing, w->position, &w->n, room));
    int64_t to = 0;
    for (int64_t e = 0; e < w->n; ++e) {
        if (!brc_walls_inside(&w->walls, w->position + 3 * e, 1e-6 * w->spacing)) continue;
        memmove(w->position + 3 * to++, w->position + 3 * e, 3 * sizeof(double));
    }
    w->n = to;
    if (w->n < 1) status = BRC_FAIL(context, BRC_INTERNAL, "no seed of %lld is left at the cracks", (long long)before);
cleanup:
    brc_memory_free(crack);
    return status;
}

static brc_status name_walls(brc_context *context, const brc_solid *solid, brc_domain *domain)
{
    const int32_t n = brc_solid_n_walls(solid);
    BRC_TRY(BRC_ALLOCATE(context, &domain->wall_name, n, "wall names"));
    for (int32_t w = 0; w < n; ++w)
        BRC_TRY(brc_domain_add_wall(context, domain, brc_solid_wall_name(solid, w)));
    return BRC_OK;
}

static brc_status check_volume(brc_context *context, const work *w, const brc_domain *domain)
{
    double exact;
    const brc_quality *q = &domain->quality;
    brc_solid_volume(w->solid, &exact);
    if (!w->walls.mirrored && !(fabs(q->volume_error) < LOST_VOLUME + exact))
        return BRC_FAIL(context, BRC_INTERNAL,
                        "the volumes of the cells sum to %.12g m^3, the shape has %.12g m^3: cells were lost",
                        q->volume_cells, q->volume_shape);
    if (!(fabs(q->volume_error) < WORST_VOLUME_ERROR))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "shape: cells %.3g m wide fill %.2f %% more or less than the shape of %.6g m^3 has: they are "
                        "too coarse for its round or thin places; ask for more "
                        "elements (the error falls with the square of the cell size)",
                        w->spacing, 100.0 * q->volume_error, q->volume_shape);
    if (fabs(q->volume_error) > DOUBTFUL_VOLUME_ERROR)
        brc_log(context, BRC_LOG_WARNING,
                "shape: cells %.3g m wide fill %.2f %% more or less than the shape has; more elements bring them "
                "nearer (the error falls with the square of the cell size)",
                w->spacing, 100.0 * q->volume_error);
    return BRC_OK;
}

/* Seeds to cells to half-edges, in the coordinates of the shape. */
static brc_status build_cells(brc_context *context, work *w, brc_domain *domain)
{
    const brc_build_request *request = w->request;
    const double threshold = request->tiny_face_threshold > 0.0 ? request->tiny_face_threshold : DEFAULT_TINY_FACE;
    brc_cells cells = {.n_elements = 0};
    brc_status status = BRC_OK;
    w->spacing = cbrt(brc_solid_volume(w->solid, NULL) / (double)w->n);
    for (int32_t sweep = 0; sweep < request->fill.lloyd_sweeps; ++sweep) {
        char what[64];
        snprintf(what, sizeof what, "Lloyd sweep %d of %d", sweep + 1, request->fill.lloyd_sweeps);
        BRC_TRY_OR(cleanup, brc_conform_walls(context, w->position, w->n, w->spacing, false, w->n_threads, &w->walls));
        BRC_TRY_OR(cleanup, brc_cells_relax(context, w->position, w->n, &w->walls, w->spacing, w->n_threads,
                                            request->together != BRC_ALONE, what));
    }
    if (request->fill.kind != BRC_FILL_POINTS) /* those are as given */
        BRC_TRY_OR(cleanup, brc_edges_place(context, &w->walls, w->spacing, request->fill.spread, request->fill.seed,
                                            w->n_threads, &w->position, &w->n));
    BRC_TRY_OR(cleanup, mirror_at_cracks(context, w));
    domain->position = w->position;
    domain->n_elements = w->n;
    w->position = NULL;
    BRC_TRY_OR(cleanup, brc_conform_cells(context, domain->position, w->n, w->spacing, w->n_threads, request->together,
                                          &w->walls, &cells));
    BRC_TRY_OR(cleanup, brc_half_edges_build(context, &cells, threshold, w->n_threads, domain));
    BRC_TRY_OR(cleanup, brc_conform_check(context, &w->walls, w->spacing, w->n_threads, domain));
    status = name_walls(context, w->solid, domain);
cleanup:
    brc_cells_free(&cells);
    return status;
}

static brc_status build_beams(brc_context *context, work *w, brc_domain *domain)
{
    if (!w->radius)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "beams join spheres, and the points of %s have no radii: add a column radius or diameter, or build cells",
            w->request->fill.file);
    BRC_TRY(brc_beams_build(context, w->solid, w->position, w->radius, w->n, w->request->beams, w->request->balanced,
                            w->n_threads, domain));
    w->position = w->radius = NULL; /* the domain's now */
    return BRC_OK;
}

static brc_status set_regions(brc_context *context, const brc_build_request *request, brc_domain *domain)
{
    BRC_TRY(BRC_ALLOCATE(context, &domain->region, domain->n_elements, "material regions"));
    BRC_TRY(BRC_ALLOCATE(context, &domain->body, domain->n_elements, "bodies"));
    for (int64_t e = 0; e < domain->n_elements; ++e)
        domain->body[e] = request->body;
    for (int32_t r = 0; r < request->n_regions; ++r) {
        char what[32];
        snprintf(what, sizeof what, "region %d", r + 1);
        BRC_TRY(brc_predicate_check(context, &request->regions[r], BRC_SET_ELEMENTS, domain, what));
        int64_t count = 0;
        for (int64_t e = 0; e < domain->n_elements; ++e)
            if (brc_predicate_holds(&request->regions[r], BRC_SET_ELEMENTS, domain, e)) {
                domain->region[e] = r + 1;
                ++count;
            }
        if (count == 0) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: no element lies in it; widen or move it", what);
    }
    return BRC_OK;
}

/* Box and worst cases over the cells of all ranks. */
static brc_status measure_among_ranks(brc_context *context, brc_domain *domain)
{
    if (!domain->here) return BRC_OK;
    BRC_TRY(brc_ranks_least(context, 3, domain->bounds[0]));
    BRC_TRY(brc_ranks_most(context, 3, domain->bounds[1]));
    BRC_TRY(brc_quality_agree(context, domain));
    return brc_cells_bring_free_corners(context, domain);
}

/* Everything named or measured in posed coordinates. */
static brc_status finish(brc_context *context, const work *w, brc_domain *domain)
{
    const brc_build_request *request = w->request;
    brc_pose_apply(request->shape.origin, request->rotation, request->translation, domain);
    domain->quality.volume_shape = brc_solid_volume(w->solid, NULL);
    if (request->n_cracks > 0) {
        int64_t n_cut;
        BRC_TRY(brc_cracks_cut(context, request->n_cracks, request->cracks, domain, &n_cut));
        brc_log(context, BRC_LOG_INFO, "%d cracks cut %lld bonds", request->n_cracks, (long long)n_cut);
    }
    brc_quality_measure(domain, w->n_threads);
    if (domain->element_kind == BRC_ELEMENT_SPHERE) brc_beams_fill(domain, domain->quality.volume_fraction);
    BRC_TRY(measure_among_ranks(context, domain));
    if (domain->element_kind == BRC_ELEMENT_CELL) BRC_TRY(check_volume(context, w, domain));
    brc_features_warn(context, w->solid, domain->quality.mean_spacing, domain);
    BRC_TRY(set_regions(context, request, domain));
    if (request->grains.n > 0 || request->grains.size > 0.0)
        BRC_TRY(brc_grains_assign(context, &request->grains, request->n_regions, w->n_threads, domain));
    BRC_TRY(brc_sets_build(context, request->n_sets, request->sets, domain));
    BRC_TRY(brc_quality_judge(context, domain, request->n_limits, request->limits));
    return brc_describe(context, request, &w->grid, domain);
}

brc_status brc_domain_build(brc_context *context, const brc_build_request *request, brc_domain **out)
{
    *out = NULL;
    work w;
    brc_domain *domain = NULL;
    brc_status status = plan(context, request, &w);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain, 1, "domain"));
    BRC_TRY_OR(cleanup, place_seeds(context, &w, &domain->quality));
    if (request->beams > 0.0)
        BRC_TRY_OR(cleanup, build_beams(context, &w, domain));
    else
        BRC_TRY_OR(cleanup, build_cells(context, &w, domain));
    BRC_TRY_OR(cleanup, finish(context, &w, domain));
    *out = domain;
    domain = NULL;
cleanup:
    work_free(&w);
    brc_domain_free(&domain);
    return status;
}
