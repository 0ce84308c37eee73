/* What a launch of several ranks does, and what it reads. */
#include "shares_internal.h"
#include <string.h>

typedef struct brc_shares shares;

static bool writes(brc_use use)
{
    return use == BRC_USE_PUT || use == BRC_USE_UPDATE;
}

static bool flags(brc_use use)
{
    return use == BRC_USE_FLAG || use == BRC_USE_SPREAD;
}

/* A launch, and how ranks share it. */
typedef struct shared {
    const brc_kernel *kernel;
    int n_args;
    const brc_arg *args;
    enum {
        ALIKE,
        OWN_ITEMS,
        LISTED,
        AMONG
    } way; /* all do all; own items; own rows are right, whoever does others; all do all, own rows are right, and
            * what is not of rows is right everywhere */
    brc_array_of items;
    int64_t first, end;     /* own items; of a list, those that have own rows */
    int64_t numbers, block; /* BRC_OF_BLOCKS: numbers in all and of a block */
    int n_flying;           /* arrays whose rows of others come while the inside is computed */
    brc_flight flying[BRC_KERNEL_MOST_ARGS];
} shared;

static brc_buffer *buffer_of(const shared *l, int a)
{
    return l->args[a].kind == BRC_ARG_BUFFER ? l->args[a].value.buffer : NULL;
}

/* Every array that is written lies in rows, and is written at own ones; may_flag: or at others by flags. */
static bool writes_rows(const shared *l, bool may_flag)
{
    for (int a = 0; a < l->n_args; ++a) {
        const brc_use use = l->kernel->signature.use[a];
        const brc_buffer *const buffer = buffer_of(l, a);
        if (use == BRC_USE_SCATTER || (flags(use) && !may_flag)) return false;
        if (buffer && writes(use) && (buffer->of == BRC_OF_NOTHING || buffer->of == BRC_OF_BLOCKS)) return false;
        if (buffer && flags(use) && (buffer->of != BRC_OF_ROWS || buffer->each != sizeof(int32_t))) return false;
    }
    return true;
}

/* ---- own items ---- */

static bool own_rows(shared *l, int64_t n_items)
{
    const shares *h = l->kernel->device->shares;
    const bool of_groups = l->items == BRC_OF_GROUPS;
    if (n_items != (of_groups ? h->rows.n_groups : h->rows.n_rows) || !writes_rows(l, true)) return false;
    l->first = brc_share_before(h, l->items, h->first_slice[h->mine]);
    l->end = brc_share_before(h, l->items, h->first_slice[h->mine + 1]);
    return true;
}

/* Numbers of rows, as many of each. */
static bool own_numbers(shared *l, int64_t n_items)
{
    const shares *h = l->kernel->device->shares;
    const int64_t width = n_items / h->rows.n_rows;
    if (width < 1 || n_items % h->rows.n_rows != 0) return false;
    for (int a = 0; a < l->n_args; ++a) {
        const brc_buffer *const buffer = buffer_of(l, a);
        const brc_use use = l->kernel->signature.use[a];
        if (use == BRC_USE_SCATTER || use == BRC_USE_GATHER || flags(use)) return false;
        if (buffer && (buffer->of != BRC_OF_ROWS || buffer->each != width * buffer->number)) return false;
    }
    l->first = width * brc_share_before(h, BRC_OF_ROWS, h->first_slice[h->mine]);
    l->end = width * brc_share_before(h, BRC_OF_ROWS, h->first_slice[h->mine + 1]);
    return true;
}

/* Blocks of the numbers of rows or groups, which begin where ranges of ranks do. What is written is of blocks. */
static bool own_blocks(shared *l, int64_t n_items)
{
    const shares *h = l->kernel->device->shares;
    const int64_t n = l->n_args > 1 && l->args[1].kind == BRC_ARG_INT ? l->args[1].value.integer : 0;
    if (n_items < 2 || n < n_items || (n % h->rows.n_rows != 0 && n != h->rows.n_groups)) return false;
    int64_t block = 1;
    while ((n + block - 1) / block > n_items)
        block *= 2;
    if ((n + block - 1) / block != n_items) return false;
    for (int32_t rank = 1; rank < h->n_ranks; ++rank)
        if ((int64_t)h->first_slice[rank] * h->rows.slice * n / h->rows.n_rows % block != 0 &&
            h->first_slice[rank] < h->rows.n_slices)
            return false;
    for (int a = 0; a < l->n_args; ++a) {
        const brc_use use = l->kernel->signature.use[a];
        const brc_buffer *const buffer = buffer_of(l, a);
        const bool of_blocks = buffer && (buffer->of == BRC_OF_NOTHING || buffer->of == BRC_OF_BLOCKS);
        if (use == BRC_USE_SCATTER || flags(use)) return false;
        if (buffer && writes(use) && (!of_blocks || buffer->each == 0)) return false;
        if (buffer && !writes(use) && buffer->of == BRC_OF_SLOTS) return false;
    }
    const int64_t from = (int64_t)h->first_slice[h->mine] * h->rows.slice * n / h->rows.n_rows,
                  to = (int64_t)h->first_slice[h->mine + 1] * h->rows.slice * n / h->rows.n_rows;
    l->first = (from + block - 1) / block;
    l->end = (to + block - 1) / block;
    l->numbers = n;
    l->block = block;
    return true;
}

