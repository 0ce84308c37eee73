/* A study: many runs of one scene whose keys vary, as many at once as there is room for, and what they say together. docs/reference/study.md has the file.
 *
 *     DIR/00000/...     a folder a run, as `breccia run` writes it; log.txt: what it told; study.txt: what it is a run of
 *     DIR/table.csv     a row a run: its keys, how it ended, its measures
 *     DIR/means.csv     runs that differ only in what is averaged over, together
 *     DIR/fits.csv      the laws that were asked for */
#ifndef BRC_COMMANDS_STUDY_H
#define BRC_COMMANDS_STUDY_H

#include "../base/status.h"
#include <stdint.h>

#define BRC_STUDY_KEYS 16
#define BRC_STUDY_VALUES 1000
#define BRC_STUDY_FITS 8
#define BRC_STUDY_MEASURES 64
#define BRC_STUDY_RUNS 100000

typedef enum brc_study_kind { BRC_STUDY_LIST, BRC_STUDY_RANGE, BRC_STUDY_UNIFORM, BRC_STUDY_NORMAL } brc_study_kind;

/* Texts are owned by the study. */
typedef struct brc_study_key {
    const char *key;  /* dotted path of the scene */
    brc_study_kind kind;
    int n_values;     /* of the grid; 1 of draws */
    const char **values; /* [n_values] of a list; owned */
    int64_t from;     /* of a range */
    double a, b;      /* uniform: from, to; normal: mean, deviation */
    const char *unit; /* of draws; "": none */
    bool averaged;    /* means are taken over it */
} brc_study_key;

typedef struct brc_study_fit {
    bool power;      /* y = a x^b; else Weibull */
    const char *of;  /* measure */
    const char *by;  /* power: key */
} brc_study_fit;

typedef struct brc_study {
    char *scene; /* path; owned */
    int n_keys;
    brc_study_key keys[BRC_STUDY_KEYS];
    bool together;  /* run k has the k-th value of every list and range of more than one; else all combinations */
    int draws;      /* at each point of the grid; 1 without random keys */
    uint64_t seed;
    int n_fits;
    brc_study_fit fits[BRC_STUDY_FITS];
    int n_runs;
    struct brc_tree *tree; /* owner of the texts */
} brc_study;

/* BRC_BAD_INPUT with places. */
brc_status brc_study_read(brc_context *context, const char *path, brc_study **out);
void brc_study_free(brc_study **study);
/* The value of a key in a run as YAML, into out. */
const char *brc_study_value(const brc_study *study, int run, int key, char *out, size_t room);

/* How a run ended, and what it measured; texts are owned. */
typedef struct brc_study_outcome {
    char status[24]; /* end.status of summary.json; "missing": not run; "bad_input": refused */
    char *reason;
    int n_measures;
    char *name[BRC_STUDY_MEASURES];
    char *text[BRC_STUDY_MEASURES]; /* as in summary.json; "" where there is none */
} brc_study_outcome;

typedef struct brc_study_request {
    const char *folder, *device, *precision; /* device, precision: NULL: default */
    int jobs, threads; /* runs at once, threads of each; 0: as many as there are processors for them; 1 */
    bool now;          /* do not price before */
} brc_study_request;

/* Run what is not done yet. Returns BRC_OK also where single runs failed; they have their outcome. outcome [n_runs], freed by brc_study_outcomes_free in any case. */
brc_status brc_study_run(brc_context *context, const brc_study *study, const brc_study_request *request, brc_study_outcome **outcome);
void brc_study_outcomes_free(int n, brc_study_outcome **outcome);
/* table.csv, means.csv, fits.csv: a function of study and outcomes alone. */
brc_status brc_study_write(brc_context *context, const brc_study *study, const char *folder, const brc_study_outcome *outcome);

/* Weibull's modulus and scale of n > 1 positive values that are not all equal, by maximum likelihood; false: there is none. */
bool brc_study_weibull(int n, const double *x, double *modulus, double *scale);
/* a, b and the standard error of b of y = a x^b by least squares of the logarithms; false: fewer than two different x, or one that is not positive. error is NAN for two points. */
bool brc_study_power(int n, const double *x, const double *y, double *a, double *b, double *error);
/* The 97.5 % point of Student's t, to 0.2 %. */
double brc_study_student(int freedom);

#endif
