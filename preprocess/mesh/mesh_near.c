/* Questions about the nearest surface. The sign of a distance is that of the angle between x - foot and the normal of
 * the feature the foot lies on: a face's own, the sum of two at an edge, weighted by angles at a vertex (J. A.
 * Baerentzen & H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243: right for any closed surface). */
#include "mesh_internal.h"

#include <math.h>
#include <string.h>

/* Squared distance of x to the node's box. */
static double box_distance2(const brc_mesh_node *node, const double x[3])
{
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double below = (double)node->low[d] - x[d], above = x[d] - (double)node->high[d];
        const double gap = below > above ? below : above;
        if (gap > 0.0) sum += gap * gap;
    }
    return sum;
}

/* Is the node's disc at this squared distance of x or further? The normal is a unit vector to 1e-7 only, hence a
 * millionth to spare. */
static bool beyond(const brc_mesh_node *node, const double x[3], double distance2)
{
    double along = 0.0, arm2 = 0.0;
    if (node->half < 0.0f) return false;
    for (int d = 0; d < 3; ++d) {
        const double arm = x[d] - (double)node->centre[d];
        along += arm * (double)node->normal[d];
        arm2 += arm * arm;
    }
    const double above = fmax(0.0, fabs(along) - (double)node->half);
    const double aside = fmax(0.0, sqrt(fmax(0.0, arm2 - along * along)) - (double)node->radius);
    return (above * above + aside * aside) * (1.0 - 1e-6) >= distance2;
}

static int at_corner(const double p[3], int k, double point[3])
{
    memcpy(point, p, 3 * sizeof *point);
    return BRC_MESH_CORNER + k;
}

static int on_edge(const double from[3], const double along[3], double share, int k, double point[3])
{
    for (int d = 0; d < 3; ++d)
        point[d] = from[d] + share * along[d];
    return BRC_MESH_EDGE + k;
}

/* By the regions of the triangle's plane that belong to its corners, edges and face (C. Ericson, Real-Time Collision
 * Detection, 2005, 5.1.5). */
int brc_mesh_nearest_of(const brc_mesh *mesh, int32_t t, const double x[3], double point[3])
{
    const double *a = mesh->vertex[mesh->corner[t][0]], *b = mesh->vertex[mesh->corner[t][1]],
                 *c = mesh->vertex[mesh->corner[t][2]];
    double ab[3], ac[3], bc[3], ax[3], bx[3], cx[3];
    mesh_minus(b, a, ab);
    mesh_minus(c, a, ac);
    mesh_minus(x, a, ax);
    const double d1 = mesh_dot(ab, ax), d2 = mesh_dot(ac, ax);
    if (d1 <= 0.0 && d2 <= 0.0) return at_corner(a, 0, point);
    mesh_minus(x, b, bx);
    const double d3 = mesh_dot(ab, bx), d4 = mesh_dot(ac, bx);
    if (d3 >= 0.0 && d4 <= d3) return at_corner(b, 1, point);
    mesh_minus(x, c, cx);
    const double d5 = mesh_dot(ab, cx), d6 = mesh_dot(ac, cx);
    if (d6 >= 0.0 && d5 <= d6) return at_corner(c, 2, point);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return on_edge(a, ab, d1 / (d1 - d3), 0, point);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return on_edge(a, ac, d2 / (d2 - d6), 2, point);
    const double va = d3 * d6 - d5 * d4;
    mesh_minus(c, b, bc);
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) return on_edge(b, bc, (d4 - d3) / ((d4 - d3) + (d5 - d6)), 1, point);
    const double share = 1.0 / (va + vb + vc), v = vb * share, w = vc * share;
    for (int d = 0; d < 3; ++d)
        point[d] = a[d] + v * ab[d] + w * ac[d];
    return BRC_MESH_FACE;
}

typedef struct candidate {
    double distance2;
    double point[3];
    int32_t triangle, patch;
    int feature;
} candidate;

static void try_triangle(const brc_mesh *mesh, int32_t t, const double x[3], candidate *best)
{
    double point[3], gap[3];
    const int feature = brc_mesh_nearest_of(mesh, t, x, point);
    mesh_minus(x, point, gap);
    const double distance2 = mesh_dot(gap, gap);
    if (!(distance2 < best->distance2)) return;
    best->distance2 = distance2;
    best->triangle = t;
    best->feature = feature;
    memcpy(best->point, point, sizeof best->point);
}

