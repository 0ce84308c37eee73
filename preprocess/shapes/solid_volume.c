/* Bounds, volume and surface of a shape of several parts, by rays: where a line enters and leaves is known exactly, so
 * the volume is the sum of exact chords over a regular set of parallel lines. Their direction is askew to everything,
 * so that no wall hides between two lines; with a mesh it is an axis of the mesh, along which the mesh tells its
 * crossings. Everything is summed in a fixed order. */
#include "solid_internal.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>

enum { MOST_CROSSINGS = 512, MOST_HALVINGS = 40, LEAST_GRID = 64, MOST_GRID = 1024 };
/* The grid of lines is refined until two grids differ by less [of the volume]. */
#define GOAL 1e-6

/* Few values, nearly in order. */
void brc_sort(double *t, int n)
{
    for (int k = 1; k < n; ++k) {
        const double value = t[k];
        int at = k;
        for (; at > 0 && t[at - 1] > value; --at)
            t[at] = t[at - 1];
        t[at] = value;
    }
}

/* Does the line run along an axis of the part's own frame? */
static int axis_of(const brc_leaf *leaf, const double u[3])
{
    for (int axis = 0; axis < 3; ++axis)
        if (u[0] * leaf->frame[0][axis] + u[1] * leaf->frame[1][axis] + u[2] * leaf->frame[2][axis] > 1.0 - 1e-15)
            return axis;
    return -1;
}

/* How many there are; those beyond `most` are not written. */
static int mesh_crossings(const brc_leaf *leaf, const double x[3], const double u[3], double low, double high,
                          double *t, int most)
{
    const int axis = axis_of(leaf, u);
    double y[3], v[3];
    brc_leaf_to_part(leaf, x, y);
    if (axis >= 0) {
        const int32_t n = brc_mesh_crossings(leaf->mesh, y, axis, t, most);
        if (n <= most) return n;
    }
    for (int d = 0; d < 3; ++d)
        v[d] = u[0] * leaf->frame[0][d] + u[1] * leaf->frame[1][d] + u[2] * leaf->frame[2][d];
    return brc_mesh_passes(leaf->mesh, y, v, low, high, t, most);
}

/* The line's parameters where it passes the box; false when it misses it. */
bool brc_pass_box(const double bounds[2][3], const double x[3], const double u[3], double *low, double *high)
{
    *low = -HUGE_VAL;
    *high = HUGE_VAL;
    for (int d = 0; d < 3; ++d) {
        if (u[d] == 0.0) {
            if (x[d] < bounds[0][d] || x[d] > bounds[1][d]) return false;
            continue;
        }
        const double a = (bounds[0][d] - x[d]) / u[d], b = (bounds[1][d] - x[d]) / u[d];
        *low = fmax(*low, fmin(a, b));
        *high = fmin(*high, fmax(a, b));
    }
    return *low < *high;
}

typedef struct chords {
    double length, last; /* inside the solid; where the line leaves it for good */
    int n;               /* crossings of the solid's surface, begin and end of the line in it among them */
    bool begins, ends;   /* in the solid */
} chords;

static bool member_at(const brc_solid *solid, const double x[3], const double u[3], double t)
{
    const double y[3] = {x[0] + t * u[0], x[1] + t * u[1], x[2] + t * u[2]};
    return brc_solid_member(solid, y);
}

/* All places of low < t < high where the line may enter or leave, and both ends; more than MOST_CROSSINGS: too many to
 * be written. */
static int find_cuts(const brc_solid *solid, const double x[3], const double u[3], double low, double high,
                     double cut[MOST_CROSSINGS])
{
    int n = 0;
    cut[n++] = low;
    cut[n++] = high;
    for (int32_t k = 0; k < solid->n_leaves; ++k) {
        const brc_leaf *leaf = &solid->leaf[k];
        double from, to, some[4];
        if (!brc_pass_box(leaf->bounds, x, u, &from, &to) || from > high || to < low) continue;
        if (leaf->mesh) {
            n += mesh_crossings(leaf, x, u, low, high, cut + n, MOST_CROSSINGS - n);
            if (n > MOST_CROSSINGS) return n;
            continue;
        }
        for (int32_t s = leaf->first; s < leaf->first + leaf->n_surfaces; ++s) {
            const int found = brc_surface_crossings(&solid->surface[s], x, u, some);
            for (int i = 0; i < found; ++i) {
                if (!(some[i] > low && some[i] < high)) continue;
                if (n == MOST_CROSSINGS) return n + 1;
                cut[n++] = some[i];
            }
        }
    }
    return n;
}

/* Follow the line x + t u through the solid from t = low to high. u: unit. Where there are more crossings than fit, by
 * halves. */
