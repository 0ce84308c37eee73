/* A tree of boxes over the triangles. Nodes halve the box of the centroids where that leaves a quarter of the triangles
 * on each side, else the triangles. Triangles, and vertices by first use, are then put in the order of the tree, so
 * that what is near in space is near in memory. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

enum { LEAF = 4, MOST_OF_DISC = 512 };

typedef struct item {
    float centroid[3];
    int32_t triangle;
} item;

typedef struct planter {
    item *items;
    brc_mesh_node *node;
    int32_t n_nodes;
} planter;

/* Put the `middle` smallest centroids along d first (Hoare's quickselect; pivot: the median of three). */
static void select_items(item *items, int32_t n, int32_t middle, int d)
{
    int32_t low = 0, high = n - 1;
    while (low < high) {
        const float a = items[low].centroid[d], b = items[low + (high - low) / 2].centroid[d],
                    c = items[high].centroid[d];
        const float pivot = fmaxf(fminf(a, b), fminf(fmaxf(a, b), c));
        int32_t i = low, j = high;
        while (i <= j) {
            while (items[i].centroid[d] < pivot)
                ++i;
            while (items[j].centroid[d] > pivot)
                --j;
            if (i > j) break;
            const item swap = items[i];
            items[i++] = items[j];
            items[j--] = swap;
        }
        if (middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            return;
    }
}

static int32_t split(item *items, int32_t n)
{
    float low[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF}, high[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    for (int32_t i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d) {
            low[d] = fminf(low[d], items[i].centroid[d]);
            high[d] = fmaxf(high[d], items[i].centroid[d]);
        }
    int d = 0;
    for (int k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[d] - low[d]) d = k;
    const float centre = low[d] + 0.5f * (high[d] - low[d]);
    int32_t left = 0;
    for (int32_t i = 0; i < n; ++i)
        if (items[i].centroid[d] < centre) {
            const item swap = items[i];
            items[i] = items[left];
            items[left++] = swap;
        }
    if (left >= n / 4 && n - left >= n / 4 && left > 0 && left < n) return left;
    select_items(items, n, n / 2, d);
    return n / 2;
}

static void grow(planter *p, int32_t first, int32_t n)
{
    brc_mesh_node *node = &p->node[p->n_nodes++];
    node->patch = -1;
    if (n <= LEAF) {
        node->next = first;
        node->count = n;
        return;
    }
    const int32_t left = split(p->items + first, n);
    grow(p, first, left);
    node->next = p->n_nodes;
    grow(p, first + left, n - left);
}

static float down(double x)
{
    const float value = (float)x;
    return (double)value > x ? nextafterf(value, -HUGE_VALF) : value;
}

static float up(double x)
{
    const float value = (float)x;
    return (double)value < x ? nextafterf(value, HUGE_VALF) : value;
}

/* Children stand behind their node: from the last node to the first every box is known when it is asked for. */
static void fit_boxes(brc_mesh *mesh)
{
    for (int32_t i = mesh->n_nodes - 1; i >= 0; --i) {
        brc_mesh_node *node = &mesh->node[i];
        if (node->count == 0) {
            const brc_mesh_node *a = node + 1, *b = &mesh->node[node->next];
            for (int d = 0; d < 3; ++d) {
                node->low[d] = fminf(a->low[d], b->low[d]);
                node->high[d] = fmaxf(a->high[d], b->high[d]);
            }
            continue;
        }
        for (int d = 0; d < 3; ++d) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (int32_t t = node->next; t < node->next + node->count; ++t)
                for (int k = 0; k < 3; ++k) {
                    const double x = mesh->vertex[mesh->corner[t][k]][d];
                    low = fmin(low, x);
                    high = fmax(high, x);
                }
            node->low[d] = down(low);
            node->high[d] = up(high);
        }
    }
}

/* New triangle i is old triangle items[i]. */
static brc_status reorder_triangles(brc_context *context, brc_mesh *mesh, const item *items)
{
    const int32_t n = mesh->n_triangles;
    int32_t(*corner)[3] = NULL, (*across)[3] = NULL, *facet = NULL, *shell = NULL, *place = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &corner, n, "triangles of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &across, n, "edges of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &facet, n, "triangles of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &shell, n, "shells of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &place, n, "triangles of a mesh"));
    for (int32_t i = 0; i < n; ++i)
        place[items[i].triangle] = i;
    for (int32_t i = 0; i < n; ++i) {
        const int32_t t = items[i].triangle;
        memcpy(corner[i], mesh->corner[t], sizeof corner[i]);
        for (int k = 0; k < 3; ++k)
            across[i][k] = 3 * place[mesh->across[t][k] / 3] + mesh->across[t][k] % 3;
        facet[i] = mesh->facet[t];
        shell[i] = mesh->shell[t];
    }
    brc_memory_free(mesh->corner);
    brc_memory_free(mesh->across);
    brc_memory_free(mesh->facet);
    brc_memory_free(mesh->shell);
    mesh->corner = corner;
    mesh->across = across;
    mesh->facet = facet;
    mesh->shell = shell;
    corner = across = NULL;
    facet = shell = NULL;
