/* Radii and start points. Every draw depends on the fill's seed and the index of the element, or of the grid cell,
 * alone. */
#include "packing_internal.h"

#include "../../host/base/memory.h"
#include "../../host/base/random.h"
#include "../cells/order.h"

#include <math.h>
#include <string.h>

/* Densities of the grid tried until it has about as many points inside as there are spheres. */
#define MOST_GRIDS 40
/* So many points too many [of all] are drawn and left out again. */
#define MOST_SURPLUS 0.01
/* A grid so much finer than the spheres lie apart has found no room. */
#define LEAST_SPACING 0.2

/* A sphere of this radius, of that of four equal ones, fits between them: sqrt(3/2) - 1; and so much of the volume of
 * all spheres may stand in holes before they are full (a little below the third that random packings at 0.62 leave,
 * filled at 0.62 again). */
#define HOLE_RADIUS 0.2247
#define HOLES 0.2

/* Mean of radius^power over the table, radii being uniform between its points (or all equal at a step). */
static double table_moment(const brc_fill *fill, int power)
{
    double sum = 0.0;
    for (int32_t k = 1; k < fill->n_radii; ++k) {
        const double a = fill->radii[k - 1].radius, b = fill->radii[k].radius;
        double mean = 0.0; /* of r^p over a .. b: sum of a^m b^(p - m) / (p + 1) */
        for (int m = 0; m <= power; ++m)
            mean += pow(a, m) * pow(b, power - m) / (power + 1.0);
        sum += mean * (fill->radii[k].fraction - fill->radii[k - 1].fraction);
    }
    return sum;
}

double brc_pack_mean_radius(const brc_fill *fill)
{
    return fill->n_radii > 0 ? table_moment(fill, 1) : 1.0;
}

double brc_pack_mean_square(const brc_fill *fill)
{
    if (fill->n_radii == 0) return 1.0 + fill->radius_spread * fill->radius_spread / 3.0;
    return table_moment(fill, 2) / pow(table_moment(fill, 1), 2);
}

double brc_pack_mean_cube(const brc_fill *fill)
{
    if (fill->n_radii == 0) return 1.0 + fill->radius_spread * fill->radius_spread;
    return table_moment(fill, 3) / pow(table_moment(fill, 1), 3);
}

double brc_pack_largest(const brc_fill *fill)
{
    if (fill->n_radii == 0) return 1.0 + fill->radius_spread;
    return fill->radii[fill->n_radii - 1].radius / table_moment(fill, 1);
}

/* Integral of radius^power over the part of the table between two radii, divided by nothing: shares by number. */
static double part_moment(const brc_fill *fill, double low, double high, int power)
{
    double sum = 0.0;
    for (int32_t k = 1; k < fill->n_radii; ++k) {
        const double a = fill->radii[k - 1].radius, b = fill->radii[k].radius, from = fmax(a, low), to = fmin(b, high);
        if (!(to > from)) continue;
        sum += (fill->radii[k].fraction - fill->radii[k - 1].fraction) * (pow(to, power + 1) - pow(from, power + 1)) /
               ((power + 1.0) * (b - a));
    }
    return sum;
}

double brc_pack_loose_share(const brc_fill *fill)
{
    enum { CUTS = 200 };
    double loose = 0.0;
    if (fill->n_radii == 0) return 0.0;
    const double least = fill->radii[0].radius, most = fill->radii[fill->n_radii - 1].radius;
    for (int k = 1; k < CUTS; ++k) {
        const double cut = least * pow(most / least, (double)k / CUTS);
        const double below = part_moment(fill, least, cut, 3), above = part_moment(fill, cut, most, 3);
        if (below < HOLES * (below + above) && cut * above < HOLE_RADIUS * part_moment(fill, cut, most, 4))
            loose = fmax(loose, part_moment(fill, least, cut, 0));
    }
    return loose;
}

