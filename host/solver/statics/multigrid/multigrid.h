/* Multigrid as preconditioner of the static solver: z near K^-1 r at a cost of a few evaluations of forces, symmetric
 * and positive. */
#ifndef BRC_SOLVER_MULTIGRID_MULTIGRID_H
#define BRC_SOLVER_MULTIGRID_MULTIGRID_H

#include "../unknowns.h"

typedef struct brc_multigrid brc_multigrid;

/* What multigrid was made of, from which the same can be made again later: bonds that broke after the moment
 * (brc_fracture_moment) counted as whole. */
typedef struct brc_multigrid_origin {
    int64_t moment;
    double weight;     /* of a step on the finest level [-]; 0: nothing was made */
    double law_weight; /* of a step of the law itself [-]; 0: there is none */
} brc_multigrid_origin;

/* Elements from which on it is worth its setup. */
enum { BRC_MULTIGRID_LEAST = 500 };

/* Steps of the law itself before and after the cycle: where the volume of some cells is so much stiffer or softer than
 * springs can be that they pay. */
bool brc_multigrid_has_law_steps(const brc_simulation *s);
/* Of the current stage's supports, and of the bonds as they are (origin->weight 0; what they are goes there) or as they
 * were. BRC_NO_MEMORY, BRC_DEVICE_FAILED. */
brc_status brc_multigrid_create(brc_simulation *s, brc_multigrid_origin *origin, brc_multigrid **out);
void brc_multigrid_free(brc_multigrid **multigrid);
/* z = M r. r.turn NULL: no torques; z.turn NULL: rotations are not asked for. r and z do not overlap. */
brc_status brc_multigrid_apply(brc_multigrid *multigrid, brc_unknowns r, brc_unknowns z);

/* out = right - A x of the finest level; right.move NULL: none; right.turn NULL: no torques. */
brc_status brc_multigrid_residual(brc_multigrid *multigrid, brc_unknowns x, brc_unknowns right, brc_unknowns out);

/* What it is made of. */
typedef struct brc_multigrid_report {
    int n_levels;
    int64_t nodes[16];    /* of each level, the finest first */
    int64_t device_bytes; /* held while it is there */
    int64_t host_bytes;   /* the most that its setup held */
    double seconds;       /* of its setup */
} brc_multigrid_report;
brc_multigrid_report brc_multigrid_get_report(const brc_multigrid *multigrid);

#endif
