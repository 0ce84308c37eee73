/* Which pairs are looked for and evaluated here (device/shares.h). A rank looks for those of its own elements, whose
 * slots follow one another in the list, and what it finds goes to all: the list is the same on every rank. It evaluates
 * those of which the lower id is one of its elements; pairs of a rank follow one another. Results of those that touch
 * elements of other ranks or strikers then go to all. Of the others results, and of all others histories are out of
 * date, until they are asked for. */
#include "contact_internal.h"
#include "../../../base/ranks.h"
#include "../../../device/shares.h"

struct brc_contact_share {
    int32_t n_pairs, n_own, n_todo;
    int64_t room;
    int32_t *ends;            /* [n_pairs][2] */
    int64_t *before;          /* [ranks + 1] pairs of the ranks before */
    int64_t *sent_before;     /* [ranks + 1] of those whose results go to all */
    int32_t *sent;            /* [room] numbers of these */
    int32_t *number;          /* [room] of pairs, before it goes to the device */
    brc_buffer *own, *todo;   /* [room] pairs; of those that breaks may have changed */
    brc_rows_among *crossing; /* elements of pairs of two ranks */
};

brc_status brc_contact_share_list(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = c->now.n_listed;
    if (!brc_device_is_shared(s->device)) return BRC_OK;
    BRC_LOCAL(s->context, n, int32_t, rows, "elements of contact");
    BRC_TRY(brc_buffer_read(c->now.list, 0, rows, n * (int64_t)sizeof *rows));
    BRC_TRY(brc_rows_among_make(s->device, n, rows, &c->listed));
    brc_buffer *const of_each[] = {c->redo, c->count, c->owned, c->now.used, c->now.with_pairs};
    for (size_t k = 0; k < sizeof of_each / sizeof *of_each; ++k)
        brc_buffer_is_of(of_each[k], BRC_OF_LOOSE, 4, 4);
    return BRC_OK;
}

/* ---- the search ---- */

/* Of ascending numbers [from, to) of a list those in [first, end). */
static void keep_within(const int32_t *number, int64_t first, int64_t end, int32_t *from, int32_t *to)
{
    while (*from < *to && number[*from] < first)
        ++*from;
    while (*to > *from && number[*to - 1] >= end)
        --*to;
}

brc_status brc_contact_keep_slots(brc_simulation *s, brc_buffer *list, int64_t *n)
{
    const brc_rows_among *listed = s->contact->listed;
    const int32_t mine = brc_ranks_mine();
    int32_t from = 0, to = (int32_t)*n;
    if (!brc_device_is_shared(s->device) || *n == 0) return BRC_OK;
    BRC_LOCAL(s->context, *n, int32_t, slot, "elements of contact");
    BRC_TRY(brc_buffer_read(list, 0, slot, *n * (int64_t)sizeof *slot));
    keep_within(slot, brc_rows_among_before(listed, mine), brc_rows_among_before(listed, mine + 1), &from, &to);
    *n = to - from;
    return brc_upload_int(list, slot + from, *n);
}

/* Where slots of each rank begin. */
static brc_status find_slots(const brc_simulation *s, int64_t **out)
{
    const int32_t n_ranks = brc_ranks_count();
    BRC_TRY(BRC_ALLOCATE(s->context, out, n_ranks + 1, "elements of contact"));
    for (int32_t rank = 0; rank <= n_ranks; ++rank)
        (*out)[rank] = brc_rows_among_before(s->contact->listed, rank);
    return BRC_OK;
}

brc_status brc_contact_bring_counts(brc_simulation *s)
{
    BRC_FREED int64_t *slots = NULL;
    if (!brc_device_is_shared(s->device)) return BRC_OK;
    BRC_TRY(find_slots(s, &slots));
    return brc_buffer_bring_ranges(s->contact->count, 4, slots, NULL);
}

