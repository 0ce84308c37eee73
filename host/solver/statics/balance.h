/* Forces that no support takes: only what does not move a body as a whole can be balanced by its elasticity. */
#ifndef BRC_SOLVER_BALANCE_H
#define BRC_SOLVER_BALANCE_H

#include <stdbool.h>
#include <stdint.h>

/* Take a + b x r off the forces at places r [n][3] so that their sum, and their moment together with the torques (NULL:
 * none) [n][3], are zero. *rigid: size (root of the sum of squares) of what was taken off [N]. */
void brc_balance(int64_t n, const double *place, const double *torque, double *force, double *rigid);

/* Rigid motions u = a + b x (X - centre), with rotations b of the elements, that given supports leave free. */
typedef struct brc_free_motions {
    double centre[3], arm; /* [m]; b counts times the arm */
    double held[6][6];     /* sum of the supports' rows (a, b arm) */
    int n;
    double motion[6][6]; /* [n] rows a, b */
} brc_free_motions;

/* Start without supports: the centre and size of the places [n][3]. */
void brc_free_motions_begin(brc_free_motions *free, int64_t n, const double *place);
/* A component of the displacement at a place is held; of the rotation. */
void brc_free_motions_hold(brc_free_motions *free, const double place[3], int component);
void brc_free_motions_clamp(brc_free_motions *free, int component);
/* Find what is left free; false when the eigenvalues did not converge. */
bool brc_free_motions_find(brc_free_motions *free);
/* Take off forces and torques [n][3] (NULL: elements are points) what does work on the free motions; they are then in
 * the range of a stiffness whose null space these motions are. */
void brc_free_motions_project(const brc_free_motions *free, int64_t n, const double *place, double *force,
                              double *torque);

#endif
