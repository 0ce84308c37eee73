/* Radii of a packing's spheres, and the points from which they are pushed to rest. */
#ifndef BRC_PREPROCESS_START_H
#define BRC_PREPROCESS_START_H

#include "../shapes/solid.h"

/* How the radii of a fill are spread: moments of radius / mean radius. */
double brc_pack_mean_radius(const brc_fill *fill); /* of the table [m]; 1 without a table */
double brc_pack_mean_square(const brc_fill *fill); /* mean of (radius / mean radius)^2 */
double brc_pack_mean_cube(const brc_fill *fill);   /* mean of (radius / mean radius)^3 */
double brc_pack_largest(const brc_fill *fill);
/* Share (by number) of the spheres of a table that are so small and so little of the volume that they fit into the
 * holes between the others, where nothing presses them. */
double brc_pack_loose_share(const brc_fill *fill); /* largest radius / mean radius */
/* Radius of an element over the mean radius: a draw by its id. */
double brc_pack_radius(const brc_fill *fill, int64_t element);
/* n start points inside the solid, at least `margin` [m] from the walls, along the Hilbert curve; *out [n][3] is the
 * caller's. Every region holds its share of them (one random point in each cell of a grid), so that nothing has to flow
 * far. *deepest: largest distance of one to the walls [m]. BRC_BAD_INPUT when the solid holds no such points. */
brc_status brc_pack_start(brc_context *context, const brc_solid *solid, const brc_fill *fill, int64_t n, double margin,
                          int n_threads, double **out, double *deepest);

#endif
