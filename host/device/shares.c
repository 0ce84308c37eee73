#include "shares_internal.h"
#include "../base/memory.h"
#include "../base/ranks.h"
#include <stdlib.h>
#include <string.h>

/* Where the rows of an array are right. */
enum { EVERYWHERE, NEAR, MINE }; /* of all ranks; own ones and those that own bonds reach; own ones */

/* Messages of rows of so many bytes, made at the first use. */
typedef struct messages {
    struct messages *next;
    int64_t bytes; /* of a row */
    char *send, *receive;
    brc_exchange *exchange;
} messages;

struct brc_shares {
    brc_rows_of_device rows;
    int32_t n_ranks, mine;
    int32_t *first_slice; /* [n_ranks + 1] */
    int32_t n_beside;     /* ranks that rows are exchanged with */
    int32_t *beside;      /* [n_beside] */
    int64_t *to, *from;   /* [n_beside + 1] where their rows begin in the lists */
    int32_t *give, *take; /* rows, ascending for each rank */
    messages *messages;
};
typedef struct brc_shares shares;

/* ---- ranges ---- */

/* Things of a kind before a slice. */
static int64_t before_slice(const shares *h, brc_array_of what, int32_t slice)
{
    if (what == BRC_OF_SLOTS) return h->rows.slot_start[slice];
    if (what == BRC_OF_SLICES) return slice;
    const int64_t row = (int64_t)slice * h->rows.slice;
    return what == BRC_OF_GROUPS ? row * h->rows.n_groups / h->rows.n_rows : row;
}

static int32_t rank_of_row(const shares *h, int32_t row)
{
    const int32_t slice = row / h->rows.slice;
    int32_t rank = (int32_t)((int64_t)slice * h->n_ranks / h->rows.n_slices);
    while (slice < h->first_slice[rank])
        --rank;
    while (slice >= h->first_slice[rank + 1])
        ++rank;
    return rank;
}

/* ---- who gives which rows to whom ---- */

typedef struct row_list {
    int64_t n, room;
    int32_t *row;
} row_list;

static brc_status add_row(brc_context *context, row_list *list, int32_t row)
{
    if (list->n == list->room) {
        list->room = 2 * list->room + 64;
        BRC_TRY(brc_memory_resize(context, (void **)&list->row, list->room, sizeof *list->row, "rows of other ranks"));
    }
    list->row[list->n++] = row;
    return BRC_OK;
}

/* Rows of [first, end) that bonds of rank `of` reach: seen [n_rows] marks those that were found for it. */
static brc_status reached(brc_context *context, const shares *h, int32_t of, int32_t *seen, row_list *lists, bool give)
{
    const int64_t begin = before_slice(h, BRC_OF_SLOTS, h->first_slice[of]) * h->rows.slice,
                  end = before_slice(h, BRC_OF_SLOTS, h->first_slice[of + 1]) * h->rows.slice;
    for (int64_t k = begin; k < end; ++k) {
        const int32_t row = h->rows.neighbour[k], owner = rank_of_row(h, row);
        if (owner == of || seen[row] == of + 1 || (give && owner != h->mine)) continue;
        seen[row] = of + 1;
        BRC_TRY(add_row(context, &lists[give ? of : owner], row));
    }
    return BRC_OK;
}

static int ascending(const void *left, const void *right)
{
    const int32_t a = *(const int32_t *)left, b = *(const int32_t *)right;
    return (a > b) - (a < b);
}

/* Lists of the ranks beside, one after another. */
static brc_status join(brc_context *context, const shares *h, const row_list *lists, int64_t **start, int32_t **rows)
{
    int64_t n = 0;
    for (int32_t k = 0; k < h->n_beside; ++k)
        n += lists[h->beside[k]].n;
    BRC_TRY(BRC_ALLOCATE(context, start, h->n_beside + 1, "rows of other ranks"));
    BRC_TRY(BRC_ALLOCATE(context, rows, n + 1, "rows of other ranks"));
    for (int32_t k = 0; k < h->n_beside; ++k) {
        const row_list *list = &lists[h->beside[k]];
        if (list->n > 0) memcpy(*rows + (*start)[k], list->row, (size_t)list->n * sizeof *list->row);
        if (list->n > 0) qsort(*rows + (*start)[k], (size_t)list->n, sizeof **rows, ascending);
        (*start)[k + 1] = (*start)[k] + list->n;
    }
    return BRC_OK;
}

static brc_status find_rows(brc_context *context, shares *h)
{
    brc_status status = BRC_OK;
    int32_t *seen = NULL;
    row_list *give = NULL, *take = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &seen, h->rows.n_rows, "rows of other ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &give, h->n_ranks, "rows of other ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &take, h->n_ranks, "rows of other ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &h->beside, h->n_ranks, "rows of other ranks"));
    for (int32_t rank = 0; rank < h->n_ranks; ++rank)
        BRC_TRY_OR(cleanup, rank == h->mine ? reached(context, h, rank, seen, take, false)
                                            : reached(context, h, rank, seen, give, true));
    for (int32_t rank = 0; rank < h->n_ranks; ++rank)
        if (give[rank].n > 0 || take[rank].n > 0) h->beside[h->n_beside++] = rank;
    BRC_TRY_OR(cleanup, join(context, h, give, &h->to, &h->give));
    status = join(context, h, take, &h->from, &h->take);
cleanup:
    for (int32_t rank = 0; rank < h->n_ranks; ++rank) {
        if (give) brc_memory_free(give[rank].row);
        if (take) brc_memory_free(take[rank].row);
    }
    brc_memory_free(seen);
    brc_memory_free(give);
    brc_memory_free(take);
    return status;
}

