/* Boxes are visited in shells round the one that holds x. After shell r everything nearer than r edges has been seen,
 * also where x or points lie beyond the bounds: they count to the outermost boxes, which only makes them appear
 * nearer. */
#include "point_grid.h"

#include "../host/base/memory.h"

#include <math.h>

struct brc_point_grid {
    double origin[3], edge; /* [m] */
    int64_t cells[3];
    int32_t *first; /* [cells] latest point of the box + 1, 0: none */
    int32_t *next;  /* [room] the one before it + 1 */
    double *position;
    int64_t n;
};

brc_status brc_point_grid_create(brc_context *context, const double bounds[2][3], double edge, int64_t room,
                                 brc_point_grid **out)
{
    *out = NULL;
    brc_point_grid *grid = NULL;
    brc_status status = BRC_ALLOCATE(context, &grid, 1, "search grid");
    if (status != BRC_OK) return status;
    double side[3], most = 0.0;
    for (int k = 0; k < 3; ++k) {
        grid->origin[k] = bounds[0][k];
        side[k] = bounds[1][k] - bounds[0][k];
        most = fmax(most, side[k]);
    }
    grid->edge = fmax(edge, 1e-5 * most);
    if (!(grid->edge > 0.0)) grid->edge = 1.0; /* all points are one */
    for (;;) {
        double count = 1.0;
        for (int k = 0; k < 3; ++k) {
            grid->cells[k] = (int64_t)floor(side[k] / grid->edge) + 1;
            count *= (double)grid->cells[k];
        }
        if (count <= 4.0 * (double)room + 64.0) break;
        grid->edge *= 1.25;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &grid->first, grid->cells[0] * grid->cells[1] * grid->cells[2],
                                     "boxes of a search grid"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &grid->next, room, "points of a search grid"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &grid->position, 3 * room, "points of a search grid"));
    *out = grid;
    grid = NULL;
cleanup:
    brc_point_grid_free(&grid);
    return status;
}

void brc_point_grid_free(brc_point_grid **grid)
{
    if (!grid || !*grid) return;
    brc_memory_free((*grid)->first);
    brc_memory_free((*grid)->next);
    brc_memory_free((*grid)->position);
    brc_memory_free(*grid);
    *grid = NULL;
}

static void box_of(const brc_point_grid *grid, const double x[3], int64_t box[3])
{
    for (int k = 0; k < 3; ++k) {
        const double place = floor((x[k] - grid->origin[k]) / grid->edge);
        box[k] = !(place > 0.0) ? 0 : place >= (double)grid->cells[k] ? grid->cells[k] - 1 : (int64_t)place;
    }
}

void brc_point_grid_add(brc_point_grid *grid, const double x[3])
{
    int64_t box[3];
    box_of(grid, x, box);
    int32_t *first = grid->first + box[0] + grid->cells[0] * (box[1] + grid->cells[1] * box[2]);
    for (int k = 0; k < 3; ++k)
        grid->position[3 * grid->n + k] = x[k];
    grid->next[grid->n] = *first;
    *first = (int32_t)++grid->n;
}

/* Look at the points of one box; *best [m^2] and *index are the nearest so far. */
static void look(const brc_point_grid *grid, int64_t box, const double x[3], double *best, int64_t *index)
{
    for (int64_t p = grid->first[box] - 1; p >= 0; p = grid->next[p] - 1) {
        const double *y = grid->position + 3 * p;
        const double r[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
        const double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        if (square > *best || (square == *best && p > *index && *index >= 0)) continue;
        *best = square;
        *index = p;
    }
}

/* Look at the boxes r away from `box` (in the largest coordinate). */
static void look_at_shell(const brc_point_grid *grid, const int64_t box[3], int64_t r, const double x[3], double *best,
                          int64_t *index)
{
    int64_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = box[k] - r > 0 ? box[k] - r : 0;
        high[k] = box[k] + r < grid->cells[k] - 1 ? box[k] + r : grid->cells[k] - 1;
    }
    for (int64_t k = low[2]; k <= high[2]; ++k)
        for (int64_t j = low[1]; j <= high[1]; ++j) {
            const int64_t row = grid->cells[0] * (j + grid->cells[1] * k);
            if (k - box[2] == r || box[2] - k == r || j - box[1] == r || box[1] - j == r) {
                for (int64_t i = low[0]; i <= high[0]; ++i)
                    look(grid, row + i, x, best, index);
                continue;
            }
            if (box[0] - r >= 0) look(grid, row + box[0] - r, x, best, index);
            if (box[0] + r < grid->cells[0]) look(grid, row + box[0] + r, x, best, index);
        }
}

/* Nearest point within `limit` [m^2], -1: none. */
static int64_t search(const brc_point_grid *grid, const double x[3], double limit)
{
    int64_t box[3], index = -1, shells = 0;
    double best = limit;
    box_of(grid, x, box);
    for (int k = 0; k < 3; ++k)
        shells = grid->cells[k] > shells ? grid->cells[k] : shells;
    for (int64_t r = 0; r < shells; ++r) {
        const double seen = (double)(r - 1) * grid->edge * (1.0 - 1e-9); /* rounding in box_of */
        if (r > 0 && best < seen * seen) break;
        look_at_shell(grid, box, r, x, &best, &index);
    }
    return index;
}

int64_t brc_point_grid_nearest(const brc_point_grid *grid, const double x[3])
{
    return search(grid, x, HUGE_VAL);
}

bool brc_point_grid_crowded(const brc_point_grid *grid, const double x[3], double distance)
{
    const int64_t p = search(grid, x, distance * distance);
    if (p < 0) return false;
    const double *y = grid->position + 3 * p;
    const double r[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < distance * distance;
}