/* ---- which of them it is ---- */

/* A list of rows that is the same on all ranks. */
static bool has_list(const shared *l)
{
    const int at = l->kernel->signature.list;
    const brc_buffer *const list = at > 0 && at < l->n_args ? buffer_of(l, at) : NULL;
    return list && list->where == BRC_EVERYWHERE;
}

/* How many of n ascending rows are below one. */
static int64_t rows_below(const int32_t *row, int64_t n, int32_t bound)
{
    int64_t low = 0;
    while (low < n) {
        const int64_t middle = (low + n) / 2;
        if (row[middle] < bound)
            low = middle + 1;
        else
            n = middle;
    }
    return low;
}

/* Of a list that items take several rows of (PASS of kernels.h), where the host sees it, those items that have own
 * rows; else all. */
static void find_listed(shared *l, int64_t n_items)
{
    const brc_device *device = l->kernel->device;
    const shares *h = device->shares;
    const int64_t n = l->args[1].kind == BRC_ARG_INT ? l->args[1].value.integer : 0, lanes = device->lanes;
    l->end = n_items;
    if (l->kernel->signature.list != 2 || device->info.kind != BRC_DEVICE_CPU || (n + lanes - 1) / lanes != n_items)
        return;
    const int32_t *const row = buffer_of(l, 2)->memory;
    l->first = rows_below(row, n, h->first_slice[h->mine] * h->rows.slice) / lanes;
    l->end = (rows_below(row, n, h->first_slice[h->mine + 1] * h->rows.slice) + lanes - 1) / lanes;
}

/* Rows of others than the set are written. */
static bool scatters_rows(const shared *l)
{
    for (int a = 0; a < l->n_args; ++a) {
        const brc_use use = l->kernel->signature.use[a];
        const brc_buffer *const buffer = buffer_of(l, a);
        if (buffer && (use == BRC_USE_SCATTER || flags(use)) && buffer->of != BRC_OF_NOTHING) return true;
    }
    return false;
}

static void find_way(shared *l, int64_t n_items)
{
    const shares *h = l->kernel->device->shares;
    l->way = ALIKE;
    l->items = l->kernel->signature.items;
    const bool own = l->items == BRC_OF_BLOCKS                              ? own_blocks(l, n_items)
                     : l->items == BRC_OF_NUMBERS                           ? own_numbers(l, n_items)
                     : l->items == BRC_OF_ROWS || l->items == BRC_OF_GROUPS ? own_rows(l, n_items)
                                                                            : false;
    if (own)
        l->way = OWN_ITEMS;
    else if (l->items == BRC_OF_NOTHING && has_list(l) && writes_rows(l, false)) {
        l->way = LISTED;
        find_listed(l, n_items);
    } else if (h->among && !scatters_rows(l))
        l->way = AMONG;
}

/* ---- what it reads ---- */

/* Rows of others: at once, or while rows inside are computed. Between ranks of one machine a message is a copy that
 * processors make, and nothing flies; images of other devices are copies, made whole. */
static brc_status bring_beside(shared *l, brc_use use, brc_buffer *buffer)
{
    for (int k = 0; k < l->n_flying; ++k)
        if (l->flying[k].buffer == buffer) return BRC_OK;
    if (use != BRC_USE_GATHER || (l->items != BRC_OF_ROWS && l->items != BRC_OF_GROUPS) ||
        buffer->device->info.kind != BRC_DEVICE_CPU || !brc_ranks_here().far)
        return brc_share_bring_near(buffer);
    BRC_TRY(brc_share_begin_near(buffer, &l->flying[l->n_flying]));
    ++l->n_flying;
    return BRC_OK;
}

/* One array before the launch. */
static brc_status bring_one(shared *l, brc_use use, brc_buffer *buffer, bool only_rows)
{
    const shares *h = l->kernel->device->shares;
    const bool near = buffer->of == BRC_OF_ROWS || (buffer->of == BRC_OF_SLOTS && buffer->number > 0);
    if (use != BRC_USE_FLAG || l->way != OWN_ITEMS) BRC_TRY(brc_share_settle(buffer));
    if (buffer->where == BRC_EVERYWHERE || use == BRC_USE_VALUE) return BRC_OK;
    if (l->way == ALIKE || buffer->of == BRC_OF_BLOCKS) {
        if (l->way == OWN_ITEMS && l->items == BRC_OF_BLOCKS && writes(use)) {
            if (use == BRC_USE_UPDATE && (buffer->numbers != l->numbers || buffer->block != l->block))
                return brc_share_gather(buffer);
            return BRC_OK;
        }
        return brc_share_gather(buffer);
    }
    if (l->way == AMONG) {
        /* slots of what the rows of the set reach are not in the set */
        if (!near || (buffer->of == BRC_OF_SLOTS && use == BRC_USE_GATHER)) return brc_share_gather(buffer);
        return writes(use) && only_rows ? BRC_OK : brc_share_bring_among(buffer, h->among);
    }
    if (use != BRC_USE_GATHER && !flags(use)) return BRC_OK;
    if (!near) return brc_share_gather(buffer);
    return buffer->where == BRC_MINE ? bring_beside(l, use, buffer) : BRC_OK;
}

