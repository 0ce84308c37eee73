/* Opening bonds: a domain without some of its bonds, whose faces become free. */
#ifndef BRC_PREPROCESS_CRACK_FACES_H
#define BRC_PREPROCESS_CRACK_FACES_H

#include "domain.h"

/* Remove the bonds with wall[b] >= 0 from the half-edges and renumber the rest. Cells get both faces of bond b as free
 * faces of the wall wall[b], behind those they have, by ascending wall and neighbour. All ranks, where they have the
 * domain between them, with the same walls. BRC_INTERNAL: corners of a cell
 * do not outline its face; BRC_NO_MEMORY. Refused: the domain is untouched. */
brc_status brc_crack_faces_open(brc_context *context, const int32_t *wall, brc_domain *domain);

#endif
