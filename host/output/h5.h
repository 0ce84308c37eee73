/* Writing HDF5 so that a crash or a full disk loses nothing older: a file written aside, or an image in memory that is
 * written whole. Failures are kept and reported once, at the end, with the operating system's reason. Equal content
 * gives equal bytes (no times are stored). On a rank that does not write (file.h) every call does nothing. */
#ifndef BRC_OUTPUT_H5_H
#define BRC_OUTPUT_H5_H

#include "../base/status.h"
#include "h5_disk.h"
#include <hdf5.h>
#include <stdint.h>

typedef struct brc_h5 {
    brc_context *context; /* borrowed */
    char *path, *aside;   /* owned; aside NULL: an image in memory */
    hid_t file;           /* invalid on a rank that does not write */
    bool silent;          /* such a rank */
    brc_h5_disk *disk;    /* owned; NULL: in memory */
    brc_status status;    /* BRC_OK, or the first failure: later calls do nothing */
    H5E_auto2_t print;    /* HDF5's own printing of errors, off while this is open */
    void *print_data;
} brc_h5;

/* Large files: written aside on the disk, block by block. */
brc_status brc_h5_create(brc_context *context, const char *path, brc_h5 *out);
/* Small files: made in memory, so that a full disk cannot leave HDF5 with a half-written file. */
brc_status brc_h5_create_in_memory(brc_context *context, const char *path, brc_h5 *out);
/* Close; after a failure remove what was written and report it, else fsync and rename to the path. */
brc_status brc_h5_commit(brc_h5 *h5);
/* Close and seal (seal.h); the same otherwise. */
brc_status brc_h5_commit_sealed(brc_h5 *h5);
/* Close and remove without a word. */
void brc_h5_discard(brc_h5 *h5);

/* After each block of `what`: a refusal of the library or the disk shows at once, not at the end of a large file. */
void brc_h5_check(brc_h5 *h5, bool ok, const char *what);
/* Group by its full path; parents exist already. */
void brc_h5_group(brc_h5 *h5, const char *name);
/* Dataset of `rows` x `columns` (columns 0: one dimension), contiguous. data: [rows][columns] of `type`; NULL: to be
 * filled by brc_h5_rows. */
void brc_h5_dataset(brc_h5 *h5, const char *name, hid_t type, int64_t rows, int64_t columns, const void *data);
/* The same, packed (shuffled and deflated) in blocks of BRC_H5_BLOCK rows: to be filled by brc_h5_pack_rows
 * (h5_pack.h), or by brc_h5_rows in order. */
void brc_h5_packed(brc_h5 *h5, const char *name, hid_t type, int64_t rows, int64_t columns);
#define BRC_H5_BLOCK ((int64_t)1 << 14)
/* Fill rows first .. first + n - 1 of a dataset. type: of data in memory, converted where the file's differs. */
void brc_h5_rows(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data);
/* One fixed-length string as a dataset of no dimension (UTF-8). */
void brc_h5_text(brc_h5 *h5, const char *name, const char *text);
/* Attributes of a group or dataset. Strings are of fixed length, ASCII (what VTK's reader asks for). */
void brc_h5_attribute_text(brc_h5 *h5, const char *object, const char *name, const char *text);
/* Unit and one line of meaning of a dataset that meaning.h does not know by its path; the others get theirs when
 * made. */
void brc_h5_describe(brc_h5 *h5, const char *object, const char *unit, const char *meaning);
void brc_h5_attribute_integers(brc_h5 *h5, const char *object, const char *name, int64_t n, const int64_t *values);
void brc_h5_attribute_number(brc_h5 *h5, const char *object, const char *name, double value);
/* Another name for an object of this file. */
void brc_h5_link(brc_h5 *h5, const char *name, const char *object);
/* name -> another file's object. */
void brc_h5_external_link(brc_h5 *h5, const char *name, const char *file, const char *object);

#endif
