/* OpenCL devices in one flat order: platform by platform, as the loader gives them. */
#ifndef BRC_OPENCL_LIST_H
#define BRC_OPENCL_LIST_H

#include "device_internal.h"
#include <CL/cl.h>

enum { BRC_OPENCL_MOST_DEVICES = 64 };

/* All devices; returns how many (0 when there is no platform). */
int brc_opencl_devices(cl_device_id devices[BRC_OPENCL_MOST_DEVICES]);
/* The same described, in this process, then a row for each platform that lists no device; at most `most`. */
int brc_opencl_describe_all(brc_device_info *rows, int most);
/* Whether some driver is in this process already: then it has shown that it can be, and a fork may not use it, since
 * what the driver has started is not there. */
bool brc_opencl_driver_is_loaded(void);
/* brc_device_opencl_list with a limit on the drivers' time. */
brc_status brc_opencl_list_within(brc_context *context, brc_device_list *list, double seconds);

#endif
