/* The operator `told` of a case: is the error class that `breccia check` tells of a scene that of the run? */
#ifndef BRC_COMMANDS_REPRODUCE_TOLD_H
#define BRC_COMMANDS_REPRODUCE_TOLD_H

#include "reproduce.h"

/* The class of the scene (a text, its name a path) by a trial and coarser bodies (price.h) [-]; BRC_BAD_INPUT where none is known. */
brc_status brc_told_class(brc_campaign *campaign, const brc_outcome *outcome, const char *name, const char *text, size_t bytes, double *error_class);
/* After the run: told (the class), actual (the largest error of the measures with a target) and right: 1 where actual is at most the upper edge of the class,
 * 10^(1/4) of it, and not below a tenth of it unless the class is the finest; else 0. */
void brc_told_values(double error_class, brc_outcome *outcome);

#endif
