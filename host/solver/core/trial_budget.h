/* Trials: a run that is only asked what its parts cost. Its linear solves and modes leave off where they are once its
 * budget is spent, as if they had converged, so that the run goes on to its end in little time. What it computes after
 * that is no answer. */
#ifndef BRC_SOLVER_TRIAL_BUDGET_H
#define BRC_SOLVER_TRIAL_BUDGET_H

#include "../simulation.h"

typedef struct brc_trial_budget {
    void *self;
    bool (*over)(void *self); /* asked after every iteration (modes: round) */
    int64_t batch;            /* dynamic stages: steps between pauses at most; may change while the run goes on */
} brc_trial_budget;

/* budget: borrowed until the simulation is freed or NULL is set. */
void brc_simulation_set_trial_budget(brc_simulation *simulation, const brc_trial_budget *budget);
/* Did a solve of the current stage leave off? */
bool brc_simulation_stopped_early(const brc_simulation *simulation);

#endif
