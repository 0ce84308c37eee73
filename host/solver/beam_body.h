/* What of a body's bonds decides its stiffness: the coordination number of its inside. A body's number counts all elements, and those at a wall have fewer
 * bonds, so that at one number the inside of a small or slender body has more bonds, and is stiffer, than that of a large one. */
#ifndef BRC_SOLVER_BEAM_BODY_H
#define BRC_SOLVER_BEAM_BODY_H

#include "../../preprocess/domain.h"

typedef struct brc_beam_body {
    double coordination; /* bonds of an element, mean over all of the body [-] */
    double inner;        /* mean over the elements whose centres are 2 R or more away from every wall; 0: there are too few, or no walls [-] */
} brc_beam_body;

/* Of one body of a domain of spheres; body < 0: of all. By the sets "<wall>_layer" (domain.h). BRC_NO_MEMORY. */
brc_status brc_beam_body_of(brc_context *context, const brc_domain *domain, int32_t body, brc_beam_body *out);

#endif
