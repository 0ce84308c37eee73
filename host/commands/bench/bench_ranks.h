/* `breccia bench ranks`: what several ranks cost, told as a table. */
#ifndef BRC_COMMANDS_BENCH_RANKS_H
#define BRC_COMMANDS_BENCH_RANKS_H

#include "../command.h"

/* All ranks; rank 0 prints, and writes rows.json and rows.csv. */
brc_status brc_bench_ranks(const brc_session *session, const brc_arguments *arguments);

#endif
