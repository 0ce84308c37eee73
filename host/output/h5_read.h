/* Reading HDF5 files of results, block by block. */
#ifndef BRC_OUTPUT_H5_READ_H
#define BRC_OUTPUT_H5_READ_H

#include "../base/status.h"
#include <hdf5.h>
#include <stdint.h>

typedef struct brc_h5_read {
    brc_context *context; /* borrowed */
    const char *path;     /* borrowed */
    hid_t file;
    H5E_auto2_t print; /* HDF5's own printing of errors, off while this is open */
    void *print_data;
} brc_h5_read;

/* BRC_BAD_INPUT: not there, or not HDF5. path is borrowed until close. */
brc_status brc_h5_read_open(brc_context *context, const char *path, brc_h5_read *out);
void brc_h5_read_close(brc_h5_read *h5);
/* Does the dataset exist? */
bool brc_h5_read_has(const brc_h5_read *h5, const char *name);
/* Its size; columns 1 for one dimension. BRC_BAD_INPUT where it is missing or has more than two. */
brc_status brc_h5_read_size(const brc_h5_read *h5, const char *name, int64_t *rows, int64_t *columns);
/* A text of brc_h5_text (h5.h); *out is freed by brc_memory_free. BRC_BAD_INPUT where there is none. */
brc_status brc_h5_read_string(const brc_h5_read *h5, const char *name, char **out);
/* Rows first .. first + n - 1 as `type` into data. BRC_BAD_INPUT: damaged. */
brc_status brc_h5_read_rows(const brc_h5_read *h5, const char *name, hid_t type, int64_t first, int64_t n, void *data);

#endif
