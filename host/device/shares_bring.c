/* How rows come from the ranks that compute them. */
#include "shares_internal.h"
#include "../base/memory.h"
#include <stdlib.h>
#include <string.h>

typedef struct brc_shares shares;

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

/* ---- messages ---- */

/* Rows, or slots of rows, that one side has of those beside. */
static int64_t things(const brc_rows_beside *rows, int64_t k, bool slots)
{
    return slots ? rows->slots[rows->start[k]] : rows->start[k];
}

static brc_status messages_make(brc_context *context, const shares *h, brc_messages *m)
{
    const brc_rows_beside *from = m->back ? &h->take : &h->give, *to = m->back ? &h->give : &h->take;
    brc_neighbour *beside = NULL;
    BRC_TRY(brc_memory_allocate(context, (void **)&m->send, things(from, h->n_beside, m->of_slots) + 1,
                                (size_t)m->bytes, "messages"));
    BRC_TRY(brc_memory_allocate(context, (void **)&m->receive, things(to, h->n_beside, m->of_slots) + 1,
                                (size_t)m->bytes, "messages"));
    BRC_TRY(BRC_ALLOCATE(context, &beside, h->n_beside + 1, "messages"));
    for (int32_t k = 0; k < h->n_beside; ++k) {
        const int64_t send = things(from, k, m->of_slots), receive = things(to, k, m->of_slots);
        beside[k] = (brc_neighbour){.rank = h->beside[k],
                                    .send = m->send + send * m->bytes,
                                    .send_bytes = (things(from, k + 1, m->of_slots) - send) * m->bytes,
                                    .receive = m->receive + receive * m->bytes,
                                    .receive_bytes = (things(to, k + 1, m->of_slots) - receive) * m->bytes};
    }
    const brc_status status = brc_exchange_create(context, h->n_beside, beside, &m->exchange);
    brc_memory_free(beside);
    return status;
}

static brc_status messages_of(brc_context *context, shares *h, const brc_messages *like, brc_messages **out)
{
    for (brc_messages *m = h->messages; m; m = m->next)
        if (m->bytes == like->bytes && m->of_slots == like->of_slots && m->back == like->back && !m->flying) {
            *out = m;
            return BRC_OK;
        }
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "messages"));
    **out = *like;
    (*out)->next = h->messages;
    h->messages = *out;
    return messages_make(context, h, *out);
}

/* Rows, and slots of those before each. */
typedef struct rows_of {
    const int32_t *row;
    const int64_t *slots;
} rows_of;

/* memcpy of a number, a vector or a tensor without a call. */
static inline void copy(char *to, const char *from, size_t bytes)
{
    switch (bytes) {
    case 4: memcpy(to, from, 4); break;
    case 8: memcpy(to, from, 8); break;
    case 12: memcpy(to, from, 12); break;
    case 24: memcpy(to, from, 24); break;
    case 72: memcpy(to, from, 72); break;
    default: memcpy(to, from, bytes);
    }
}

/* Between the rows of an array, [begin, end) of the list, and a message that has them one after another. Numbers of a
 * slot lie beside those of the other rows of its slice: `each` bytes of a slot of a slice, in parts of one number. */
static void carry(const shares *h, const brc_buffer *buffer, char *image, const rows_of *rows, int64_t begin,
                  int64_t end, char *message, bool into_message)
{
    const int64_t slice = h->rows.slice;
    const bool slots = buffer->of == BRC_OF_SLOTS;
    const size_t bytes = (size_t)(slots ? buffer->number : buffer->each);
    const int64_t parts = slots ? buffer->each / (buffer->number * slice) : 1;
#pragma omp parallel for schedule(static)
    for (int64_t k = begin; k < end; ++k) {
        const int64_t row = rows->row[k], first = slots ? h->slot_start[row / slice] : 0,
                      last = slots ? h->slot_start[row / slice + 1] : 1;
        char *at = message + (slots ? rows->slots[k] * parts : k) * (int64_t)bytes;
        for (int64_t slot = first; slot < last; ++slot)
            for (int64_t part = 0; part < parts; ++part, at += bytes) {
                char *const own = image + (slots ? (slot * parts + part) * slice + row % slice : row) * (int64_t)bytes;
                copy(into_message ? at : own, into_message ? own : at, bytes);
            }
    }
}

