/* A body thrown on the ground: when it touches, how high it comes again, how it spins. */
#ifndef BRC_COMMANDS_REPRODUCE_BOUNCE_H
#define BRC_COMMANDS_REPRODUCE_BOUNCE_H

#include "reproduce.h"

/* The bounce operator, of a scene with gravity along -z (and across) and three sensors: push (force of the ground), height (mean displacement along z), spin. */
typedef struct brc_bounce brc_bounce;
brc_status brc_bounce_create(brc_context *context, brc_bounce **out);
void brc_bounce_free(brc_bounce **bounce);
brc_observer brc_bounce_observer(brc_bounce *bounce);
/* first_contact and release [s]: first sample at which the ground pushes, and the last of that touch; touches farther apart than first_contact are others: bounces [-] is
 * their number. apex [m]: of free flight after the first one, over the start, from the straight line through height + g t^2 / 2; spin_after: mean of that flight [rad/s].
 * NAN where a run did not come so far. BRC_BAD_INPUT: no such scene. */
brc_status brc_bounce_values(const brc_bounce *bounce, brc_outcome *outcome);

#endif
