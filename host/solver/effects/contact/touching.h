/* What touches now, in scenes with contact. */
#ifndef BRC_SOLVER_TOUCHING_H
#define BRC_SOLVER_TOUCHING_H

#include "../../simulation.h"

typedef struct brc_touching {
    double pairs;       /* that touch [-] */
    double sliding;     /* of them [-] */
    double penetration; /* deepest: of spheres the overlap, of cells its volume over its area, and no more than the way
                           out of one of their faces where that is beyond a tenth of a cell [m] */
    double force;       /* sum of the magnitudes of their normal forces [N] */
} brc_touching;
/* As of the last evaluation of the forces; read from the device. BRC_BAD_INPUT: no contact. */
brc_status brc_simulation_touching(brc_simulation *simulation, brc_touching *out);

/* Device bytes that a pair of surfaces near each other takes at most, beside what elements do; 0: no contact. What
 * brc_simulation_planned_bytes cannot know: how many come near. */
int64_t brc_simulation_pair_bytes(const brc_simulation *simulation);

/* What contact follows. */
typedef struct brc_contact_report {
    int32_t n_pairs, n_listed; /* pairs near each other; exposed elements among which they are looked for */
    int64_t searches;          /* of all, so far */
    double n_rigid;            /* cells without bonds, rigid bodies now (dlsm) */
    int64_t pair_bytes;        /* of all arrays of pairs on the device */
} brc_contact_report;
brc_contact_report brc_simulation_contact_report(const brc_simulation *simulation);

#endif
