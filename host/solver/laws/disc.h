/* Written by tests/validation/nah19-brazilian/law.py from disc-strengths.csv: 128 discs of 20 000 spheres, packings 1 to 8, of alumina, glass. Relative error left, root mean square over discs:
 * 1.73 %, which is their scatter. */
#ifndef BRC_LAWS_DISC_H
#define BRC_LAWS_DISC_H

#include "../strength_law.h"

static const brc_disc_law brc_disc_law_fitted = {
    .coordination = {6, 13}, .radius = {0.1616, 0.5173},
    .term = {0.885794, 0.0649451, -0.00261378, -0.000657439, 0.313558, -0.0774605},
};

#endif
