/* OpenCL: the kernels are compiled at run time from one pasted text for the variant a run needs; everything goes
 * through one queue that keeps the order. Drivers of GPUs compile every kernel of a program: theirs has those alone
 * that were asked for, and is made when the first is launched; what is asked for later gets a program of its own. PoCL
 * compiles a kernel when it is launched and keeps it by its program, so there all are in one. */
#include "gpu_layout.h"
#include "opencl_build.h"
#include "opencl_list.h"
#include "opencl_profile.h"
#include "opencl_status.h"
#include "../base/memory.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Work-items a group; docs/notebook/devices.md has the measurements. Never left to the driver: PoCL's own choice
 * crashed with wide types. */
enum { GROUP_CPU = 64 };
/* What kernels of one element a work-item put aside of it in local memory (kernels/portable.h), numbers at most. */
enum { MOST_ASIDE = 27 };
/* Elements a slice of the storage holds on a CPU: as many as a work-item, and at least these. */
enum { SLICE_CPU = 8 };
/* Long batches reach the device while they are still being enqueued. */
enum { LAUNCHES_BETWEEN_FLUSHES = 64 };
/* Buffers are rounded up to this, so that clearing may write whole patterns. */
enum { LINE = 64 };

typedef struct opencl_inside {
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    cl_program program;          /* of all kernels; NULL: programs have those that were asked for */
    brc_opencl_profile *profile; /* NULL: none is asked for */
    size_t group;
    int launches; /* since the last flush */
    int releases; /* of buffers so far: a handle may come back for another buffer, so set arguments are then sent
                     again */
} opencl_inside;

typedef struct opencl_kernel {
    cl_kernel kernel; /* NULL: in no program yet */
    size_t group;
    cl_uint n_args;
    int releases;                              /* opencl_inside.releases when the arguments were set */
    brc_packed_arg last[BRC_KERNEL_MOST_ARGS]; /* arguments stay set from launch to launch: only changes are sent */
    bool set[BRC_KERNEL_MOST_ARGS];
} opencl_kernel;

static void release_inside(opencl_inside *inside)
{
    if (!inside) return;
    brc_memory_free(inside->profile);
    if (inside->program) (void)clReleaseProgram(inside->program);
    if (inside->queue) (void)clReleaseCommandQueue(inside->queue);
    if (inside->context) (void)clReleaseContext(inside->context);
    brc_memory_free(inside);
}

/* Work-items a group at most, by the local memory that kernels take. */
static size_t most_in_group(const brc_device *device, cl_device_id id)
{
    cl_ulong local = 0;
    if (device->lanes != 1) return 1024;
    if (clGetDeviceInfo(id, CL_DEVICE_LOCAL_MEM_SIZE, sizeof local, &local, NULL) != CL_SUCCESS) return 32;
    const size_t most = (size_t)local / (size_t)(MOST_ASIDE * brc_precision_coeff_bytes(device->precision));
    return most < 1024 ? most : 1024;
}

/* W, C and work-items a group: those of a GPU or of a CPU by the kind of the device, or as BRECCIA_OPENCL_LAYOUT says
 * (tests run the layout of a GPU on PoCL); the group also as BRECCIA_OPENCL_GROUP says (to tune for a new device). */
static brc_status choose_layout(brc_device *device, cl_device_id id, int lanes, size_t *group)
{
    const char *const layout = getenv("BRECCIA_OPENCL_LAYOUT"), *const asked = getenv("BRECCIA_OPENCL_GROUP");
    bool gpu = device->info.is_gpu;
    if (layout && layout[0]) {
        gpu = strcmp(layout, "gpu") == 0;
        if (!gpu && strcmp(layout, "cpu") != 0)
            return BRC_FAIL(device->context, BRC_BAD_INPUT, "BRECCIA_OPENCL_LAYOUT is '%.32s': expected gpu or cpu",
                            layout);
    }
    if (!lanes) lanes = gpu ? 1 : 8;
    if (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16)
        return BRC_FAIL(device->context, BRC_BAD_INPUT, "%d elements a work-item: expected 1, 4, 8 or 16", lanes);
    device->lanes = lanes;
    device->slice = gpu ? BRC_GPU_SLICE : lanes > SLICE_CPU ? lanes : SLICE_CPU;
    *group = !gpu ? GROUP_CPU : device->precision == BRC_DOUBLE ? BRC_GPU_GROUP_DOUBLE : BRC_GPU_GROUP;
    const size_t most = most_in_group(device, id);
    while (*group > most)
        *group /= 2;
    if (!asked || !asked[0]) return BRC_OK;
    char *end;
    const long number = strtol(asked, &end, 10);
    if (*end || number < 1 || (size_t)number > most)
        return BRC_FAIL(device->context, BRC_BAD_INPUT, "BRECCIA_OPENCL_GROUP is '%.32s': expected 1 to %d work-items",
                        asked, (int)most);
    *group = (size_t)number;
    return BRC_OK;
}

