/* The pieces of a body in a static stage: what each may do as a whole, since nothing holds it there, takes no part in
 * an equilibrium. */
#ifndef BRC_SOLVER_PIECES_H
#define BRC_SOLVER_PIECES_H

#include "balance.h"
#include "../simulation.h"

typedef struct brc_pieces {
    int64_t n;
    int64_t *start;         /* [n + 1] */
    int32_t *element;       /* [n_elements] ids, piece after piece */
    double *place;          /* [n_elements][3] of these, undeformed [m] */
    brc_free_motions *free; /* [n] what the loads of the stage leave free */
    bool any;               /* some piece has free motions */
} brc_pieces;

/* Number the parts of a domain that no bond joins, in the order of their first elements; piece [n_elements].
 * BRC_NO_MEMORY. */
brc_status brc_pieces_number(brc_context *context, const brc_domain *domain, int32_t *piece, int64_t *n);
/* Of the current stage: fragments where bonds can break, else the parts of the domain. *out is freed first. */
brc_status brc_pieces_find(brc_simulation *simulation, brc_pieces *out);
void brc_pieces_free(brc_pieces *pieces);
/* Take off forces and torques [n_elements][3] by id what does work on free motions; torque NULL: cells, of which single
 * ones and rows of them are held still by not moving (balance.h). BRC_NO_MEMORY. */
brc_status brc_pieces_project(brc_context *context, const brc_pieces *pieces, double *force, double *torque);

#endif
