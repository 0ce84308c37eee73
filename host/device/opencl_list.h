/* OpenCL devices in one flat order: platform by platform, as the loader gives them. */
#ifndef BRC_OPENCL_LIST_H
#define BRC_OPENCL_LIST_H

#include "device_internal.h"
#include <CL/cl.h>

enum { BRC_OPENCL_MOST_DEVICES = 64 };

/* All devices; returns how many (0 when there is no platform). */
int brc_opencl_devices(cl_device_id devices[BRC_OPENCL_MOST_DEVICES]);

#endif
