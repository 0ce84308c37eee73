/* Fracture, as models, contact and solvers ask of it. */
#ifndef BRC_SOLVER_BREAKING_H
#define BRC_SOLVER_BREAKING_H

#include "../../core/solver.h"
#include "cell_breaks.h"
#include "fracture.h"

/* Broken beams may bear, or leave forces behind. */
bool brc_wants_lost_beams(const brc_wants *wants);
/* Beams may lie in interfaces. */
bool brc_wants_joined(const brc_wants *wants);
/* What bonds that broke keep; what criteria of elements have, their numbers too. */
brc_scope brc_scope_of_breaks(const brc_simulation *s, const brc_scope *outer);
brc_scope brc_scope_of_criterion(const brc_simulation *s, const brc_scope *outer);
/* Criteria of elements: limits, records and kernels, for beams and cells. branch: borrowed for as long as the
 * simulation lives. */
brc_status brc_fracture_create_elements(brc_simulation *s, brc_buffer *branch);
/* Of records as they stand: the bond each element loses, choice and measure. */
brc_status brc_fracture_choose(brc_simulation *s, int32_t moment);
/* Steps and static events so far: what orders breaks. */
int64_t brc_fracture_moment(const brc_simulation *s);
/* An event of a static stage at the present load factor: what brc_fracture_step breaks next belongs to it. */
brc_status brc_fracture_begin_event(brc_simulation *s);
/* After the forces of a step: break what fails. half_kick: as in fracture.cl. */
brc_status brc_fracture_step(brc_simulation *s, double half_kick);
/* Passes of a step of criteria of elements where nothing is near its limit, beside the forces (model.h), into out;
 * returns how many. */
int brc_fracture_step_passes(const brc_simulation *s, brc_step_pass *out);
/* Unbroken half-edges of the domain [n_half_edges] (1, else 0); *out is the caller's (brc_memory_free). */
brc_status brc_fracture_whole(brc_simulation *s, uint8_t **out);
/* Those that were unbroken at a moment (brc_fracture_moment), its own breaks counted as broken. */
brc_status brc_fracture_whole_at(brc_simulation *s, int64_t moment, uint8_t **out);
/* [n_rows] of how many bonds an element has lost what they bore; NULL: nothing breaks. */
brc_buffer *brc_fracture_lost_bonds(const brc_simulation *s);
/* Energy that left with broken bonds [J]. */
brc_status brc_fracture_lost(brc_simulation *s, double *out);
/* Limits of tension, compression and shear [n_elements][3], 0: none [Pa]; borrowed. */
const double *brc_fracture_limits(const brc_simulation *s);
/* What criteria of elements judged last: stress [n_elements][6] [Pa], record [n_elements][8] (fracture.cl). */
brc_status brc_fracture_judged(brc_simulation *s, double *stress, double *record);
/* Normals of interfaces by entries, plane [n_slots][3][C], zeros before: out of the own element, of the bonds in some
 * interface that lies [n_bonds] marks (interfaces.h). All ranks. */
brc_status brc_fracture_planes(brc_simulation *s, const uint8_t *lies, double *plane);
/* Factors of bonds, half-edges [n_slots][C]; NULL: all are as strong as their material. */
brc_buffer *brc_fracture_factors(const brc_simulation *s);

#endif
