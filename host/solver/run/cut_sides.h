/* Cuts (cracks that are there from the start) bear no push by themselves. */
#ifndef BRC_SOLVER_CUT_SIDES_H
#define BRC_SOLVER_CUT_SIDES_H

#include "../core/solver.h"

/* The present stage has ended: warns, with the cure, of each cut of cells whose sides now lie in each other where no
 * contact keeps them apart. All ranks. */
brc_status brc_cut_sides_tell(brc_simulation *s);

#endif
