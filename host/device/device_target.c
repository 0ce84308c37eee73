/* OpenMP target devices, through a plug-in library built by clang or by gcc. It is opened so that nothing of it is seen
 * by the rest and its own OpenMP runtime is found first: gcc's runtime in the program and clang's in the plug-in share
 * names. */
#include "device_internal.h"
#include "instance_call.h"
#include "target_plugin.h"
#include "kernel_hash.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The first that is there. */
static const char *const plugin_files[] = {"libbreccia_target.so", "libbreccia_target_nvptx.so"};

#if defined(__SANITIZE_ADDRESS__)
#define BRC_UNDER_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define BRC_UNDER_SANITIZER
#endif
#endif

typedef struct target_inside {
    const brc_target_plugin *plugin;
    const brc_kernel_instance *instance;
} target_inside;

#ifndef BRC_UNDER_SANITIZER
/* Programs that name `environ` (Python) have it in a copy of their own; a library that finds its own names first then
 * meets the C library's, which is NULL, and clang's OpenMP runtime reads the environment as it is loaded. */
static void show_environment(void)
{
    void *const library = dlopen("libc.so.6", RTLD_LAZY | RTLD_NOLOAD);
    char ***const own = library ? dlsym(library, "environ") : NULL;
    if (own && !*own) *own = environ;
    if (library) dlclose(library);
}
#endif

/* The plug-in at a path, or NULL with the reason. A library that holds target code must never be closed again (its
 * runtime keeps threads and handlers), so the handle is given away on purpose: the loader opens a path only once. */
static const brc_target_plugin *load(const char *path, char *why, size_t bytes)
{
#ifdef BRC_UNDER_SANITIZER
    snprintf(why, bytes, "%s stays out: the address sanitizer ends programs that open libraries as plug-ins need it",
             path);
    return NULL;
#else
    show_environment();
    void *const library = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND | RTLD_NODELETE);
    if (!library) {
        snprintf(why, bytes, "%s", dlerror());
        return NULL;
    }
    brc_target_plugin_getter get = NULL;
    void *const symbol = dlsym(library, BRC_TARGET_PLUGIN_SYMBOL);
    memcpy(&get, &symbol, sizeof get); /* C has no conversion from object to function pointers */
    const brc_target_plugin *const plugin = get ? get() : NULL;
    if (plugin && plugin->version == BRC_TARGET_PLUGIN_VERSION && plugin->kernels_hash == BRC_KERNEL_TEXTS_HASH)
        return plugin;
    snprintf(why, bytes, "%s belongs to another version of breccia: build it again", path);
    return NULL;
#endif
}

/* What is behind the last '/' goes; "" where there is none. */
static void keep_folder(char *path)
{
    char *const slash = strrchr(path, '/');
    path[slash ? slash + 1 - path : 0] = '\0';
}

/* The folder of the running program, with a '/' at the end; "" when it cannot be told. */
static void program_folder(char *folder, size_t bytes)
{
    const ssize_t length = readlink("/proc/self/exe", folder, bytes - 1);
    folder[length > 0 ? length : 0] = '\0';
    keep_folder(folder);
}

/* The same of the library that this is part of, or of the program. */
static void own_folder(char *folder, size_t bytes)
{
    Dl_info information;
    snprintf(folder, bytes, "%s",
             dladdr(&brc_backend_target, &information) && information.dli_fname ? information.dli_fname : "");
    keep_folder(folder);
}

/* Where the environment says, else beside the program or the library, else where `install` puts it. */
static const brc_target_plugin *find_plugin(char *why, size_t bytes)
{
    const char *const named = getenv("BRECCIA_TARGET_LIBRARY");
    if (named && named[0]) return load(named, why, bytes);
    static const char *const places[] = {"", "../", "../lib/breccia/", "breccia/"};
    char folder[2][2048], path[sizeof folder + 64];
    program_folder(folder[0], sizeof folder[0]);
    own_folder(folder[1], sizeof folder[1]);
    for (int k = 0; k < 4; ++k)
        for (size_t p = 0; folder[k % 2][0] && p < sizeof places / sizeof places[0]; ++p) {
            snprintf(path, sizeof path, "%s%s%s", folder[k % 2], places[p], plugin_files[k / 2]);
            if (access(path, R_OK) == 0) return load(path, why, bytes);
        }
    snprintf(why, bytes,
             "the plug-in %s is not there: it is built when clang with libomptarget is found (Debian: "
             "clang-14 libomp-14-dev), or name it in BRECCIA_TARGET_LIBRARY",
             plugin_files[0]);
    return NULL;
}

brc_status brc_device_target_list(brc_context *context, brc_device_list *list)
{
    brc_device_info info = {.kind = BRC_DEVICE_TARGET, .name = "OpenMP target", .driver = "no plug-in"};
    const brc_target_plugin *const plugin = find_plugin(info.why_not, sizeof info.why_not);
    const int n = plugin ? plugin->devices() : 0;
    const bool on_host = plugin && n == 0 && plugin->falls_back;
    if (plugin && n == 0)
        snprintf(
            info.why_not, sizeof info.why_not,
            "the plug-in finds no device: libomptarget and its device library must be installed (Debian: libomp5-14)");
    if (n == 0 && !on_host) {
        snprintf(info.selector, sizeof info.selector, "target:0");
        return brc_device_list_add(context, list, &info);
    }
    /* libomp presents one processor as four devices; they are the same, and one is enough. */
    info.usable = on_host || plugin->runs_on_device(0) == 1;
    info.is_gpu = plugin->falls_back && !on_host;
    if (!info.usable)
        snprintf(info.why_not, sizeof info.why_not, "a test region fell back to the host");
    else
        info.why_not[0] = '\0';
    info.has_double = true;
    info.compute_units = info.is_gpu ? 0 : (int)sysconf(_SC_NPROCESSORS_ONLN);
    snprintf(info.selector, sizeof info.selector, "target:0");
    snprintf(info.name, sizeof info.name, "OpenMP target device (%.48s)%s", plugin->architecture,
             on_host ? ": there is none, the host stands in" : "");
    snprintf(info.driver, sizeof info.driver, "%.96s", plugin->compiler);
    return brc_device_list_add(context, list, &info);
}

