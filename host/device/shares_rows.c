/* Which rows a rank owns, and which it exchanges with whom. */
#include "shares_internal.h"
#include "../base/memory.h"
#include <stdlib.h>
#include <string.h>

typedef struct brc_shares shares;

/* Sums of a row's numbers and of those of groups are made in blocks of so many (kernels/core/vector.cl). */
enum { SUM_BLOCK = 1024 };

/* ---- ranges ---- */

int64_t brc_share_before(const shares *h, brc_array_of what, int32_t slice)
{
    if (what == BRC_OF_NOTHING) return 0;
    if (what == BRC_OF_SLOTS) return h->slot_start[slice];
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

/* Slices that ranges are whole numbers of: where there are rows enough, blocks of sums belong to one rank each. */
static int32_t unit_of(const shares *h)
{
    const int32_t lanes = h->rows.n_rows / h->rows.n_groups, least = 4 * h->n_ranks;
    const int32_t of_groups = SUM_BLOCK * lanes / h->rows.slice, of_rows = SUM_BLOCK / h->rows.slice;
    if (h->rows.n_slices >= least * of_groups) return of_groups;
    return of_rows > 0 && h->rows.n_slices >= least * of_rows ? of_rows : 1;
}

/* As many slots for each. */
static void cut(shares *h)
{
    const int32_t unit = unit_of(h), n_slices = h->rows.n_slices;
    const int64_t n_slots = h->slot_start[n_slices];
    int32_t slice = 0;
    for (int32_t rank = 1; rank < h->n_ranks; ++rank) {
        while (slice < n_slices) {
            const int32_t next = slice + unit < n_slices ? slice + unit : n_slices;
            const int64_t middle = (h->slot_start[slice] + (int64_t)h->slot_start[next] + 1) / 2;
            if ((unit > 1 ? middle : h->slot_start[next]) * h->n_ranks > n_slots * rank) break;
            slice = next;
        }
        h->first_slice[rank] = slice;
    }
    h->first_slice[h->n_ranks] = n_slices;
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

/* Rows of others that bonds of rank `of` reach: seen [n_rows] marks those that were found for it. give: own rows
 * alone, for it; else those of all, by their owners. */
static brc_status reached(brc_context *context, const shares *h, int32_t of, int32_t *seen, row_list *lists, bool give)
{
    const int64_t begin = (int64_t)h->slot_start[h->first_slice[of]] * h->rows.slice,
                  end = (int64_t)h->slot_start[h->first_slice[of + 1]] * h->rows.slice;
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
static brc_status join(brc_context *context, const shares *h, const row_list *lists, brc_rows_beside *out)
{
    int64_t n = 0;
    for (int32_t k = 0; k < h->n_beside; ++k)
        n += lists[h->beside[k]].n;
    BRC_TRY(BRC_ALLOCATE(context, &out->start, h->n_beside + 1, "rows of other ranks"));
    BRC_TRY(BRC_ALLOCATE(context, &out->row, n + 1, "rows of other ranks"));
    BRC_TRY(BRC_ALLOCATE(context, &out->slots, n + 1, "rows of other ranks"));
    for (int32_t k = 0; k < h->n_beside; ++k) {
        const row_list *list = &lists[h->beside[k]];
        if (list->n > 0) memcpy(out->row + out->start[k], list->row, (size_t)list->n * sizeof *list->row);
        if (list->n > 0) qsort(out->row + out->start[k], (size_t)list->n, sizeof *out->row, ascending);
        out->start[k + 1] = out->start[k] + list->n;
    }
    for (int64_t k = 0; k < n; ++k) {
        const int32_t slice = out->row[k] / h->rows.slice;
        out->slots[k + 1] = out->slots[k] + h->slot_start[slice + 1] - h->slot_start[slice];
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
    BRC_TRY_OR(cleanup, join(context, h, give, &h->give));
    status = join(context, h, take, &h->take);
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

/* ---- what is inside ---- */

static bool is_inside(const shares *h, int32_t slice)
{
    const int32_t first = h->first_slice[h->mine] * h->rows.slice, end = h->first_slice[h->mine + 1] * h->rows.slice;
    for (int64_t k = (int64_t)h->slot_start[slice] * h->rows.slice;
         k < (int64_t)h->slot_start[slice + 1] * h->rows.slice; ++k)
        if (h->rows.neighbour[k] < first || h->rows.neighbour[k] >= end) return false;
    return true;
}

/* The range takes its place among the longest so far, of which the shortest goes where there is no room. */
static void keep_inside(shares *h, brc_inside range)
{
    int32_t shortest = h->n_inside;
    for (int32_t k = 0; k < h->n_inside && h->n_inside == BRC_MOST_INSIDE; ++k)
        if (shortest == h->n_inside ||
            h->inside[k].end - h->inside[k].first < h->inside[shortest].end - h->inside[shortest].first)
            shortest = k;
    if (h->n_inside == BRC_MOST_INSIDE) {
        if (h->inside[shortest].end - h->inside[shortest].first >= range.end - range.first) return;
        memmove(h->inside + shortest, h->inside + shortest + 1,
                (size_t)(h->n_inside - shortest - 1) * sizeof *h->inside);
        --h->n_inside;
    }
    h->inside[h->n_inside++] = range;
}

/* Border slices lie all along a rank's range: ranges shorter than 1/64 of it are not worth a launch. */
static void find_inside(shares *h)
{
    const int32_t first = h->first_slice[h->mine], end = h->first_slice[h->mine + 1], least = (end - first) / 64 + 1;
    for (int32_t slice = first, from = first; slice <= end; ++slice) {
        if (slice < end && is_inside(h, slice)) continue;
        if (slice - from >= least) keep_inside(h, (brc_inside){from, slice});
        from = slice + 1;
    }
}

static brc_status find_slices_here(brc_context *context, shares *h)
{
    BRC_TRY(BRC_ALLOCATE(context, &h->slice_here, h->rows.n_slices, "shares of ranks"));
    for (int32_t slice = h->first_slice[h->mine]; slice < h->first_slice[h->mine + 1]; ++slice)
        h->slice_here[slice] = 1;
    for (int64_t k = 0; k < h->take.start[h->n_beside]; ++k)
        h->slice_here[h->take.row[k] / h->rows.slice] = 1;
    return BRC_OK;
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
    BRC_TRY(BRC_ALLOCATE(context, &h->slot_start, rows->n_slices + 1, "shares of ranks"));
    memcpy(h->slot_start, rows->slot_start, ((size_t)rows->n_slices + 1) * sizeof *h->slot_start);
    BRC_TRY(BRC_ALLOCATE(context, &h->first_slice, n_ranks + 1, "shares of ranks"));
    cut(h);
    double most_local = brc_ranks_here().local_count;
    BRC_TRY(brc_ranks_most(context, 1, &most_local));
    h->ranks_meet = most_local > 1;
    BRC_TRY(find_rows(context, h));
    find_inside(h);
    BRC_TRY(find_slices_here(context, h));
    h->rows.slot_start = h->rows.neighbour = NULL; /* the caller's */
    return BRC_OK;
}

static void free_beside(brc_rows_beside *rows)
{
    brc_memory_free(rows->start);
    brc_memory_free(rows->row);
    brc_memory_free(rows->slots);
}

void brc_shares_free(brc_device *device)
{
    shares *h = device->shares;
    if (!h) return;
    while (h->messages) {
        brc_messages *const m = h->messages;
        h->messages = m->next;
        brc_exchange_free(&m->exchange);
        brc_memory_free(m->send);
        brc_memory_free(m->receive);
        brc_memory_free(m);
    }
    brc_memory_free(h->slice_here);
    brc_memory_free(h->slot_start);
    brc_memory_free(h->first_slice);
    brc_memory_free(h->beside);
    free_beside(&h->give);
    free_beside(&h->take);
    brc_memory_free(h);
    device->shares = NULL;
}

/* ---- sets of rows ---- */

/* The rows that there are, ascending, each once, into `among->row`; returns how many. Many are marked: in dust, sorting
 * them was 6 % of a rank's work. Few are sorted, for all marks are looked at. */
static int32_t put_in_order(const shares *h, brc_rows_among *among, int32_t n, const int32_t *rows)
{
    const int32_t n_rows = h->rows.n_rows;
    int32_t n_there = 0, n_kept = 0;
    for (int32_t k = 0; k < n; ++k)
        if (rows[k] >= 0 && rows[k] < n_rows) among->row[n_there++] = rows[k];
    if (n_there > n_rows / 32) {
        for (int32_t k = 0; k < n_there; ++k)
            among->mark[among->row[k]] = 1;
        for (int32_t row = 0; row < n_rows; ++row) {
            if (among->mark[row]) among->row[n_kept++] = row;
            among->mark[row] = 0;
        }
        return n_kept;
    }
    if (n_there > 0) qsort(among->row, (size_t)n_there, sizeof *among->row, ascending);
    for (int32_t k = 0; k < n_there; ++k)
        if (k == 0 || among->row[k] != among->row[k - 1]) among->row[n_kept++] = among->row[k];
    return n_kept;
}

brc_status brc_rows_among_make(brc_device *device, int32_t n, const int32_t *rows, brc_rows_among **out)
{
    const shares *h = device->shares;
    brc_rows_among *among = *out;
    if (!h) return BRC_OK;
    if (!among) {
        BRC_TRY(BRC_ALLOCATE(device->context, out, 1, "rows of launches"));
        among = *out;
        BRC_TRY(BRC_ALLOCATE(device->context, &among->mark, h->rows.n_rows, "rows of launches"));
        BRC_TRY(BRC_ALLOCATE(device->context, &among->n_of, h->n_ranks, "rows of launches"));
        BRC_TRY(BRC_ALLOCATE(device->context, &among->slots_of, h->n_ranks, "rows of launches"));
    }
    BRC_TRY(brc_memory_resize(device->context, (void **)&among->row, n, sizeof *rows, "rows of launches"));
    BRC_TRY(
        brc_memory_resize(device->context, (void **)&among->slots, n + 1, sizeof *among->slots, "rows of launches"));
    memset(among->n_of, 0, (size_t)h->n_ranks * sizeof *among->n_of);
    memset(among->slots_of, 0, (size_t)h->n_ranks * sizeof *among->slots_of);
    among->n = put_in_order(h, among, n, rows);
    for (int32_t k = 0, owner = 0; k < among->n; ++k) {
        const int32_t slice = among->row[k] / h->rows.slice;
        while (slice >= h->first_slice[owner + 1])
            ++owner;
        const int64_t n_slots = h->slot_start[slice + 1] - h->slot_start[slice];
        among->n_of[owner] += 1;
        among->slots_of[owner] += n_slots;
        among->slots[k + 1] = among->slots[k] + n_slots;
    }
    among->first = brc_rows_among_before(among, h->mine);
    among->number = ++device->shares->n_sets;
    return BRC_OK;
}

int32_t brc_rows_among_before(const brc_rows_among *among, int32_t rank)
{
    int64_t n = 0;
    for (int32_t k = 0; k < rank; ++k)
        n += among->n_of[k];
    return (int32_t)n;
}

void brc_rows_among_free(brc_rows_among **among)
{
    if (!among || !*among) return;
    brc_memory_free((*among)->row);
    brc_memory_free((*among)->slots);
    brc_memory_free((*among)->mark);
    brc_memory_free((*among)->n_of);
    brc_memory_free((*among)->slots_of);
    brc_memory_free((*among)->image);
    brc_memory_free(*among);
    *among = NULL;
}

brc_rows_among *brc_device_keep_among(brc_device *device, brc_rows_among *among)
{
    brc_rows_among *const before = device->shares ? device->shares->among : NULL;
    if (device->shares) device->shares->among = among;
    return before;
}

brc_row_range brc_device_rows_of(const brc_device *device, int32_t rank)
{
    const shares *h = device->shares;
    if (!h) return (brc_row_range){0, INT32_MAX};
    return (brc_row_range){h->first_slice[rank] * h->rows.slice, h->first_slice[rank + 1] * h->rows.slice};
}

brc_row_range brc_device_rows_here(const brc_device *device)
{
    return brc_device_rows_of(device, brc_ranks_mine());
}

bool brc_device_is_shared(const brc_device *device)
{
    return device->shares != NULL;
}
