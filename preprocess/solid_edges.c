/* The straight concave edges of a solid: those between two planes of its parts, found along the line where the planes meet, and those of its
 * mesh, with collinear pieces joined. */
#include "solid_internal.h"

#include "../host/base/memory.h"

#include <math.h>
#include <string.h>

static brc_status add_edge(brc_context *context, brc_solid *solid, const brc_edge *edge)
{
    BRC_TRY(brc_memory_resize(context, (void **)&solid->edge, solid->n_edges + 1, sizeof *solid->edge, "concave edges"));
    solid->edge[solid->n_edges++] = *edge;
    return BRC_OK;
}

static void at(const double x[3], const double u[3], double t, double out[3])
{
    for (int d = 0; d < 3; ++d) out[d] = x[d] + t * u[d];
}

/* The line where two planes meet; false: parallel. */
static bool common_line(const brc_surface *a, const brc_surface *b, double x[3], double u[3])
{
    for (int d = 0; d < 3; ++d) u[d] = a->axis[(d + 1) % 3] * b->axis[(d + 2) % 3] - a->axis[(d + 2) % 3] * b->axis[(d + 1) % 3];
    const double length = brc_length3(u), c = brc_dot3(a->axis, b->axis);
    if (length < 1e-6) return false;
    for (int d = 0; d < 3; ++d) u[d] /= length;
    /* from the point of a towards b within a */
    const double gap[3] = {b->point[0] - a->point[0], b->point[1] - a->point[1], b->point[2] - a->point[2]};
    const double t = brc_dot3(gap, b->axis) / (1.0 - c * c);
    for (int d = 0; d < 3; ++d) x[d] = a->point[d] + t * (b->axis[d] - c * a->axis[d]);
    return true;
}

static brc_status find_between(brc_context *context, brc_solid *solid, const brc_surface *a, const brc_surface *b)
{
    enum { MOST_CUTS = 512 };
    double x[3], u[3], cut[MOST_CUTS], low, high;
    int n = 0;
    if (!common_line(a, b, x, u)) return BRC_OK;
    /* the edge lies on both leaves */
    if (!brc_pass_box(solid->bounds, x, u, &low, &high)) return BRC_OK;
    const brc_surface *const pair[2] = {a, b};
    for (int k = 0; k < 2; ++k) {
        double from, to, wide[2][3];
        for (int d = 0; d < 3; ++d) {
            wide[0][d] = solid->leaf[pair[k]->leaf].bounds[0][d] - solid->tiny;
            wide[1][d] = solid->leaf[pair[k]->leaf].bounds[1][d] + solid->tiny;
        }
        if (!brc_pass_box((const double(*)[3])wide, x, u, &from, &to)) return BRC_OK;
        low = fmax(low, from);
        high = fmin(high, to);
    }
    if (!(high - low > solid->tiny)) return BRC_OK;
    cut[n++] = low;
    for (int32_t s = 0; s < solid->n_surfaces && n + 6 < MOST_CUTS; ++s) {
        const brc_surface *other = &solid->surface[s];
        if (other == a || other == b || other->kind == BRC_SURFACE_MESH) continue;
        const int found = brc_surface_crossings(other, x, u, cut + n);
        for (int k = 0; k < found; ++k)
            if (cut[n + k] <= low || cut[n + k] >= high) cut[n + k] = low;
        n += found;
    }
    cut[n++] = high;
    brc_sort(cut, n);
    brc_edge edge = {.normal = {{0.0}}};
    bool open = false;
    for (int k = 0; k + 1 < n; ++k) {
        double middle[3], normal[2][3];
        if (!(cut[k + 1] - cut[k] > solid->tiny)) continue;
        at(x, u, 0.5 * (cut[k] + cut[k + 1]), middle);
        const bool concave = brc_solid_concave_there(solid, middle, a->axis, b->axis, normal);
        if (concave && !open) {
            at(x, u, cut[k], edge.end[0]);
            memcpy(edge.normal, normal, sizeof normal);
        }
        if (open && !concave) BRC_TRY(add_edge(context, solid, &edge));
        open = concave;
        if (open) at(x, u, cut[k + 1], edge.end[1]);
    }
    return open ? add_edge(context, solid, &edge) : BRC_OK;
}

static double gap_between(const double a[3], const double b[3])
{
    const double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return brc_length3(r);
}

/* Lengthen an earlier edge by this one if they are one straight edge. */
static bool joins(brc_edge *edge, const brc_edge *more, double same)
{
    for (int side = 0; side < 2; ++side)
        if (brc_dot3(edge->normal[side], more->normal[side]) < 1.0 - 1e-8) return false;
    for (int end = 0; end < 2; ++end)
        if (gap_between(edge->end[end], more->end[1 - end]) <= same) {
            memcpy(edge->end[end], more->end[end], sizeof edge->end[end]);
            return true;
        }
    return false;
}

/* Edges of the mesh of a leaf that is added; joined until nothing joins. */
static brc_status take_mesh(brc_context *context, brc_solid *solid, const brc_leaf *leaf)
{
    brc_mesh_edge *list = NULL;
    const int64_t n = brc_mesh_concave_edges(leaf->mesh, NULL, 0);
    brc_status status = BRC_ALLOCATE(context, &list, n, "concave edges of a mesh");
    if (status != BRC_OK) goto cleanup;
    brc_mesh_concave_edges(leaf->mesh, list, n);
    const int32_t first = solid->n_edges;
    for (int64_t k = 0; k < n; ++k) {
        brc_edge edge;
        for (int end = 0; end < 2; ++end) {
            brc_leaf_from_part(leaf, list[k].end[end], edge.end[end]);
            brc_leaf_turn(leaf, list[k].normal[end], edge.normal[end]);
        }
        bool joined = false;
        for (int32_t e = first; e < solid->n_edges && !joined; ++e) joined = joins(&solid->edge[e], &edge, solid->tiny);
        if (!joined) BRC_TRY_OR(cleanup, add_edge(context, solid, &edge));
    }
    for (bool again = true; again;) { /* pieces that grew towards one another */
        again = false;
        for (int32_t e = first; e < solid->n_edges; ++e)
            for (int32_t f = e + 1; f < solid->n_edges; ++f)
                if (joins(&solid->edge[e], &solid->edge[f], solid->tiny)) {
                    solid->edge[f--] = solid->edge[--solid->n_edges];
                    again = true;
                }
    }
cleanup:
    brc_memory_free(list);
    return status;
}

brc_status brc_solid_find_edges(brc_context *context, brc_solid *solid)
{
    for (int32_t k = 0; k < solid->n_leaves; ++k)
        if (solid->leaf[k].mesh && solid->leaf[k].role == BRC_PART_ADD) BRC_TRY(take_mesh(context, solid, &solid->leaf[k]));
    if (solid->n_leaves == 1) return BRC_OK;
    for (int32_t a = 0; a < solid->n_surfaces; ++a)
        for (int32_t b = 0; b < a; ++b)
            if (solid->surface[a].kind == BRC_SURFACE_PLANE && solid->surface[b].kind == BRC_SURFACE_PLANE)
                BRC_TRY(find_between(context, solid, &solid->surface[b], &solid->surface[a]));
    return BRC_OK;
}

int32_t brc_solid_n_edges(const brc_solid *solid)
{
    return solid->n_edges;
}

const brc_edge *brc_solid_edge(const brc_solid *solid, int32_t edge)
{
    return &solid->edge[edge];
}
