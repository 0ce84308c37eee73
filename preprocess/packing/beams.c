/* Bonds become rows of half-edges like those of cells, without faces. */
#include "beams.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "bond_balance.h"
#include "bond_search.h"
#include "../domain/sets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A sphere touches a wall if its surface comes this near to it, in radii: packed spheres overlap walls a little. */
#define TOUCH 1e-6
/* Bonds longer than this many sums of radii pass other elements by. */
#define LONG_BOND 2.0
/* Feet of one sphere that are looked at: walls of corners, edges and thin parts. */
enum { MOST_FEET = 64 };

static brc_status check(brc_context *context, const double *position, const double *radius, int64_t n,
                        double coordination)
{
    if (n < 2 || n > INT32_MAX)
        return BRC_FAIL(context, BRC_BAD_INPUT, "bonds: %lld elements, must be 2 to 2^31 - 1", (long long)n);
    for (int64_t e = 0; e < n; ++e) {
        const double *x = position + 3 * e;
        if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]) || !isfinite(radius[e]) || !(radius[e] > 0.0))
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "bonds: sphere %lld at (%g, %g, %g) m has the radius %g m; all must be finite, the "
                            "radius positive",
                            (long long)e, x[0], x[1], x[2], radius[e]);
    }
    const double most = (double)(n - 1), pairs = 0.5 * coordination * (double)n;
    if (!(coordination > 0.0) || !(coordination <= most) || pairs < 0.5)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "bonds: a coordination number of %g cannot be reached with %lld elements, at most %g, at least "
                        "%g; papers use 6 to 13",
                        coordination, (long long)n, most, 1.0 / (double)n);
    if (pairs > (double)(INT32_MAX / 2))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "bonds: %.3g bonds, must be below 2^30; use fewer elements or a smaller coordination", pairs);
    return BRC_OK;
}

static int compare_ids(const void *left, const void *right)
{
    const int32_t a = *(const int32_t *)left, b = *(const int32_t *)right;
    return a < b ? -1 : a > b;
}

/* Rows sorted by neighbour, from pairs. */
static brc_status make_rows(brc_context *context, int32_t (*pair)[2], int n_threads, brc_domain *d)
{
    BRC_TRY(BRC_ALLOCATE(context, &d->row_start, d->n_elements + 1, "rows of half-edges"));
    BRC_TRY(BRC_ALLOCATE(context, &d->neighbour, d->n_half_edges, "neighbours"));
    int64_t *start = d->row_start;
    for (int64_t b = 0; b < d->n_bonds; ++b)
        for (int side = 0; side < 2; ++side)
            start[pair[b][side] + 1]++;
    for (int64_t e = 0; e < d->n_elements; ++e)
        start[e + 1] += start[e];
    for (int64_t b = 0; b < d->n_bonds; ++b) /* each end moves to where its row begins */
        for (int side = 0; side < 2; ++side)
            d->neighbour[--start[pair[b][side] + 1]] = pair[b][1 - side];
    memmove(start, start + 1, (size_t)d->n_elements * sizeof *start);
    start[d->n_elements] = d->n_half_edges;
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t e = 0; e < d->n_elements; ++e)
        qsort(d->neighbour + start[e], (size_t)(start[e + 1] - start[e]), sizeof *d->neighbour, compare_ids);
    return BRC_OK;
}

/* Elements ascend and so do the entries of a row: the twin of an entry is the next of its neighbour's row not yet
 * met. */
static brc_status pair_half_edges(brc_context *context, brc_domain *d)
{
    int32_t *met = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &d->twin, d->n_half_edges, "twins"));
    BRC_TRY(BRC_ALLOCATE(context, &d->bond, d->n_half_edges, "bonds of half-edges"));
    BRC_TRY(BRC_ALLOCATE(context, &d->bond_half_edge, d->n_bonds, "half-edges of bonds"));
    BRC_TRY(BRC_ALLOCATE(context, &met, d->n_elements, "entries met"));
    int32_t b = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const int32_t j = d->neighbour[h];
            if (j < e) continue;
            const int64_t t = d->row_start[j] + met[j]++;
            d->twin[h] = (int32_t)t;
            d->twin[t] = (int32_t)h;
            d->bond[h] = d->bond[t] = b;
            d->bond_half_edge[b++] = (int32_t)h;
        }
    brc_memory_free(met);
    return BRC_OK;
}

