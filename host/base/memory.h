/* Host memory: zeroed, 64-byte aligned (one cache line, one AVX-512 register), counted. Pages of large blocks that
 * nobody writes take no memory. */
#ifndef BRC_BASE_MEMORY_H
#define BRC_BASE_MEMORY_H

#include "status.h"
#include <stdbool.h>
#include <stdint.h>

/* Allocate `count` zeroed items of `size` bytes into *out (64-byte aligned). Overflow and exhaustion give
 * BRC_NO_MEMORY with `what` and the size in the sentence; *out is then NULL. count 0 gives a valid 64-byte block. */
brc_status brc_memory_allocate(brc_context *context, void **out, int64_t count, size_t size, const char *what);
/* Typed form: BRC_ALLOCATE(context, &domain->volume, n, "element volumes"). */
#define BRC_ALLOCATE(context, pointer, count, what)                                                                    \
    brc_memory_allocate((context), (void **)(pointer), (int64_t)(count), sizeof(**(pointer)), (what))
/* The same in pages of its own, which take no memory until they are written and are not counted: for blocks of which
 * little is written. Never spilled (spill.h). */
brc_status brc_memory_allocate_sparse(brc_context *context, void **out, int64_t count, size_t size, const char *what);
/* What is written to such a block lies in a file from here on (spill.h). False: there is no folder, or no room there.
 */
bool brc_memory_spill_sparse(void *block);
/* Bytes of its pages that are in memory now. */
int64_t brc_memory_sparse_resident(const void *block);
/* Grow or shrink a block got from brc_memory_allocate, keeping its first bytes; new bytes are zero. */
brc_status brc_memory_resize(brc_context *context, void **block, int64_t count, size_t size, const char *what);
/* Free a block got from brc_memory_allocate; accepts NULL. */
void brc_memory_free(void *block);
/* After many small blocks were freed: what they held goes back to the system. */
void brc_memory_trim(void);
/* The next `bytes` of a large block, at `at`, are not read any more: whole pages of them go back to the system. The
 * block is still to be freed. */
void brc_memory_forget(void *at, int64_t bytes);
/* A variable that is freed where its scope ends, by a function that takes its address: BRC_ENDS_WITH(brc_buffer_free)
 * brc_buffer *x = NULL; and a block: BRC_FREED double *x = NULL. */
#define BRC_ENDS_WITH(free) __attribute__((cleanup(free)))
void brc_memory_end_scope(void *variable);
#define BRC_FREED BRC_ENDS_WITH(brc_memory_end_scope)
/* The same with a block: BRC_LOCAL(context, n, double, x, "masses") declares x, or returns why there is none. */
#define BRC_LOCAL(context, count, type, name, what)                                                                    \
    BRC_FREED type *name = NULL;                                                                                       \
    BRC_TRY(BRC_ALLOCATE((context), &name, (count), (what)))
/* Bytes of a block, at least those asked for. */
int64_t brc_memory_block_bytes(const void *block);
enum { BRC_MEMORY_HEAD = 64 };
/* What lies in front of a block: its size, here of one in memory that was got otherwise, which brc_memory_free and
 * brc_memory_resize leave as it is. bytes: a multiple of BRC_MEMORY_HEAD. */
void brc_memory_head(char head[BRC_MEMORY_HEAD], int64_t bytes);
/* Bytes now held and the most ever held through this interface in the process [byte]. */
int64_t brc_memory_held(void);
int64_t brc_memory_peak(void);
/* The most held since the last mark of the process (without one: since its start) [byte]: of a part of a run. */
void brc_memory_mark(void);
int64_t brc_memory_peak_since_mark(void);
/* Most memory of the process that was resident so far, libraries and all [byte]; 0: not known. */
int64_t brc_memory_resident(void);

#endif
