/* Arrays between the device's order and that of ids, on their way to a store and back. */
#include "../../base/file.h"
#include "state_store.h"
#include "core_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int brc_stored_type_bytes(brc_stored_type type)
{
    static const int bytes[] = {[BRC_STORED_DOUBLE] = 8, [BRC_STORED_FLOAT] = 4, [BRC_STORED_INT32] = 4,
                                [BRC_STORED_INT64] = 8,  [BRC_STORED_BYTE] = 1,  [BRC_STORED_SAMPLE] = 8};
    return bytes[type];
}

brc_status brc_store_double(brc_state_store *store, const char *name, double *value)
{
    return store->numbers(store, name, BRC_STORED_DOUBLE, 1, 1, value);
}
brc_status brc_store_sample(brc_state_store *store, const char *name, double *value)
{
    return store->numbers(store, name, BRC_STORED_SAMPLE, 1, 1, value);
}
brc_status brc_store_integer(brc_state_store *store, const char *name, int64_t *value)
{
    return store->numbers(store, name, BRC_STORED_INT64, 1, 1, value);
}
brc_status brc_store_index(brc_state_store *store, const char *name, int32_t *value)
{
    return store->numbers(store, name, BRC_STORED_INT32, 1, 1, value);
}

brc_status brc_store_flag(brc_state_store *store, const char *name, bool *value)
{
    int32_t number = *value;
    BRC_TRY(brc_store_index(store, name, &number));
    *value = number != 0;
    return BRC_OK;
}

brc_status brc_store_text(brc_state_store *store, const char *name, char *text, int64_t room)
{
    const size_t length = strnlen(text, (size_t)room);
    if (!store->loading) memset(text + length, 0, (size_t)room - length);
    BRC_TRY(store->numbers(store, name, BRC_STORED_BYTE, room, 1, text));
    text[room - 1] = '\0';
    return BRC_OK;
}

brc_status brc_store_array(brc_context *context, brc_state_store *store, const char *name, brc_stored_type type,
                           int32_t columns, int64_t *n, void **data)
{
    if (store->loading) {
        int64_t rows;
        BRC_TRY(store->count(store, name, &rows));
        BRC_TRY(brc_memory_resize(context, data, rows * columns, brc_stored_type_bytes(type), name));
        *n = rows;
    }
    return store->numbers(store, name, type, *n, columns, *data);
}

static brc_stored_type type_of(const brc_simulation *s, brc_number_kind kind)
{
    const brc_precision precision = brc_device_get_precision(s->device);
    if (kind == BRC_OF_INT) return BRC_STORED_INT32;
    return (kind == BRC_OF_STATE ? brc_precision_state_bytes(precision) : brc_precision_coeff_bytes(precision)) == 8
               ? BRC_STORED_DOUBLE
               : BRC_STORED_FLOAT;
}

/* Entry of every half-edge [n_half_edges]. */
static brc_status find_entries(brc_simulation *s, int32_t **out)
{
    const int64_t n = s->layout->n_slots * s->layout->slice;
    BRC_TRY(BRC_ALLOCATE(s->context, out, s->domain->n_half_edges, "entries"));
    for (int64_t k = 0; k < n; ++k)
        if (s->layout->half_edge[k] >= 0) (*out)[s->layout->half_edge[k]] = (int32_t)k;
    return BRC_OK;
}

/* Numbers of elements or half-edges on their way between the device's image of them and the order of ids. */
typedef struct passage {
    char *image, *values;
    const int32_t *place; /* [all ids] row or entry */
    const brc_chosen *chosen;
    int64_t n;
    size_t bytes;   /* of one number */
    int64_t stride; /* between the numbers of one row */
    int32_t width, slice;
    bool rows, loading;
} passage;

static void pass(const passage *p)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; ++i) {
        const int64_t at = p->place[p->chosen ? p->chosen->id[i] : i];
        const int64_t first = p->rows ? at * p->width : at / p->slice * p->slice * p->width + at % p->slice;
        for (int32_t c = 0; c < p->width; ++c) {
            char *device = p->image + p->bytes * (size_t)(first + c * p->stride),
                 *own = p->values + p->bytes * (size_t)(i * p->width + c);
            memcpy(p->loading ? device : own, p->loading ? own : device, p->bytes);
        }
    }
}

static brc_status read_for(const brc_state_store *store, brc_buffer *buffer, void *image, int64_t bytes)
{
    return store->for_file ? brc_buffer_read_for_file(buffer, image, bytes) : brc_buffer_read(buffer, 0, image, bytes);
}

/* Somebody sees what this rank shows. */
static bool is_shown(const brc_state_store *store)
{
    return !store->loading && (!store->for_file || brc_file_writes());
}