brc_status brc_contact_bring_entries(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    brc_buffer *const of_each[] = {c->count, c->owned, c->now.used};
    BRC_FREED int64_t *slots = NULL;
    if (!brc_device_is_shared(s->device)) return BRC_OK;
    BRC_TRY(find_slots(s, &slots));
    for (size_t k = 0; k < sizeof of_each / sizeof *of_each; ++k)
        BRC_TRY(brc_buffer_bring_ranges(of_each[k], 4, slots, NULL));
    for (int32_t rank = 0; rank <= brc_ranks_count(); ++rank) {
        int32_t start;
        BRC_TRY(brc_buffer_read(c->now.start, 4 * slots[rank], &start, 4));
        slots[rank] = start;
    }
    return brc_buffer_bring_ranges(c->now.entry, 4, slots, NULL);
}

brc_status brc_contact_run_gather(const brc_simulation *s, const brc_pass *pass, const brc_force_request *request,
                                  const brc_given *given)
{
    const brc_contact_state *c = s->contact;
    brc_rows_among *const outer = brc_device_keep_among(s->device, c->listed); /* some ranks may have none */
    const brc_status status = brc_pass_run_on(pass, c->now.n_with_pairs, request, NULL, given);
    brc_device_keep_among(s->device, outer);
    return status;
}

/* ---- pairs ---- */

void brc_contact_share_free(brc_contact_state *c)
{
    struct brc_contact_share *h = c->share;
    if (!h) return;
    brc_buffer_free(&h->own);
    brc_buffer_free(&h->todo);
    brc_rows_among_free(&h->crossing);
    brc_memory_free(h->ends);
    brc_memory_free(h->before);
    brc_memory_free(h->sent_before);
    brc_memory_free(h->sent);
    brc_memory_free(h->number);
    brc_memory_free(h);
    c->share = NULL;
}

static brc_status make_room(brc_simulation *s, struct brc_contact_share *h, int64_t n)
{
    const int32_t n_ranks = brc_ranks_count();
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->before, n_ranks + 1, sizeof *h->before, "pairs"));
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->sent_before, n_ranks + 1, sizeof *h->before, "pairs"));
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->ends, 2 * n, sizeof *h->ends, "pairs"));
    if (h->own && n <= h->room) return BRC_OK;
    h->room = n + n / 8 + 1; /* as those of the list */
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->number, h->room, sizeof *h->number, "pairs"));
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->sent, h->room, sizeof *h->sent, "pairs"));
    brc_buffer_free(&h->own);
    brc_buffer_free(&h->todo);
    BRC_TRY(brc_buffer_create(s->device, &h->own, 4 * h->room, "pairs"));
    brc_buffer_is_of(h->own, BRC_OF_LOOSE, 4, 4);
    BRC_TRY(brc_buffer_create(s->device, &h->todo, 4 * h->room, "pairs"));
    brc_buffer_is_of(h->todo, BRC_OF_LOOSE, 4, 4);
    return BRC_OK;
}

/* Whose pairs are whose, and which are sent; elements of those of two ranks. */
static brc_status sort_pairs(brc_simulation *s, struct brc_contact_share *h)
{
    const int32_t n = s->layout->n_rows, n_ranks = brc_ranks_count();
    brc_row_range range = {0, 0};
    int32_t rank = -1, n_crossing = 0;
    int64_t n_sent = 0;
    BRC_LOCAL(s->context, 2 * (int64_t)h->n_pairs, int32_t, rows, "pairs");
    for (int64_t p = 0; p <= h->n_pairs; ++p) {
        const int32_t i = p < h->n_pairs ? h->ends[2 * p] : INT32_MAX; /* ascends */
        while (rank < n_ranks && i >= range.end) {
            h->before[++rank] = p;
            h->sent_before[rank] = n_sent;
            if (rank < n_ranks) range = brc_device_rows_of(s->device, rank);
        }
        const int32_t j = p < h->n_pairs ? h->ends[2 * p + 1] : range.first;
        if (j >= range.first && j < range.end) continue;
        h->sent[n_sent++] = (int32_t)p;
        if (j >= n) continue;
        rows[n_crossing++] = i;
        rows[n_crossing++] = j;
    }
    return brc_rows_among_make(s->device, n_crossing, rows, &h->crossing);
}

