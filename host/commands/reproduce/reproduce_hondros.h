/* A pressed disc of spheres against Hondros' stresses (NAH19 section 4.3, Fig. 15). */
#ifndef BRC_COMMANDS_REPRODUCE_HONDROS_H
#define BRC_COMMANDS_REPRODUCE_HONDROS_H

#include "reproduce.h"

/* The hondros operator, at the end of a run: across_KK and along_KK (stress over 2 P / (pi t D)) in 25 stretches of the loaded diameter, centre_across and centre_along
 * (|r| <= R/5; references: Hondros), rms_across and worst_across (rms and largest difference to Hondros) of the stretches within 0.7 R. BRC_BAD_INPUT: not one cylinder under two loads across its axis. */
brc_status brc_hondros_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);
/* hondros.png and its numbers, hondros.dat, into the campaign's folder, where such runs were made. */
brc_status brc_hondros_figure(brc_campaign *campaign);

#endif
