/* Which regime a fracture ran in: how much of the energy moved when bonds began to break and until the load was at its
 * peak. Followed at the samples of dynamic stages of scenes with `fracture`. */
#ifndef BRC_SOLVER_REGIME_H
#define BRC_SOLVER_REGIME_H

#include "../simulation.h"

/* Ratios of kinetic to elastic energy [-]; NAN: not known (yet). */
typedef struct brc_regime {
    bool broke;
    double at_first_break; /* at the last sample before the first bond broke */
    double at_peak;        /* at the sample with the largest elastic energy */
    double until_peak;     /* largest from the first break to that sample */
    double last, most;     /* at the last sample; largest since the first break */
    double peak_elastic;   /* [J] */
} brc_regime;

/* Share of the elastic energy up to which a fracture is called quasi-static [-]. */
#define BRC_QUASI_STATIC 0.05

/* A sample with these energies [J] of all bodies and this many broken bonds. A regime starts as all zero. */
void brc_regime_follow(brc_regime *regime, double kinetic, double elastic, bool broken);
/* "quasi-static", "dynamic", or "" where nothing broke. */
const char *brc_regime_name(const brc_regime *regime);
/* Of a scene's first simulation. */
brc_regime brc_simulation_regime(const brc_simulation *simulation);

#endif
