/* The way from a request to a domain, in the order of the steps: check, walls, grid, seeds, relaxation, cells,
 * half-edges, pose, regions, sets, quality. */
#include "build.h"

#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/base/version.h"
#include "cells.h"
#include "halfedge.h"
#include "pose.h"
#include "quality.h"
#include "seeds.h"
#include "sets.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Faces this small carry nothing, and dropping one leaves its two cells open by less than the patch test notices. */
#define DEFAULT_TINY_FACE 1e-12
/* While building, cells and half-edges are held at once, and the search of Voro++. */
#define BUILD_OVER_DOMAIN 2.2

static int n_threads_of(const brc_build_request *request)
{
    return request->n_threads > 0 ? request->n_threads : omp_get_max_threads();
}

static brc_status check_request(brc_context *context, const brc_build_request *request)
{
    BRC_TRY(brc_shape_check(context, &request->shape));
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
    return BRC_OK;
}

/* Bonds' ends and free faces per element, fitted to built domains (docs/domain.md). w: cells at a wall, per element. A
 * cell of random seeds has 15.6 neighbours inside, fewer after relaxation, and loses four at a wall. A flat wall gives it
 * one free face; laying p planes a cell over a curved one gives 1 + p (cylinder) or (1 + sqrt p)^2 (sphere). Without
 * noise cells are cubes, until relaxation carries the disorder of a curved wall one layer a sweep inward. */
static void estimate_faces(const brc_shape *shape, const brc_fill *fill, double h, double w, double *half_edges,
                           double *free_faces)
{
    const double sweeps = fill->lloyd_sweeps, r = shape->radius;
    const bool sphere = shape->kind == BRC_SHAPE_SPHERE, cylinder = shape->kind == BRC_SHAPE_CYLINDER;
    const double planes = brc_shape_planes(shape, h);
    *free_faces = w;
    if (cylinder) *free_faces = w * (r + (1.0 + planes * h / (6.283185307 * r)) * shape->length) / (r + shape->length);
    if (sphere) *free_faces = w * pow(1.0 + sqrt(planes * h * h / 12.566370614) / r, 2.0);
    if (fill->spread > 0.0) {
        *half_edges = 14.9 + 0.7 * exp(-sweeps / 3.0) - 4.1 * w;
    } else {
        const double disorder = 1.0 - pow(fmax(0.0, 1.0 - w), sweeps);
        *half_edges = 6.0 - (sphere ? 0.0 : cylinder ? 0.7 : 1.0) * w + (sphere ? 8.5 : cylinder ? 2.0 : 0.0) * disorder;
    }
}

/* Bytes of a finished domain, by the sizes of domain.h. */
static int64_t estimate_bytes(const brc_shape *shape, const brc_fill *fill, double n)
{
    double bounds[2][3], side[3], half_edges, free_faces;
    brc_shape_bounds(shape, bounds);
    for (int k = 0; k < 3; ++k) side[k] = bounds[1][k] - bounds[0][k];
    const double r = shape->radius, h = cbrt(brc_shape_volume(shape) / n);
    double surface = 2.0 * (side[0] * side[1] + side[1] * side[2] + side[2] * side[0]);
    if (shape->kind == BRC_SHAPE_CYLINDER) surface = 6.283185307 * r * (r + shape->length);
    if (shape->kind == BRC_SHAPE_SPHERE) surface = 12.566370614 * r * r;
    estimate_faces(shape, fill, h, surface / (h * h * n), &half_edges, &free_faces);
    const double corners = 2.0 * (half_edges + free_faces) - 4.0; /* three faces meet in a corner */
    const double element = 3 * 8 + 8 + 3 * 8 + 6 * 8 + 4 + 4 + 3 * 8, half_edge = 3 * 4 + 6 * 8 + 2;
    const double free_face = 2 * 4 + 6 * 8 + 8 + 5.2 * 4 + 4;
    return (int64_t)(n * (element + half_edges * half_edge + free_faces * free_face + corners * 3 * 8));
}