static brc_status make_spheres(brc_context *context, const double *position, const double *radius, int n_threads,
                               brc_domain *d)
{
    const int64_t n = d->n_elements;
    BRC_TRY(BRC_ALLOCATE(context, &d->volume, n, "volumes"));
    BRC_TRY(BRC_ALLOCATE(context, &d->centroid, 3 * n, "centroids"));
    BRC_TRY(BRC_ALLOCATE(context, &d->inertia, 6 * n, "inertia"));
    memcpy(d->centroid, position, 3 * (size_t)n * sizeof *position);
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t e = 0; e < n; ++e) {
        const double r = radius[e];
        d->volume[e] = brc_sphere_volume(r);
        for (int k = 0; k < 3; ++k)
            d->inertia[6 * e + k] = 0.4 * d->volume[e] * r * r;
    }
    for (int c = 0; c < 3; ++c) {
        d->bounds[0][c] = HUGE_VAL;
        d->bounds[1][c] = -HUGE_VAL;
    }
    for (int64_t e = 0; e < n; ++e)
        for (int c = 0; c < 3; ++c) {
            d->bounds[0][c] = fmin(d->bounds[0][c], position[3 * e + c] - radius[e]);
            d->bounds[1][c] = fmax(d->bounds[1][c], position[3 * e + c] + radius[e]);
        }
    return BRC_OK;
}

/* balance: the harmonics of walls (bond_balance.h); NULL: the nearest pairs. */
static brc_status bond(brc_context *context, double *position, double *radius, int64_t n, double coordination,
                       const double *balance, int n_threads, brc_domain *domain)
{
    int32_t(*pair)[2] = NULL;
    const double start = brc_clock_s();
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, check(context, position, radius, n, coordination));
    domain->element_kind = BRC_ELEMENT_SPHERE;
    domain->n_elements = n;
    domain->n_bonds = (int64_t)floor(0.5 * coordination * (double)n + 0.5);
    domain->n_half_edges = 2 * domain->n_bonds;
    if (balance)
        BRC_TRY_OR(cleanup, brc_bond_balance(context, position, radius, n, domain->n_bonds, balance, n_threads, &pair,
                                             &domain->quality.growth));
    else
        BRC_TRY_OR(cleanup, brc_bond_search(context, position, radius, n, domain->n_bonds, n_threads, &pair,
                                            &domain->quality.growth));
    BRC_TRY_OR(cleanup, make_rows(context, pair, n_threads, domain));
    brc_memory_free(pair);
    pair = NULL;
    BRC_TRY_OR(cleanup, pair_half_edges(context, domain));
    BRC_TRY_OR(cleanup, make_spheres(context, position, radius, n_threads, domain));
    domain->position = position;
    domain->radius = radius;
    brc_log(context, BRC_LOG_INFO,
            "bonds: %lld between %lld spheres in %.2f s, the longest %.4f times the sum of the radii",
            (long long)domain->n_bonds, (long long)n, brc_clock_s() - start, domain->quality.growth);
    if (domain->quality.growth > LONG_BOND)
        brc_log(context, BRC_LOG_WARNING,
                "bonds: for a coordination number of %g bonds reach to %.3g times the sum of the radii, past other "
                "elements; a "
                "denser packing or a smaller number would be sounder",
                coordination, domain->quality.growth);
cleanup:
    brc_memory_free(pair);
    return status;
}

void brc_beams_fill(brc_domain *d, double volume_fraction)
{
    const double part = volume_fraction < BRC_LOOSE ? 1 : volume_fraction;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        d->volume[e] = brc_sphere_volume(d->radius[e]) / part;
        for (int k = 0; k < 3; ++k)
            d->inertia[6 * e + k] = 0.4 * d->volume[e] * d->radius[e] * d->radius[e];
    }
}

