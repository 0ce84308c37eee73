/* Written by breccia calibrate: 4 samples of 10000 spheres, 1 of their axes, radii +-12.5 %, seeds 1001 to 1004, 9
 * coordination numbers 5.5 to 13, 6 radii 0.14 to 1, 1 E_m from 2e+12 Pa, 1 sigma_m from 2e+06 Pa, 30 passages of a
 * wave to the expected strength. Relative error left, root mean square over the means of samples: 0.18 %. */
#ifndef BRC_LAWS_STRENGTH_H
#define BRC_LAWS_STRENGTH_H

#include "strength_law.h"

static const brc_strength_law brc_strength_law_fitted = {
    .name = "fit of breccia calibrate",
    .coordination = {5.5, 13},
    .radius = {0.14, 1},
    .surface = {{0.7800108408, 0.1521949223, -0.049611582962, 0.0049286849399, 0.0011965694522, -0.00050049399497},
                {0.062134751142, -0.06704378695, 0.010853861012, 0.0063910688208, -0.0033594188052, 0.00086521150007},
                {-0.0023812934697, 0.0053243501639, -0.0029508316804, 0.00013038693257, 0.0012673502387,
                 -3.4488818669e-05},
                {-0.0020573823799, 0.00015445507264, 0.0015951497634, -0.0013425768358, -2.2592701835e-05,
                 0.0007936980335}},
};

#endif
