/* Walls by mirror images. Every seed near a wall gets an image (a ghost) behind it, mirrored across the wall's tangent
 * plane at the seed's foot. Ghosts compete for space as seeds do but get no cell: the face between a seed and its ghost
 * lies in the tangent plane. So cells at a wall are Voronoi cells like all others, convex and closed, with twins that
 * agree. Flat walls are met exactly; on a curved wall the tangent planes' error falls with the square of the cell
 * size. */
#ifndef BRC_PREPROCESS_MIRROR_H
#define BRC_PREPROCESS_MIRROR_H

#include "walls.h"

/* Make the ghosts of the seeds position [n][3] in `walls`, in place of earlier ones. reach: of seeds that are mirrored
 * [m]. Nothing where no wall is mirrored. BRC_BAD_INPUT: a seed outside the solid. The result does not depend on
 * n_threads. */
brc_status brc_mirror_make(brc_context *context, const double *position, int64_t n, double reach, int n_threads,
                           brc_walls *walls);

/* Move the ghosts of curved walls along their normals such that the mean height of each seed's own face above the
 * solid's surface is zero: a plane that touches a curved wall lies above it everywhere else. Uses the cells the ghosts
 * now give. spacing: of seeds [m]. BRC_INTERNAL names the first seed that Voro++ gives no cell; BRC_NO_MEMORY. */
brc_status brc_mirror_fit(brc_context *context, const double *position, int64_t n, double spacing, int n_threads,
                          brc_walls *walls);

#endif
