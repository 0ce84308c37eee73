/* The surfaces shapes are made of: signed distance, normal and crossings with a line, each by its closed formula. */
#include "solid_internal.h"

#include <math.h>
#include <string.h>

double brc_dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double brc_length3(const double a[3])
{
    return sqrt(brc_dot3(a, a));
}

/* x in the cylindrical coordinates of the surface: height along the axis, distance from it and the unit vector away
 * from it (any one at right angles on the axis itself). */
static void cylindrical(const brc_surface *s, const double x[3], double *z, double *rho, double away[3])
{
    const double p[3] = {x[0] - s->point[0], x[1] - s->point[1], x[2] - s->point[2]};
    *z = brc_dot3(p, s->axis);
    for (int d = 0; d < 3; ++d)
        away[d] = p[d] - *z * s->axis[d];
    *rho = brc_length3(away);
    if (*rho > 0.0) {
        for (int d = 0; d < 3; ++d)
            away[d] /= *rho;
        return;
    }
    const int small = fabs(s->axis[0]) < 0.6 ? 0 : 1;
    for (int d = 0; d < 3; ++d)
        away[d] = (d == small) - s->axis[small] * s->axis[d];
    const double length = brc_length3(away);
    for (int d = 0; d < 3; ++d)
        away[d] /= length;
}

/* The nearest foot of a point outside a mesh or inside; the mesh may have several patches. */
static double mesh_height(const brc_leaf *leaf, const double x[3], double normal[3])
{
    double y[3];
    brc_leaf_to_part(leaf, x, y);
    const double depth = brc_mesh_depth(leaf->mesh, y);
    if (!normal) return -depth;
    brc_mesh_foot feet[BRC_MESH_VIEWS];
    const double reach =
        fabs(depth) * (1.0 + 1e-9) + 1e-12 * (brc_length3(leaf->bounds[1]) + brc_length3(leaf->bounds[0]));
    int32_t n = brc_mesh_feet(leaf->mesh, y, reach, feet, BRC_MESH_VIEWS);
    if (n > BRC_MESH_VIEWS) n = brc_mesh_views(leaf->mesh, y, reach, feet);
    const brc_mesh_foot *best = NULL;
    for (int32_t k = 0; k < n; ++k)
        if (!best || feet[k].distance < best->distance) best = &feet[k];
    double local[3] = {1.0, 0.0, 0.0};
    if (best) {
        memcpy(local, best->normal, sizeof local);
        if (best->distance > 0.0 && fabs(depth) > 1e-9 * brc_length3(leaf->bounds[1]))
            for (int d = 0; d < 3; ++d)
                local[d] = (best->point[d] - y[d]) / (depth > 0.0 ? best->distance : -best->distance);
    }
    brc_leaf_turn(leaf, local, normal);
    return -depth;
}

double brc_surface_height(const brc_solid *solid, const brc_surface *s, const double x[3], double normal[3])
{
    double z, rho, away[3];
    switch (s->kind) {
    case BRC_SURFACE_PLANE:
        if (normal) memcpy(normal, s->axis, sizeof s->axis);
        return (x[0] - s->point[0]) * s->axis[0] + (x[1] - s->point[1]) * s->axis[1] +
               (x[2] - s->point[2]) * s->axis[2];
    case BRC_SURFACE_SPHERE: {
        const double p[3] = {x[0] - s->point[0], x[1] - s->point[1], x[2] - s->point[2]};
        const double r = brc_length3(p);
        if (normal)
            for (int d = 0; d < 3; ++d)
                normal[d] = r > 0.0 ? p[d] / r : (d == 0);
        return r - s->radius;
    }
    case BRC_SURFACE_CYLINDER:
        cylindrical(s, x, &z, &rho, away);
        if (normal) memcpy(normal, away, sizeof away);
        return rho - s->radius;
    case BRC_SURFACE_CONE: {
        cylindrical(s, x, &z, &rho, away);
        if (z * s->cosine + rho * s->sine >= 0.0) {
            if (normal)
                for (int d = 0; d < 3; ++d)
                    normal[d] = s->cosine * away[d] - s->sine * s->axis[d];
            return rho * s->cosine - z * s->sine;
        }
        const double r = hypot(rho, z); /* beyond the tip */
        if (normal)
            for (int d = 0; d < 3; ++d)
                normal[d] = r > 0.0 ? (rho * away[d] + z * s->axis[d]) / r : -s->axis[d];
        return r;
    }
    case BRC_SURFACE_TORUS: {
        cylindrical(s, x, &z, &rho, away);
        const double across = rho - s->radius, q = hypot(across, z);
        if (normal)
            for (int d = 0; d < 3; ++d)
                normal[d] = q > 0.0 ? (across * away[d] + z * s->axis[d]) / q : away[d];
        return q - s->radius2;
    }
    case BRC_SURFACE_MESH: return mesh_height(&solid->leaf[s->leaf], x, normal);
    }
    return HUGE_VAL;
}

