/* Elements that motion may have reached: what passes over all elements go over, where something knows it
 * (../effects/rest.c). The others have the same numbers as when these passes last went over them. */
#ifndef BRC_SOLVER_AWAKE_H
#define BRC_SOLVER_AWAKE_H

#include "phases.h"
#include "solver.h"

/* The groups of elements (n_groups of them), ascending; borrowed until the next call. groups NULL: all. */
void brc_awake_choose(brc_simulation *s, int32_t n, const int32_t *groups);
/* What is done from here on leaves the others out, or not (the motion of a step, its forces, the look at limits do);
 * returns what was before. */
bool brc_awake_only(brc_simulation *s, bool only);
/* A pass over all groups or rows (n_items), as brc_pass_run_on: of such work, over those that are awake. Devices that
 * cannot choose, and kernels that do not (portable.h), go over all. */
brc_status brc_pass_run_awake(const brc_simulation *s, const brc_pass *pass, int64_t n_items, const void *request,
                              const brc_given *given);
/* Of the look at limits after a step: a pass over groups. */
brc_status brc_pass_look_awake(brc_simulation *s, const brc_pass *pass, const brc_given *given);
/* Models tell the passes of an evaluation, in order: forces change up to so many rings of bonds around elements that
 * moved. */
brc_status brc_awake_passes(brc_simulation *s, int n, const brc_pass *const *passes);
int brc_awake_rings(const brc_simulation *s);
/* A step is counted (brc_simulation_at_rest, phases.h). */
void brc_awake_count(brc_simulation *s);

#endif