/* The plug-in is always compiled without contraction: there is no choice to make for request->exact. */
static brc_status target_open(brc_device *device, const brc_device_request *request)
{
    char why[BRC_REASON_BYTES];
    const brc_target_plugin *const plugin = find_plugin(why, sizeof why);
    if (!plugin) return BRC_FAIL(device->context, BRC_DEVICE_FAILED, "device %s: %s", device->info.selector, why);
    const brc_kernel_instance *const instance =
        plugin->instance((int)request->precision, (int)request->many_materials, why, sizeof why);
    if (!instance)
        return BRC_FAIL(device->context, BRC_DEVICE_FAILED, "device %s: the plug-in has no kernels in %s: %s",
                        device->info.selector, brc_precision_name(request->precision), why);
    if (request->lanes && request->lanes != instance->lanes)
        return BRC_FAIL(device->context, BRC_BAD_INPUT, "the target kernels handle %d elements at once, not %d",
                        instance->lanes, request->lanes);
    if (request->kernel_folder)
        return BRC_FAIL(device->context, BRC_BAD_INPUT,
                        "the target kernels are compiled already: a kernel folder (%.128s) needs an OpenCL device",
                        request->kernel_folder);
    if (plugin->falls_back && plugin->devices() == 0)
        brc_log(device->context, BRC_LOG_WARNING,
                "device %s: no device for %s is here, its kernels run on the host (slowly, the same numbers)",
                device->info.selector, plugin->architecture);
    target_inside *inside = NULL;
    BRC_TRY(BRC_ALLOCATE(device->context, &inside, 1, "target device"));
    inside->plugin = plugin;
    inside->instance = instance;
    device->lanes = instance->lanes;
    device->slice = instance->slice;
    device->inside = inside;
    return BRC_OK;
}

static void target_close(brc_device *device)
{
    brc_memory_free(device->inside);
}

static const brc_target_plugin *plugin_of(const brc_device *device)
{
    return ((const target_inside *)device->inside)->plugin;
}

static brc_status check(brc_device *device, int failed, const char *what)
{
    if (!failed) return BRC_OK;
    return BRC_FAIL(device->context, BRC_DEVICE_FAILED,
                    "device %s: %s failed (OMP_TARGET_OFFLOAD=MANDATORY and "
                    "LIBOMPTARGET_DEBUG=1 tell more)",
                    device->info.selector, what);
}

static bool target_allocate(brc_device *device, int64_t bytes, void **memory, char reason[BRC_REASON_BYTES])
{
    *memory = plugin_of(device)->allocate(device->info.index, (size_t)bytes);
    if (!*memory) {
        snprintf(reason, BRC_REASON_BYTES, "omp_target_alloc gave none");
        return false;
    }
    return plugin_of(device)->zero(device->info.index, *memory, (size_t)bytes) == 0;
}

static void target_release(brc_device *device, void *memory, int64_t bytes)
{
    (void)bytes;
    plugin_of(device)->release(device->info.index, memory);
}

static brc_status target_write(brc_device *device, void *memory, int64_t offset, const void *data, int64_t bytes)
{
    return check(device, plugin_of(device)->write(device->info.index, memory, (size_t)offset, data, (size_t)bytes),
                 "writing a buffer");
}

static brc_status target_read(brc_device *device, void *memory, int64_t offset, void *data, int64_t bytes)
{
    return check(device, plugin_of(device)->read(device->info.index, memory, (size_t)offset, data, (size_t)bytes),
                 "reading a buffer");
}

static brc_status target_copy(brc_device *device, void *to, void *from, int64_t bytes)
{
    return check(device, plugin_of(device)->copy(device->info.index, to, from, (size_t)bytes), "copying a buffer");
}

static brc_status target_zero(brc_device *device, void *memory, int64_t bytes)
{
    return check(device, plugin_of(device)->zero(device->info.index, memory, (size_t)bytes), "clearing a buffer");
}

static brc_status target_find(brc_kernel *kernel)
{
    return brc_instance_find(kernel, ((const target_inside *)kernel->device->inside)->instance);
}

static brc_status target_launch(brc_kernel *kernel, int64_t first, int64_t n_items, int n_args, const brc_arg *args)
{
    (void)first;   /* one rank alone computes here (shares.h) */
    (void)n_items; /* the loop bound is an argument of the kernel */
    plugin_of(kernel->device)->select(kernel->device->info.index);
    return brc_instance_call(kernel, n_args, args);
}

static brc_status target_wait(brc_device *device)
{
    (void)device; /* target regions are not deferred: each has ended when its launch returns */
    return BRC_OK;
}

const brc_backend brc_backend_target = {
    .open = target_open,
    .close = target_close,
    .allocate = target_allocate,
    .release = target_release,
    .write = target_write,
    .read = target_read,
    .copy = target_copy,
    .zero = target_zero,
    .find = target_find,
    .forget = brc_instance_forget,
    .launch = target_launch,
    .wait = target_wait,
};
