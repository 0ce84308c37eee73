/* Sizes of the pieces a body broke into, over runs at several speeds: exponent, distribution, and what became of the
 * body against speed. */
#ifndef BRC_COMMANDS_REPRODUCE_FRAGMENTS_H
#define BRC_COMMANDS_REPRODUCE_FRAGMENTS_H

#include "reproduce.h"

/* Most likely tau of masses [n] drawn from m^-tau between low and high; those outside do not count. *n_inside: how many
 * do; *error: its standard error. NAN for fewer than two or for equal ones. */
double brc_fragments_exponent(int64_t n, const double *mass, double low, double high, int64_t *n_inside, double *error);

#endif
