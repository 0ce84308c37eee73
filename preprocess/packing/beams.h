/* Spheres joined by beams: the bonds of a packing for a wanted mean coordination number, exactly (sort d / (R_i + R_j)
 * and cut), and the domain they make. */
#ifndef BRC_PREPROCESS_BEAMS_H
#define BRC_PREPROCESS_BEAMS_H

#include "../shapes/solid.h"

/* Choose bonds and fill every array of `domain` that spheres have (domain.h), but for regions, bodies, grains and
 * provenance: the two functions below in turn. position [n][3], radius [n] are taken over by the domain on success,
 * else they stay with the caller. balanced: bonds are those of brc_bond_balance, with what the walls of the solid do.
 * Temporary memory: about 110 + 16 coordination bytes a sphere. */
brc_status brc_beams_build(brc_context *context, const brc_solid *solid, double *position, double *radius, int64_t n,
                           double coordination, bool balanced, int n_threads, brc_domain *domain);

/* The round(coordination n / 2) pairs with the smallest d / (R_i + R_j) are bonded (ties by the smaller indices);
 * quality.growth is the last one's ratio. Fills all but walls and sets. BRC_BAD_INPUT: fewer than 2 elements, positions
 * or radii that are not finite, spheres in one place, a coordination number that is not positive or cannot be reached
 * (with the largest that can); BRC_NO_MEMORY. */
brc_status brc_beams_bond(brc_context *context, double *position, double *radius, int64_t n, double coordination,
                          int n_threads, brc_domain *domain);
/* Volumes and inertia of spheres as those of a body of which they fill that part (domain.h); until then, and where they
 * fill less than BRC_LOOSE, a third, as grains that lie far apart do, their own. Random packings at rest have 0.55 and
 * more. */
#define BRC_LOOSE (1.0 / 3)
void brc_beams_fill(brc_domain *domain, double volume_fraction);
/* Wall names and one set per wall: the elements that touch it (depth <= R (1 + 1e-6)); then the sets "<wall>_layer" of
 * those with centres within 2 R of it. Positions are those of the solid: before the pose. Sets may be empty. */
brc_status brc_beams_walls(brc_context *context, const brc_solid *solid, int n_threads, brc_domain *domain);

#endif
