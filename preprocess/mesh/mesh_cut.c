/* Triangles that cut each other. Two triangles are apart when some direction separates them: their normals, the
 * products of their edges, and the normals of edges in their planes. Far neighbours must be apart by more than the
 * rounding of the file; those that share a vertex, or nearly do, must not reach into each other by more than that. */
#include "../../host/base/memory.h"
#include "mesh_internal.h"

#include <math.h>
#include <omp.h>
#include <string.h>

typedef struct pair {
    const double *a[3], *b[3];
    double edge_a[3][3], edge_b[3][3], normal_a[3], normal_b[3];
} pair;

/* How far the triangles reach into each other along a direction; negative: the gap between them. */
static double reach_in(const pair *p, const double direction[3])
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    const double length2 = mesh_dot(direction, direction);
    if (!(length2 > 0.0)) return HUGE_VAL; /* no direction */
    for (int k = 0; k < 3; ++k) {
        double x[3], y[3];
        mesh_minus(p->a[k], p->a[0], x);
        mesh_minus(p->b[k], p->a[0], y);
        const double s = mesh_dot(direction, x), t = mesh_dot(direction, y);
        low[0] = fmin(low[0], s);
        high[0] = fmax(high[0], s);
        low[1] = fmin(low[1], t);
        high[1] = fmax(high[1], t);
    }
    return fmin(high[0] - low[1], high[1] - low[0]) / sqrt(length2);
}

/* The product of two edges is a direction only if they are not parallel up to rounding. */
static bool product(const double a[3], const double b[3], double out[3])
{
    mesh_cross(a, b, out);
    return mesh_dot(out, out) > 1e-20 * mesh_dot(a, a) * mesh_dot(b, b);
}

/* Does a direction in the plane of this normal separate them to `limit`? */
static bool apart_in_plane(const pair *p, const double normal[3], double limit)
{
    double direction[3];
    for (int k = 0; k < 3; ++k) {
        if (product(normal, p->edge_a[k], direction) && reach_in(p, direction) <= limit) return true;
        if (product(normal, p->edge_b[k], direction) && reach_in(p, direction) <= limit) return true;
    }
    return false;
}

