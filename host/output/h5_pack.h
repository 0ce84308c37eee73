/* Packing rows of a dataset on the way into a file. HDF5 would do it with one thread and the slow search of deflate;
 * here blocks are packed side by side, and deflate looks for runs of equal bytes only, which is what neighbouring
 * numbers give once bytes of equal place stand together. Blocks that would hardly shrink are left as they are. Any HDF5
 * reads them. */
#ifndef BRC_OUTPUT_H5_PACK_H
#define BRC_OUTPUT_H5_PACK_H

#include "h5.h"

/* Fill rows first .. first + n - 1 of a dataset of brc_h5_packed, of the type it has in the file. Blocks that are
 * wholly among them, or end with the dataset, are packed by n_threads (0: as OpenMP decides); where there are others
 * HDF5 packs all. The bytes do not depend on the number of threads. */
void brc_h5_pack_rows(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data,
                      int n_threads);
/* The same for rows of which many occur again: bytes of a block stay as they stand where that packs smaller. */
void brc_h5_pack_rows_either(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data,
                             int n_threads);

#endif
