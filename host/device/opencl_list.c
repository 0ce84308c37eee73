#include "opencl_list.h"
#include "opencl_aside.h"
#include "../base/log.h"
#include <dirent.h>
#include <dlfcn.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PLATFORMS = 16 };

static cl_uint find_platforms(cl_platform_id platforms[MOST_PLATFORMS])
{
    cl_uint n = 0;
    if (clGetPlatformIDs(MOST_PLATFORMS, platforms, &n) != CL_SUCCESS) return 0;
    return n < MOST_PLATFORMS ? n : MOST_PLATFORMS;
}

int brc_opencl_devices(cl_device_id devices[BRC_OPENCL_MOST_DEVICES])
{
    cl_platform_id platforms[MOST_PLATFORMS];
    const cl_uint n_platforms = find_platforms(platforms);
    int n = 0;
    for (cl_uint p = 0; p < n_platforms && n < BRC_OPENCL_MOST_DEVICES; ++p) {
        cl_uint found = 0;
        const cl_uint room = (cl_uint)(BRC_OPENCL_MOST_DEVICES - n);
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, room, devices + n, &found) != CL_SUCCESS) continue;
        n += (int)(found < room ? found : room);
    }
    return n;
}

static void device_text(cl_device_id device, cl_device_info what, char *text, size_t bytes)
{
    char whole[1024] = "";
    if (clGetDeviceInfo(device, what, sizeof whole, whole, NULL) != CL_SUCCESS) whole[0] = '\0';
    whole[sizeof whole - 1] = '\0';
    snprintf(text, bytes, "%s", whole + strspn(whole, " "));
}

static uint64_t device_number(cl_device_id device, cl_device_info what)
{
    union {
        cl_ulong wide;
        cl_uint narrow;
    } number = {0}; /* the queries used answer with 4 or 8 bytes; on little-endian machines both read the same */
    size_t bytes = 0;
    if (clGetDeviceInfo(device, what, sizeof number, &number, &bytes) != CL_SUCCESS) return 0;
    return bytes == sizeof number.narrow ? number.narrow : number.wide;
}

static brc_device_info describe(cl_device_id device, int index)
{
    brc_device_info info = {.kind = BRC_DEVICE_OPENCL, .index = index};
    cl_platform_id platform = NULL;
    char platform_name[64] = "", version[32];
    snprintf(info.selector, sizeof info.selector, "opencl:%d", index);
    device_text(device, CL_DEVICE_NAME, info.name, sizeof info.name);
    device_text(device, CL_DRIVER_VERSION, version, sizeof version);
    (void)clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    if (platform) (void)clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof platform_name, platform_name, NULL);
    snprintf(info.driver, sizeof info.driver, "OpenCL platform %s, driver %s", platform_name, version);
    info.is_gpu = (device_number(device, CL_DEVICE_TYPE) & (CL_DEVICE_TYPE_GPU | CL_DEVICE_TYPE_ACCELERATOR)) != 0;
    info.has_double = device_number(device, CL_DEVICE_DOUBLE_FP_CONFIG) != 0;
    info.compute_units = (int)device_number(device, CL_DEVICE_MAX_COMPUTE_UNITS);
    info.memory_bytes = (int64_t)device_number(device, CL_DEVICE_GLOBAL_MEM_SIZE);
    info.largest_buffer_bytes = (int64_t)device_number(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    info.usable = true;
    if (!device_number(device, CL_DEVICE_AVAILABLE)) {
        info.usable = false;
        snprintf(info.why_not, sizeof info.why_not, "its driver says it is not available; see the driver's own tools");
    } else if (!device_number(device, CL_DEVICE_COMPILER_AVAILABLE)) {
        info.usable = false;
        snprintf(info.why_not, sizeof info.why_not,
                 "its driver has no compiler, and the kernels are compiled at run time");
    } else if (!device_number(device, CL_DEVICE_ENDIAN_LITTLE)) {
        info.usable = false;
        snprintf(info.why_not, sizeof info.why_not,
                 "it is big-endian, and buffers are shared with the host as they are");
    }
    return info;
}

/* A platform whose driver lists no device, as a row: its card may be missing, or hidden from this machine or
 * container. */
static brc_device_info describe_empty(cl_platform_id platform, int n_devices)
{
    brc_device_info row = {.kind = BRC_DEVICE_OPENCL, .index = n_devices, .name = "no device"};
    char name[64] = "";
    (void)clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name, name, NULL);
    name[sizeof name - 1] = '\0';
    /* opencl:0 where there is no device at all, so that who asks for it is told; otherwise a name that is no
     * selector */
    snprintf(row.selector, sizeof row.selector, n_devices ? "opencl:-" : "opencl:0");
    snprintf(row.driver, sizeof row.driver, "OpenCL platform %s", name);
    snprintf(
        row.why_not, sizeof row.why_not,
        "the driver of platform %.60s is there and lists no device: see whether the driver's own tools (nvidia-smi, "
        "rocm-smi) find the card, and in a container whether it is passed in",
        name);
    return row;
}