static bool apart_by_products(const pair *p, double limit)
{
    double direction[3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (product(p->edge_a[i], p->edge_b[j], direction) && reach_in(p, direction) <= limit) return true;
    return false;
}

/* Do all of these corners lie within `limit` of the plane through `origin`? */
static bool in_plane(const double *const corner[3], const double *origin, const double normal[3], double limit)
{
    const double length = sqrt(mesh_dot(normal, normal));
    for (int k = 0; k < 3; ++k) {
        double gap[3];
        mesh_minus(corner[k], origin, gap);
        if (fabs(mesh_dot(gap, normal)) > limit * length) return false;
    }
    return true;
}

static void make_pair(const brc_mesh *mesh, int32_t t, int32_t u, pair *p)
{
    for (int k = 0; k < 3; ++k) {
        p->a[k] = mesh->vertex[mesh->corner[t][k]];
        p->b[k] = mesh->vertex[mesh->corner[u][k]];
    }
    for (int k = 0; k < 3; ++k) {
        mesh_minus(p->a[(k + 1) % 3], p->a[k], p->edge_a[k]);
        mesh_minus(p->b[(k + 1) % 3], p->b[k], p->edge_b[k]);
    }
    mesh_cross(p->edge_a[0], p->edge_a[1], p->normal_a);
    mesh_cross(p->edge_b[0], p->edge_b[1], p->normal_b);
}

/* Apart by more than `gap` everywhere? */
static bool far_apart(const pair *p, double gap)
{
    return reach_in(p, p->normal_a) < -gap || reach_in(p, p->normal_b) < -gap || apart_in_plane(p, p->normal_a, -gap) ||
           apart_in_plane(p, p->normal_b, -gap) || apart_by_products(p, -gap);
}

/* Do they reach into each other by no more than `depth`? In a common plane only directions within it count. */
static bool side_by_side(const pair *p, double depth)
{
    if (in_plane(p->b, p->a[0], p->normal_a, depth)) return apart_in_plane(p, p->normal_a, depth);
    if (in_plane(p->a, p->b[0], p->normal_b, depth)) return apart_in_plane(p, p->normal_b, depth);
    return reach_in(p, p->normal_a) <= depth || reach_in(p, p->normal_b) <= depth || apart_by_products(p, depth) ||
           apart_in_plane(p, p->normal_a, depth) || apart_in_plane(p, p->normal_b, depth);
}

static bool has_vertex(const brc_mesh *mesh, int32_t t, int32_t v)
{
    return mesh->corner[t][0] == v || mesh->corner[t][1] == v || mesh->corner[t][2] == v;
}

static bool share_vertex(const brc_mesh *mesh, int32_t t, int32_t u)
{
    return has_vertex(mesh, u, mesh->corner[t][0]) || has_vertex(mesh, u, mesh->corner[t][1]) ||
           has_vertex(mesh, u, mesh->corner[t][2]);
}

/* Does an edge join a vertex of t to one of u? */
static bool near_neighbours(const brc_mesh *mesh, int32_t t, int32_t u)
{
    for (int k = 0; k < 3; ++k) {
        int32_t at = 3 * t + k;
        do {
            if (share_vertex(mesh, at / 3, u)) return true;
            at = brc_mesh_turn(mesh, at);
        } while (at != 3 * t + k);
    }
    return false;
}

static bool cut(const brc_mesh *mesh, int32_t t, int32_t u)
{
    pair p;
    make_pair(mesh, t, u, &p);
    if (share_vertex(mesh, t, u)) return !side_by_side(&p, mesh->rounding);
    if (far_apart(&p, mesh->rounding)) return false;
    return !near_neighbours(mesh, t, u) || !side_by_side(&p, mesh->rounding);
}

typedef struct finding {
    int64_t n;
    int32_t t, u; /* the pair that comes first in the file */
} finding;

static bool earlier(const brc_mesh *mesh, int32_t t, int32_t u, const finding *than)
{
    const int32_t a = mesh->facet[t] < mesh->facet[u] ? mesh->facet[t] : mesh->facet[u];
    const int32_t b = mesh->facet[t] < mesh->facet[u] ? mesh->facet[u] : mesh->facet[t];
    const int32_t c = mesh->facet[than->t] < mesh->facet[than->u] ? mesh->facet[than->t] : mesh->facet[than->u];
    const int32_t d = mesh->facet[than->t] < mesh->facet[than->u] ? mesh->facet[than->u] : mesh->facet[than->t];
    return a < c || (a == c && b < d);
}

static void note(const brc_mesh *mesh, int32_t t, int32_t u, int64_t n, finding *found)
{
    if (n > 0 && (found->n == 0 || earlier(mesh, t, u, found))) {
        found->t = t;
        found->u = u;
    }
    found->n += n;
}

/* All later triangles in the tree's order that cut t. */
static void search(const brc_mesh *mesh, int32_t t, finding *found)
{
    double low[3], high[3];
    for (int d = 0; d < 3; ++d) {
        low[d] = HUGE_VAL;
        high[d] = -HUGE_VAL;
        for (int k = 0; k < 3; ++k) {
            low[d] = fmin(low[d], mesh->vertex[mesh->corner[t][k]][d] - mesh->rounding);
            high[d] = fmax(high[d], mesh->vertex[mesh->corner[t][k]][d] + mesh->rounding);
        }
    }
    int32_t stack[BRC_MESH_STACK], n = 0;
    stack[n++] = 0;
    while (n > 0) {
        const int32_t at = stack[--n];
        const brc_mesh_node *node = &mesh->node[at];
        bool meets = true;
        for (int d = 0; d < 3; ++d)
            meets = meets && low[d] <= (double)node->high[d] && high[d] >= (double)node->low[d];
        if (!meets) continue;
        if (node->count == 0) {
            stack[n++] = node->next;
            stack[n++] = at + 1;
            continue;
        }
        for (int32_t u = node->next > t ? node->next : t + 1; u < node->next + node->count; ++u)
            if (!(mesh->flags[u] & BRC_MESH_SLIVER) && cut(mesh, t, u)) note(mesh, t, u, 1, found);
    }
}

/* A point where they meet: an edge of one through the other, else the middle of what their boxes share. */
static void place_of(const brc_mesh *mesh, int32_t t, int32_t u, double out[3])
{
    for (int d = 0; d < 3; ++d) {
        double low = -HUGE_VAL, high = HUGE_VAL;
        for (int s = 0; s < 2; ++s) {
            const int32_t *c = mesh->corner[s ? u : t];
            const double x = mesh->vertex[c[0]][d], y = mesh->vertex[c[1]][d], z = mesh->vertex[c[2]][d];
            low = fmax(low, fmin(x, fmin(y, z)));
            high = fmin(high, fmax(x, fmax(y, z)));
        }
        out[d] = 0.5 * (low + high);
    }
    for (int s = 0; s < 2; ++s) {
        const int32_t edges = s ? u : t, face = s ? t : u;
        double normal[3];
        brc_mesh_area_vector(mesh, face, normal);
        for (int k = 0; k < 3; ++k) {
            const double *a = mesh->vertex[mesh->corner[edges][k]], *b = mesh->vertex[mesh->corner[edges][(k + 1) % 3]];
            double to_a[3], to_b[3], x[3], point[3], gap[3];
            mesh_minus(a, mesh->vertex[mesh->corner[face][0]], to_a);
            mesh_minus(b, mesh->vertex[mesh->corner[face][0]], to_b);
            const double above = mesh_dot(to_a, normal), below = mesh_dot(to_b, normal);
            if (!(above * below < 0.0)) continue;
            for (int d = 0; d < 3; ++d)
                x[d] = a[d] + above / (above - below) * (b[d] - a[d]);
            brc_mesh_nearest_of(mesh, face, x, point);
            mesh_minus(x, point, gap);
            if (mesh_dot(gap, gap) > mesh->rounding * mesh->rounding) continue;
            memcpy(out, point, sizeof point);
            return;
        }
    }
}

brc_status brc_mesh_check_cuts(brc_context *context, const brc_mesh *mesh, const brc_mesh_source *source)
{
    finding found = {0};
    const int threads = source->n_threads > 0 ? source->n_threads : omp_get_max_threads();
#pragma omp parallel num_threads(threads)
    {
        finding mine = {0};
#pragma omp for schedule(dynamic, 1024)
        for (int32_t t = 0; t < mesh->n_triangles; ++t)
            if (!(mesh->flags[t] & BRC_MESH_SLIVER)) search(mesh, t, &mine);
#pragma omp critical(brc_mesh_cut)
        note(mesh, mine.t, mine.u, mine.n, &found);
    }
    if (found.n == 0) return BRC_OK;
    double x[3];
    char place[BRC_MESH_PLACE];
    place_of(mesh, found.t, found.u, x);
    const int32_t a = mesh->facet[found.t] + 1, b = mesh->facet[found.u] + 1;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "%s: %lld pairs of triangles cut or touch each other, the first are triangles %d and %d near %s "
                    "(units of the file); unite overlapping parts in your "
                    "CAD program or mend the mesh with a repair tool",
                    source->path, (long long)found.n, a < b ? a : b, a < b ? b : a, brc_mesh_place(source, x, place));
}
