/* Contact, for a store (state_store.h). The list of pairs is made again from where the elements were when it was made,
 * so it comes in the same order; what a pair remembers is kept by the ids of its two ends. */
#include "contact_internal.h"
#include "../../core/state_store.h"
#include <stdlib.h>
#include <string.h>

/* A pair by the ids of its ends, strikers' pieces behind the elements, and where it stands in the list. */
typedef struct pair_of_ids {
    int32_t id[2], at;
} pair_of_ids;

static int by_ids(const void *left, const void *right)
{
    const pair_of_ids *a = left, *b = right;
    const int k = a->id[0] == b->id[0];
    return (a->id[k] > b->id[k]) - (a->id[k] < b->id[k]);
}

static brc_status find_pairs(brc_simulation *s, pair_of_ids **out)
{
    const brc_contact_list *l = &s->contact->now;
    const int32_t n_rows = s->layout->n_rows;
    BRC_TRY(BRC_ALLOCATE(s->context, out, l->n_pairs, "pairs"));
    BRC_LOCAL(s->context, 2 * (int64_t)l->n_pairs, int32_t, ends, "pairs");
    if (l->n_pairs > 0) BRC_TRY(brc_buffer_read(l->ends, 0, ends, 8 * (int64_t)l->n_pairs));
    for (int32_t p = 0; p < l->n_pairs; ++p) {
        pair_of_ids *pair = *out + p;
        pair->at = p;
        for (int k = 0; k < 2; ++k) {
            const int32_t row = ends[2 * (int64_t)p + k];
            pair->id[k] = row < n_rows ? s->layout->element_of_row[row] : (int32_t)s->domain->n_elements + row - n_rows;
        }
    }
    if (l->n_pairs > 0) qsort(*out, (size_t)l->n_pairs, sizeof **out, by_ids);
    return BRC_OK;
}

/* The ids that were kept, against those of the list. */
static brc_status walk_ids(brc_simulation *s, brc_state_store *store, const pair_of_ids *pair)
{
    const int64_t n_pairs = s->contact->now.n_pairs;
    int64_t n = n_pairs;
    BRC_LOCAL(s->context, 2 * n, int32_t, ids, "pairs");
    for (int64_t p = 0; p < n; ++p)
        memcpy(ids + 2 * p, pair[p].id, sizeof pair[p].id);
    BRC_TRY(brc_store_array(s->context, store, "contact.pairs", BRC_STORED_INT32, 2, &n, (void **)&ids));
    int64_t like = 0; /* pairs up to the first that differs */
    while (like < n && like < n_pairs && memcmp(ids + 2 * like, pair[like].id, sizeof pair[like].id) == 0)
        ++like;
    if (n != n_pairs)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "contact.pairs: the history that was kept is of %lld pairs, and the surfaces near each other "
                        "are %lld: friction would be lost",
                        (long long)n, (long long)n_pairs);
    if (like < n)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "contact.pairs: the history that was kept has elements %d and %d in row %lld, where surfaces "
                        "of %d and %d are near each other: friction would be lost",
                        (int)ids[2 * like], (int)ids[2 * like + 1], (long long)like, (int)pair[like].id[0],
                        (int)pair[like].id[1]);
    return BRC_OK;
}

static brc_status walk_pairs(brc_simulation *s, brc_state_store *store)
{
    const brc_contact_list *l = &s->contact->now;
    BRC_FREED pair_of_ids *pair = NULL;
    BRC_TRY(brc_contact_bring_pairs(s));
    BRC_TRY(find_pairs(s, &pair));
    BRC_TRY(walk_ids(s, store, pair));
    BRC_LOCAL(s->context, l->n_pairs, int32_t, rank, "pairs");
    for (int32_t p = 0; p < l->n_pairs; ++p)
        rank[pair[p].at] = p;
    return brc_store_fields(
        s, store, &(brc_kept_fields){.table = &brc_contact_pair_fields, .owner = l, .n = l->n_pairs, .id = rank});
}

/* Of dlsm the probe of how far surfaces have moved reads the gradients of the step before. */
static brc_status walk_arrays(brc_simulation *s, brc_state_store *store)
{
    brc_contact_state *c = s->contact;
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_contact_fields, .owner = c, .n = c->n_pieces}));
    if (!c->affine) return BRC_OK;
    if (store->field) return store->field(store, brc_gradient_of(s));
    return brc_store_entry(s, store,
                           &(brc_state_entry){"contact.gradient", brc_gradient_of(s), BRC_ROWS, BRC_OF_COEFF, 9, NULL});
}

brc_status brc_contact_store_stretch(brc_simulation *s, brc_state_store *store)
{
    brc_contact_state *c = s->contact;
    BRC_TRY(walk_arrays(s, store));
    BRC_TRY(brc_contact_bring_pairs(s));
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_contact_pair_fields, .owner = &c->now}));
    return brc_store_integer(store, "contact.quiet", &c->quiet);
}

brc_status brc_contact_store_state(brc_simulation *s, brc_state_store *store)
{
    brc_contact_state *c = s->contact;
    BRC_TRY(walk_arrays(s, store));
    BRC_TRY(brc_store_double(store, "contact.skin", &c->skin));
    if (store->loading) {
        BRC_TRY(brc_contact_expose(s)); /* what is broken is old */
        BRC_TRY(brc_contact_list_again(s));
    }
    BRC_TRY(walk_pairs(s, store));
    BRC_TRY(brc_store_integer(store, "contact.quiet", &c->quiet));
    BRC_TRY(brc_store_integer(store, "contact.searches", &c->searches));
    BRC_TRY(brc_store_double(store, "contact.n_rigid", &c->n_rigid));
    if (store->loading) BRC_TRY(brc_contact_list_bonded(s));
    return brc_store_double(store, "contact.born", &c->energy_from_breaks);
}
