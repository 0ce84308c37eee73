/* Beside diagonal blocks, which reach no farther than a bond in each iteration: a body of beams cut into a few parts,
 * moved as rigid ones by what their forces and torques sum up to. Far less work to make than multigrid, for solves that
 * are short. */
#ifndef BRC_SOLVER_RIGID_PARTS_H
#define BRC_SOLVER_RIGID_PARTS_H

#include "unknowns.h"

typedef struct brc_rigid_parts brc_rigid_parts;

/* Of a model whose bonds are known (brc_model_statics.bond) and whose elements turn, of a domain that this rank has
 * whole. */
bool brc_rigid_parts_suit(const brc_simulation *s);
/* Of the current stage's supports, and of the bonds as they are. *out NULL: what the parts resist with is not positive.
 * BRC_NO_MEMORY, BRC_DEVICE_FAILED. */
brc_status brc_rigid_parts_create(brc_simulation *s, brc_rigid_parts **out);
void brc_rigid_parts_free(brc_rigid_parts **parts);
/* z += P (P^T K P)^-1 P^T r, P what the motions of the parts are to elements; prescribed components stay. */
brc_status brc_rigid_parts_add(brc_rigid_parts *parts, brc_unknowns r, brc_unknowns z);

#endif
