/* OpenCL programs: the pasted text of the kernels compiled for one device, or taken from the cache
 * (program_cache.h). */
#ifndef BRC_OPENCL_BUILD_H
#define BRC_OPENCL_BUILD_H

#include "device_internal.h"
#include "program_source.h"
#include <CL/cl.h>

/* device: precision, materials, exactness, lanes and slice are those of the program; group: work-items a group at most.
 * folder: of kernel texts, NULL for the embedded ones; part: kernels it is to have, NULL: all. BRC_DEVICE_FAILED with
 * device, options and the whole compiler log. *out is released by the caller. */
typedef struct brc_opencl_request {
    cl_context context;
    cl_device_id id;
    size_t group;
    const char *folder;
    const brc_program_part *part;
} brc_opencl_request;
brc_status brc_opencl_build(brc_device *device, const brc_opencl_request *request, cl_program *out);

#endif
