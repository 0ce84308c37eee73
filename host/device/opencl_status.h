/* OpenCL's codes in words, and failures that carry them. */
#ifndef BRC_OPENCL_STATUS_H
#define BRC_OPENCL_STATUS_H

#include "device_internal.h"
#include <CL/cl.h>

/* "CL_OUT_OF_RESOURCES", ...; "unknown code" for others. */
const char *brc_opencl_status_text(cl_int code);
/* BRC_OK for CL_SUCCESS, else BRC_DEVICE_FAILED: "device ...: <what>: CL_... (-5)". */
brc_status brc_opencl_check(brc_device *device, cl_int code, const char *what);

#endif
