/* Sizes of the pieces a body broke into, over runs at several speeds: exponent, distribution, and what became of the body against speed. */
#ifndef BRC_COMMANDS_REPRODUCE_FRAGMENTS_H
#define BRC_COMMANDS_REPRODUCE_FRAGMENTS_H

#include "reproduce.h"

/* The fragments operator, at the end of a run: damage (share of the bonds that broke), mass_exponent (tau where the number of fragments of a mass m falls as m^-tau, most likely one between 2.5 mean
 * cells and a twentieth of the whole), exponent_error (standard error of that), pieces (fragments in that range), and heavier_KK, how many fragments have at least 10^(-KK/6) of the whole. */
brc_status brc_fragments_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);
/* fragments.png and its numbers, fragments.dat, into the campaign's folder, where such runs were made: damage and largest fragment against the label `speed`, and the distributions. */
brc_status brc_fragments_figure(brc_campaign *campaign);

/* Most likely tau of masses [n] drawn from m^-tau between low and high; those outside do not count. *n_inside: how many do; *error: its standard error. NAN for fewer than two or for equal ones. */
double brc_fragments_exponent(int64_t n, const double *mass, double low, double high, int64_t *n_inside, double *error);

#endif
