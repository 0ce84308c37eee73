/* What points of accuracy say together: means over seeds, orders of convergence, Pareto fronts, and the price of an
 * error. Knows no files.
 *
 * A question is a problem with one Poisson's ratio; a series answers it in one way (model, preparation, precision,
 * integrator ...) at several resolutions; a mean is a series at one resolution, over its seeds. */
#ifndef BRC_BENCH_ACCURACY_STUDY_H
#define BRC_BENCH_ACCURACY_STUDY_H

#include "accuracy_point.h"

typedef struct brc_accuracy_mean {
    const brc_accuracy_point *point; /* one of them, for what they share; borrowed from the points */
    int n;                           /* points */
    int32_t series;
    double error; /* root of the mean square [-] */
    double sure;  /* the largest error of this and all finer means of the series: what errors that change sign hide is
                     not counted [-] */
    double cost_s, build_s, run_s; /* means [s] */
    double crossing_s;             /* of one crossing in dynamics [s] */
    double spacing;                /* spacing_over_length [-] */
    bool front;                    /* no mean of its question is cheaper and at most as wrong, by `sure` */
} brc_accuracy_mean;

typedef struct brc_accuracy_series {
    const brc_accuracy_point *point; /* borrowed */
    int32_t question;
    int n;        /* means */
    double order; /* slope of log error against log spacing; NAN: fewer than two resolutions with an error */
} brc_accuracy_series;

typedef struct brc_accuracy_question {
    const brc_accuracy_point *point; /* borrowed */
} brc_accuracy_question;

typedef struct brc_accuracy_study {
    int32_t n_questions, n_series;
    int64_t n_means;
    brc_accuracy_question *questions; /* [n_questions] in order of appearance */
    brc_accuracy_series *series;      /* [n_series] */
    brc_accuracy_mean *means;         /* [n_means] by question, series, spacing (coarse first) */
} brc_accuracy_study;

/* Points without an error are left out. The points are borrowed until the study is freed. */
brc_status brc_accuracy_study_create(brc_context *context, const brc_accuracy_points *points, brc_accuracy_study **out);
void brc_accuracy_study_free(brc_accuracy_study **study);

/* The cheapest mean of a question that is surely within `error`; model NULL: of any model. -1: none was measured. */
int64_t brc_accuracy_cheapest(const brc_accuracy_study *study, int32_t question, const char *model, double error);
/* What an error costs with a model [s]: along the model's own Pareto front, straight in the logarithms between its
 * means. *beyond -1: every measured mean is more wrong (NAN); +1: every one is better (the cheapest one's cost, an
 * upper bound); 0: in between. */
double brc_accuracy_cost(const brc_accuracy_study *study, int32_t question, const char *model, double error,
                         int *beyond);
/* What an error below that of a model's best mean would cost [s]: time goes with spacing^-4 (elements and steps;
 * elements and iterations), the error with the order of the best mean's series, at most 2; NAN where that order is
 * below 0.5 or unknown. */
double brc_accuracy_cost_beyond(const brc_accuracy_study *study, int32_t question, const char *model, double error);

#endif
