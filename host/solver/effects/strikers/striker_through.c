/* Strikers that stand in a body though no corner of either tells: a plate or a rod that goes through between the
 * corners of the cells, an edge across an edge. Two convex polyhedra without a corner of one in the other share volume
 * only if an edge of one goes through the other. How deep that is, is asked of the body: the distance of the place from
 * its free surface, since a plate that goes right through a body may be as thin as one likes. */
#include "strikers_internal.h"
#include <math.h>

/* The part of the segment a b that lies in polyhedron p (a and b from its origin), deeper than `deep`: *middle of it,
 * from the origin of p. False: none. */
static bool middle_within(const brc_convex *v, int32_t p, const double a[3], const double b[3], double deep,
                          double middle[3])
{
    double from = 0, to = 1;
    for (int32_t f = v->face_start[p]; f < v->face_start[p + 1]; ++f) {
        const double *q = v->plane + 4 * (int64_t)f;
        const double at_a = q[0] * a[0] + q[1] * a[1] + q[2] * a[2] - q[3] + deep,
                     at_b = q[0] * b[0] + q[1] * b[1] + q[2] * b[2] - q[3] + deep;
        if (at_a >= 0 && at_b >= 0) return false;
        if (at_a > 0) from = fmax(from, at_a / (at_a - at_b));
        if (at_b > 0) to = fmin(to, at_a / (at_a - at_b));
        if (from >= to) return false;
    }
    for (int c = 0; c < 3; ++c)
        middle[c] = a[c] + 0.5 * (from + to) * (b[c] - a[c]);
    return true;
}

/* Distance of x from the free faces of cell e [m]. */
static double from_free_faces(const brc_domain *d, const brc_convex *cells, int64_t e, const double x[3], double least)
{
    const int32_t shared = (int32_t)(d->row_start[e + 1] - d->row_start[e]);
    double r[3], square = 0;
    for (int c = 0; c < 3; ++c) {
        r[c] = x[c] - d->position[3 * e + c];
        square += r[c] * r[c];
    }
    if (sqrt(square) - cells->radius[e] >= least) return least;
    for (int32_t f = cells->face_start[e] + shared; f < cells->face_start[e + 1]; ++f)
        least = fmin(least, brc_convex_face_distance(cells, (int32_t)e, f, r));
    return least;
}

/* How far x, which lies in cell e, is from the free surface of its body. Not looked at further once it is below
 * `enough`: most places are in a cell of the surface. */
static double depth_in_body(const brc_domain *d, const brc_convex *cells, int64_t e, const double x[3], double enough)
{
    double least = from_free_faces(d, cells, e, x, HUGE_VAL);
    for (int64_t other = 0; other < d->n_elements && least > enough; ++other)
        if (d->body[other] == d->body[e]) least = from_free_faces(d, cells, other, x, least);
    return least;
}

/* Edges of polyhedron p of `of`, which stands `shift` from the origin of polyhedron q of `through`, that go through
 * this one; each is looked at once, from the face where its corners ascend. */
static void look_along_edges(const brc_simulation *s, const brc_convex *cells, int64_t e, const brc_convex *of,
                             int32_t p, const double shift[3], const brc_convex *through, int32_t q,
                             const double origin[3], brc_overlap *deepest)
{
    const double enough = brc_striker_refused_depth(s);
    const double *corner = of->corner + 3 * (int64_t)of->corner_start[p];
    for (int32_t f = of->face_start[p]; f < of->face_start[p + 1]; ++f) {
        const int32_t first = of->loop_start[f], n = of->loop_start[f + 1] - first;
        for (int32_t k = 0; k < n && deepest->depth <= enough; ++k) {
            const int32_t i = of->loop[first + k], j = of->loop[first + (k + 1) % n];
            double a[3], b[3], x[3], near = 0, half = 0;
            if (i > j) continue;
            for (int c = 0; c < 3; ++c) {
                a[c] = corner[3 * (int64_t)i + c] + shift[c];
                b[c] = corner[3 * (int64_t)j + c] + shift[c];
                near += 0.25 * (a[c] + b[c]) * (a[c] + b[c]);
                half += 0.25 * (a[c] - b[c]) * (a[c] - b[c]);
            }
            if (sqrt(near) > sqrt(half) + through->radius[q] ||
                !middle_within(through, q, a, b, brc_striker_warned_depth(s), x))
                continue;
            for (int c = 0; c < 3; ++c)
                x[c] += origin[c];
            brc_deepen(deepest, depth_in_body(s->domain, cells, e, x, enough), e, x);
            deepest->first = deepest->depth > enough;
        }
    }
}

/* A ball of this radius about r, from the origin of piece p, is outside one of its planes. */
static bool ball_outside(const brc_convex *v, int32_t p, const double r[3], double radius)
{
    for (int32_t f = v->face_start[p]; f < v->face_start[p + 1]; ++f) {
        const double *q = v->plane + 4 * (int64_t)f;
        if (q[0] * r[0] + q[1] * r[1] + q[2] * r[2] - q[3] > radius) return true;
    }
    return false;
}

brc_status brc_strikers_check_edges(brc_simulation *s, const brc_convex *cells)
{
    const brc_strikers *t = s->strikers;
    const brc_domain *d = s->domain;
    for (int32_t i = 0; i < t->n; ++i) {
        brc_overlap deepest = {0};
        for (int32_t p = 0; p < t->convex.n; ++p) {
            if (t->piece_striker[p] != i || t->piece_kind[p] == BRC_PIECE_PLANE) continue;
            const double *centre = t->body[i].centre;
            for (int64_t e = 0; e < d->n_elements && deepest.depth <= brc_striker_refused_depth(s); ++e) {
                const double *x = d->position + 3 * e,
                             there[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]},
                             back[3] = {-there[0], -there[1], -there[2]};
                if (hypot(hypot(there[0], there[1]), there[2]) > cells->radius[e] + t->convex.radius[p] ||
                    ball_outside(&t->convex, p, there, cells->radius[e]))
                    continue;
                look_along_edges(s, cells, e, cells, (int32_t)e, there, &t->convex, p, centre, &deepest);
                look_along_edges(s, cells, e, &t->convex, p, back, cells, (int32_t)e, x, &deepest);
            }
        }
        BRC_TRY(brc_striker_stands_in(s, i, &deepest));
    }
    return BRC_OK;
}
