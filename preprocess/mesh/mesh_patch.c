/* Normals and smooth patches. A triangle thinner than the rounding of the file has a normal of chance: it takes that of
 * the neighbour across its longest edge. The triangles of a plane patch take the patch's normal. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

enum { MOST_ROUNDS = 16 };
static const double SMOOTH = 0.86602540378443864676; /* cosine of 30 degrees */

static void unit(double v[3])
{
    const double length = sqrt(mesh_dot(v, v));
    if (length > 0.0)
        for (int d = 0; d < 3; ++d)
            v[d] /= length;
}

static void find_normals(brc_mesh *mesh, uint8_t *own)
{
    int64_t left = 0;
    for (int32_t t = 0; t < mesh->n_triangles; ++t) {
        brc_mesh_area_vector(mesh, t, mesh->normal[t]);
        unit(mesh->normal[t]);
        own[t] = !(mesh->flags[t] & BRC_MESH_SLIVER);
        left += !own[t];
    }
    for (int round = 0; left > 0 && round < MOST_ROUNDS; ++round)
        for (int32_t t = 0; t < mesh->n_triangles; ++t) {
            int k = 0;
            if (own[t]) continue;
            brc_mesh_height(mesh, t, &k);
            const int32_t u = mesh->across[t][k] / 3;
            if (!own[u]) continue;
            memcpy(mesh->normal[t], mesh->normal[u], sizeof mesh->normal[t]);
            own[t] = 1;
            --left;
        }
}

static int32_t root_of(int32_t *parent, int32_t t)
{
    while (parent[t] != t) {
        parent[t] = parent[parent[t]];
        t = parent[t];
    }
    return t;
}

/* Join triangles across smooth edges; number the patches in the order of their first triangles. */
static void find_patches(brc_mesh *mesh)
{
    int32_t *parent = mesh->patch;
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        parent[t] = t;
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const int32_t u = mesh->across[t][k] / 3;
            if (mesh_dot(mesh->normal[t], mesh->normal[u]) <= SMOOTH) {
                mesh->flags[t] |= (uint8_t)BRC_MESH_SHARP(k);
                continue;
            }
            const int32_t a = root_of(parent, t), b = root_of(parent, u);
            if (a < b)
                parent[b] = a;
            else
                parent[a] = b;
        }
    for (int32_t t = 0; t < mesh->n_triangles;
         ++t) /* a root is the first triangle of its patch, so it has its number already */
        mesh->patch[t] = parent[t] == t ? mesh->n_patches++ : mesh->patch[parent[t]];
}

/* Extent of a patch along its mean normal. */
typedef struct sheet {
    double normal[3], low, high;
} sheet;

static brc_status flatten(brc_context *context, brc_mesh *mesh)
{
    sheet *of = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &of, mesh->n_patches, "patches of a mesh"));
    for (int32_t p = 0; p < mesh->n_patches; ++p) {
        of[p].low = HUGE_VAL;
        of[p].high = -HUGE_VAL;
    }
    for (int32_t t = 0; t < mesh->n_triangles; ++t) {
        double area[3];
        brc_mesh_area_vector(mesh, t, area);
        for (int d = 0; d < 3; ++d)
            of[mesh->patch[t]].normal[d] += area[d];
    }
    for (int32_t p = 0; p < mesh->n_patches; ++p)
        unit(of[p].normal);
    for (int32_t t = 0; t < mesh->n_triangles; ++t) {
        sheet *s = &of[mesh->patch[t]];
        for (int k = 0; k < 3; ++k) {
            double arm[3];
            mesh_minus(mesh->vertex[mesh->corner[t][k]], mesh->bounds[0], arm);
            const double height = mesh_dot(arm, s->normal);
            s->low = fmin(s->low, height);
            s->high = fmax(s->high, height);
        }
    }
    for (int32_t p = 0; p < mesh->n_patches; ++p)
        mesh->patch_flat[p] = of[p].high - of[p].low <= mesh->rounding;
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        if (mesh->patch_flat[mesh->patch[t]])
            memcpy(mesh->normal[t], of[mesh->patch[t]].normal, sizeof mesh->normal[t]);
    brc_memory_free(of);
    return BRC_OK;
}

static void mark_concave(brc_mesh *mesh)
{
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            if (!(mesh->flags[t] & BRC_MESH_SHARP(k))) continue;
            double along[3], turn[3];
            mesh_minus(mesh->vertex[mesh->corner[t][(k + 1) % 3]], mesh->vertex[mesh->corner[t][k]], along);
            mesh_cross(mesh->normal[t], mesh->normal[mesh->across[t][k] / 3], turn);
            if (mesh_dot(turn, along) < 0.0) mesh->flags[t] |= (uint8_t)BRC_MESH_CONCAVE(k);
        }
}

static void weigh_vertices(brc_mesh *mesh)
{
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const int32_t *corner = mesh->corner[t];
            double a[3], b[3], area[3];
            mesh_minus(mesh->vertex[corner[(k + 1) % 3]], mesh->vertex[corner[k]], a);
            mesh_minus(mesh->vertex[corner[(k + 2) % 3]], mesh->vertex[corner[k]], b);
            mesh_cross(a, b, area);
            const double angle = atan2(sqrt(mesh_dot(area, area)), mesh_dot(a, b));
            for (int d = 0; d < 3; ++d)
                mesh->vertex_normal[corner[k]][d] += angle * mesh->normal[t][d];
        }
}

