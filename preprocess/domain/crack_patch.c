#include "crack_patch.h"

#include <math.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void minus(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = a[k] - b[k];
}

void brc_crack_patch_make(const brc_crack *crack, brc_crack_patch *patch)
{
    *patch = (brc_crack_patch){.kind = crack->kind, .radius = crack->radius};
    double normal[3];
    for (int k = 0; k < 3; ++k) {
        patch->point[k] = crack->point[k];
        patch->edge[0][k] = crack->edge[0][k];
        patch->edge[1][k] = crack->edge[1][k];
        normal[k] = crack->normal[k];
    }
    if (crack->kind == BRC_CRACK_RECTANGLE) cross(crack->edge[0], crack->edge[1], normal);
    const double length = sqrt(dot(normal, normal));
    for (int k = 0; k < 3; ++k)
        patch->normal[k] = normal[k] / length;
    if (crack->kind == BRC_CRACK_DISC) return;
    for (int m = 0; m < 2; ++m) {
        cross(patch->edge[1 - m], patch->normal, patch->dual[m]);
        const double scale = dot(patch->dual[m], patch->edge[m]);
        for (int k = 0; k < 3; ++k)
            patch->dual[m][k] /= scale;
    }
}

double brc_crack_patch_height(const brc_crack_patch *patch, const double x[3])
{
    double r[3];
    minus(x, patch->point, r);
    return dot(r, patch->normal);
}

/* Distance from the axis of a disc [m]. */
static double axis_distance(const brc_crack_patch *patch, const double r[3])
{
    double away[3];
    cross(patch->normal, r, away);
    return sqrt(dot(away, away));
}

bool brc_crack_patch_covers(const brc_crack_patch *patch, const double x[3], double margin)
{
    double r[3];
    minus(x, patch->point, r);
    if (patch->kind == BRC_CRACK_DISC) return axis_distance(patch, r) <= patch->radius + margin;
    for (int m = 0; m < 2; ++m) {
        const double place = dot(patch->dual[m], r), slack = margin * sqrt(dot(patch->dual[m], patch->dual[m]));
        if (place < -slack || place > 1.0 + slack) return false;
    }
    return true;
}

double brc_crack_patch_depth(const brc_crack_patch *patch, int side, const double x[3], double outward[3])
{
    const int m = side / 2, is_far = side % 2;
    double r[3];
    minus(x, patch->point, r);
    const double size = sqrt(dot(patch->dual[m], patch->dual[m]));
    const double place = dot(patch->dual[m], r), beside = dot(patch->dual[1 - m], r);
    for (int k = 0; k < 3; ++k)
        outward[k] = (is_far ? patch->dual[m][k] : -patch->dual[m][k]) / size;
    if (beside < 0.0 || beside > 1.0) return -HUGE_VAL;
    return (is_far ? 1.0 - place : place) / size;
}

/* Distance of r to the edge that starts at `from` and runs along `along` [m]. */
static double edge_distance(const double r[3], const double from[3], const double along[3])
{
    double q[3];
    minus(r, from, q);
    const double t = fmax(0.0, fmin(1.0, dot(q, along) / dot(along, along)));
    for (int k = 0; k < 3; ++k)
        q[k] -= t * along[k];
    return sqrt(dot(q, q));
}

double brc_crack_patch_distance(const brc_crack_patch *patch, const double x[3])
{
    double r[3];
    minus(x, patch->point, r);
    const double height = fabs(dot(r, patch->normal));
    if (brc_crack_patch_covers(patch, x, 0.0)) return height;
    if (patch->kind == BRC_CRACK_DISC) return hypot(height, axis_distance(patch, r) - patch->radius);
    const double origin[3] = {0.0, 0.0, 0.0};
    double least = HUGE_VAL;
    for (int m = 0; m < 2; ++m) {
        least = fmin(least, edge_distance(r, origin, patch->edge[m]));
        least = fmin(least, edge_distance(r, patch->edge[1 - m], patch->edge[m]));
    }
    return least;
}
