/* Free vibration of a box by Rayleigh-Ritz in products of Legendre polynomials (Visscher's method): the exact values
 * that the vibration of a solid of cells is held against. Knows nothing of elements. */
#ifndef BRC_COMMANDS_REFERENCE_VIBRATION_H
#define BRC_COMMANDS_REFERENCE_VIBRATION_H

#include "../base/status.h"

/* A free box of isotropic elastic material. */
typedef struct brc_reference_box {
    double size[3]; /* edge lengths [m] */
    double young;   /* [Pa] */
    double poisson; /* [-] in (-1, 0.5) */
    double density; /* [kg/m^3] */
} brc_reference_box;

/* The n lowest angular frequencies [rad/s], ascending, the six rigid motions left out. degree: total degree of the
 * polynomials, 1..20; 14 gives four digits for a cube at any nu. BRC_BAD_INPUT for a degree or n that does not fit. */
brc_status brc_reference_vibration(brc_context *context, const brc_reference_box *box, int degree, int n, double *omega);

#endif
