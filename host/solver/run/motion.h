/* Kicks and drifts. */
#ifndef BRC_SOLVER_MOTION_H
#define BRC_SOLVER_MOTION_H

#include "../core/solver.h"

/* Velocities gain force over mass times `kick`, then everything moves for a time of `drift` [s]. */
brc_status brc_motion(brc_simulation *s, double kick, double drift);
/* Of it, bodies that effects move, and rotations. */
brc_status brc_motion_turn(brc_simulation *s, const brc_occasion *now);

#endif
