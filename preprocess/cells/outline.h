/* The polygon of a shared face, which a domain does not keep, from the corners of its cell. */
#ifndef BRC_PREPROCESS_OUTLINE_H
#define BRC_PREPROCESS_OUTLINE_H

#include "../domain/domain.h"

/* A corner in the plane of a face, about its centroid. */
typedef struct brc_outline_corner {
    double angle, height, at[2]; /* angle: what grows with it; height: over the plane, either side [m] */
    int32_t vertex;
} brc_outline_corner;

/* Corners of the face of half-edge h of element e, counter-clockwise from outside, into out as indices into the
 * domain's vertex; their number, 0: they do not outline it. room: for twice the corners of the cell; out: for as many
 * as it has. Safe from any thread. */
int64_t brc_outline(const brc_domain *domain, int64_t e, int64_t h, brc_outline_corner *room, int32_t *out);

#endif
