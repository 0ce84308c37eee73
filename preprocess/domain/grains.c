/* Dart throwing: elements are drawn one after the other and become centres where no earlier centre is too near.
 * Elements, not points of space, are drawn, so a shape of any kind needs no second description and every grain has at
 * least one element. */
#include "grains.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/random.h"
#include "../point_grid.h"

#include <math.h>
#include <stdlib.h>

/* Random spheres without overlap fill at most 0.38 of space, at a diameter of 0.9 of the cube root of the volume of
 * each. */
#define FIRST_DISTANCE 0.9
#define SHRINK 0.96
#define DRAWS_A_GRAIN 8
/* "Finer than two cells across": fewer elements a grain than a cube of two by two by two. */
#define LEAST_ELEMENTS 8
#define SHARE_ROUNDING 1e-9

/* Volume the elements stand for [m^3]: spheres leave pores. */
static double solid_volume(const brc_domain *domain)
{
    if (domain->element_kind == BRC_ELEMENT_SPHERE && domain->quality.volume_shape > 0.0)
        return domain->quality.volume_shape;
    double sum = 0.0;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        sum += domain->volume[e];
    return sum;
}

static brc_status check(brc_context *context, const brc_grains *grains)
{
    if (grains->n < 0 || !(grains->size >= 0.0 && isfinite(grains->size)))
        return BRC_FAIL(context, BRC_BAD_INPUT, "grains: %lld grains of %g m, must be finite and 0 or more",
                        (long long)grains->n, grains->size);
    if (grains->n > 0 && grains->size > 0.0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "grains: number (%lld) and size (%g m) are given, must be one of them",
                        (long long)grains->n, grains->size);
    if (grains->n_phases < 0 || (grains->n_phases > 0 && !grains->fraction))
        return BRC_FAIL(context, BRC_BAD_INPUT, "grains: %d phases without shares, must be 0 or have a share each",
                        grains->n_phases);
    double sum = 0.0;
    for (int32_t p = 0; p < grains->n_phases; ++p) {
        const double share = grains->fraction[p];
        if (!(share >= 0.0 && share <= 1.0))
            return BRC_FAIL(context, BRC_BAD_INPUT, "grains: the share of phase %d is %g, must be 0 to 1", p + 1,
                            share);
        sum += share;
    }
    if (sum > 1.0 + SHARE_ROUNDING)
        return BRC_FAIL(context, BRC_BAD_INPUT, "grains: the shares of the phases sum to %g, must be at most 1", sum);
    return BRC_OK;
}

/* Number of grains for `volume` [m^3]. */
static brc_status count_grains(brc_context *context, const brc_grains *grains, double volume, int64_t n_elements,
                               int64_t *n)
{
    const double by_size = grains->size > 0.0 ? volume / (grains->size * grains->size * grains->size) : 0.0;
    const double wanted = grains->n > 0 ? (double)grains->n : fmax(1.0, floor(by_size + 0.5));
    if (wanted * LEAST_ELEMENTS > (double)n_elements) {
        const double most = fmax(1.0, floor((double)n_elements / LEAST_ELEMENTS));
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "grains: %.4g grains of %.3g m are finer than two of the %lld elements (%.3g m) across; ask "
                        "for at most %.0f "
                        "grains (%.3g m) or for %.0f elements",
                        wanted, cbrt(volume / wanted), (long long)n_elements, cbrt(volume / (double)n_elements), most,
                        cbrt(volume / most), ceil(wanted * LEAST_ELEMENTS));
    }
    *n = (int64_t)wanted;
    return BRC_OK;
}

/* Draw n centres into the grid. size: cube root of a grain's volume [m]. */
static brc_status draw_centres(brc_context *context, const brc_domain *domain, uint64_t seed, double size, int64_t n,
                               brc_point_grid *grid)
{
    int64_t found = 0;
    uint64_t draw = 0;
    for (double distance = FIRST_DISTANCE * size; found < n; distance *= SHRINK) {
        if (distance < 1e-6 * size)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "grains: only %lld of %lld centres found room; elements lie on each other",
                            (long long)found, (long long)n);
        for (int64_t k = 0; k < DRAWS_A_GRAIN * n && found < n; ++k) {
            double u[4];
            brc_random_uniform4(seed, BRC_RANDOM_GRAIN, draw++, (uint64_t)domain->body[0], u);
            const double *x = domain->position + 3 * (int64_t)(u[0] * (double)domain->n_elements);
            if (brc_point_grid_crowded(grid, x, distance)) continue;
            brc_point_grid_add(grid, x);
            ++found;
        }
    }
    return BRC_OK;
}