bool brc_surface_around(const brc_surface *s, const double x[3], int k, double *height, double normal[3])
{
    static const double turn = 6.283185307179586 / BRC_TUBE_PLANES;
    const double c = cos(k * turn), q = sin(k * turn);
    double z, rho, away[3], beside[3];
    if (s->kind != BRC_SURFACE_CYLINDER && s->kind != BRC_SURFACE_CONE && s->kind != BRC_SURFACE_TORUS) return false;
    cylindrical(s, x, &z, &rho, away);
    if (s->kind == BRC_SURFACE_TORUS) { /* around the tube, whose axis is at right angles to both */
        const double across = rho - s->radius, from_line = hypot(across, z);
        const double u = from_line > 0.0 ? across / from_line : 1.0, v = from_line > 0.0 ? z / from_line : 0.0;
        for (int d = 0; d < 3; ++d)
            normal[d] = (c * u - q * v) * away[d] + (c * v + q * u) * s->axis[d];
        *height = from_line * c - s->radius2;
        return true;
    }
    for (int d = 0; d < 3; ++d)
        beside[d] = s->axis[(d + 1) % 3] * away[(d + 2) % 3] - s->axis[(d + 2) % 3] * away[(d + 1) % 3];
    for (int d = 0; d < 3; ++d)
        normal[d] = c * away[d] + q * beside[d];
    *height = rho * c - s->radius;
    if (s->kind == BRC_SURFACE_CYLINDER) return true;
    for (int d = 0; d < 3; ++d)
        normal[d] = s->cosine * normal[d] - s->sine * s->axis[d];
    *height = rho * c * s->cosine - z * s->sine;
    return true;
}

bool brc_surface_opposite(const brc_surface *s, const double x[3], double *height, double normal[3])
{
    double z, rho, away[3];
    if (s->kind == BRC_SURFACE_CONE) {
        cylindrical(s, x, &z, &rho, away);
        if (z * s->cosine - rho * s->sine <= 0.0) return false;
    }
    if (s->kind != BRC_SURFACE_SPHERE) return brc_surface_around(s, x, BRC_TUBE_PLANES / 2, height, normal);
    *height = -2.0 * s->radius - brc_surface_height(NULL, s, x, normal);
    for (int d = 0; d < 3; ++d)
        normal[d] = -normal[d];
    return true;
}

/* Real roots of a t^2 + 2 b t + c without cancellation. */
static int quadratic(double a, double b, double c, double t[2])
{
    const double discriminant = b * b - a * c;
    if (a == 0.0) {
        if (b == 0.0) return 0;
        t[0] = -0.5 * c / b;
        return 1;
    }
    if (discriminant < 0.0) return 0;
    const double q = -(b + copysign(sqrt(discriminant), b));
    t[0] = q / a;
    t[1] = q != 0.0 ? c / q : 0.0;
    return 2;
}

static double polynomial(const double *coefficient, int degree, double t)
{
    double value = coefficient[degree];
    for (int k = degree - 1; k >= 0; --k)
        value = value * t + coefficient[k];
    return value;
}

