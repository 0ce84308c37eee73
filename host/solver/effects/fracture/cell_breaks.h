/* Fracture of cells: how strong their bonds are, when they break, and the topology that is left (cells.cl). */
#ifndef BRC_SOLVER_CELL_BREAKS_H
#define BRC_SOLVER_CELL_BREAKS_H

#include "../../core/rings.h"

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
/* The largest ratio of stress to limit. */
brc_status brc_cell_breaks_failure_ratio(brc_simulation *s, double *out);

/* ---- for models ---- */
/* The rings around bonds that break; NULL: no cells break. */
brc_rings *brc_cell_breaks_rings(const brc_simulation *s);
/* An array of the cells' bonds or of the cells, as kernels call it (brc_cell_break_fields); NULL: not in this run. */
brc_buffer *brc_cell_breaks_array(const brc_simulation *s, const char *name);
/* Arrays of the cells' bonds, then of the rings around breaks, then what broken bonds keep. Three scopes, which must
 * stay where they are. */
typedef struct brc_cell_scopes {
    brc_scope breaks, rings, cells;
} brc_cell_scopes;
const brc_scope *brc_cell_scopes_make(const brc_simulation *s, const brc_scope *outer, brc_cell_scopes *room);
/* The room of `measure`, the stresses of marked bonds, which nobody wants once these broke, as `delta`. */
brc_scope brc_scope_of_deltas(const brc_simulation *s, const brc_scope *outer);

#endif
