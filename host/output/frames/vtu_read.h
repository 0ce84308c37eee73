/* Reading back the VTU files that vtu.h writes. */
#ifndef BRC_OUTPUT_VTU_READ_H
#define BRC_OUTPUT_VTU_READ_H

#include "../../base/status.h"
#include <stdint.h>

typedef struct brc_vtu_read {
    brc_context *context; /* borrowed */
    char *path, *bytes;   /* owned */
    size_t n_bytes, data; /* data: where the appended arrays begin */
} brc_vtu_read;

/* BRC_BAD_INPUT: not a file of brc_vtu_write. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_vtu_read_open(brc_context *context, const char *path, brc_vtu_read *out);
void brc_vtu_read_close(brc_vtu_read *vtu);
/* The numbers of an array, each of `width` bytes as written, aligned as bytes only; inside the file's own bytes until
 * close. BRC_BAD_INPUT: missing or cut off. */
brc_status brc_vtu_read_array(const brc_vtu_read *vtu, const char *name, int width, int64_t *n, const char **out);

#endif
