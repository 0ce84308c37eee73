/* The mean load of the two sides that a sample is held by, as NAH19 takes it for discs and rods (sections 4.3 and 4.4). */
#ifndef BRC_COMMANDS_REPRODUCE_SIDES_H
#define BRC_COMMANDS_REPRODUCE_SIDES_H

#include "reproduce.h"

/* The sides operator: created and finished around a run, an observer in between. */
typedef struct brc_sides brc_sides;
brc_status brc_sides_create(brc_context *context, brc_sides **out);
void brc_sides_free(brc_sides **sides);
/* At every sample of the last stage the mean of the sensors of the scene's first two measures of kind peak, each times its scale. BRC_BAD_INPUT: it has not two, or they
 * divide by an area, or look at another stage or a window. */
brc_observer brc_sides_observer(brc_sides *sides);
/* both_sides: the largest of these means, in the unit that the scales give; waves that run to and fro between the sides after breaks raise one while they lower the other. */
void brc_sides_values(const brc_sides *sides, brc_outcome *outcome);

#endif
