/* Memory that the ranks (ranks.h) of one machine share: what its first rank has written, the others see; what one of
 * them writes later is its own (pages are copied then). Linux: a file without a name in memory, or on a disk (spill.h).
 */
#ifndef BRC_BASE_MACHINE_MEMORY_H
#define BRC_BASE_MACHINE_MEMORY_H

#include "status.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct brc_machine_memory {
    char *data; /* [bytes]; NULL: none */
    int64_t bytes;
} brc_machine_memory;

/* All ranks, after the first rank of each machine (brc_ranks_place.local 0) has made `file` (brc_machine_file): the
 * bytes of that file are in *out, on all ranks of the machine, until brc_machine_memory_free. file: of the first rank;
 * closed here. BRC_INTERNAL, on all ranks: some rank may not open it, as across containers; only the first of each
 * machine then has them, out->data of the others is NULL. */
brc_status brc_machine_memory_map(brc_context *context, int file, brc_machine_memory *out);
void brc_machine_memory_free(brc_machine_memory *memory);

/* The same in place of the memory at `at`, whose pages the caller got from mmap and gives back with it. On failure they
 * are as they were. */
brc_status brc_machine_memory_lay(brc_context *context, int file, void *at);

/* A file for it, empty; closed by brc_machine_memory_map. BRC_NO_MEMORY. */
brc_status brc_machine_file(brc_context *context, int *file);
/* Append bytes. BRC_NO_MEMORY. */
brc_status brc_machine_file_write(brc_context *context, int file, const void *data, int64_t bytes);
/* Append bytes that take no memory until they are written. BRC_NO_MEMORY. */
brc_status brc_machine_file_skip(brc_context *context, int file, int64_t bytes);
/* Put bytes over its first ones. BRC_NO_MEMORY. */
brc_status brc_machine_file_place(brc_context *context, int file, const void *data, int64_t bytes);

/* Memory that all ranks of a machine see and write, each its part of the work: `part` of `parts`. Where there is one
 * rank, or ranks cannot see one another's memory, each has memory of its own and does all of it. */
typedef struct brc_common_memory {
    void *data; /* [bytes] */
    int64_t bytes;
    int file; /* -1: of its own */
    int32_t part, parts;
} brc_common_memory;

/* All ranks, with the same bytes, which are 0. What others have written is there after a call of all ranks
 * (brc_ranks_agree). BRC_NO_MEMORY. */
brc_status brc_common_memory_begin(brc_context *context, int64_t bytes, brc_common_memory *out);
/* After all have written: the pages lie at `at` too, as brc_machine_memory_lay. False: they cannot; copy them. */
bool brc_common_memory_lay(const brc_common_memory *memory, void *at);
/* What was laid stays. Accepts what is all 0. */
void brc_common_memory_free(brc_common_memory *memory);

#endif
