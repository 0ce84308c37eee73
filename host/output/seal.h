/* A seal at the end of a file: its length and CRC-32 (zlib's), so that a file that was cut short or changed is told
 * from a whole one. HDF5 reads a sealed file as it is: it does not look behind its own end. */
#ifndef BRC_OUTPUT_SEAL_H
#define BRC_OUTPUT_SEAL_H

#include "../base/status.h"
#include <stdint.h>

/* Append the seal. BRC_FILE_FAILED. */
brc_status brc_seal_add(brc_context *context, const char *path);
/* Is the file whole? If not, why: "it has no seal: it was cut short", "its checksum is 1a2b3c4d, its seal says
 * 5e6f7a8b". BRC_BAD_INPUT: it cannot be read. */
brc_status brc_seal_check(brc_context *context, const char *path, bool *whole, char *why, size_t room);
/* CRC-32 of `bytes` bytes, after those that gave `sum` (0: none). */
uint32_t brc_seal_sum(uint32_t sum, const void *data, int64_t bytes);
/* The same from the sum, beginning with 0, of these bytes. */
uint32_t brc_seal_join(uint32_t sum, uint32_t next, int64_t bytes);

#endif
