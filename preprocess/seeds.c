/* The noise of a grid cell depends on the seed of the fill and the cell's index alone, so seeds do not depend on
 * threads or on how many there are. */
#include "seeds.h"

#include "../host/base/memory.h"
#include "../host/base/random.h"

#include <math.h>
#include <stdlib.h>

/* A seed this near to a wall [of the spacing] has no room for a cell of its own side and is dropped. */
#define WALL_MARGIN 1e-6
#define DEFAULT_MIN_DISTANCE 1e-6
/* Less noise than this cannot be told from the rounding of a regular grid. */
#define LEAST_SPREAD 1e-4

brc_status brc_fill_check(brc_context *context, const brc_fill *fill)
{
    if (fill->kind != BRC_FILL_NOISY_GRID)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: kind %d is unknown, must be the noisy grid", (int)fill->kind);
    const bool cells = fill->cells[0] != 0 || fill->cells[1] != 0 || fill->cells[2] != 0;
    const int given = (fill->n_elements != 0) + (fill->spacing != 0.0) + cells;
    if (given != 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: %d of the number of elements, the spacing and the grid cells are given, must be exactly "
                        "one of them",
                        given);
    if (fill->n_elements < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: %lld elements wanted, must be at least 1",
                        (long long)fill->n_elements);
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
                        "fill: spread %g leaves faces as small as rounding; use 0 for cubes, or %g or more", fill->spread,
                        LEAST_SPREAD);
    if (fill->lloyd_sweeps < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: %d Lloyd sweeps, must be 0 or more", fill->lloyd_sweeps);
    if (!(fill->min_distance >= 0.0 && isfinite(fill->min_distance)))
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: the minimal distance is %g m, must be finite and 0 or more",
                        fill->min_distance);
    return BRC_OK;
}

double brc_fill_spacing(const brc_shape *shape, const brc_fill *fill)
{
    if (fill->spacing > 0.0) return fill->spacing;
    if (fill->n_elements > 0) return cbrt(brc_shape_volume(shape) / (double)fill->n_elements);
    double bounds[2][3], volume = 1.0;
    brc_shape_bounds(shape, bounds);
    for (int k = 0; k < 3; ++k) volume *= (bounds[1][k] - bounds[0][k]) / (double)fill->cells[k];
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
                    for (int k = 0; k < 3; ++k) cells[k] = c[k];
                }
            }
}

/* Grid for a spacing h: exact between flat walls, centred and standing out where the wall is curved. */
static void lay_grid(const brc_shape *shape, double h, brc_grid *grid)
{
    double bounds[2][3];
    brc_shape_bounds(shape, bounds);
    for (int k = 0; k < 3; ++k) {
        const double size = bounds[1][k] - bounds[0][k];
        const bool flat = shape->kind == BRC_SHAPE_BOX || (shape->kind == BRC_SHAPE_CYLINDER && k == shape->axis);
        const double wanted = size / h;
        if (flat) {
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

static brc_status check_thickness(brc_context *context, const brc_shape *shape, const brc_grid *grid)
{
    double bounds[2][3];
    brc_shape_bounds(shape, bounds);
    for (int k = 0; k < 3; ++k) {
        const double size = bounds[1][k] - bounds[0][k];
        const double across = size / grid->spacing[k];
        if (across >= 2.0 * (1.0 - 1e-9)) continue;
        const double h = 0.5 * size;
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: %.3g cells across %c (%g m), must be at least 2, for one layer gives the strain nothing "
                        "to hold on to; use a spacing of %g m or less (about %.3g elements or more) or a thicker body",
                        across, "xyz"[k], size, h, ceil(brc_shape_volume(shape) / (h * h * h)));
    }
    return BRC_OK;
}

/* Refuse grids whose indices do not fit before counting anything. */
static brc_status check_size(brc_context *context, const brc_grid *grid)
{
    const double n = (double)grid->cells[0] * (double)grid->cells[1] * (double)grid->cells[2];
    if (n > (double)INT32_MAX / 16.0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: a grid of %.3g cells has too many faces for one domain; ask for "
                        "fewer than %.3g elements", n, (double)INT32_MAX / 16.0);
    return BRC_OK;
}

/* Spacing whose grid leaves as nearly as possible n seeds inside: the count falls with h^3, with jumps; secant steps
 * from the exact volume, the best one kept. */
static brc_status search_spacing(brc_context *context, const brc_shape *shape, const brc_fill *fill,
                                 const brc_walls *walls, int n_threads, brc_grid *best)
{
    enum { TRIES = 12 };
    const int64_t n = fill->n_elements;
    double h = cbrt(brc_shape_volume(shape) / (double)n);
    int64_t least = INT64_MAX;
    for (int t = 0; t < TRIES && least != 0; ++t) {
        brc_grid grid = *best;
        lay_grid(shape, h, &grid);
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

brc_status brc_grid_plan(brc_context *context, const brc_shape *shape, const brc_fill *fill, const brc_walls *walls,
                         int n_threads, brc_grid *grid)
{
    *grid = (brc_grid){.n_requested = fill->n_elements};
    double bounds[2][3];
    brc_shape_bounds(shape, bounds);
    const double h = brc_fill_spacing(shape, fill);
    if (fill->cells[0] > 0 || (fill->n_elements > 0 && shape->kind == BRC_SHAPE_BOX)) {
        if (fill->cells[0] > 0)
            for (int k = 0; k < 3; ++k) grid->cells[k] = fill->cells[k];
        else
            box_cells(shape->size, fill->n_elements, grid->cells);
        for (int k = 0; k < 3; ++k) {
            grid->origin[k] = bounds[0][k];
            grid->spacing[k] = (bounds[1][k] - bounds[0][k]) / (double)grid->cells[k];
        }
    } else {
        lay_grid(shape, h, grid);
    }
    BRC_TRY(check_size(context, grid));
    BRC_TRY(check_thickness(context, shape, grid));
    if (fill->n_elements > 0 && shape->kind != BRC_SHAPE_BOX) {
        BRC_TRY(search_spacing(context, shape, fill, walls, n_threads, grid));
        BRC_TRY(check_thickness(context, shape, grid));
    } else {
        grid->n_inside = shape->kind == BRC_SHAPE_BOX ? grid->cells[0] * grid->cells[1] * grid->cells[2]
                                                      : count_inside(grid, fill, walls, n_threads);
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
        if (crowds(grid, cell, x, distance, kept, *position)) {
            ++*n_duplicate;
            continue;
        }
        if (*n >= grid->n_inside) { /* the plan counts a box without looking at the margin, never the other way */
            status = BRC_FAIL(context, BRC_INTERNAL, "more seeds than planned");
            goto cleanup;
        }
        for (int k = 0; k < 3; ++k) (*position)[3 * *n + k] = x[k];
        kept[cell] = (int32_t)++*n;
    }
cleanup:
    brc_memory_free(kept);
    if (status != BRC_OK) {
        brc_memory_free(*position);
        *position = NULL;
    }
    return status;
}
