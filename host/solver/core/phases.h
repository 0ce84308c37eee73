/* Where the time of the steps of dynamic stages goes: a watch that is handed from phase to phase. Wall seconds of the
 * calling thread, so what a device only queues (opencl) counts for the phase that waits for it. */
#ifndef BRC_SOLVER_PHASES_H
#define BRC_SOLVER_PHASES_H

#include "../simulation.h"

typedef enum brc_step_phase {
    BRC_PHASE_NONE,     /* no steps are done: nothing is counted */
    BRC_PHASE_MOTION,   /* integrator, prescribed motion, guard's probes, strikers */
    BRC_PHASE_FORCES,   /* elements, bonds and loads, once a step */
    BRC_PHASE_SEARCH,   /* who may touch whom */
    BRC_PHASE_PAIRS,    /* contact of pairs, and what they give to elements and strikers */
    BRC_PHASE_FRACTURE, /* who breaks, what breaks change (forces that are evaluated again included), faces that
                           soften */
    BRC_PHASE_LEDGER,   /* energies, and what the guard reads */
    BRC_PHASE_OUTPUT,   /* samples, frames, checkpoints */
    BRC_N_PHASES
} brc_step_phase;

/* "motion", "forces", "search", ...; "none". */
const char *brc_phase_name(brc_step_phase phase);
/* Seconds in a phase so far; 0 for BRC_PHASE_NONE. */
double brc_simulation_phase_seconds(const brc_simulation *simulation, brc_step_phase phase);

/* Steps of groups of elements, of this run of the program [-]: those that were left out, as nothing had reached them
 * (awake.h), and all there were; both 0 where nobody counts. */
typedef struct brc_rest_account {
    double left_out, all;
} brc_rest_account;
brc_rest_account brc_simulation_at_rest(const brc_simulation *simulation);

#endif
