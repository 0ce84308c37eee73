/* What summary.json says of a fracture. */
#ifndef BRC_OUTPUT_CRACK_REPORT_H
#define BRC_OUTPUT_CRACK_REPORT_H

#include "../../solver/effects/fracture/fragments.h"
#include "../../solver/core/regime.h"
#include "crack_statistics.h"
#include "cracks.h"

typedef struct brc_crack_report {
    brc_crack_statistics statistics;
    brc_fragment_sizes sizes;
    brc_regime regime;
    double released;                /* energy of all breaks [J] */
    double implied_energy;          /* brc_simulation_implied_fracture_energy of the part that has most [J/m^2] */
    brc_softening_report softening; /* of all parts */
    double *area_of_body;           /* [scene.n_bodies] [m^2]; owned */
} brc_crack_report;

/* Of what was taken. What *out held is freed. */
brc_status brc_crack_report_find(brc_context *context, const brc_assembly *assembly, const brc_cracks *cracks,
                                 const brc_fragment_sizes *sizes, brc_crack_report *out);
void brc_crack_report_free(brc_crack_report *report);
/* Object `fracture`. */
void brc_crack_report_add(brc_json *json, const brc_scene *scene, const brc_cracks *cracks,
                          const brc_crack_report *report);

#endif
