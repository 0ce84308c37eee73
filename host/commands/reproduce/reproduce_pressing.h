/* The bulk modulus along a dynamic test (NAH19 section 4.2, Fig. 11). */
#ifndef BRC_COMMANDS_REPRODUCE_PRESSING_H
#define BRC_COMMANDS_REPRODUCE_PRESSING_H

#include "reproduce.h"

/* The pressing operator: created and finished around a run, an observer in between. */
typedef struct brc_pressing brc_pressing;
brc_status brc_pressing_create(brc_context *context, brc_pressing **out);
void brc_pressing_free(brc_pressing **pressing);
/* At every sample the load over the strain of the scene's first measure of kind K. BRC_BAD_INPUT: it has none. */
brc_observer brc_pressing_observer(brc_pressing *pressing);
/* K_mean, over the last half of them (reference: E / (3 (1 - 2 nu)) of the scene's only material), and settled, the time after which they stay within 2 % of it [s]; and
 * <run>.png with its numbers, <run>.dat, in the campaign's folder. */
brc_status brc_pressing_values(const brc_campaign *campaign, const brc_pressing *pressing, brc_outcome *outcome);

#endif
