/* The surfaces of a solid near a point, and where they meet. */
#include "solid_near.h"
#include <math.h>
#include <string.h>

/* A mesh with more patches than MOST_PATCHES near x is rough there; then it counts as a few walls. */
enum { MOST_STEPS = 40, MOST_PATCHES = 32, MOST_WALLS = 16 };
void brc_near_step(const double x[3], double length, const double direction[3], double out[3])
{
    for (int d = 0; d < 3; ++d)
        out[d] = x[d] + length * direction[d];
}

static void set_probe(brc_near_surface *a)
{
    const brc_surface *s = a->surface;
    memcpy(a->probe, a->normal, sizeof a->probe);
    if (s->kind != BRC_SURFACE_CONE) return;
    const double gap[3] = {a->point[0] - s->point[0], a->point[1] - s->point[1], a->point[2] - s->point[2]};
    if (brc_length3(gap) <= 1e-12 * fabs(a->height))
        for (int d = 0; d < 3; ++d)
            a->probe[d] = -s->axis[d];
}

/* The walls of a rough mesh near x, as nearest points or as mean planes. */
static int gather_rough(const brc_leaf *leaf, const brc_surface *surface, const double local[3], double reach,
                        bool mirror, brc_near_surface *near, int room)
{
    brc_rough_wall walls[MOST_WALLS];
    const int n = brc_rough_walls(leaf->mesh, local, reach, mirror, walls, room < MOST_WALLS ? room : MOST_WALLS);
    const double sign = n > 0 && brc_mesh_inside(leaf->mesh, local) ? 1.0 : -1.0;
    for (int k = 0; k < n; ++k) {
        brc_near_surface *a = &near[k];
        const brc_mesh_foot *foot = &walls[k].foot;
        double out[3];
        *a = (brc_near_surface){.surface = surface,
                                .height = -sign * foot->distance,
                                .rough = true,
                                .wall = walls[k],
                                .concave = foot->concave != (leaf->role == BRC_PART_REMOVE)};
        brc_leaf_from_part(leaf, foot->point, a->point);
        brc_leaf_turn(leaf, walls[k].normal, a->wall.normal);
        brc_leaf_turn(leaf, foot->normal, a->plane);
        memcpy(a->probe, a->plane, sizeof a->probe);
        for (int d = 0; d < 3; ++d)
            out[d] = sign * (foot->point[d] - local[d]) / foot->distance;
        brc_leaf_turn(leaf, out, a->normal);
    }
    return n;
}

/* The patches of a mesh near x. */
static int gather_mesh(const brc_solid *solid, const brc_surface *surface, const double x[3], double reach, bool mirror,
                       brc_near_surface *near, int room)
{
    const brc_leaf *leaf = &solid->leaf[surface->leaf];
    brc_mesh_foot feet[MOST_PATCHES];
    double local[3];
    brc_leaf_to_part(leaf, x, local);
    const int32_t n = brc_mesh_feet(leaf->mesh, local, reach, feet, room < MOST_PATCHES ? room : MOST_PATCHES);
    if (n > MOST_PATCHES || n > room) return gather_rough(leaf, surface, local, reach, mirror, near, room);
    const bool alone = solid->n_leaves == 1; /* then only points inside are asked for */
    const double sign = n > 0 && (alone || brc_mesh_inside(leaf->mesh, local)) ? 1.0 : -1.0;
    for (int k = 0; k < n; ++k) {
        brc_near_surface *a = &near[k];
        *a = (brc_near_surface){.surface = surface,
                                .height = -sign * feet[k].distance,
                                .flat = feet[k].flat,
                                .rim = feet[k].on_edge,
                                .concave = feet[k].concave != (leaf->role == BRC_PART_REMOVE)};
        brc_leaf_from_part(leaf, feet[k].point, a->point);
        brc_leaf_turn(leaf, feet[k].normal, a->plane);
        memcpy(a->normal, a->plane, sizeof a->normal);
        /* towards the point itself: on a patch that curves in facets it may lie on an edge of them */
        if (feet[k].distance > 1e-3 * solid->tiny && !(feet[k].flat && !feet[k].on_edge))
            for (int d = 0; d < 3; ++d)
                a->normal[d] = sign * (a->point[d] - x[d]) / feet[k].distance;
        memcpy(a->probe, a->normal, sizeof a->probe);
    }
    return n;
}

/* Surfaces nearer to x than reach, in order; the opposite sides of curved ones too. mirror: rough meshes as mean
 * planes. */
int brc_near_gather(const brc_solid *solid, const double x[3], double reach, bool mirror, brc_near_surface *near)
{
    int n = 0;
    for (int32_t s = 0; s < solid->n_surfaces && n + 1 < BRC_NEAR_MOST; ++s) {
        const brc_surface *surface = &solid->surface[s];
        brc_near_surface *a = &near[n];
        if (surface->kind == BRC_SURFACE_MESH) {
            n += gather_mesh(solid, surface, x, reach, mirror, a, BRC_NEAR_MOST - n);
            continue;
        }
        const double height = brc_surface_height(solid, surface, x, NULL);
        if (fabs(height) >= reach) continue;
        *a = (brc_near_surface){.surface = surface, .height = height, .flat = surface->kind == BRC_SURFACE_PLANE};
        brc_surface_height(solid, surface, x, a->normal);
        brc_near_step(x, -a->height, a->normal, a->point);
        set_probe(a);
        ++n;
        brc_near_surface *b = &near[n];
        *b = (brc_near_surface){.surface = surface, .opposite = true};
        if (!brc_surface_opposite(surface, x, &b->height, b->normal) || fabs(b->height) >= reach) continue;
        brc_near_step(x, -b->height, b->normal, b->point);
        set_probe(b);
        ++n;
    }
    return n;
}