/* Whether programs have only the kernels that were asked for: on a GPU, or as BRECCIA_OPENCL_PROGRAM says. */
static brc_status choose_program(brc_device *device, const char *kernel_folder, bool *parts)
{
    const char *const asked = getenv("BRECCIA_OPENCL_PROGRAM");
    *parts = device->info.is_gpu && !kernel_folder;
    if (!asked || !asked[0]) return BRC_OK;
    if (strcmp(asked, "whole") != 0 && strcmp(asked, "parts") != 0)
        return BRC_FAIL(device->context, BRC_BAD_INPUT, "BRECCIA_OPENCL_PROGRAM is '%.32s': expected whole or parts",
                        asked);
    *parts = asked[0] == 'p' && !kernel_folder;
    return BRC_OK;
}

static brc_status opencl_open(brc_device *device, const brc_device_request *request)
{
    brc_status status = BRC_OK;
    opencl_inside *inside = NULL;
    cl_device_id devices[BRC_OPENCL_MOST_DEVICES];
    cl_int code;
    bool parts;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(device->context, &inside, 1, "OpenCL device"));
    BRC_TRY_OR(cleanup, choose_program(device, request->kernel_folder, &parts));
    if (device->info.index >= brc_opencl_devices(devices)) {
        status = BRC_FAIL(device->context, BRC_DEVICE_FAILED, "device %s has vanished", device->info.selector);
        goto cleanup;
    }
    inside->id = devices[device->info.index];
    BRC_TRY_OR(cleanup, choose_layout(device, inside->id, request->lanes, &inside->group));
    inside->context = clCreateContext(NULL, 1, &inside->id, NULL, NULL, &code);
    BRC_TRY_OR(cleanup, brc_opencl_check(device, code, "making a context"));
    BRC_TRY_OR(cleanup, brc_opencl_profile_create(device->context, &inside->profile));
    inside->queue =
        clCreateCommandQueue(inside->context, inside->id, inside->profile ? CL_QUEUE_PROFILING_ENABLE : 0, &code);
    BRC_TRY_OR(cleanup, brc_opencl_check(device, code, "making a queue"));
    const brc_opencl_request whole = {inside->context, inside->id, inside->group, request->kernel_folder, NULL};
    if (!parts) BRC_TRY_OR(cleanup, brc_opencl_build(device, &whole, &inside->program));
    device->inside = inside;
    inside = NULL;
cleanup:
    release_inside(inside);
    return status;
}

static void opencl_close(brc_device *device)
{
    opencl_inside *const inside = device->inside;
    (void)clFinish(inside->queue); /* whatever it says, everything is given back now */
    brc_opencl_profile_close(&inside->profile, device);
    release_inside(inside);
}

static brc_status opencl_zero(brc_device *device, void *memory, int64_t bytes)
{
    opencl_inside *const inside = device->inside;
    static const cl_uint zero = 0;
    const size_t rounded = ((size_t)bytes + LINE - 1) / LINE * LINE;
    const cl_int code =
        clEnqueueFillBuffer(inside->queue, (cl_mem)memory, &zero, sizeof zero, 0, rounded, 0, NULL, NULL);
    return brc_opencl_check(device, code, "clearing a buffer");
}

static bool opencl_allocate(brc_device *device, int64_t bytes, void **memory, char reason[BRC_REASON_BYTES])
{
    opencl_inside *const inside = device->inside;
    const size_t rounded = ((size_t)bytes + LINE - 1) / LINE * LINE;
    static const cl_uint zero = 0;
    cl_int code;
    const cl_mem buffer = clCreateBuffer(inside->context, CL_MEM_READ_WRITE, rounded, NULL, &code);
    if (code == CL_SUCCESS) {
        /* Drivers take the memory at first use: clear at once and wait, so that a lack of it shows here. */
        code = clEnqueueFillBuffer(inside->queue, buffer, &zero, sizeof zero, 0, rounded, 0, NULL, NULL);
        if (code == CL_SUCCESS) code = clFinish(inside->queue);
        if (code != CL_SUCCESS) (void)clReleaseMemObject(buffer);
    }
    if (code != CL_SUCCESS) {
        snprintf(reason, BRC_REASON_BYTES, "%s (%d)", brc_opencl_status_text(code), (int)code);
        return false;
    }
    *memory = buffer;
    return true;
}

