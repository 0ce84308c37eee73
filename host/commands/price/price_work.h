/* What a run costs, counted: no clock is asked, so that what is decided by it is the same on every machine. */
#ifndef BRC_COMMANDS_PRICE_WORK_H
#define BRC_COMMANDS_PRICE_WORK_H

#include "trial.h"

/* Does a stage take more iterations the more elements there are across? Not with multigrid. across: brc_setup_across */
bool brc_price_iterations_grow(const brc_stage *stage, double across);
/* Linear iterations of a static solve, rounds of modes: a rule of thumb, some for each element across, or so many with
 * multigrid. */
double brc_price_iterations(const brc_stage *stage, double across);
/* The whole run in bond updates of a dynamic step, building included: steps, increments and events as planned (of the
 * trial's entries only those are read), the scene's elements and bonds. */
double brc_price_work(const brc_scene *scene, const brc_setup *setup, const brc_trial *trial);

#endif
