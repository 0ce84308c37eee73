/* A case of `breccia reproduce`: which runs to make, what to take from them, and what to hold it against. Data, read
 * from tests/validation/<case>/case.yaml; its README says what the keys mean. */
#ifndef BRC_COMMANDS_CASE_H
#define BRC_COMMANDS_CASE_H

#include "../../device/device.h"
#include <stdint.h>

/* How a value is judged. */
typedef enum brc_case_rule {
    BRC_CASE_ERROR_BOUND, /* |error| <= bound */
    BRC_CASE_AT_MOST,     /* value <= bound */
    BRC_CASE_AT_LEAST,    /* value >= bound */
    BRC_CASE_INFORMATION  /* no bound but that it could be computed */
} brc_case_rule;

/* One printed row. Texts are owned by the case. */
typedef struct brc_case_row {
    const char *quantity, *unit;
    double reference; /* NAN: none, or computed by the run's operator */
    double paper;     /* NAN: none */
    bool absolute;    /* error = value - reference; else relative */
    brc_case_rule rule;
    double bound;
} brc_case_row;

#define BRC_CASE_LIST 32 /* most overrides, labels, names in one list */

typedef struct brc_case_pair {
    const char *key, *value;
} brc_case_pair;

/* What is done with a run beside its measures (operators.h). */
typedef struct brc_operator brc_operator;

typedef struct brc_case_run {
    const char *name, *scene;
    char *own_name;    /* where the name was put together: owned */
    const char *about; /* a sentence printed above its rows; "" */
    bool quick;        /* part of --quick */
    bool keep;         /* its displacement at the end is kept for derived rows */
    bool may_stop;     /* a stop of the physics is a result, not a failure */
    const brc_operator *operator;
    const char *device; /* NULL: the one of the command line. A device that is not there: the run is skipped */
    bool has_precision;
    brc_precision precision;
    bool exact;        /* as in brc_device_request */
    int n_threads;     /* 0: as the command line says */
    int n_seeds;       /* samples, the seed of the fill one larger each time; values are means. Not with drift, build,
                          vibration or keep */
    double half_angle; /* hondros: of the loaded arcs [rad] */
    int n_overrides;
    const char *overrides[BRC_CASE_LIST];
    int n_files; /* files of the case that the scene reads: put beside it before the run */
    const char *files[BRC_CASE_LIST];
    int n_labels;
    brc_case_pair labels[BRC_CASE_LIST];
    int n_rows;
    brc_case_row *rows;
} brc_case_run;

/* What is computed from several runs. */
typedef enum brc_case_formula {
    BRC_CASE_MEAN,       /* of a quantity over the runs */
    BRC_CASE_WORST,      /* largest magnitude */
    BRC_CASE_ORDER,      /* slope of log |quantity - reference| against log `against`, sign so that convergence is
                            positive */
    BRC_CASE_RANGE,      /* largest minus smallest of a quantity, over its mean */
    BRC_CASE_RATIO,      /* magnitude of the mean of a quantity over the first half of the runs, over that of the second
                            half; an even number of runs */
    BRC_CASE_DIFFERENCE, /* largest difference of kept displacements, over the largest displacement; exactly two runs */
    BRC_CASE_CROSSING    /* where a quantity first passes `origin`, along `against`, linear between runs */
} brc_case_formula;

typedef struct brc_case_derived {
    brc_case_row row;
    brc_case_formula formula;
    bool quick;
    const char *of;      /* quantity */
    const char *against; /* "spacing" (elements^-1/3, the default), a quantity such as "time_step", or a label that is a
                            number */
    double origin;       /* what `of` converges to; 0 for errors */
    int n_runs;
    const char *runs[BRC_CASE_LIST];
    int n_labels;
    brc_case_pair labels[BRC_CASE_LIST];
} brc_case_derived;

typedef struct brc_case {
    const char *name, *title, *about;
    int n_runs;
    brc_case_run *runs;
    int n_derived;
    brc_case_derived *derived;
    const char *folder; /* scenes are read from there; NULL: from the program itself */
    struct brc_tree *tree;
} brc_case;

/* Read a case by name: from `folder`/<name>/case.yaml, or from the program itself when folder is NULL. BRC_BAD_INPUT
 * with place and cure, for an unknown name with the nearest one. */
brc_status brc_case_read(brc_context *context, const char *folder, const char *name, brc_case **out);
void brc_case_free(brc_case **what);
/* Text of a file of the case; freed by brc_memory_free. */
brc_status brc_case_text(brc_context *context, const char *folder, const char *name, const char *file, char **out,
                         size_t *bytes);
/* The k-th case in the program as "<name>/case.yaml", NULL beyond the last. */
const char *brc_case_name(int k);

#endif
