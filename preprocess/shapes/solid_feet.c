/* Where the surface of a solid comes near a point. Candidates are the nearest points of all surfaces, of the curves
 * where two of them cut and of the corners where three do; one is on the solid's surface where small steps off it, to
 * every side of its surfaces, do not all agree about being inside. */
#include "solid_near.h"

#include <math.h>
#include <string.h>
#define SAME_FOOT 1e-6 /* relative, and as an angle */

/* Distance to the nearest surface point; *corner: it and its wall where only an edge or a corner is that near. */
static double nearest(const brc_solid *solid, const double x[3], const brc_near_surface *near, int n, double reach,
                      double point[3], int32_t *wall)
{
    double best = reach, y[3], normal[3][3], weight[3];
    for (int i = 0; i < n; ++i) {
        const double distance = fabs(near[i].height);
        if (distance >= best || !brc_near_leaf_ends(solid, &near[i])) continue;
        const int side = brc_near_sides(solid, near[i].point, near[i].probe);
        if (side != 1 && side != 2) continue;
        best = distance;
        memcpy(point, near[i].point, sizeof near[i].point);
        *wall = near[i].surface->wall;
    }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            const brc_near_surface *const pair[2] = {&near[j], &near[i]};
            if (fabs(near[i].height) >= best || fabs(near[j].height) >= best || near[i].surface == near[j].surface)
                continue;
            if (!brc_near_meet(solid, x, 2, pair, best, y, normal, weight)) continue;
            const int inside = brc_near_sectors(solid, 2, y, (const double(*)[3])normal);
            if (inside != 0 && inside != 15) {
                const double gap[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
                best = brc_length3(gap);
                memcpy(point, y, sizeof y);
                *wall = near[j].surface->wall;
            }
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < j; ++k) {
                const brc_near_surface *const triple[3] = {&near[k], &near[j], &near[i]};
                if (fabs(near[i].height) >= best || fabs(near[j].height) >= best || fabs(near[k].height) >= best)
                    continue;
                if (near[i].surface == near[j].surface || near[j].surface == near[k].surface) continue;
                if (!brc_near_meet(solid, x, 3, triple, best, y, normal, weight)) continue;
                const int inside = brc_near_sectors(solid, 3, y, (const double(*)[3])normal);
                if (inside != 0 && inside != 255) {
                    const double gap[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
                    best = brc_length3(gap);
                    memcpy(point, y, sizeof y);
                    *wall = near[k].surface->wall;
                }
            }
    return best;
}

double brc_solid_depth(const brc_solid *solid, const double x[3])
{
    const bool inside = brc_solid_member(solid, x);
    const double sign = inside ? 1.0 : -1.0;
    if (solid->n_leaves == 1 && solid->leaf[0].mesh) return -brc_surface_height(solid, &solid->surface[0], x, NULL);
    if (solid->n_leaves == 1 && (inside || solid->n_surfaces == 1)) {
        double depth = HUGE_VAL; /* in a convex leaf nothing hides a surface */
        for (int32_t s = 0; s < solid->n_surfaces; ++s)
            depth = fmin(depth, fabs(brc_surface_height(solid, &solid->surface[s], x, NULL)));
        return sign * depth;
    }
    brc_near_surface near[BRC_NEAR_MOST];
    double point[3], diagonal[3], away = 0.0;
    int32_t wall;
    for (int d = 0; d < 3; ++d) {
        diagonal[d] = solid->bounds[1][d] - solid->bounds[0][d];
        away += fmax(0.0, fmax(solid->bounds[0][d] - x[d], x[d] - solid->bounds[1][d]));
    }
    /* look near first: most questions are asked near the surface */
    const double all = brc_length3(diagonal) + away;
    for (double reach = 1.0 / 64.0 * all;; reach *= 4.0) {
        const int n = brc_near_gather(solid, x, reach, false, near);
        const double distance = nearest(solid, x, near, n, reach, point, &wall);
        if (distance < reach) return sign * distance;
        if (reach > all) return sign * all;
    }
}

double brc_solid_distance(const brc_solid *solid, const double x[3], double reach)
{
    brc_near_surface near[BRC_NEAR_MOST];
    double point[3];
    int32_t wall;
    if (solid->n_leaves == 1 && solid->leaf[0].mesh) { /* looking no farther than needed is much faster */
        double y[3];
        brc_leaf_to_part(&solid->leaf[0], x, y);
        return brc_mesh_distance(solid->leaf[0].mesh, y, reach);
    }
    if (solid->n_leaves == 1 && solid->n_surfaces == 1)
        return fmin(reach, fabs(brc_surface_height(solid, &solid->surface[0], x, NULL)));
    return nearest(solid, x, near, brc_near_gather(solid, x, reach, false, near), reach, point, &wall);
}

bool brc_solid_clear(const brc_solid *solid, const double x[3], double distance)
{
    return !brc_solid_member(solid, x) && brc_solid_distance(solid, x, distance) >= distance;
}

/* Add a foot unless an earlier one is the same place; planes of a file agree to its rounding only. Of too many the
 * nearest stay. */
static int32_t add_foot(brc_foot *feet, int32_t n, int32_t most, const brc_foot *foot)
{
    for (int32_t k = 0; k < n && k < most; ++k)
        if (fabs(feet[k].depth - foot->depth) <= SAME_FOOT * foot->depth &&
            brc_dot3(feet[k].normal, foot->normal) > 1.0 - SAME_FOOT * SAME_FOOT)
            return n;
    if (n < most)
        feet[n] = *foot;
    else if (most > 0) {
        int32_t deepest = 0;
        for (int32_t k = 1; k < most; ++k)
            if (feet[k].depth > feet[deepest].depth) deepest = k;
        if (foot->depth < feet[deepest].depth) feet[deepest] = *foot;
    }
    return n + 1;
}

/* A surface whose foot lies beyond an edge, outside the solid, still bounds what is around x when x is on its inner
 * side and the wall itself begins near x, at an edge with another surface. */
static bool bounds_beyond(const brc_solid *solid, const brc_near_surface *near, int n_near, int self, const double x[3],
                          double reach)
{
    const brc_near_surface *a = &near[self];
    const brc_leaf *leaf = &solid->leaf[a->surface->leaf];
    if (leaf->role == BRC_PART_REMOVE ? a->height < 0.0 : a->height > 0.0) return false;
    if (leaf->role == BRC_PART_ADD && !brc_leaf_inside(solid, leaf, x)) return false;
    if (a->surface->hull != 0.0) return true;
    for (int k = 0; k < n_near; ++k) {
        const brc_near_surface *const pair[2] = {a, &near[k]};
        double y[3], normal[3][3], weight[3];
        if (near[k].surface == a->surface || !brc_near_meet(solid, x, 2, pair, reach, y, normal, weight)) continue;
        const int inside = brc_near_sectors(
            solid, 2, y, (const double(*)[3])normal); /* sectors 0 and 1, 2 and 3 are apart by surface a */
        if ((inside & 1) != (inside >> 1 & 1) || (inside >> 2 & 1) != (inside >> 3 & 1)) return true;
    }
    return false;
}

static int32_t edge_feet(const brc_solid *solid, const double x[3], const brc_near_surface *near, int n_near,
                         double reach, brc_foot *feet, int32_t n, int32_t most)
{
    double y[3], normal[3][3], weight[3];
    for (int i = 0; i < n_near; ++i)
        for (int j = 0; j < i; ++j) {
            const brc_near_surface *const pair[2] = {&near[j], &near[i]};
            if (near[i].surface == near[j].surface || !brc_near_meet(solid, x, 2, pair, reach, y, normal, weight))
                continue;
            const int outside = brc_near_lone_outside(2, brc_near_sectors(solid, 2, y, (const double(*)[3])normal));
            if (outside < 0) continue;
            /* nearest to x only if x lies between the normals of the two faces */
            if ((outside & 1 ? weight[0] : -weight[0]) < 0.0 || (outside & 2 ? weight[1] : -weight[1]) < 0.0) continue;
            brc_foot foot = {.wall = near[j].surface->wall};
            for (int d = 0; d < 3; ++d)
                foot.normal[d] = y[d] - x[d];
            foot.depth = brc_length3(foot.normal);
            if (!(foot.depth > 0.0 && foot.depth < reach)) continue;
            for (int d = 0; d < 3; ++d)
                foot.normal[d] /= foot.depth;
            n = add_foot(feet, n, most, &foot);
        }
    return n;
}

bool brc_solid_concave_there(const brc_solid *solid, const double x[3], const double a[3], const double b[3],
                             double outward[2][3])
{
    double normal[3][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}};
    const int outside = brc_near_lone_outside(2, brc_near_sectors(solid, 2, x, (const double(*)[3])normal));
    for (int k = 0; k < 2 && outside >= 0; ++k)
        for (int d = 0; d < 3; ++d)
            outward[k][d] = outside >> k & 1 ? normal[k][d] : -normal[k][d];
    return outside >= 0;
}

