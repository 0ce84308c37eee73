/* Surfaces that bend at every edge, as scans do, at the scale a question is asked at: patches mean nothing there. Such
 * a surface is seen from a point in directions, and around a place it has a mean plane. */
#include "mesh_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Directions: squares on the sides of a cube around the point. */
enum { ACROSS = 8 };
_Static_assert(BRC_MESH_VIEWS == 6 * ACROSS * ACROSS, "one view a square");
/* Triangles steeper than this belong to another wall (cosine), and so often the mean normal is found anew. */
#define STEEP 0.17
enum { ROUNDS = 2 };

static int view_of(const double arm[3])
{
    int axis = 0, at[2];
    for (int d = 1; d < 3; ++d)
        if (fabs(arm[d]) > fabs(arm[axis])) axis = d;
    for (int k = 0; k < 2; ++k) {
        const int cell = (int)floor((arm[(axis + 1 + k) % 3] / fabs(arm[axis]) + 1.0) * (0.5 * ACROSS));
        at[k] = cell < 0 ? 0 : cell >= ACROSS ? ACROSS - 1 : cell;
    }
    return ((2 * axis + (arm[axis] > 0.0)) * ACROSS + at[0]) * ACROSS + at[1];
}

/* Nearest point of triangle t; into the view that it lies in, if nothing there is nearer. */
static void look_at(const brc_mesh *mesh, int32_t t, const double x[3], double reach, brc_mesh_foot *views)
{
    brc_mesh_foot foot = {.patch = mesh->patch[t]};
    double arm[3];
    const int feature = brc_mesh_nearest_of(mesh, t, x, foot.point);
    mesh_minus(foot.point, x, arm);
    foot.distance = sqrt(mesh_dot(arm, arm));
    if (!(foot.distance < reach)) return;
    brc_mesh_foot *view = &views[foot.distance > 0.0 ? view_of(arm) : 0];
    if (view->distance > 0.0 && view->distance <= foot.distance) return;
    memcpy(foot.normal, mesh->normal[t], sizeof foot.normal);
    if (feature >= BRC_MESH_EDGE && feature < BRC_MESH_CORNER)
        foot.concave = (mesh->flags[t] & BRC_MESH_CONCAVE(feature - BRC_MESH_EDGE)) != 0;
    if (feature >= BRC_MESH_CORNER)
        foot.concave = (mesh->flags[t] & (BRC_MESH_CONCAVE(0) | BRC_MESH_CONCAVE(1) | BRC_MESH_CONCAVE(2))) != 0;
    *view = foot;
}

static int by_distance(const void *a, const void *b)
{
    const brc_mesh_foot *p = a, *q = b;
    if (p->distance != q->distance) return p->distance < q->distance ? -1 : 1;
    return (p->patch > q->patch) - (p->patch < q->patch);
}

/* Does the node's box come nearer to x than `reach`? */
static bool near_node(const brc_mesh_node *node, const double x[3], double reach)
{
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double gap = fmax((double)node->low[d] - x[d], x[d] - (double)node->high[d]);
        if (gap > 0.0) sum += gap * gap;
    }
    return sum < reach * reach;
}

typedef void visit(void *of, int32_t triangle);

/* Every triangle of the nodes that come near, in the order of the tree. */
static void walk(const brc_mesh *mesh, const double x[3], double reach, visit *call, void *of)
{
    int32_t stack[BRC_MESH_STACK];
    int n = 0;
    stack[n++] = 0;
    while (n > 0) {
        const int32_t at = stack[--n];
        const brc_mesh_node *node = &mesh->node[at];
        if (!near_node(node, x, reach)) continue;
        if (node->count == 0) {
            stack[n++] = node->next;
            stack[n++] = at + 1;
            continue;
        }
        for (int32_t t = node->next; t < node->next + node->count; ++t)
            call(of, t);
    }
}

typedef struct sight {
    const brc_mesh *mesh;
    const double *x;
    double reach;
    brc_mesh_foot *views;
} sight;

static void see(void *of, int32_t t)
{
    const sight *s = of;
    look_at(s->mesh, t, s->x, s->reach, s->views);
}

int32_t brc_mesh_views(const brc_mesh *mesh, const double x[3], double reach, brc_mesh_foot feet[BRC_MESH_VIEWS])
{
    sight s = {.mesh = mesh, .x = x, .reach = reach, .views = feet};
    memset(feet, 0, BRC_MESH_VIEWS * sizeof *feet);
    walk(mesh, x, reach, see, &s);
    int32_t n = 0;
    for (int v = 0; v < BRC_MESH_VIEWS; ++v)
        if (feet[v].distance > 0.0) feet[n++] = feet[v];
    qsort(feet, (size_t)n, sizeof *feet, by_distance);
    return n;
}

/* Sums over the triangles of a neighbourhood. Heights are counted from the point. */
typedef struct sheet {
    const brc_mesh *mesh;
    const double *point;
    double radius;
    double towards[3];                       /* unit */
    double area[3], flux, moment, low, high; /* [m^2], [m^3], [m] */
} sheet;

static void add(void *of, int32_t t)
{
    sheet *s = of;
    const int32_t *corner = s->mesh->corner[t];
    double arm[3][3], centroid[3], area[3], height = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
    if (mesh_dot(s->mesh->normal[t], s->towards) < STEEP) return;
    for (int k = 0; k < 3; ++k)
        mesh_minus(s->mesh->vertex[corner[k]], s->point, arm[k]);
    for (int d = 0; d < 3; ++d)
        centroid[d] = (arm[0][d] + arm[1][d] + arm[2][d]) / 3.0;
    if (mesh_dot(centroid, centroid) >= s->radius * s->radius) return;
    for (int k = 0; k < 3; ++k) {
        const double h = mesh_dot(arm[k], s->towards);
        height += h / 3.0;
        low = fmin(low, h);
        high = fmax(high, h);
    }
    brc_mesh_area_vector(s->mesh, t, area);
    const double share = mesh_dot(area, s->towards);
    for (int d = 0; d < 3; ++d)
        s->area[d] += area[d];
    s->flux += share;
    s->moment += share * height;
    s->low = fmin(s->low, low);
    s->high = fmax(s->high, high);
}

bool brc_mesh_mean_plane(const brc_mesh *mesh, const double point[3], double radius, double normal[3], double *height,
                         double *rough)
{
    sheet s = {.mesh = mesh, .point = point, .radius = radius};
    memcpy(s.towards, normal, sizeof s.towards);
    for (int round = 0; round <= ROUNDS; ++round) {
        memset(s.area, 0, sizeof s.area);
        s.flux = s.moment = 0.0;
        s.low = HUGE_VAL;
        s.high = -HUGE_VAL;
        walk(mesh, point, radius, add, &s);
        const double length = sqrt(mesh_dot(s.area, s.area));
        if (!(s.flux > 0.0 && length > 0.0)) return false;
        if (round < ROUNDS)
            for (int d = 0; d < 3; ++d)
                s.towards[d] = s.area[d] / length;
    }
    const double mean = s.moment / s.flux;
    memcpy(normal, s.towards, sizeof s.towards);
    *height = mean + mesh_dot(point, s.towards);
    *rough = fmax(s.high - mean, mean - s.low);
    return true;
}
