/* `breccia bench peers`: breccia beside the other programs of its kind, told as a table. */
#ifndef BRC_COMMANDS_BENCH_PEERS_H
#define BRC_COMMANDS_BENCH_PEERS_H

#include "../../base/status.h"
#include <stdint.h>

/* rows.json and rows.csv go into the folder `output`, beside what the peers were given (bench/peers.h). */
brc_status brc_bench_peers(brc_context *context, const char *output, int64_t elements, int64_t steps, int n_threads);

#endif
