/* dlsm: the rim of the rings around broken bonds: fluxes of ring 2 and forces of the rings 2 and 3, found from what
 * their neighbours' stresses and fluxes gained (rims.cl) in place of an evaluation of their own. The rings
 * within are evaluated as a whole (force.c). */
#ifndef BRC_SOLVER_MODELS_DLSM_RIMS_H
#define BRC_SOLVER_MODELS_DLSM_RIMS_H

#include "../../core/rings.h"

/* Energies around breaks are those of elements and of bonds apart: of dlsm, where no face softens; of open faces cells
 * keep half each. */
bool brc_rims_energies_apart(const brc_simulation *s);
/* Whether the rim may be done so: the list is to be placed (rings.h). Not where surfaces touch or soften, or in the
 * comparison with whole evaluations. */
bool brc_rims_may_add(const brc_simulation *s, const brc_rings *rings);
/* Whether they are: the list was placed, there is room for what its elements gained, and the pass over the rim is not
 * over the whole body anyway. */
bool brc_rims_add(const brc_simulation *s, const brc_rings *rings);
/* Of each of the two gains: those of B follow those of P. */
int32_t brc_rims_records(const brc_rings *rings);

/* Passes, in the scopes of cells that break (cell_breaks.h). */
brc_status brc_rims_make_passes(brc_simulation *s, const brc_scope *cells);
/* P of rings 0 and 1 with what their elements hold, elastic_energy, and what P gained where the rim wants it. */
brc_status brc_rims_stress(brc_simulation *s, const brc_force_request *r);
/* B of the rings 0 to 2 where the rim is done so, 0 and 1 as a whole. moments: there are moments of faces
 * (held_moment). */
brc_status brc_rims_flux(brc_simulation *s, const brc_force_request *r, bool moments);
/* Forces of the rings 2 and 3: all of theirs, loads on them too, from those of the state, which are as before the
 * breaks and which they replace (brc_rings_replace). Nothing where the rim is not done so. */
brc_status brc_rims_force(brc_simulation *s, const brc_rings *rings);

#endif
