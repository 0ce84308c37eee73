/* A sweep of `breccia bench accuracy`: a problem with an exact answer, and what is varied of it. Data, read from
 * bench/accuracy/<problem>/sweep.yaml; bench/accuracy/README.md says what the keys mean. It becomes a case whose runs
 * are the combinations. */
#ifndef BRC_COMMANDS_SWEEP_H
#define BRC_COMMANDS_SWEEP_H

#include "../reproduce/case.h"

/* What a run is priced by. */
typedef enum brc_sweep_cost {
    BRC_SWEEP_COST_RUN,      /* building and the run itself */
    BRC_SWEEP_COST_CROSSINGS /* building and 100 crossings of a wave in explicit dynamics on the same elements */
} brc_sweep_cost;

typedef struct brc_sweep {
    const char *problem;
    const char *quantity, *unit; /* what is held against the exact answer */
    double reference;            /* NAN: comes with the quantity; of scenes without one of their own */
    brc_sweep_cost cost;
    brc_case what;         /* named "accuracy/<problem>"; labels of a run: every axis and its value, in order */
    const char **sweep_of; /* [what.n_runs] name of the first sweep that has the run */
    double *reference_of;  /* [what.n_runs] NAN: comes with the quantity */
    struct brc_sweep_texts *texts;
    char name[64];
} brc_sweep;

/* Read a problem by name: from `folder`/accuracy/<problem>/sweep.yaml, or from the program itself when folder is NULL.
 * problem and folder are borrowed. BRC_BAD_INPUT with place and cure. */
brc_status brc_sweep_read(brc_context *context, const char *folder, const char *problem, brc_sweep **out);
void brc_sweep_free(brc_sweep **sweep);
/* The k-th problem in the program, NULL beyond the last; its length is *length. */
const char *brc_sweep_name(int k, int *length);
/* The value of an axis of a run; NULL when it has none. */
const char *brc_sweep_value(const brc_case_run *run, const char *axis);

#endif
