/* Ranges of a file as memory: pages come when they are read, all processes that have them share them, and the kernel
 * may drop them again. What a process writes there is its own (pages are copied then), never the file's. */
#ifndef BRC_BASE_FILE_PAGES_H
#define BRC_BASE_FILE_PAGES_H

#include "machine_memory.h"
#include "status.h"
#include <stdint.h>

typedef struct brc_file_range {
    int64_t place, offset, bytes; /* place in the memory, offset in the file: at whole pages */
} brc_file_range;

/* Which ranges of a file lie in a memory. All 0: none. */
typedef struct brc_file_pages {
    char *path; /* of the file, from the root; a block */
    int64_t device, inode, n;
    brc_file_range *range; /* [n] a block */
} brc_file_pages;

/* What lies behind ranges that are shorter is read: a page and a call each would cost more. */
enum { BRC_LEAST_FILE_RANGE = 1 << 16, BRC_FILE_PAGE = 4096 };

/* Room for `most` ranges of an open file; nothing lies there yet. *memory: freed by brc_machine_memory_free; path and
 * range of *pages: blocks. BRC_NO_MEMORY, BRC_FILE_FAILED; both are then empty. */
brc_status brc_file_pages_begin(brc_context *context, int file, const char *path, int64_t most,
                                brc_machine_memory *memory, brc_file_pages *pages);
/* `bytes` of the file from `offset`, as a block (memory.h) that is not freed with brc_memory_free. NULL: they are few,
 * not at whole pages of this machine, or not in the file; then read them. */
void *brc_file_pages_add(int file, int64_t offset, int64_t bytes, const brc_machine_memory *memory,
                         brc_file_pages *pages);
/* Lay the ranges into another memory, at their places. False: the file is not there any more, or another one. */
bool brc_file_pages_lay(const brc_file_pages *pages, const brc_machine_memory *memory);
/* The range that begins at `block`; -1: none does. */
int64_t brc_file_pages_find(const brc_file_pages *pages, const brc_machine_memory *memory, const void *block);
/* Pages that were read but not written leave the process; they come again when they are read. Only before anything is
 * written. */
void brc_file_pages_forget(const brc_file_pages *pages, const brc_machine_memory *memory);

#endif
