/* Trials: a run that is only asked what its parts cost. Its linear solves and modes leave off where they are once
 * patience is over, as if they had converged, so that the run goes on to its end in little time. What it computes after
 * that is no answer. */
#ifndef BRC_SOLVER_PATIENCE_H
#define BRC_SOLVER_PATIENCE_H

#include "../simulation.h"

typedef struct brc_patience {
    void *self;
    bool (*over)(void *self); /* asked after every iteration (modes: round) */
    int64_t batch;            /* dynamic stages: steps between pauses at most; may change while the run goes on */
} brc_patience;

/* patience: borrowed until the simulation is freed or NULL is set. */
void brc_simulation_set_patience(brc_simulation *simulation, const brc_patience *patience);
/* Did a solve of the current stage leave off? */
bool brc_simulation_left_off(const brc_simulation *simulation);

#endif
