/* Cracks that are there from the start: bonds cut into pairs of free faces. */
#ifndef BRC_PREPROCESS_CRACKS_H
#define BRC_PREPROCESS_CRACKS_H

#include "build.h"

/* Refuse cracks without area, not finite, without or with a doubled name. */
brc_status brc_cracks_check(brc_context *context, int32_t n, const brc_crack *cracks);
/* Mirror seeds across the planes of flat cracks (others are passed over), after any relaxation, so that faces lie in
 * them: for every seed within three spacings of the plane over the crack (and half a spacing beyond its rim) on one
 * side, its image; those on the other side there are dropped. The side with more such seeds is mirrored, so a crack
 * near a wall takes no seeds away. Mirrored seeds nearer to the plane than a quarter of a spacing are moved to that
 * distance (dropped where another seed is within it); images nearer than half a spacing to a seed that is not mirrored
 * are not made. No two seeds coincide that did not before. Faces are then exactly in the plane but for a seam about one
 * spacing wide along the rim, and about two spacings along walls that the plane meets at a slant or, nearer than one
 * and a half, runs along (images fall outside there), and single faces within a spacing of a round wall, whose planes
 * are not mirror images of one another; where two flat cracks come nearer than six spacings, only the later one is
 * exact (said as a warning). Kept seeds keep their order, images follow in the order of their sources: the result
 * depends on the seeds alone. position [*n][3] (seeds inside the solid, before the pose: pass the cracks turned back)
 * is changed in place and *n with it; room for twice *n is enough for one crack. Images may lie outside the solid: the
 * caller drops those. spacing: mean distance of seeds [m]. BRC_BAD_INPUT when there is no room (several cracks nearer
 * to each other than a spacing) and as brc_cracks_check; BRC_NO_MEMORY. */
brc_status brc_cracks_mirror_seeds(brc_context *context, int32_t n_cracks, const brc_crack *cracks, double spacing,
                                   double *position, int64_t *n, int64_t room);
/* Cut: every bond whose branch (the segment between the positions of its elements; cells and spheres alike) crosses a
 * crack is removed. The rim belongs to the crack, to 1e-9 of the mean spacing; an element in the plane counts as above
 * it. For each such bond cells get two free faces of the wall "<name>", with exactly the area vectors, centroids and
 * polygons of the face both shared, behind the free faces their element has, by crack and then by neighbour; a bond
 * that crosses several cracks belongs to the first. Rows, twins and bonds are renumbered: all promises of domain.h hold
 * again; closures do not change. *n_cut counts the bonds. Coordinates after the pose, positions and volumes set; before
 * sets are built and quality is measured. All ranks, where they have the domain between them. Elements that lose all
 * bonds are said as a warning. Refused with BRC_BAD_INPUT: cracks that brc_cracks_check refuses, the name of a wall, a
 * crack that cuts no bond (with the nearest element's distance); BRC_INTERNAL when sets of faces exist already;
 * BRC_NO_MEMORY. */
brc_status brc_cracks_cut(brc_context *context, int32_t n, const brc_crack *cracks, brc_domain *domain, int64_t *n_cut);

#endif
