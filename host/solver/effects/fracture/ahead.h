/* Steps ahead of what is known. Whether bonds of cells are to break in a step is decided on the device; the host acts
 * on it, so it would have to wait in every step. On a device that works beside the host, stretches of steps in which
 * nothing seems to break are taken as if nothing did, and counted; the host asks once, at their end. Where bonds were
 * to break after all, everything is put back to the start of the stretch and its steps are taken again with a question
 * each: the same bits in either case. A stretch is no longer than the steps before it in which nothing broke, so at
 * most half of all steps are taken in vain. Beams break on the device, and the host is to know where surfaces may
 * touch: there it is the count of broken ones that is asked for. So it is with the probes of how far surfaces moved,
 * once they found nothing: they are put down on the device, and the stretch stands where each found nothing. */
#ifndef BRC_SOLVER_AHEAD_H
#define BRC_SOLVER_AHEAD_H

#include "../../simulation.h"
#include "../effect.h"

enum { BRC_AHEAD_FEWEST = 16, BRC_AHEAD_MOST = 256 };

/* Of fracture, and of contact alone. */
extern const brc_effect_ahead brc_steps_ahead;
/* A stretch is being taken ... */
bool brc_ahead_is_on(const brc_simulation *s);
/* ... of beams none of which is broken. */
bool brc_ahead_is_whole(const brc_simulation *s);
/* The bonds that a step marked: found [count] of elements or groups; *n: their sum, 0 while steps are taken ahead. */
brc_status brc_ahead_count(brc_simulation *s, brc_buffer *found, int64_t count, double *n);
/* Bonds broke in the step before, so that some may in this one: what that would ask next may be asked at once, on a
 * device that works beside the host; brc_ahead_known tells whether any broke. */
bool brc_ahead_expects(const brc_simulation *s);
void brc_ahead_known(brc_simulation *s, bool some);
void brc_ahead_free(brc_simulation *s);

#endif
