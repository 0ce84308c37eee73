/* Beams that open against cohesion, for a fracture energy (softening.h, beam_softening.cl;
 * docs/notebook/fracture.md "Fracture energy of beams"). All of it exists only where some bond of model cbm has a
 * fracture energy; without it every function here does nothing. */
#ifndef BRC_SOLVER_BEAM_SOFTENING_H
#define BRC_SOLVER_BEAM_SOFTENING_H

#include "../../effects/fracture/breaking.h"
#include "../../effects/fracture/strengths.h"

extern const brc_field_table brc_beam_softening_fields;

/* Openings over the length of a broken beam from which on its ends stand clear of each other. */
#define BRC_BEAM_CLEAR 0.05

/* Arrays and kernels; the factors of bonds are there. Warns where E G_c / sigma_f^2 is too short for the spheres. */
brc_status brc_beam_softening_create(brc_simulation *s, const brc_strengths *strengths);
void brc_beam_softening_free(brc_simulation *s);
bool brc_beam_softening_is_on(const brc_simulation *s);

/* What the openings take of an evaluation: after fracture_force; after cbm_energy; after cbm_virial (virial
 * [n_rows][6]). */
brc_status brc_beam_softening_force(brc_simulation *s, const brc_force_request *r);
brc_status brc_beam_softening_energy(brc_simulation *s);
brc_status brc_beam_softening_virial(brc_simulation *s, brc_buffer *virial);

/* Between the motion of a step and its forces: the openings follow. */
brc_status brc_beam_softening_move(brc_simulation *s);
/* After the elements chose: beams that can open do, and are chosen no more. */
brc_status brc_beam_softening_begin(brc_simulation *s, int32_t moment);
/* After what is still chosen broke: energies are booked, and beams at the end of their cohesion broken. */
brc_status brc_beam_softening_end(brc_simulation *s, int32_t moment);

/* States of the entries, and crack (beam_softening.cl); NULL where no beam softens. */
void brc_beam_softening_cracks(const brc_simulation *s, brc_buffer **open, brc_buffer **crack);

/* What a checkpoint keeps (state_store.h). */
brc_status brc_beam_softening_store_state(brc_simulation *s, brc_state_store *store);
/* brc_simulation_softening of beams, and whether some beam opened. */
brc_status brc_beam_softening_report(brc_simulation *s, brc_softening_report *out);

#endif
