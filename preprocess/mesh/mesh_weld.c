/* One vertex for equal corners: first those that are equal to the bit, then those within 1e-9 of the mesh's size of an
 * earlier one. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

static const double WELD = 1e-9; /* of the size */

typedef struct table {
    int32_t *slot; /* vertex + 1, 0: free */
    uint64_t mask;
} table;

static uint64_t mix(uint64_t a, uint64_t b, uint64_t c)
{
    uint64_t h = a * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ b) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 31) ^ c) * 0x94d049bb133111ebu;
    return h ^ (h >> 30);
}

static brc_status make_table(brc_context *context, int64_t n, table *out)
{
    uint64_t size = 16;
    while (size < (uint64_t)n + (uint64_t)n / 2)
        size *= 2;
    out->mask = size - 1;
    return BRC_ALLOCATE(context, &out->slot, size, "table of a mesh's vertices");
}

/* Give every corner its vertex; distinct points are moved to the front of `point`. Returns how many. */
static int32_t weld_equal(double (*point)[3], int64_t n, const table *of, int32_t *vertex)
{
    int32_t n_vertices = 0;
    for (int64_t k = 0; k < n; ++k) {
        uint64_t word[3];
        for (int d = 0; d < 3; ++d)
            point[k][d] += 0.0; /* -0 becomes 0 */
        memcpy(word, point[k], sizeof word);
        uint64_t at = mix(word[0], word[1], word[2]) & of->mask;
        while (of->slot[at] && memcmp(point[of->slot[at] - 1], word, sizeof word) != 0)
            at = (at + 1) & of->mask;
        if (!of->slot[at]) {
            memcpy(point[n_vertices], word, sizeof word);
            of->slot[at] = ++n_vertices;
        }
        vertex[k] = of->slot[at] - 1;
    }
    return n_vertices;
}

/* The cell of a coordinate: four reaches wide, counted from the mesh's smallest corner. */
static int64_t cell_of(const brc_mesh *mesh, double x, int d)
{
    return (int64_t)floor((x - mesh->bounds[0][d]) / (4.0 * WELD * mesh->size));
}

/* The earliest kept vertex within reach of vertex v, or -1. Kept vertices stand in the slots of their cells. */
static int32_t find_near(const brc_mesh *mesh, int32_t v, const table *of)
{
    const double *p = mesh->vertex[v], reach = WELD * mesh->size;
    int64_t low[3], high[3];
    int32_t found = -1;
    for (int d = 0; d < 3; ++d) {
        low[d] = cell_of(mesh, p[d] - reach, d);
        high[d] = cell_of(mesh, p[d] + reach, d);
    }
    for (int64_t x = low[0]; x <= high[0]; ++x)
        for (int64_t y = low[1]; y <= high[1]; ++y)
            for (int64_t z = low[2]; z <= high[2]; ++z)
                for (uint64_t at = mix((uint64_t)x, (uint64_t)y, (uint64_t)z) & of->mask; of->slot[at];
                     at = (at + 1) & of->mask) {
                    const int32_t w = of->slot[at] - 1;
                    double gap[3];
                    mesh_minus(mesh->vertex[w], p, gap);
                    if (mesh_dot(gap, gap) <= reach * reach && (found < 0 || w < found)) found = w;
                }
    return found;
}

static void keep(const brc_mesh *mesh, int32_t v, const table *of)
{
    uint64_t cell[3];
    for (int d = 0; d < 3; ++d)
        cell[d] = (uint64_t)cell_of(mesh, mesh->vertex[v][d], d);
    uint64_t at = mix(cell[0], cell[1], cell[2]) & of->mask;
    while (of->slot[at])
        at = (at + 1) & of->mask;
    of->slot[at] = v + 1;
}

void brc_mesh_measure(brc_mesh *mesh)
{
    for (int d = 0; d < 3; ++d) {
        mesh->bounds[0][d] = HUGE_VAL;
        mesh->bounds[1][d] = -HUGE_VAL;
    }
    for (int64_t v = 0; v < mesh->n_vertices; ++v)
        for (int d = 0; d < 3; ++d) {
            mesh->bounds[0][d] = fmin(mesh->bounds[0][d], mesh->vertex[v][d]);
            mesh->bounds[1][d] = fmax(mesh->bounds[1][d], mesh->vertex[v][d]);
        }
    double diagonal[3];
    mesh_minus(mesh->bounds[1], mesh->bounds[0], diagonal);
    mesh->size = sqrt(mesh_dot(diagonal, diagonal));
}

/* Keep triangles with three different corners. */
static void drop_degenerate(brc_mesh *mesh, int32_t n_facets)
{
    int32_t n = 0;
    for (int32_t t = 0; t < n_facets; ++t) {
        const int32_t a = mesh->corner[t][0], b = mesh->corner[t][1], c = mesh->corner[t][2];
        if (a == b || b == c || c == a) continue;
        mesh->corner[n][0] = a;
        mesh->corner[n][1] = b;
        mesh->corner[n][2] = c;
        mesh->facet[n++] = t;
    }
    mesh->n_triangles = n;
}

brc_status brc_mesh_weld(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source, double (*corner)[3],
                         int32_t n_facets)
{
    brc_status status = BRC_OK;
    table of = {0};
    int32_t *merged = NULL;
    mesh->vertex = corner;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->corner, n_facets, "triangles of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->facet, n_facets, "triangles of a mesh"));
    BRC_TRY_OR(cleanup, make_table(context, 3 * (int64_t)n_facets, &of));
    mesh->n_vertices = weld_equal(corner, 3 * (int64_t)n_facets, &of, &mesh->corner[0][0]);
    brc_memory_free(of.slot);
    of.slot = NULL;
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&mesh->vertex, mesh->n_vertices, sizeof *mesh->vertex,
                                          "vertices of a mesh"));
    brc_mesh_measure(mesh);
    if (!(mesh->size > 0.0)) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: all corners are one point; export a part that has a volume",
                          source->path);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, make_table(context, mesh->n_vertices, &of));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &merged, mesh->n_vertices, "vertices of a mesh"));
    int64_t n_merged = 0;
    for (int32_t v = 0; v < mesh->n_vertices; ++v) {
        const int32_t near = find_near(mesh, v, &of);
        merged[v] = near < 0 ? v : near;
        if (near < 0)
            keep(mesh, v, &of);
        else
            ++n_merged;
    }
    if (n_merged > 0)
        for (int64_t k = 0; k < 3 * (int64_t)n_facets; ++k)
            mesh->corner[k / 3][k % 3] = merged[mesh->corner[k / 3][k % 3]];
    drop_degenerate(mesh, n_facets);
    if (mesh->n_triangles == 0)
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: every triangle has two equal corners; export a part that has a volume", source->path);
cleanup:
    brc_memory_free(of.slot);
    brc_memory_free(merged);
    return status;
}
