/* Fracture of cells: how strong their bonds are, when they break, and the topology that is left (cells.cl). */
#ifndef BRC_SOLVER_CELL_BREAKS_H
#define BRC_SOLVER_CELL_BREAKS_H

#include "../../core/simulation_internal.h"

typedef struct brc_cell_breaks brc_cell_breaks;

/* s->fracture with everything that cells need; refuses materials without strength. */
brc_status brc_cell_breaks_create(brc_simulation *s);
/* What brc_fracture_free does not know. */
void brc_cell_breaks_free(brc_simulation *s);
/* Bonds break by a stress of their own, for which the forces of the full law are found with what the check needs. */
bool brc_cell_breaks_by_bond(const brc_simulation *s);
/* After the forces of a step: bonds above `share` of their limit break. half_kick: dt/2 where the
 * step's velocities still want the force at its end, half of it that of before the breaks (velocity Verlet); 0:
 * none. */
brc_status brc_cell_breaks_step(brc_simulation *s, double half_kick, double share);
/* The same with share 1: bonds that fail break. */
brc_status brc_cell_breaks_fail(brc_simulation *s, double half_kick);
extern const brc_field_table brc_cell_break_fields;
/* The largest ratio of stress to limit. */
brc_status brc_cell_breaks_failure_ratio(brc_simulation *s, double *out);

#endif
