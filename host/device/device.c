/* What all backends share: checks, sentences, counting, and finding each kernel once. */
#include "device_internal.h"
#include "../base/file.h"
#include "shares_internal.h"
#include "device_list.h"
#include "../base/memory.h"
#include "../base/ranks.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void brc_device_describe(const brc_device_info *info, char *text, size_t bytes)
{
    snprintf(text, bytes, "%s (%s)", info->selector, info->name);
}

static const brc_backend *backend_of(brc_device_kind kind)
{
    switch (kind) {
    case BRC_DEVICE_OPENCL: return &brc_backend_opencl;
    case BRC_DEVICE_TARGET: return &brc_backend_target;
    default: return &brc_backend_cpu;
    }
}

/* Does the selector have one of the forms "auto", "cpu", "opencl:N", "opencl:auto", "target:N"? */
static bool selector_parses(const char *selector)
{
    if (strcmp(selector, "auto") == 0 || strcmp(selector, "cpu") == 0 || strcmp(selector, "opencl:auto") == 0)
        return true;
    const char *digits =
        strncmp(selector, "opencl:", 7) == 0 || strncmp(selector, "target:", 7) == 0 ? selector + 7 : "";
    const size_t n = strspn(digits, "0123456789");
    return n > 0 && n < 6 && digits[n] == '\0';
}

/* The usable selectors, for sentences: "cpu, opencl:0". */
static void list_selectors(const brc_device_list *list, char *text, size_t bytes)
{
    size_t used = 0;
    text[0] = '\0';
    for (int d = 0; d < list->n && used < bytes; ++d)
        if (list->items[d].usable)
            used += (size_t)snprintf(text + used, bytes - used, "%s%s", used ? ", " : "", list->items[d].selector);
}

/* The kinds a selector can mean; `auto` never means target, and 0 is for what does not parse. */
static unsigned kinds_of(const char *selector)
{
    if (!selector_parses(selector)) return 0;
    if (strcmp(selector, "auto") == 0) return 1u << BRC_DEVICE_CPU | 1u << BRC_DEVICE_OPENCL;
    if (strcmp(selector, "cpu") == 0) return 1u << BRC_DEVICE_CPU;
    return 1u << (selector[0] == 'o' ? BRC_DEVICE_OPENCL : BRC_DEVICE_TARGET);
}

/* The device a selector names, in a list that may not have it: NULL then. */
static const brc_device_info *find_device(const brc_device_list *list, const char *selector, brc_precision precision)
{
    char why[512];
    if (strcmp(selector, "auto") == 0) return &list->items[brc_device_list_choose(list, precision, why, sizeof why)];
    if (strcmp(selector, "opencl:auto") == 0) {
        const int dealt = brc_device_list_deal(list, precision, brc_ranks_here().local);
        return dealt < 0 ? NULL : &list->items[dealt];
    }
    for (int d = 0; d < list->n; ++d)
        if (strcmp(list->items[d].selector, selector) == 0) return &list->items[d];
    return NULL;
}

static brc_status select_device(brc_context *context, const brc_device_request *request, brc_device_info *out)
{
    brc_status status = BRC_OK;
    brc_device_list *list = NULL;
    const char *const selector = request->selector ? request->selector : "auto";
    const unsigned kinds = kinds_of(selector);
    if (kinds) {
        BRC_TRY_OR(cleanup, brc_device_list_look(context, kinds, &list));
        const brc_device_info *const info = find_device(list, selector, request->precision);
        if (info && info->usable) {
            *out = *info;
            goto cleanup;
        }
        brc_device_list_free(&list);
    }
    /* No such device: the sentence names those that are there. */
    BRC_TRY_OR(cleanup, brc_device_list_create(context, &list));
    char there[256];
    list_selectors(list, there, sizeof there);
    const brc_device_info *const info = kinds ? find_device(list, selector, request->precision) : NULL;
    if (!kinds)
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "device '%.64s' is not a selector: expected auto, cpu, opencl:N, opencl:auto or target:N; "
                          "usable here: %s",
                          selector, there);
    else if (info)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "device %s (%s) cannot be used: %s; usable here: %s", selector,
                          info->name, info->why_not, there);
    else
        status = BRC_FAIL(context, BRC_BAD_INPUT, "device '%s' is not there; usable here: %s (see breccia devices)",
                          selector, there);