int brc_opencl_describe_all(brc_device_info *rows, int most)
{
    cl_device_id devices[BRC_OPENCL_MOST_DEVICES];
    cl_platform_id platforms[MOST_PLATFORMS];
    int n = brc_opencl_devices(devices);
    if (n > most) n = most;
    for (int d = 0; d < n; ++d)
        rows[d] = describe(devices[d], d);
    const int n_devices = n;
    const cl_uint n_platforms = find_platforms(platforms);
    for (cl_uint p = 0; p < n_platforms && n < most; ++p) {
        cl_uint found = 0;
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, 0, NULL, &found) == CL_SUCCESS && found > 0) continue;
        rows[n++] = describe_empty(platforms[p], n_devices);
    }
    return n;
}

/* The object of the loader itself, which has the functions of a driver too. */
static const void *object_of(const void *address)
{
    Dl_info where;
    return address && dladdr(address, &where) ? where.dli_fbase : NULL;
}

/* Asked of the dynamic loader, since a program around this library may use OpenCL for itself. Drivers have this
 * symbol. */
bool brc_opencl_driver_is_loaded(void)
{
    static const char symbol[] = "clGetExtensionFunctionAddress";
    const struct link_map *object = NULL;
    void *const program = dlopen(NULL, RTLD_LAZY);
    const void *const loader = object_of(dlsym(RTLD_DEFAULT, "clGetPlatformIDs"));
    bool found = false;
    if (!program) return false;
    if (dlinfo(program, RTLD_DI_LINKMAP, &object) != 0) object = NULL;
    for (; object && !found; object = object->l_next) {
        void *const library = object->l_name[0] ? dlopen(object->l_name, RTLD_LAZY | RTLD_NOLOAD) : NULL;
        if (!library) continue;
        const void *const owner = object_of(dlsym(library, symbol)); /* a library's own or one that it needs */
        found = owner && owner != loader;
        dlclose(library);
    }
    dlclose(program);
    return found;
}

/* The drivers that the loader is told of, "nvidia.icd, pocl.icd"; empty where there are none. */
static void name_drivers(char *text, size_t bytes)
{
    const char *const asked = getenv("OCL_ICD_VENDORS");
    const char *const place = asked && asked[0] ? asked : "/etc/OpenCL/vendors";
    const size_t length = strlen(place);
    size_t used = 0;
    text[0] = '\0';
    if (length > 4 && strcmp(place + length - 4, ".icd") == 0 && access(place, R_OK) == 0) {
        snprintf(text, bytes, "%s", place);
        return;
    }
    DIR *const folder = opendir(place);
    if (!folder) return;
    for (const struct dirent *entry; (entry = readdir(folder)) && used < bytes;) {
        const size_t end = strlen(entry->d_name);
        if (end > 4 && strcmp(entry->d_name + end - 4, ".icd") == 0)
            used += (size_t)snprintf(text + used, bytes - used, "%s%s", used ? ", " : "", entry->d_name);
    }
    closedir(folder);
}

brc_status brc_opencl_list_within(brc_context *context, brc_device_list *list, double seconds)
{
    brc_device_info rows[BRC_OPENCL_MOST_DEVICES];
    brc_device_info none = {
        .kind = BRC_DEVICE_OPENCL,
        .selector = "opencl:0",
        .name = "no OpenCL device",
        .driver = "OpenCL loader without a platform",
        .why_not = "no OpenCL driver is installed: install the GPU's own, or pocl-opencl-icd for the CPU",
    };
    int n;
    char trouble[128];
    if (brc_opencl_driver_is_loaded())
        n = brc_opencl_describe_all(rows, BRC_OPENCL_MOST_DEVICES);
    else
        brc_opencl_aside(brc_opencl_describe_all, seconds, rows, BRC_OPENCL_MOST_DEVICES, &n, trouble, sizeof trouble);
    for (int d = 0; d < n; ++d)
        BRC_TRY(brc_device_list_add(context, list, &rows[d]));
    if (n > 0) return BRC_OK;
    if (n < 0) {
        snprintf(none.driver, sizeof none.driver, "OpenCL loader with a driver that fails");
        snprintf(none.why_not, sizeof none.why_not,
                 "%s: mend it (PoCL needs /sys), or name the .icd file of a good one in OCL_ICD_VENDORS", trouble);
        brc_log(context, BRC_LOG_WARNING, "OpenCL is left out: %s", none.why_not);
    }
    char drivers[96];
    name_drivers(drivers, sizeof drivers);
    if (n == 0 && drivers[0])
        snprintf(
            none.why_not, sizeof none.why_not,
            "a driver is installed (%s) and gives no platform: its library is missing, or it finds no device; see the "
            "driver's own tools (nvidia-smi)",
            drivers);
    return brc_device_list_add(context, list, &none);
}

brc_status brc_device_opencl_list(brc_context *context, brc_device_list *list)
{
    return brc_opencl_list_within(context, list, BRC_OPENCL_LIST_SECONDS);
}