static brc_status bring(shared *l)
{
    const bool only_rows = writes_rows(l, false);
    for (int a = 0; a < l->n_args; ++a)
        if (buffer_of(l, a)) BRC_TRY(bring_one(l, l->kernel->signature.use[a], buffer_of(l, a), only_rows));
    return BRC_OK;
}

/* ---- what it leaves ---- */

static void leave(const shared *l)
{
    const bool only_rows = writes_rows(l, false);
    for (int a = 0; a < l->n_args; ++a) {
        brc_buffer *const buffer = buffer_of(l, a);
        const brc_use use = l->kernel->signature.use[a];
        if (buffer && brc_use_writes(use)) buffer->set = 0;
        if (!buffer || l->way == ALIKE) continue;
        if (flags(use)) {
            buffer->where = BRC_NEAR;
            buffer->marked = true;
        } else if (writes(use) && l->way == OWN_ITEMS && l->items == BRC_OF_BLOCKS) {
            buffer->of = BRC_OF_BLOCKS;
            buffer->numbers = l->numbers;
            buffer->block = l->block;
            buffer->where = BRC_MINE;
        } else if (writes(use) && buffer->of != BRC_OF_NOTHING && buffer->of != BRC_OF_LOOSE &&
                   (l->way != AMONG || only_rows)) {
            buffer->where = BRC_MINE;
            if (buffer->filled) brc_share_give_back(buffer);
        }
    }
}

/* ---- launches ---- */

static brc_status launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args)
{
    return kernel->device->backend->launch(kernel, 0, n_items, n_args, args);
}

/* Items [first, end); their bound is the first argument. */
static brc_status launch_range(brc_kernel *kernel, const shared *l, int64_t first, int64_t end)
{
    brc_arg own[BRC_KERNEL_MOST_ARGS];
    if (first >= end) return BRC_OK;
    memcpy(own, l->args, (size_t)l->n_args * sizeof *own);
    own[0] = BRC_INT((int32_t)end);
    return kernel->device->backend->launch(kernel, first, end, l->n_args, own);
}

/* Own items; where rows of others are on their way, those inside first, and what lies between them when all are there.
 */
static brc_status launch_own(brc_kernel *kernel, shared *l)
{
    const shares *h = kernel->device->shares;
    brc_context *context = kernel->device->context;
    brc_status status = BRC_OK;
    if (l->n_flying == 0) return launch_range(kernel, l, l->first, l->end);
    for (int32_t k = 0; status == BRC_OK && k < h->n_inside; ++k) {
        status = launch_range(kernel, l, brc_share_before(h, l->items, h->inside[k].first),
                              brc_share_before(h, l->items, h->inside[k].end));
        for (int m = 0; status == BRC_OK && m < l->n_flying; ++m)
            status = brc_exchange_poke(context, l->flying[m].messages->exchange);
    }
    for (int m = 0; m < l->n_flying; ++m) {
        const brc_status came = brc_share_finish_near(&l->flying[m]);
        if (status == BRC_OK) status = came;
    }
    int64_t from = l->first;
    for (int32_t k = 0; status == BRC_OK && k < h->n_inside; ++k) {
        status = launch_range(kernel, l, from, brc_share_before(h, l->items, h->inside[k].first));
        from = brc_share_before(h, l->items, h->inside[k].end);
    }
    return status == BRC_OK ? launch_range(kernel, l, from, l->end) : status;
}

bool brc_share_waits(const brc_device *device)
{
    return device->shares && device->shares->among;
}

brc_status brc_share_launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args)
{
    if (!kernel->device->shares) return launch(kernel, n_items, n_args, args);
    shared l = {.kernel = kernel, .n_args = n_args, .args = args};
    kernel->device->shares->n_launches += 1;
    find_way(&l, n_items);
    BRC_TRY(bring(&l));
    if (l.way == LISTED)
        BRC_TRY(launch_range(kernel, &l, l.first, l.end));
    else if (n_items > 0)
        BRC_TRY(l.way == OWN_ITEMS ? launch_own(kernel, &l) : launch(kernel, n_items, n_args, args));
    leave(&l);
    return BRC_OK;
}
