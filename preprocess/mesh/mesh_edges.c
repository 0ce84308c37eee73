/* Which triangles meet at an edge: every edge of a closed surface has two. Then one side is made outside for all: a
 * triangle whose neighbours see it from the other side is turned, spreading over the surface. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { OPEN_WORDS = 192 };
/* Vertices so much nearer to each other than an edge is long were meant to be one. */
#define NEARLY_CLOSED 0.1

static int by_key(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void ends(const brc_mesh *mesh, int64_t h, int32_t *low, int32_t *high)
{
    const int32_t *corner = mesh->corner[h / 3];
    const int32_t a = corner[h % 3], b = corner[(h + 1) % 3];
    *low = a < b ? a : b;
    *high = a < b ? b : a;
}

/* Half-edges by their smaller vertex: key (larger vertex, half-edge) in rows of the smaller one. */
static brc_status sort_half_edges(brc_context *context, const brc_mesh *mesh, int64_t **start, uint64_t **key)
{
    const int64_t n = 3 * (int64_t)mesh->n_triangles;
    int32_t low, high;
    BRC_TRY(BRC_ALLOCATE(context, start, mesh->n_vertices + 2, "edges of a mesh"));
    BRC_TRY(BRC_ALLOCATE(context, key, n, "edges of a mesh"));
    for (int64_t h = 0; h < n; ++h) {
        ends(mesh, h, &low, &high);
        ++(*start)[low + 2];
    }
    for (int64_t v = 0; v < mesh->n_vertices; ++v)
        (*start)[v + 2] += (*start)[v + 1];
    for (int64_t h = 0; h < n; ++h) { /* start[v + 1] moves from the row's begin to its end */
        ends(mesh, h, &low, &high);
        (*key)[(*start)[low + 1]++] = (uint64_t)high << 32 | (uint64_t)h;
    }
    for (int64_t v = 0; v < mesh->n_vertices; ++v)
        qsort(*key + (*start)[v], (size_t)((*start)[v + 1] - (*start)[v]), sizeof **key, by_key);
    return BRC_OK;
}

/* Edges that have not two triangles. */
typedef struct fault {
    int64_t n, first; /* how many; the first half-edge of one in the order of the file, -1: none */
    int64_t triangles;
} fault;

static void note(fault *of, int64_t half_edge, int64_t triangles)
{
    ++of->n;
    if (of->first >= 0 && of->first < half_edge) return;
    of->first = half_edge;
    of->triangles = triangles;
}

static void join(brc_mesh *mesh, const int64_t *start, const uint64_t *key, fault *open, fault *crowded)
{
    for (int64_t v = 0; v < mesh->n_vertices; ++v)
        for (int64_t i = start[v], j; i < start[v + 1]; i = j) {
            for (j = i + 1; j < start[v + 1] && key[j] >> 32 == key[i] >> 32;)
                ++j;
            const int64_t g = (int64_t)(key[i] & 0xffffffffu);
            if (j - i == 1)
                note(open, g, 1);
            else if (j - i > 2)
                note(crowded, g, j - i);
            else {
                const int64_t h = (int64_t)(key[i + 1] & 0xffffffffu);
                mesh->across[g / 3][g % 3] = (int32_t)h;
                mesh->across[h / 3][h % 3] = (int32_t)g;
            }
        }
}

/* Distance from vertex v to the nearest other one [m]. */
static double nearest_vertex(const brc_mesh *mesh, int32_t v)
{
    double least = HUGE_VAL;
    for (int32_t w = 0; w < mesh->n_vertices; ++w) {
        double gap[3];
        mesh_minus(mesh->vertex[w], mesh->vertex[v], gap);
        if (w != v) least = fmin(least, mesh_dot(gap, gap));
    }
    return sqrt(least);
}

/* Open edges whose ends lie next to other vertices were meant to be closed: what to say of it. */
static void explain_open(const brc_mesh *mesh, const brc_mesh_source *source, int32_t a, int32_t b,
                         char words[OPEN_WORDS])
{
    double along[3];
    mesh_minus(mesh->vertex[b], mesh->vertex[a], along);
    const double apart = fmax(nearest_vertex(mesh, a), nearest_vertex(mesh, b));
    words[0] = 0;
    if (apart < NEARLY_CLOSED * sqrt(mesh_dot(along, along)))
        snprintf(words, OPEN_WORDS,
                 "; its ends lie only %.2g from other vertices: merge vertices nearer than that (here only those "
                 "within 1e-9 of the size are one)",
                 apart / source->scale);
}

brc_status brc_mesh_join_edges(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source)
{
    int64_t *start = NULL;
    uint64_t *key = NULL;
    brc_status status = BRC_OK;
    char from[BRC_MESH_PLACE], to[BRC_MESH_PLACE];
    fault open = {.first = -1}, crowded = {.first = -1};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->across, mesh->n_triangles, "edges of a mesh"));
    BRC_TRY_OR(cleanup, sort_half_edges(context, mesh, &start, &key));
    join(mesh, start, key, &open, &crowded);
    if (open.n > 0) {
        const int32_t *corner = mesh->corner[open.first / 3];
        char words[OPEN_WORDS];
        explain_open(mesh, source, corner[open.first % 3], corner[(open.first + 1) % 3], words);
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: the mesh is open: %lld edges have one triangle only, the first from %s to %s (units of "
                          "the file)%s; close the mesh in your CAD "
                          "program or with a repair tool",
                          source->path, (long long)open.n,
                          brc_mesh_place(source, mesh->vertex[corner[open.first % 3]], from),
                          brc_mesh_place(source, mesh->vertex[corner[(open.first + 1) % 3]], to), words);
    }
    if (crowded.n > 0) {
        const int32_t *corner = mesh->corner[crowded.first / 3];
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: %lld edges have more than two triangles, the first %lld, from %s to %s (units of the "
                          "file): inner walls, double faces, or parts "
                          "that touch along an edge; unite the parts or remove the inner walls in your CAD program or "
                          "with a repair tool",
                          source->path, (long long)crowded.n, (long long)crowded.triangles,
                          brc_mesh_place(source, mesh->vertex[corner[crowded.first % 3]], from),
                          brc_mesh_place(source, mesh->vertex[corner[(crowded.first + 1) % 3]], to));
    }
