/* A curved wall is replaced by planes at one common distance from its centre, chosen so that the polyhedron has exactly
 * the volume of the curved shape: nothing is scaled afterwards. A cylinder becomes a regular prism, a sphere the
 * polyhedron of half-spaces whose normals lie on a Fibonacci lattice, a cone a pyramid about its tip. */
#include "walls.h"

#include "../../host/base/memory.h"
#include "../shapes/shape_type.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

double brc_walls_n_planes(const brc_shape *shape, double spacing)
{
    const brc_shape_type *type = brc_shape_type_of(shape->kind);
    return type->planes ? type->planes(shape, spacing) : 0.0;
}

/* Normal k of n on a Fibonacci lattice: equal steps of z, the azimuth turning by the golden angle. */
static void fibonacci_normal(int64_t k, int64_t n, double out[3])
{
    const double golden_angle = PI * (3.0 - sqrt(5.0));
    const double z = 1.0 - (2.0 * (double)k + 1.0) / (double)n;
    const double r = sqrt(1.0 - z * z), phi = fmod(golden_angle * (double)k, 2.0 * PI);
    out[0] = r * cos(phi);
    out[1] = r * sin(phi);
    out[2] = z;
}

/* Cut a convex polygon (2D, room for n + 1 corners) by a . x <= b; returns the new number of corners. */
static int cut_polygon(double (*corner)[2], int n, const double a[2], double b, double (*work)[2])
{
    int m = 0;
    for (int k = 0; k < n; ++k) {
        const double *p = corner[k], *q = corner[(k + 1) % n];
        const double dp = a[0] * p[0] + a[1] * p[1] - b, dq = a[0] * q[0] + a[1] * q[1] - b;
        if (dp <= 0.0) {
            work[m][0] = p[0];
            work[m++][1] = p[1];
        }
        if ((dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0)) {
            const double t = dp / (dp - dq);
            work[m][0] = p[0] + t * (q[0] - p[0]);
            work[m++][1] = p[1] + t * (q[1] - p[1]);
        }
    }
    memcpy(corner, work, (size_t)m * sizeof *corner);
    return m;
}

/* Area of facet k of the polyhedron normal . x <= 1: its tangent plane cut by the other planes near it. `half` is the
 * half width of the square cut out of the tangent plane; false when it was too small to hold the facet. */
static bool facet_area(const brc_walls *unit, int32_t k, double half, double *area)
{
    enum { MOST_CORNERS = 256 };
    double corner[MOST_CORNERS][2] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    double work[MOST_CORNERS][2];
    int n = 4;
    const double *t = unit->normal + 3 * (int64_t)k;
    /* two unit vectors in the tangent plane */
    const int small = fabs(t[0]) < 0.6 ? 0 : 1;
    double e1[3] = {-t[small] * t[0], -t[small] * t[1], -t[small] * t[2]}, e2[3];
    e1[small] += 1.0;
    const double length = sqrt(e1[0] * e1[0] + e1[1] * e1[1] + e1[2] * e1[2]);
    for (int d = 0; d < 3; ++d)
        e1[d] /= length;
    for (int d = 0; d < 3; ++d)
        e2[d] = t[(d + 1) % 3] * e1[(d + 2) % 3] - t[(d + 2) % 3] * e1[(d + 1) % 3];
    /* the plane of another normal at angle g passes the touching point at the distance tan(g / 2) */
    const double widest = 2.0 * atan(half * sqrt(2.0));
    const double centre[3] = {unit->centre[0] + t[0], unit->centre[1] + t[1], unit->centre[2] + t[2]};
    int64_t first, count;
    brc_walls_near(unit, centre, 1.0 - cos(widest), &first, &count);
    for (int64_t m = first; m < first + count; ++m) {
        const int32_t j = (int32_t)(m % unit->n_planes);
        const double *o = unit->normal + 3 * (int64_t)j;
        const double c = t[0] * o[0] + t[1] * o[1] + t[2] * o[2];
        if (j == k || c < cos(widest) || n + 1 >= MOST_CORNERS) continue;
        const double a[2] = {o[0] * e1[0] + o[1] * e1[1] + o[2] * e1[2], o[0] * e2[0] + o[1] * e2[1] + o[2] * e2[2]};
        /* 1 - c without cancellation, from the chord */
        const double chord[3] = {o[0] - t[0], o[1] - t[1], o[2] - t[2]};
        const double b = 0.5 * (chord[0] * chord[0] + chord[1] * chord[1] + chord[2] * chord[2]);
        n = cut_polygon(corner, n, a, b, work);
    }
    double twice = 0.0;
    bool fits = true;
    for (int p = 0; p < n; ++p) {
        const int q = (p + 1) % n;
        twice += corner[p][0] * corner[q][1] - corner[p][1] * corner[q][0];
        if (fmax(fabs(corner[p][0]), fabs(corner[p][1])) >= half * (1.0 - 1e-9)) fits = false;
    }
    *area = 0.5 * twice;
    return fits;
}