typedef struct open_node {
    int32_t node;
    double distance2;
} open_node;

static void nearest(const brc_mesh *mesh, const double x[3], candidate *best)
{
    open_node stack[BRC_MESH_STACK];
    int n = 0;
    stack[n++] = (open_node){0, box_distance2(&mesh->node[0], x)};
    while (n > 0) {
        const open_node top = stack[--n];
        if (!(top.distance2 < best->distance2)) continue;
        const brc_mesh_node *node = &mesh->node[top.node];
        if (beyond(node, x, best->distance2)) continue;
        if (node->count > 0) {
            for (int32_t t = node->next; t < node->next + node->count; ++t)
                try_triangle(mesh, t, x, best);
            continue;
        }
        const open_node a = {top.node + 1, box_distance2(node + 1, x)},
                        b = {node->next, box_distance2(&mesh->node[node->next], x)};
        const bool a_first = a.distance2 <= b.distance2;
        stack[n++] = a_first ? b : a;
        stack[n++] = a_first ? a : b;
    }
}

/* The distance to the nearest point found, with its sign. */
static double signed_distance(const brc_mesh *mesh, const double x[3], const candidate *best)
{
    double normal[3], gap[3];
    const int32_t t = best->triangle;
    memcpy(normal, mesh->normal[t], sizeof normal);
    if (best->feature >= BRC_MESH_CORNER)
        memcpy(normal, mesh->vertex_normal[mesh->corner[t][best->feature - BRC_MESH_CORNER]], sizeof normal);
    else if (best->feature >= BRC_MESH_EDGE)
        for (int d = 0; d < 3; ++d)
            normal[d] += mesh->normal[mesh->across[t][best->feature - BRC_MESH_EDGE] / 3][d];
    mesh_minus(x, best->point, gap);
    const double distance = sqrt(best->distance2);
    return mesh_dot(gap, normal) > 0.0 ? -distance : distance;
}

double brc_mesh_depth(const brc_mesh *mesh, const double x[3])
{
    candidate best = {.distance2 = HUGE_VAL};
    nearest(mesh, x, &best);
    return signed_distance(mesh, x, &best);
}

/* Crossings of a line before the point. In doubt when one is so flat to the line that its place is not sure. */
typedef struct parity {
    const brc_mesh *mesh;
    bool odd, doubt;
} parity;

static void count(void *of, int32_t triangle, double t)
{
    parity *p = of;
    double area[3];
    brc_mesh_area_vector(p->mesh, triangle, area);
    p->doubt = p->doubt || area[0] * area[0] <= 1e-16 * mesh_dot(area, area);
    p->odd = p->odd != (t < 0.0);
}

/* Near the surface its nearest point decides; else a line does, which is cheaper than to find the nearest point far
 * away. */
bool brc_mesh_inside(const brc_mesh *mesh, const double x[3])
{
    for (int d = 0; d < 3; ++d)
        if (!(x[d] >= mesh->bounds[0][d] && x[d] <= mesh->bounds[1][d])) return false;
    const double near = 1e-6 * mesh->size;
    candidate best = {.distance2 = near * near, .triangle = -1};
    nearest(mesh, x, &best);
    if (best.triangle >= 0) return signed_distance(mesh, x, &best) >= 0.0;
    parity p = {.mesh = mesh};
    brc_mesh_pierce(mesh, x, 0, count, &p);
    return p.doubt ? brc_mesh_depth(mesh, x) >= 0.0 : p.odd;
}

/* The candidates of a window of patches, ascending: those above `after`, the first WINDOW of them. */
enum { WINDOW = 256 };
typedef struct window {
    candidate of[WINDOW];
    int32_t n, after;
    bool more; /* patches beyond the window were met */
} window;