cleanup:
    brc_device_list_free(&list);
    return status;
}

brc_status brc_device_open(brc_context *context, const brc_device_request *request, brc_device **out)
{
    brc_status status = BRC_OK;
    brc_device *device = NULL;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &device, 1, "device"));
    device->context = context;
    device->precision = request->precision;
    device->many_materials = request->many_materials;
    device->exact = request->exact;
    BRC_TRY_OR(cleanup, select_device(context, request, &device->info));
    if (!device->info.has_double && request->precision != BRC_SINGLE) {
        char text[192];
        brc_device_describe(&device->info, text, sizeof text);
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "device %s has no double precision, which precision %s needs: take --precision single or "
                          "another device",
                          text, brc_precision_name(request->precision));
        goto cleanup;
    }
    const brc_backend *const backend = backend_of(device->info.kind);
    BRC_TRY_OR(cleanup, backend->open(device, request));
    device->backend = backend; /* from here on there is something to close */
    char reason[BRC_REASON_BYTES] = "";
    if (!backend->allocate(device, 64, &device->dummy, reason)) {
        status = BRC_FAIL(context, BRC_DEVICE_FAILED, "device %s has no room for 64 bytes: %s", device->info.selector,
                          reason);
        goto cleanup;
    }
    *out = device;
    device = NULL;
cleanup:
    brc_device_close(&device);
    return status;
}

void brc_device_close(brc_device **handle)
{
    brc_device *const device = handle ? *handle : NULL;
    if (!device) return;
    if (device->backend) {
        while (device->kernels) {
            brc_kernel *const kernel = device->kernels;
            device->kernels = kernel->next;
            device->backend->forget(kernel);
            brc_memory_free(kernel);
        }
        brc_shares_free(device);
        if (device->dummy) device->backend->release(device, device->dummy, 64);
        device->backend->close(device);
    }
    brc_memory_free(device);
    *handle = NULL;
}

brc_precision brc_device_get_precision(const brc_device *device)
{
    return device->precision;
}

bool brc_device_has_many_materials(const brc_device *device)
{
    return device->many_materials;
}

bool brc_device_is_exact(const brc_device *device)
{
    return device->exact;
}

int brc_device_lanes(const brc_device *device)
{
    return device->lanes;
}

int brc_device_slice(const brc_device *device)
{
    return device->slice;
}

int64_t brc_device_bytes(const brc_device *device)
{
    return device->bytes;
}

/* Into a list ordered by name, whose first n are there; equal names share a place. Returns the new n, which may be
 * above `most`. */
static int add_item(brc_device_item *items, int n, int most, const char *name, int64_t number)
{
    int k = 0;
    const int kept = n < most ? n : most;
    while (k < kept && strcmp(items[k].name, name) < 0)
        ++k;
    if (k < kept && strcmp(items[k].name, name) == 0) {
        items[k].number += number;
        return n;
    }
    for (int i = kept < most ? kept : most - 1; i > k; --i)
        items[i] = items[i - 1];
    if (k < most) items[k] = (brc_device_item){name, number};
    return n + 1;
}

int brc_device_launched(const brc_device *device, int most, brc_device_item *out)
{
    int n = 0;
    for (const brc_kernel *kernel = device->kernels; kernel; kernel = kernel->next)
        if (kernel->launches > 0) n = add_item(out, n, most, kernel->name, kernel->launches);
    return n;
}

int brc_device_buffers(const brc_device *device, int most, brc_device_item *out)
{
    int n = 0;
    for (const brc_buffer *buffer = device->buffers; buffer; buffer = buffer->older)
        n = add_item(out, n, most, buffer->what, buffer->bytes);
    return n;
}

