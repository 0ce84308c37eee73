/* OpenCL programs: the pasted text of the kernels compiled for one device, or taken from the cache
 * (program_cache.h). */
#ifndef BRC_OPENCL_BUILD_H
#define BRC_OPENCL_BUILD_H

#include "device_internal.h"
#include <CL/cl.h>

/* device: precision, materials, lanes and slice are those of the program; group: work-items a group at most. folder: of
 * kernel texts, NULL for the embedded ones; exact: as in brc_device_request. BRC_DEVICE_FAILED with device, options and
 * the whole compiler log. *out is released by the caller. */
brc_status brc_opencl_build(brc_device *device, cl_context context, cl_device_id id, size_t group, const char *folder,
                            bool exact, cl_program *out);

#endif
