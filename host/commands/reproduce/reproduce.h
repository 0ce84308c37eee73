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
    bool done;      /* ran, or stopped where that is a result */
    bool skipped;   /* not part of this campaign, or its device is not there */
    char note[400]; /* why it was skipped, stopped or failed */
    double seconds;
    int64_t n_elements, n_bonds, steps;
    char device[32];
    brc_precision precision;
    int n_values;
    brc_case_value values[BRC_CASE_VALUES];
    double *displacement;   /* [n_elements][3] kept on wish; owned */
    brc_isotropy *isotropy; /* [4] of a run of isotropy: every bond once, weighted with area (empty for beams), and both
                               inside; owned */
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
    bool priced; /* processor seconds of the runs, and the price of dynamics on their elements (pace.h), are wanted
                    too */
    brc_rows rows;
    brc_outcome *outcomes; /* [what->n_runs] */
    int n_judged, n_missed;
    struct brc_sample_store *samples; /* of reproduce_beams.c; owned */
} brc_campaign;

/* Carry out one run; a failure of the run itself is kept in its outcome (note), BRC_OK is returned. Not BRC_OK: an
 * interruption, or no memory. */
brc_status brc_outcome_obtain(brc_campaign *campaign, brc_outcome *outcome);
/* One run of the scene (a text, its name a path), watched by the run's operator: counts, times, measures and what the
 * operator adds. */
brc_status brc_outcome_simulate(brc_campaign *campaign, brc_outcome *outcome, const char *scene, const char *text,
                                size_t bytes, const char *folder);
/* The value of a derived row; NAN with a sentence in `note` where a run is missing. */
double brc_derived_value(const brc_campaign *campaign, const brc_case_derived *derived, char *note, size_t size);

/* Free what the operator isotropy keeps in an outcome. */
void brc_isotropy_forget(brc_outcome *outcome);
void brc_sample_store_free(struct brc_sample_store **store);

#endif
