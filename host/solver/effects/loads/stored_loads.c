/* What the loads of the stage remember, number by number, for a store (state_store.h). */
#include "../../core/state_store.h"
#include "loads_internal.h"
#include <math.h>
#include <stdio.h>

/* What a list of a load keeps, as "loads.<kind>.<i>.<what>". */
static brc_status walk_list(brc_simulation *s, brc_state_store *store, const char *kind, int32_t i,
                            const brc_field_table *table, const void *list, int64_t n, const int32_t *id)
{
    char prefix[64];
    snprintf(prefix, sizeof prefix, "loads.%s.%d.", kind, (int)i);
    return brc_store_fields(s, store,
                            &(brc_kept_fields){.table = table, .owner = list, .prefix = prefix, .n = n, .id = id});
}

static brc_status walk_number(brc_state_store *store, const char *kind, int32_t i, const char *what, double *value)
{
    char name[64];
    snprintf(name, sizeof name, "loads.%s.%d.%s", kind, (int)i, what);
    return brc_store_double(store, name, value);
}

static brc_status walk_held(brc_simulation *s, brc_state_store *store)
{
    const brc_held_faces *h = &s->loads->held;
    if (h->n_faces == 0) return BRC_OK;
    BRC_LOCAL(s->context, h->n_faces, int32_t, face, "held faces");
    for (int64_t f = 0; f < s->domain->n_free_faces; ++f)
        if (h->index_of_free_face[f] >= 0) face[h->index_of_free_face[f]] = (int32_t)f;
    BRC_TRY(walk_list(s, store, "held", 0, &brc_held_face_fields, h, h->n_faces, face));
    for (int32_t i = 0; i < h->n_loads; ++i) { /* in the order of the set's members */
        BRC_TRY(walk_list(s, store, "held", i, &brc_held_load_fields, h->loads + i, h->loads[i].n, NULL));
        h->loads[i].factor = NAN; /* the store may have other places */
    }
    return BRC_OK;
}

static brc_status walk_traction(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_traction_load *t = s->loads->tractions + i;
    BRC_TRY(walk_number(store, "traction", i, "last_factor", &t->last_factor));
    if (t->n == 0) return BRC_OK;
    if (store->field) return walk_list(s, store, "traction", i, &brc_traction_fields, t, t->n, NULL);
    BRC_LOCAL(s->context, t->n, int32_t, element, "elements under traction");
    BRC_TRY(brc_buffer_read(t->element, 0, element, 4 * (int64_t)t->n));
    for (int32_t k = 0; k < t->n; ++k)
        element[k] = s->layout->element_of_row[element[k]];
    return walk_list(s, store, "traction", i, &brc_traction_fields, t, t->n, element);
}

static brc_status walk_prescribed(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_prescribed_load *m = s->loads->prescribed + i;
    BRC_TRY(walk_list(s, store, "imposed", i, &brc_prescribed_fields, m, m->n, m->element_id));
    return walk_number(store, "imposed", i, "last_rate", &m->last_rate);
}

static brc_status walk_push(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_push_load *p = s->loads->pushes + i;
    BRC_TRY(walk_number(store, "push", i, "factor", &p->factor));
    BRC_TRY(walk_number(store, "push", i, "last_factor", &p->last_factor));
    return walk_list(s, store, "push", i, &brc_push_fields, p, p->n, p->element_id);
}

static brc_status walk_turn(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_turn_load *m = s->loads->turns + i;
    BRC_TRY(walk_number(store, "turn", i, "turned", &m->turned));
    BRC_TRY(walk_number(store, "turn", i, "last_factor", &m->last_factor));
    BRC_TRY(walk_number(store, "turn", i, "last_rate", &m->last_rate));
    return walk_list(s, store, "turn", i, &brc_turn_fields, m, m->n, m->element_id);
}

brc_status brc_loads_store(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(brc_store_double(store, "work_before", &s->loads->work_before));
    BRC_TRY(walk_held(s, store));
    for (int32_t i = 0; i < s->loads->n_tractions; ++i)
        BRC_TRY(walk_traction(s, store, i));
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i)
        BRC_TRY(walk_prescribed(s, store, i));
    for (int32_t i = 0; i < s->loads->n_pushes; ++i)
        BRC_TRY(walk_push(s, store, i));
    for (int32_t i = 0; i < s->loads->n_turns; ++i)
        BRC_TRY(walk_turn(s, store, i));
    return BRC_OK;
}
