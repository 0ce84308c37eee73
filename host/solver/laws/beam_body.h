/* What of a body decides its stiffness. First the coordination number of its inside. A body's number counts all
 * elements, and those at a wall have fewer bonds, so that at one number the inside of a small or slender body has more
 * bonds, and is stiffer, than that of a large one. */
#ifndef BRC_SOLVER_BEAM_BODY_H
#define BRC_SOLVER_BEAM_BODY_H

#include "../../../preprocess/domain/domain.h"

typedef struct brc_beam_body {
    double coordination; /* bonds of an element, mean over all of the body [-] */
    double inner; /* mean over the elements whose centres are 2 R or more away from every wall; 0: there are too few, or
                     no walls [-] */
    double reading; /* E by the bounding box along the longest edge over E of the inside; 0: neither a box nor a
                       cylinder [-] */
} brc_beam_body;

/* The reading of a body with the edges L1 >= L2 >= L3 in mean diameters: 1 + 1 / L1 - 0.2 (1 / L2 + 1 / L3). The 0.2, a
 * tenth of a diameter at each free surface that carries nothing, is that of cubes of 1000 to 40 000 spheres, bars and
 * plates at cn 10 (docs/notebook/beams-calibration.md). */
double brc_beam_body_reading(const double edges[3]);

/* Of one body of a domain of spheres; body < 0: of all. By the sets of the walls and "<wall>_layer" (domain.h), whose
 * names end in x-, x+ ... for planes and in "side" for the wall of a cylinder. BRC_NO_MEMORY. */
brc_status brc_beam_body_of(brc_context *context, const brc_domain *domain, int32_t body, brc_beam_body *out);

#endif
