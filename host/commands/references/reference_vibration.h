/* Free vibration of a box, a round cylinder or a sphere by Rayleigh-Ritz in products of Legendre polynomials
 * (Visscher's method): the exact values that the vibration of a solid of cells is held against. Knows nothing of
 * elements. */
#ifndef BRC_COMMANDS_REFERENCE_VIBRATION_H
#define BRC_COMMANDS_REFERENCE_VIBRATION_H

#include "../../base/status.h"

typedef enum brc_reference_shape {
    BRC_REFERENCE_BOX,
    BRC_REFERENCE_CYLINDER /* along x */,
    BRC_REFERENCE_SPHERE
} brc_reference_shape;

/* A free solid of isotropic elastic material. */
typedef struct brc_reference_solid {
    double size[3]; /* edge lengths of its bounding box [m] */
    double young;   /* [Pa] */
    double poisson; /* [-] in (-1, 0.5) */
    double density; /* [kg/m^3] */
    brc_reference_shape shape;
} brc_reference_solid;

/* The n lowest angular frequencies [rad/s], ascending, the six rigid motions left out. degree: total degree of the
 * polynomials, 1..20; 14 gives four digits for a cube at any nu. Round solids: at most 12, where the polynomials are
 * still far from dependent on the solid. BRC_BAD_INPUT for a degree or n that does not fit. */
brc_status brc_reference_vibration(brc_context *context, const brc_reference_solid *solid, int degree, int n,
                                   double *omega);

#endif