brc_device_counts brc_device_counted(const brc_device *device)
{
    brc_device_counts counts = device->counts;
    for (const brc_kernel *kernel = device->kernels; kernel; kernel = kernel->next)
        counts.launches += kernel->launches;
    return counts;
}

brc_status brc_device_wait(brc_device *device)
{
    device->counts.waits += 1;
    return device->backend->wait(device);
}

brc_status brc_buffer_create(brc_device *device, brc_buffer **out, int64_t bytes, const char *what)
{
    *out = NULL;
    if (bytes < 0)
        return BRC_FAIL(device->context, BRC_INTERNAL, "buffer for %s: %lld bytes asked", what, (long long)bytes);
    const brc_device_info *const info = &device->info;
    char reason[BRC_REASON_BYTES] = "";
    void *memory = NULL;
    const int64_t held = bytes > 0 ? bytes : 64;
    const bool too_large = info->largest_buffer_bytes > 0 && bytes > info->largest_buffer_bytes;
    /* Subtracted, not added: what is asked may be close to the largest number there is. */
    const bool too_much = info->memory_bytes > 0 && bytes > info->memory_bytes - device->bytes;
    if (too_large || too_much || !device->backend->allocate(device, held, &memory, reason)) {
        char text[192], most[64], all[64];
        brc_device_describe(info, text, sizeof text);
        snprintf(most, sizeof most, "%lld", (long long)info->largest_buffer_bytes);
        snprintf(all, sizeof all, "%lld", (long long)info->memory_bytes);
        return BRC_FAIL(
            device->context, BRC_DEVICE_FAILED,
            "device %s has no room for %s: %lld bytes asked, %lld held, %s allowed in one buffer, %s in all%s%s; "
            "use fewer elements, a lower precision or another device",
            text, what, (long long)bytes, (long long)device->bytes, info->largest_buffer_bytes ? most : "any number",
            info->memory_bytes ? all : "an unknown number", reason[0] ? ": " : "", reason);
    }
    brc_buffer *buffer = NULL;
    const brc_status status = BRC_ALLOCATE(device->context, &buffer, 1, what);
    if (status != BRC_OK) {
        device->backend->release(device, memory, held);
        return status;
    }
    buffer->device = device;
    buffer->older = device->buffers;
    if (buffer->older) buffer->older->younger = buffer;
    device->buffers = buffer;
    buffer->memory = memory;
    buffer->bytes = bytes;
    buffer->held = held;
    snprintf(buffer->what, sizeof buffer->what, "%s", what);
    device->bytes += bytes;
    device->counts.waits += 1;
    *out = buffer;
    return BRC_OK;
}

brc_status brc_buffer_create_scratch(brc_buffer *of, brc_buffer **out)
{
    brc_buffer *buffer = NULL;
    BRC_TRY(BRC_ALLOCATE(of->device->context, &buffer, 1, of->what));
    buffer->device = of->device;
    buffer->memory = of->memory;
    buffer->bytes = of->bytes;
    buffer->is_scratch = true;
    snprintf(buffer->what, sizeof buffer->what, "%s", of->what);
    *out = buffer;
    return BRC_OK;
}

void brc_buffer_free(brc_buffer **handle)
{
    brc_buffer *const buffer = handle ? *handle : NULL;
    if (!buffer) return;
    if (buffer->is_scratch) {
        brc_memory_free(buffer);
        *handle = NULL;
        return;
    }
    buffer->device->backend->release(buffer->device, buffer->memory, buffer->held);
    buffer->device->bytes -= buffer->bytes;
    if (buffer->older) buffer->older->younger = buffer->younger;
    if (buffer->younger)
        buffer->younger->older = buffer->older;
    else
        buffer->device->buffers = buffer->older;
    brc_memory_free(buffer);
    *handle = NULL;
}

int64_t brc_buffer_bytes(const brc_buffer *buffer)
{
    return buffer->bytes;
}

void *brc_buffer_host(const brc_buffer *buffer)
{
    return buffer->device->info.kind == BRC_DEVICE_CPU ? buffer->memory : NULL;
}