cleanup:
    brc_memory_free(start);
    brc_memory_free(key);
    return status;
}

void brc_mesh_reverse(brc_mesh *mesh, const uint8_t *marked)
{
    for (int32_t t = 0; t < mesh->n_triangles; ++t) {
        int32_t *corner = mesh->corner[t], *across = mesh->across[t];
        for (int k = 0; k < 3; ++k) {
            const int32_t h = across[k];
            if (marked[h / 3]) across[k] = h - h % 3 + 2 - h % 3; /* a reversed triangle's edges 0 1 2 become 2 1 0 */
        }
        if (!marked[t]) continue;
        const int32_t c = corner[1], a = across[0];
        corner[1] = corner[2];
        corner[2] = c;
        across[0] = across[2];
        across[2] = a;
    }
}

/* Spread over one shell from its first triangle; turn[t]: 1 keep, 2 turn. Returns a half-edge whose two sides cannot
 * agree, or -1. */
static int64_t flood(const brc_mesh *mesh, int32_t first, uint8_t *turn, int32_t *queue, int32_t *n_queue)
{
    int64_t clash = -1;
    *n_queue = 0;
    queue[(*n_queue)++] = first;
    turn[first] = 1;
    for (int32_t at = 0; at < *n_queue; ++at) {
        const int32_t t = queue[at];
        for (int k = 0; k < 3; ++k) {
            const int32_t h = mesh->across[t][k], u = h / 3;
            const bool agree = mesh->corner[t][k] != mesh->corner[u][h % 3]; /* the edge runs the other way there */
            const uint8_t wanted = agree ? turn[t] : (uint8_t)(3 - turn[t]);
            if (turn[u] == 0) {
                turn[u] = wanted;
                queue[(*n_queue)++] = u;
            } else if (turn[u] != wanted && clash < 0)
                clash = 3 * (int64_t)t + k;
        }
    }
    return clash;
}

brc_status brc_mesh_orient(brc_context *context, brc_mesh *mesh, const brc_mesh_source *source)
{
    uint8_t *turn = NULL;
    int32_t *queue = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &turn, mesh->n_triangles, "orientation of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &queue, mesh->n_triangles, "orientation of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &mesh->shell, mesh->n_triangles, "shells of a mesh"));
    for (int32_t first = 0; first < mesh->n_triangles; ++first) {
        if (turn[first]) continue;
        int32_t n, n_turned = 0;
        const int64_t clash = flood(mesh, first, turn, queue, &n);
        if (clash >= 0) {
            char from[BRC_MESH_PLACE], to[BRC_MESH_PLACE];
            const int32_t *corner = mesh->corner[clash / 3];
            status = BRC_FAIL(context, BRC_BAD_INPUT,
                              "%s: the surface has no outside: its triangles cannot be oriented alike around the edge "
                              "from %s to %s (units of the file), as on "
                              "a Moebius strip; rebuild the surface in your CAD program",
                              source->path, brc_mesh_place(source, mesh->vertex[corner[clash % 3]], from),
                              brc_mesh_place(source, mesh->vertex[corner[(clash + 1) % 3]], to));
            goto cleanup;
        }
        for (int32_t i = 0; i < n; ++i)
            n_turned += turn[queue[i]] == 2;
        for (int32_t i = 0; i < n; ++i) {
            mesh->shell[queue[i]] = mesh->n_shells;
            if (2 * (int64_t)n_turned > n) turn[queue[i]] = (uint8_t)(3 - turn[queue[i]]);
        }
        ++mesh->n_shells;
    }
    for (int32_t t = 0; t < mesh->n_triangles; ++t)
        turn[t] = turn[t] == 2;
    brc_mesh_reverse(mesh, turn);
cleanup:
    brc_memory_free(turn);
    brc_memory_free(queue);
    return status;
}