brc_status brc_store_entry(brc_simulation *s, brc_state_store *store, const brc_state_entry *entry)
{
    const brc_layout *layout = s->layout;
    const bool entries = entry->arrangement == BRC_ENTRIES || entry->arrangement == BRC_RECORDS;
    const int64_t words = (entries ? layout->n_slots * layout->slice : (int64_t)layout->n_rows) * entry->width;
    const brc_stored_type type = type_of(s, entry->kind);
    const int bytes = brc_stored_type_bytes(type);
    int32_t *entry_of = NULL;
    passage p = {.chosen = entry->chosen,
                 .bytes = (size_t)bytes,
                 .width = entry->width,
                 .slice = layout->slice,
                 .rows = entry->arrangement == BRC_ROWS || entry->arrangement == BRC_RECORDS,
                 .loading = store->loading};
    brc_status status = BRC_OK;
    if (!entry->buffer) return BRC_OK;
    p.stride = p.rows ? 1 : layout->slice;
    p.n = entry->chosen ? entry->chosen->n : entries ? s->domain->n_half_edges : s->domain->n_elements;
    if (entries) BRC_TRY_OR(cleanup, find_entries(s, &entry_of));
    p.place = entries ? entry_of : layout->row_of_element;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &p.image, words * bytes, entry->name));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &p.values, p.n * entry->width * bytes, entry->name));
    BRC_TRY_OR(cleanup, read_for(store, entry->buffer, p.image, words * bytes));
    if (is_shown(store)) pass(&p);
    BRC_TRY_OR(cleanup, store->numbers(store, entry->name, type, p.n, entry->width, p.values));
    if (store->loading) {
        pass(&p);
        BRC_TRY_OR(cleanup, brc_buffer_write(entry->buffer, 0, p.image, words * bytes));
    }
cleanup:
    brc_memory_free(entry_of);
    brc_memory_free(p.image);
    brc_memory_free(p.values);
    return status;
}

brc_status brc_store_entries(brc_simulation *s, brc_state_store *store, int n, const brc_state_entry *entries)
{
    for (int i = 0; i < n; ++i)
        BRC_TRY(brc_store_entry(s, store, &entries[i]));
    return BRC_OK;
}

typedef struct place_of_id {
    int32_t id, at;
} place_of_id;

static int by_id(const void *left, const void *right)
{
    const place_of_id *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

/* Row i becomes what row order[i].id was, along the cycles of that change: lists of pairs are long, and held is all
 * there is beside the image. Uses up the ids. */
static void rearrange(char *image, size_t row, char *held, int64_t n, place_of_id *order)
{
    for (int64_t first = 0; first < n; ++first) {
        if (order[first].id < 0) continue;
        int64_t i = first;
        memcpy(held, image + (size_t)first * row, row);
        while (order[i].id != first) {
            const int32_t from = order[i].id;
            memcpy(image + (size_t)i * row, image + (size_t)from * row, row);
            order[i].id = -1;
            i = from;
        }
        memcpy(image + (size_t)i * row, held, row);
        order[i].id = -1;
    }
}

brc_status brc_store_list(brc_simulation *s, brc_state_store *store, const char *name, brc_buffer *buffer,
                          brc_number_kind kind, int64_t n, int32_t width, const int32_t *id)
{
    const brc_stored_type type = type_of(s, kind);
    const size_t row = (size_t)width * (size_t)brc_stored_type_bytes(type);
    BRC_FREED place_of_id *order = NULL;
    if (!buffer || n == 0) return BRC_OK;
    BRC_LOCAL(s->context, (n + 1) * (int64_t)row, char, image, name); /* a row more, held while they change places */
    if (id) {
        BRC_TRY(BRC_ALLOCATE(s->context, &order, n, name));
        for (int64_t i = 0; i < n; ++i)
            order[i] = (place_of_id){id[i], (int32_t)i};
        qsort(order, (size_t)n, sizeof *order, by_id);
        for (int64_t i = 0; i < n; ++i)
            order[store->loading ? order[i].at : i].id = store->loading ? (int32_t)i : order[i].at;
    }
    if (!store->loading) {
        BRC_TRY(read_for(store, buffer, image, n * (int64_t)row));
        if (id && is_shown(store)) rearrange(image, row, image + (size_t)n * row, n, order);
    }
    BRC_TRY(store->numbers(store, name, type, n, width, image));
    if (store->loading) {
        if (id) rearrange(image, row, image + (size_t)n * row, n, order);
        BRC_TRY(brc_buffer_write(buffer, 0, image, n * (int64_t)row));
    }
    return BRC_OK;
}

brc_status brc_store_fields(brc_simulation *s, brc_state_store *store, const brc_kept_fields *k)
{
    static const brc_number_kind kind[] = {
        [BRC_FIELD_STATE] = BRC_OF_STATE, [BRC_FIELD_COEFF] = BRC_OF_COEFF, [BRC_FIELD_INT] = BRC_OF_INT};
    for (int i = 0; i < k->table->n; ++i) {
        const brc_field_row *field = &k->table->fields[i];
        const bool rows = field->count == brc_each_row, blocks = field->count == brc_each_block,
                   entries = field->count == brc_each_entry, records = field->count == brc_each_record;
        char name[96];
        if (!field->kept || (field->wanted && !field->wanted(&s->wants))) continue;
        snprintf(name, sizeof name, "%s%s", k->prefix ? k->prefix : "", field->kept);
        brc_buffer *buffer = brc_field_buffer(field, k->owner);
        if (store->field) {
            if (buffer) BRC_TRY(store->field(store, buffer));
            continue;
        }
        if (rows || blocks || entries || records) {
            const brc_chosen *chosen = field->keep == BRC_KEEP_BROKEN   ? k->bonds
                                       : field->keep == BRC_KEEP_OWNERS ? k->elements
                                                                        : NULL;
            const brc_arrangement arrangement = rows      ? BRC_ROWS
                                                : blocks  ? BRC_BLOCKS
                                                : entries ? BRC_ENTRIES
                                                          : BRC_RECORDS;
            BRC_TRY(brc_store_entry(
                s, store, &(brc_state_entry){name, buffer, arrangement, kind[field->number], field->width, chosen}));
        } else
            BRC_TRY(brc_store_list(s, store, name, buffer, kind[field->number], k->n, field->width, k->id));
    }
    return BRC_OK;
}
