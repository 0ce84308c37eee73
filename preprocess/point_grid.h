/* Points sorted into boxes of space as they come, and the nearest of them. For searches whose reach is not known
 * before, and for points that are added while searching. Adding is for one thread; any number may search. */
#ifndef BRC_PREPROCESS_POINT_GRID_H
#define BRC_PREPROCESS_POINT_GRID_H

#include "../host/base/status.h"
#include <stdint.h>

typedef struct brc_point_grid brc_point_grid;

/* Boxes about `edge` wide over `bounds` [m] (wider where there would be far more boxes than points); room for `room`
 * points. Points beyond the bounds are found too, only slower. BRC_NO_MEMORY. Caller frees with brc_point_grid_free. */
brc_status brc_point_grid_create(brc_context *context, const double bounds[2][3], double edge, int64_t room,
                                 brc_point_grid **out);
void brc_point_grid_free(brc_point_grid **grid);
/* Add a point; its index is the number of points before. There must be room. */
void brc_point_grid_add(brc_point_grid *grid, const double x[3]);
/* Index of the point nearest to x, of equally near ones the smallest; -1 when there is none. */
int64_t brc_point_grid_nearest(const brc_point_grid *grid, const double x[3]);
/* Is there a point nearer to x than `distance` [m]? */
bool brc_point_grid_crowded(const brc_point_grid *grid, const double x[3], double distance);

#endif
