/* What share of a crack belongs to one bond. */
#ifndef BRC_SOLVER_BOND_AREA_H
#define BRC_SOLVER_BOND_AREA_H

#include "../../preprocess/domain.h"

/* Area of crack that a broken bond leaves [m^2]. Cells: that of the face. Spheres: 3 V / L with the volume V that the bond stands for
 * (brc_strengths_volume) and the length L between the centres, as for the pyramids on a face. Then the sum over bonds of area L n (x) n over the
 * solid's volume is on average the unit tensor, so that the bonds that cross a plane of a random packing have, projected on it, the plane's own
 * area. */
double brc_bond_area(const brc_domain *domain, int64_t bond);

#endif
