/* Written by tests/validation/nah19-brazilian/law.py from disc-strengths.csv: 128 discs of 20 000 spheres, packings 1
 * to 8, of alumina, glass. Relative error left, root mean square over discs: 1.73 %, which is their scatter. */
#ifndef BRC_LAWS_DISC_H
#define BRC_LAWS_DISC_H

#include "strength_law.h"

static const brc_disc_law brc_disc_law_fitted = {
    .coordination = {6, 13},
    .radius = {0.1616, 0.5173},
    .band = {{0.4878, 0.5173},
             {0.4258, 0.4588},
             {0.3731, 0.4127},
             {0.326, 0.3749},
             {0.2758, 0.3389},
             {0.2207, 0.3048},
             {0.1753, 0.2819},
             {0.1616, 0.2801}},
    .term = {0.885794, 0.0649451, -0.00261378, -0.000657439, 0.313558, -0.0774605},
};

#endif
