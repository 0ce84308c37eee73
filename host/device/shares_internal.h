/* Shares of ranks inside of a device. */
#ifndef BRC_DEVICE_SHARES_INTERNAL_H
#define BRC_DEVICE_SHARES_INTERNAL_H

#include "device_internal.h"
#include "shares.h"

/* Launch what of the items this rank does, with what it reads there. */
brc_status brc_share_launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args);
/* The whole array is on every rank. */
brc_status brc_share_gather(brc_buffer *buffer);
void brc_shares_free(brc_device *device);

#endif