static void place_sphere(brc_walls *walls, double radius)
{
    const int32_t n = walls->n_planes;
    for (int32_t k = 0; k < n; ++k)
        fibonacci_normal(k, n, walls->normal + 3 * (int64_t)k);
    /* volume at distance 1 from the centre, as the sum of pyramids; it grows with the cube of the distance */
    walls->offset = 1.0;
    double volume = 0.0;
    const double half_width = 1.5 * sqrt(4.0 * PI / n);
    for (int32_t k = 0; k < n; ++k) {
        double area = 0.0, half = half_width;
        while (!facet_area(walls, k, half, &area) && half < 8.0)
            half *= 2.0;
        volume += area / 3.0;
    }
    walls->offset = radius * cbrt(4.0 / 3.0 * PI / volume);
}

/* Sides of a prism, or of a pyramid about the same tip as the cone. */
static void place_prism(brc_walls *walls, const brc_shape *shape)
{
    const int32_t n = walls->n_planes;
    const int axis = shape->axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    /* a regular polygon of inner radius c has the area n c^2 tan(pi / n) */
    const double inner = sqrt(PI / (n * tan(PI / n)));
    const bool cone = shape->kind == BRC_SHAPE_CONE && shape->radius != shape->radius2;
    walls->axis = axis;
    walls->offset = cone ? 0.0 : shape->radius * inner;
    if (cone) {
        const double slope = (shape->radius2 - shape->radius) / shape->length;
        walls->centre[axis] -= shape->radius / slope;
        walls->slope = slope * inner;
    }
    const double inverse = 1.0 / sqrt(1.0 + walls->slope * walls->slope);
    for (int32_t k = 0; k < n; ++k) {
        const double phi = 2.0 * PI * k / n;
        double *normal = walls->normal + 3 * (int64_t)k;
        normal[u] = cos(phi);
        normal[v] = sin(phi);
        if (!cone) continue;
        normal[u] *= inverse;
        normal[v] *= inverse;
        normal[axis] = -walls->slope * inverse;
    }
}

static brc_status place_round(brc_context *context, const brc_shape *shape, double spacing, brc_walls *walls)
{
    walls->round = shape->kind;
    for (int k = 0; k < 3; ++k)
        walls->centre[k] = shape->origin[k];
    walls->plane_wall = brc_solid_n_walls(walls->solid) - 1; /* the last, after the ends */
    const double n = brc_walls_n_planes(shape, spacing);
    if (n > 1e9)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: cells of %g m on a curved wall of radius %g m need %.3g wall planes; use larger cells",
                        spacing, fmax(shape->radius, shape->radius2), n);
    BRC_TRY(BRC_ALLOCATE(context, &walls->normal, 3 * (int64_t)n, "planes of the curved wall"));
    walls->n_planes = (int32_t)n;
    if (shape->kind == BRC_SHAPE_SPHERE)
        place_sphere(walls, shape->radius);
    else
        place_prism(walls, shape);
    return BRC_OK;
}

/* Planes with the whole solid on one side. They become sides of the box, but not where there are ghosts: the box must
 * hold those too. */
