/* Shared by the linear solvers of the static stage. */
#ifndef BRC_SOLVER_STATICS_H
#define BRC_SOLVER_STATICS_H

#include "../base/log.h"
#include "simulation.h"

/* Device vectors [n_rows][3] of a linear solve K x = r, and preconditioner blocks [n_rows][6]; zero and orientation only for
 * dlsm-published. */
typedef struct brc_solve_vectors {
    brc_buffer *x, *r, *z, *p, *kp, *move, *blocks;
    brc_buffer *zero, *orientation;
    int state_bytes;
} brc_solve_vectors;

/* Force on the free components of the state into the simulation's own force array, and its norm [N]. finite: full law. */
brc_status brc_statics_residual(brc_simulation *s, bool finite, double *norm);
/* kp = -K p of the linearised operator, imposed components zero. */
brc_status brc_statics_apply(brc_simulation *s, brc_solve_vectors *v);
/* Residual over load at which the stage's equilibrium counts as reached [-]. */
double brc_statics_tolerance(const brc_simulation *s);
int32_t brc_statics_most_iterations(const brc_simulation *s);
/* Restarted GMRES with right preconditioning: v->x solves K x = v->r to a residual of *left <= target [N] or as near as
 * `most` iterations bring it. */
brc_status brc_gmres(brc_simulation *s, brc_solve_vectors *v, double target, int32_t most, brc_progress *progress, double *left);

#endif