static brc_status check_memory(brc_context *context, double n, double bytes)
{
    const double physical = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const double needed = BUILD_OVER_DOMAIN * bytes;
    if (physical <= 0.0 || needed <= physical) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "fill: building %.3g elements needs about %.3g GB, this machine has %.3g GB; ask for at most %.2g "
                    "elements",
                    n, needed * 1e-9, physical * 1e-9, n * physical / needed);
}

/* Walls and grid, which both building and estimating need. *walls is the caller's to free in any case. */
static brc_status plan(brc_context *context, const brc_build_request *request, brc_walls *walls, brc_grid *grid)
{
    memset(walls, 0, sizeof *walls);
    BRC_TRY(check_request(context, request));
    const double spacing = brc_fill_spacing(&request->shape, &request->fill);
    /* before anything is allocated by the number of elements */
    const double n = brc_shape_volume(&request->shape) / (spacing * spacing * spacing);
    if (n > 1e12)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: a spacing of %g m gives %.3g elements; use larger cells", spacing, n);
    BRC_TRY(check_memory(context, n, (double)estimate_bytes(&request->shape, &request->fill, n) / 2.0));
    BRC_TRY(brc_walls_create(context, &request->shape, spacing, walls));
    BRC_TRY(brc_grid_plan(context, &request->shape, &request->fill, walls, n_threads_of(request), grid));
    const double inside = (double)grid->n_inside;
    return check_memory(context, inside, (double)estimate_bytes(&request->shape, &request->fill, inside));
}

brc_status brc_domain_estimate(brc_context *context, const brc_build_request *request, int64_t *n_elements,
                               int64_t *bytes)
{
    brc_walls walls;
    brc_grid grid;
    const brc_status status = plan(context, request, &walls, &grid);
    if (status == BRC_OK) {
        *n_elements = grid.n_inside;
        *bytes = estimate_bytes(&request->shape, &request->fill, (double)grid.n_inside);
    }
    brc_walls_free(&walls);
    return status;
}

static brc_status name_walls(brc_context *context, const brc_walls *walls, brc_domain *domain)
{
    BRC_TRY(BRC_ALLOCATE(context, &domain->wall_name, walls->n_walls, "wall names"));
    for (int32_t w = 0; w < walls->n_walls; ++w) {
        BRC_TRY(BRC_ALLOCATE(context, &domain->wall_name[w], (int64_t)strlen(walls->wall_name[w]) + 1, "wall name"));
        strcpy(domain->wall_name[w], walls->wall_name[w]);
        domain->n_walls = w + 1;
    }
    return BRC_OK;
}

static brc_status set_regions(brc_context *context, const brc_build_request *request, brc_domain *domain)
{
    BRC_TRY(BRC_ALLOCATE(context, &domain->region, domain->n_elements, "material regions"));
    BRC_TRY(BRC_ALLOCATE(context, &domain->body, domain->n_elements, "bodies"));
    for (int64_t e = 0; e < domain->n_elements; ++e) domain->body[e] = request->body;
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
        if (count == 0)
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: no element lies in it; widen or move it", what);
    }
    return BRC_OK;
}