static brc_status place_hull(brc_context *context, brc_walls *walls)
{
    const int32_t n = brc_solid_n_hull_planes(walls->solid);
    BRC_TRY(BRC_ALLOCATE(context, &walls->flat, 4 * (int64_t)n, "flat walls"));
    BRC_TRY(BRC_ALLOCATE(context, &walls->flat_wall, n, "flat walls"));
    for (int32_t p = 0; p < n; ++p) {
        double *plane = walls->flat + 4 * (int64_t)walls->n_flats;
        int32_t wall;
        brc_solid_hull_plane(walls->solid, p, plane, &plane[3], &wall);
        int side = -1;
        for (int k = 0; k < 3; ++k) {
            if (plane[k] == -1.0 && -plane[3] == walls->box[0][k]) side = 2 * k;
            if (plane[k] == 1.0 && plane[3] == walls->box[1][k]) side = 2 * k + 1;
        }
        bool known = false; /* two parts may end in one plane */
        for (int32_t f = 0; f < walls->n_flats; ++f) {
            const double *other = walls->flat + 4 * (int64_t)f, size = walls->box[1][0] - walls->box[0][0];
            const double cosine = plane[0] * other[0] + plane[1] * other[1] + plane[2] * other[2];
            known = known || (cosine > 1.0 - 1e-14 && fabs(plane[3] - other[3]) < 1e-7 * size);
        }
        if (side >= 0) walls->flat_side[side] = true;
        if (side >= 0 && !walls->mirrored)
            walls->side_wall[side] = wall;
        else if (!known)
            walls->flat_wall[walls->n_flats++] = wall;
    }
    return BRC_OK;
}

brc_status brc_walls_create(brc_context *context, const brc_solid *solid, double spacing, brc_walls *walls)
{
    memset(walls, 0, sizeof *walls);
    walls->solid = solid;
    walls->round = BRC_SHAPE_BOX;
    for (int side = 0; side < 6; ++side)
        walls->side_wall[side] = -1;
    brc_solid_bounds(solid, walls->box);
    const brc_shape *shape = brc_solid_shape(solid);
    const bool planes = brc_walls_n_planes(shape, spacing) > 0.0;
    walls->mirrored = !planes && shape->kind != BRC_SHAPE_BOX;
    BRC_TRY(place_hull(context, walls));
    if (planes) {
        /* corners of the polyhedron stand out of the curved wall by at most a few percent */
        const double margin =
            0.25 * (shape->kind == BRC_SHAPE_CONE ? fmax(shape->radius, shape->radius2) : shape->radius);
        for (int side = 0; side < 6; ++side)
            if (walls->side_wall[side] < 0) walls->box[side % 2][side / 2] += (side % 2 ? 1.0 : -1.0) * margin;
        return place_round(context, shape, spacing, walls);
    }
    return BRC_OK;
}

void brc_walls_set_reach(brc_walls *walls, double reach)
{
    double bounds[2][3];
    brc_solid_bounds(walls->solid, bounds);
    walls->reach = reach;
    for (int side = 0; side < 6; ++side)
        if (walls->side_wall[side] < 0)
            walls->box[side % 2][side / 2] = bounds[side % 2][side / 2] + (side % 2 ? 1.5 : -1.5) * reach;
}

void brc_walls_free(brc_walls *walls)
{
    if (!walls) return;
    void *const block[] = {walls->normal,     walls->flat,        walls->flat_wall,
                           walls->ghost,      walls->ghost_wall,  walls->ghost_owner,
                           walls->ghost_foot, walls->ghost_rough, walls->ghost_flat};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
    memset(walls, 0, sizeof *walls);
}

double brc_walls_depth(const brc_walls *walls, int32_t k, const double x[3])
{
    if (k >= walls->n_planes) {
        const double *p = walls->flat + 4 * (int64_t)(k - walls->n_planes);
        return p[3] - (p[0] * x[0] + p[1] * x[1] + p[2] * x[2]);
    }
    const double *n = walls->normal + 3 * (int64_t)k, *c = walls->centre;
    return walls->offset - (n[0] * (x[0] - c[0]) + n[1] * (x[1] - c[1]) + n[2] * (x[2] - c[2]));
}

const double *brc_walls_normal(const brc_walls *walls, int32_t k)
{
    return k < walls->n_planes ? walls->normal + 3 * (int64_t)k : walls->flat + 4 * (int64_t)(k - walls->n_planes);
}

