/* Brittle beams of interfaces that hold on alone (beam_alone.cl; docs/notebook/fracture.md "Fracture energy of beams").
 * Where no beam lies in a brittle interface every function here does nothing. */
#ifndef BRC_SOLVER_BEAM_ALONE_H
#define BRC_SOLVER_BEAM_ALONE_H

#include "../../effects/fracture/breaking.h"

extern const brc_field_table brc_beam_alone_fields;

/* Arrays and kernel, once the normals of interfaces are there. */
brc_status brc_beam_alone_create(brc_simulation *s);
void brc_beam_alone_free(brc_simulation *s);

/* After the elements chose (brc_fracture_choose) at `moment`. */
brc_status brc_beam_alone_choose(brc_simulation *s, int32_t moment);

#endif
