/* Vectors of all unknowns of a static solve. */
#ifndef BRC_SOLVER_UNKNOWNS_H
#define BRC_SOLVER_UNKNOWNS_H

#include "../core/solver.h"

/* A vector of all unknowns: displacements or forces [n_rows][3] and, for cbm, rotations or torques [n_rows][3] (else
 * NULL). */
typedef struct brc_unknowns {
    brc_buffer *move, *turn;
} brc_unknowns;

/* y += a x; y = x + a y; x.y, the rotations' part times `weight`; to = from. */
brc_status brc_unknowns_add(brc_simulation *s, double a, brc_unknowns x, brc_unknowns y);
brc_status brc_unknowns_scale_add(brc_simulation *s, brc_unknowns x, double a, brc_unknowns y);
brc_status brc_unknowns_dot(brc_simulation *s, brc_unknowns x, brc_unknowns y, double weight, double *out);
brc_status brc_unknowns_copy(brc_unknowns from, brc_unknowns to);

#endif
