/* The straight concave edges of a solid: those between two planes of its parts, found along the line where the planes
 * meet, and those of its mesh, with collinear pieces joined. */
#include "solid_internal.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static brc_status add_edge(brc_context *context, brc_solid *solid, const brc_edge *edge)
{
    BRC_TRY(
        brc_memory_resize(context, (void **)&solid->edge, solid->n_edges + 1, sizeof *solid->edge, "concave edges"));
    solid->edge[solid->n_edges++] = *edge;
    return BRC_OK;
}

static void at(const double x[3], const double u[3], double t, double out[3])
{
    for (int d = 0; d < 3; ++d)
        out[d] = x[d] + t * u[d];
}

/* The line where two planes meet; false: parallel. */
static bool common_line(const brc_surface *a, const brc_surface *b, double x[3], double u[3])
{
    for (int d = 0; d < 3; ++d)
        u[d] = a->axis[(d + 1) % 3] * b->axis[(d + 2) % 3] - a->axis[(d + 2) % 3] * b->axis[(d + 1) % 3];
    const double length = brc_length3(u), c = brc_dot3(a->axis, b->axis);
    if (length < 1e-6) return false;
    for (int d = 0; d < 3; ++d)
        u[d] /= length;
    /* from the point of a towards b within a */
    const double gap[3] = {b->point[0] - a->point[0], b->point[1] - a->point[1], b->point[2] - a->point[2]};
    const double t = brc_dot3(gap, b->axis) / (1.0 - c * c);
    for (int d = 0; d < 3; ++d)
        x[d] = a->point[d] + t * (b->axis[d] - c * a->axis[d]);
    return true;
}

/* cut: room for 4 values a surface and 2. */
static brc_status find_between(brc_context *context, brc_solid *solid, const brc_surface *a, const brc_surface *b,
                               double *cut)
{
    double x[3], u[3], low, high;
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
    for (int32_t s = 0; s < solid->n_surfaces; ++s) {
        const brc_surface *other = &solid->surface[s];
        if (other == a || other == b || other->kind == BRC_SURFACE_MESH) continue;
        const int found = brc_surface_crossings(other, x, u, cut + n);
        int kept = 0;
        for (int k = 0; k < found; ++k)
            if (cut[n + k] > low && cut[n + k] < high) cut[n + kept++] = cut[n + k];
        n += kept;
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

/* An end of a piece of edge, to be sorted by place. */
typedef struct edge_end {
    double x[3];
    int64_t piece;
    int end;
} edge_end;

static int by_place(const void *a, const void *b)
{
    const edge_end *p = a, *q = b;
    for (int d = 0; d < 3; ++d)
        if (p->x[d] != q->x[d]) return p->x[d] < q->x[d] ? -1 : 1;
    if (p->piece != q->piece) return p->piece < q->piece ? -1 : 1;
    return p->end - q->end;
}

/* Are they pieces of one straight edge? */
static bool in_line(const brc_edge *a, const brc_edge *b)
{
    return brc_dot3(a->normal[0], b->normal[0]) >= 1.0 - 1e-8 && brc_dot3(a->normal[1], b->normal[1]) >= 1.0 - 1e-8;
}

/* after[k]: the piece that goes on where piece k ends, before[k] the other way; -1: none. Pieces of a mesh share
 * vertices, to the bit. */
static void link_pieces(const brc_edge *piece, int64_t n, edge_end *ends, int64_t *after, int64_t *before)
{
    for (int64_t k = 0; k < n; ++k) {
        after[k] = before[k] = -1;
        for (int end = 0; end < 2; ++end) {
            ends[2 * k + end] = (edge_end){.piece = k, .end = end};
            memcpy(ends[2 * k + end].x, piece[k].end[end], sizeof ends[0].x);
        }
    }
    qsort(ends, (size_t)(2 * n), sizeof *ends, by_place);
    for (int64_t i = 0, j; i < 2 * n; i = j) {
        for (j = i + 1; j < 2 * n && memcmp(ends[j].x, ends[i].x, sizeof ends[0].x) == 0;)
            ++j;
        for (int64_t a = i; a < j; ++a)
            for (int64_t b = i; b < j && ends[a].end == 1; ++b) {
                const int64_t p = ends[a].piece, q = ends[b].piece;
                if (ends[b].end != 0 || after[p] >= 0 || before[q] >= 0 || p == q || !in_line(&piece[p], &piece[q]))
                    continue;
                after[p] = q;
                before[q] = p;
            }
    }
}

/* Edges of the mesh of a leaf that is added: its pieces, joined where they go straight on. */
static brc_status take_mesh(brc_context *context, brc_solid *solid, const brc_leaf *leaf)
{
    brc_mesh_edge *list = NULL;
    brc_edge *piece = NULL;
    edge_end *ends = NULL;
    int64_t *after = NULL, *before = NULL;
    const int64_t n = brc_mesh_concave_edges(leaf->mesh, NULL, 0);
    brc_status status = BRC_ALLOCATE(context, &list, n, "concave edges of a mesh");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &piece, n, "concave edges of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &ends, 2 * n, "concave edges of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &after, n, "concave edges of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &before, n, "concave edges of a mesh"));
    brc_mesh_concave_edges(leaf->mesh, list, n);
    for (int64_t k = 0; k < n; ++k)
        for (int end = 0; end < 2; ++end) {
            brc_leaf_from_part(leaf, list[k].end[end], piece[k].end[end]);
            brc_leaf_turn(leaf, list[k].normal[end], piece[k].normal[end]);
        }
    link_pieces(piece, n, ends, after, before);
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&solid->edge, solid->n_edges + n, sizeof *solid->edge,
                                          "concave edges"));
    for (int64_t k = 0; k < n; ++k) {
        if (before[k] >= 0) continue;
        brc_edge *edge = &solid->edge[solid->n_edges++];
        int64_t last = k;
        while (after[last] >= 0)
            last = after[last];
        *edge = piece[k];
        memcpy(edge->end[1], piece[last].end[1], sizeof edge->end[1]);
    }
cleanup:
    brc_memory_free(list);
    brc_memory_free(piece);
    brc_memory_free(ends);
    brc_memory_free(after);
    brc_memory_free(before);
    return status;
}

brc_status brc_solid_find_edges(brc_context *context, brc_solid *solid)
{
    for (int32_t k = 0; k < solid->n_leaves; ++k)
        if (solid->leaf[k].mesh && solid->leaf[k].role == BRC_PART_ADD)
            BRC_TRY(take_mesh(context, solid, &solid->leaf[k]));
    if (solid->n_leaves == 1) return BRC_OK;
    double *cut = NULL;
    brc_status status = BRC_ALLOCATE(context, &cut, 4 * (int64_t)solid->n_surfaces + 2, "cuts of concave edges");
    if (status != BRC_OK) goto cleanup;
    for (int32_t a = 0; a < solid->n_surfaces; ++a)
        for (int32_t b = 0; b < a; ++b)
            if (solid->surface[a].kind == BRC_SURFACE_PLANE && solid->surface[b].kind == BRC_SURFACE_PLANE)
                BRC_TRY_OR(cleanup, find_between(context, solid, &solid->surface[b], &solid->surface[a], cut));
cleanup:
    brc_memory_free(cut);
    return status;
}

int32_t brc_solid_n_edges(const brc_solid *solid)
{
    return solid->n_edges;
}

const brc_edge *brc_solid_edge(const brc_solid *solid, int32_t edge)
{
    return &solid->edge[edge];
}
