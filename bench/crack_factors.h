/* Strengths that let cracks run: for the bench of what breaking costs. */
#ifndef BRC_BENCH_CRACK_FACTORS_H
#define BRC_BENCH_CRACK_FACTORS_H

#include "../preprocess/domain/domain.h"

/* Factors of strength of the bonds across three planes of a unit cube, normal to x, as a CSV of element_i, element_j,
 * factor: from 0.003 at the edge y = 0 up by 1 over the side, so that under a stress that grows with time fronts run
 * across the planes. All other bonds: 1e6. */
brc_status brc_crack_factors_write(brc_context *context, const brc_domain *domain, const char *path);

#endif