/* All rows of those beside. */
static void carry_beside(const shares *h, const brc_buffer *buffer, char *image, const brc_rows_beside *beside,
                         char *message, bool into_message)
{
    const rows_of rows = {beside->row, beside->slots};
    carry(h, buffer, image, &rows, 0, beside->start[h->n_beside], message, into_message);
}

static brc_status exchange(brc_context *context, brc_messages *m)
{
    BRC_TRY(brc_exchange_begin(context, m->exchange));
    return brc_exchange_finish(context, m->exchange);
}

static brc_messages like(const shares *h, const brc_buffer *buffer, bool back)
{
    const bool slots = buffer->of == BRC_OF_SLOTS;
    return (brc_messages){
        .bytes = slots ? buffer->each / h->rows.slice : buffer->each, .of_slots = slots, .back = back};
}

/* What an exchange of an array needs. */
static brc_status open_exchange(brc_buffer *buffer, bool back, brc_messages **m, char **image)
{
    shares *h = buffer->device->shares;
    const brc_messages wanted = like(h, buffer, back);
    BRC_TRY(messages_of(buffer->device->context, h, &wanted, m));
    return open_image(buffer, image);
}

brc_status brc_share_begin_near(brc_buffer *buffer, brc_flight *flight)
{
    const shares *h = buffer->device->shares;
    flight->buffer = buffer;
    BRC_TRY(open_exchange(buffer, false, &flight->messages, &flight->image));
    brc_messages *const m = flight->messages;
    carry_beside(h, buffer, flight->image, &h->give, m->send, true);
    const brc_status status = brc_exchange_begin(buffer->device->context, m->exchange);
    m->flying = status == BRC_OK;
    return m->flying ? BRC_OK : close_image(buffer, flight->image, status);
}

brc_status brc_share_finish_near(brc_flight *flight)
{
    brc_buffer *buffer = flight->buffer;
    const shares *h = buffer->device->shares;
    brc_messages *const m = flight->messages;
    const brc_status status = brc_exchange_finish(buffer->device->context, m->exchange);
    m->flying = false;
    if (status == BRC_OK) carry_beside(h, buffer, flight->image, &h->take, m->receive, false);
    buffer->where = BRC_NEAR;
    return close_image(buffer, flight->image, status);
}

brc_status brc_share_bring_near(brc_buffer *buffer)
{
    brc_flight flight;
    BRC_TRY(brc_share_begin_near(buffer, &flight));
    return brc_share_finish_near(&flight);
}

brc_status brc_share_settle(brc_buffer *buffer)
{
    const shares *h = buffer->device->shares;
    brc_messages *m;
    char *image = NULL;
    if (!h || !buffer->marked) return BRC_OK;
    buffer->marked = false;
    BRC_TRY(open_exchange(buffer, true, &m, &image));
    carry_beside(h, buffer, image, &h->take, m->send, true);
    const brc_status status = exchange(buffer->device->context, m);
    for (int64_t k = 0; status == BRC_OK && k < h->give.start[h->n_beside]; ++k) {
        int32_t *const own = (int32_t *)(void *)image + h->give.row[k];
        const int32_t theirs = ((const int32_t *)(const void *)m->receive)[k];
        *own = theirs > *own ? theirs : *own;
    }
    buffer->where = BRC_MINE;
    return close_image(buffer, image, status);
}

brc_status brc_share_bring_among(brc_buffer *buffer, brc_rows_among *among)
{
    brc_context *context = buffer->device->context;
    const shares *h = buffer->device->shares;
    const bool slots = buffer->of == BRC_OF_SLOTS;
    const int64_t each = slots ? buffer->each / h->rows.slice : buffer->each,
                  all = (slots ? among->slots[among->n] : among->n) * each;
    const int64_t end = among->first + among->n_of[h->mine];
    char *image = NULL;
    if (among->n == 0 || buffer->set == among->number) return BRC_OK;
    if (2 * (int64_t)among->n > h->rows.n_rows) return brc_share_gather(buffer);
    if (among->room < all) {
        among->room = 0;
        BRC_TRY(brc_memory_resize(context, (void **)&among->image, all, 1, "messages"));
        among->room = all;
    }
    BRC_TRY(open_image(buffer, &image));
    const rows_of rows = {among->row, among->slots};
    carry(h, buffer, image, &rows, among->first, end, among->image, true);
    const brc_status status =
        brc_ranks_gather_all(context, among->image + (slots ? among->slots[among->first] : among->first) * each, each,
                             slots ? among->slots_of : among->n_of, among->image);
    if (status == BRC_OK) carry(h, buffer, image, &rows, 0, among->first, among->image, false);
    if (status == BRC_OK) carry(h, buffer, image, &rows, end, among->n, among->image, false);
    buffer->set = among->number;
    return close_image(buffer, image, status);
}

