/* Closed cracks of cells whose bonds break at once (closed_face.h, closed_faces.cl; docs/notebook/fracture.md
 * "Closed faces"): the two sides of a broken face bear on each other until they stand clear. Model dlsm, dynamic stages
 * of scenes without contact, `fracture: {closure: true}`; else, and where faces open against cohesion, every function
 * here does nothing. */
#ifndef BRC_SOLVER_CLOSED_FACES_H
#define BRC_SOLVER_CLOSED_FACES_H

#include "../../core/rings.h"
#include "../../core/state_store.h"

extern const brc_field_table brc_closed_face_fields;

/* Arrays and kernels. the breaks of cells are there, with what softens. */
brc_status brc_closed_faces_create(brc_simulation *s);
void brc_closed_faces_free(brc_simulation *s);

/* ---- an evaluation; of the rings around breaks with the loads that faces had before ---- */
/* Whether any may be. */
bool brc_closed_faces_act(const brc_simulation *s, const brc_force_request *r);
/* After the gradients: which faces are pressed. */
brc_status brc_closed_faces_press(brc_simulation *s, const brc_force_request *r);
/* After the pass of fluxes over the rings 0 to `ring` of a list: B of pressed elements. */
brc_status brc_closed_faces_flux(brc_simulation *s, const brc_force_request *r, const brc_ring_list *list, int ring);
/* After that of forces: what pushes their elements. */
brc_status brc_closed_faces_force(brc_simulation *s, const brc_force_request *r, const brc_ring_list *list, int ring);

/* ---- a step with breaks ---- */
/* Before marked bonds break; after all of them broke; after the forces around them were found: forces and velocities
 * gain what pressed faces changed by (half_kick: brc_cell_breaks_step). */
brc_status brc_closed_faces_keep(brc_simulation *s);
brc_status brc_closed_faces_probe(brc_simulation *s);
brc_status brc_closed_faces_change(brc_simulation *s, double half_kick);

/* Places were set otherwise than by a step: all faces are looked at, until the next one. */
brc_status brc_closed_faces_restart(brc_simulation *s);
/* Energy that pressed faces hold, later (brc_vector_sum_later), and that sliding took so far [J]. */
brc_status brc_closed_faces_stored(brc_simulation *s, double *out);
brc_status brc_closed_faces_friction(brc_simulation *s, double *out);
/* What a checkpoint keeps (state_store.h). */
brc_status brc_closed_faces_store_state(brc_simulation *s, brc_state_store *store, const brc_chosen *bonds);

#endif
