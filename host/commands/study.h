/* A study: many runs of one scene whose keys vary, as many at once as there is room for, and what they say together.
 * docs/reference/study.md has the file.
 *
 *     DIR/00000/...     a folder a run, as `breccia run` writes it; log.txt: what it told; study.txt: of what it is
 *     DIR/table.csv     a row a run: its keys, how it ended, its measures
 *     DIR/means.csv     runs that differ only in what is averaged over, together
 *     DIR/MEASURE.png   means against the first key that varies (study_plots.c), where gnuplot is installed
 *     DIR/fits.csv      the laws that were asked for, a row a parameter of each */
#ifndef BRC_COMMANDS_STUDY_H
#define BRC_COMMANDS_STUDY_H

#include "../base/status.h"
#include <stdint.h>

#define BRC_STUDY_KEYS 16
#define BRC_STUDY_VALUES 1000
#define BRC_STUDY_FITS 8
#define BRC_STUDY_MEASURES 64
#define BRC_STUDY_RUNS 100000
#define BRC_STUDY_PARAMETERS 3

typedef enum brc_study_kind { BRC_STUDY_LIST, BRC_STUDY_RANGE, BRC_STUDY_UNIFORM, BRC_STUDY_NORMAL } brc_study_kind;

/* Texts are owned by the study. */
typedef struct brc_study_key {
    const char *key; /* dotted path of the scene */
    brc_study_kind kind;
    int n_values;        /* of the grid; 1 of draws */
    const char **values; /* [n_values] of a list; owned */
    int64_t from;        /* of a range */
    double a, b;         /* uniform: from, to; normal: mean, deviation */
    const char *unit;    /* of draws; "": none */
    bool averaged;       /* means are taken over it */
} brc_study_key;

/* Laws of a measure; then those of fragments: of their number, and of the mass in fragments that are not larger. */
typedef enum brc_study_law {
    BRC_STUDY_WEIBULL,
    BRC_STUDY_POWER,
    BRC_STUDY_SIZE_EFFECT,
    BRC_STUDY_FRAGMENTS_POWER,
    BRC_STUDY_SCHUHMANN,
    BRC_STUDY_ROSIN_RAMMLER,
    BRC_STUDY_GILVARRY
} brc_study_law;

typedef struct brc_study_fit {
    brc_study_law law;
    const char *of; /* measure; "" of fragments */
    const char *by; /* key of power and size effect; else "" */
    int elements;   /* of the smallest fragment that counts */
    /* bounds of the power law of fragments, as shares of the mass; 0: the lower one is found from the fragments,
     * there is no upper one */
    double above, below;
} brc_study_fit;

/* What a law comes to. */
typedef struct brc_study_found {
    int n;            /* values that counted */
    int n_parameters; /* 0: there is no fit */
    struct {
        const char *name;    /* static storage */
        double value, error; /* standard error; NAN: none */
    } parameter[BRC_STUDY_PARAMETERS];
} brc_study_found;

typedef struct brc_study {
    char *scene; /* path; owned */
    int n_keys;
    brc_study_key keys[BRC_STUDY_KEYS];
    bool together; /* run k has the k-th value of every list and range of more than one; else all combinations */
    int draws;     /* at each point of the grid; 1 without random keys */
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
    int task, n_tasks; /* only runs task, task + n_tasks, ...; n_tasks 0: all */
    bool collect;      /* run nothing: what is there */
} brc_study_request;

/* Run what is not done yet. Returns BRC_OK also where single runs failed; they have their outcome. outcome [n_runs],
 * freed by brc_study_outcomes_free in any case. */
brc_status brc_study_run(brc_context *context, const brc_study *study, const brc_study_request *request,
                         brc_study_outcome **outcome);
void brc_study_outcomes_free(int n, brc_study_outcome **outcome);
/* DIR/slurm.sh: an array job whose tasks are the runs of the study, several a task beyond as many tasks as Slurm
 * takes by default. path: of the study. */
