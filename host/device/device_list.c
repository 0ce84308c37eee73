/* What can run here, and which one `auto` takes. */
#include "device_list.h"
#include "device_internal.h"
#include "../base/memory.h"
#include <stdio.h>

brc_status brc_device_list_add(brc_context *context, brc_device_list *list, const brc_device_info *info)
{
    BRC_TRY(brc_memory_resize(context, (void **)&list->items, list->n + 1, sizeof *list->items, "device list"));
    list->items[list->n++] = *info;
    return BRC_OK;
}

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
