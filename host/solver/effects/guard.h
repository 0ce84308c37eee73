/* The guard of every dynamic stage: looks at each element on the device and at the energy ledger, and stops a run that
 * goes wrong with where and why (docs/notebook/stability.md). */
#ifndef BRC_SOLVER_GUARD_H
#define BRC_SOLVER_GUARD_H

#include "../simulation.h"

/* How often it read probes (`looks` of a summary). Steps between reading what the device saw, and between ledgers; 0:
 * no dynamic stage yet. */
typedef struct brc_guard_report {
    int64_t every, ledger_every;
    int64_t probes, ledgers; /* times it read the one and the other */
} brc_guard_report;
brc_guard_report brc_simulation_guard_report(const brc_simulation *simulation);
/* Look at every element now and read what was found: before a state is kept as a good one. Nothing of the run changes.
 * BRC_PHYSICS_STOPPED where something is wrong; fine in stages that are not dynamic. */
brc_status brc_guard_vouch(brc_simulation *simulation, bool several);

/* Once a stage has its state: limits of this stage, and nothing found. */
brc_status brc_guard_begin_stage(brc_simulation *s);
/* After a step: enqueues a probe of the elements where one is due. Waits for nothing. */
brc_status brc_guard_step(brc_simulation *s);
/* Read what the probes found; at multiples of ledger_every, or where one was drawn up (else NULL), also the energy
 * ledger. BRC_PHYSICS_STOPPED with step, element, its bonds' last events and the likely cause; several: the run has
 * several models, and the sentence names this one. */
brc_status brc_guard_read(brc_simulation *s, bool several, const brc_ledger *ledger);

#endif
