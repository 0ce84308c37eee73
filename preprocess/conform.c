/* A wall's mirror images are right where the cell that meets the wall belongs to a mirrored seed: no cell may have a corner farther from its seed than
 * the depth to which seeds were mirrored. */
#include "conform.h"

#include "mirror.h"

#include <math.h>
#include <omp.h>

/* Depth to which seeds are mirrored at first [of the spacing]: about the farthest corner of a cell of a random grid. */
#define FIRST_REACH 2.0
enum { MOST_TRIES = 4 };
/* A bond joins what is not joined when both its branch and its face have their middle outside: next to a concave wall the branch may
 * leave the solid, at a thin tip the face may. A large face must not at all, a small one not far [of the spacing, its square]. */
#define LARGE_FACE 0.2
#define LARGE_OUTSIDE 1e-6
#define SMALL_OUTSIDE 0.05

brc_status brc_conform_walls(brc_context *context, const double *position, int64_t n, double spacing, bool fit, int n_threads, brc_walls *walls)
{
    if (!walls->mirrored) return BRC_OK;
    BRC_TRY(brc_mirror_make(context, position, n, fmax(walls->reach, FIRST_REACH * spacing), n_threads, walls));
    return fit ? brc_mirror_fit(context, position, n, spacing, n_threads, walls) : BRC_OK;
}

brc_status brc_conform_cells(brc_context *context, const double *position, int64_t n, double spacing, int n_threads, brc_walls *walls, brc_cells *cells)
{
    for (int t = 0; t < MOST_TRIES; ++t) {
        BRC_TRY(brc_conform_walls(context, position, n, spacing, true, n_threads, walls));
        BRC_TRY(brc_cells_compute(context, position, n, walls, spacing, n_threads, cells));
        if (!walls->mirrored || cells->farthest_corner <= walls->reach) return BRC_OK;
        walls->reach = 1.05 * fmin(cells->farthest_corner, 2.0 * walls->reach);
        brc_cells_free(cells);
    }
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "shape: some cells reach %.3g m, or %.3g spacings, to the wall: the seeds are too few or too uneven for this shape; ask for more elements",
                    walls->reach, walls->reach / spacing);
}

/* How far outside half-edge h of element e runs [m]; 0: it does not. own: a ball of this radius around the seed lies inside, < 0: not known yet. */
static double bond_outside(const brc_walls *walls, const brc_domain *domain, int64_t e, int64_t h, double spacing, double *own)
{
    const double *x = domain->position + 3 * e, *y = domain->position + 3 * (int64_t)domain->neighbour[h], *s = domain->area_vector + 3 * h;
    const double *c = domain->face_centroid + 3 * h;
    const double away = sqrt((c[0] - x[0]) * (c[0] - x[0]) + (c[1] - x[1]) * (c[1] - x[1]) + (c[2] - x[2]) * (c[2] - x[2]));
    if (*own < 0.0) *own = brc_solid_distance(walls->solid, x, walls->reach);
    if (away < *own) return 0.0;
    const bool large = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) > LARGE_FACE * spacing * spacing;
    const double limit = (large ? LARGE_OUTSIDE : SMALL_OUTSIDE) * spacing;
    const double outside = -brc_solid_depth(walls->solid, c);
    if (outside <= limit) return 0.0;
    const double middle[3] = {0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1]), 0.5 * (x[2] + y[2])};
    return -brc_solid_depth(walls->solid, middle) > limit ? outside : 0.0;
}

brc_status brc_conform_check(brc_context *context, const brc_walls *walls, double spacing, int n_threads, const brc_domain *domain)
{
    if (!walls->mirrored || brc_solid_is_convex(walls->solid)) return BRC_OK;
    int64_t n_bad = 0, worst_half_edge = -1;
    double worst = 0.0;
#pragma omp parallel num_threads(n_threads) reduction(+ : n_bad)
    {
        double most = 0.0;
        int64_t at = -1;
#pragma omp for schedule(dynamic, 256)
        for (int64_t e = 0; e < domain->n_elements; ++e) {
            double own = -1.0;
            for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
                const double outside = domain->neighbour[h] < e ? 0.0 : bond_outside(walls, domain, e, h, spacing, &own);
                n_bad += outside > 0.0;
                if (outside > most || (outside > 0.0 && outside == most && h < at)) {
                    most = outside;
                    at = h;
                }
            }
        }
#pragma omp critical(brc_conform)
        if (at >= 0 && (most > worst || (most == worst && at < worst_half_edge))) {
            worst = most;
            worst_half_edge = at;
        }
    }
    if (n_bad == 0) return BRC_OK;
    const double *c = domain->face_centroid + 3 * worst_half_edge;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "shape: %lld bonds of cells %.3g m wide would cross places outside the shape, the worst at (%g, %g, %g) m, %.3g m outside (before the pose): a gap or "
                    "notch there is narrower than the cells; ask for more elements (cells of a third of the gap), or make a slot of no width a crack",
                    (long long)n_bad, spacing, c[0], c[1], c[2], worst);
}