/* Is [offset, offset + bytes) inside? Programmers' mistakes, but cheap to catch beside a blocking copy. */
static brc_status check_range(const brc_buffer *buffer, int64_t offset, int64_t bytes, const char *verb)
{
    if (offset >= 0 && bytes >= 0 && offset <= buffer->bytes && bytes <= buffer->bytes - offset) return BRC_OK;
    return BRC_FAIL(buffer->device->context, BRC_INTERNAL, "buffer of %s: cannot %s %lld bytes at %lld, it has %lld",
                    buffer->what, verb, (long long)bytes, (long long)offset, (long long)buffer->bytes);
}

brc_status brc_buffer_write(brc_buffer *buffer, int64_t offset, const void *data, int64_t bytes)
{
    BRC_TRY(check_range(buffer, offset, bytes, "write"));
    if (bytes == 0) return BRC_OK;
    buffer->device->counts.waits += 1;
    buffer->device->counts.written_bytes += bytes;
    if (brc_share_write(buffer, offset, data, bytes) || brc_share_once(buffer, offset, data, bytes)) return BRC_OK;
    BRC_TRY(brc_share_gather(buffer));
    buffer->set = 0;
    return buffer->device->backend->write(buffer->device, buffer->memory, offset, data, bytes);
}

brc_status brc_buffer_write_common(brc_buffer *buffer, const brc_common_memory *memory)
{
    const bool large = memory->bytes >= BRC_LARGE_ARRAY && buffer->of == BRC_OF_NOTHING;
    BRC_TRY(check_range(buffer, 0, memory->bytes, "write"));
    if (memory->bytes == 0) return BRC_OK;
    buffer->device->counts.waits += 1;
    buffer->device->counts.written_bytes += memory->bytes;
    if (large && brc_buffer_host(buffer) && brc_common_memory_lay(memory, buffer->memory)) return BRC_OK;
    return buffer->device->backend->write(buffer->device, buffer->memory, 0, memory->data, memory->bytes);
}

static brc_status read(brc_buffer *buffer, int64_t offset, void *data, int64_t bytes, bool for_file)
{
    BRC_TRY(check_range(buffer, offset, bytes, "read"));
    if (bytes == 0) return BRC_OK;
    bool done;
    buffer->device->counts.waits += 1;
    buffer->device->counts.read_bytes += bytes;
    BRC_TRY(brc_share_read(buffer, offset, data, bytes, for_file, &done));
    if (done) return BRC_OK;
    BRC_TRY(brc_share_gather(buffer));
    if (for_file && !brc_file_writes()) return BRC_OK;
    return buffer->device->backend->read(buffer->device, buffer->memory, offset, data, bytes);
}

brc_status brc_buffer_read(brc_buffer *buffer, int64_t offset, void *data, int64_t bytes)
{
    return read(buffer, offset, data, bytes, false);
}

brc_status brc_buffer_read_for_file(brc_buffer *buffer, void *data, int64_t bytes)
{
    return read(buffer, 0, data, bytes, true);
}

brc_status brc_buffer_copy(brc_buffer *dst, brc_buffer *src, int64_t bytes)
{
    BRC_TRY(check_range(dst, 0, bytes, "copy"));
    BRC_TRY(check_range(src, 0, bytes, "copy"));
    if (dst == src || dst->device != src->device)
        return BRC_FAIL(dst->device->context, BRC_INTERNAL, "copy from %s to %s: must be two buffers of one device",
                        src->what, dst->what);
    if (bytes == 0) return BRC_OK;
    BRC_TRY(brc_share_copy(dst, src, bytes));
    dst->set = 0;
    dst->device->counts.copied_bytes += bytes;
    return dst->device->backend->copy(dst->device, dst->memory, src->memory, bytes);
}

brc_status brc_buffer_fill_zero(brc_buffer *buffer)
{
    if (buffer->bytes == 0 || brc_share_zero(buffer)) return BRC_OK;
    buffer->where = BRC_EVERYWHERE;
    buffer->marked = false;
    return buffer->device->backend->zero(buffer->device, buffer->memory, buffer->bytes);
}