/* Where patch p stands, or should. */
static int32_t find_patch(const window *w, int32_t p)
{
    int32_t low = 0, high = w->n;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (w->of[middle].patch < p)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void offer(const brc_mesh *mesh, int32_t t, const double x[3], double reach2, window *w)
{
    const int32_t p = mesh->patch[t];
    if (p <= w->after) return;
    const int32_t at = find_patch(w, p);
    if (at < w->n && w->of[at].patch == p) {
        try_triangle(mesh, t, x, &w->of[at]);
        return;
    }
    candidate found = {.distance2 = reach2, .patch = p, .triangle = -1};
    try_triangle(mesh, t, x, &found);
    if (found.triangle < 0) return;
    if (w->n == WINDOW) {
        w->more = true;
        if (at == WINDOW) return;
        --w->n;
    }
    memmove(&w->of[at + 1], &w->of[at], (size_t)(w->n - at) * sizeof w->of[0]);
    w->of[at] = found;
    ++w->n;
}

/* Can this node hold something new? */
static bool worth(const brc_mesh_node *node, const double x[3], double distance2, double reach2, const window *w)
{
    double limit2 = reach2;
    if (node->patch >= 0) {
        if (node->patch <= w->after) return false;
        const int32_t at = find_patch(w, node->patch);
        if (at < w->n && w->of[at].patch == node->patch) limit2 = w->of[at].distance2;
    }
    return distance2 < limit2 && !beyond(node, x, limit2);
}

/* Stops when the window holds more than `most`. */
static void gather(const brc_mesh *mesh, const double x[3], double reach2, int32_t most, window *w)
{
    open_node stack[BRC_MESH_STACK];
    int n = 0;
    stack[n++] = (open_node){0, box_distance2(&mesh->node[0], x)};
    while (n > 0 && w->n <= most) {
        const open_node top = stack[--n];
        const brc_mesh_node *node = &mesh->node[top.node];
        if (!worth(node, x, top.distance2, reach2, w)) continue;
        if (node->count > 0) {
            for (int32_t t = node->next; t < node->next + node->count; ++t)
                offer(mesh, t, x, reach2, w);
            continue;
        }
        const open_node a = {top.node + 1, box_distance2(node + 1, x)},
                        b = {node->next, box_distance2(&mesh->node[node->next], x)};
        const bool a_first = a.distance2 <= b.distance2;
        stack[n++] = a_first ? b : a;
        stack[n++] = a_first ? a : b;
    }
}

/* The bits of the sharp edges that belong to the patch of `corner` and end at its vertex, of all its triangles: as if
 * they were edges 0. */
static unsigned rim_at(const brc_mesh *mesh, int32_t corner)
{
    const int32_t patch = mesh->patch[corner / 3];
    unsigned bits = 0;
    int32_t at = corner;
    do {
        const int32_t t = at / 3, out = at % 3, in = (out + 2) % 3;
        if (mesh->patch[t] == patch) bits |= (mesh->flags[t] >> out & 9u) | (mesh->flags[t] >> in & 9u);
        at = brc_mesh_turn(mesh, at);
    } while (at != corner);
    return bits;
}

static void make_foot(const brc_mesh *mesh, const candidate *c, brc_mesh_foot *foot)
{
    unsigned bits = 0;
    if (c->feature >= BRC_MESH_CORNER)
        bits = rim_at(mesh, 3 * c->triangle + c->feature - BRC_MESH_CORNER);
    else if (c->feature >= BRC_MESH_EDGE)
        bits = mesh->flags[c->triangle] >> (c->feature - BRC_MESH_EDGE);
    memcpy(foot->point, c->point, sizeof foot->point);
    memcpy(foot->normal, mesh->normal[c->triangle], sizeof foot->normal);
    foot->distance = sqrt(c->distance2);
    foot->on_edge = (bits & BRC_MESH_SHARP(0)) != 0;
    foot->concave = (bits & BRC_MESH_CONCAVE(0)) != 0;
    foot->flat = mesh->patch_flat[c->patch];
    foot->patch = c->patch;
}

int32_t brc_mesh_feet(const brc_mesh *mesh, const double x[3], double reach, brc_mesh_foot *feet, int32_t most)
{
    window w;
    int32_t n = 0;
    if (!(reach > 0.0)) return 0;
    w.after = -1;
    do {
        w.n = 0;
        w.more = false;
        gather(mesh, x, reach * reach, most - n, &w);
        if (w.n > most - n || (w.more && w.n >= most - n)) return most + 1;
        for (int32_t k = 0; k < w.n; ++k)
            make_foot(mesh, &w.of[k], &feet[n++]);
        if (w.n > 0) w.after = w.of[w.n - 1].patch;
    } while (w.more);
    return n;
}

double brc_mesh_distance(const brc_mesh *mesh, const double x[3], double reach)
{
    candidate best = {.distance2 = reach * reach, .triangle = -1};
    nearest(mesh, x, &best);
    return best.triangle < 0 ? reach : sqrt(best.distance2);
}