int32_t brc_walls_wall(const brc_walls *walls, int32_t k)
{
    return k < walls->n_planes ? walls->plane_wall : walls->flat_wall[k - walls->n_planes];
}

void brc_walls_near(const brc_walls *walls, const double x[3], double reach, int64_t *first, int64_t *count)
{
    *first = *count = 0;
    const int64_t n = walls->n_planes;
    if (n == 0) return;
    double y[3], square = 0.0;
    const bool sphere = walls->round == BRC_SHAPE_SPHERE;
    for (int k = 0; k < 3; ++k) {
        y[k] = x[k] - walls->centre[k];
        if (sphere || k != walls->axis) square += y[k] * y[k];
    }
    const double radius = sqrt(square);
    /* a cone's planes widen along the axis; across the axis they are nearer than they are along their normal */
    const double widen = walls->slope != 0.0 ? walls->slope * y[walls->axis] : 0.0;
    const double limit =
        walls->slope != 0.0 ? widen - reach * sqrt(1.0 + walls->slope * walls->slope) : walls->offset - reach;
    if (limit - radius >= 0.0) return;
    /* plane k is nearer than reach where the angle between its normal and x is below alpha */
    const double cosine = radius > 0.0 ? limit / radius : -1.0;
    const double alpha = cosine <= -1.0 ? PI : acos(fmin(cosine, 1.0));
    if (sphere) {
        const double polar = radius > 0.0 ? acos(fmax(-1.0, fmin(1.0, y[2] / radius))) : 0.0;
        const double z_high = cos(fmax(0.0, polar - alpha)), z_low = cos(fmin(PI, polar + alpha));
        const double low = floor((1.0 - z_high) * (double)n / 2.0 - 0.5) - 1.0;
        const double high = ceil((1.0 - z_low) * (double)n / 2.0 - 0.5) + 1.0;
        *first = low > 0.0 ? (int64_t)low : 0;
        *count = (high < (double)n ? (int64_t)high : n - 1) - *first + 1;
    } else {
        const int u = (walls->axis + 1) % 3, v = (walls->axis + 2) % 3;
        const double step = 2.0 * PI / (double)n, phi = atan2(y[v], y[u]);
        const int64_t low = (int64_t)floor((phi - alpha) / step) - 1, high = (int64_t)ceil((phi + alpha) / step) + 1;
        *first = ((low % n) + n) % n;
        *count = high - low + 1 < n ? high - low + 1 : n;
    }
}

void brc_walls_keep_off(const brc_walls *walls, double distance, double x[3])
{
    enum { MOST_FEET = 16 };
    if (!walls->mirrored) return;
    brc_foot feet[MOST_FEET];
    const int32_t found = brc_solid_feet(walls->solid, x, distance, feet, MOST_FEET);
    double y[3] = {x[0], x[1], x[2]};
    for (int32_t f = 0; f < found && f < MOST_FEET; ++f)
        for (int d = 0; d < 3 && !feet[f].hull; ++d)
            y[d] -= (distance - feet[f].depth) * feet[f].normal[d];
    if (found > 0 && brc_walls_inside(walls, y, 0.0)) memcpy(x, y, sizeof y);
}

bool brc_walls_inside(const brc_walls *walls, const double x[3], double margin)
{
    for (int side = 0; side < 6; ++side) {
        if (walls->side_wall[side] < 0) continue;
        const double depth = (side % 2 ? 1.0 : -1.0) * (walls->box[side % 2][side / 2] - x[side / 2]);
        if (!(depth >= margin)) return false;
    }
    int64_t first, count;
    brc_walls_near(walls, x, margin, &first, &count);
    for (int64_t m = first; m < first + count; ++m)
        if (!(brc_walls_depth(walls, (int32_t)(m % walls->n_planes), x) >= margin)) return false;
    for (int32_t k = walls->n_planes; k < walls->n_planes + walls->n_flats; ++k)
        if (!(brc_walls_depth(walls, k, x) >= margin)) return false;
    return !walls->mirrored || brc_solid_inside(walls->solid, x, margin);
}