static double table_radius(const brc_fill *fill, double fraction)
{
    int32_t k = 1;
    while (k < fill->n_radii - 1 && fill->radii[k].fraction < fraction)
        ++k;
    const brc_radius *const a = fill->radii + k - 1, *const b = fill->radii + k;
    const double width = b->fraction - a->fraction;
    return width > 0.0 ? a->radius + (b->radius - a->radius) * (fraction - a->fraction) / width : b->radius;
}

double brc_pack_radius(const brc_fill *fill, int64_t element)
{
    double draw[4];
    brc_random_uniform4(fill->seed, BRC_RANDOM_PACKING_RADIUS, (uint64_t)element, 0, draw);
    if (fill->n_radii > 0) return table_radius(fill, draw[0]) / table_moment(fill, 1);
    return 1.0 + fill->radius_spread * (2.0 * draw[0] - 1.0);
}

typedef struct start_grid {
    const brc_solid *solid;
    uint64_t seed;
    double margin, spacing, origin[3]; /* [m] */
    int64_t cells[3];
} start_grid;

static void plan_grid(start_grid *grid, const double bounds[2][3], double spacing)
{
    grid->spacing = spacing;
    for (int k = 0; k < 3; ++k) {
        const double side = bounds[1][k] - bounds[0][k] - 2.0 * grid->margin;
        grid->cells[k] = (int64_t)fmax(1.0, ceil(side / spacing));
        grid->origin[k] = 0.5 * (bounds[0][k] + bounds[1][k] - spacing * (double)grid->cells[k]);
    }
}

/* The point of a grid cell; false where it is not inside. */
static bool grid_point(const start_grid *grid, int64_t x, int64_t y, int64_t z, double out[3])
{
    double draw[4];
    const uint64_t cell = (uint64_t)((z * grid->cells[1] + y) * grid->cells[0] + x);
    brc_random_uniform4(grid->seed, BRC_RANDOM_PACKING_POSITION, cell, 0, draw);
    out[0] = grid->origin[0] + grid->spacing * ((double)x + draw[0]);
    out[1] = grid->origin[1] + grid->spacing * ((double)y + draw[1]);
    out[2] = grid->origin[2] + grid->spacing * ((double)z + draw[2]);
    return brc_solid_inside(grid->solid, out, grid->margin);
}

/* Points of each row along x into counts[row]. Returns the sum. */
static int64_t count_points(const start_grid *grid, int n_threads, int32_t *counts)
{
    int64_t sum = 0;
#pragma omp parallel for schedule(dynamic, 16) num_threads(n_threads) reduction(+ : sum)
    for (int64_t row = 0; row < grid->cells[1] * grid->cells[2]; ++row) {
        double point[3];
        counts[row] = 0;
        for (int64_t x = 0; x < grid->cells[0]; ++x)
            counts[row] += grid_point(grid, x, row % grid->cells[1], row / grid->cells[1], point);
        sum += counts[row];
    }
    return sum;
}

/* Leaves out n_points - n points, one somewhere in each of as many equal stretches, and returns true for those. */
static bool left_out(const start_grid *grid, int64_t point, int64_t n_points, int64_t n)
{
    const int64_t surplus = n_points - n;
    if (surplus == 0) return false;
    const int64_t stretch = point * surplus / n_points; /* its points: first .. next - 1 */
    const int64_t first = (stretch * n_points + surplus - 1) / surplus;
    const int64_t next = ((stretch + 1) * n_points + surplus - 1) / surplus;
    double draw[4];
    brc_random_uniform4(grid->seed, BRC_RANDOM_PACKING_POSITION, (uint64_t)stretch, 1, draw);
    return point == first + (int64_t)(draw[0] * (double)(next - first));
}