static double distance_to_edge(const brc_edge *edge, const double x[3])
{
    double along[3], from[3], off[3];
    for (int d = 0; d < 3; ++d) {
        along[d] = edge->end[1][d] - edge->end[0][d];
        from[d] = x[d] - edge->end[0][d];
    }
    const double t = fmax(0.0, fmin(1.0, brc_dot3(from, along) / brc_dot3(along, along)));
    for (int d = 0; d < 3; ++d)
        off[d] = from[d] - t * along[d];
    return brc_length3(off);
}

/* The point nearest to x where the planes of two flat patches of a mesh meet. */
static bool patches_meet(const brc_near_surface *a, const brc_near_surface *b, const double x[3], double reach,
                         double y[3], double normal[3][3])
{
    const brc_near_surface *const pair[2] = {a, b};
    double wanted[3] = {0.0, 0.0, 0.0}, weight[3], square = 0.0;
    for (int k = 0; k < 2; ++k) {
        memcpy(normal[k], pair[k]->plane, sizeof pair[k]->plane);
        for (int d = 0; d < 3; ++d)
            wanted[k] += (pair[k]->point[d] - x[d]) * normal[k][d];
    }
    if (!brc_near_combine(2, (const double(*)[3])normal, wanted, weight)) return false;
    for (int d = 0; d < 3; ++d) {
        const double move = weight[0] * normal[0][d] + weight[1] * normal[1][d];
        y[d] = x[d] + move;
        square += move * move;
    }
    return square < reach * reach;
}

