/* Brittle beams that bridge a crack of a solid (beam_bridges.cl; docs/notebook/fracture.md "Beams that bridge a
 * crack"). Where no beam breaks at once, or `closure: false` asks for the paper's law, every function here does
 * nothing. */
#ifndef BRC_SOLVER_BEAM_BRIDGES_H
#define BRC_SOLVER_BEAM_BRIDGES_H

#include "../../effects/fracture/breaking.h"

extern const brc_field_table brc_beam_bridge_fields;

/* Arrays and kernel, once the limits of elements are there. */
brc_status brc_beam_bridges_create(brc_simulation *s);
void brc_beam_bridges_free(brc_simulation *s);

/* After the elements chose (brc_fracture_choose) at `moment`; half_kick: of a step (fracture.cl), 0: of an event. */
brc_status brc_beam_bridges_choose(brc_simulation *s, int32_t moment, double half_kick);

#endif