static void opencl_release(brc_device *device, void *memory, int64_t bytes)
{
    (void)bytes;
    ++((opencl_inside *)device->inside)->releases;
    (void)clReleaseMemObject((cl_mem)memory); /* the driver waits for what still uses it */
}

static brc_status opencl_write(brc_device *device, void *memory, int64_t offset, const void *data, int64_t bytes)
{
    opencl_inside *const inside = device->inside;
    const cl_int code = clEnqueueWriteBuffer(inside->queue, (cl_mem)memory, CL_TRUE, (size_t)offset, (size_t)bytes,
                                             data, 0, NULL, NULL);
    return brc_opencl_check(device, code, "writing a buffer");
}

static brc_status opencl_read(brc_device *device, void *memory, int64_t offset, void *data, int64_t bytes)
{
    opencl_inside *const inside = device->inside;
    const cl_int code =
        clEnqueueReadBuffer(inside->queue, (cl_mem)memory, CL_TRUE, (size_t)offset, (size_t)bytes, data, 0, NULL, NULL);
    return brc_opencl_check(device, code, "reading a buffer");
}

static brc_status opencl_copy(brc_device *device, void *to, void *from, int64_t bytes)
{
    opencl_inside *const inside = device->inside;
    const cl_int code =
        clEnqueueCopyBuffer(inside->queue, (cl_mem)from, (cl_mem)to, 0, 0, (size_t)bytes, 0, NULL, NULL);
    return brc_opencl_check(device, code, "copying a buffer");
}

/* A kernel of a program that has it. */
static brc_status take_kernel(brc_kernel *kernel, cl_program program)
{
    brc_device *const device = kernel->device;
    opencl_inside *const inside = device->inside;
    opencl_kernel *const own = kernel->inside;
    cl_int code;
    size_t most = 0;
    const cl_kernel found = clCreateKernel(program, kernel->name, &code);
    if (code == CL_INVALID_KERNEL_NAME)
        return BRC_FAIL(device->context, BRC_INTERNAL, "there is no kernel '%s' on device %s", kernel->name,
                        device->info.selector);
    BRC_TRY(brc_opencl_check(device, code, kernel->name));
    own->kernel = found;
    own->group = inside->group;
    (void)clGetKernelInfo(found, CL_KERNEL_NUM_ARGS, sizeof own->n_args, &own->n_args, NULL);
    /* A kernel with many registers may allow only smaller groups. */
    if (clGetKernelWorkGroupInfo(found, inside->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof most, &most, NULL) == CL_SUCCESS)
        while (own->group > most && own->group > 1)
            own->group /= 2;
    return BRC_OK;
}

static brc_status opencl_find(brc_kernel *kernel)
{
    brc_device *const device = kernel->device;
    opencl_inside *const inside = device->inside;
    opencl_kernel *own = NULL;
    if (!inside->program && kernel->signature.n == 0)
        return BRC_FAIL(device->context, BRC_INTERNAL, "there is no kernel '%s' on device %s", kernel->name,
                        device->info.selector);
    BRC_TRY(BRC_ALLOCATE(device->context, &own, 1, kernel->name));
    kernel->inside = own;
    const brc_status status = inside->program ? take_kernel(kernel, inside->program) : BRC_OK;
    if (status != BRC_OK) {
        brc_memory_free(own);
        kernel->inside = NULL;
    }
    return status;
}

/* A program of the kernels that were asked for and are in none. */
static brc_status build_missing(brc_device *device)
{
    opencl_inside *const inside = device->inside;
    const char **names = NULL;
    cl_program program = NULL;
    brc_status status = BRC_OK;
    int n = 0, room = 0;
    for (const brc_kernel *k = device->kernels; k; k = k->next)
        ++room;
    BRC_TRY(BRC_ALLOCATE(device->context, &names, room, "names of kernels"));
    for (const brc_kernel *k = device->kernels; k; k = k->next)
        if (!((const opencl_kernel *)k->inside)->kernel) names[n++] = k->name;
    const brc_program_part part = {n, names};
    const brc_opencl_request asked = {inside->context, inside->id, inside->group, NULL, &part};
    BRC_TRY_OR(cleanup, brc_opencl_build(device, &asked, &program));
    for (brc_kernel *k = device->kernels; k; k = k->next)
        if (!((const opencl_kernel *)k->inside)->kernel) BRC_TRY_OR(cleanup, take_kernel(k, program));
cleanup:
    if (program) (void)clReleaseProgram(program); /* its kernels hold it */
    brc_memory_free(names);
    return status;
}

