/* A curved wall is replaced by planes at one common distance from its centre, chosen so that the polyhedron has exactly
 * the volume of the curved shape: nothing is scaled afterwards. A cylinder becomes a regular prism, a sphere the
 * polyhedron of half-spaces whose normals lie on a Fibonacci lattice. */
#include "shape.h"

#include "../host/base/memory.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Curved walls never get coarser than this: volume is exact at any number, but the outline should look round. */
enum { LEAST_PRISM_SIDES = 32, LEAST_SPHERE_PLANES = 256 };

static const char *const side_name[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

static brc_status check_size(brc_context *context, const char *what, double value)
{
    if (isfinite(value) && value > 0.0) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: %s is %g m, must be finite and > 0", what, value);
}

brc_status brc_shape_check(brc_context *context, const brc_shape *shape)
{
    for (int k = 0; k < 3; ++k)
        if (!isfinite(shape->origin[k]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: origin has the component %g, must be finite",
                            shape->origin[k]);
    switch (shape->kind) {
    case BRC_SHAPE_BOX:
        for (int k = 0; k < 3; ++k) BRC_TRY(check_size(context, "an edge length of the box", shape->size[k]));
        return BRC_OK;
    case BRC_SHAPE_CYLINDER:
        if (shape->axis < 0 || shape->axis > 2)
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: axis of the cylinder is %d, must be 0 (x), 1 (y) or 2 (z)",
                            shape->axis);
        BRC_TRY(check_size(context, "the length of the cylinder", shape->length));
        return check_size(context, "the radius of the cylinder", shape->radius);
    case BRC_SHAPE_SPHERE: return check_size(context, "the radius of the sphere", shape->radius);
    }
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: kind %d is unknown, must be box, cylinder or sphere",
                    (int)shape->kind);
}

void brc_shape_bounds(const brc_shape *shape, double bounds[2][3])
{
    for (int k = 0; k < 3; ++k) {
        const double x = shape->origin[k];
        const bool along = shape->kind == BRC_SHAPE_CYLINDER && k == shape->axis;
        if (shape->kind == BRC_SHAPE_BOX || along) {
            bounds[0][k] = x;
            bounds[1][k] = x + (along ? shape->length : shape->size[k]);
        } else {
            bounds[0][k] = x - shape->radius;
            bounds[1][k] = x + shape->radius;
        }
    }
}

double brc_shape_volume(const brc_shape *shape)
{
    const double r = shape->radius;
    switch (shape->kind) {
    case BRC_SHAPE_BOX: return shape->size[0] * shape->size[1] * shape->size[2];
    case BRC_SHAPE_CYLINDER: return PI * r * r * shape->length;
    case BRC_SHAPE_SPHERE: return 4.0 / 3.0 * PI * r * r * r;
    }
    return 0.0;
}

