#include "opencl_build.h"
#include "opencl_status.h"
#include "program_cache.h"
#include "program_source.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The whole compiler log, freed with brc_memory_free; NULL when there is none. */
static char *build_log(brc_device *device, cl_program program, cl_device_id id)
{
    size_t bytes = 0;
    char *log = NULL;
    if (clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, 0, NULL, &bytes) != CL_SUCCESS) return NULL;
    if (brc_memory_allocate(device->context, (void **)&log, (int64_t)bytes + 1, 1, "compiler log") != BRC_OK)
        return NULL;
    if (clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, bytes, log, NULL) != CL_SUCCESS) log[0] = '\0';
    return log;
}

/* What makes a device round every operation by itself. Divisions and roots of single numbers may be off by 2.5 and 3
 * last places unless the device is asked, which it can be where it offers it (OpenCL 1.2, 5.6.4.2). */
static const char *exact_options(brc_device *device, cl_device_id id)
{
    cl_device_fp_config single = 0;
    if (device->precision == BRC_DOUBLE) return " -D BRC_EXACT";
    if (clGetDeviceInfo(id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof single, &single, NULL) == CL_SUCCESS &&
        single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT)
        return " -D BRC_EXACT -cl-fp32-correctly-rounded-divide-sqrt";
    brc_log(device->context, BRC_LOG_WARNING,
            "device %s does not round divisions and roots of single numbers correctly: its results in precision %s may "
            "differ from those of other devices in spite of exact",
            device->info.selector, brc_precision_name(device->precision));
    return " -D BRC_EXACT";
}

/* Characters of BRECCIA_OPENCL_OPTIONS. */
enum { MOST_MORE = 200 };
/* Characters of the list of a device's extensions. */
enum { MOST_EXTENSIONS = 4096 };

/* Where what the compiler says of every program is added (docs/notebook/devices.md); NULL: nowhere. */
static const char *log_path(void)
{
    const char *const path = getenv("BRECCIA_OPENCL_LOG");
    return path && path[0] ? path : NULL;
}

static void extensions_of(cl_device_id id, char out[MOST_EXTENSIONS])
{
    memset(out, 0, MOST_EXTENSIONS);
    if (clGetDeviceInfo(id, CL_DEVICE_EXTENSIONS, MOST_EXTENSIONS - 1, out, NULL) != CL_SUCCESS) out[0] = '\0';
}

static void add_to_log(brc_device *device, cl_device_id id, const char *options, const char *log)
{
    FILE *const file = fopen(log_path(), "a");
    bool written = file != NULL;
    if (file) {
        char extensions[MOST_EXTENSIONS];
        extensions_of(id, extensions);
        fprintf(file, "extensions: %s\noptions: %s\n%s\n", extensions, options, log ? log : "");
        written = fclose(file) == 0;
    }
    if (!written)
        brc_log(device->context, BRC_LOG_WARNING, "the compiler log of BRECCIA_OPENCL_LOG is not written to %s: %s",
                log_path(), strerror(errno));
}

/* NVIDIA's compiler tells registers and spills of each kernel in its log where it is asked to. */
static const char *verbose_option(cl_device_id id)
{
    char extensions[MOST_EXTENSIONS];
    if (!log_path()) return "";
    extensions_of(id, extensions);
    return strstr(extensions, "cl_nv_compiler_options") ? " -cl-nv-verbose" : "";
}

/* What a compiled program depends on, as text: platform, device and driver with their versions, options, source. Freed
 * with brc_memory_free. */
static brc_status make_key(brc_device *device, cl_device_id id, const char *options, const char *source, char **out)
{
    static const cl_device_info of_device[] = {CL_DEVICE_VENDOR, CL_DEVICE_NAME, CL_DEVICE_VERSION, CL_DRIVER_VERSION,
                                               CL_DEVICE_EXTENSIONS};
    static const cl_platform_info of_platform[] = {CL_PLATFORM_NAME, CL_PLATFORM_VERSION};
    enum { LINE_BYTES = 2048, LINES = 8 };
    const size_t most = LINES * LINE_BYTES + strlen(options) + strlen(source) + 1;
    cl_platform_id platform = NULL;
    char line[LINE_BYTES];
    size_t used = 0;
    *out = NULL;
    BRC_TRY(brc_memory_allocate(device->context, (void **)out, (int64_t)most, 1, "key of a program"));
    (void)clGetDeviceInfo(id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    for (size_t k = 0; k < sizeof of_device / sizeof of_device[0] + sizeof of_platform / sizeof of_platform[0]; ++k) {
        const size_t p = k - sizeof of_device / sizeof of_device[0];
        memset(line, 0, sizeof line);
        if (k < sizeof of_device / sizeof of_device[0])
            (void)clGetDeviceInfo(id, of_device[k], sizeof line - 1, line, NULL);
        else
            (void)clGetPlatformInfo(platform, of_platform[p], sizeof line - 1, line, NULL);
        used += (size_t)snprintf(*out + used, most - used, "%s\n", line);
    }
    snprintf(*out + used, most - used, "%s\n%s", options, source);
    return BRC_OK;
}

/* Drivers that run on the CPU (PoCL) keep kernels themselves, and to hand a program out compile every kernel of it:
 * there only where a folder is named. */
static bool is_kept(const brc_device *device)
{
    const char *const folder = getenv("BRECCIA_OPENCL_CACHE");
    if (folder && strcmp(folder, "off") == 0) return false;
    return device->info.is_gpu || (folder && folder[0]);
}

/* The program kept under a key, ready to run; NULL: there is none, or the driver does not take it. */
static cl_program kept_program(brc_device *device, cl_context context, cl_device_id id, const char *options,
                               const char *key)
{
    size_t bytes;
    cl_int code, taken;
    unsigned char *const binary = brc_program_cache_find(device->context, key, &bytes);
    if (!binary) return NULL;
    const unsigned char *const binaries[] = {binary};
    cl_program program =
        clCreateProgramWithBinary(context, 1, &id, &bytes, (const unsigned char **)(uintptr_t)binaries, &taken, &code);
    brc_memory_free(binary);
    if (code != CL_SUCCESS || taken != CL_SUCCESS ||
        clBuildProgram(program, 1, &id, options, NULL, NULL) != CL_SUCCESS) {
        if (program) (void)clReleaseProgram(program);
        return NULL;
    }
    brc_log(device->context, BRC_LOG_DEBUG, "device %s: program taken from the cache", device->info.selector);
    return program;
}

static void keep_program(brc_device *device, cl_program program, const char *key)
{
    size_t bytes = 0;
    unsigned char *binary = NULL;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof bytes, &bytes, NULL) != CL_SUCCESS || bytes == 0)
        return;
    if (brc_memory_allocate(device->context, (void **)&binary, (int64_t)bytes, 1, "OpenCL program") != BRC_OK) return;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL) == CL_SUCCESS)
        brc_program_cache_keep(device->context, key, binary, bytes);
    brc_memory_free(binary);
}

