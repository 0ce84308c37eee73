/* `breccia bench rest`: what is gained where elements at rest are left out (bench/rest_cost.h), told as a table. */
#ifndef BRC_COMMANDS_BENCH_REST_H
#define BRC_COMMANDS_BENCH_REST_H

#include "../command.h"

brc_status brc_bench_rest(const brc_session *session, const brc_arguments *arguments);

#endif
