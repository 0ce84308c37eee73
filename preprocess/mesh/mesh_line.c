/* Lines along an axis. Seen along the line a triangle is crossed when the half-line from the point to the right crosses
 * exactly one of its edges. Whether it crosses an edge is decided in the same way, to the bit, for both triangles of
 * the edge, so every closed mesh gives an even number, also for lines through edges and vertices. */
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

/* Does the half-line from (u, v) to the right cross the edge of vertices a and b? A vertex level with the line counts
 * as below it. */
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
        if (u < (double)node->low[i] || u > (double)node->high[i] || v < (double)node->low[j] ||
            v > (double)node->high[j])
            continue;
        if (node->count == 0) {
            stack[n++] = node->next;
            stack[n++] = at + 1;
            continue;
        }
        for (int32_t t = node->next; t < node->next + node->count; ++t) {
            const int32_t *c = mesh->corner[t];
            const bool odd = crosses(mesh, c[0], c[1], i, j, u, v) !=
                             (crosses(mesh, c[1], c[2], i, j, u, v) != crosses(mesh, c[2], c[0], i, j, u, v));
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
    for (; at > 0 && l->t[at - 1] > t; --at)
        l->t[at] = l->t[at - 1];
    l->t[at] = t;
}

int32_t brc_mesh_crossings(const brc_mesh *mesh, const double x[3], int axis, double *t, int32_t most)
{
    list l = {.t = t, .most = most};
    brc_mesh_pierce(mesh, x, axis, insert, &l);
    return l.n;
}

/* Does x + t u pass the node's box with low < t < high? */
static bool meets_box(const brc_mesh_node *node, const double x[3], const double u[3], double low, double high)
{
    for (int d = 0; d < 3; ++d) {
        if (u[d] == 0.0) {
            if (x[d] < (double)node->low[d] || x[d] > (double)node->high[d]) return false;
            continue;
        }
        const double a = ((double)node->low[d] - x[d]) / u[d], b = ((double)node->high[d] - x[d]) / u[d];
        low = fmax(low, fmin(a, b));
        high = fmin(high, fmax(a, b));
    }
    return low <= high * (1.0 + 1e-12) + 1e-300;
}

/* Where the line passes triangle t, a little widened so that nothing slips through between two (T. Moeller & B.
 * Trumbore, J. Graph. Tools 2 (1997) 21). */
static bool passes(const brc_mesh *mesh, int32_t triangle, const double x[3], const double u[3], double *t)
{
    static const double WIDER = 1e-9;
    const int32_t *corner = mesh->corner[triangle];
    double ab[3], ac[3], ax[3], p[3], q[3];
    mesh_minus(mesh->vertex[corner[1]], mesh->vertex[corner[0]], ab);
    mesh_minus(mesh->vertex[corner[2]], mesh->vertex[corner[0]], ac);
    mesh_cross(u, ac, p);
    const double determinant = mesh_dot(ab, p);
    if (determinant * determinant <= 1e-24 * mesh_dot(ab, ab) * mesh_dot(p, p))
        return false; /* along the plane: its neighbours tell */
    mesh_minus(x, mesh->vertex[corner[0]], ax);
    const double v = mesh_dot(ax, p) / determinant;
    if (v < -WIDER || v > 1.0 + WIDER) return false;
    mesh_cross(ax, ab, q);
    const double w = mesh_dot(u, q) / determinant;
    if (w < -WIDER || v + w > 1.0 + WIDER) return false;
    *t = mesh_dot(ac, q) / determinant;
    return true;
}

int32_t brc_mesh_passes(const brc_mesh *mesh, const double x[3], const double u[3], double low, double high, double *t,
                        int32_t most)
{
    int32_t stack[BRC_MESH_STACK];
    int32_t n = 0, count = 0;
    stack[n++] = 0;
    while (n > 0) {
        const int32_t at = stack[--n];
        const brc_mesh_node *node = &mesh->node[at];
        if (!meets_box(node, x, u, low, high)) continue;
        if (node->count == 0) {
            stack[n++] = node->next;
            stack[n++] = at + 1;
            continue;
        }
        for (int32_t k = node->next; k < node->next + node->count; ++k) {
            double where;
            if (!passes(mesh, k, x, u, &where) || !(where > low && where < high)) continue;
            if (count < most) t[count] = where;
            ++count;
        }
    }
    return count;
}
