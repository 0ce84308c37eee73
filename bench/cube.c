#include "cube.h"
#include "../host/base/memory.h"
#include <stdio.h>
#include <string.h>

bool brc_cube_is_of_spheres(brc_model_kind model)
{
    return brc_model_traits_of(model)->spheres;
}

void brc_cube_make(brc_cube *c, brc_model_kind model)
{
    const brc_model_traits *traits = brc_model_traits_of(model);
    memset(c, 0, sizeof *c);
    c->material = (brc_material){.name = "glass", .young = 72e9, .poisson = 0.23, .density = 2500};
    snprintf(c->body.name, sizeof c->body.name, "cube");
    c->body.shape = (brc_shape){.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    c->initial[0] =
        (brc_initial){.kind = BRC_INITIAL_AFFINE, .gradient = {{1e-6, 2e-7, 0}, {0, -3e-7, 1e-7}, {1e-7, 0, 5e-7}}};
    c->initial[1] = (brc_initial){.kind = BRC_INITIAL_RANDOM, .value = {1e-4, 1e-4, 1e-4}, .seed = 1};
    /* The paper's time step is far below the critical one at this nu and needs no power iteration. */
    c->stage =
        (brc_stage){.name = "run",
                    .solver = BRC_SOLVER_DYNAMIC,
                    .n_initials = 2,
                    .initials = c->initial,
                    .integrator = !traits->spheres && !traits->deforms ? BRC_TCHAMWA_WIELGOSZ : BRC_VELOCITY_VERLET,
                    .phi = 1.03,
                    .time_step_rule = traits->spheres ? BRC_TIME_STEP_AUTO : BRC_TIME_STEP_PUBLISHED,
                    .safety = 0.8,
                    .steps = INT64_C(1) << 40};
    c->scene = (brc_scene){.version = 1,
                           .folder = ".",
                           .n_materials = 1,
                           .materials = &c->material,
                           .n_bodies = 1,
                           .bodies = &c->body,
                           .n_stages = 1,
                           .stages = &c->stage,
                           .model = {.kind = model,
                                     .compaction = true,
                                     .beta = 1,
                                     .tau = 0.1,
                                     .rotation_stiffness = 1,
                                     .beam_poisson = 0.3,
                                     .keep_isolated = true},
                           .output = {.n_frames = -1}};
}

/* Its relaxation is no part of what is measured, so it stops early. */
static brc_status pack(brc_context *context, const double edges[3], int64_t size, brc_domain **out)
{
    brc_build_request packed = {.shape = {.kind = BRC_SHAPE_BOX, .size = {edges[0], edges[1], edges[2]}},
                                .fill = {.kind = BRC_FILL_PACKING,
                                         .n_elements = size,
                                         .radius_spread = 0.125,
                                         .coordination = 6.2,
                                         .tolerance = 0.1,
                                         .seed = 1},
                                .beams = 10};
    return brc_domain_build(context, &packed, out);
}

/* The image of a coordinate in a mirrored tile: tiles of odd number are turned over. */
static double mirrored(double x, double edge, int tile)
{
    return edge * tile + (tile % 2 ? edge - x : x);
}

/* Packing takes minutes a million spheres: more than MOST_PACKED are mirror images of a packing in a part of the box,
 * whose walls its spheres touch. */
static brc_status build_packing(brc_context *context, const double edges[3], int64_t size, brc_domain **out)
{
    enum { MOST_PACKED = 100000 };
    int tiles = 1;
    while (size / ((int64_t)tiles * tiles * tiles) > MOST_PACKED)
        ++tiles;
    if (tiles == 1) return pack(context, edges, size, out);
    const int n_tiles = tiles * tiles * tiles;
    const double part[3] = {edges[0] / tiles, edges[1] / tiles, edges[2] / tiles};
    brc_status status = BRC_OK;
    brc_domain *one = NULL;
    double *points = NULL, *radii = NULL;
    *out = NULL;
    BRC_TRY(pack(context, part, size / n_tiles, &one));
    const int64_t n = one->n_elements;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &points, 3 * n * n_tiles, "centres of mirrored spheres"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &radii, n * n_tiles, "radii of mirrored spheres"));
    for (int64_t e = 0; e < n * n_tiles; ++e) {
        const int t = (int)(e / n), tile[3] = {t % tiles, t / tiles % tiles, t / (tiles * tiles)};
        radii[e] = one->radius[e % n];
        for (int k = 0; k < 3; ++k)
            points[3 * e + k] = mirrored(one->position[3 * (e % n) + k], part[k], tile[k]);
    }
    brc_domain_free(&one);
    const brc_build_request request = {.shape = {.kind = BRC_SHAPE_BOX, .size = {edges[0], edges[1], edges[2]}},
                                       .fill = {.kind = BRC_FILL_POINTS, .file = "mirrored spheres", .scale = 1},
                                       .n_points = n * n_tiles,
                                       .points = points,
                                       .radii = radii,
                                       .beams = 10};
    status = brc_domain_build(context, &request, out);
cleanup:
    brc_domain_free(&one);
    brc_memory_free(points);
    brc_memory_free(radii);
    return status;
}

brc_status brc_cube_build(brc_context *context, int64_t size, bool spheres, brc_domain **out)
{
    static const double edges[3] = {1, 1, 1};
    if (spheres) return build_packing(context, edges, size, out);
    brc_build_request request = {.shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}},
                                 .fill = {.kind = BRC_FILL_NOISY_GRID, .n_elements = size, .spread = 0.9, .seed = 1}};
    return brc_domain_build(context, &request, out);
}

brc_status brc_cube_build_bar(brc_context *context, int64_t size, brc_domain **out)
{
    static const double edges[3] = {1, BRC_BAR_WIDTH, BRC_BAR_WIDTH};
    return build_packing(context, edges, size, out);
}