bool brc_solid_concave_edge_near(const brc_solid *solid, const double x[3], double reach)
{
    brc_near_surface near[BRC_NEAR_MOST];
    double y[3], normal[3][3], weight[3];
    const int n = brc_near_gather(solid, x, reach, false, near);
    for (int i = 0; i < n; ++i)
        if ((near[i].rim || near[i].rough) && near[i].concave) return true;
    for (int32_t e = 0; e < solid->n_edges; ++e)
        if (distance_to_edge(&solid->edge[e], x) < reach) return true;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            const brc_near_surface *const pair[2] = {&near[j], &near[i]};
            if (near[i].rough || near[j].rough) continue;
            const bool patches = near[i].surface == near[j].surface && near[i].flat && near[j].flat;
            if (patches
                    ? !patches_meet(&near[j], &near[i], x, reach, y, normal)
                    : near[i].surface == near[j].surface || !brc_near_meet(solid, x, 2, pair, reach, y, normal, weight))
                continue;
            if (brc_near_lone_outside(2, brc_near_sectors(solid, 2, y, (const double(*)[3])normal)) >= 0) return true;
        }
    return false;
}

/* The plane of a mesh's flat patch that ends at a convex edge: the same for a foot beyond it. */
static bool beyond_rim(const brc_solid *solid, const brc_near_surface *a, const double x[3], brc_foot *foot)
{
    double y[3];
    const double to[3] = {a->point[0] - x[0], a->point[1] - x[1], a->point[2] - x[2]};
    if (!a->flat) return false;
    foot->depth = brc_dot3(to, a->plane);
    memcpy(foot->normal, a->plane, sizeof foot->normal);
    brc_near_step(x, foot->depth, foot->normal, y);
    return foot->depth > 0.0 && brc_near_sides(solid, y, a->plane) == 0;
}