brc_status brc_beams_bond(brc_context *context, double *position, double *radius, int64_t n, double coordination,
                          int n_threads, brc_domain *domain)
{
    return bond(context, position, radius, n, coordination, NULL, n_threads, domain);
}

/* Spheres near enough to the surface for a foot within their layer. */
static void mark_skin(const brc_solid *solid, const brc_domain *d, int n_threads, uint8_t *skin)
{
#pragma omp parallel for schedule(dynamic, 256) num_threads(n_threads)
    for (int64_t e = 0; e < d->n_elements; ++e) {
        brc_foot foot;
        skin[e] = brc_solid_feet(solid, d->position + 3 * e, 2.0 * d->radius[e] * (1.0 + TOUCH), &foot, 1) > 0;
    }
}

/* Go through the skin in order and hand every element to the sets it belongs to: wall w and layer n_walls + w. With
 * member NULL they are only counted. */
static void sort_skin(const brc_solid *solid, const brc_domain *d, const uint8_t *skin, int64_t *count, int32_t *last,
                      brc_set *sets)
{
    for (int32_t s = 0; s < 2 * d->n_walls; ++s) {
        count[s] = 0;
        last[s] = -1;
    }
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (!skin[e]) continue;
        brc_foot feet[MOST_FEET];
        const double r = d->radius[e];
        int32_t n = brc_solid_feet(solid, d->position + 3 * e, 2.0 * r * (1.0 + TOUCH), feet, MOST_FEET);
        if (n > MOST_FEET) n = MOST_FEET;
        for (int32_t k = 0; k < n; ++k)
            for (int layer = 0; layer < 2; ++layer) {
                const int32_t s = layer * d->n_walls + feet[k].wall;
                if (feet[k].depth > (1.0 + layer) * r * (1.0 + TOUCH) || last[s] == e) continue;
                last[s] = (int32_t)e; /* a wall may come near in several places */
                if (sets) sets[s].members[count[s]] = (int32_t)e;
                ++count[s];
            }
    }
}

brc_status brc_beams_walls(brc_context *context, const brc_solid *solid, int n_threads, brc_domain *domain)
{
    const int32_t n_walls = brc_solid_n_walls(solid);
    uint8_t *skin = NULL;
    int64_t *count = NULL;
    int32_t *last = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->wall_name, n_walls, "wall names"));
    for (int32_t w = 0; w < n_walls; ++w)
        BRC_TRY_OR(cleanup, brc_domain_add_wall(context, domain, brc_solid_wall_name(solid, w)));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &skin, domain->n_elements, "elements of the skin"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &count, 2 * n_walls, "sizes of wall sets"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &last, 2 * n_walls, "sizes of wall sets"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->sets, 2 * n_walls, "sets"));
    mark_skin(solid, domain, n_threads, skin);
    sort_skin(solid, domain, skin, count, last, NULL);
    for (int32_t s = 0; s < 2 * n_walls; ++s) {
        char layer[BRC_LAYER_NAME];
        const char *wall = domain->wall_name[s % n_walls];
        brc_set *set;
        brc_sets_layer_name(wall, layer);
        BRC_TRY_OR(cleanup,
                   brc_sets_append(context, domain, s < n_walls ? wall : layer, BRC_SET_ELEMENTS, count[s], &set));
    }
    sort_skin(solid, domain, skin, count, last, domain->sets);
cleanup:
    brc_memory_free(skin);
    brc_memory_free(count);
    brc_memory_free(last);
    return status;
}

brc_status brc_beams_build(brc_context *context, const brc_solid *solid, double *position, double *radius, int64_t n,
                           double coordination, bool balanced, int n_threads, brc_domain *domain)
{
    double walls[BRC_BALANCE_PARTS];
    if (balanced) brc_balance_of_walls(solid, position, radius, n, n_threads, walls);
    BRC_TRY(bond(context, position, radius, n, coordination, balanced ? walls : NULL, n_threads, domain));
    const brc_status status = brc_beams_walls(context, solid, n_threads, domain);
    if (status != BRC_OK) domain->position = domain->radius = NULL; /* they stay the caller's */
    return status;
}
