/* What broke, for a store (state_store.h): kept of the broken bonds and of the elements that lost one only, since a new
 * simulation has all others right. */
#include "cell_breaks.h"
#include "cell_breaks_internal.h"
#include "../../core/state_store.h"
#include <string.h>

/* Half-edges of broken bonds. */
static brc_status find_broken(brc_simulation *s, brc_chosen *out)
{
    const int64_t n_entries = s->layout->n_slots * s->layout->slice;
    BRC_FREED uint8_t *broken = NULL;
    int64_t n = 0;
    BRC_LOCAL(s->context, n_entries, int32_t, step, "broken bonds");
    BRC_TRY(BRC_ALLOCATE(s->context, &broken, s->domain->n_half_edges, "broken bonds"));
    BRC_TRY(brc_buffer_read(s->fracture->break_step, 0, step, 4 * n_entries));
    for (int64_t k = 0; k < n_entries; ++k) {
        if (s->layout->half_edge[k] < 0 || step[k] == 0) continue;
        broken[s->layout->half_edge[k]] = 1;
        ++n;
    }
    BRC_TRY(brc_memory_resize(s->context, (void **)&out->id, n, sizeof *out->id, "broken bonds"));
    out->n = 0;
    for (int64_t h = 0; h < s->domain->n_half_edges; ++h)
        if (broken[h]) out->id[out->n++] = (int32_t)h;
    return BRC_OK;
}

brc_status brc_fracture_owners(brc_simulation *s, const brc_chosen *half_edges, brc_chosen *out)
{
    const brc_domain *d = s->domain;
    BRC_TRY(
        brc_memory_resize(s->context, (void **)&out->id, half_edges->n, sizeof *out->id, "elements with broken bonds"));
    out->n = 0;
    for (int64_t i = 0; i < half_edges->n; ++i) { /* rows of half-edges follow one another as their elements do */
        const int32_t e = d->neighbour[d->twin[half_edges->id[i]]];
        if (out->n == 0 || out->id[out->n - 1] != e) out->id[out->n++] = e;
    }
    return BRC_OK;
}

/* Ids that a file gives, before anything is looked up by them. */
static brc_status check_ids(brc_simulation *s, const brc_chosen *half_edges)
{
    for (int64_t i = 0; i < half_edges->n; ++i)
        if (half_edges->id[i] < 0 || half_edges->id[i] >= s->domain->n_half_edges ||
            (i > 0 && half_edges->id[i] <= half_edges->id[i - 1]))
            return BRC_FAIL(s->context, BRC_BAD_INPUT, "broken bonds: half-edge %d of %lld, after %d",
                            (int)half_edges->id[i], (long long)s->domain->n_half_edges,
                            i > 0 ? (int)half_edges->id[i - 1] : -1);
    return BRC_OK;
}

/* A broken bond has no neighbour: it points home. */
static brc_status point_home(brc_simulation *s, const brc_chosen *half_edges)
{
    const brc_layout *layout = s->layout;
    const int64_t n = layout->n_slots * layout->slice;
    BRC_LOCAL(s->context, n, int32_t, neighbour, "neighbours");
    BRC_LOCAL(s->context, s->domain->n_half_edges, uint8_t, broken, "neighbours");
    BRC_TRY(brc_buffer_read(brc_neighbour_of(s), 0, neighbour, 4 * n));
    for (int64_t i = 0; i < half_edges->n; ++i)
        broken[half_edges->id[i]] = 1;
    for (int32_t block = 0; block < layout->n_slices; ++block)
        for (int64_t k = (int64_t)layout->slot_start[block] * layout->slice;
             k < (int64_t)layout->slot_start[block + 1] * layout->slice; ++k)
            if (layout->half_edge[k] >= 0 && broken[layout->half_edge[k]])
                neighbour[k] = block * layout->slice + (int32_t)(k % layout->slice);
    return brc_buffer_write(brc_neighbour_of(s), 0, neighbour, 4 * n);
}