brc_status brc_study_write_slurm(brc_context *context, const brc_study *study, const char *path,
                                 const brc_study_request *request);
/* table.csv, means.csv, fits.csv: a function of the study, the outcomes, and the fragments.csv of the runs where
 * their laws are asked for. */
brc_status brc_study_write(brc_context *context, const brc_study *study, const char *folder,
                           const brc_study_outcome *outcome);

/* Runs that differ only in what is averaged over and in `by`: those of group g are run[start[g]] to
 * run[start[g + 1] - 1], growing; groups are in the order of their first runs. */
typedef struct brc_study_groups {
    int n;
    int *run, *start; /* [n_runs], [n + 1]; owned */
} brc_study_groups;

/* by: key, or NULL: nothing; one: all runs are a group. Freed by brc_study_groups_free in any case. */
brc_status brc_study_group(brc_context *context, const brc_study *study, const char *by, bool one,
                           brc_study_groups *out);
void brc_study_groups_free(brc_study_groups *groups);
brc_status brc_study_write_fits(brc_context *context, const brc_study *study, const char *folder,
                                const brc_study_outcome *outcome);
/* The picture of a measure, folder/MEASURE.png; none of fewer than two values. groups: of what is not averaged over;
 * room: [n_runs]. */
brc_status brc_study_draw(brc_context *context, const brc_study *study, const char *folder,
                          const brc_study_outcome *outcome, const brc_study_groups *groups, const char *measure,
                          double *room);
bool brc_study_is_averaged(const brc_study_key *key);
/* A cell of a table, in quotation marks where it has to be. */
struct brc_text;
void brc_study_add_cell(struct brc_text *text, const char *cell);
/* A measure of a run that is done; NAN: there is none. */
double brc_study_measured(const brc_study_outcome *outcome, const char *name);
/* Its text; "": the run has none. */
const char *brc_study_measure(const brc_study_outcome *o, const char *name);

/* Weibull's law of n > 1 positive values that are not all equal, by maximum likelihood: `modulus` with the standard
 * error of many values, `unbiased_modulus`, times (n - 2) / (n - 0.68) (Ross, IEEE Trans. Dielectr. Electr. Insul. 1,
 * 1994), `scale`. Nothing is found of other values. */
brc_study_found brc_study_fit_weibull(int n, const double *x);
/* y = factor x^exponent by least squares of the logarithms: at least two different x, all positive. */
brc_study_found brc_study_fit_power(int n, const double *x, const double *y);
/* Bazant's size effect law, y = strength / sqrt(1 + x / size) (J. Eng. Mech. 110, 1984, 518), by least squares of ln
 * y: at least three different x, all positive. Nothing is found where y does not fall with x, or falls as x^(-1/2) or
 * faster: then strength and size have no finite values. */
brc_study_found brc_study_fit_size_effect(int n, const double *x, const double *y);

/* Fragments of some runs. */
typedef struct brc_study_pieces {
    int n, n_runs;
    double *share;  /* [n] mass of each over that of its run, growing; owned */
    int *elements;  /* [n]; owned */
    double element; /* mean share of an element */
} brc_study_pieces;

/* Those of the last frame of fragments.csv in folder/run added to *pieces, which begins as {0}; sorted by
 * brc_study_pieces_sort. */
brc_status brc_study_pieces_add(brc_context *context, const char *folder, int run, brc_study_pieces *pieces);
brc_status brc_study_pieces_sort(brc_context *context, brc_study_pieces *pieces);
void brc_study_pieces_free(brc_study_pieces *pieces);
/* The law of the fit; see docs/reference/study.md. */
brc_status brc_study_fit_fragments(brc_context *context, const brc_study_pieces *pieces, const brc_study_fit *fit,
                                   brc_study_found *found);
/* The 97.5 % point of Student's t, to 0.2 %. */
double brc_study_student(int freedom);

#endif
