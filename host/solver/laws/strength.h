/* Written by breccia calibrate: 4 samples of 10000 spheres, 1 of their axes, radii +-12.5 %, seeds 1001 to 1004, 9 coordination numbers 5.5 to 13, 6 radii 0.14 to 1, 1 E_m from 2e+12 Pa, 1 sigma_m from 2e+06 Pa, 30 passages of a wave to the expected strength. Relative error left, root mean square over the means of samples: 0.18 %. */
#ifndef BRC_LAWS_STRENGTH_H
#define BRC_LAWS_STRENGTH_H

#include "../strength_law.h"

static const brc_strength_law brc_strength_law_fitted = {
    .name = "fit of breccia calibrate",
    .coordination = {5.5, 13}, .radius = {0.14, 1},
    .surface = {{0.78001102101, 0.15225798896, -0.049694102611, 0.005033704642, 0.0012970228794, -0.00052969376778},
        {0.062201003164, -0.067242457626, 0.010973791935, 0.0063163121208, -0.0035307398912, 0.00082002973115},
        {-0.0026148375671, 0.0056280687935, -0.0028452883644, -0.00013462790202, 0.0014889053632, 0.00014229106836},
        {-0.0017403547914, -0.00014057152772, 0.0014204760526, -0.0010554390169, -0.00018764018226, 0.00057646318582}},
};

#endif