cleanup:
    brc_memory_free(corner);
    brc_memory_free(across);
    brc_memory_free(facet);
    brc_memory_free(shell);
    brc_memory_free(place);
    return status;
}

static brc_status reorder_vertices(brc_context *context, brc_mesh *mesh)
{
    int32_t *place = NULL, n = 0;
    double(*vertex)[3] = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &place, mesh->n_vertices,
                                     "vertices of a mesh")); /* new number + 1; 0: not used yet */
    for (int64_t k = 0; k < 3 * (int64_t)mesh->n_triangles; ++k) {
        int32_t *v = &mesh->corner[k / 3][k % 3];
        if (place[*v] == 0) place[*v] = ++n;
        *v = place[*v] - 1;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &vertex, n, "vertices of a mesh"));
    for (int32_t v = 0; v < mesh->n_vertices; ++v)
        if (place[v]) memcpy(vertex[place[v] - 1], mesh->vertex[v], sizeof *vertex);
    brc_memory_free(mesh->vertex);
    mesh->vertex = vertex;
    mesh->n_vertices = n;
cleanup:
    brc_memory_free(place);
    return status;
}

/* The disc of n triangles from `first`: about the mean of their corners, along the sum of their area vectors. */
static void fit_disc(const brc_mesh *mesh, int32_t first, int32_t n, brc_mesh_node *node)
{
    double centre[3] = {0.0, 0.0, 0.0}, normal[3] = {0.0, 0.0, 0.0}, half = 0.0, radius = 0.0;
    for (int32_t t = first; t < first + n; ++t) {
        double area[3];
        brc_mesh_area_vector(mesh, t, area);
        for (int d = 0; d < 3; ++d) {
            normal[d] += area[d];
            for (int k = 0; k < 3; ++k)
                centre[d] += mesh->vertex[mesh->corner[t][k]][d] / (3.0 * n);
        }
    }
    const double length = sqrt(mesh_dot(normal, normal));
    for (int d = 0; d < 3; ++d) {
        node->centre[d] = (float)centre[d];
        node->normal[d] = length > 0.0 ? (float)(normal[d] / length) : 0.0f;
        centre[d] = (double)node->centre[d]; /* as it will be used */
        normal[d] = (double)node->normal[d];
    }
    for (int32_t t = first; t < first + n; ++t)
        for (int k = 0; k < 3; ++k) {
            double arm[3];
            mesh_minus(mesh->vertex[mesh->corner[t][k]], centre, arm);
            const double along = mesh_dot(arm, normal);
            half = fmax(half, fabs(along));
            radius = fmax(radius, mesh_dot(arm, arm) - along * along);
        }
    node->half = up(half);
    node->radius =
        up(sqrt(fmax(radius, 0.0)) * (1.0 + 1e-6) + 1e-3 * half); /* the normal is a unit vector to 1e-7 only */
}

static brc_status fit_discs(brc_context *context, brc_mesh *mesh)
{
    int32_t(*range)[2] = NULL; /* first triangle and number */
    BRC_TRY(BRC_ALLOCATE(context, &range, mesh->n_nodes, "tree of a mesh"));
    for (int32_t i = mesh->n_nodes - 1; i >= 0; --i) {
        brc_mesh_node *node = &mesh->node[i];
        range[i][0] = node->count ? node->next : range[i + 1][0];
        range[i][1] = node->count ? node->count : range[i + 1][1] + range[node->next][1];
        node->half = -1.0f;
        if (range[i][1] <= MOST_OF_DISC) fit_disc(mesh, range[i][0], range[i][1], node);
    }
    brc_memory_free(range);
    return BRC_OK;
}

brc_status brc_mesh_plant(brc_context *context, brc_mesh *mesh)
{
    planter p = {0};
    brc_status status = BRC_OK;
    const int32_t n = mesh->n_triangles;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &p.items, n, "tree of a mesh"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &p.node, (int64_t)n + n / 7 + 1,
                                     "tree of a mesh")); /* most: 4 leaves of 7 triangles */
    for (int32_t t = 0; t < n; ++t) {
        p.items[t].triangle = t;
        for (int d = 0; d < 3; ++d) {
            double sum = 0.0;
            for (int k = 0; k < 3; ++k)
                sum += mesh->vertex[mesh->corner[t][k]][d] - mesh->bounds[0][d];
            p.items[t].centroid[d] = (float)(sum / mesh->size);
        }
    }
    grow(&p, 0, n);
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&p.node, p.n_nodes, sizeof *p.node, "tree of a mesh"));
    mesh->node = p.node;
    mesh->n_nodes = p.n_nodes;
    p.node = NULL;
    BRC_TRY_OR(cleanup, reorder_triangles(context, mesh, p.items));
    BRC_TRY_OR(cleanup, reorder_vertices(context, mesh));
    brc_mesh_measure(mesh); /* corners of dropped triangles alone are gone */
    fit_boxes(mesh);
    BRC_TRY_OR(cleanup, fit_discs(context, mesh));
cleanup:
    brc_memory_free(p.items);
    brc_memory_free(p.node);
    return status;
}
