/* Grains: a coarse Voronoi tessellation laid over the elements, each grain with a material of its own where asked. */
#ifndef BRC_PREPROCESS_GRAINS_H
#define BRC_PREPROCESS_GRAINS_H

#include "build.h"

/* Set domain->grain (0 .. number of grains - 1, only grains that got elements, in order of their centres' draw) and, with phases, domain->region =
 * n_regions + 1 + phase. Centres: Poisson-disc-like random points by the counter-based generator, independent of threads. BRC_BAD_INPUT:
 * grains smaller than two cells across, fractions out of range. */
brc_status brc_grains_assign(brc_context *context, const brc_grains *grains, int32_t n_regions, int n_threads, brc_domain *domain);

#endif
