/* Memory and control of OpenMP target devices, compiled by clang into libbreccia_target together with the kernel
 * instances, by gcc into libbreccia_target_nvptx, whose instances lie in libraries beside it (BRC_TARGET_APART, the
 * stem of their names): a card's driver compiles whole libraries as they are opened, one instance in seconds; six
 * together took more than 24 GB. */
#ifdef BRC_TARGET_APART
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#endif
#include "../target_plugin.h"
#include "kernel_hash.h"
#include <omp.h>
#include <stdio.h>
#include <string.h>

#ifdef BRC_TARGET_APART
static const brc_kernel_instance *instance(int precision, int many_materials, char *why, size_t bytes)
{
    static const char *const names[] = {"double", "mixed", "single"};
    Dl_info own;
    char path[4096];
    const char *const folder = dladdr(&names, &own) && own.dli_fname ? own.dli_fname : "";
    const char *const slash = strrchr(folder, '/');
    snprintf(path, sizeof path, "%.*s%s_%s_%d.so", slash ? (int)(slash + 1 - folder) : 0, folder, BRC_TARGET_APART,
             names[precision], many_materials);
    void *const library = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    void *const symbol = library ? dlsym(library, BRC_TARGET_INSTANCE_SYMBOL) : NULL;
    if (!symbol) {
        snprintf(why, bytes, "%s", dlerror());
        return NULL;
    }
    brc_target_instance_getter get = NULL;
    uint64_t hash = 0;
    memcpy(&get, &symbol, sizeof get); /* C has no conversion from object to function pointers */
    const brc_kernel_instance *const found = get(&hash);
    if (hash == BRC_KERNEL_TEXTS_HASH) return found;
    snprintf(why, bytes, "%s belongs to another version of breccia: build it again", path);
    return NULL;
}
#else
#define BRC_DECLARE(name) extern const brc_kernel_instance name;
BRC_TARGET_INSTANCES(BRC_DECLARE)
#define BRC_ADDRESS(name) &name,
static const brc_kernel_instance *const instances[] = {BRC_TARGET_INSTANCES(BRC_ADDRESS)};

static const brc_kernel_instance *instance(int precision, int many_materials, char *why, size_t bytes)
{
    for (size_t k = 0; k < sizeof instances / sizeof instances[0]; ++k)
        if (instances[k]->precision == precision && instances[k]->many_materials == many_materials) return instances[k];
    snprintf(why, bytes, "it was built without");
    return NULL;
}
#endif

static int devices(void)
{
    return omp_get_num_devices();
}

/* Kernels get device addresses. clang 14 ignores defaultmap(firstprivate : pointer) and looks every pointer up among
 * the mapped host addresses, giving NULL for what it does not find: so each block is entered there as its own image. */
static void *allocate(int device, size_t bytes)
{
    void *const memory = omp_target_alloc(bytes, device);
#ifdef __clang__
    if (memory && omp_target_associate_ptr(memory, memory, bytes, 0, device) != 0) {
        omp_target_free(memory, device);
        return NULL;
    }
#endif
    return memory;
}

static void release(int device, void *memory)
{
#ifdef __clang__
    (void)omp_target_disassociate_ptr(memory, device);
#endif
    omp_target_free(memory, device);
}

/* omp_target_memcpy takes its source without const. */
static void *without_const(const void *p)
{
    return (void *)(uintptr_t)p;
}

static int write_to(int device, void *memory, size_t offset, const void *data, size_t bytes)
{
    return omp_target_memcpy(memory, without_const(data), bytes, offset, 0, device, omp_get_initial_device());
}

static int read_from(int device, const void *memory, size_t offset, void *data, size_t bytes)
{
    return omp_target_memcpy(data, without_const(memory), bytes, 0, offset, omp_get_initial_device(), device);
}

static int copy(int device, void *to, const void *from, size_t bytes)
{
    return omp_target_memcpy(to, without_const(from), bytes, 0, 0, device, device);
}

static int zero(int device, void *memory, size_t bytes)
{
    unsigned char *const first = memory;
#pragma omp target teams distribute parallel for is_device_ptr(first) device(device)
    for (size_t k = 0; k < bytes; ++k)
        first[k] = 0;
    return 0;
}

static void select_device(int device)
{
    omp_set_default_device(device);
}

static int runs_on_device(int device)
{
    int on_host = 1;
#pragma omp target map(from : on_host) device(device)
    on_host = omp_is_initial_device();
    return !on_host;
}

static const brc_target_plugin plugin = {
    .version = BRC_TARGET_PLUGIN_VERSION,
    .kernels_hash = BRC_KERNEL_TEXTS_HASH,
#ifdef __clang__
    .compiler = "clang " __clang_version__,
#else
    .compiler = "gcc " __VERSION__,
#endif
    .architecture = BRC_TARGET_ARCHITECTURE,
    .falls_back = BRC_TARGET_FALLS_BACK,
    .instance = instance,
    .devices = devices,
    .allocate = allocate,
    .release = release,
    .write = write_to,
    .read = read_from,
    .copy = copy,
    .zero = zero,
    .select = select_device,
    .runs_on_device = runs_on_device,
};

__attribute__((visibility("default"))) const brc_target_plugin *brc_target_plugin_get(void);
const brc_target_plugin *brc_target_plugin_get(void)
{
    return &plugin;
}
