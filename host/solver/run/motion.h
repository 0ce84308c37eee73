/* Kicks and drifts. */
#ifndef BRC_SOLVER_MOTION_H
#define BRC_SOLVER_MOTION_H

#include "../core/solver.h"

/* Velocities gain force over mass times `kick`, then everything moves for a time of `drift` [s]. */
brc_status brc_motion(brc_simulation *s, double kick, double drift);
/* Of Tchamwa-Wielgosz: a whole step of dt [s]. */
brc_status brc_motion_tchamwa(brc_simulation *s, double phi, double dt);
/* Of it, bodies that effects move, and rotations. */
brc_status brc_motion_turn(brc_simulation *s, const brc_occasion *now);
/* What is at rest is set in motion by no less than these [m/s], [rad/s]. */
double brc_motion_least_velocity(const brc_simulation *s);
double brc_motion_least_spin(const brc_simulation *s);

#endif