brc_status brc_buffer_bring_ranges(brc_buffer *buffer, int64_t bytes, const int64_t *before, const int32_t *place)
{
    brc_context *context = buffer->device->context;
    const shares *h = buffer->device->shares;
    char *image = NULL;
    if (!h || before[h->n_ranks] == 0) return BRC_OK;
    BRC_LOCAL(context, h->n_ranks, int64_t, n_of, "messages");
    BRC_LOCAL(context, place ? before[h->n_ranks] * bytes : 0, char, packed, "messages");
    for (int32_t rank = 0; rank < h->n_ranks; ++rank)
        n_of[rank] = before[rank + 1] - before[rank];
    BRC_TRY(open_image(buffer, &image));
    char *const all = place ? packed : image;
    for (int64_t k = before[h->mine]; place && k < before[h->mine + 1]; ++k)
        memcpy(packed + k * bytes, image + place[k] * bytes, (size_t)bytes);
    const brc_status status = brc_ranks_gather_all(context, all + before[h->mine] * bytes, bytes, n_of, all);
    for (int64_t k = 0; place && status == BRC_OK && k < before[h->n_ranks]; ++k)
        memcpy(image + place[k] * bytes, packed + k * bytes, (size_t)bytes);
    return close_image(buffer, image, status);
}

/* ---- the whole array ---- */

static int64_t before(const shares *h, const brc_buffer *buffer, int32_t rank)
{
    const int32_t slice = h->first_slice[rank];
    if (buffer->of != BRC_OF_BLOCKS) return brc_share_before(h, buffer->of, slice);
    const int64_t number = (int64_t)slice * h->rows.slice * buffer->numbers / h->rows.n_rows;
    return (number + buffer->block - 1) / buffer->block;
}

brc_status brc_share_gather(brc_buffer *buffer)
{
    brc_context *context = buffer->device->context;
    const shares *h = buffer->device->shares;
    brc_status status = BRC_OK;
    int64_t *n_of = NULL;
    char *image = NULL;
    if (!h) return BRC_OK;
    BRC_TRY(brc_share_settle(buffer));
    if (buffer->where == BRC_EVERYWHERE) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &n_of, h->n_ranks, "shares of ranks"));
    for (int32_t rank = 0; rank < h->n_ranks; ++rank)
        n_of[rank] = before(h, buffer, rank + 1) - before(h, buffer, rank);
    BRC_TRY_OR(cleanup, open_image(buffer, &image));
    status =
        brc_ranks_gather_all(context, image + before(h, buffer, h->mine) * buffer->each, buffer->each, n_of, image);
    buffer->where = BRC_EVERYWHERE;
    buffer->filled = true;
    status = close_image(buffer, image, status);
cleanup:
    brc_memory_free(n_of);
    return status;
}

brc_status brc_share_copy(brc_buffer *to, brc_buffer *from, int64_t bytes)
{
    const shares *h = to->device->shares;
    if (!h) return BRC_OK;
    BRC_TRY(brc_share_settle(from));
    const bool alike = from->of != BRC_OF_NOTHING && from->of != BRC_OF_BLOCKS && from->of != BRC_OF_LOOSE &&
                       to->of == from->of && to->each == from->each &&
                       bytes >= before(h, from, h->n_ranks) * from->each;
    if (!alike) {
        BRC_TRY(brc_share_gather(from));
        return brc_share_gather(to);
    }
    to->where = from->where;
    to->marked = false;
    return BRC_OK;
}
