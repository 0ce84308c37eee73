/* A convex cell has all of its corners on the inner side of a face's plane, and those on the plane are the corners of
 * the face. */
#include "outline.h"

#include <math.h>

/* Corners are on a plane to rounding, which is larger for cells far from the origin: the smallest of these tolerances
 * [of the cell's size] whose corners enclose the face's area is taken. */
#define FIRST_TOLERANCE 1e-14
#define LAST_TOLERANCE 1e-7
/* How well a polygon's area must match the face's [of the cell's size squared]. */
#define AREA_TOLERANCE 1e-9

/* Grows with the angle of (x, y) from -2 at the negative first axis to 2, without a function of the angle. */
static double turn_of(double x, double y)
{
    const double along = fabs(x) + fabs(y) > 0.0 ? y / (fabs(x) + fabs(y)) : 0.0;
    return x >= 0.0 ? along : y >= 0.0 ? 2.0 - along : -2.0 - along;
}

static bool comes_before(const brc_outline_corner *p, const brc_outline_corner *q)
{
    return p->angle != q->angle ? p->angle < q->angle : p->vertex < q->vertex;
}

/* By ascending angle; rings are short. */
static void sort_ring(brc_outline_corner *ring, int64_t n)
{
    for (int64_t k = 1; k < n; ++k) {
        const brc_outline_corner one = ring[k];
        int64_t at = k;
        for (; at > 0 && comes_before(&one, &ring[at - 1]); --at)
            ring[at] = ring[at - 1];
        ring[at] = one;
    }
}

static double polygon_area(const brc_outline_corner *c, int64_t n)
{
    double twice = 0.0;
    for (int64_t k = 0; k < n; ++k) {
        const double *a = c[k].at, *b = c[(k + 1) % n].at;
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return 0.5 * twice;
}

/* Two unit vectors that make a right-handed system with the unit vector n. */
static void plane_axes(const double n[3], double u[3], double v[3])
{
    int least = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(n[k]) < fabs(n[least])) least = k;
    double length = 0.0;
    for (int k = 0; k < 3; ++k) {
        u[k] = (k == least) - n[least] * n[k];
        length += u[k] * u[k];
    }
    for (int k = 0; k < 3; ++k)
        u[k] /= sqrt(length);
    for (int k = 0; k < 3; ++k)
        v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
}

int64_t brc_outline(const brc_domain *domain, int64_t e, int64_t h, brc_outline_corner *room, int32_t *out)
{
    const double *s = domain->area_vector + 3 * h, *centre = domain->face_centroid + 3 * h;
    const double area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    const double normal[3] = {s[0] / area, s[1] / area, s[2] / area};
    double u[3], v[3], size = 0.0;
    plane_axes(normal, u, v);
    const int64_t first = domain->vertex_start[e], n = domain->vertex_start[e + 1] - first;
    brc_outline_corner *all = room, *ring = room + n;
    for (int64_t k = 0; k < n; ++k) {
        const double *x = domain->vertex + 3 * (first + k);
        const double r[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
        all[k] = (brc_outline_corner){.vertex = (int32_t)(first + k)};
        for (int m = 0; m < 3; ++m) {
            all[k].height += r[m] * normal[m];
            all[k].at[0] += r[m] * u[m];
            all[k].at[1] += r[m] * v[m];
        }
        all[k].height = fabs(all[k].height);
        size = fmax(size, r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    }
    size = sqrt(size);
    int64_t before = 0;
    for (double tolerance = FIRST_TOLERANCE; tolerance < 2.0 * LAST_TOLERANCE; tolerance *= 10.0) {
        int64_t on = 0;
        for (int64_t k = 0; k < n; ++k)
            on += all[k].height <= tolerance * size;
        if (on < 3 || on == before) continue;
        before = on;
        on = 0;
        for (int64_t k = 0; k < n; ++k) {
            if (all[k].height > tolerance * size) continue;
            ring[on] = all[k];
            ring[on].angle = turn_of(ring[on].at[0], ring[on].at[1]);
            ++on;
        }
        sort_ring(ring, on);
        if (fabs(polygon_area(ring, on) - area) > AREA_TOLERANCE * size * size) continue;
        for (int64_t k = 0; k < on; ++k)
            out[k] = ring[k].vertex;
        return on;
    }
    return 0;
}