/* The foot of x on a near surface; false: none there. mirror: also on curved walls beyond their edges. */
static bool foot_on(const brc_solid *solid, const brc_near_surface *near, int n_near, int self, const double x[3],
                    double reach, bool mirror, brc_foot *foot)
{
    const brc_near_surface *a = &near[self];
    *foot = (brc_foot){.depth = fabs(a->height),
                       .wall = a->surface->wall,
                       .plane = a->flat && !a->rim,
                       .hull = a->surface->hull != 0.0};
    for (int d = 0; d < 3; ++d)
        foot->normal[d] = a->height < 0.0 ? a->normal[d] : -a->normal[d];
    if (a->rough) {
        foot->depth = a->wall.depth;
        foot->rough = a->wall.rough;
        memcpy(foot->normal, a->wall.normal, sizeof foot->normal);
        if (!(foot->depth > 0.0)) return false;
        if (solid->n_leaves == 1) return true;
        const int there = brc_near_sides(solid, a->point, a->probe);
        return (there == 1 || there == 2) && brc_near_leaf_ends(solid, a);
    }
    if (a->rim && !a->concave) {
        foot->plane = true;
        return beyond_rim(solid, a, x, foot);
    }
    if (!(foot->depth > 0.0)) return false;
    if (solid->n_leaves == 1 && solid->leaf[0].mesh) return true;
    const int side = brc_near_sides(solid, a->point, a->probe);
    if (side == (a->height < 0.0 ? 1 : 2)) return brc_near_leaf_ends(solid, a); /* outward is away from x */
    return side == 0 && (a->flat || mirror) && bounds_beyond(solid, near, n_near, self, x, reach);
}

/* Tangent planes around x in a thin tube. */
static int32_t around_feet(const brc_near_surface *a, const double x[3], double reach, brc_foot *feet, int32_t n,
                           int32_t most)
{
    for (int k = 1; k < BRC_TUBE_PLANES; ++k) {
        double height, normal[3];
        if (k == BRC_TUBE_PLANES / 2 || !brc_surface_around(a->surface, x, k, &height, normal) ||
            !(height < 0.0 && -height < reach))
            continue;
        brc_foot foot = {.depth = -height, .wall = a->surface->wall, .normal = {normal[0], normal[1], normal[2]}};
        n = add_foot(feet, n, most, &foot);
    }
    return n;
}

static int32_t find_feet(const brc_solid *solid, const double x[3], double reach, bool mirror, brc_foot *feet,
                         int32_t most)
{
    if (!brc_solid_member(solid, x)) return 0;
    brc_near_surface near[BRC_NEAR_MOST];
    const int n_near = brc_near_gather(solid, x, reach, mirror, near);
    int32_t n = 0;
    double least = HUGE_VAL;
    for (int i = 0; i < n_near; ++i) {
        brc_foot foot;
        if (!foot_on(solid, near, n_near, i, x, reach, mirror, &foot)) continue;
        n = add_foot(feet, n, most, &foot);
        if (mirror && near[i].opposite && near[i].height < 0.0) n = around_feet(&near[i], x, reach, feet, n, most);
    }
    if (solid->n_leaves == 1) return n; /* convex, without edges, or a mesh that knows its own */
    n = edge_feet(solid, x, near, n_near, reach, feet, n, most);
    for (int32_t k = 0; k < n && k < most; ++k)
        least = fmin(least, feet[k].depth);
    /* a concave corner is the nearest place where nothing else is */
    double point[3];
    brc_foot corner = {.wall = 0};
    const double nearer = fmin(reach, least * (1.0 - 1e-9));
    if (nearest(solid, x, near, n_near, nearer, point, &corner.wall) < nearer) {
        for (int d = 0; d < 3; ++d)
            corner.normal[d] = point[d] - x[d];
        corner.depth = brc_length3(corner.normal);
        for (int d = 0; d < 3; ++d)
            corner.normal[d] /= corner.depth;
        if (corner.depth > 0.0) n = add_foot(feet, n, most, &corner);
    }
    return n;
}

int32_t brc_solid_feet(const brc_solid *solid, const double x[3], double reach, brc_foot *feet, int32_t most)
{
    return find_feet(solid, x, reach, false, feet, most);
}

int32_t brc_solid_mirrors(const brc_solid *solid, const double x[3], double reach, brc_foot *feet, int32_t most)
{
    return find_feet(solid, x, reach, true, feet, most);
}
