/* What the files of the vibration of solids share. */
#ifndef BRC_COMMANDS_REFERENCE_VIBRATION_INTERNAL_H
#define BRC_COMMANDS_REFERENCE_VIBRATION_INTERNAL_H

#include "reference_vibration.h"

/* One function of the basis: component of the displacement and degrees along x, y, z. */
typedef struct brc_reference_function {
    int component, degree[3];
} brc_reference_function;

/* Upper triangles [size][size] of a round solid's stiffness over its density and of its mass over its density, for
 * functions of one reflection class (so that an eighth of the solid is integrated), exactly for polynomials of this
 * degree. Both are zero on entry. */
brc_status brc_reference_round_fill(brc_context *context, const brc_reference_solid *solid, int degree, int size,
                                    const brc_reference_function *basis, double *stiffness, double *mass);

#endif