static void opencl_forget(brc_kernel *kernel)
{
    opencl_kernel *const own = kernel->inside;
    if (own->kernel) (void)clReleaseKernel(own->kernel);
    brc_memory_free(own);
}

/* Few items on a GPU: smaller groups, so that no part of it is idle, down to one item, for those of a group wait for
 * the longest path of all (pairs of polyhedra: 154 us for 358, bench/results/2026-11-27-nvidia-h200-crews). PoCL would
 * compile a kernel once more for each size of group. */
static size_t group_for(const brc_device_info *device, size_t group, size_t items)
{
    while (device->is_gpu && group > 1 && items < group * (size_t)device->compute_units)
        group /= 2;
    return group;
}

/* Where and in what groups a launch runs. */
typedef struct {
    size_t offset, global, group;
} extent;
static extent extent_of(const brc_kernel *kernel, size_t first, size_t items)
{
    const brc_device *const device = kernel->device;
    if (kernel->signature.crews && device->lanes == 1)
        return (extent){first * BRC_GPU_CREW, items * BRC_GPU_CREW, BRC_GPU_CREW};
    const size_t group = group_for(&device->info, ((const opencl_kernel *)kernel->inside)->group, items);
    return (extent){first, (items + group - 1) / group * group, group};
}

static brc_status opencl_launch(brc_kernel *kernel, int64_t first, int64_t n_items, int n_args, const brc_arg *args)
{
    brc_device *const device = kernel->device;
    opencl_inside *const inside = device->inside;
    opencl_kernel *const own = kernel->inside;
    if (!own->kernel) BRC_TRY(build_missing(device));
    if ((cl_uint)n_args != own->n_args)
        return BRC_FAIL(device->context, BRC_INTERNAL, "kernel %s takes %u arguments, was given %d", kernel->name,
                        (unsigned)own->n_args, n_args);
    if (own->releases != inside->releases) memset(own->set, 0, sizeof own->set);
    own->releases = inside->releases;
    for (int a = 0; a < n_args; ++a) {
        const brc_packed_arg packed = brc_arg_pack(device, &args[a]);
        if (own->set[a] && own->last[a].bytes == packed.bytes &&
            memcmp(&own->last[a].value, &packed.value, packed.bytes) == 0)
            continue;
        own->set[a] = false;
        const cl_int code = clSetKernelArg(own->kernel, (cl_uint)a, packed.bytes, &packed.value);
        BRC_TRY(brc_opencl_check(device, code, kernel->name));
        own->last[a] = packed;
        own->set[a] = true;
    }
    const extent e = extent_of(kernel, (size_t)first, (size_t)(n_items - first));
    const cl_int code = clEnqueueNDRangeKernel(inside->queue, own->kernel, 1, &e.offset, &e.global, &e.group, 0, NULL,
                                               brc_opencl_profile_event(inside->profile));
    BRC_TRY(brc_opencl_check(device, code, kernel->name));
    brc_opencl_profile_add(inside->profile, kernel->name, n_items);
    if (++inside->launches < LAUNCHES_BETWEEN_FLUSHES) return BRC_OK;
    inside->launches = 0;
    return brc_opencl_check(device, clFlush(inside->queue), "flushing the queue");
}

static brc_status opencl_wait(brc_device *device)
{
    opencl_inside *const inside = device->inside;
    inside->launches = 0;
    return brc_opencl_check(device, clFinish(inside->queue), "waiting for the device");
}

const brc_backend brc_backend_opencl = {
    .open = opencl_open,
    .close = opencl_close,
    .allocate = opencl_allocate,
    .release = opencl_release,
    .write = opencl_write,
    .read = opencl_read,
    .copy = opencl_copy,
    .zero = opencl_zero,
    .find = opencl_find,
    .forget = opencl_forget,
    .launch = opencl_launch,
    .wait = opencl_wait,
};
