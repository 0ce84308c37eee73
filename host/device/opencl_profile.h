/* Seconds of each kernel on an OpenCL device, by the driver's own events: for tuning, asked for by
 * BRECCIA_OPENCL_PROFILE=FILE. Every launch then has an event, and the queue is drained at times, so a profiled run is
 * a little slower. */
#ifndef BRC_OPENCL_PROFILE_H
#define BRC_OPENCL_PROFILE_H

#include "device_internal.h"
#include <CL/cl.h>

typedef struct brc_opencl_profile brc_opencl_profile;

/* *out is NULL where no profile is asked for. */
brc_status brc_opencl_profile_create(brc_context *context, brc_opencl_profile **out);
/* Where the next launch leaves its event; NULL without a profile. */
cl_event *brc_opencl_profile_event(brc_opencl_profile *profile);
/* That launch was made: of which kernel, over how many work-items. */
void brc_opencl_profile_add(brc_opencl_profile *profile, const char *kernel, int64_t n_items);
/* Appends rows (kernel, precision, launches, work-items, seconds) to the file, most seconds first, and frees. What
 * cannot be written is a warning. The queue must be done. Takes NULL. */
void brc_opencl_profile_close(brc_opencl_profile **profile, brc_device *device);

#endif
