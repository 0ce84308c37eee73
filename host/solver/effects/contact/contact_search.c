/* The list of pairs that may touch: a grid of hashed cells, sorted on the device (contact_search.cl,
 * scan.cl). */
#include "contact_internal.h"
#include "../../../device/shares.h"
#include "../strikers/striker_contact.h"
#include <math.h>

/* A table of lists anew, for n things. */
static brc_status renew(brc_simulation *s, const brc_field_table *table, int64_t n, void *owner)
{
    const brc_wants wants = brc_wants_listed(&s->wants, n);
    return brc_fields_create(s->device, table, &wants, owner);
}

/* start [n + 1]: running sums of x [n]; *total: that of all. */
static brc_status scan(brc_simulation *s, brc_buffer *x, int64_t n, brc_buffer *start, int64_t *total)
{
    return brc_scan(&s->contact->scan, x, n, s->contact->sums, start, total);
}

static brc_status make_passes(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    brc_contact_scopes in;
    brc_contact_scopes_make(s, &in);
    static const brc_value_row moves[] = {{"moved", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_contact_state, moved)}};
    const brc_scope survey = {.owner = "moves since the last search", .base = c, BRC_VALUES(moves), .outer = &in.state};
    BRC_TRY(BRC_PASSES(s, &survey, BRC_PASS(&c->pass.drift, "contact_drift", "n"),
                       BRC_PASS(&c->pass.moved, "contact_moved", "n")));
    static const brc_value_row most[] = {{"most", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_contact_state, most_moved)}};
    const brc_scope fold = {.owner = "moves of the looks so far", .base = c, BRC_VALUES(most), .outer = &survey};
    BRC_TRY(BRC_PASSES(s, &fold, BRC_PASS(&c->pass.most, "contact_most", NULL)));
    const brc_pass_wanted of_lists[] = {BRC_PASS(&c->pass.extent, "contact_extent", NULL),
                                        BRC_PASS(&c->pass.largest, "contact_largest", "n"),
                                        BRC_PASS(&c->pass.drift_mean, "contact_drift_mean", "n_blocks"),
                                        BRC_PASS(&c->pass.with_pairs, "contact_with_pairs", "any at with_pairs"),
                                        BRC_PASS(&c->pass.list, "contact_list", NULL),
                                        BRC_PASS(&c->pass.keys, "contact_keys", "per_edge mask key row"),
                                        BRC_PASS(&c->pass.buckets, "contact_buckets", "key"),
                                        BRC_PASS(&c->pass.again, "contact_again", "whole per_edge mask row"),
                                        BRC_PASS(&c->pass.kept, "contact_kept", NULL),
                                        BRC_PASS(&c->pass.keep, "contact_keep", "any"),
                                        BRC_PASS(&c->pass.changed, "contact_changed", "n touched"),
                                        BRC_PASS(&c->pass.spread, "contact_spread", "n to level"),
                                        BRC_PASS(&c->pass.count, "contact_count", "per_edge mask row"),
                                        BRC_PASS(&c->pass.fill, "contact_fill", "rows per_edge mask row any"),
                                        BRC_PASS(&c->pass.own_pairs, "contact_own_pairs", NULL),
                                        BRC_PASS(&c->pass.other_pairs, "contact_other_pairs", NULL),
                                        BRC_PASS(&c->pass.pack, "contact_pack", "stride at"),
                                        BRC_PASS(&c->pass.carry, "contact_carry", "whole had stride todo"),
                                        BRC_PASS(&c->pass.pieces, "contact_pieces", NULL),
                                        BRC_PASS(&c->pass.pieces_moved, "contact_pieces_moved", "first")};
    return BRC_PASSES_MAKE(s, &in.before, of_lists);
}

brc_status brc_contact_search_create(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    BRC_TRY(brc_scan_kernels_find(s->device, &c->scan));
    BRC_TRY(make_passes(s));
    BRC_TRY(brc_fields_create(s->device, &brc_contact_sum_fields, &s->wants, c));
    BRC_TRY(brc_fields_create(s->device, &brc_contact_slot_fields, &s->wants, &c->now));
    return brc_fields_create(s->device, &brc_contact_slot_fields, &s->wants, &c->before);
}

/* Where the scene leaves the skin open: such that a list lasts some BRC_CONTACT_QUIET steps at four times the present
 * speeds (a thin skin sifts better, a thick one lasts longer). */