brc_status brc_device_share(brc_device *device, const brc_rows_of_device *rows)
{
    brc_context *context = device->context;
    shares *h = NULL;
    const int32_t n_ranks = brc_ranks_count();
    brc_shares_free(device);
    if (n_ranks == 1) return BRC_OK;
    if (device->info.kind == BRC_DEVICE_TARGET)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "device %s computes on one rank alone; on several take cpu or opencl devices",
                        device->info.selector);
    BRC_TRY(BRC_ALLOCATE(context, &h, 1, "shares of ranks"));
    device->shares = h;
    h->rows = *rows;
    h->n_ranks = n_ranks;
    h->mine = brc_ranks_mine();
    BRC_TRY(BRC_ALLOCATE(context, &h->first_slice, n_ranks + 1, "shares of ranks"));
    int32_t slice = 0; /* as many slots for each */
    for (int32_t rank = 1; rank <= n_ranks; ++rank) {
        while (slice < rows->n_slices &&
               (int64_t)rows->slot_start[slice + 1] * n_ranks <= (int64_t)rows->slot_start[rows->n_slices] * rank)
            ++slice;
        h->first_slice[rank] = rank == n_ranks ? rows->n_slices : slice;
    }
    return find_rows(context, h);
}

void brc_shares_free(brc_device *device)
{
    shares *h = device->shares;
    if (!h) return;
    while (h->messages) {
        messages *const m = h->messages;
        h->messages = m->next;
        brc_exchange_free(&m->exchange);
        brc_memory_free(m->send);
        brc_memory_free(m->receive);
        brc_memory_free(m);
    }
    brc_memory_free(h->first_slice);
    brc_memory_free(h->beside);
    brc_memory_free(h->to);
    brc_memory_free(h->from);
    brc_memory_free(h->give);
    brc_memory_free(h->take);
    brc_memory_free(h);
    device->shares = NULL;
}

void brc_buffer_is_of(brc_buffer *buffer, brc_array_of what, int64_t bytes)
{
    buffer->of = what;
    buffer->each = bytes;
}

/* ---- bringing rows ---- */

/* The memory of an array as the host sees it: itself on the cpu, else a copy, which is put back. */
static brc_status open_image(brc_buffer *buffer, char **image)
{
    brc_device *device = buffer->device;
    *image = device->info.kind == BRC_DEVICE_CPU ? buffer->memory : NULL;
    if (*image) return BRC_OK;
    BRC_TRY(brc_memory_allocate(device->context, (void **)image, buffer->bytes, 1, "rows of other ranks"));
    return device->backend->read(device, buffer->memory, 0, *image, buffer->bytes);
}
static brc_status close_image(brc_buffer *buffer, char *image, brc_status status)
{
    brc_device *device = buffer->device;
    if (image == buffer->memory) return status;
    if (status == BRC_OK) status = device->backend->write(device, buffer->memory, 0, image, buffer->bytes);
    brc_memory_free(image);
    return status;
}

static brc_status messages_of(brc_context *context, shares *h, int64_t bytes, messages **out)
{
    brc_status status = BRC_OK;
    brc_neighbour *beside = NULL;
    for (messages *m = h->messages; m; m = m->next)
        if (m->bytes == bytes) {
            *out = m;
            return BRC_OK;
        }
    messages *m = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &m, 1, "messages"));
    m->next = h->messages;
    m->bytes = bytes;
    *out = h->messages = m;
    BRC_TRY(brc_memory_allocate(context, (void **)&m->send, h->to[h->n_beside] + 1, bytes, "messages"));
    BRC_TRY(brc_memory_allocate(context, (void **)&m->receive, h->from[h->n_beside] + 1, bytes, "messages"));
    BRC_TRY(BRC_ALLOCATE(context, &beside, h->n_beside + 1, "messages"));
    for (int32_t k = 0; k < h->n_beside; ++k)
        beside[k] = (brc_neighbour){.rank = h->beside[k],
                                    .send = m->send + h->to[k] * bytes,
                                    .send_bytes = (h->to[k + 1] - h->to[k]) * bytes,
                                    .receive = m->receive + h->from[k] * bytes,
                                    .receive_bytes = (h->from[k + 1] - h->from[k]) * bytes};
    status = brc_exchange_create(context, h->n_beside, beside, &m->exchange);
    brc_memory_free(beside);
    return status;
}

