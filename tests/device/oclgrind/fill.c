/* oclgrind 21.10 takes what clEnqueueFillBuffer put into a buffer for values that nobody set (--uninitialized). Loaded
 * before its library, this writes them instead (test_oclgrind.py). */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdlib.h>
#include <string.h>

__attribute__((visibility("default"))) cl_int clEnqueueFillBuffer(cl_command_queue queue, cl_mem buffer,
                                                                  const void *pattern, size_t pattern_bytes,
                                                                  size_t offset, size_t bytes, cl_uint n_waited,
                                                                  const cl_event *waited, cl_event *event)
{
    char *const data = malloc(bytes);
    if (!data) return CL_OUT_OF_HOST_MEMORY;
    for (size_t at = 0; at < bytes; at += pattern_bytes)
        memcpy(data + at, pattern, pattern_bytes);
    const cl_int code = clEnqueueWriteBuffer(queue, buffer, CL_TRUE, offset, bytes, data, n_waited, waited, event);
    free(data);
    return code;
}
