/* What share of a crack belongs to one bond. */
#ifndef BRC_SOLVER_BOND_AREA_H
#define BRC_SOLVER_BOND_AREA_H

#include "../../../base/status.h"
#include "../../../../preprocess/domain/domain.h"

/* Area of crack that a broken bond leaves [m^2]. Cells: that of the face. Spheres: 3 V / L with the volume V that the
 * bond stands for (brc_strengths_volume) and the length L between the centres, as for the pyramids on a face. Then the
 * sum over bonds of area L n (x) n over the solid's volume is on average the unit tensor, so that the bonds that cross
 * a plane of a random packing have, projected on it, the plane's own area. */
double brc_bond_area(const brc_domain *domain, int64_t bond);

/* Areas of the bonds between spheres that close the volume around every element, area [n_bonds] [m^2]: those of
 * brc_bond_area but for the shares of an element's volume V, which change as little as they must for the sum over its
 * bonds of area L/2 n (x) n to come near V (1 - 2 s (x) s), s the mean of n: what the faces of a cell would add up to,
 * of which half is missing across a wall (there s is half the normal). So the bonds across a plane have the plane's
 * area in small bodies too, where most spheres are at walls and equal shares are ten percent too large. */
brc_status brc_bond_areas_closed(brc_context *context, const brc_domain *domain, double *area);

/* A crack costs a beam by its |cos| to the opening, and never less than by this, so that a beam that only slides keeps
 * a cost. Of an isotropic packing the beams across a plane with floor f cost 1 + f^3 / 2 of its area (they cross it as
 * |cos|, 3 |cos| max(|cos|, f) on average): 0.8 % too much at 1/4, where 1/2 took 6 %. */
#define BRC_BEAM_LEAST_COSINE 0.25

#endif
