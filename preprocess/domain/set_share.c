/* A convex face is a fan of triangles, each of which is cut by one plane after the other (Sutherland and Hodgman, Comm.
 * ACM 17 (1974) 32). */
#include "set_share.h"
#include "sets.h"

#include <math.h>
#include <string.h>

enum {
    PLANES = 7,
    CORNERS = 48
}; /* a cut adds one corner; were rounding to make every second one cross, half as many: 3, 4, 6, 9, 13, 19, 28, 42 */

/* Inside: normal . x >= level. */
typedef struct plane {
    double normal[3], level;
} plane;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int planes_of(const brc_predicate *where, plane out[PLANES])
{
    int n = 0;
    for (int k = 0; where->has_box && k < 3; ++k)
        for (int side = 0; side < 2; ++side) {
            plane *p = &out[n++];
            *p = (plane){.level = side ? -where->box[1][k] : where->box[0][k]};
            p->normal[k] = side ? -1 : 1;
        }
    if (where->has_half_space) {
        const double length = sqrt(dot(where->half_space_normal, where->half_space_normal));
        plane *p = &out[n++];
        for (int c = 0; c < 3; ++c)
            p->normal[c] = where->half_space_normal[c] / length;
        p->level = dot(p->normal, where->half_space_point);
    }
    return n;
}

/* Corners of the part of a polygon inside a plane; in place. */
static int cut(double (*x)[3], int n, const plane *p)
{
    double kept[CORNERS][3];
    int m = 0;
    for (int i = 0; i < n; ++i) {
        const double *a = x[i], *b = x[(i + 1) % n];
        const double from = dot(p->normal, a) - p->level, to = dot(p->normal, b) - p->level;
        if (from >= 0) memcpy(kept[m++], a, sizeof kept[0]);
        if ((from < 0) != (to < 0)) {
            for (int c = 0; c < 3; ++c)
                kept[m][c] = a[c] + (b[c] - a[c]) * (from / (from - to));
            ++m;
        }
    }
    memcpy(x, kept, (size_t)m * sizeof kept[0]);
    return m;
}

/* Add the area along the unit normal, and area times centroid, of a fan. */
static double add_fan(double (*x)[3], int n, const double normal[3], double moment[3])
{
    double sum = 0;
    for (int i = 2; i < n; ++i) {
        double u[3], v[3];
        for (int c = 0; c < 3; ++c) {
            u[c] = x[i - 1][c] - x[0][c];
            v[c] = x[i][c] - x[0][c];
        }
        const double cross[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double area = 0.5 * dot(cross, normal);
        for (int c = 0; c < 3; ++c)
            moment[c] += area * (x[0][c] + x[i - 1][c] + x[i][c]) / 3;
        sum += area;
    }
    return sum;
}

bool brc_predicate_cuts(const brc_predicate *where)
{
    return where->has_box || where->has_half_space;
}

double brc_predicate_share(const brc_predicate *where, const brc_domain *domain, int64_t face, double area[3],
                           double centroid[3])
{
    const double *whole = domain->free_area_vector + 3 * face, slack = BRC_SET_SLACK * domain->quality.mean_spacing;
    const int64_t first = domain->free_polygon_start[face];
    const int n = (int)(domain->free_polygon_start[face + 1] - domain->free_polygon_start[face]);
    const double size = sqrt(dot(whole, whole));
    brc_predicate rest = *where;
    plane planes[PLANES];
    const int n_planes = planes_of(where, planes);
    memcpy(area, whole, 3 * sizeof *area);
    memcpy(centroid, domain->free_centroid + 3 * face, 3 * sizeof *centroid);
    if (n < 3 || !(size > 0)) return brc_predicate_holds(where, BRC_SET_FACES, domain, face) ? 1 : 0;
    rest.has_box = rest.has_half_space = false;
    if (!brc_predicate_holds(&rest, BRC_SET_FACES, domain, face)) return 0;
    bool is_cut = false;
    for (int p = 0; p < n_planes; ++p) {
        int inside = 0;
        for (int k = 0; k < n; ++k)
            inside += dot(planes[p].normal, brc_domain_free_corner(domain, first + k)) - planes[p].level >= -slack;
        if (inside == 0) return 0;
        is_cut |= inside < n;
    }
    if (!is_cut) return 1;
    const double normal[3] = {whole[0] / size, whole[1] / size, whole[2] / size};
    double all = 0, part = 0, moment[3] = {0}, ignored[3] = {0};
    for (int k = 2; k < n; ++k) {
        double x[CORNERS][3];
        const int64_t ends[3] = {first, first + k - 1, first + k};
        for (int i = 0; i < 3; ++i)
            memcpy(x[i], brc_domain_free_corner(domain, ends[i]), sizeof x[i]);
        all += add_fan(x, 3, normal, ignored);
        int m = 3;
        for (int p = 0; p < n_planes && m > 0; ++p)
            m = cut(x, m, &planes[p]);
        part += add_fan(x, m, normal, moment);
    }
    const double share = all > 0 ? part / all : 0;
    if (!(share > BRC_SET_SLACK)) return 0;
    for (int c = 0; c < 3; ++c) {
        area[c] = share * whole[c];
        centroid[c] = moment[c] / part;
    }
    return share;
}
