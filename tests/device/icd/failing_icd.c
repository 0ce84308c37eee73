/* An OpenCL driver that fails as BRC_FAILING_ICD says, as soon as the loader asks it for its functions: abort, hang,
 * exit end or stop the program; empty: a platform without devices; platformless: a driver without a platform. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl_icd.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SHOWN __attribute__((visibility("default")))
SHOWN void *clGetExtensionFunctionAddress(const char *name);

static cl_int CL_API_CALL platform_info(cl_platform_id platform, cl_platform_info what, size_t bytes, void *value,
                                        size_t *bytes_of_value)
{
    const char *const text = what == CL_PLATFORM_EXTENSIONS ? "cl_khr_icd" : "EMPTY";
    const size_t length = strlen(text) + 1;
    (void)platform;
    if (value && bytes < length) return CL_INVALID_VALUE;
    if (value) memcpy(value, text, length);
    if (bytes_of_value) *bytes_of_value = length;
    return CL_SUCCESS;
}

static cl_int CL_API_CALL no_devices(cl_platform_id platform, cl_device_type type, cl_uint room, cl_device_id *devices,
                                     cl_uint *n)
{
    (void)platform, (void)type, (void)room, (void)devices;
    if (n) *n = 0;
    return CL_DEVICE_NOT_FOUND;
}

struct _cl_platform_id {
    const cl_icd_dispatch *functions;
};

static cl_int CL_API_CALL platforms(cl_uint room, cl_platform_id *found, cl_uint *n)
{
    static const cl_icd_dispatch functions = {.clGetPlatformInfo = platform_info, .clGetDeviceIDs = no_devices};
    static struct _cl_platform_id platform = {&functions};
    if (strcmp(getenv("BRC_FAILING_ICD"), "empty") != 0) return CL_PLATFORM_NOT_FOUND_KHR;
    if (found && room > 0) *found = &platform;
    if (n) *n = 1;
    return CL_SUCCESS;
}

void *clGetExtensionFunctionAddress(const char *name)
{
    const char *const how = getenv("BRC_FAILING_ICD");
    if (!how) return NULL;
    if (strcmp(how, "abort") == 0) abort();
    if (strcmp(how, "exit") == 0) exit(3);
    while (strcmp(how, "hang") == 0)
        sleep(1);
    if (strcmp(name, "clIcdGetPlatformIDsKHR") == 0) return (void *)platforms;
    return strcmp(name, "clGetPlatformInfo") == 0 ? (void *)platform_info : NULL;
}
