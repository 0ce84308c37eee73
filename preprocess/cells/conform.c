/* A wall's mirror images are right where the cell that meets the wall belongs to a mirrored seed: no cell may have a
 * corner farther from its seed than the depth to which seeds were mirrored. */
#include "conform.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include "cells_ranks.h"
#include "mirror.h"

#include <math.h>
#include <string.h>

/* Depth to which seeds are mirrored at first [of the spacing]: about the farthest corner of a cell of a random grid. */
#define FIRST_REACH 2.0
enum { MOST_TRIES = 4 };
/* A bond joins what is not joined when the way between its seeds by the middle of their face leaves the solid. At a
 * wall that is made by mirror images, small faces may lie a little outside, and around a sharp concave edge the cells
 * next to it may [of the spacing, its square]. */
#define LARGE_FACE 0.2
#define OUTSIDE_LIMIT 1e-6
#define CONCAVE_REACH 2.0
/* Cosine of the angle between its normals up to which two places are of one wall: 60 degrees, which a way of a cell's
 * width spans on a hollow wall of that radius; across a gap normals are opposed. */
#define ONE_WALL 0.5

brc_status brc_conform_walls(brc_context *context, const double *position, int64_t n, double spacing, bool fit,
                             int n_threads, brc_walls *walls)
{
    if (!walls->mirrored) return BRC_OK;
    BRC_TRY(brc_mirror_make(context, position, n, fmax(walls->reach, FIRST_REACH * spacing), n_threads, walls));
    return fit ? brc_mirror_fit(context, position, n, spacing, n_threads, walls) : BRC_OK;
}

brc_status brc_conform_cells(brc_context *context, const double *position, int64_t n, double spacing, int n_threads,
                             brc_together together, brc_walls *walls, brc_cells *cells)
{
    for (int t = 0; t < MOST_TRIES; ++t) {
        BRC_TRY(brc_conform_walls(context, position, n, spacing, true, n_threads, walls));
        BRC_TRY(brc_cells_compute(context, position, n, walls, spacing, n_threads, together, cells));
        if (!walls->mirrored || cells->farthest_corner <= walls->reach) return BRC_OK;
        walls->reach = 1.05 * fmin(cells->farthest_corner, 2.0 * walls->reach);
        brc_cells_free(cells);
    }
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "shape: some cells reach %.3g m, or %.3g spacings, to the wall: the seeds are too few or too "
                    "uneven for this shape; ask for more elements",
                    walls->reach, walls->reach / spacing);
}

static void place_between(const double a[3], const double b[3], double share, double x[3])
{
    for (int d = 0; d < 3; ++d)
        x[d] = a[d] + share * (b[d] - a[d]);
}

/* Outward normal of the surface where the way from a, inside, to b first leaves the solid, looked for in PIECES and
 * then by HALVINGS; false: it does not. */
static bool normal_of_exit(const brc_solid *solid, const double a[3], const double b[3], double spacing, double n[3])
{
    enum { PIECES = 16, HALVINGS = 20 };
    double inside = 0, outside = 0, x[3];
    brc_foot foot;
    for (int k = 1; outside == 0; ++k) {
        if (k > PIECES) return false;
        place_between(a, b, (double)k / PIECES, x);
        *(brc_solid_inside(solid, x, 0) ? &inside : &outside) = (double)k / PIECES;
    }
    for (int k = 0; k < HALVINGS; ++k) {
        const double middle = 0.5 * (inside + outside);
        place_between(a, b, middle, x);
        *(brc_solid_inside(solid, x, 0) ? &inside : &outside) = middle;
    }
    place_between(a, b, inside, x);
    if (brc_solid_feet(solid, x, spacing, &foot, 1) < 1) return false;
    memcpy(n, foot.normal, sizeof foot.normal);
    return true;
}

/* Whether the way from seed a by c to seed b leaves the solid and comes back through one round wall, which small faces
 * beside it do, rather than across a gap between two. */
