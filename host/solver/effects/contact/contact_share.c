/* Which pairs are evaluated here (device/shares.h): those with an element that is computed here, whose results it
 * takes, and those with strikers, whose loads are sums of all. Of the others results and histories are out of date,
 * until all are asked for. */
#include "contact_internal.h"
#include "../../../device/shares.h"

struct brc_contact_share {
    int32_t n_pairs, n_own, n_todo;
    int64_t room;
    int32_t *ends;            /* [n_pairs][2] */
    int32_t *number;          /* [room] of pairs, before it goes to the device */
    brc_buffer *own, *todo;   /* [room] pairs; of those that breaks may have changed */
    brc_rows_among *crossing; /* their elements that are computed elsewhere too */
};

brc_status brc_contact_share_list(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = c->now.n_listed;
    if (!brc_device_is_shared(s->device)) return BRC_OK;
    BRC_LOCAL(s->context, n, int32_t, rows, "elements of contact");
    BRC_TRY(brc_buffer_read(c->now.list, 0, rows, n * (int64_t)sizeof *rows));
    return brc_rows_among_make(s->device, n, rows, &c->listed);
}

void brc_contact_share_free(brc_contact_state *c)
{
    struct brc_contact_share *h = c->share;
    if (!h) return;
    brc_buffer_free(&h->own);
    brc_buffer_free(&h->todo);
    brc_rows_among_free(&h->crossing);
    brc_memory_free(h->ends);
    brc_memory_free(h->number);
    brc_memory_free(h);
    c->share = NULL;
}

static brc_status make_room(brc_simulation *s, struct brc_contact_share *h, int64_t n)
{
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->ends, 2 * n, sizeof *h->ends, "pairs"));
    if (h->own && n <= h->room) return BRC_OK;
    h->room = n + n / 8 + 1; /* as those of the list */
    BRC_TRY(brc_memory_resize(s->context, (void **)&h->number, h->room, sizeof *h->number, "pairs"));
    brc_buffer_free(&h->own);
    brc_buffer_free(&h->todo);
    BRC_TRY(brc_buffer_create(s->device, &h->own, 4 * h->room, "pairs"));
    brc_buffer_is_of(h->own, BRC_OF_LOOSE, 4, 4);
    BRC_TRY(brc_buffer_create(s->device, &h->todo, 4 * h->room, "pairs"));
    brc_buffer_is_of(h->todo, BRC_OF_LOOSE, 4, 4);
    return BRC_OK;
}

static bool is_own(const brc_simulation *s, const struct brc_contact_share *h, int32_t p)
{
    const int32_t i = h->ends[2 * (int64_t)p], j = h->ends[2 * (int64_t)p + 1];
    return j >= s->layout->n_rows || brc_device_has_row(s->device, i) || brc_device_has_row(s->device, j);
}

/* Elements of pairs that several ranks evaluate; in place of the ends, -1: none. */
static brc_status find_crossing(brc_simulation *s, struct brc_contact_share *h)
{
    const int32_t n = s->layout->n_rows;
    BRC_LOCAL(s->context, 2 * (int64_t)h->n_pairs, int32_t, rows, "pairs");
    for (int64_t p = 0; p < h->n_pairs; ++p) {
        const int32_t i = h->ends[2 * p], j = h->ends[2 * p + 1];
        const bool crosses = j >= n || !brc_device_rows_together(s->device, i, j);
        rows[2 * p] = crosses ? i : -1;
        rows[2 * p + 1] = crosses && j < n ? j : -1;
    }
    return brc_rows_among_make(s->device, 2 * h->n_pairs, rows, &h->crossing);
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
    h->n_own = h->n_todo = 0;
    BRC_TRY(brc_buffer_read(c->now.ends, 0, h->ends, 8 * (int64_t)n));
    for (int32_t p = 0; p < n; ++p)
        if (is_own(s, h, p)) h->number[h->n_own++] = p;
    BRC_TRY(brc_upload_int(h->own, h->number, h->n_own));
    return find_crossing(s, h);
}

brc_status brc_contact_share_todo(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    struct brc_contact_share *h = c->share;
    if (!brc_device_is_shared(s->device) || c->n_todo == 0) return BRC_OK;
    h->n_todo = 0;
    BRC_TRY(brc_buffer_read(c->todo, 0, h->number, 4 * (int64_t)c->n_todo));
    for (int32_t k = 0; k < c->n_todo; ++k)
        if (is_own(s, h, h->number[k])) h->number[h->n_todo++] = h->number[k];
    return brc_upload_int(h->todo, h->number, h->n_todo);
}

brc_contact_items brc_contact_items_of(const brc_simulation *s, bool whole)
{
    const brc_contact_state *c = s->contact;
    const struct brc_contact_share *h = c->share;
    if (!brc_device_is_shared(s->device))
        return (brc_contact_items){whole ? c->now.n_pairs : c->n_todo, c->todo, whole, NULL};
    return (brc_contact_items){whole ? h->n_own : h->n_todo, whole ? h->own : h->todo, false, h->crossing};
}

brc_status brc_contact_bring_pairs(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const struct brc_contact_share *h = c->share;
    const int64_t state = brc_state_bytes(s);
    if (!brc_device_is_shared(s->device) || c->now.n_pairs == 0) return BRC_OK;
    BRC_LOCAL(s->context, h->n_pairs, int32_t, row, "pairs");
    for (int64_t p = 0; p < h->n_pairs; ++p)
        row[p] = h->ends[2 * p];
    BRC_TRY(brc_buffer_bring_items(c->touch, 4, h->n_pairs, row));
    BRC_TRY(brc_buffer_bring_items(c->result, (BRC_CONTACT_RESULT + 2 * c->width) * state, h->n_pairs, row));
    return brc_buffer_bring_items(c->now.history, BRC_CONTACT_HISTORY * state, h->n_pairs, row);
}