/* The grid's points, without the surplus, into position [n][3]. counts becomes the first point of each row. */
static void take_points(const start_grid *grid, int n_threads, int32_t *counts, int64_t n_points, int64_t n,
                        double *position)
{
    const int64_t n_rows = grid->cells[1] * grid->cells[2];
    int32_t *const first = counts;
    int32_t before = 0;
    for (int64_t row = 0; row < n_rows; ++row) {
        const int32_t own = counts[row];
        first[row] = before;
        before += own;
    }
#pragma omp parallel for schedule(dynamic, 16) num_threads(n_threads)
    for (int64_t row = 0; row < n_rows; ++row) {
        int64_t point = first[row];
        /* points left out before this one: one for each finished stretch, and those passed in this one */
        const int64_t surplus = n_points - n, stretch = surplus ? point * surplus / n_points : 0;
        int64_t out = point - stretch;
        for (int64_t p = surplus ? (stretch * n_points + surplus - 1) / surplus : point; p < point; ++p)
            out -= left_out(grid, p, n_points, n);
        for (int64_t x = 0; x < grid->cells[0]; ++x) {
            double at[3];
            if (!grid_point(grid, x, row % grid->cells[1], row / grid->cells[1], at)) continue;
            if (!left_out(grid, point++, n_points, n)) memcpy(position + 3 * out++, at, sizeof at);
        }
    }
}

/* A grid with n points inside, or a little more: its spacing is searched. */
static brc_status find_grid(brc_context *context, start_grid *grid, int64_t n, int n_threads, int32_t **counts,
                            int64_t *n_points)
{
    double bounds[2][3];
    brc_solid_bounds(grid->solid, bounds);
    double spacing = cbrt(brc_solid_volume(grid->solid, NULL) / (double)n);
    const double finest = LEAST_SPACING * spacing;
    double least = 0.0, most = HUGE_VAL; /* spacings known to give enough, and too few */
    *n_points = 0;
    for (int k = 0; k < MOST_GRIDS; ++k) {
        plan_grid(grid, (const double(*)[3])bounds, spacing);
        brc_memory_free(*counts);
        *counts = NULL;
        BRC_TRY(BRC_ALLOCATE(context, counts, grid->cells[1] * grid->cells[2], "rows of the start grid"));
        *n_points = count_points(grid, n_threads, *counts);
        if (*n_points >= n && (double)*n_points <= (1.0 + MOST_SURPLUS) * (double)n + 1.0) return BRC_OK;
        if (*n_points >= n)
            least = fmax(least, spacing);
        else
            most = fmin(most, spacing);
        /* aim a little high, so that the next one is good rather than just too few */
        const double aim = spacing * cbrt(((double)*n_points + 0.3) / ((1.0 + 0.3 * MOST_SURPLUS) * (double)n + 0.3));
        spacing = aim > least && aim < most        ? aim
                  : least > 0.0 && most < HUGE_VAL ? 0.5 * (least + most)
                                                   : fmin(0.8 * most, aim);
        if (least > 0.0 && k > MOST_GRIDS - 4) spacing = least;
        if (spacing < finest) break;
    }
    if (*n_points >= n) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "fill: found room for %lld of %lld spheres at least %.3g m inside the shape, which is too thin for "
                    "them; use more "
                    "and so smaller spheres",
                    (long long)*n_points, (long long)n, grid->margin);
}

brc_status brc_pack_start(brc_context *context, const brc_solid *solid, const brc_fill *fill, int64_t n, double margin,
                          int n_threads, double **out, double *deepest)
{
    start_grid grid = {.solid = solid, .seed = fill->seed, .margin = margin};
    int32_t *counts = NULL;
    double *position = NULL;
    int64_t n_points = 0;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, find_grid(context, &grid, n, n_threads, &counts, &n_points));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &position, 3 * n, "start points of the packing"));
    take_points(&grid, n_threads, counts, n_points, n, position);
    BRC_TRY_OR(cleanup, brc_order_points(context, position, NULL, n, n_threads));
    double depth = 0.0;
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(max : depth)
    for (int64_t i = 0; i < n; ++i)
        depth = fmax(depth, brc_solid_depth(solid, position + 3 * i));
    *deepest = depth;
cleanup:
    brc_memory_free(counts);
    if (status != BRC_OK) {
        brc_memory_free(position);
        position = NULL;
    }
    *out = position;
    return status;
}
