/* Shares of ranks inside of a device. */
#ifndef BRC_DEVICE_SHARES_INTERNAL_H
#define BRC_DEVICE_SHARES_INTERNAL_H

#include "device_internal.h"
#include "shares.h"

/* Before a launch: what it reads is there; [*first, *end): its items on this rank. */
brc_status brc_share_before(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args, int64_t *first,
                            int64_t *end);
/* After it: what it wrote is where. */
void brc_share_after(const brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args);
/* The whole array is on every rank. */
brc_status brc_share_gather(brc_buffer *buffer);
void brc_shares_free(brc_device *device);

#endif
