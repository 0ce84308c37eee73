/* Faces of cells that open against cohesion, for a fracture energy (softening.{h,cl}, docs/notebook/fracture.md
 * "Fracture energy"). All of it exists only where some bond has a fracture energy; without it every function here does
 * nothing. */
#ifndef BRC_SOLVER_CELL_SOFTENING_H
#define BRC_SOLVER_CELL_SOFTENING_H

#include "../../core/solver.h"
#include "../../core/state_store.h"
#include "../../effects/fracture/strengths.h"

extern const brc_field_table brc_softening_fields;

/* Arrays and kernels, where strengths->softens; warns of bonds that are too long for their fracture energy.
 * the breaks of cells are there. */
brc_status brc_softening_create(brc_simulation *s, const brc_strengths *strengths);
void brc_softening_free(brc_simulation *s);
bool brc_softening_is_on(const brc_simulation *s);
/* Some face opened. */
bool brc_softening_acts(const brc_simulation *s);

/* What the openings change in an evaluation: H after the pass of gradients, B after that of fluxes (of the rings that
 * the pass went over), the forces; energies after those of the bonds. */
brc_status brc_softening_gradient(brc_simulation *s, const struct brc_ring_list *list, int ring);
brc_status brc_softening_flux(brc_simulation *s, const struct brc_ring_list *list, int ring);
brc_status brc_softening_force(brc_simulation *s, brc_buffer *force);
brc_status brc_softening_energy(brc_simulation *s);

/* Between the motion of a step and its forces: the openings follow. */
brc_status brc_softening_move(brc_simulation *s);
/* After the forces of a step: faces above `share` of their limit open, those that opened book their energy; *n_ended:
 * those at the end of their cohesion, marked for breaking. */
brc_status brc_softening_step(brc_simulation *s, double share, double *n_ended);
/* After bonds broke: counts of open faces anew, before the forces are evaluated; and after it, their forces. */
brc_status brc_softening_recount(brc_simulation *s);
brc_status brc_softening_refresh(brc_simulation *s);
/* After the energies of the broken bonds, around which the list is, were shared out. */
brc_status brc_softening_settle(brc_simulation *s, const struct brc_ring_list *around);

brc_status brc_softening_find_report(brc_simulation *s, struct brc_softening_report *out);
/* What a checkpoint keeps (state_store.h). */
brc_status brc_softening_store_state(brc_simulation *s, brc_state_store *store);
/* Energy lost to friction between the sides of broken faces so far [J]. */
brc_status brc_softening_friction(brc_simulation *s, double *out);

#endif
