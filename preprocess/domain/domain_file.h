/* The domain file (HDF5, "domain.h5"): elements, half-edges with twin, free faces, sets, quality, provenance. */
#ifndef BRC_PREPROCESS_DOMAIN_FILE_H
#define BRC_PREPROCESS_DOMAIN_FILE_H

#include "domain.h"

/* 1: cells only. 2: the kind of elements, spheres, grains, more of the quality. 3: arrays lie as in memory. 4: volumes
 * of spheres are those that they stand for. All are read, 4 is written. */
#define BRC_DOMAIN_FORMAT_VERSION 4

/* Written aside, fsynced, renamed. BRC_FILE_FAILED with path and reason (a full disk included). Equal domains give
 * equal bytes. */
brc_status brc_domain_write(brc_context *context, const brc_domain *domain, const char *path);
/* Read and check (brc_domain_check). Long arrays of versions 3 and 4 are pages of the file (domain.h), which must not
 * be written over while the domain is there; another file may take its name. Not HDF5, a later version, truncated,
 * missing or misshaped arrays: BRC_BAD_INPUT with path, what was found and what is expected. */
brc_status brc_domain_read(brc_context *context, const char *path, brc_domain **out);

#endif