/* folder: for the sentence. */
static brc_status compile(brc_device *device, cl_context context, cl_device_id id, const char *options,
                          const char *source, const char *folder, cl_program *out)
{
    brc_status status = BRC_OK;
    const char *const sources[] = {source};
    char text[192], *log = NULL;
    cl_int code;
    brc_device_describe(&device->info, text, sizeof text);
    *out = clCreateProgramWithSource(context, 1, (const char **)(uintptr_t)sources, NULL, &code);
    BRC_TRY(brc_opencl_check(device, code, "taking the kernel text"));
    code = clBuildProgram(*out, 1, &id, options, NULL, NULL);
    if (code != CL_SUCCESS || log_path() || brc_log_get_level(device->context) >= BRC_LOG_DEBUG)
        log = build_log(device, *out, id);
    if (log_path()) add_to_log(device, id, options, log);
    if (code != CL_SUCCESS)
        status = BRC_FAIL(device->context, BRC_DEVICE_FAILED,
                          "device %s, %s: the kernels%s%s do not compile: %s\noptions: %s\ncompiler log:\n%s", text,
                          device->info.driver, folder ? " in " : "", folder ? folder : "", brc_opencl_status_text(code),
                          options, log && log[0] ? log : "(empty)");
    else if (brc_log_get_level(device->context) >= BRC_LOG_DEBUG)
        brc_log(device->context, BRC_LOG_DEBUG, "device %s, options %s, compiler log:\n%s", text, options,
                log && log[0] ? log : "(empty)");
    brc_memory_free(log);
    return status;
}

brc_status brc_opencl_build(brc_device *device, const brc_opencl_request *r, cl_program *out)
{
    brc_status status = BRC_OK;
    char *source = NULL, *key = NULL, options[512];
    const char *const more = getenv("BRECCIA_OPENCL_OPTIONS"); /* to tune for a new device */
    const double start = brc_clock_s();
    *out = NULL;
    if (more && strlen(more) > MOST_MORE)
        return BRC_FAIL(device->context, BRC_BAD_INPUT,
                        "BRECCIA_OPENCL_OPTIONS has %zu characters: expected at most %d", strlen(more), (int)MOST_MORE);
    snprintf(options, sizeof options,
             "-cl-std=CL1.2 -cl-denorms-are-zero -D BRC_PRECISION=%d -D BRC_LANES=%d -D BRC_SLICE=%d -D "
             "BRC_GROUP=%d -D BRC_MANY_MATERIALS=%d%s%s%s%s",
             (int)device->precision, device->lanes, device->slice, (int)r->group, (int)device->many_materials,
             device->exact ? exact_options(device, r->id) : "", verbose_option(r->id), more && more[0] ? " " : "",
             more ? more : "");
    BRC_TRY_OR(cleanup, brc_program_source(device->context, r->folder, r->part, &source));
    BRC_TRY_OR(cleanup, make_key(device, r->id, options, source, &key));
    if (is_kept(device)) *out = kept_program(device, r->context, r->id, options, key);
    if (*out) goto cleanup;
    BRC_TRY_OR(cleanup, compile(device, r->context, r->id, options, source, r->folder, out));
    if (is_kept(device)) keep_program(device, *out, key);
    char kernels[32] = "all";
    if (r->part) snprintf(kernels, sizeof kernels, "%d", r->part->n);
    brc_log(device->context, r->part || device->info.is_gpu ? BRC_LOG_INFO : BRC_LOG_DEBUG,
            "device %s: a program of %s kernels, made in %.2f s", device->info.selector, kernels,
            brc_clock_s() - start);
cleanup:
    if (status != BRC_OK && *out) {
        (void)clReleaseProgram(*out);
        *out = NULL;
    }
    brc_memory_free(source);
    brc_memory_free(key);
    return status;
}
