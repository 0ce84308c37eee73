/* Options that the benches of `breccia bench` read alike; messages name the option. */
#ifndef BRC_COMMANDS_BENCH_OPTIONS_H
#define BRC_COMMANDS_BENCH_OPTIONS_H

#include "../command.h"

/* The list of an option, or `otherwise`, split within `copy` [size]; pieces [BRC_THROUGHPUT_LIST] point into it. */
brc_status brc_bench_take_list(brc_context *context, const brc_arguments *arguments, const char *name,
                               const char *otherwise, char *copy, size_t size, const char **pieces, int *n);
/* `text` as a number from low to high. */
brc_status brc_bench_take_number(brc_context *context, const char *name, const char *text, double low, double high,
                                 double *out);
/* Models by their names [n]. */
brc_status brc_bench_take_models(brc_context *context, int n, const char *const *names, brc_model_kind *out);
/* Options of other benches [n] are slips. */
brc_status brc_bench_refuse_options(brc_context *context, const brc_arguments *arguments, const char *kind, int n,
                                    const char *const *names);

#endif
