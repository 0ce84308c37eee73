/* The reference backend: kernels as C with OpenMP, one instance per {instruction set, precision, materials}; the
 * instruction set is chosen here, at run time, so that one binary runs anywhere. */
#include "device_internal.h"
#include "instance_call.h"
#include "kernel_instances.h"
#include "../base/memory.h"
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* Above this size buffers are aligned to huge pages: gathers walk all over them. */
enum { HUGE_PAGE = 2 << 20 };

typedef struct cpu_inside {
    const brc_kernel_instance *instance;
    int n_threads;
} cpu_inside;

/* Instruction sets, the best last; which of them are built is in kernel_instances.h. */
static const struct {
    const char *level, *words;
} levels[] = {{"generic", "plain C"}, {"v2", "sse2"}, {"v3", "avx2"}, {"v4", "avx512"}};
enum { N_LEVELS = sizeof levels / sizeof levels[0] };

static bool level_runs(int level)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    switch (level) {
    case 3:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("fma");
    case 2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
               __builtin_cpu_supports("bmi2");
    default: return true;
    }
#else
    return level == 0;
#endif
}

static const brc_kernel_instance *find_instance(int level, brc_precision precision, bool many_materials)
{
    for (int k = 0; k < brc_kernel_instance_count; ++k) {
        const brc_kernel_instance *const instance = brc_kernel_instances[k];
        if (strcmp(instance->level, levels[level].level) == 0 && instance->precision == (int)precision &&
            instance->many_materials == (int)many_materials)
            return instance;
    }
    return NULL;
}

/* The best level that is built and runs here; 0 or above always, since every build holds the lowest one. */
static int best_level(void)
{
    int level = N_LEVELS - 1;
    while (level > 0 && !(level_runs(level) && find_instance(level, BRC_DOUBLE, false)))
        --level;
    return level;
}

/* best_level, or a lower one that BRECCIA_ISA names. */
static brc_status choose_level(brc_context *context, int *out)
{
    const char *const asked = getenv("BRECCIA_ISA");
    const int best = best_level();
    *out = best;
    if (!asked || !asked[0]) return BRC_OK;
    for (int level = 0; level <= best; ++level)
        if (strcmp(asked, levels[level].level) == 0 && find_instance(level, BRC_DOUBLE, false)) {
            *out = level;
            return BRC_OK;
        }
    return BRC_FAIL(
        context, BRC_BAD_INPUT,
        "BRECCIA_ISA is '%.32s', which is not an instruction set this machine and this build have; the best "
        "one is %s (unset it to take that)",
        asked, levels[best].level);
}

/* "model name" of /proc/cpuinfo, or "processor". */
static void processor_name(char *name, size_t bytes)
{
    snprintf(name, bytes, "processor");
    FILE *const file = fopen("/proc/cpuinfo", "r");
    if (!file) return;
    char line[256];
    while (fgets(line, sizeof line, file)) {
        char *const colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, bytes, "%s", colon + 1 + strspn(colon + 1, " "));
        break;
    }
    fclose(file);
}