/* Roots of a polynomial of degree <= 4 within low..high, ascending: between two neighbouring extrema there is at most
 * one, found by Newton's steps kept inside its bracket. Double roots, where a line only touches, may be missed. */
static int real_roots(const double *coefficient, int degree, double low, double high, double *root)
{
    double derivative[5], turn[6];
    if (degree < 1) return 0;
    for (int k = 1; k <= degree; ++k)
        derivative[k - 1] = k * coefficient[k];
    int n_turns = degree > 1 ? real_roots(derivative, degree - 1, low, high, turn + 1) : 0;
    turn[0] = low;
    turn[++n_turns] = high;
    int n = 0;
    for (int k = 0; k < n_turns; ++k) {
        double a = turn[k], b = turn[k + 1];
        const double fa = polynomial(coefficient, degree, a), fb = polynomial(coefficient, degree, b);
        if (fa == 0.0 || fa * fb > 0.0) continue; /* a root at b belongs to this piece */
        double t = 0.5 * (a + b);
        for (int i = 0; i < 100; ++i) {
            const double f = polynomial(coefficient, degree, t), slope = polynomial(derivative, degree - 1, t);
            if (fa * f > 0.0)
                a = t;
            else
                b = t;
            double next = t - f / slope;
            if (!(next > a && next < b)) next = 0.5 * (a + b);
            const double step = fabs(next - t);
            t = next;
            if (step <= 4e-16 * (fabs(low) + fabs(high))) break;
        }
        root[n++] = t;
    }
    return n;
}

/* (|p|^2 + R^2 - r^2)^2 = 4 R^2 rho^2 along the line, with t counted from the point nearest to the centre. */
static int torus_crossings(const brc_surface *s, const double x[3], const double u[3], double t[4])
{
    double p[3] = {x[0] - s->point[0], x[1] - s->point[1], x[2] - s->point[2]};
    const double start = -brc_dot3(p, u);
    for (int d = 0; d < 3; ++d)
        p[d] += start * u[d];
    const double outer = s->radius + s->radius2, square = brc_dot3(p, p);
    if (square >= outer * outer) return 0;
    const double z = brc_dot3(p, s->axis), uz = brc_dot3(u, s->axis), big = s->radius * s->radius;
    const double k = square + big - s->radius2 * s->radius2;
    const double coefficient[5] = {k * k - 4.0 * big * (square - z * z), 8.0 * big * z * uz,
                                   2.0 * k - 4.0 * big * (1.0 - uz * uz), 0.0, 1.0};
    const double reach = 1.001 * sqrt(outer * outer - square) + 1e-9 * outer;
    const int n = real_roots(coefficient, 4, -reach, reach, t);
    for (int i = 0; i < n; ++i)
        t[i] += start;
    return n;
}

int brc_surface_crossings(const brc_surface *s, const double x[3], const double u[3], double t[4])
{
    const double p[3] = {x[0] - s->point[0], x[1] - s->point[1], x[2] - s->point[2]};
    const double pu = brc_dot3(p, u), pp = brc_dot3(p, p);
    const double z = brc_dot3(p, s->axis), uz = brc_dot3(u, s->axis);
    switch (s->kind) {
    case BRC_SURFACE_PLANE:
        if (uz == 0.0) return 0;
        t[0] = -z / uz;
        return 1;
    case BRC_SURFACE_SPHERE: return quadratic(1.0, pu, pp - s->radius * s->radius, t);
    case BRC_SURFACE_CYLINDER: return quadratic(1.0 - uz * uz, pu - z * uz, pp - z * z - s->radius * s->radius, t);
    case BRC_SURFACE_CONE: {
        const double c2 = s->cosine * s->cosine;
        return quadratic(uz * uz - c2, z * uz - c2 * pu, z * z - c2 * pp,
                         t); /* both nappes: whoever asks tests the sides */
    }
    case BRC_SURFACE_TORUS: return torus_crossings(s, x, u, t);
    case BRC_SURFACE_MESH: break;
    }
    return 0;
}
