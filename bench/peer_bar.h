/* The bar of `breccia bench peers`: samples of its motion, and what they say. */
#ifndef BRC_BENCH_PEER_BAR_H
#define BRC_BENCH_PEER_BAR_H

#include "../host/solver/simulation.h"
#include "peer.h"

/* Advance by `steps`, with a sample after every `every` steps and one before. Momentum: sum of m v_x cos(pi x / 1 m).
 * `density` is of the spheres [kg/m^3]. */
brc_status brc_peer_bar_follow(brc_context *context, brc_simulation *simulation, double density, int64_t steps,
                               int64_t every, brc_peer_result *out);
/* Half the inverse of the mean time between two changes of the momentum's sign [Hz]; NAN: fewer than two. */
double brc_peer_bar_frequency(const brc_peer_result *result, double time_step);
/* Largest difference of the kinetic energies at common steps, over the first one of `ours` [-]; NAN: no common step. */
double brc_peer_bar_difference(const brc_peer_result *ours, const brc_peer_result *theirs);

#endif