/* What the process may use: the machine's memory or, in a container, its limit. */
static int64_t memory_limit(void)
{
    int64_t limit = (int64_t)sysconf(_SC_PHYS_PAGES) * (int64_t)sysconf(_SC_PAGE_SIZE);
    static const char *const files[] = {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
    for (size_t f = 0; f < sizeof files / sizeof files[0]; ++f) {
        FILE *const file = fopen(files[f], "r");
        if (!file) continue;
        long long bytes;
        if (fscanf(file, "%lld", &bytes) == 1 && bytes > 0 && bytes < limit) limit = bytes;
        fclose(file);
    }
    return limit;
}

brc_status brc_device_cpu_list(brc_context *context, brc_device_list *list)
{
    brc_device_info info = {.kind = BRC_DEVICE_CPU,
                            .selector = "cpu",
                            .has_double = true,
                            .compute_units = omp_get_max_threads(),
                            .memory_bytes = memory_limit(),
                            .usable = true};
    char processor[80];
    int level;
    BRC_TRY(choose_level(context, &level));
    processor_name(processor, sizeof processor);
    snprintf(info.name, sizeof info.name, "%s, %d threads, %s", processor, info.compute_units, levels[level].words);
    snprintf(info.driver, sizeof info.driver, "OpenMP, instruction set %s", levels[level].level);
    return brc_device_list_add(context, list, &info);
}

static brc_status cpu_open(brc_device *device, const brc_device_request *request)
{
    int level;
    BRC_TRY(choose_level(device->context, &level));
    /* The lowest level has no fused multiply-add; the others are compiled to use it. */
    if (request->exact)
        for (level = 0; !find_instance(level, request->precision, request->many_materials) && level < N_LEVELS - 1;)
            ++level;
    const brc_kernel_instance *const instance = find_instance(level, request->precision, request->many_materials);
    if (!instance)
        return BRC_FAIL(device->context, BRC_BAD_INPUT,
                        "this build has no kernels for %s in precision %s (./quickstart build makes those of all)",
                        levels[level].level, brc_precision_name(request->precision));
    if (request->n_threads < 0 || request->n_threads > 4096)
        return BRC_FAIL(device->context, BRC_BAD_INPUT,
                        "%d threads: expected 1 to 4096, or 0 for as many as OpenMP takes", request->n_threads);
    if (request->lanes && request->lanes != instance->lanes)
        return BRC_FAIL(device->context, BRC_BAD_INPUT,
                        "the cpu kernels of this build (%s, %s) handle %d elements at once, not %d: other widths are "
                        "for OpenCL devices",
                        levels[level].level, brc_precision_name(request->precision), instance->lanes, request->lanes);
    if (request->kernel_folder)
        return BRC_FAIL(
            device->context, BRC_BAD_INPUT,
            "the cpu kernels are compiled into the program: a kernel folder (%.128s) needs an OpenCL device",
            request->kernel_folder);
    cpu_inside *inside = NULL;
    BRC_TRY(BRC_ALLOCATE(device->context, &inside, 1, "cpu device"));
    inside->instance = instance;
    inside->n_threads = request->n_threads ? request->n_threads : omp_get_max_threads();
    char processor[80];
    processor_name(processor, sizeof processor);
    snprintf(device->info.name, sizeof device->info.name, "%s, %d threads, %s", processor, inside->n_threads,
             levels[level].words);
    snprintf(device->info.driver, sizeof device->info.driver, "OpenMP, instruction set %s", levels[level].level);
    device->info.joins_roundings = strcmp(instance->level, "v3") == 0 || strcmp(instance->level, "v4") == 0;
    device->info.compute_units = inside->n_threads;
    device->lanes = instance->lanes;
    device->slice = instance->slice;
    device->inside = inside;
    return BRC_OK;
}

static void cpu_close(brc_device *device)
{
    brc_memory_free(device->inside);
}

/* Every page is first touched by the thread whose kernels will walk it (NUMA), so clearing is a parallel loop. */
static void clear(const brc_device *device, char *memory, int64_t bytes)
{
    const int n_threads = ((const cpu_inside *)device->inside)->n_threads;
    if (bytes < 1 << 16) {
        memset(memory, 0, (size_t)bytes);
        return;
    }
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t page = 0; page < (bytes + 4095) / 4096; ++page) {
        const int64_t from = page * 4096;
        memset(memory + from, 0, (size_t)(bytes - from < 4096 ? bytes - from : 4096));
    }
}

