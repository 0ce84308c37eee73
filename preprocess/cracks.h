/* Cracks that are there from the start: bonds cut into pairs of free faces. */
#ifndef BRC_PREPROCESS_CRACKS_H
#define BRC_PREPROCESS_CRACKS_H

#include "build.h"

/* Refuse cracks without area, not finite, without or with a doubled name. */
brc_status brc_cracks_check(brc_context *context, int32_t n, const brc_crack *cracks);
/* Replace seeds near a flat crack's plane by mirror images across it, so that faces lie in its plane: for every seed within one spacing of the plane over the crack (and half a
 * spacing beyond its rim) on the negative side, its image; those on the positive side there are dropped. position [*n][3] is changed in place and *n with
 * it (never grows beyond `room`). Coordinates before the pose: pass the cracks turned back. */
brc_status brc_cracks_mirror_seeds(brc_context *context, int32_t n_cracks, const brc_crack *cracks, double spacing, double *position, int64_t *n, int64_t room);
/* Cut: every bond whose branch crosses a crack (cells: the segment between the two elements; spheres likewise) is removed; cells get two
 * free faces of the wall "<name>" for it, with the polygon both shared. Row order and all promises of domain.h hold again afterwards. *n_cut counts the bonds. BRC_BAD_INPUT: a crack that
 * cuts no bond (with the nearest distance). Before sets are built. */
brc_status brc_cracks_cut(brc_context *context, int32_t n, const brc_crack *cracks, brc_domain *domain, int64_t *n_cut);

#endif