brc_status brc_contact_share_pairs(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = c->now.n_pairs;
    if (!brc_device_is_shared(s->device) || n == 0) return BRC_OK;
    if (!c->share) BRC_TRY(BRC_ALLOCATE(s->context, &c->share, 1, "pairs"));
    struct brc_contact_share *h = c->share;
    BRC_TRY(make_room(s, h, n));
    h->n_pairs = n;
    h->n_todo = 0;
    BRC_TRY(brc_buffer_read(c->now.ends, 0, h->ends, 8 * (int64_t)n));
    BRC_TRY(sort_pairs(s, h));
    const int32_t first = (int32_t)h->before[brc_ranks_mine()];
    h->n_own = (int32_t)h->before[brc_ranks_mine() + 1] - first;
    for (int32_t k = 0; k < h->n_own; ++k)
        h->number[k] = first + k;
    return brc_upload_int(h->own, h->number, h->n_own);
}

brc_status brc_contact_share_todo(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    struct brc_contact_share *h = c->share;
    int32_t from = 0, to = c->n_todo;
    if (!brc_device_is_shared(s->device) || c->n_todo == 0) return BRC_OK;
    BRC_TRY(brc_buffer_read(c->todo, 0, h->number, 4 * (int64_t)c->n_todo));
    keep_within(h->number, h->before[brc_ranks_mine()], h->before[brc_ranks_mine() + 1], &from, &to);
    h->n_todo = to - from;
    return brc_upload_int(h->todo, h->number + from, h->n_todo);
}

brc_contact_items brc_contact_items_of(const brc_simulation *s, bool whole)
{
    const brc_contact_state *c = s->contact;
    const struct brc_contact_share *h = c->share;
    if (!brc_device_is_shared(s->device))
        return (brc_contact_items){whole ? c->now.n_pairs : c->n_todo, c->todo, whole, NULL};
    return (brc_contact_items){whole ? h->n_own : h->n_todo, whole ? h->own : h->todo, false, h->crossing};
}

static int64_t result_bytes(const brc_simulation *s)
{
    return (BRC_CONTACT_RESULT + 2 * s->contact->width) * (int64_t)brc_state_bytes(s);
}

brc_status brc_contact_bring_pairs(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const struct brc_contact_share *h = c->share;
    if (!brc_device_is_shared(s->device) || c->now.n_pairs == 0) return BRC_OK;
    BRC_TRY(brc_buffer_bring_ranges(c->touch, 4, h->before, NULL));
    BRC_TRY(brc_buffer_bring_ranges(c->result, result_bytes(s), h->before, NULL));
    return brc_buffer_bring_ranges(c->now.history, BRC_CONTACT_HISTORY * brc_state_bytes(s), h->before, NULL);
}

brc_status brc_contact_bring_sent(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const struct brc_contact_share *h = c->share;
    const int32_t n_ranks = brc_ranks_count();
    if (!brc_device_is_shared(s->device) || c->now.n_pairs == 0) return BRC_OK;
    BRC_TRY(brc_buffer_bring_ranges(c->touch, 4, h->sent_before, h->sent));
    BRC_LOCAL(s->context, n_ranks + 1, int64_t, before, "pairs");
    BRC_LOCAL(s->context, h->n_pairs, int32_t, touch, "pairs");
    BRC_TRY(brc_buffer_read(c->touch, 0, touch, 4 * (int64_t)h->n_pairs));
    for (int32_t rank = 0; rank < n_ranks; ++rank) {
        before[rank + 1] = before[rank];
        for (int64_t k = h->sent_before[rank]; k < h->sent_before[rank + 1]; ++k)
            if (touch[h->sent[k]]) h->number[before[rank + 1]++] = h->sent[k];
    }
    return brc_buffer_bring_ranges(c->result, result_bytes(s), before, h->number);
}
