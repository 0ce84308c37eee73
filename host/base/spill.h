/* Memory in place of which a file on a disk stands: long blocks of memory.h, where the environment names a folder for
 * them, BRECCIA_SPILL. Pages that are not in use go to the disk when memory is short; the file has no name, and is gone
 * with the process. A child begins one of its own; what it has from its parent it may write, as ever, but not read any
 * more once the parent has freed it. */
#ifndef BRC_BASE_SPILL_H
#define BRC_BASE_SPILL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { BRC_LEAST_SPILL = 1 << 16, BRC_SPILL_REASON = 200 }; /* bytes: of blocks, of a sentence */

/* In place of what the environment says, from here on until NULL; borrowed. For what one part of a program holds: what
 * it got stays there. */
void brc_spill_into(const char *folder);
/* NULL: memory is memory. */
const char *brc_spill_folder(void);
/* Zeroed memory of at least so many bytes, BRC_LEAST_SPILL or more, at whole pages. NULL: reason says why. From any
 * thread. */
char *brc_spill_take(size_t bytes, char reason[BRC_SPILL_REASON]);
/* bytes: as they were taken. Their room on the disk is free again. Of a parent's memory nothing happens. */
void brc_spill_give(char *memory, size_t bytes);
/* So many bytes at `at`, whole pages that came from mmap, lie in the file from here on, with what is in them, until
 * they are unmapped. False: they stay in memory, for there is no room. */
bool brc_spill_lay(char *at, size_t bytes);
/* Is it of this process's own file? */
bool brc_spill_has(const void *at);
/* Another file there, without a name; below 0: errno says why. */
int brc_spill_file(void);
/* Bytes that are free on the disk [byte]; 0 without a folder. */
double brc_spill_room(void);

#endif
