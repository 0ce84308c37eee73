/* A file driver for HDF5 that outlives a full disk. HDF5 keeps a file for ever whose last writes were refused, and
 * crashes at the end of the program; this driver remembers the first refusal, takes every later write without writing,
 * and so lets HDF5 close. Whoever closes the file then asks whether all of it reached the disk. */
#ifndef BRC_OUTPUT_H5_DISK_H
#define BRC_OUTPUT_H5_DISK_H

#include <hdf5.h>

typedef struct brc_h5_disk {
    int error;    /* errno of the first refused call; 0: all went well */
    hid_t driver; /* its registration, ended by brc_h5_disk_end */
} brc_h5_disk;

/* File access list for a file to be created and written; the disk must stay where it is until the file is closed. The
 * caller closes the list. Negative on failure. */
hid_t brc_h5_disk_begin(brc_h5_disk *disk);
void brc_h5_disk_end(brc_h5_disk *disk);

#endif