double brc_shape_planes(const brc_shape *shape, double spacing)
{
    const double r = shape->radius / spacing;
    switch (shape->kind) {
    case BRC_SHAPE_BOX: return 0.0;
    case BRC_SHAPE_CYLINDER: return fmax(LEAST_PRISM_SIDES, ceil(2.0 * PI * r));
    case BRC_SHAPE_SPHERE: return fmax(LEAST_SPHERE_PLANES, ceil(4.0 * PI * r * r));
    }
    return 0.0;
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
    for (int d = 0; d < 3; ++d) e1[d] /= length;
    for (int d = 0; d < 3; ++d) e2[d] = t[(d + 1) % 3] * e1[(d + 2) % 3] - t[(d + 2) % 3] * e1[(d + 1) % 3];
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

static void place_sphere(brc_walls *walls)
{
    const int32_t n = walls->n_planes;
    for (int32_t k = 0; k < n; ++k) fibonacci_normal(k, n, walls->normal + 3 * (int64_t)k);
    /* volume at distance 1 from the centre, as the sum of pyramids; it grows with the cube of the distance */
    walls->offset = 1.0;
    double volume = 0.0;
    const double half_width = 1.5 * sqrt(4.0 * PI / n);
    for (int32_t k = 0; k < n; ++k) {
        double area = 0.0, half = half_width;
        while (!facet_area(walls, k, half, &area) && half < 8.0) half *= 2.0;
        volume += area / 3.0;
    }
    walls->offset = walls->shape.radius * cbrt(4.0 / 3.0 * PI / volume);
}

static void place_prism(brc_walls *walls)
{
    const int32_t n = walls->n_planes;
    const int u = (walls->shape.axis + 1) % 3, v = (walls->shape.axis + 2) % 3;
    for (int32_t k = 0; k < n; ++k) {
        const double phi = 2.0 * PI * k / n;
        walls->normal[3 * (int64_t)k + u] = cos(phi);
        walls->normal[3 * (int64_t)k + v] = sin(phi);
    }
    /* a regular polygon of inner radius c has the area n c^2 tan(pi / n) */
    walls->offset = walls->shape.radius * sqrt(PI / (n * tan(PI / n)));
}

brc_status brc_walls_create(brc_context *context, const brc_shape *shape, double spacing, brc_walls *walls)
{
    memset(walls, 0, sizeof *walls);
    walls->shape = *shape;
    brc_shape_bounds(shape, walls->box);
    const bool sphere = shape->kind == BRC_SHAPE_SPHERE, cylinder = shape->kind == BRC_SHAPE_CYLINDER;
    for (int side = 0; side < 6; ++side) {
        const int k = side / 2;
        walls->side_wall[side] = -1;
        if (!sphere && !(cylinder && k != shape->axis)) {
            walls->side_wall[side] = walls->n_walls;
            walls->wall_name[walls->n_walls++] = side_name[side];
        } else {
            /* corners of the polyhedron stand out of the curved wall by at most a few percent */
            walls->box[side % 2][k] += (side % 2 ? 0.25 : -0.25) * shape->radius;
        }
    }
    if (shape->kind == BRC_SHAPE_BOX) return BRC_OK;
    for (int k = 0; k < 3; ++k) walls->centre[k] = shape->origin[k];
    walls->plane_wall = walls->n_walls;
    walls->wall_name[walls->n_walls++] = sphere ? "surface" : "side";
    const double n = brc_shape_planes(shape, spacing);
    if (n > 1e9)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: cells of %g m on a curved wall of radius %g m need %.3g wall planes; use larger cells",
                        spacing, shape->radius, n);
    BRC_TRY(BRC_ALLOCATE(context, &walls->normal, 3 * (int64_t)n, "planes of the curved wall"));
    walls->n_planes = (int32_t)n;
    if (sphere) place_sphere(walls);
    else place_prism(walls);
    return BRC_OK;
}

void brc_walls_free(brc_walls *walls)
{
    if (!walls) return;
    brc_memory_free(walls->normal);
    walls->normal = NULL;
    walls->n_planes = 0;
}

double brc_walls_depth(const brc_walls *walls, int32_t k, const double x[3])
{
    const double *n = walls->normal + 3 * (int64_t)k, *c = walls->centre;
    return walls->offset - (n[0] * (x[0] - c[0]) + n[1] * (x[1] - c[1]) + n[2] * (x[2] - c[2]));
}

void brc_walls_near(const brc_walls *walls, const double x[3], double reach, int64_t *first, int64_t *count)
{
    *first = *count = 0;
    const int64_t n = walls->n_planes;
    if (n == 0) return;
    double y[3], square = 0.0;
    const bool sphere = walls->shape.kind == BRC_SHAPE_SPHERE;
    for (int k = 0; k < 3; ++k) {
        y[k] = x[k] - walls->centre[k];
        if (sphere || k != walls->shape.axis) square += y[k] * y[k];
    }
    const double radius = sqrt(square);
    if (walls->offset - radius >= reach) return;
    /* plane k is nearer than reach where the angle between its normal and x is below alpha */
    const double cosine = radius > 0.0 ? (walls->offset - reach) / radius : -1.0;
    const double alpha = cosine <= -1.0 ? PI : acos(fmin(cosine, 1.0));
    if (sphere) {
        const double polar = radius > 0.0 ? acos(fmax(-1.0, fmin(1.0, y[2] / radius))) : 0.0;
        const double z_high = cos(fmax(0.0, polar - alpha)), z_low = cos(fmin(PI, polar + alpha));
        const double low = floor((1.0 - z_high) * (double)n / 2.0 - 0.5) - 1.0;
        const double high = ceil((1.0 - z_low) * (double)n / 2.0 - 0.5) + 1.0;
        *first = low > 0.0 ? (int64_t)low : 0;
        *count = (high < (double)n ? (int64_t)high : n - 1) - *first + 1;
    } else {
        const int u = (walls->shape.axis + 1) % 3, v = (walls->shape.axis + 2) % 3;
        const double step = 2.0 * PI / (double)n, phi = atan2(y[v], y[u]);
        const int64_t low = (int64_t)floor((phi - alpha) / step) - 1, high = (int64_t)ceil((phi + alpha) / step) + 1;
        *first = ((low % n) + n) % n;
        *count = high - low + 1 < n ? high - low + 1 : n;
    }
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
    return true;
}
