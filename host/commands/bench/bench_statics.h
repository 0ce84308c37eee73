/* `breccia bench statics`: what equilibrium takes as bodies grow, told as a table (bench/statics_cost.h), with finite
 * elements beside it where they are installed (bench/statics_peer.h). */
#ifndef BRC_COMMANDS_BENCH_STATICS_H
#define BRC_COMMANDS_BENCH_STATICS_H

#include "../command.h"

brc_status brc_bench_statics(const brc_session *session, const brc_arguments *arguments);

#endif