static brc_status choose_skin(brc_simulation *s)
{
    static const double thinnest = 0.05, thickest = 0.5; /* of the mean size of an element */
    brc_contact_state *c = s->contact;
    brc_contact_survey now;
    c->skin = s->scene->contact.skin;
    if (c->skin > 0) return BRC_OK;
    BRC_TRY(brc_contact_take_survey(s, &now));
    c->skin = fmin(fmax(8 * BRC_CONTACT_QUIET * now.element[1] * brc_simulation_time_step(s).value, thinnest * c->size),
                   thickest * c->size);
    return BRC_OK;
}

/* Sort the exposed elements by the key of their cell. *sorted: which of the two arrays has them in the end. */
static brc_status sort_by_cell(brc_simulation *s, double per_edge, int32_t mask, int *sorted)
{
    brc_contact_state *c = s->contact;
    const int32_t m = c->now.n_listed, n_blocks = brc_scan_blocks(m);
    int at = 0;
    BRC_TRY(BRC_RUN(c->pass.keys, m, {"per_edge", BRC_STATE(per_edge)}, {"mask", BRC_INT(mask)},
                    {"key", BRC_BUF(c->key[0])}, {"row", BRC_BUF(c->row[0])}));
    for (int shift = 0; mask >> shift; shift += 8, at = 1 - at) {
        BRC_TRY(brc_sort_count(&c->scan, m, shift, c->key[at], c->count));
        BRC_TRY(scan(s, c->count, BRC_SORT_BINS * (int64_t)n_blocks, c->digits, NULL));
        BRC_TRY(brc_sort_move(&c->scan, m, shift, c->key[at], c->row[at], c->digits, c->key[1 - at], c->row[1 - at]));
    }
    *sorted = at;
    BRC_TRY(brc_buffer_fill_zero(c->first));
    BRC_TRY(brc_buffer_fill_zero(c->last));
    return BRC_RUN(c->pass.buckets, m, {"key", BRC_BUF(c->key[at])});
}

/* Room for m exposed elements. */
static brc_status make_room(brc_simulation *s, int64_t m)
{
    brc_contact_state *c = s->contact;
    const int64_t buckets = brc_contact_buckets(m);
    if (!c->first || buckets > s->wants.bucket_room) {
        brc_want_exposed(s, s->wants.exposed_room, buckets);
        BRC_TRY(brc_fields_create(s->device, &brc_contact_bucket_fields, &s->wants, c));
    }
    if (c->key[0] && m <= s->wants.exposed_room) return BRC_OK;
    brc_want_exposed(s, brc_contact_exposed_room(&s->wants, m), s->wants.bucket_room);
    return brc_fields_create(s->device, &brc_contact_grid_fields, &s->wants, c);
}

/* Arrays of the list to be made; the larger of what is asked for and what it has. */
static brc_status room_for_listed(brc_simulation *s, brc_contact_list *l, int64_t m)
{
    if (l->list && brc_buffer_bytes(l->list) >= 4 * m) return BRC_OK;
    return brc_fields_create(s->device, &brc_contact_listed_fields, &s->wants, l);
}
static brc_status room_for_entries(brc_simulation *s, brc_contact_list *l, int64_t n)
{
    if (l->entry && n <= l->entry_room) return BRC_OK;
    l->entry_room = brc_contact_room(n);
    BRC_TRY(renew(s, &brc_contact_entry_fields, l->entry_room, l));
    brc_buffer_is_of(l->entry, BRC_OF_LOOSE, 4, 4);
    brc_buffer_is_of(l->pair, BRC_OF_LOOSE, 4, 4);
    return BRC_OK;
}
/* Numbers of a result. */
static int32_t stride_of(const brc_contact_state *c)
{
    return BRC_CONTACT_RESULT + 2 * c->width;
}

static brc_status room_for_pairs(brc_simulation *s, brc_contact_list *l, int64_t n)
{
    brc_contact_state *c = s->contact;
    if (!l->ends || n > l->pair_room) {
        l->pair_room = brc_contact_room(n);
        BRC_TRY(renew(s, &brc_contact_pair_fields, l->pair_room, l));
    }
    if (c->n_pieces) {
        const int64_t parts = 6 * (int64_t)brc_simulation_n_strikers(s) * brc_blocks(l->pair_room, BRC_CONTACT_PAIRS);
        if (!c->part || parts > c->part_room) {
            c->part_room = parts;
            BRC_TRY(renew(s, &brc_contact_part_fields, parts, c));
        }
    }
    if (c->result && n <= c->result_room) return BRC_OK;
    c->result_room = brc_contact_room(n);
    return renew(s, &brc_contact_result_fields, c->result_room, c);
}

