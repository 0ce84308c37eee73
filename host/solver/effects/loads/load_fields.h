/* Fields of the lists that a stage's loads are made of. */
#ifndef BRC_SOLVER_LOAD_FIELDS_H
#define BRC_SOLVER_LOAD_FIELDS_H

#include "../../core/simulation_internal.h"

/* Of brc_held_faces (its elements, its faces), brc_held_load, brc_traction_load, brc_imposed_load, brc_push_load,
 * brc_turn_load. */
extern const brc_field_table brc_held_element_fields, brc_held_face_fields, brc_held_load_fields, brc_traction_fields,
    brc_imposed_fields, brc_push_fields, brc_turn_fields;
/* Passes over the lists of all loads; those of held faces are of models that have some. */
typedef struct brc_load_passes {
    brc_pass *held_prescribe, *held_energy;
    brc_pass *impose_motion, *impose_book, *zero_imposed, *zero_turned, *push_elements, *impose_turn, *turn_book;
} brc_load_passes;
const brc_load_passes *brc_load_passes_of(const brc_simulation *s);
brc_status brc_load_passes_make(brc_simulation *s);
/* Room for a list of n things. */
brc_status brc_load_fields_create(brc_simulation *s, const brc_field_table *table, int64_t n, void *list);

#endif
