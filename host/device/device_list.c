/* What can run here, and which one `auto` takes. */
#include "device_list.h"
#include "device_internal.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/ranks.h"
#include <stdio.h>

/* PoCL and other OpenCL drivers for the CPU are never taken on their own: the C build is the reference and faster. */
int brc_device_list_choose(const brc_device_list *list, brc_precision precision, char *why, size_t bytes)
{
    int n_gpus = 0, n_cpu_drivers = 0;
    for (int d = 0; d < list->n; ++d) {
        const brc_device_info *const info = &list->items[d];
        if (info->kind == BRC_DEVICE_OPENCL && info->usable && !info->is_gpu) ++n_cpu_drivers;
        if (info->kind != BRC_DEVICE_OPENCL || !info->is_gpu || !info->usable) continue;
        ++n_gpus;
        if (!info->has_double && precision != BRC_SINGLE) continue;
        snprintf(why, bytes, "auto takes %s, the first GPU that has the %s precision asked for (%s)", info->selector,
                 brc_precision_name(precision), info->name);
        return d;
    }
    int cpu = 0;
    while (cpu < list->n - 1 && list->items[cpu].kind != BRC_DEVICE_CPU)
        ++cpu;
    snprintf(
        why, bytes, "auto takes cpu, since %s%s",
        n_gpus ? "no GPU here has double precision (--precision single would take one)" : "no usable GPU was found",
        n_cpu_drivers ? "; OpenCL drivers that run on the CPU are slower than the cpu backend and taken only by name"
                      : "");
    return cpu;
}

int brc_device_list_deal(const brc_device_list *list, brc_precision precision, int32_t local)
{
    for (int gpus = 1; gpus >= 0; --gpus) {
        int n = 0, at = 0;
        for (int pass = 0; pass < 2; ++pass)
            for (int d = 0; d < list->n; ++d) {
                const brc_device_info *const info = &list->items[d];
                if (info->kind != BRC_DEVICE_OPENCL || !info->usable || info->is_gpu != (gpus == 1)) continue;
                if (!info->has_double && precision != BRC_SINGLE) continue;
                if (pass == 0)
                    ++n;
                else if (at++ == local % n)
                    return d;
            }
    }
    return -1;
}

brc_status brc_device_log_places(brc_context *context, const brc_device *device)
{
    enum { ROOM = 320 };
    const brc_ranks_place place = brc_ranks_here();
    const brc_device_info *const info = brc_device_get_info(device);
    int64_t *ones = NULL;
    char *all = NULL, own[ROOM];
    brc_status status = BRC_OK;
    if (place.count == 1) return BRC_OK;
    snprintf(own, sizeof own, "%.100s: %s, %s", place.node, info->selector, info->name);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &ones, place.count, "places of ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &all, (int64_t)ROOM * place.count, "places of ranks"));
    for (int32_t k = 0; k < place.count; ++k)
        ones[k] = 1;
    BRC_TRY_OR(cleanup, brc_ranks_gather_all(context, own, ROOM, ones, all));
    for (int32_t k = 0; k < place.count && place.mine == 0; ++k)
        brc_log(context, BRC_LOG_INFO, "rank %d on %s", (int)k, all + (int64_t)ROOM * k);
cleanup:
    brc_memory_free(ones);
    brc_memory_free(all);
    return status;
}

brc_status brc_device_list_look(brc_context *context, unsigned kinds, brc_device_list **out)
{
    brc_status status = BRC_OK;
    brc_device_list *list = NULL;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &list, 1, "device list"));
    if (kinds & 1u << BRC_DEVICE_CPU) BRC_TRY_OR(cleanup, brc_device_cpu_list(context, list));
    if (kinds & 1u << BRC_DEVICE_OPENCL) BRC_TRY_OR(cleanup, brc_device_opencl_list(context, list));
    if (kinds & 1u << BRC_DEVICE_TARGET) BRC_TRY_OR(cleanup, brc_device_target_list(context, list));
    list->automatic = brc_device_list_choose(list, BRC_DOUBLE, list->why, sizeof list->why);
    *out = list;
    list = NULL;
cleanup:
    brc_device_list_free(&list);
    return status;
}

brc_status brc_device_list_create(brc_context *context, brc_device_list **out)
{
    return brc_device_list_look(context, ~0u, out);
}

void brc_device_list_free(brc_device_list **handle)
{
    brc_device_list *const list = handle ? *handle : NULL;
    if (!list) return;
    brc_memory_free(list->items);
    brc_memory_free(list);
    *handle = NULL;
}

static void print_bytes(FILE *file, const char *label, int64_t bytes)
{
    if (bytes > 0) fprintf(file, "%s%.1f GiB", label, (double)bytes / (double)(1 << 30));
}

void brc_device_list_print(const brc_device_list *list, FILE *file)
{
    for (int d = 0; d < list->n; ++d) {
        const brc_device_info *const info = &list->items[d];
        fprintf(file, "%c %-10s %s\n", d == list->automatic ? '*' : ' ', info->selector, info->name);
        fprintf(file, "             %s; %s; %d %s; %s", info->driver, info->is_gpu ? "GPU" : "CPU", info->compute_units,
                info->kind == BRC_DEVICE_OPENCL ? "compute units" : "threads",
                info->has_double ? "double, mixed, single" : "single only");
        print_bytes(file, "; ", info->memory_bytes);
        print_bytes(file, ", one buffer at most ", info->largest_buffer_bytes);
        fputc('\n', file);
        if (!info->usable) fprintf(file, "             not usable: %s\n", info->why_not);
    }
    fprintf(file, "%s\n", list->why);
}