static bool grazes(const brc_solid *solid, const double a[3], const double c[3], const double b[3], double spacing)
{
    double out[3], in[3];
    if (!normal_of_exit(solid, a, c, spacing, out) && !normal_of_exit(solid, c, b, spacing, out)) return false;
    if (!normal_of_exit(solid, b, c, spacing, in) && !normal_of_exit(solid, c, a, spacing, in)) return false;
    return out[0] * in[0] + out[1] * in[1] + out[2] * in[2] > ONE_WALL;
}

/* Length of the way along half-edge h of element e that is outside [m]. own: radius of a ball around each seed that
 * lies inside [m]. */
static double bond_outside(const brc_walls *walls, const brc_domain *domain, int64_t e, int64_t h, double spacing,
                           const double *own)
{
    const int64_t j = domain->neighbour[h];
    const double *s = domain->area_vector + 3 * h, *c = domain->face_centroid + 3 * h;
    if (sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) < LARGE_FACE * spacing * spacing) return 0.0;
    double outside = 0.0;
    for (int end = 0; end < 2; ++end) {
        const int64_t k = end ? j : e;
        const double *x = domain->position + 3 * k;
        const double way =
            sqrt((c[0] - x[0]) * (c[0] - x[0]) + (c[1] - x[1]) * (c[1] - x[1]) + (c[2] - x[2]) * (c[2] - x[2]));
        if (way > own[k]) outside += brc_solid_outside(walls->solid, x, c);
    }
    if (outside <= OUTSIDE_LIMIT * spacing || brc_solid_concave_edge_near(walls->solid, c, CONCAVE_REACH * spacing))
        return 0.0;
    return grazes(walls->solid, domain->position + 3 * e, c, domain->position + 3 * j, spacing) ? 0.0 : outside;
}

brc_status brc_conform_check(brc_context *context, const brc_walls *walls, double spacing, int n_threads,
                             const brc_domain *domain)
{
    if (!walls->mirrored || brc_solid_is_convex(walls->solid)) return BRC_OK;
    const int64_t n = domain->n_elements;
    double *own = NULL, *worst = NULL; /* worst: of each element's bonds */
    int64_t n_bad = 0, at = -1;
    brc_status status = BRC_ALLOCATE(context, &own, n, "depths of seeds");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &worst, n, "bonds outside"));
#pragma omp parallel for schedule(dynamic, 256) num_threads(n_threads)
    for (int64_t e = 0; e < n; ++e)
        own[e] = brc_solid_distance(walls->solid, domain->position + 3 * e, walls->reach);
#pragma omp parallel for schedule(dynamic, 256) num_threads(n_threads) reduction(+ : n_bad)
    for (int64_t e = 0; e < n; ++e)
        for (int64_t h = domain->row_start[e]; brc_domain_has(domain, e) && h < domain->row_start[e + 1]; ++h) {
            const double outside = domain->neighbour[h] < e ? 0.0 : bond_outside(walls, domain, e, h, spacing, own);
            n_bad += outside > 0.0;
            worst[e] = fmax(worst[e], outside);
        }
    if (domain->here) {
        BRC_TRY_OR(cleanup, brc_ranks_reduce(context, BRC_SUM, 1, &n_bad));
        BRC_TRY_OR(cleanup, brc_cells_bring_rows(context, n, sizeof *worst, worst));
    }
    for (int64_t e = 0; e < n; ++e)
        if (worst[e] > 0.0 && (at < 0 || worst[e] > worst[at])) at = e;
    if (at >= 0) {
        const double *x = domain->position + 3 * at;
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "shape: %lld bonds of cells %.3g m wide would cross places outside the shape, the worst next "
                          "to (%g, %g, %g) m, %.3g m of it outside (before the pose): "
                          "a gap there is narrower than the cells; ask for more elements (cells of half the gap), or "
                          "make a slot of no width a crack",
                          (long long)n_bad, spacing, x[0], x[1], x[2], worst[at]);
    }
cleanup:
    brc_memory_free(own);
    brc_memory_free(worst);
    return status;
}
