/* Elements at rest, for those who foretell what a run takes. */
#ifndef BRC_SOLVER_REST_H
#define BRC_SOLVER_REST_H

#include "../core/awake.h"

/* Steps' worth of work of all elements that the next `steps` leave out, as a pressure wave of the fastest material
 * would wake the elements that are left along the longest edge of the domain's box; 0 where nothing is left out now. */
double brc_rest_spared(const brc_simulation *s, double steps);
/* Seconds of a step of all elements, where steps took `pace` from one account to the other. */
double brc_rest_whole_pace(double pace, brc_rest_account from, brc_rest_account to);
/* For comparison: everything is gone over, as with BRECCIA_AT_REST=compute. */
void brc_rest_compute_all(brc_simulation *s);

#endif
