/* Virial stress of a pulled sample against force over section (NAH19 section 2.2, Table 1). */
#ifndef BRC_COMMANDS_REPRODUCE_VIRIAL_H
#define BRC_COMMANDS_REPRODUCE_VIRIAL_H

#include "reproduce.h"

/* The virial operator, at the end of a run, for levels 0, 1, 2: level_K, mean of the normal stress along the pull over the bonded elements that are not loaded, over force / section, minus 1; inside_K, the
 * same over those more than two mean diameters away from the walls; scatter_K, how those differ from each other (standard deviation over mean). BRC_BAD_INPUT: not one box of spheres
 * pulled along an axis by two loads in its last stage. */
brc_status brc_virial_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);

#endif