/* Stages that were entered, and the loads of static events: [first step, first load, first time, time step, stage]. */
static brc_status walk_moments(brc_simulation *s, brc_state_store *store)
{
    enum { N = 5 };
    brc_breaking *f = s->fracture;
    int64_t n = f->n_spans;
    BRC_LOCAL(s->context, N * n, double, spans, "stages with fracture");
    for (int64_t k = 0; k < n; ++k) {
        const brc_break_span *span = &f->spans[k];
        const double row[N] = {(double)span->first_step, (double)span->first_load, span->first_time, span->time_step,
                               span->stage};
        memcpy(spans + N * k, row, sizeof row);
    }
    BRC_TRY(brc_store_array(s->context, store, "fracture.stages", BRC_STORED_DOUBLE, N, &n, (void **)&spans));
    BRC_TRY(brc_store_array(s->context, store, "fracture.loads", BRC_STORED_DOUBLE, 1, &f->n_loads, (void **)&f->load));
    if (!store->loading) return BRC_OK;
    BRC_TRY(brc_memory_resize(s->context, (void **)&f->spans, n, sizeof *f->spans, "stages with fracture"));
    f->n_spans = (int)n;
    for (int64_t k = 0; k < n; ++k) {
        const double *row = spans + N * k;
        f->spans[k] = (brc_break_span){(int64_t)row[0], (int64_t)row[1], row[2], row[3], (int32_t)row[4]};
    }
    return BRC_OK;
}

/* Arrays of both models and of the criterion. A broken beam has no length, and leaves the volume that an element's
 * stress is averaged over; records of beams follow from the forces but for what bonds that broke after them carried. */
static brc_status walk_tables(brc_simulation *s, brc_state_store *store, const brc_chosen *bonds,
                              const brc_chosen *elements)
{
    const brc_breaking *f = s->fracture;
    const struct {
        const brc_field_table *table;
        const void *owner;
        bool there;
    } walked[] = {{&brc_break_fields, f, true},
                  {&brc_criterion_fields, f, f->record != NULL},
                  {&brc_cell_break_fields, f->cells, f->cells != NULL}};
    for (size_t k = 0; k < sizeof walked / sizeof *walked; ++k)
        if (walked[k].there)
            BRC_TRY(brc_store_fields(
                s, store,
                &(brc_kept_fields){
                    .table = walked[k].table, .owner = walked[k].owner, .bonds = bonds, .elements = elements}));
    return brc_geometry_store(s, store, bonds, elements);
}

static brc_status walk_arrays(brc_simulation *s, brc_state_store *store, const brc_chosen *bonds)
{
    brc_chosen elements = {0};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_fracture_owners(s, bonds, &elements));
    status = walk_tables(s, store, bonds, &elements);
cleanup:
    brc_memory_free(elements.id);
    return status;
}

brc_status brc_fracture_store_stretch(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(walk_tables(s, store, NULL, NULL));
    BRC_TRY(store->field(store, brc_neighbour_of(s)));
    return store->loading ? brc_fracture_raise_bounds(s) : BRC_OK;
}

brc_status brc_fracture_store_state(brc_simulation *s, brc_state_store *store)
{
    brc_chosen bonds = {0};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, walk_moments(s, store));
    if (!store->loading) BRC_TRY_OR(cleanup, find_broken(s, &bonds));
    BRC_TRY_OR(cleanup, brc_store_array(s->context, store, "fracture.half_edges", BRC_STORED_INT32, 1, &bonds.n,
                                        (void **)&bonds.id));
    if (store->loading) {
        BRC_TRY_OR(cleanup, check_ids(s, &bonds));
        BRC_TRY_OR(cleanup, point_home(s, &bonds));
    }
    BRC_TRY_OR(cleanup, walk_arrays(s, store, &bonds));
    if (s->model->cohesion) BRC_TRY_OR(cleanup, s->model->cohesion->store(s, store, &bonds));
    if (store->loading) status = brc_fracture_raise_bounds(s);
cleanup:
    brc_memory_free(bonds.id);
    return status;
}
