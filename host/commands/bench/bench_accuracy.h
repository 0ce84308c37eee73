/* `breccia bench accuracy`: the sweeps of bench/accuracy, carried out; points, tables and diagrams of what accuracy
 * costs. */
#ifndef BRC_COMMANDS_BENCH_ACCURACY_H
#define BRC_COMMANDS_BENCH_ACCURACY_H

#include "../command.h"

typedef struct brc_accuracy_request {
    const char *output; /* folder of curves.csv, rows.*, accuracy.md, diagrams; and a folder a problem with its runs */
    const char *folder; /* problems are read from <folder>/accuracy; NULL: from the program */
    int n_problems;     /* 0: all */
    const char *const *problems;
    const char *device;
    int n_threads;
    bool quick;  /* only the runs of sweeps marked quick */
    bool resume; /* runs that curves.csv of the folder has are not made again */
} brc_accuracy_request;

/* A run that fails gives a point with a note and no error. BRC_BAD_INPUT: an unknown problem, a folder that holds
 * points and resume is false. */
brc_status brc_bench_accuracy(const brc_session *session, const brc_accuracy_request *request);
/* Names of the problems with their titles and numbers of runs, printed. */
brc_status brc_bench_accuracy_list(brc_context *context, const char *folder);

#endif
