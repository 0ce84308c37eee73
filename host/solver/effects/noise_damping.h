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

#include "../core/simulation_internal.h"

/* One simulation has at most one. */
struct brc_noise {
    brc_pass *gradient_pass, *flux_pass, *force_pass, *damp;
    brc_buffer *gradient, *no_stress, *flux, *bond_part,
        *force;     /* of velocities: [n][9] 1/s, zeros, [n][9], [n][9], [n][3] */
    int64_t every;  /* 0: not in this stage */
    double factor;  /* [s^2]: v -= factor / m S v */
    double nothing; /* 0: no compaction */
    bool never;     /* false: no loads on faces, and the linear law */
};

/* Damp velocities of whole steps; what they lose is booked as damping. */
brc_status brc_noise_damp(brc_simulation *s);

#endif