static chords follow_piece(const brc_solid *solid, const double x[3], const double u[3], double low, double high,
                           int halvings)
{
    chords result = {.length = 0.0, .last = -HUGE_VAL};
    double cut[MOST_CROSSINGS];
    const int n = find_cuts(solid, x, u, low, high, cut);
    if (n > MOST_CROSSINGS && halvings < MOST_HALVINGS) {
        const double middle = 0.5 * (low + high);
        const chords a = follow_piece(solid, x, u, low, middle, halvings + 1),
                     b = follow_piece(solid, x, u, middle, high, halvings + 1);
        return (chords){.length = a.length + b.length,
                        .last = fmax(a.last, b.last),
                        .n = a.n + b.n - (a.ends && b.begins ? 2 : 0),
                        .begins = a.begins,
                        .ends = b.ends};
    }
    if (n > MOST_CROSSINGS) { /* a piece without length */
        result.begins = result.ends = member_at(solid, x, u, 0.5 * (low + high));
        result.n = result.begins ? 2 : 0;
        return result;
    }
    brc_sort(cut, n);
    bool was = false;
    for (int k = 0; k + 1 < n; ++k) {
        const double a = fmax(cut[k], low), b = fmin(cut[k + 1], high);
        if (!(b > a)) continue;
        /* at both of two points: a line may touch a surface at one without a crossing being found */
        const bool in = member_at(solid, x, u, a + 0.382 * (b - a)) && member_at(solid, x, u, a + 0.764 * (b - a));
        if (in) {
            result.length += b - a;
            result.last = b;
        }
        result.begins = result.begins || (in && a == low);
        result.n += in != was;
        was = in;
    }
    result.ends = was;
    result.n += was;
    return result;
}

static chords follow(const brc_solid *solid, const double x[3], const double u[3])
{
    double low, high;
    if (!brc_pass_box(solid->bounds, x, u, &low, &high)) return (chords){.length = 0.0, .last = -HUGE_VAL};
    return follow_piece(solid, x, u, low, high, 0);
}

double brc_solid_outside(const brc_solid *solid, const double a[3], const double b[3])
{
    double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double length = brc_length3(u);
    if (!(length > 0.0)) return 0.0;
    for (int d = 0; d < 3; ++d)
        u[d] /= length;
    return length - follow_piece(solid, a, u, 0.0, length, 0).length;
}

/* Two unit vectors at right angles to u and to each other. */
static void across(const double u[3], double e1[3], double e2[3])
{
    const int small = fabs(u[0]) < 0.6 ? 0 : 1;
    for (int d = 0; d < 3; ++d)
        e1[d] = (d == small) - u[small] * u[d];
    const double length = brc_length3(e1);
    for (int d = 0; d < 3; ++d)
        e1[d] /= length;
    for (int d = 0; d < 3; ++d)
        e2[d] = u[(d + 1) % 3] * e1[(d + 2) % 3] - u[(d + 2) % 3] * e1[(d + 1) % 3];
    /* turned about u, for e1 is the shadow of an axis and the shadows of edges must not run along the rows of lines */
    const double c = cos(0.6), s = sin(0.6);
    for (int d = 0; d < 3; ++d) {
        const double a = e1[d], b = e2[d];
        e1[d] = c * a + s * b;
        e2[d] = c * b - s * a;
    }
}

/* Volume and crossings along n x n lines of direction u through the bounds; *per_line: area a line stands for. */
static brc_status shoot(brc_context *context, const brc_solid *solid, const double u[3], int n, int n_threads,
                        double *volume, double *crossings)
{
    double e1[3], e2[3], low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    double *row = NULL;
    across(u, e1, e2);
    for (int corner = 0; corner < 8; ++corner) {
        const double x[3] = {solid->bounds[corner & 1][0], solid->bounds[corner >> 1 & 1][1],
                             solid->bounds[corner >> 2 & 1][2]};
        const double p[2] = {brc_dot3(x, e1), brc_dot3(x, e2)};
        for (int k = 0; k < 2; ++k) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    const double step[2] = {(high[0] - low[0]) / n, (high[1] - low[1]) / n};
    BRC_TRY(BRC_ALLOCATE(context, &row, 2 * n, "rows of rays"));
#pragma omp parallel for schedule(dynamic, 4) num_threads(n_threads)
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double p = low[0] + (i + 0.5) * step[0], q = low[1] + (j + 0.5) * step[1];
            const double x[3] = {p * e1[0] + q * e2[0], p * e1[1] + q * e2[1], p * e1[2] + q * e2[2]};
            const chords c = follow(solid, x, u);
            row[2 * i] += c.length;
            row[2 * i + 1] += c.n;
        }
    *volume = *crossings = 0.0;
    for (int i = 0; i < n; ++i) {
        *volume += row[2 * i];
        *crossings += row[2 * i + 1];
    }
    *volume *= step[0] * step[1];
    *crossings *= step[0] * step[1];
    brc_memory_free(row);
    return BRC_OK;
}

