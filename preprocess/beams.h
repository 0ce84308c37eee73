/* Spheres joined by beams: the bonds of a packing for a wanted mean coordination number, exactly (design: sort d / (R_i + R_j) and
 * cut), and the domain they make. */
#ifndef BRC_PREPROCESS_BEAMS_H
#define BRC_PREPROCESS_BEAMS_H

#include "solid.h"

/* Choose bonds and fill every array of `domain` that spheres have (domain.h), but for regions, bodies, sets and provenance.
 * position [n][3], radius [n] are taken over by the domain on success. The round(coordination n / 2) pairs with the smallest
 * d / (R_i + R_j) are bonded (ties by the smaller indices); quality.growth is the last one's ratio. Elements that touch a wall of the
 * solid (depth <= R (1 + 1e-6)) are its set's members; those with centres within 2 R_i are the set "<wall>_layer". BRC_BAD_INPUT: a coordination number that cannot be reached (with the
 * largest that can), fewer than 2 elements. */
brc_status brc_beams_build(brc_context *context, const brc_solid *solid, double *position, double *radius, int64_t n,
                           double coordination, int n_threads, brc_domain *domain);

#endif