/* For running sums over n pairs. */
static brc_status room_for_sums(brc_simulation *s, int64_t n)
{
    brc_contact_state *c = s->contact;
    if (n <= c->sums_room) return BRC_OK;
    c->sums_room = brc_contact_room(n);
    return renew(s, &brc_contact_sum_fields, c->sums_room, c);
}

/* What number_pairs asks for in one read. */
enum { PAIRS, WITH_PAIRS, TOUCHING, ASKED };

/* Results of the list before are on their way: those of pairs that touched, since the others hold nothing. First where
 * they go. */
static brc_status find_packed(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int64_t n = c->before.n_pairs;
    if (n > c->packed_at_room) {
        c->packed_at_room = brc_contact_room(n);
        BRC_TRY(renew(s, &brc_contact_packed_at_fields, c->packed_at_room, c));
    }
    return brc_scan_later(&c->scan, c->touch, n, c->sums, c->packed_at, TOUCHING);
}
static brc_status pack_results(brc_simulation *s, int32_t n_touching)
{
    brc_contact_state *c = s->contact;
    const int64_t n = c->before.n_pairs;
    if (!c->packed || n_touching > c->packed_room) {
        c->packed_room = brc_contact_room(n_touching) + 1;
        BRC_TRY(renew(s, &brc_contact_packed_fields, c->packed_room, c));
    }
    return BRC_RUN(c->pass.pack, n, {"stride", BRC_INT(stride_of(c))}, {"at", BRC_BUF(c->packed_at)});
}

/* Exposed elements in the list to be made. */
static brc_status list_exposed(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = s->layout->n_rows;
    int64_t m;
    BRC_TRY(scan(s, c->exposed, n, c->now.slot_of, &m));
    c->now.n_listed = (int32_t)m;
    BRC_TRY(make_room(s, m));
    BRC_TRY(room_for_listed(s, &c->now, m));
    return brc_pass_run(c->pass.list, n);
}

/* The slots of c->redo: all, or those whose entries a break may have changed; the others keep the number of theirs. */
static brc_status find_redo(brc_simulation *s, bool whole, double per_edge, int32_t mask, int sorted, int64_t *n_redo)
{
    brc_contact_state *c = s->contact;
    brc_contact_list *l = &c->now;
    const int32_t m = l->n_listed;
    BRC_TRY(brc_buffer_fill_zero(c->again));
    BRC_TRY(BRC_RUN(c->pass.again, m, {"whole", BRC_INT(whole ? 1 : 0)}, {"per_edge", BRC_STATE(per_edge)},
                    {"mask", BRC_INT(mask)}, {"row", BRC_BUF(c->row[sorted])}));
    BRC_TRY(scan(s, c->again, m, c->pair_start, n_redo));
    BRC_TRY(BRC_RUN(c->pass.with_pairs, m, {"any", BRC_BUF(c->again)}, {"at", BRC_BUF(c->pair_start)},
                    {"with_pairs", BRC_BUF(c->redo)}));
    return brc_pass_run(c->pass.kept, m);
}

/* Radius of the largest exposed element; of any, which breaks may expose, c->largest. */
static brc_status find_largest(brc_simulation *s, double *out)
{
    brc_contact_state *c = s->contact;
    const int32_t n = s->layout->n_rows;
    brc_contact_survey most;
    BRC_TRY(BRC_RUN(c->pass.largest, brc_blocks(n, BRC_CONTACT_BLOCK), {"n", BRC_INT(n)}));
    BRC_TRY(brc_contact_read_survey(s, c->moved, 0, &most));
    *out = most.element[0];
    c->largest = most.element[1];
    return BRC_OK;
}

