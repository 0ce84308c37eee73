/* Do bodies stand in one another? */
#ifndef BRC_PREPROCESS_OVERLAP_H
#define BRC_PREPROCESS_OVERLAP_H

#include "domain.h"

/* BRC_BAD_INPUT, one sentence for each pair of bodies that overlap (which, how many elements, the place of the first,
 * the cure). Cells overlap if the position of one lies inside a cell of the other, deeper than 1e-6 of its spacing, or
 * a corner of a free face deeper than a tenth; spheres if their centres are nearer than 0.9 (R_i + R_j), as packed; a
 * sphere and a body of cells if its centre lies in a cell or nearer than 0.9 R to a free face. Bodies that share a face
 * or touch do not. All ranks, where they have one of the bodies between them (domain.h, here). name [n]: what sentences
 * call the bodies, NULL: by number, from 0. BRC_NO_MEMORY. */
brc_status brc_overlap_check(brc_context *context, int32_t n, const brc_domain *const *bodies, const char *const *name);

enum { BRC_OVERLAP_NAME = 80 };
/* How sentences call a body: its name in quotes, or its number. Returns words. */
const char *brc_overlap_name(const char *const *name, int32_t body, char words[BRC_OVERLAP_NAME]);

#endif