/* Sides of a surface at y: is the solid there below it (bit 0), above it (bit 1)? */
int brc_near_sides(const brc_solid *solid, const double y[3], const double normal[3])
{
    double below[3], above[3];
    brc_near_step(y, -solid->tiny, normal, below);
    brc_near_step(y, solid->tiny, normal, above);
    return (brc_solid_member(solid, below) ? 1 : 0) | (brc_solid_member(solid, above) ? 2 : 0);
}

/* Does the leaf itself end at y? */
bool brc_near_leaf_ends(const brc_solid *solid, const brc_near_surface *a)
{
    const brc_leaf *leaf = &solid->leaf[a->surface->leaf];
    if (leaf->n_surfaces == 1) return true;
    double below[3];
    brc_near_step(a->point, -solid->tiny, a->probe, below);
    return brc_leaf_inside(solid, leaf, below);
}

/* Solve the small symmetric system of unit normals: find the combination of normals with the given heights along them.
 * n: 2 or 3; false when they are nearly parallel. */
bool brc_near_combine(int n, const double normal[3][3], const double value[3], double weight[3])
{
    const double c = brc_dot3(normal[0], normal[1]);
    if (n == 2) {
        const double determinant = 1.0 - c * c;
        if (determinant < 1e-10) return false;
        weight[0] = (value[0] - c * value[1]) / determinant;
        weight[1] = (value[1] - c * value[0]) / determinant;
        weight[2] = 0.0;
        return true;
    }
    const double b = brc_dot3(normal[0], normal[2]), a = brc_dot3(normal[1], normal[2]);
    const double determinant = 1.0 + 2.0 * a * b * c - a * a - b * b - c * c;
    if (determinant < 1e-10) return false;
    weight[0] = ((1.0 - a * a) * value[0] + (a * b - c) * value[1] + (a * c - b) * value[2]) / determinant;
    weight[1] = ((a * b - c) * value[0] + (1.0 - b * b) * value[1] + (b * c - a) * value[2]) / determinant;
    weight[2] = ((a * c - b) * value[0] + (b * c - a) * value[1] + (1.0 - c * c) * value[2]) / determinant;
    return true;
}

/* The point nearest to x that lies on all n surfaces: tangent planes are cut until nothing moves. weight: x to the
 * point in terms of the normals there. False when the surfaces do not meet near x. */
bool brc_near_meet(const brc_solid *solid, const double x[3], int n, const brc_near_surface *const *a, double reach,
                   double y[3], double normal[3][3], double weight[3])
{
    bool flat = true;
    double height[3];
    memcpy(y, x, 3 * sizeof *y);
    for (int k = 0; k < n; ++k) {
        flat = flat && a[k]->surface->kind == BRC_SURFACE_PLANE;
        height[k] = a[k]->height;
        memcpy(normal[k], a[k]->normal, 3 * sizeof(double));
        if (a[k]->opposite) return false;
    }
    for (int i = 0; i < MOST_STEPS; ++i) {
        double wanted[3] = {0.0, 0.0, 0.0}, next[3];
        const double back[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
        for (int k = 0; k < n; ++k)
            wanted[k] = brc_dot3(normal[k], back) - height[k];
        if (!brc_near_combine(n, (const double(*)[3])normal, wanted, weight)) return false;
        for (int d = 0; d < 3; ++d) {
            next[d] = x[d];
            for (int k = 0; k < n; ++k)
                next[d] += weight[k] * normal[k][d];
        }
        const double moved[3] = {next[0] - y[0], next[1] - y[1], next[2] - y[2]},
                     far[3] = {next[0] - x[0], next[1] - x[1], next[2] - x[2]};
        memcpy(y, next, sizeof next);
        if (flat) return brc_length3(far) < reach;
        if (brc_length3(far) > 4.0 * reach) return false;
        if (brc_length3(moved) < 1e-3 * solid->tiny) return brc_length3(far) < reach;
        for (int k = 0; k < n; ++k)
            height[k] = brc_surface_height(solid, a[k]->surface, y, normal[k]);
    }
    return false;
}

/* Is the solid there in each of the 2^n sectors around a point where n surfaces meet? Bit s: sector where surface k is
 * above for each bit k of s. */
int brc_near_sectors(const brc_solid *solid, int n, const double y[3], const double normal[3][3])
{
    int inside = 0;
    for (int s = 0; s < 1 << n; ++s) {
        double value[3] = {0.0, 0.0, 0.0}, weight[3], direction[3] = {0.0, 0.0, 0.0}, x[3];
        for (int k = 0; k < n; ++k)
            value[k] = s >> k & 1 ? 1.0 : -1.0;
        if (!brc_near_combine(n, normal, value, weight)) return 0;
        for (int k = 0; k < n; ++k)
            for (int d = 0; d < 3; ++d)
                direction[d] += weight[k] * normal[k][d];
        brc_near_step(y, solid->tiny / brc_length3(direction), direction, x);
        if (brc_solid_member(solid, x)) inside |= 1 << s;
    }
    return inside;
}

/* The only sector outside, -1 when there is none or another one. */
int brc_near_lone_outside(int n, int inside)
{
    const int all = (1 << (1 << n)) - 1, outside = all & ~inside;
    for (int s = 0; s < 1 << n; ++s)
        if (outside == 1 << s) return s;
    return -1;
}
