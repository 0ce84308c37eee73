/* Loads of whole elements that no faces carry: dead forces and prescribed rotations. For the files of host/solver
 * only. */
#ifndef BRC_SOLVER_ELEMENT_LOADS_H
#define BRC_SOLVER_ELEMENT_LOADS_H

#include "../../core/simulation_internal.h"

/* An element of a load's set, with its storage row. */
typedef struct brc_load_member {
    int32_t row, id;
} brc_load_member;
/* By row, then by id; for qsort. */
int brc_load_compare_members(const void *left, const void *right);
/* Components as bits 1 2 4 into [n][3] of 0 and 1. */
brc_status brc_load_upload_components(brc_simulation *s, brc_buffer *out, const int32_t *bits, int32_t n);
/* The faces that the stage holds. BRC_BAD_INPUT: models whose elements have no faces that move. */
/* Where the held faces stand, as brc_held_faces.left; *out: NULL where none is held, else the caller's. */
brc_status brc_held_faces_places(brc_simulation *s, double **out);
brc_status brc_held_faces_create(brc_simulation *s, const brc_stage *stage, brc_held_faces *held);
/* Elements of a load's set (of a face set: the owners of its faces), by storage row, each once; owned by the caller. */
brc_status brc_load_members(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_load_member **out,
                            int32_t *n);

/* Make one load of the stage. taken [n_elements]: bits 1 2 4 of rotation components that earlier loads prescribe. */
brc_status brc_push_create(brc_simulation *s, const brc_stage *stage, int32_t l, brc_push_load *out);
brc_status brc_turn_create(brc_simulation *s, const brc_stage *stage, int32_t l, int32_t *taken, brc_turn_load *out);
void brc_element_loads_free(brc_loads *loads);

/* Add the forces of all pushes at time t to `force`, and book their work. */
brc_status brc_pushes_apply(brc_simulation *s, const brc_force_request *r);
/* All that loads remember. */
brc_status brc_loads_store(brc_simulation *s, brc_state_store *store);
/* Moments of all turns, which then balance the torques they meet, and their work. */
brc_status brc_turns_book(brc_simulation *s, const brc_force_request *r);
/* Bring orientations (statics, and the jump at the start of a stage) and spins to time t. */
brc_status brc_turns_prescribe(brc_simulation *s, double t);
/* Dynamics: spins that turn their elements from t0 to t1 as prescribed. */
brc_status brc_turns_begin_step(brc_simulation *s, double t0, double t1);

#endif
