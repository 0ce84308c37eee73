/* Triangles without height are needed for the edges of their neighbours to meet, but have no normal. Flipping the
 * longest edge of such a triangle gives both halves of its neighbour a height and moves the surface by less than equal
 * vertices may differ. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

enum { MOST_ROUNDS = 64 };
static const double FLAT = 1e-9; /* height of the size */

void brc_mesh_area_vector(const brc_mesh *mesh, int32_t t, double out[3])
{
    double a[3], b[3];
    const int32_t *corner = mesh->corner[t];
    mesh_minus(mesh->vertex[corner[1]], mesh->vertex[corner[0]], a);
    mesh_minus(mesh->vertex[corner[2]], mesh->vertex[corner[0]], b);
    mesh_cross(a, b, out);
}

double brc_mesh_height(const brc_mesh *mesh, int32_t t, int *longest)
{
    double area[3], most = 0.0;
    for (int k = 0; k < 3; ++k) {
        double edge[3];
        mesh_minus(mesh->vertex[mesh->corner[t][(k + 1) % 3]], mesh->vertex[mesh->corner[t][k]], edge);
        const double length = mesh_dot(edge, edge);
        if (length <= most) continue;
        most = length;
        if (longest) *longest = k;
    }
    brc_mesh_area_vector(mesh, t, area);
    return most > 0.0 ? sqrt(mesh_dot(area, area) / most) : 0.0;
}

/* Is there an edge from the vertex of this corner to vertex w? */
static bool has_edge(const brc_mesh *mesh, int32_t corner, int32_t w)
{
    int32_t at = corner;
    do {
        if (mesh->corner[at / 3][(at + 1) % 3] == w) return true;
        at = brc_mesh_turn(mesh, at);
    } while (at != corner);
    return false;
}

static void link_edges(brc_mesh *mesh, int32_t g, int32_t h)
{
    mesh->across[g / 3][g % 3] = h;
    mesh->across[h / 3][h % 3] = g;
}

static void set_corners(brc_mesh *mesh, int32_t t, int32_t a, int32_t b, int32_t c)
{
    mesh->corner[t][0] = a;
    mesh->corner[t][1] = b;
    mesh->corner[t][2] = c;
}

/* Flip the longest edge of t: t = (a, b, c) and its neighbour (b, a, d) become (c, a, d) and (d, b, c). Not where that
 * gives nothing better, or an edge that is there already. */
static bool flip(brc_mesh *mesh, int32_t t)
{
    int k = 0, unused;
    const double before = brc_mesh_height(mesh, t, &k);
    const int32_t h = mesh->across[t][k], u = h / 3, m = h % 3;
    const int32_t a = mesh->corner[t][k], b = mesh->corner[t][(k + 1) % 3], c = mesh->corner[t][(k + 2) % 3];
    const int32_t d = mesh->corner[u][(m + 2) % 3];
    if (t == u || c == d || has_edge(mesh, 3 * t + (k + 2) % 3, d)) return false;
    const int32_t ca = mesh->across[t][(k + 2) % 3], bc = mesh->across[t][(k + 1) % 3];
    const int32_t ad = mesh->across[u][(m + 1) % 3], db = mesh->across[u][(m + 2) % 3];
    if (ca / 3 == u || bc / 3 == u) return false;
    int32_t corner_t[3], corner_u[3];
    memcpy(corner_t, mesh->corner[t], sizeof corner_t);
    memcpy(corner_u, mesh->corner[u], sizeof corner_u);
    set_corners(mesh, t, c, a, d);
    set_corners(mesh, u, d, b, c);
    if (!(brc_mesh_height(mesh, t, &unused) > before && brc_mesh_height(mesh, u, &unused) > before)) {
        memcpy(mesh->corner[t], corner_t, sizeof corner_t);
        memcpy(mesh->corner[u], corner_u, sizeof corner_u);
        return false;
    }
    link_edges(mesh, 3 * t, ca);
    link_edges(mesh, 3 * t + 1, ad);
    link_edges(mesh, 3 * t + 2, 3 * u + 2);
    link_edges(mesh, 3 * u, db);
    link_edges(mesh, 3 * u + 1, bc);
    return true;
}

brc_status brc_mesh_mend(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source)
{
    const double least = FLAT * mesh->size;
    bool moved = true;
    for (int round = 0; moved && round < MOST_ROUNDS; ++round) {
        moved = false;
        for (int32_t t = 0; t < mesh->n_triangles; ++t)
            if (brc_mesh_height(mesh, t, NULL) <= least && flip(mesh, t)) moved = true;
    }
    for (int32_t t = 0; t < mesh->n_triangles; ++t) {
        char place[BRC_MESH_PLACE];
        if (brc_mesh_height(mesh, t, NULL) > 0.0) continue;
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: triangle %d at %s (units of the file) has no area, and so have those around it; remove it "
                        "with a repair tool and close the mesh",
                        source->path, mesh->facet[t] + 1,
                        brc_mesh_place(source, mesh->vertex[mesh->corner[t][0]], place));
    }
    return BRC_OK;
}

brc_status brc_mesh_split_fans(brc_context *context, brc_mesh *mesh)
{
    const int64_t n = 3 * (int64_t)mesh->n_triangles;
    uint8_t *seen = NULL, *used = NULL;
    int64_t capacity = mesh->n_vertices;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &seen, n, "corners of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &used, mesh->n_vertices, "vertices of a mesh"));
    for (int64_t first = 0; first < n; ++first) {
        if (seen[first]) continue;
        const int32_t v = mesh->corner[first / 3][first % 3];
        int32_t w = v;
        if (used[v]) {
            if (mesh->n_vertices >= capacity) {
                capacity += capacity / 2 + 16;
                BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&mesh->vertex, capacity, sizeof *mesh->vertex,
                                                      "vertices of a mesh"));
            }
            w = mesh->n_vertices++;
            memcpy(mesh->vertex[w], mesh->vertex[v], sizeof *mesh->vertex);
        } else
            used[v] = 1;
        for (int32_t at = (int32_t)first; !seen[at]; at = brc_mesh_turn(mesh, at)) {
            seen[at] = 1;
            mesh->corner[at / 3][at % 3] = w;
        }
    }
cleanup:
    brc_memory_free(seen);
    brc_memory_free(used);
    return status;
}
