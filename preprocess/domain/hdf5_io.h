/* The few HDF5 calls a file of plain arrays needs, with our sentences: numbers are stored little-endian, as they lie in
 * memory, and every array carries a checksum of them. */
#ifndef BRC_PREPROCESS_HDF5_IO_H
#define BRC_PREPROCESS_HDF5_IO_H

#include "../../host/base/file_pages.h"
#include "../../host/base/status.h"
#include <hdf5.h>
#include <stdint.h>

/* How an array lies in memory. Older files have 64 bits for integers of 32, and attributes always do. */
typedef enum brc_h5_kind { BRC_H5_DOUBLE, BRC_H5_INT64, BRC_H5_INT32 } brc_h5_kind;

/* Silence HDF5's own printing until the matching brc_h5_loud; *keep receives what to restore. */
typedef struct brc_h5_voice {
    H5E_auto2_t function;
    void *data;
} brc_h5_voice;
void brc_h5_quiet(brc_h5_voice *keep);
void brc_h5_loud(const brc_h5_voice *keep);

/* Record a failed HDF5 call on `path` with the innermost reason HDF5 gives; returns `code`. */
brc_status brc_h5_fail(brc_context *context, brc_status code, const char *path, const char *what);

/* Create a file or a group without time stamps, so that equal contents give equal bytes. Long arrays begin at whole
 * pages (BRC_LEAST_FILE_RANGE, BRC_FILE_PAGE). Below 0: failed. */
hid_t brc_h5_create_file(const char *path);
hid_t brc_h5_create_group(hid_t file, const char *name);
/* Close a file whose writing failed. On a full disk H5Fclose would fail too and HDF5 1.10 would then crash when the
 * program ends; so what it still wants to write goes nowhere. The file's contents are lost: discard it. */
void brc_h5_close_broken(hid_t file);

/* Write [rows][width] items (width 1: one dimension). */
brc_status brc_h5_write_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                              int64_t rows, int64_t width, const void *data);
/* Allocate *data (brc_memory_free) and read exactly [rows][width] items into it; BRC_BAD_INPUT with path and name when
 * the array is missing, of another type or shape, larger than the file, or its checksum is wrong. rows < 0: as many as
 * there are. *found (may be NULL) receives the rows. */
brc_status brc_h5_read_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                             int64_t rows, int64_t width, void **data, int64_t *found);
/* Pages of an open file, for arrays that lie there as they do in memory; begun by brc_file_pages_begin. */
typedef struct brc_h5_pages {
    int file;
    brc_machine_memory *memory;
    brc_file_pages *pages;
} brc_h5_pages;
/* The descriptor of a file that was opened with brc_h5_create_file or for reading; below 0: it has none. */
int brc_h5_descriptor(hid_t file);
/* The same, where it can be without reading: *data is then in `pages` and stays there. NULL: as brc_h5_read_array. */
brc_status brc_h5_map_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                            int64_t rows, int64_t width, const brc_h5_pages *pages, void **data);

/* Text attributes have a fixed length and are ASCII; numbers are int64 or double. `what` is the attribute's name. */
brc_status brc_h5_write_text(brc_context *context, hid_t place, const char *path, const char *what, const char *text);
/* *out is freed by brc_memory_free. */
brc_status brc_h5_read_text(brc_context *context, hid_t place, const char *path, const char *what, char **out);
brc_status brc_h5_write_numbers(brc_context *context, hid_t place, const char *path, const char *what, brc_h5_kind kind,
                                int64_t n, const void *data);
brc_status brc_h5_read_numbers(brc_context *context, hid_t place, const char *path, const char *what, brc_h5_kind kind,
                               int64_t n, void *data);

#endif
