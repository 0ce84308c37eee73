/* Grains: a coarse Voronoi tessellation laid over the elements, each grain with a material of its own where asked. */
#ifndef BRC_PREPROCESS_GRAINS_H
#define BRC_PREPROCESS_GRAINS_H

#include "build.h"

/* Set domain->grain (0 .. number of grains - 1; every grain has elements) and, with phases, domain->region = n_regions
 * + 1 + phase for the elements of the grains drawn for a phase; the shares hold to within one grain. Without grains
 * asked for (both n and size 0) nothing happens. Centres are elements' positions, drawn by the counter-based generator,
 * no two nearer than a distance that starts at 0.9 of the grain size and shrinks until there is room; an element goes
 * to the nearest centre, of equally near ones to the first drawn. The result depends on the elements and the request
 * alone, not on n_threads (>= 1). Call with positions, volumes, regions and, for spheres, quality.volume_shape set
 * (grains by size need it). Refused with BRC_BAD_INPUT: n and size both given, grains finer than two elements across
 * (eight elements each), fractions out of range; BRC_NO_MEMORY. */
brc_status brc_grains_assign(brc_context *context, const brc_grains *grains, int32_t n_regions, int n_threads,
                             brc_domain *domain);
/* Bonds whose two elements belong to different grains; 0 without grains. A bond is such a grain interface exactly if
 * grain[i] != grain[j]. */
int64_t brc_grains_count_interfaces(const brc_domain *domain);

#endif
