/* The tables and diagrams of `breccia bench accuracy`. */
#ifndef BRC_BENCH_ACCURACY_REPORT_H
#define BRC_BENCH_ACCURACY_REPORT_H

#include "accuracy_study.h"

/* Write accuracy.md (what to take for 1 %, 0.1 % and 0.01 %; what other models cost at equal error; orders of
 * convergence; Pareto fronts) and a diagram of error against seconds a question, <problem>[_<nu>].png, into `folder`,
 * which is there. Without gnuplot there are no diagrams and a warning. */
brc_status brc_accuracy_report_write(brc_context *context, const brc_accuracy_study *study, const char *folder);
/* "dlsm, lloyd-5, 8000 elements" and what is unlike the default (double, 0.8 of the critical step, verlet); returns
 * `out`. */
const char *brc_accuracy_describe(const brc_accuracy_point *point, bool with_elements, char *out, size_t size);

#endif
