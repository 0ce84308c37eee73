/* A mesh from its file: the steps in order, and what is known of the whole. */
#include "mesh.h"
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *brc_mesh_place(const brc_mesh_source *source, const double x[3], char text[BRC_MESH_PLACE])
{
    double place[3];
    for (int d = 0; d < 3; ++d)
        place[d] = (x[d] - source->offset[d]) / source->scale;
    snprintf(text, BRC_MESH_PLACE, "(%.7g, %.7g, %.7g)", place[0], place[1], place[2]);
    return text;
}

/* From units of the file to metres. */
static brc_status place_corners(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source,
                                double (*corner)[3], int32_t n_facets)
{
    double largest = 0.0;
    for (int64_t k = 0; k < 3 * (int64_t)n_facets; ++k)
        for (int d = 0; d < 3; ++d) {
            double *x = &corner[k][d];
            largest = fmax(largest, fabs(*x));
            *x = *x * source->scale + source->offset[d];
            if (!(fabs(*x) < 1e30))
                return BRC_FAIL(context, BRC_BAD_INPUT,
                                "%s: triangle %lld: %c of corner %d becomes %g m, at most 1e30 m is possible; check "
                                "the file's numbers and the scale",
                                source->path, (long long)(k / 3) + 1, "xyz"[d], (int)(k % 3) + 1, *x);
        }
    mesh->rounding = 4.0 * 0x1p-24 * largest * source->scale;
    return BRC_OK;
}

static void mark_slivers(brc_mesh *mesh)
{
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        if (brc_mesh_height(mesh, t, NULL) <= mesh->rounding) mesh->flags[t] |= BRC_MESH_SLIVER;
}

static brc_status make(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source)
{
    double(*corner)[3] = NULL;
    int32_t n_facets = 0;
    BRC_TRY(brc_mesh_read_facets(context, source->path, &corner, &n_facets));
    mesh->vertex = corner; /* freed with the mesh from here on */
    BRC_TRY(place_corners(context, mesh, source, corner, n_facets));
    BRC_TRY(brc_mesh_weld(context, mesh, source, corner, n_facets));
    BRC_TRY(brc_mesh_join_edges(context, mesh, source));
    BRC_TRY(brc_mesh_orient(context, mesh, source));
    BRC_TRY(brc_mesh_mend(context, mesh, source));
    BRC_TRY(brc_mesh_split_fans(context, mesh));
    BRC_TRY(brc_mesh_plant(context, mesh));
    BRC_TRY(BRC_ALLOCATE(context, &mesh->flags, mesh->n_triangles, "edges of a mesh"));
    mark_slivers(mesh);
    BRC_TRY(brc_mesh_check_cuts(context, mesh, source));
    BRC_TRY(brc_mesh_nest(context, mesh, source));
    return brc_mesh_smooth(context, mesh);
}

brc_status brc_mesh_read_stl(brc_context *context, const char *path, double scale, const double offset[3],
                             int n_threads, brc_mesh **out)
{
    *out = NULL;
    const brc_mesh_source source = {
        .path = path, .scale = scale, .offset = {offset[0], offset[1], offset[2]}, .n_threads = n_threads};
    if (!(scale > 0.0) || !isfinite(scale) || !isfinite(offset[0] + offset[1] + offset[2]))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: scale %g and offset (%g, %g, %g) m: the scale must be finite and > 0, the offset finite",
                        path, scale, offset[0], offset[1], offset[2]);
    brc_mesh *mesh = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &mesh, 1, "a mesh"));
    const brc_status status = make(context, mesh, &source);
    brc_memory_free(mesh->facet);
    brc_memory_free(mesh->shell);
    mesh->facet = mesh->shell = NULL;
    if (status != BRC_OK) brc_mesh_free(&mesh);
    *out = mesh;
    return status;
}

void brc_mesh_free(brc_mesh **mesh)
{
    if (!mesh || !*mesh) return;
    brc_mesh *m = *mesh;
    brc_memory_free(m->vertex);
    brc_memory_free(m->corner);
    brc_memory_free(m->across);
    brc_memory_free(m->flags);
    brc_memory_free(m->normal);
    brc_memory_free(m->vertex_normal);
    brc_memory_free(m->patch);
    brc_memory_free(m->patch_flat);
    brc_memory_free(m->node);
    brc_memory_free(m);
    *mesh = NULL;
}

int64_t brc_mesh_n_triangles(const brc_mesh *mesh)
{
    return mesh->n_triangles;
}

const double (*brc_mesh_vertices(const brc_mesh *mesh, int32_t *n))[3]
{
    *n = mesh->n_vertices;
    return (const double(*)[3])mesh->vertex;
}

bool brc_mesh_triangle(const brc_mesh *mesh, int64_t t, const int32_t **corners)
{
    *corners = mesh->corner[t];
    return !(mesh->flags[t] & BRC_MESH_SLIVER);
}

void brc_mesh_bounds(const brc_mesh *mesh, double bounds[2][3])
{
    memcpy(bounds, mesh->bounds, sizeof mesh->bounds);
}

double brc_mesh_volume(const brc_mesh *mesh)
{
    return mesh->volume;
}

double brc_mesh_area(const brc_mesh *mesh)
{
    return mesh->area;
}

bool brc_mesh_is_convex(const brc_mesh *mesh)
{
    return mesh->convex;
}

int32_t brc_mesh_n_patches(const brc_mesh *mesh)
{
    return mesh->n_patches;
}
