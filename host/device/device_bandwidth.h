/* What the memory of a device gives: the measure that speeds are held against. */
#ifndef BRC_DEVICE_BANDWIDTH_H
#define BRC_DEVICE_BANDWIDTH_H

#include "device.h"

/* Copy an array of about `bytes` bytes on the device with the kernel vector_copy and all its threads; *bytes_per_s is
 * the best of several runs by `clock` [s], bytes read plus bytes written [byte/s]. Take an array much larger than the
 * caches. Holds two such arrays meanwhile; BRC_DEVICE_FAILED when they do not fit. */
brc_status brc_device_copy_bandwidth(brc_device *device, int64_t bytes, double (*clock)(void), double *bytes_per_s);

#endif
