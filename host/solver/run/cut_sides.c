#include "cut_sides.h"
#include "run_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of what the sides of a cut have moved past each other, on all of it, the part that must lie in each other to be told
 * of: what a tip or a wave leaves is less. */
static const double least_part = 0.1;

/* A face of a cut, seen from one side. */
typedef struct side {
    double centroid[3];
    int32_t face;
} side;

static int by_place(const void *left, const void *right)
{
    const side *a = left, *b = right;
    for (int c = 0; c < 3; ++c)
        if (a->centroid[c] != b->centroid[c]) return a->centroid[c] < b->centroid[c] ? -1 : 1;
    return (a->face > b->face) - (a->face < b->face);
}

/* u + H (C - X) of a free face. */
static void moved(const brc_domain *d, int32_t face, const double *u, const double *h, double out[3])
{
    const int64_t e = d->free_element[face];
    for (int i = 0; i < 3; ++i) {
        out[i] = u[3 * e + i];
        for (int j = 0; j < 3; ++j)
            out[i] += h[9 * e + 3 * i + j] * (d->free_centroid[3 * (int64_t)face + j] - d->position[3 * e + j]);
    }
}

/* How far the sides of a cut are in each other at most [m], and by area the share of it where they are, and of all that
 * they moved past each other. */
typedef struct overlap {
    double deepest, share, part;
} overlap;

/* side: n faces by place; those of the two sides are neighbours there, with opposite area vectors. */
static overlap overlap_of(const brc_domain *d, const side *sides, int64_t n, const double *u, const double *h)
{
    overlap out = {0, 0, 0};
    double area = 0, lapped = 0, in = 0, all = 0;
    for (int64_t k = 0; k + 1 < n; ++k) {
        const int32_t f = sides[k].face, g = sides[k + 1].face;
        const double *s = d->free_area_vector + 3 * (int64_t)f, *t = d->free_area_vector + 3 * (int64_t)g;
        double a[3], b[3], gap = 0, square = 0, size = 0;
        if (memcmp(sides[k].centroid, sides[k + 1].centroid, sizeof sides->centroid) != 0) continue;
        if (!(s[0] * t[0] + s[1] * t[1] + s[2] * t[2] < 0)) continue;
        moved(d, f, u, h, a);
        moved(d, g, u, h, b);
        for (int c = 0; c < 3; ++c) {
            gap += (b[c] - a[c]) * s[c];
            square += (b[c] - a[c]) * (b[c] - a[c]);
            size += s[c] * s[c];
        }
        size = sqrt(size);
        area += size;
        all += size * sqrt(square);
        if (gap < 0) {
            lapped += size;
            in -= gap;
            out.deepest = fmax(out.deepest, -gap / size);
        }
    }
    if (all > 0) out.share = lapped / area, out.part = in / all;
    return out;
}

static void tell(const brc_simulation *s, const char *crack, const overlap *o)
{
    const brc_stage *stage = brc_current_stage(s);
    brc_log(s->context, BRC_LOG_WARNING,
            "stage '%s': at its end the sides of crack '%s' lie in each other, over %.0f %% of it and by up to %.3g m: "
            "a cut bears no push by itself; %s",
            stage->name, crack, 100 * o->share, o->deepest,
            stage->solver == BRC_SOLVER_DYNAMIC
                ? "let its sides touch: `interactions: {contact: {friction: ...}}`"
                : "let its sides touch, `interactions: {contact: {friction: ...}}`, in a dynamic stage");
}

static int32_t wall_of(const brc_domain *d, const char *name)
{
    for (int32_t w = 0; w < d->n_walls; ++w)
        if (strcmp(d->wall_name[w], name) == 0) return w;
    return -1;
}

static bool has_cuts(const brc_simulation *s)
{
    for (int32_t b = 0; b < s->scene->n_bodies; ++b)
        if (s->scene->bodies[b].n_cracks > 0) return true;
    return false;
}

/* Each wall once, though bodies may have cracks of one name. */
static brc_status tell_of_wall(const brc_simulation *s, int32_t wall, const double *u, const double *h, uint8_t *told)
{
    const brc_domain *d = s->domain;
    int64_t n = 0;
    if (wall < 0 || told[wall]) return BRC_OK;
    told[wall] = 1;
    BRC_LOCAL(s->context, d->n_free_faces, side, sides, "sides of cuts");
    for (int64_t f = 0; f < d->n_free_faces; ++f)
        if (d->free_wall[f] == wall) {
            memcpy(sides[n].centroid, d->free_centroid + 3 * f, sizeof sides->centroid);
            sides[n++].face = (int32_t)f;
        }
    qsort(sides, (size_t)n, sizeof *sides, by_place);
    const overlap o = overlap_of(d, sides, n, u, h);
    if (o.part > least_part) tell(s, d->wall_name[wall], &o);
    return BRC_OK;
}

brc_status brc_cut_sides_tell(brc_simulation *s)
{
    const brc_domain *d = s->domain;
    const brc_solver_kind solver = brc_current_stage(s)->solver;
    if (!has_cuts(s) || brc_has_spheres(s) || solver == BRC_SOLVER_MODES ||
        (s->scene->has_contact && solver == BRC_SOLVER_DYNAMIC))
        return BRC_OK;
    BRC_LOCAL(s->context, 3 * d->n_elements, double, u, "displacements");
    BRC_LOCAL(s->context, 9 * d->n_elements, double, h, "gradients");
    BRC_LOCAL(s->context, d->n_walls, uint8_t, told, "walls");
    memset(told, 0, (size_t)d->n_walls);
    memset(h, 0, (size_t)(9 * d->n_elements) * sizeof *h);
    BRC_TRY(brc_simulation_displacement(s, u));
    if (brc_gradient_of(s)) BRC_TRY(brc_coeff_from_rows(s, brc_gradient_of(s), h, 9));
    for (int32_t b = 0; b < s->scene->n_bodies; ++b)
        for (int32_t c = 0; c < s->scene->bodies[b].n_cracks; ++c)
            BRC_TRY(tell_of_wall(s, wall_of(d, s->scene->bodies[b].cracks[c].name), u, h, told));
    return BRC_OK;
}
