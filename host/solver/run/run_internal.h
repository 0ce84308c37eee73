/* What run/ keeps of a simulation, for its own files. */
#ifndef BRC_SOLVER_RUN_INTERNAL_H
#define BRC_SOLVER_RUN_INTERNAL_H

#include "../core/regime.h"
#include "../core/solver.h"
#include "../core/trial_budget.h"
#include <signal.h>

enum { BRC_MOST_OBSERVERS = 8 };

/* Passes of every run; of rotations only where elements turn. */
typedef struct brc_run_passes {
    brc_pass *advance, *advance_rotation, *advance_tchamwa, *numerical_close;
    brc_pass *kinetic_energy, *add_spin_energy, *divide_by_mass;
} brc_run_passes;
brc_status brc_run_passes_make(brc_simulation *s);

/* Why a stage ended early (stage_end.c). */
typedef struct brc_stage_note {
    bool ended;
    char reason[192];
} brc_stage_note;

struct brc_run {
    brc_run_passes pass;
    struct brc_look *look; /* from the first look between two batches on (look.c) */

    int32_t stage;
    int64_t step, total_steps;
    double time, total_time_before, load_factor;
    bool open; /* velocities are those of half a step ago: half a kick is missing (dynamics.c) */
    brc_time_step time_step;
    char governed_by[64];                    /* of the time step, where it came from a store */
    int64_t calm_steps, judged_step;         /* for which the kinetic energy has been small; of the last sample */
    double damping_before, numerical_before; /* of earlier stages */
    double initial_energy, peak_elastic, peak_kinetic;
    double total_before_stage; /* energy when the stage was entered [J] */
    brc_stage_note *note;      /* [n_stages] */
    brc_regime regime;         /* of all parts, in the first one */

    int n_observers;
    brc_observer observers[BRC_MOST_OBSERVERS];
    volatile sig_atomic_t interrupted;
    const brc_trial_budget *budget; /* of a trial; else NULL */
    bool stopped_early;             /* in this stage */
    brc_simulation *const
        *volatile others; /* [n_others] while they run in step with this one: an interrupt reaches them too */
    volatile int32_t n_others;
    double setup_seconds, step_seconds;
};

#endif
