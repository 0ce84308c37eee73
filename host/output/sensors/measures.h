/* Measures: named operators on the histories of sensors (scene.h brc_measure). */
#ifndef BRC_OUTPUT_MEASURES_H
#define BRC_OUTPUT_MEASURES_H

#include "../../../preprocess/domain/domain.h"
#include "../cracks/cracks.h"
#include "history.h"

typedef struct brc_measured {
    const char *name; /* of the scene's measure, borrowed from it */
    const char *unit; /* static storage */
    double value;     /* NAN: could not be measured, see why_not */
    bool has_target;  /* given by the scene, or E, nu, K, G of the scene's only material */
    double target;
    double error;   /* value / target - 1 [-]; value - target where the target is 0 or the measure a Poisson's ratio */
    int64_t n_used; /* samples in the window */
    char why_not[256]; /* "" or the reason for NAN, one sentence */
} brc_measured;

/* Evaluate measure `index` of the scene. Never fails for want of data: value NAN and why_not say so.
 * BRC_NO_MEMORY only. domain may be NULL where no measure has an area_set; cracks: what broke, for at_first_break, or
 * NULL. */
brc_status brc_measure_evaluate(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                const brc_history *history, const brc_cracks *cracks, int32_t index, brc_measured *out);
/* The samples that a measure reads: those of its stage and window that are numbers. */
typedef struct brc_measure_series {
    int64_t n;
    double *time; /* [n] of the stage [s] */
    double *x;    /* [n] abscissa of a slope; else the same sensor as y, unscaled */
    double *y;    /* [n] times the measure's scale, over its reference area, minus for a Poisson's ratio */
} brc_measure_series;
/* Collect them for a measure, the scene's or one made for the purpose; where there are none measured->why_not says why.
 * BRC_NO_MEMORY. Caller frees. */
brc_status brc_measure_series_collect(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                      const brc_history *history, const brc_measure *measure, brc_measure_series *out,
                                      brc_measured *measured);
void brc_measure_series_free(brc_measure_series *series);
/* Reference area of a face set, as a flat section sees it: sum of |area vector . mean normal| [m^2]; NAN where the set
 * is not a face set. */
double brc_measure_area(const brc_domain *domain, int32_t set);

#endif