/* Farthest point of the solid along an axis: rays through the leaf, then closer and closer around the best. */
static double farthest(const brc_solid *solid, const brc_leaf *leaf, int axis, double sign, double least)
{
    enum { COARSE = 65, FINE = 7, LEVELS = 60 };
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double direction[3] = {0.0, 0.0, 0.0}, best = least, at[2] = {0.0, 0.0}, half[2];
    bool found = false;
    direction[axis] = sign;
    for (int level = 0; level <= LEVELS; ++level) {
        const int n = level == 0 ? COARSE : FINE;
        double centre[2] = {at[0], at[1]};
        if (level == 0) {
            centre[0] = 0.5 * (leaf->bounds[0][u] + leaf->bounds[1][u]);
            centre[1] = 0.5 * (leaf->bounds[0][v] + leaf->bounds[1][v]);
            half[0] = 0.5 * (leaf->bounds[1][u] - leaf->bounds[0][u]);
            half[1] = 0.5 * (leaf->bounds[1][v] - leaf->bounds[0][v]);
        }
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                double x[3] = {0.0, 0.0, 0.0};
                x[u] = centre[0] + half[0] * (2.0 * (i + 0.5) / n - 1.0);
                x[v] = centre[1] + half[1] * (2.0 * (j + 0.5) / n - 1.0);
                const double last = follow(solid, x, direction).last;
                if (!(last > best)) continue;
                best = last;
                at[0] = x[u];
                at[1] = x[v];
                found = true;
            }
        if (!found) return least;
        half[0] *= level == 0 ? 2.0 / COARSE : 0.6;
        half[1] *= level == 0 ? 2.0 / COARSE : 0.6;
    }
    return best;
}

static void find_bounds(brc_solid *solid)
{
    double tight[2][3];
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const double sign = side ? 1.0 : -1.0;
            double best = -HUGE_VAL;
            for (int32_t k = 0; k < solid->n_leaves; ++k) {
                const brc_leaf *leaf = &solid->leaf[k];
                if (leaf->role == BRC_PART_ADD && sign * leaf->bounds[side][axis] > best)
                    best = farthest(solid, leaf, axis, sign, best);
            }
            for (int32_t s = 0; s < solid->n_surfaces; ++s) { /* a flat side is met exactly */
                const brc_surface *plane = &solid->surface[s];
                if (plane->kind == BRC_SURFACE_PLANE && fabs(plane->axis[axis]) == 1.0 &&
                    fabs(sign * plane->point[axis] - best) < solid->tiny)
                    best = sign * plane->point[axis];
            }
            tight[side][axis] = sign * best;
        }
    memcpy(solid->bounds, tight, sizeof tight);
}

/* Directions of the lines for the volume: askew, or the first axis of the first mesh. */
static void choose_direction(const brc_solid *solid, double u[3])
{
    static const double askew[3] = {0.5773, 0.3141, 0.7535};
    for (int d = 0; d < 3; ++d)
        u[d] = askew[d] / brc_length3(askew);
    for (int32_t k = 0; k < solid->n_leaves; ++k)
        if (solid->leaf[k].mesh) {
            for (int d = 0; d < 3; ++d)
                u[d] = solid->leaf[k].frame[d][0];
            return;
        }
}

brc_status brc_solid_measure(brc_context *context, brc_solid *solid, int n_threads)
{
    static const double some[7][3] = {{1, 0.01, 0.02},     {0.02, 1, 0.01},     {0.01, 0.02, 1},    {0.58, 0.57, 0.59},
                                      {-0.58, 0.57, 0.59}, {0.58, -0.57, 0.59}, {0.58, 0.57, -0.59}};
    double u[3], before = 0.0, last_change = 1.0, crossings;
    find_bounds(solid);
    for (int d = 0; d < 3; ++d)
        if (!(solid->bounds[1][d] - solid->bounds[0][d] > solid->tiny))
            return BRC_FAIL(
                context, BRC_BAD_INPUT,
                "shape: its parts leave nothing; check their places and the order in which they are removed and kept");
    choose_direction(solid, u);
    for (int n = LEAST_GRID; n <= MOST_GRID; n *= 2) {
        BRC_TRY(shoot(context, solid, u, n, n_threads, &solid->volume, &crossings));
        const double change = solid->volume > 0.0 ? fabs(before / solid->volume - 1.0) : 1.0;
        solid->volume_error = fmax(change, 0.25 * last_change); /* two grids may agree by chance, three hardly */
        if (solid->volume_error < GOAL) break;
        before = solid->volume;
        last_change = change;
    }
    /* every surface patch is met by the lines of a direction as often as its projection is large: half its area on
     * average */
    for (int k = 0; k < 7; ++k) {
        double volume;
        for (int d = 0; d < 3; ++d)
            u[d] = some[k][d] / brc_length3(some[k]);
        BRC_TRY(shoot(context, solid, u, 48, n_threads, &volume, &crossings));
        solid->area += 2.0 * crossings / 7.0;
    }
    return BRC_OK;
}
