/* What a static stage begins from (docs/notebook/theory.md T4). A body that is not in balance at its load factor 0, in
 * gravity, after a dynamic stage or because other loads were there, does not swing but is led to rest: its kinetic
 * energy is lost. Its unbalanced forces fall to nothing in proportion on the way to the first equilibrium; half of what
 * they do on it is lost where it is let go. After a static stage, whose loads are taken off as those of this one are
 * put on, it is work of the loads, and so it is wherever something must be put in. */
#ifndef BRC_SOLVER_SETTLING_H
#define BRC_SOLVER_SETTLING_H

#include "statics_internal.h"

/* Unbalanced forces and where the elements stand, by elements; host, zeros at first. */
typedef struct brc_settling {
    double *force, *torque; /* [n_elements][3] [N], [N m] */
    double *place;          /* [n_elements][3] displacements [m] */
    double *orientation;    /* [n_elements][4] */
} brc_settling;

/* At the load factor 0, before the first solve. */
brc_status brc_settling_begin(brc_simulation *s, const brc_solve_vectors *v, brc_settling *out);
/* At the first equilibrium: into what statics released, or the work of loads that change. */
brc_status brc_settling_end(brc_simulation *s, const brc_settling *from);
void brc_settling_free(brc_settling *settling);

#endif
