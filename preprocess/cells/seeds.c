/* The noise of a grid cell depends on the seed of the fill and the cell's index alone, so seeds do not depend on
 * threads or on how many there are. */
#include "seeds.h"

#include "../../host/base/memory.h"
#include "../../host/base/random.h"

#include <math.h>
#include <stdlib.h>

/* A seed this near to a wall [of the spacing] has no room for a cell of its own side and is dropped. */
#define WALL_MARGIN 1e-6
/* and this near to a mirrored wall it is moved to there: it needs some distance from its image. */
#define MIRROR_MARGIN 0.05
#define DEFAULT_MIN_DISTANCE 1e-6
/* Less noise than this cannot be told from the rounding of a regular grid. */
#define LEAST_SPREAD 1e-4
/* Volume fraction of a random packing at rest: what a number of spheres is guessed from. */
#define TYPICAL_PACKING 0.63

static brc_status check_grid(brc_context *context, const brc_fill *fill)
{
    const bool cells = fill->cells[0] != 0 || fill->cells[1] != 0 || fill->cells[2] != 0;
    const int given = (fill->n_elements != 0) + (fill->spacing != 0.0) + cells;
    if (given != 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: %d of the number of elements, the spacing and the grid cells are given, must be exactly "
                        "one of them",
                        given);
    if (fill->spacing != 0.0 && !(isfinite(fill->spacing) && fill->spacing > 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: spacing is %g m, must be finite and > 0", fill->spacing);
    for (int k = 0; k < 3 && cells; ++k)
        if (fill->cells[k] < 1 || fill->cells[k] > INT32_MAX)
            return BRC_FAIL(context, BRC_BAD_INPUT, "fill: %lld grid cells along %c, must be at least 1",
                            (long long)fill->cells[k], "xyz"[k]);
    if (!(fill->spread >= 0.0 && fill->spread <= 1.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: spread is %g, must be 0 to 1 (0 to 100 %%)", fill->spread);
    if (fill->spread > 0.0 && fill->spread < LEAST_SPREAD)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: spread %g leaves faces as small as rounding; use 0 for cubes, or %g or more",
                        fill->spread, LEAST_SPREAD);
    return BRC_OK;
}

static brc_status check_radii(brc_context *context, const brc_fill *fill)
{
    const brc_radius *r = fill->radii;
    const int32_t n = fill->n_radii;
    if (!(fill->radius_spread >= 0.0 && fill->radius_spread <= 0.9))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the spread of the radii is %g, must be 0 to 0.9",
                        fill->radius_spread);
    if (n == 0) return BRC_OK;
    if (fill->radius_spread != 0.0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: give a spread of the radii or a table of them, not both");
    if (n < 2) return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the table of radii has %d point, must have 2 or more", n);
    for (int32_t k = 0; k < n; ++k) {
        if (!(isfinite(r[k].radius) && r[k].radius > 0.0 && (k == 0 || r[k].radius >= r[k - 1].radius)))
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "fill: radius %d of the table is %g m, must be > 0 and not below the one before it", k + 1,
                            r[k].radius);
        if (!(r[k].fraction >= 0.0 && r[k].fraction <= 1.0 && (k == 0 || r[k].fraction >= r[k - 1].fraction)))
            return BRC_FAIL(
                context, BRC_BAD_INPUT,
                "fill: fraction %d of the table of radii is %g, must be 0 to 1 and not below the one before it", k + 1,
                r[k].fraction);
    }
    if (r[0].fraction != 0.0 || r[n - 1].fraction != 1.0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: the table of radii runs from the fraction %g to %g, must run from 0 to 1", r[0].fraction,
                        r[n - 1].fraction);
    return BRC_OK;
}

static brc_status check_packing(brc_context *context, const brc_fill *fill)
{
    if ((fill->n_elements != 0) == (fill->radius != 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: a packing needs either the number of elements or their mean radius");
    if (fill->radius != 0.0 && !(isfinite(fill->radius) && fill->radius > 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the mean radius is %g m, must be finite and > 0", fill->radius);
    if ((fill->coordination != 0.0) == (fill->volume_fraction != 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: a packing needs either a coordination number (6.2 say) or a volume fraction (0.63 say)");
    if (!(fill->coordination >= 0.0 && fill->coordination <= 12.0))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: the coordination number is %g, must be up to 12; 5.8 to 7 can be reached at rest",
                        fill->coordination);
    if (!(fill->volume_fraction >= 0.0 && fill->volume_fraction < 1.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the volume fraction is %g, must be above 0 and below 1",
                        fill->volume_fraction);
    if (!(fill->tolerance >= 0.0 && isfinite(fill->tolerance)))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the tolerance is %g, must be 0 (default) or more",
                        fill->tolerance);
    return check_radii(context, fill);
}

brc_status brc_fill_check(brc_context *context, const brc_fill *fill)
{
    if (fill->n_elements < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: %lld elements wanted, must be at least 1",
                        (long long)fill->n_elements);
    switch (fill->kind) {
    case BRC_FILL_NOISY_GRID: BRC_TRY(check_grid(context, fill)); break;
    case BRC_FILL_PACKING: BRC_TRY(check_packing(context, fill)); break;
    case BRC_FILL_POINTS:
        if (!(isfinite(fill->scale) && fill->scale > 0.0))
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "fill: the scale of the points is %g m per unit of the file, must be finite and > 0",
                            fill->scale);
        break;
    default:
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: kind %d is unknown, must be noisy grid, packing or points",
                        (int)fill->kind);
    }
    if (fill->lloyd_sweeps < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: %d Lloyd sweeps, must be 0 or more", fill->lloyd_sweeps);
    if (!(fill->min_distance >= 0.0 && isfinite(fill->min_distance)))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the minimal distance is %g m, must be finite and 0 or more",
                        fill->min_distance);
    return BRC_OK;
}

double brc_fill_spacing(const brc_solid *solid, const brc_fill *fill)
{
    const double shape = brc_solid_volume(solid, NULL);
    if (fill->spacing > 0.0) return fill->spacing;
    if (fill->n_elements > 0) return cbrt(shape / (double)fill->n_elements);
    if (fill->radius > 0.0) return fill->radius * cbrt(4.0 / 3.0 * 3.14159265358979323846 / TYPICAL_PACKING);
    double bounds[2][3], volume = 1.0;
    brc_solid_bounds(solid, bounds);
    for (int k = 0; k < 3; ++k)
        volume *= (bounds[1][k] - bounds[0][k]) / (double)fill->cells[k];
    return cbrt(volume);
}

/* Seed of a grid cell [m]. */
static void draw(const brc_grid *grid, const brc_fill *fill, int64_t cell, double x[3])
{
    const int64_t index[3] = {cell % grid->cells[0], cell / grid->cells[0] % grid->cells[1],
                              cell / (grid->cells[0] * grid->cells[1])};
    double noise[4] = {0.5, 0.5, 0.5, 0.5};
    if (fill->spread > 0.0) brc_random_uniform4(fill->seed, BRC_RANDOM_GRID_NOISE, (uint64_t)cell, 0, noise);
    for (int k = 0; k < 3; ++k)
        x[k] = grid->origin[k] + grid->spacing[k] * ((double)index[k] + 0.5 + fill->spread * (noise[k] - 0.5));
}

static double margin_of(const brc_grid *grid)
{
    return WALL_MARGIN * fmin(grid->spacing[0], fmin(grid->spacing[1], grid->spacing[2]));
}

static int64_t count_inside(const brc_grid *grid, const brc_fill *fill, const brc_walls *walls, int n_threads)
{
    const int64_t n = grid->cells[0] * grid->cells[1] * grid->cells[2];
    const double margin = margin_of(grid);
    int64_t inside = 0;
#pragma omp parallel for schedule(static) reduction(+ : inside) num_threads(n_threads)
    for (int64_t cell = 0; cell < n; ++cell) {
        double x[3];
        draw(grid, fill, cell, x);
        inside += brc_walls_inside(walls, x, margin);
    }
    return inside;
}

/* Counts along x, y, z whose product is near n while the grid cells stay nearly cubic: a tenth of anisotropy weighs as
 * much as two percent of elements. */
static void box_cells(const double size[3], int64_t n, int64_t cells[3])
{
    const double h = cbrt(size[0] * size[1] * size[2] / (double)n);
    double best = HUGE_VAL;
    for (int64_t dx = -3; dx <= 3; ++dx)
        for (int64_t dy = -3; dy <= 3; ++dy)
            for (int64_t dz = -3; dz <= 3; ++dz) {
                const int64_t c[3] = {llround(size[0] / h) + dx, llround(size[1] / h) + dy, llround(size[2] / h) + dz};
                if (c[0] < 1 || c[1] < 1 || c[2] < 1) continue;
                double low = HUGE_VAL, high = 0.0, product = 1.0;
                for (int k = 0; k < 3; ++k) {
                    const double edge = size[k] / (double)c[k];
                    low = fmin(low, edge);
                    high = fmax(high, edge);
                    product *= (double)c[k];
                }
                const double cost = fabs(product / (double)n - 1.0) + 0.2 * (high / low - 1.0);
                if (cost < best * (1.0 - 1e-12)) {
                    best = cost;
                    for (int k = 0; k < 3; ++k)
                        cells[k] = c[k];
                }
            }
}

/* May the grid end exactly at both sides of the solid along k? */
static bool flat_along(const brc_walls *walls, int k)
{
    return walls->flat_side[2 * k] && walls->flat_side[2 * k + 1];
}

/* Grid for a spacing h: exact between flat walls, centred and standing out where the wall is curved. */
static void lay_grid(const brc_walls *walls, double h, brc_grid *grid)
{
    double bounds[2][3];
    brc_solid_bounds(walls->solid, bounds);
    for (int k = 0; k < 3; ++k) {
        const double size = bounds[1][k] - bounds[0][k];
        const double wanted = size / h;
        if (flat_along(walls, k)) {
            grid->cells[k] = wanted < 1.0 ? 1 : llround(wanted);
            grid->spacing[k] = size / (double)grid->cells[k];
        } else {
            /* one more than needed: the polyhedron stands out a little, and noise moves seeds inward */
            grid->cells[k] = (int64_t)ceil(wanted) + 2;
            grid->spacing[k] = h;
        }
        grid->origin[k] = bounds[0][k] + 0.5 * (size - (double)grid->cells[k] * grid->spacing[k]);
    }
}

/* Grid with given cells over the bounds. */
static void fill_bounds(const brc_walls *walls, const int64_t cells[3], brc_grid *grid)
{
    double bounds[2][3];
    brc_solid_bounds(walls->solid, bounds);
    for (int k = 0; k < 3; ++k) {
        grid->cells[k] = cells[k];
        grid->origin[k] = bounds[0][k];
        grid->spacing[k] = (bounds[1][k] - bounds[0][k]) / (double)cells[k];
    }
}

static brc_status check_thickness(brc_context *context, const brc_solid *solid, const brc_grid *grid)
{
    double bounds[2][3];
    brc_solid_bounds(solid, bounds);
    int thin = 0;
    for (int k = 1; k < 3; ++k)
        if (bounds[1][k] - bounds[0][k] < bounds[1][thin] - bounds[0][thin]) thin = k;
    for (int k = 0; k < 3; ++k) {
        const double size = bounds[1][k] - bounds[0][k], across = size / grid->spacing[k];
        if (across >= 2.0 * (1.0 - 1e-9)) continue;
        const double h = 0.5 * (bounds[1][thin] - bounds[0][thin]),
                     least = ceil(brc_solid_volume(solid, NULL) / (h * h * h));
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: %.3g cells across %c (%g m), must be at least 2, for one layer gives the strain nothing "
                        "to hold on to; use a spacing of %g m or less (about %.3g elements or more) or a thicker body",
                        across, "xyz"[k], size, h, fmax(least, (double)grid->n_requested + 1.0));
    }
    return BRC_OK;
}

/* Refuse grids whose indices do not fit before counting anything. */
static brc_status check_size(brc_context *context, const brc_grid *grid)
{
    const double n = (double)grid->cells[0] * (double)grid->cells[1] * (double)grid->cells[2];
    if (n > (double)INT32_MAX / 16.0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: a grid of %.3g cells has too many faces for one domain; ask for "
                        "fewer than %.3g elements",
                        n, (double)INT32_MAX / 16.0);
    return BRC_OK;
}

/* Spacing whose grid leaves as nearly as possible n seeds inside: the count falls with h^3, with jumps; secant steps
 * from the exact volume, the best one kept. Between flat walls all round, where the spacing cannot be chosen freely,
 * the same search runs over the number of cells that the bounds would hold. */
static brc_status search_spacing(brc_context *context, const brc_fill *fill, const brc_walls *walls, int n_threads,
                                 brc_grid *best)
{
    enum { TRIES = 12 };
    const int64_t n = fill->n_elements;
    const bool boxed = flat_along(walls, 0) && flat_along(walls, 1) && flat_along(walls, 2);
    double h = cbrt(brc_solid_volume(walls->solid, NULL) / (double)n), bounds[2][3];
    brc_solid_bounds(walls->solid, bounds);
    const double size[3] = {bounds[1][0] - bounds[0][0], bounds[1][1] - bounds[0][1], bounds[1][2] - bounds[0][2]};
    int64_t least = INT64_MAX;
    for (int t = 0; t < TRIES && least != 0; ++t) {
        brc_grid grid = *best;
        if (boxed) {
            int64_t cells[3];
            box_cells(size, llround(fmax(1.0, size[0] * size[1] * size[2] / (h * h * h))), cells);
            fill_bounds(walls, cells, &grid);
        } else {
            lay_grid(walls, h, &grid);
        }
        BRC_TRY(check_size(context, &grid));
        grid.n_inside = count_inside(&grid, fill, walls, n_threads);
        const int64_t off = llabs(grid.n_inside - n);
        if (off < least) {
            least = off;
            *best = grid;
        }
        if ((double)off <= 1e-4 * (double)n) break;
        h *= grid.n_inside > 0 ? cbrt((double)grid.n_inside / (double)n) : 0.8;
        if (off == 0) break;
    }
    return BRC_OK;
}

brc_status brc_grid_plan(brc_context *context, const brc_fill *fill, const brc_walls *walls, int n_threads,
                         brc_grid *grid)
{
    *grid = (brc_grid){.n_requested = fill->n_elements};
    const brc_shape *shape = brc_solid_shape(walls->solid);
    const bool box = shape->kind == BRC_SHAPE_BOX;
    if (fill->cells[0] > 0 || (fill->n_elements > 0 && box)) {
        int64_t cells[3] = {fill->cells[0], fill->cells[1], fill->cells[2]};
        if (cells[0] == 0) box_cells(shape->size, fill->n_elements, cells);
        fill_bounds(walls, cells, grid);
    } else {
        lay_grid(walls, brc_fill_spacing(walls->solid, fill), grid);
    }
    BRC_TRY(check_size(context, grid));
    BRC_TRY(check_thickness(context, walls->solid, grid));
    if (fill->n_elements > 0 && !box) {
        BRC_TRY(search_spacing(context, fill, walls, n_threads, grid));
        BRC_TRY(check_thickness(context, walls->solid, grid));
    } else {
        grid->n_inside =
            box ? grid->cells[0] * grid->cells[1] * grid->cells[2] : count_inside(grid, fill, walls, n_threads);
    }
    const double least = fmin(grid->spacing[0], fmin(grid->spacing[1], grid->spacing[2]));
    if (fill->min_distance > least)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: the minimal distance %g m is above the grid spacing %g m and would drop most seeds; use "
                        "half the spacing or less",
                        fill->min_distance, least);
    if (grid->n_inside < 1)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: no seed of the grid lies inside the shape; use smaller cells");
    return BRC_OK;
}

/* Is x nearer than `distance` to a kept seed of an earlier grid cell? kept[cell]: index of its seed + 1, 0 for none. */
static bool crowds(const brc_grid *grid, int64_t cell, const double x[3], double distance, const int32_t *kept,
                   const double *position)
{
    int64_t low[3], high[3];
    const int64_t index[3] = {cell % grid->cells[0], cell / grid->cells[0] % grid->cells[1],
                              cell / (grid->cells[0] * grid->cells[1])};
    for (int k = 0; k < 3; ++k) { /* a seed stays in its grid cell */
        const int64_t reach = (int64_t)floor(distance / grid->spacing[k]) + 1;
        low[k] = index[k] - reach > 0 ? index[k] - reach : 0;
        high[k] = index[k] + reach < grid->cells[k] - 1 ? index[k] + reach : grid->cells[k] - 1;
    }
    for (int64_t k = low[2]; k <= index[2]; ++k)
        for (int64_t j = low[1]; j <= high[1]; ++j)
            for (int64_t i = low[0]; i <= high[0]; ++i) {
                const int64_t other = i + grid->cells[0] * (j + grid->cells[1] * k);
                if (other >= cell) return false;
                if (kept[other] == 0) continue;
                const double *y = position + 3 * (int64_t)(kept[other] - 1);
                const double r[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
                if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < distance * distance) return true;
            }
    return false;
}

brc_status brc_seeds_draw(brc_context *context, const brc_grid *grid, const brc_fill *fill, const brc_walls *walls,
                          double **position, int64_t *n, int64_t *n_duplicate)
{
    const int64_t n_cells = grid->cells[0] * grid->cells[1] * grid->cells[2];
    const double margin = margin_of(grid);
    const double h = cbrt(grid->spacing[0] * grid->spacing[1] * grid->spacing[2]);
    const double distance = fill->min_distance > 0.0 ? fill->min_distance : DEFAULT_MIN_DISTANCE * h;
    int32_t *kept = NULL;
    *position = NULL;
    *n = *n_duplicate = 0;
    brc_status status = BRC_ALLOCATE(context, &kept, n_cells, "seeds of the grid cells");
    if (status == BRC_OK) status = BRC_ALLOCATE(context, position, 3 * grid->n_inside, "seeds");
    if (status != BRC_OK) goto cleanup;
    for (int64_t cell = 0; cell < n_cells; ++cell) {
        double x[3];
        draw(grid, fill, cell, x);
        if (!brc_walls_inside(walls, x, margin)) continue;
        brc_walls_keep_off(walls, MIRROR_MARGIN * h, x);
        if (crowds(grid, cell, x, distance, kept, *position)) {
            ++*n_duplicate;
            continue;
        }
        if (*n >= grid->n_inside) { /* the plan counts a box without looking at the margin, never the other way */
            status = BRC_FAIL(context, BRC_INTERNAL, "more seeds than planned");
            goto cleanup;
        }
        for (int k = 0; k < 3; ++k)
            (*position)[3 * *n + k] = x[k];
        kept[cell] = (int32_t)++ * n;
    }
cleanup:
    brc_memory_free(kept);
    if (status != BRC_OK) {
        brc_memory_free(*position);
        *position = NULL;
    }
    return status;
}