static void mark_nodes(brc_mesh *mesh)
{
    for (int32_t i = mesh->n_nodes - 1; i >= 0; --i) {
        brc_mesh_node *node = &mesh->node[i];
        if (node->count == 0) {
            const int32_t a = mesh->node[i + 1].patch;
            node->patch = a == mesh->node[node->next].patch ? a : -1;
            continue;
        }
        node->patch = mesh->patch[node->next];
        for (int32_t t = node->next + 1; t < node->next + node->count; ++t)
            if (mesh->patch[t] != node->patch) node->patch = -1;
    }
}

/* Does any vertex stand above the plane of triangle t? Only boxes that reach above it are opened. */
static bool stands_above(const brc_mesh *mesh, int32_t t)
{
    const double *n = mesh->normal[t], *origin = mesh->vertex[mesh->corner[t][0]];
    int32_t stack[BRC_MESH_STACK], n_stack = 0;
    stack[n_stack++] = 0;
    while (n_stack > 0) {
        const int32_t at = stack[--n_stack];
        const brc_mesh_node *node = &mesh->node[at];
        double top = 0.0;
        for (int d = 0; d < 3; ++d)
            top += n[d] * ((double)(n[d] > 0.0 ? node->high[d] : node->low[d]) - origin[d]);
        if (top <= mesh->rounding) continue;
        if (node->count == 0) {
            stack[n_stack++] = node->next;
            stack[n_stack++] = at + 1;
            continue;
        }
        for (int32_t u = node->next; u < node->next + node->count; ++u)
            for (int k = 0; k < 3; ++k) {
                double arm[3];
                mesh_minus(mesh->vertex[mesh->corner[u][k]], origin, arm);
                if (mesh_dot(arm, n) > mesh->rounding) return true;
            }
    }
    return false;
}

/* How far the neighbours of triangle t stand above its plane, at most [m]; those of its own flat patch lie in it. */
static double highest_neighbour(const brc_mesh *mesh, int32_t t)
{
    double highest = -HUGE_VAL;
    if (mesh->flags[t] & BRC_MESH_SLIVER) return highest;
    for (int k = 0; k < 3; ++k) {
        const int32_t h = mesh->across[t][k], u = h / 3;
        double arm[3];
        if (mesh->patch[u] == mesh->patch[t] && mesh->patch_flat[mesh->patch[t]]) continue;
        mesh_minus(mesh->vertex[mesh->corner[u][(h + 2) % 3]], mesh->vertex[mesh->corner[t][k]], arm);
        highest = fmax(highest, mesh_dot(arm, mesh->normal[t]));
    }
    return highest;
}

/* A connected closed surface that does not cut itself is convex when it is so at every edge (S. Nakajima, 1928). Edges
 * may be concave by the rounding of the file; that this does not add up, as in a shallow dish of very many triangles,
 * is seen from all vertices and the planes of 64 such triangles. */
static bool find_convex(const brc_mesh *mesh)
{
    enum { SAMPLES = 64 };
    const double doubt = 1e-12 * mesh->size;
    int32_t n_doubtful = 0, at = 0;
    if (mesh->n_shells > 1) return false;
    for (int32_t t = 0; t < mesh->n_triangles; ++t) {
        const double height = highest_neighbour(mesh, t);
        if (height > mesh->rounding) return false;
        n_doubtful += height > doubt;
    }
    const int32_t step = n_doubtful / SAMPLES + 1;
    for (int32_t t = 0; t < mesh->n_triangles && n_doubtful > 0; ++t)
        if (highest_neighbour(mesh, t) > doubt && at++ % step == 0 && stands_above(mesh, t)) return false;
    return true;
}

brc_status brc_mesh_smooth(brc_context *context, brc_mesh *mesh)
{
    uint8_t *own = NULL;
    brc_status status = BRC_OK;
    const int32_t n = mesh->n_triangles;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &own, n, "normals of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->normal, n, "normals of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->patch, n, "patches of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->vertex_normal, mesh->n_vertices, "normals of a mesh"));
    find_normals(mesh, own);
    find_patches(mesh);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->patch_flat, mesh->n_patches, "patches of a mesh"));
    BRC_TRY_OR(cleanup, flatten(context, mesh));
    mark_concave(mesh);
    weigh_vertices(mesh);
    mark_nodes(mesh);
    mesh->convex = find_convex(mesh);
cleanup:
    brc_memory_free(own);
    return status;
}

int64_t brc_mesh_concave_edges(const brc_mesh *mesh, brc_mesh_edge *edges, int64_t most)
{
    int64_t n = 0;
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const int32_t u = mesh->across[t][k] / 3;
            if (u < t || !(mesh->flags[t] & BRC_MESH_CONCAVE(k))) continue;
            if (n < most) {
                memcpy(edges[n].end[0], mesh->vertex[mesh->corner[t][k]], sizeof edges[n].end[0]);
                memcpy(edges[n].end[1], mesh->vertex[mesh->corner[t][(k + 1) % 3]], sizeof edges[n].end[1]);
                memcpy(edges[n].normal[0], mesh->normal[t], sizeof edges[n].normal[0]);
                memcpy(edges[n].normal[1], mesh->normal[u], sizeof edges[n].normal[1]);
            }
            ++n;
        }
    return n;
}
