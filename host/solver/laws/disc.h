/* Written by tests/validation/nah19-brazilian/law.py from disc-strengths.csv: 64 discs of 20 000 spheres, packings 1 to 4, of alumina, glass. Relative error left, root mean square over discs:
 * 1.85 %, which is their scatter. */
#ifndef BRC_LAWS_DISC_H
#define BRC_LAWS_DISC_H

#include "../strength_law.h"

static const brc_disc_law brc_disc_law_fitted = {
    .coordination = {6, 13}, .radius = {0.1616, 0.517},
    .term = {0.926075, 0.0349586, 0.000709883, -0.00088244, 0.173283},
};

#endif
