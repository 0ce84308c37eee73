/* Carrying out a case: runs, the values they give, the rows these make. Shared by reproduce*.c. */
#ifndef BRC_COMMANDS_REPRODUCE_H
#define BRC_COMMANDS_REPRODUCE_H

#include "../../../bench/rows.h"
#include "../../../preprocess/domain/isotropy.h"
#include "case.h"
#include "../command.h"
#include "../run_scene.h"

/* A number that a run gives. */
typedef struct brc_case_value {
    char name[BRC_NAME];
    char unit[16];
    double value;
    double reference; /* NAN: the case says it, or there is none */
    double scatter;   /* standard deviation over samples, NAN: there are not several */
} brc_case_value;

#define BRC_CASE_VALUES 96

/* What became of a run. */
typedef struct brc_outcome {
    const brc_case_run *run;
    bool done;     /* ran, or stopped where that is a result */
    bool skipped;  /* not part of this campaign, or its device is not there */
    char note[400]; /* why it was skipped, stopped or failed */
    double seconds;
    int64_t n_elements, n_bonds, steps;
    char device[32];
    brc_precision precision;
    int n_values;
    brc_case_value values[BRC_CASE_VALUES];
    double *displacement; /* [n_elements][3] kept on wish; owned */
    brc_isotropy *isotropy; /* [4] of a run of isotropy: every bond once, weighted with area (empty for beams), and both inside; owned */
} brc_outcome;

void brc_outcome_add(brc_outcome *outcome, const char *name, const char *unit, double value, double reference);
/* NULL when the run gave no such value. */
const brc_case_value *brc_outcome_find(const brc_outcome *outcome, const char *name);

/* The number that a label of the run begins with ("12 m/s": 12); NAN: no such label, or no number. */
double brc_outcome_label(const brc_outcome *outcome, const char *key);

/* What a command line chose for a whole campaign. */
typedef struct brc_campaign {
    const brc_session *session;
    const brc_case *what;
    const char *folder; /* of the results */
    const char *device; /* NULL: auto */
    brc_precision precision;
    int n_threads;
    bool exact;
    bool quick;
    bool priced; /* processor seconds of the runs, and the price of dynamics on their elements (pace.h), are wanted too */
    brc_rows rows;
    brc_outcome *outcomes; /* [what->n_runs] */
    int n_judged, n_missed;
    struct brc_sample_store *samples; /* of reproduce_beams.c; owned */
} brc_campaign;

/* Carry out one run; a failure of the run itself is kept in its outcome (note), BRC_OK is returned. Not BRC_OK: an
 * interruption, or no memory. */
brc_status brc_outcome_obtain(brc_campaign *campaign, brc_outcome *outcome);
/* The value of a derived row; NAN with a sentence in `note` where a run is missing. */
double brc_derived_value(const brc_campaign *campaign, const brc_case_derived *derived, char *note, size_t size);

/* The drift operator: created and finished around a run, an observer in between. */
typedef struct brc_drift brc_drift;
brc_status brc_drift_create(brc_context *context, brc_drift **out);
void brc_drift_free(brc_drift **drift);
brc_observer brc_drift_observer(brc_drift *drift);
/* energy_drift, momentum_drift, angular_momentum_drift, closure_worst, closure_rms, energy_spread; energy_growth: the largest energy
 * over what initial fields and loads had put in by then. */
void brc_drift_values(const brc_drift *drift, brc_outcome *outcome);

/* The isotropy operator: build run->n_seeds samples of the scene (a text, its name a path) and add fabric_anisotropy, cubic,
 * worst_bin, rms_bin (reference: noise), noise, excess, means with their scatter, and common (what the samples share: chance falls out); the same
 * with _area (weighted with it), _inside (three layers away from walls) and _area_inside. */
brc_status brc_isotropy_values(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes);
/* Free what the operator keeps in an outcome. */
void brc_isotropy_forget(brc_outcome *outcome);
/* <case>.png, <case>-area.png, <case>-inside.png, <case>-area-inside.png into the campaign's folder, where runs of isotropy were made. */
brc_status brc_isotropy_figures(brc_campaign *campaign);

/* The beams operator: elastic tests of run->n_seeds samples of the scene's box along x: nu, E (means with scatter; references: the material's), r_m, E_m, nu_worst, E_worst.
 * A scene with `polish`: each sample polished along all axes, the result tried on a fresh sample (seeds after the last), means over its axes; and polished along x and y,
 * tried along z: nu_axis, E_axis (means with scatter), nu_axis_worst, E_axis_worst. */
brc_status brc_beams_values(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes);
void brc_sample_store_free(struct brc_sample_store **store);

/* The vibration operator: rms of the relative errors of the modes, and each mode [rad/s] with its exact value. */
brc_status brc_vibration_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);

#endif