/* Who is near whom. */
static brc_status find_entries(brc_simulation *s, bool whole)
{
    brc_contact_state *c = s->contact;
    brc_contact_list *l = &c->now;
    const int32_t n = s->layout->n_rows, m = l->n_listed;
    int64_t near, n_redo;
    int sorted, mask = BRC_SORT_BINS;
    while (mask < 2 * (int64_t)m)
        mask *= 2;
    mask -= 1;
    double largest = c->largest;
    if (whole) BRC_TRY(find_largest(s, &largest));
    const double per_edge = 1 / (1.000001 * (2 * largest + c->skin));
    BRC_TRY(sort_by_cell(s, per_edge, mask, &sorted));
    BRC_TRY(find_redo(s, whole, per_edge, mask, sorted, &n_redo));
    int64_t n_own = n_redo;
    BRC_TRY(brc_contact_keep_slots(s, c->redo, &n_own));
    if (n_redo > 0) {
        BRC_TRY(BRC_RUN(c->pass.count, n_own, {"per_edge", BRC_STATE(per_edge)}, {"mask", BRC_INT(mask)},
                        {"row", BRC_BUF(c->row[sorted])}));
        BRC_TRY(brc_contact_bring_counts(s));
    }
    BRC_TRY(scan(s, c->count, m, l->start, &near));
    BRC_TRY(room_for_entries(s, l, near));
    BRC_TRY(BRC_RUN(c->pass.keep, m, {"any", BRC_BUF(c->count)}));
    if (n_redo == 0) return BRC_OK;
    BRC_TRY(BRC_RUN(c->pass.fill, n_own, {"rows", BRC_INT(n)}, {"per_edge", BRC_STATE(per_edge)},
                    {"mask", BRC_INT(mask)}, {"row", BRC_BUF(c->row[sorted])}, {"any", BRC_BUF(c->count)}));
    return brc_contact_bring_entries(s);
}

static brc_status number_pairs(brc_simulation *s, bool carried)
{
    brc_contact_state *c = s->contact;
    brc_contact_list *l = &c->now;
    const int32_t m = l->n_listed;
    const bool packs = carried && c->before.n_pairs > 0;
    int32_t total[ASKED];
    if (packs) BRC_TRY(room_for_sums(s, c->before.n_pairs));
    BRC_TRY(brc_scan_later(&c->scan, c->count, m, c->sums, c->pair_start, WITH_PAIRS));
    BRC_TRY(BRC_RUN(c->pass.with_pairs, m, {"any", BRC_BUF(c->count)}, {"at", BRC_BUF(c->pair_start)},
                    {"with_pairs", BRC_BUF(l->with_pairs)}));
    BRC_TRY(brc_scan_later(&c->scan, c->owned, m, c->sums, c->pair_start, PAIRS));
    if (packs) BRC_TRY(find_packed(s));
    BRC_TRY(brc_scan_totals(c->sums, packs ? ASKED : TOUCHING, total));
    if (packs) BRC_TRY(pack_results(s, total[TOUCHING]));
    const int32_t n_pairs = total[PAIRS];
    BRC_TRY(room_for_pairs(s, l, n_pairs));
    l->n_pairs = n_pairs;
    BRC_TRY(brc_pass_run(c->pass.own_pairs, m));
    if (n_pairs == 0) return BRC_OK;
    int64_t n_with_pairs = total[WITH_PAIRS];
    BRC_TRY(brc_contact_keep_slots(s, l->with_pairs, &n_with_pairs));
    l->n_with_pairs = (int32_t)n_with_pairs;
    BRC_TRY(brc_pass_run(c->pass.other_pairs, n_with_pairs));
    BRC_TRY(brc_contact_share_pairs(s));
    const brc_contact_items own = brc_contact_items_of(s, true);
    if (own.n < n_pairs) BRC_TRY(brc_buffer_fill_zero(c->touch));
    return BRC_RUN(c->pass.carry, own.n, {"whole", BRC_INT(own.whole ? 1 : 0)}, {"todo", BRC_BUF(own.todo)},
                   {"had", BRC_INT(c->before.n_pairs > 0 ? 1 : 0)}, {"stride", BRC_INT(carried ? stride_of(c) : 0)});
}

static brc_status find_pairs(brc_simulation *s, bool whole, bool carried)
{
    BRC_TRY(find_entries(s, whole));
    return number_pairs(s, carried);
}