typedef struct lot {
    double draw;
    int64_t grain;
} lot;

static int compare_lots(const void *a, const void *b)
{
    const lot *p = a, *q = b;
    if (p->draw != q->draw) return p->draw < q->draw ? -1 : 1;
    return p->grain < q->grain ? -1 : p->grain > q->grain;
}

/* Shuffle the grains and cut the row at the sums of the shares, rounded: each share is then met to within one grain. */
static brc_status set_phases(brc_context *context, const brc_grains *grains, int64_t n, int32_t n_regions,
                             brc_domain *domain)
{
    lot *lots = NULL;
    int32_t *phase = NULL; /* of every grain, -1: none */
    brc_status status = BRC_ALLOCATE(context, &lots, n, "lots of grains");
    if (status == BRC_OK) status = BRC_ALLOCATE(context, &phase, n, "phases of grains");
    if (status != BRC_OK) goto cleanup;
    for (int64_t g = 0; g < n; ++g) {
        double u[4];
        brc_random_uniform4(grains->seed, BRC_RANDOM_GRAIN_PHASE, (uint64_t)g, (uint64_t)domain->body[0], u);
        lots[g] = (lot){.draw = u[0], .grain = g};
        phase[g] = -1;
    }
    qsort(lots, (size_t)n, sizeof *lots, compare_lots);
    double sum = 0.0;
    int64_t from = 0;
    for (int32_t p = 0; p < grains->n_phases; ++p) {
        sum += grains->fraction[p];
        const int64_t to = llround(fmin(1.0, sum) * (double)n);
        for (; from < to; ++from)
            phase[lots[from].grain] = p;
    }
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const int32_t p = phase[domain->grain[e]];
        if (p >= 0) domain->region[e] = n_regions + 1 + p;
    }
cleanup:
    brc_memory_free(lots);
    brc_memory_free(phase);
    return status;
}

static void bounds_of(const brc_domain *domain, double bounds[2][3])
{
    for (int k = 0; k < 3; ++k)
        bounds[0][k] = bounds[1][k] = domain->position[k];
    for (int64_t e = 1; e < domain->n_elements; ++e)
        for (int k = 0; k < 3; ++k) {
            bounds[0][k] = fmin(bounds[0][k], domain->position[3 * e + k]);
            bounds[1][k] = fmax(bounds[1][k], domain->position[3 * e + k]);
        }
}

brc_status brc_grains_assign(brc_context *context, const brc_grains *grains, int32_t n_regions, int n_threads,
                             brc_domain *domain)
{
    BRC_TRY(check(context, grains));
    if (grains->n == 0 && grains->size == 0.0) return BRC_OK;
    const double volume = solid_volume(domain);
    int64_t n = 0;
    BRC_TRY(count_grains(context, grains, volume, domain->n_elements, &n));
    const double size = cbrt(volume / (double)n);
    double bounds[2][3];
    bounds_of(domain, bounds);
    brc_point_grid *centres = NULL;
    int32_t *grain = NULL;
    brc_status status = BRC_ALLOCATE(context, &grain, domain->n_elements, "grains of elements");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, brc_point_grid_create(context, bounds, size, n, &centres));
    BRC_TRY_OR(cleanup, draw_centres(context, domain, grains->seed, size, n, centres));
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t e = 0; e < domain->n_elements; ++e)
        grain[e] = (int32_t)brc_point_grid_nearest(centres, domain->position + 3 * e);
    brc_memory_free(domain->grain);
    domain->grain = grain;
    grain = NULL;
    if (grains->n_phases > 0) status = set_phases(context, grains, n, n_regions, domain);
    if (status == BRC_OK) brc_log(context, BRC_LOG_INFO, "grains: %lld of about %.3g m", (long long)n, size);
cleanup:
    brc_point_grid_free(&centres);
    brc_memory_free(grain);
    return status;
}

int64_t brc_grains_count_interfaces(const brc_domain *domain)
{
    int64_t count = 0;
    for (int64_t e = 0; domain->grain && e < domain->n_elements; ++e)
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h)
            count += domain->neighbour[h] > e && domain->grain[domain->neighbour[h]] != domain->grain[e];
    return count;
}