static brc_status describe(brc_context *context, const brc_build_request *request, const brc_grid *grid,
                           brc_domain *domain)
{
    const brc_shape *s = &request->shape;
    const brc_fill *f = &request->fill;
    char shape[192];
    if (s->kind == BRC_SHAPE_BOX)
        snprintf(shape, sizeof shape, "box %.17g x %.17g x %.17g m", s->size[0], s->size[1], s->size[2]);
    else if (s->kind == BRC_SHAPE_CYLINDER)
        snprintf(shape, sizeof shape, "cylinder along %c, length %.17g m, radius %.17g m", "xyz"[s->axis], s->length,
                 s->radius);
    else
        snprintf(shape, sizeof shape, "sphere, radius %.17g m", s->radius);
    enum { ROOM = 768 };
    BRC_TRY(BRC_ALLOCATE(context, &domain->provenance, ROOM, "provenance"));
    snprintf(domain->provenance, ROOM,
             "breccia %s; %s at (%.17g, %.17g, %.17g) m; noisy grid %lld x %lld x %lld, spread %.17g, seed %llu, "
             "%d Lloyd sweeps; translation (%.17g, %.17g, %.17g) m, rotation (%.17g, %.17g, %.17g) rad; Voro++ 0.4.6",
             brc_version(), shape, s->origin[0], s->origin[1], s->origin[2], (long long)grid->cells[0],
             (long long)grid->cells[1], (long long)grid->cells[2], f->spread, (unsigned long long)f->seed,
             f->lloyd_sweeps, request->translation[0], request->translation[1], request->translation[2],
             request->rotation[0], request->rotation[1], request->rotation[2]);
    return BRC_OK;
}

/* What follows the half-edges: everything named or measured in posed coordinates. */
static brc_status finish(brc_context *context, const brc_build_request *request, const brc_walls *walls,
                         const brc_grid *grid, brc_domain *domain)
{
    brc_pose_apply(request->shape.origin, request->rotation, request->translation, domain);
    BRC_TRY(name_walls(context, walls, domain));
    domain->quality.volume_shape = brc_shape_volume(&request->shape);
    brc_quality_measure(domain, n_threads_of(request));
    if (!(fabs(domain->quality.volume_error) < 1e-8))
        return BRC_FAIL(context, BRC_INTERNAL,
                        "the volumes of the cells sum to %.12g m^3, the shape has %.12g m^3: cells were lost",
                        domain->quality.volume_cells, domain->quality.volume_shape);
    BRC_TRY(set_regions(context, request, domain));
    BRC_TRY(brc_sets_build(context, request->n_sets, request->sets, domain));
    return describe(context, request, grid, domain);
}

brc_status brc_domain_build(brc_context *context, const brc_build_request *request, brc_domain **out)
{
    *out = NULL;
    brc_walls walls;
    brc_grid grid;
    brc_cells cells = {.n_elements = 0};
    brc_domain *domain = NULL;
    const int n_threads = n_threads_of(request);
    brc_status status = plan(context, request, &walls, &grid);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain, 1, "domain"));
    const brc_fill *fill = &request->fill;
    brc_quality *quality = &domain->quality;
    quality->n_seeds_requested = fill->n_elements > 0 ? fill->n_elements : grid.n_inside;
    BRC_TRY_OR(cleanup, brc_seeds_draw(context, &grid, fill, &walls, &domain->position, &domain->n_elements,
                                       &quality->n_seeds_duplicate));
    const double spacing = cbrt(brc_shape_volume(&request->shape) / (double)domain->n_elements);
    for (int32_t sweep = 0; sweep < fill->lloyd_sweeps; ++sweep) {
        char what[64];
        snprintf(what, sizeof what, "Lloyd sweep %d of %d", sweep + 1, fill->lloyd_sweeps);
        BRC_TRY_OR(cleanup, brc_cells_relax(context, domain->position, domain->n_elements, &walls, spacing, n_threads,
                                            what));
    }
    BRC_TRY_OR(cleanup, brc_cells_compute(context, domain->position, domain->n_elements, &walls, spacing, n_threads,
                                          &cells));
    const double threshold = request->tiny_face_threshold > 0.0 ? request->tiny_face_threshold : DEFAULT_TINY_FACE;
    BRC_TRY_OR(cleanup, brc_half_edges_build(context, &cells, threshold, n_threads, domain));
    BRC_TRY_OR(cleanup, finish(context, request, &walls, &grid, domain));
    *out = domain;
    domain = NULL;
cleanup:
    brc_cells_free(&cells);
    brc_walls_free(&walls);
    brc_domain_free(&domain);
    return status;
}
