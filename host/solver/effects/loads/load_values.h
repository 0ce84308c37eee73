/* What loads say, for the files of this folder. */
#ifndef BRC_SOLVER_LOAD_VALUES_H
#define BRC_SOLVER_LOAD_VALUES_H

#include "../../core/simulation_internal.h"

/* value + gradient (x - origin), in the components of the load; its components as bits 1 2 4. */
void brc_load_direction(const brc_load *load, const double *x, double out[3]);
int brc_load_components(const brc_load *load);
/* As brc_load_find_set, and sets that are empty too. */
const brc_set *brc_load_find_named(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                   brc_status *status);
brc_status brc_load_refuse_empty(brc_simulation *s, const brc_stage *stage, const brc_load *load);

#endif
