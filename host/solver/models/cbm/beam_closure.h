/* Broken beams whose ends still bear on each other (beam_closure.cl; docs/notebook/fracture.md "Beams beside
 * compression"). In dynamic stages of scenes with `fracture: {closure: true}`; without it, what is left of beams that
 * softened is taken off here as they end. Where beams neither soften nor shut every function here does nothing. */
#ifndef BRC_SOLVER_BEAM_CLOSURE_H
#define BRC_SOLVER_BEAM_CLOSURE_H

#include "../../effects/fracture/breaking.h"

extern const brc_field_table brc_beam_closure_fields;

/* Arrays and kernels, after those of softening. */
brc_status brc_beam_closure_create(brc_simulation *s);
void brc_beam_closure_free(brc_simulation *s);

/* Whether fracture_force adds what broken beams bear, which then only push along their axes, with its arguments of the
 * same names; else NULL. */
bool brc_beam_closure_within(const brc_simulation *s, brc_buffer **rubs, brc_buffer **other, brc_buffer **bears);
/* What broken beams bear of an evaluation: after fracture_force, where that does not add it, after cbm_energy, after
 * cbm_virial (virial [n_rows][6]), each after what softening takes off. */
brc_status brc_beam_closure_force(brc_simulation *s, const brc_force_request *r);
brc_status brc_beam_closure_energy(brc_simulation *s);
brc_status brc_beam_closure_virial(brc_simulation *s, brc_buffer *virial);

/* Between the motion of a step and its forces: what stands clear bears no more. */
brc_status brc_beam_closure_move(brc_simulation *s);
/* After the breaks of a step; half_kick as in fracture.cl. */
brc_status brc_beam_closure_begin(brc_simulation *s, int32_t moment, double half_kick);

/* What friction between the sides of interfaces took so far [J]; known once brc_vector_sums has been called. */
brc_status brc_beam_closure_friction(brc_simulation *s, double *out);

/* What a checkpoint keeps (state_store.h). */
brc_status brc_beam_closure_store_state(brc_simulation *s, brc_state_store *store);

#endif
