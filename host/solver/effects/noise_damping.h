/* Damping of noise: a drag on what an element moves otherwise than its neighbours do, which leaves waves of more than a
 * few cells alone (docs/notebook/theory.md T9).
 *
 * With S the linear operator of the stabilisation energy without its compaction (dlsm_bond.h, beta 0: k (1 +
 * tau) |r|^2 / 2q of the residuals r, which vanish in every linear field) velocities lose z t_c n dt M^-1 S v at every
 * n-th step: z is the stage's noise_damping, t_c its critical step. The fastest oscillation of the body then has the
 * share z of its critical damping, at most, and a rigid motion or a uniform rate of strain has none. Model dlsm
 * only. */
#ifndef BRC_SOLVER_NOISE_DAMPING_H
#define BRC_SOLVER_NOISE_DAMPING_H

#include "../core/solver.h"

/* Damp velocities of whole steps; what they lose is booked as damping. */
brc_status brc_noise_damp(brc_simulation *s);
/* [n_rows][3] S v of the last time, with the sign of a force; and z t_c n dt [s^2]. */
brc_buffer *brc_noise_drag(const brc_simulation *s);
double brc_noise_factor(const brc_simulation *s);

#endif
