/* Lines along an axis. Seen along the line a triangle is crossed when the half-line from the point to the right crosses exactly one of its edges.
 * Whether it crosses an edge is decided in the same way, to the bit, for both triangles of the edge, so every closed mesh gives an even
 * number, also for lines through edges and vertices. */
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

/* Does the half-line from (u, v) to the right cross the edge of vertices a and b? A vertex level with the line counts as below it. */
static bool crosses(const brc_mesh *mesh, int32_t a, int32_t b, int i, int j, double u, double v)
{
    const bool a_above = mesh->vertex[a][j] > v;
    if (a_above == (mesh->vertex[b][j] > v)) return false;
    const double *low = mesh->vertex[a_above ? b : a], *high = mesh->vertex[a_above ? a : b];
    if (u < low[i] && u < high[i]) return true;
    if (u >= low[i] && u >= high[i]) return false;
    return (high[i] - low[i]) * (v - low[j]) - (high[j] - low[j]) * (u - low[i]) > 0.0;
}

/* Where the line meets the triangle's plane, kept within the triangle's extent. */
static double meet(const brc_mesh *mesh, int32_t t, const double x[3], int axis)
{
    const int32_t *corner = mesh->corner[t];
    const double *a = mesh->vertex[corner[0]];
    double area[3], low = HUGE_VAL, high = -HUGE_VAL, gap[3];
    for (int k = 0; k < 3; ++k) {
        low = fmin(low, mesh->vertex[corner[k]][axis]);
        high = fmax(high, mesh->vertex[corner[k]][axis]);
    }
    brc_mesh_area_vector(mesh, t, area);
    mesh_minus(a, x, gap);
    const double where = area[axis] != 0.0 ? mesh_dot(area, gap) / area[axis] : gap[axis];
    return fmax(low - x[axis], fmin(high - x[axis], where));
}

void brc_mesh_pierce(const brc_mesh *mesh, const double x[3], int axis, brc_mesh_hit *hit, void *of)
{
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double u = x[i], v = x[j];
    int32_t stack[BRC_MESH_STACK];
    int n = 0;
    stack[n++] = 0;
    while (n > 0) {
        const int32_t at = stack[--n];
        const brc_mesh_node *node = &mesh->node[at];
        if (u < (double)node->low[i] || u > (double)node->high[i] || v < (double)node->low[j] || v > (double)node->high[j]) continue;
        if (node->count == 0) {
            stack[n++] = node->next;
            stack[n++] = at + 1;
            continue;
        }
        for (int32_t t = node->next; t < node->next + node->count; ++t) {
            const int32_t *c = mesh->corner[t];
            const bool odd = crosses(mesh, c[0], c[1], i, j, u, v) != (crosses(mesh, c[1], c[2], i, j, u, v) != crosses(mesh, c[2], c[0], i, j, u, v));
            if (odd) hit(of, t, meet(mesh, t, x, axis));
        }
    }
}

typedef struct list {
    double *t;
    int32_t n, most;
} list;

/* Keep the smallest, ascending. */
static void insert(void *of, int32_t triangle, double t)
{
    list *l = of;
    (void)triangle;
    int32_t at = l->n < l->most ? l->n : l->most;
    ++l->n;
    if (at == l->most) {
        if (at == 0 || l->t[at - 1] <= t) return;
        --at;
    }
    for (; at > 0 && l->t[at - 1] > t; --at) l->t[at] = l->t[at - 1];
    l->t[at] = t;
}

int32_t brc_mesh_crossings(const brc_mesh *mesh, const double x[3], int axis, double *t, int32_t most)
{
    list l = {.t = t, .most = most};
    brc_mesh_pierce(mesh, x, axis, insert, &l);
    return l.n;
}
