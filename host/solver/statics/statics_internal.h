/* Shared by the linear solvers of the static stage. */
#ifndef BRC_SOLVER_STATICS_INTERNAL_H
#define BRC_SOLVER_STATICS_INTERNAL_H

#include "../../base/log.h"
#include "pieces.h"
#include "rigid_parts.h"
#include "../core/solver.h"
#include "../core/trial_budget.h"
#include "multigrid/multigrid.h"

/* What statics/ keeps of a simulation. */
struct brc_statics {
    struct brc_static_run *stage; /* that runs; else NULL */
    brc_static_report report;
    double *modes;
    int32_t n_modes;
    int32_t n_known; /* states that a solve may begin from, borrowed */
    const double *const *known;
    double margin, largest_load; /* of the events of a stage; margin 0: none yet */
    double released; /* elastic energy beyond that of the broken bonds that events set free, and what stages let go of
                        as they began (settling.h) [J] */
    double changing; /* work of the loads of one stage, taken off while those of the next are put on [J] */
};

/* What stands for K^-1 in the iterations of a stage: multigrid where the body is large enough, else diagonal blocks. */
typedef struct brc_preconditioner {
    brc_buffer *blocks;       /* inverses [n_rows][6], cbm [n_rows][21] */
    brc_multigrid *multigrid; /* NULL: blocks, or not made yet */
    brc_multigrid_origin origin;
    brc_rigid_parts *parts; /* beside blocks; NULL: none, or not made yet */
    bool blocks_alone;      /* multigrid failed in this stage */
    bool bonds_broke;       /* since multigrid was made */
    double pace;            /* iterations for each digit of the residual in the first solve with it; 0: none yet */
} brc_preconditioner;

/* Device vectors of a linear solve K x = r; zero only for dlsm-published, orientation for models with rotations, theta
 * and kept, the orientations before the last move, for cbm. */
typedef struct brc_solve_vectors {
    brc_unknowns x, r, z, p, kp;
    brc_buffer *before;
    brc_preconditioner preconditioner;
    brc_buffer *zero, *orientation, *theta, *kept;
    int state_bytes;
    brc_pieces pieces; /* empty where nothing is free to move as a whole */
    double arm;        /* a torque over this counts as a force: mean radius of the spheres [m] */
    bool tangent;      /* K is that of the full law about the present state; else of the law about the undeformed one */
    bool gives_way;    /* solves at this load came upon a motion that the tangent does not hold back */
} brc_solve_vectors;

/* What a part keeps from solve to solve. */
typedef struct brc_static_run {
    brc_solve_vectors vectors;
    double reference; /* largest norm of the load so far [N] */
} brc_static_run;

/* Equilibrium at the simulation's load factor, from the state as it is; the work of the loads is booked.
 * BRC_PHYSICS_STOPPED: there is none. */
brc_status brc_statics_solve_at(brc_simulation *s, brc_static_run *run, brc_progress *progress);
/* Take off forces (or motions) what does work on the motions that the supports leave free. */
brc_status brc_statics_project_free_motions(brc_simulation *s, const brc_solve_vectors *v, brc_unknowns r);
/* The state times `factor`: under as much more of a load in proportion it is an equilibrium, exactly of the linear law,
 * a guess of the full one. */
brc_status brc_statics_scale(brc_simulation *s, brc_solve_vectors *v, double factor);
/* The pieces of the body as it is now, for the solves to come. */
brc_status brc_statics_find_pieces(brc_simulation *s, brc_solve_vectors *v);
/* v->x becomes what leads from the state, whose residual is in the simulation's own arrays, to the best mixture of
 * known states (known_states.c). */
brc_status brc_statics_mix_known(brc_simulation *s, brc_solve_vectors *v);
/* The largest failure ratio of all parts; NAN where one is not finite. */
brc_status brc_statics_failure(int32_t n, brc_simulation *const *part, double *ratio);
/* The refusals of a key that scales the loads of the stage: BRC_BAD_INPUT. */
brc_status brc_statics_refuse_unscalable(int32_t n, brc_simulation *const *part, const char *key);

extern const brc_field_table brc_solve_fields;
/* Vectors, pieces and the blocks of the preconditioner; a failure leaves what was made for the other. */
brc_status brc_solve_vectors_create(brc_simulation *s, brc_solve_vectors *v);
void brc_solve_vectors_free(brc_solve_vectors *v);

/* Sum of squares of forces and of torques over the arm [N^2]. */
brc_status brc_statics_square(brc_simulation *s, const brc_solve_vectors *v, brc_unknowns r, double *out);

/* Force on the free components of the state into the simulation's own force array, and its norm [N]. finite: full
 * law. */
brc_status brc_statics_residual(brc_simulation *s, const brc_solve_vectors *v, bool finite, double *norm);
/* kp = -K p of the linearised operator, prescribed components zero. */
brc_status brc_statics_apply(brc_simulation *s, brc_solve_vectors *v);
/* Residual over load at which the stage's equilibrium counts as reached [-]. */
/* Blocks; before a solve: multigrid where it is worth it, anew where bonds broke since it was made and iterations have
 * grown by half. */
brc_status brc_preconditioner_create(brc_simulation *s, brc_solve_vectors *v);
brc_status brc_preconditioner_prepare(brc_simulation *s, brc_solve_vectors *v);
/* z = M r, prescribed components zero. rotations: as in brc_conjugate_gradients. */
brc_status brc_preconditioner_apply(brc_simulation *s, brc_solve_vectors *v, bool rotations);
brc_status brc_preconditioner_store(const brc_simulation *s, brc_preconditioner *preconditioner,
                                    brc_state_store *store);
/* A solve took so many iterations from a residual to another. */
void brc_preconditioner_took(brc_solve_vectors *v, int64_t iterations, double from, double to);
/* Multigrid was not positive, or the residual stands: blocks from here on, with a warning. */
void brc_preconditioner_give_up(brc_simulation *s, brc_solve_vectors *v);
/* Solve K x = r to |r| <= target, or as near as `most` iterations bring it: v->r holds the right side and ends as the
 * residual, *left [N] its norm. rotations: of dlsm-published, whose torques are balanced by rotations alone. */
brc_status brc_conjugate_gradients(brc_simulation *s, brc_solve_vectors *v, bool rotations, double target, int32_t most,
                                   brc_progress *progress, double *left);
double brc_statics_tolerance(const brc_simulation *s);
int32_t brc_statics_most_iterations(const brc_simulation *s);
/* Restarted GMRES with right preconditioning: v->x solves K x = v->r to a residual of *left <= target [N] or as near as
 * `most` iterations bring it. */
brc_status brc_gmres(brc_simulation *s, brc_solve_vectors *v, double target, int32_t most, brc_progress *progress,
                     double *left);

#endif
