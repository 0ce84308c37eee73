#include "crack_statistics.h"
#include "../../solver/core/sym3.h"
#include <math.h>
#include <string.h>

/* The largest component positive, the first of equals, so that a line has one sign. */
static void orient(double v[3])
{
    int most = 0;
    for (int c = 1; c < 3; ++c)
        if (fabs(v[c]) > fabs(v[most])) most = c;
    for (int c = 0; v[most] < 0 && c < 3; ++c)
        v[c] = -v[c];
    for (int c = 0; c < 3; ++c)
        v[c] += 0.0; /* no negative zero */
}

static void add_dyad(double tensor[6], const double v[3], double weight)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    for (int k = 0; k < 6; ++k)
        tensor[k] += weight * v[row[k]] * v[column[k]];
}

/* Of all breaks, or where fragment is given of those between two of them. */
static void find_plane(int64_t n, const brc_break *breaks, const int32_t *fragment, brc_crack_plane *out)
{
    double spread[6] = {0}, value[3], axis[3][3];
    memset(out, 0, sizeof *out);
    for (int64_t k = 0; k < n; ++k) {
        const brc_break *b = &breaks[k];
        if (fragment && fragment[b->element_i] == fragment[b->element_j]) continue;
        out->n += 1;
        out->area += b->area;
        for (int c = 0; c < 3; ++c)
            out->point[c] += b->area * b->position[c];
    }
    if (!(out->area > 0)) return;
    for (int c = 0; c < 3; ++c)
        out->point[c] /= out->area;
    for (int64_t k = 0; k < n; ++k) {
        const brc_break *b = &breaks[k];
        if (fragment && fragment[b->element_i] == fragment[b->element_j]) continue;
        const double r[3] = {b->position[0] - out->point[0], b->position[1] - out->point[1],
                             b->position[2] - out->point[2]};
        add_dyad(spread, r, b->area / out->area);
    }
    brc_sym3_eigen(spread, value, axis);
    if (out->n < 3 || !(value[1] > 1e-12 * value[2])) return;
    memcpy(out->normal, axis[0], sizeof out->normal);
    orient(out->normal);
    out->rough = sqrt(fmax(value[0], 0));
}

void brc_crack_statistics_of(int64_t n, const brc_break *breaks, const int32_t *fragment, brc_crack_statistics *out)
{
    double value[3], axis[3][3];
    memset(out, 0, sizeof *out);
    for (int64_t k = 0; k < n; ++k) {
        const int mode = breaks[k].mode & (BRC_BREAK_MODES - 1);
        out->count[mode] += 1;
        out->area[mode] += breaks[k].area;
        out->total_area += breaks[k].area;
        add_dyad(out->fabric, breaks[k].normal, breaks[k].area);
    }
    if (!(out->total_area > 0)) return;
    for (int k = 0; k < 6; ++k)
        out->fabric[k] /= out->total_area;
    brc_sym3_eigen(out->fabric, value, axis);
    memcpy(out->normal, axis[2], sizeof out->normal);
    orient(out->normal);
    find_plane(n, breaks, NULL, &out->all);
    find_plane(n, breaks, fragment, &out->separating);
}

double brc_crack_angle(const double normal[3], int c)
{
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    return atan2(hypot(normal[a], normal[b]), fabs(normal[c])) * 180 / M_PI;
}