/* The rows that own bonds reach, of those that compute them. */
static brc_status bring_near(brc_buffer *buffer)
{
    brc_context *context = buffer->device->context;
    shares *h = buffer->device->shares;
    const size_t bytes = (size_t)buffer->each;
    messages *m;
    char *image = NULL;
    brc_status status = messages_of(context, h, buffer->each, &m);
    if (status == BRC_OK) status = open_image(buffer, &image);
    BRC_TRY(status);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < h->to[h->n_beside]; ++k)
        memcpy(m->send + (size_t)k * bytes, image + (size_t)h->give[k] * bytes, bytes);
    status = brc_exchange_begin(context, m->exchange);
    if (status == BRC_OK) status = brc_exchange_finish(context, m->exchange);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < h->from[h->n_beside]; ++k)
        memcpy(image + (size_t)h->take[k] * bytes, m->receive + (size_t)k * bytes, bytes);
    buffer->where = NEAR;
    return close_image(buffer, image, status);
}

brc_status brc_share_gather(brc_buffer *buffer)
{
    brc_context *context = buffer->device->context;
    const shares *h = buffer->device->shares;
    brc_status status = BRC_OK;
    int64_t *n_of = NULL;
    char *image = NULL;
    if (!h || buffer->where == EVERYWHERE) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &n_of, h->n_ranks, "shares of ranks"));
    for (int32_t rank = 0; rank < h->n_ranks; ++rank)
        n_of[rank] =
            before_slice(h, buffer->of, h->first_slice[rank + 1]) - before_slice(h, buffer->of, h->first_slice[rank]);
    BRC_TRY_OR(cleanup, open_image(buffer, &image));
    status = brc_ranks_gather_all(context, image + before_slice(h, buffer->of, h->first_slice[h->mine]) * buffer->each,
                                  buffer->each, n_of, image);
    buffer->where = EVERYWHERE;
    status = close_image(buffer, image, status);
cleanup:
    brc_memory_free(n_of);
    return status;
}

/* ---- launches ---- */

static bool writes(brc_use use)
{
    return use == BRC_USE_PUT || use == BRC_USE_UPDATE;
}

/* The kind of a launch's items, where a rank does its own alone. */
static brc_array_of shared_items(const brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args)
{
    const shares *h = kernel->device->shares;
    const brc_array_of items = kernel->signature.items;
    if (items == BRC_OF_NOTHING) return BRC_OF_NOTHING;
    if (n_items != (items == BRC_OF_GROUPS ? h->rows.n_groups : h->rows.n_rows)) return BRC_OF_NOTHING;
    for (int a = 0; a < n_args; ++a) {
        if (args[a].kind != BRC_ARG_BUFFER) continue;
        const brc_use use = kernel->signature.use[a];
        const brc_buffer *const buffer = args[a].value.buffer;
        if (use == BRC_USE_SCATTER || (writes(use) && buffer && buffer->of == BRC_OF_NOTHING)) return BRC_OF_NOTHING;
    }
    return items;
}

/* What the launch reads is there. */
static brc_status bring(brc_kernel *kernel, brc_array_of items, int n_args, const brc_arg *args)
{
    for (int a = 0; a < n_args; ++a) {
        brc_buffer *const buffer = args[a].kind == BRC_ARG_BUFFER ? args[a].value.buffer : NULL;
        if (!buffer || buffer->where == EVERYWHERE) continue;
        if (items == BRC_OF_NOTHING || (kernel->signature.use[a] == BRC_USE_GATHER && buffer->of != BRC_OF_ROWS))
            BRC_TRY(brc_share_gather(buffer));
        else if (kernel->signature.use[a] == BRC_USE_GATHER && buffer->where == MINE)
            BRC_TRY(bring_near(buffer));
    }
    return BRC_OK;
}

static brc_status launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args)
{
    return kernel->device->backend->launch(kernel, 0, n_items, n_args, args);
}

/* Items of a range; their bound is the first argument. */
static brc_status launch_range(brc_kernel *kernel, int64_t first, int64_t end, int n_args, const brc_arg *args)
{
    brc_arg own[BRC_KERNEL_MOST_ARGS];
    memcpy(own, args, (size_t)n_args * sizeof *own);
    own[0] = BRC_INT((int32_t)end);
    return kernel->device->backend->launch(kernel, first, end, n_args, own);
}

brc_status brc_share_launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args)
{
    const shares *h = kernel->device->shares;
    if (!h) return launch(kernel, n_items, n_args, args);
    const brc_array_of items = shared_items(kernel, n_items, n_args, args);
    BRC_TRY(bring(kernel, items, n_args, args));
    if (items == BRC_OF_NOTHING) return launch(kernel, n_items, n_args, args);
    const int64_t first = before_slice(h, items, h->first_slice[h->mine]),
                  end = before_slice(h, items, h->first_slice[h->mine + 1]);
    if (first < end) BRC_TRY(launch_range(kernel, first, end, n_args, args));
    for (int a = 0; a < n_args; ++a)
        if (args[a].kind == BRC_ARG_BUFFER && args[a].value.buffer && writes(kernel->signature.use[a]))
            args[a].value.buffer->where = MINE;
    return BRC_OK;
}