brc_status brc_kernel_find(brc_device *device, const char *name, brc_kernel **out)
{
    *out = NULL;
    for (brc_kernel *kernel = device->kernels; kernel; kernel = kernel->next)
        if (strcmp(kernel->name, name) == 0) {
            *out = kernel;
            return BRC_OK;
        }
    brc_kernel *kernel = NULL;
    BRC_TRY(BRC_ALLOCATE(device->context, &kernel, 1, name));
    kernel->device = device;
    snprintf(kernel->name, sizeof kernel->name, "%s", name);
    brc_kernel_signature_read(name, &kernel->signature);
    const brc_status status = device->backend->find(kernel);
    if (status != BRC_OK) {
        brc_memory_free(kernel);
        return status;
    }
    kernel->next = device->kernels;
    device->kernels = kernel;
    *out = kernel;
    return BRC_OK;
}

const char *brc_kernel_name(const brc_kernel *kernel)
{
    return kernel->name;
}

int brc_kernel_parameters(const brc_kernel *kernel)
{
    return kernel->signature.n;
}

brc_arg_kind brc_kernel_parameter(const brc_kernel *kernel, int k, char *name, size_t bytes)
{
    const char *const text = kernel->signature.name[k];
    size_t length = 0;
    while (length + 1 < bytes && (isalnum((unsigned char)text[length]) || text[length] == '_'))
        ++length;
    memcpy(name, text, length);
    name[length] = '\0';
    return (brc_arg_kind)(strchr(BRC_KERNEL_LETTERS, kernel->signature.kinds[k]) - BRC_KERNEL_LETTERS);
}

brc_use brc_kernel_use(const brc_kernel *kernel, int k)
{
    return kernel->signature.use[k];
}

/* A wrong argument list would be read as garbage by the kernel, so it is always checked: a few comparisons a launch. */
static bool kinds_match(const char *kinds, int n_args, const brc_arg *args)
{
    for (int a = 0; a < n_args; ++a)
        if (kinds[a] != BRC_KERNEL_LETTERS[args[a].kind]) return false; /* a short list ends in NUL: no match */
    return kinds[n_args] == '\0';
}

brc_status brc_kernel_launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args)
{
    brc_context *const context = kernel->device->context;
    if (n_args > BRC_KERNEL_MOST_ARGS)
        return BRC_FAIL(context, BRC_INTERNAL, "kernel %s: %d arguments, %d at most", kernel->name, n_args,
                        (int)BRC_KERNEL_MOST_ARGS);
    if (kernel->signature.n && !kinds_match(kernel->signature.kinds, n_args, args)) {
        char given[BRC_KERNEL_MOST_ARGS + 1];
        for (int a = 0; a < n_args; ++a)
            given[a] = BRC_KERNEL_LETTERS[args[a].kind];
        given[n_args] = '\0';
        return BRC_FAIL(context, BRC_INTERNAL,
                        "kernel %s takes %s (b buffer, i int, s state, c coeff, d double), was given %s", kernel->name,
                        kernel->signature.kinds, given);
    }
    if (n_items < 0 || n_items > INT32_MAX)
        return BRC_FAIL(context, BRC_INTERNAL, "kernel %s: %lld work-items", kernel->name, (long long)n_items);
    if (kernel->signature.items == BRC_OF_ROWS && n_items % kernel->device->lanes != 0)
        return BRC_FAIL(context, BRC_INTERNAL, "kernel %s: %lld rows are not whole groups of %d", kernel->name,
                        (long long)n_items, kernel->device->lanes);
    for (int a = 0; a < n_args; ++a)
        if (args[a].kind == BRC_ARG_BUFFER && args[a].value.buffer && args[a].value.buffer->device != kernel->device)
            return BRC_FAIL(context, BRC_INTERNAL, "kernel %s: argument %d (%s) lives on another device", kernel->name,
                            a, args[a].value.buffer->what);
    if (n_items == 0 && !brc_share_waits(kernel->device)) return BRC_OK;
    kernel->launches += 1;
    return brc_share_launch(kernel, n_items, n_args, args);
}