/* Whole huge pages, cleared by the system as they are touched. */
static size_t mapped(int64_t bytes)
{
    return ((size_t)bytes + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
}
static bool map(int64_t bytes, void **memory)
{
    const size_t wanted = mapped(bytes), all = wanted + HUGE_PAGE;
    char *const from = mmap(NULL, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (from == MAP_FAILED) return false;
    const size_t before = (HUGE_PAGE - (uintptr_t)from % HUGE_PAGE) % HUGE_PAGE, after = all - before - wanted;
    if (before > 0) (void)munmap(from, before);
    if (after > 0) (void)munmap(from + before + wanted, after);
    *memory = from + before;
    (void)madvise(*memory, wanted, MADV_HUGEPAGE); /* a wish: refused is fine */
    return true;
}

static bool cpu_allocate(brc_device *device, int64_t bytes, void **memory, char reason[BRC_REASON_BYTES])
{
    const size_t rounded = ((size_t)bytes + 63) / 64 * 64;
    const bool large = bytes >= HUGE_PAGE;
    if (large ? !map(bytes, memory) : posix_memalign(memory, 64, rounded) != 0) {
        snprintf(reason, BRC_REASON_BYTES, "the system has no such block");
        return false;
    }
    if (!large || !device->shares) clear(device, *memory, (int64_t)rounded); /* of several ranks each touches its own */
    return true;
}

static void cpu_release(brc_device *device, void *memory, int64_t bytes)
{
    (void)device;
    if (bytes >= HUGE_PAGE)
        (void)munmap(memory, mapped(bytes));
    else
        free(memory);
}

static brc_status cpu_write(brc_device *device, void *memory, int64_t offset, const void *data, int64_t bytes)
{
    (void)device;
    memcpy((char *)memory + offset, data, (size_t)bytes);
    return BRC_OK;
}

static brc_status cpu_read(brc_device *device, void *memory, int64_t offset, void *data, int64_t bytes)
{
    (void)device;
    memcpy(data, (char *)memory + offset, (size_t)bytes);
    return BRC_OK;
}

static brc_status cpu_copy(brc_device *device, void *to, void *from, int64_t bytes)
{
    const int n_threads = ((const cpu_inside *)device->inside)->n_threads;
#pragma omp parallel for schedule(static) num_threads(n_threads) if (bytes >= 1 << 16)
    for (int64_t block = 0; block < (bytes + 4095) / 4096; ++block) {
        const int64_t at = block * 4096;
        memcpy((char *)to + at, (char *)from + at, (size_t)(bytes - at < 4096 ? bytes - at : 4096));
    }
    return BRC_OK;
}

static brc_status cpu_zero(brc_device *device, void *memory, int64_t bytes)
{
    clear(device, memory, bytes);
    return BRC_OK;
}

static brc_status cpu_find(brc_kernel *kernel)
{
    return brc_instance_find(kernel, ((const cpu_inside *)kernel->device->inside)->instance);
}

static brc_status cpu_launch(brc_kernel *kernel, int64_t first, int64_t n_items, int n_args, const brc_arg *args)
{
    const cpu_inside *const inside = kernel->device->inside;
    (void)n_items; /* the loop bound is an argument of the kernel */
    const int n_threads = inside->n_threads;
    /* The parallel loops are in the kernels, so the team size is set around the call; the caller's own is put back. */
    const int before = omp_get_max_threads();
    if (before != n_threads) omp_set_num_threads(n_threads);
    if (first > 0) *inside->instance->first = (int)first;
    *inside->instance->chosen = (int *)(uintptr_t)kernel->device->chosen;
    *inside->instance->n_chosen = kernel->device->n_chosen;
    const brc_status status = brc_instance_call(kernel, n_args, args);
    if (first > 0) *inside->instance->first = 0;
    *inside->instance->chosen = NULL;
    if (before != n_threads) omp_set_num_threads(before);
    return status;
}

static brc_status cpu_wait(brc_device *device)
{
    (void)device; /* every launch has ended when it returns */
    return BRC_OK;
}

const brc_backend brc_backend_cpu = {
    .open = cpu_open,
    .close = cpu_close,
    .allocate = cpu_allocate,
    .release = cpu_release,
    .write = cpu_write,
    .read = cpu_read,
    .copy = cpu_copy,
    .zero = cpu_zero,
    .find = cpu_find,
    .forget = brc_instance_forget,
    .launch = cpu_launch,
    .wait = cpu_wait,
};