/* whole: all is looked for; carried: results of pairs go over. */
static brc_status make_list(brc_simulation *s, bool whole, bool carried)
{
    brc_contact_state *c = s->contact;
    const brc_contact_list last = c->now;
    c->now = c->before;
    c->before = last;
    c->now.n_listed = c->now.n_pairs = c->now.n_with_pairs = 0;
    c->n_todo = 0;
    c->lists += 1;
    BRC_TRY(list_exposed(s));
    if (c->now.n_listed == 0) return BRC_OK;
    BRC_TRY(brc_contact_share_list(s));
    brc_rows_among *const outer = brc_device_keep_among(s->device, c->listed);
    const brc_status status = find_pairs(s, whole, carried);
    brc_device_keep_among(s->device, outer);
    BRC_TRY(status);
    return brc_hook_run(s, BRC_HOOK_PAIRS, NULL);
}

brc_status brc_contact_list_again(brc_simulation *s)
{
    return make_list(s, true, false);
}

/* The pairs of elements that lost bonds or are touched. */
static brc_status find_changed(brc_simulation *s, brc_buffer *touched)
{
    brc_contact_state *c = s->contact;
    int64_t n_todo;
    const int64_t n_pairs = c->now.n_pairs;
    c->n_todo = 0;
    if (n_pairs == 0) return BRC_OK;
    if (n_pairs > c->todo_room) {
        c->todo_room = brc_contact_room(n_pairs);
        BRC_TRY(renew(s, &brc_contact_changed_fields, c->todo_room, c));
    }
    BRC_TRY(room_for_sums(s, n_pairs));
    BRC_TRY(BRC_RUN(c->pass.changed, n_pairs, {"n", BRC_INT(s->layout->n_rows)}, {"touched", BRC_BUF(touched)}));
    BRC_TRY(scan(s, c->flag, n_pairs, c->flag_start, &n_todo));
    BRC_TRY(BRC_RUN(c->pass.with_pairs, n_pairs, {"any", BRC_BUF(c->flag)}, {"at", BRC_BUF(c->flag_start)},
                    {"with_pairs", BRC_BUF(c->todo)}));
    c->n_todo = (int32_t)n_todo;
    return brc_contact_share_todo(s);
}

brc_status brc_contact_list_more(brc_simulation *s, brc_buffer *touched)
{
    BRC_TRY(make_list(s, false, true));
    return find_changed(s, touched);
}

BRC_READ(bool, brc_contact_is_due, s->contact && (s->contact->due || s->contact->always_whole))
BRC_READ(int64_t, brc_contact_lists, s->contact ? s->contact->lists : 0)

int32_t brc_contact_pairs_here(const brc_simulation *s, const int32_t **ends, const int32_t **touch)
{
    const brc_contact_state *c = s->contact;
    const int32_t n = c ? c->now.n_pairs : 0;
    *ends = n > 0 ? brc_buffer_host(c->now.ends) : NULL;
    *touch = n > 0 ? brc_buffer_host(c->touch) : NULL;
    return *ends && *touch ? n : 0;
}

brc_status brc_contact_list_around(brc_simulation *s, brc_buffer *touched)
{
    return s->contact ? find_changed(s, touched) : BRC_OK;
}

brc_status brc_contact_spread(brc_simulation *s, brc_buffer *level, int32_t to)
{
    brc_contact_state *c = s->contact;
    if (!c || c->n_todo == 0) return BRC_OK;
    return BRC_RUN(c->pass.spread, c->n_todo, {"n", BRC_INT(s->layout->n_rows)}, {"to", BRC_INT(to)},
                   {"level", BRC_BUF(level)});
}

static brc_status search(brc_simulation *s, bool carried)
{
    brc_contact_state *c = s->contact;
    c->quiet = 0;
    c->searches += 1;
    BRC_TRY(brc_pass_run(c->pass.extent, s->layout->n_rows));
    if (c->n_pieces) BRC_TRY(brc_pass_run(c->pass.pieces, c->n_pieces));
    BRC_TRY(choose_skin(s));
    BRC_TRY(brc_buffer_fill_zero(c->stored)); /* of elements that leave the list too */
    if (c->torque) BRC_TRY(brc_buffer_fill_zero(c->torque));
    if (c->n_pieces) BRC_TRY(brc_strikers_set_load(s, NULL));
    return make_list(s, true, carried);
}

brc_status brc_contact_search(brc_simulation *s)
{
    return search(s, false);
}

brc_status brc_contact_search_more(brc_simulation *s, brc_buffer *touched)
{
    BRC_TRY(search(s, true));
    return find_changed(s, touched);
}
