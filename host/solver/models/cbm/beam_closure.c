#include "beam_closure.h"
#include "cbm_internal.h"
#include "../../effects/fracture/ahead.h"
#include "beam_softening.h"

enum { LEAN = 7, SLIP = 5, CLOSURE_BITS = 31, LEANS = 1, GRIPS = 2 }; /* beam_closure.cl */

/* Ends that only push are looked at in one of these steps for whether they stand clear: far from that they bear
 * nothing any more. */
static const int32_t every = 4;

struct brc_beam_closure {
    brc_pass *force, *energy, *virial, *move, *begin;
    brc_buffer *other, *twin, *bears; /* [n_slots][C] */
    brc_buffer *lean;                 /* [n_slots][LEAN][C], only where beams soften or lie in interfaces */
    brc_buffer *slip;                 /* [n_slots][SLIP][C], only in interfaces with friction */
    brc_buffer *rubbed;               /* [n_rows] energy lost to friction [J], likewise */
    brc_buffer *rubs;                 /* [n_groups] */
    int32_t leans;                    /* LEANS: there is lean; GRIPS: slip too */
};
typedef struct brc_beam_closure beam_closure;

BRC_WANTED(leans, w->softens || brc_wants_joined(w))
BRC_WANTED(grips, brc_wants_joined(w) && brc_scene_shuts(w->scene) && brc_scene_side_friction(w->scene) > 0)

#define AT(member) BRC_FIELD_AT(beam_closure, member)
static const brc_field_row rows[] = {
    BRC_FIELD(other, brc_each_entry, 1, INT, NULL, "broken beams", "-"),
    BRC_FIELD(twin, brc_each_entry, 1, INT, NULL, "broken beams", "-"),
    BRC_KEPT_FIELD(bears, brc_each_entry, 1, INT, NULL, "broken beams", "-", "closure.bears"),
    BRC_KEPT_FIELD(lean, brc_each_entry, LEAN, COEFF, leans, "broken beams", "-", "closure.lean"),
    BRC_KEPT_FIELD(slip, brc_each_entry, SLIP, COEFF, grips, "friction of broken beams", "m", "closure.slip"),
    BRC_KEPT_FIELD(rubbed, brc_each_row, 1, STATE, grips, "friction of broken beams", "J", "closure.rubbed"),
    BRC_FIELD(rubs, brc_each_group, 1, INT, NULL, "broken beams", "-"),
};
BRC_FIELD_TABLE(brc_beam_closure_fields, "broken beams that bear", BRC_LIFE_RUN, brc_wants_lost_beams, rows);

static beam_closure *closure_of(const brc_simulation *s)
{
    return brc_cbm_own_of(s)->closure;
}
/* A static stage solves a body whose broken bonds bear nothing (docs/notebook/fracture.md). */
static bool bears_now(const brc_simulation *s)
{
    return brc_scene_shuts(s->scene) && brc_simulation_stage(s) >= 0 &&
           brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC;
}
static bool acts(const brc_simulation *s)
{
    return closure_of(s) && bears_now(s) && !brc_ahead_is_whole(s);
}

/* Rows of the neighbours over all bonds there ever were, and the other entry of each; entries without one point
 * home. */
static brc_status upload_bonds(brc_simulation *s, beam_closure *f)
{
    const brc_layout *layout = s->layout;
    const int64_t slice = layout->slice, n_entries = layout->n_slots * slice;
    BRC_LOCAL(s->context, n_entries, int32_t, row, "broken beams");
    BRC_LOCAL(s->context, n_entries, int32_t, twin, "broken beams");
    BRC_TRY(brc_layout_twins(s->context, layout, s->domain, twin));
    for (int32_t k = 0; k < layout->n_slices; ++k)
        for (int64_t at = layout->slot_start[k] * slice; at < layout->slot_start[k + 1] * slice; ++at) {
            const int32_t h = layout->half_edge[at], home = (int32_t)(k * slice + at % slice);
            row[at] = h >= 0 ? layout->row_of_element[s->domain->neighbour[h]] : home;
        }
    BRC_TRY(brc_upload_int(f->other, row, n_entries));
    return brc_upload_int(f->twin, twin, n_entries);
}

static brc_status make_passes(brc_simulation *s, beam_closure *f)
{
    static const brc_value_row values[] = {{"leans", BRC_VALUE_INT, AT(leans)}};
    const brc_scope run = brc_scope_of_run(s), breaks = brc_scope_of_breaks(s, &run),
                    criterion = brc_scope_of_criterion(s, &breaks);
    const brc_scope beams = {.owner = "broken beams",
                             .base = f,
                             .tables = {&brc_beam_closure_fields},
                             BRC_VALUES(values),
                             .outer = &criterion},
                    request = brc_scope_of_request(&beams);
    const brc_pass_wanted wanted[] = {
        BRC_PASS(&f->energy, "closure_energy", NULL), BRC_PASS(&f->virial, "closure_virial", "virial"),
        BRC_PASS(&f->move, "closure_move", "step clear friction"),
        BRC_PASS(&f->begin, "closure_begin", "step closure softens half_kick friction open crack")};
    BRC_TRY(BRC_PASSES_MAKE(s, &beams, wanted));
    return BRC_PASSES(s, &request, BRC_PASS(&f->force, "closure_force", NULL));
}

brc_status brc_beam_closure_create(brc_simulation *s)
{
    if (!brc_wants_lost_beams(&s->wants)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_cbm_own_of(s)->closure, 1, "broken beams"));
    beam_closure *f = brc_cbm_own_of(s)->closure;
    BRC_TRY(brc_fields_create(s->device, &brc_beam_closure_fields, &s->wants, f));
    f->leans = (f->lean ? LEANS : 0) + (f->slip ? GRIPS : 0);
    BRC_TRY(make_passes(s, f));
    return upload_bonds(s, f);
}

void brc_beam_closure_free(brc_simulation *s)
{
    beam_closure *f = closure_of(s);
    if (!f) return;
    brc_fields_free(&brc_beam_closure_fields, f);
    brc_memory_free(f);
    brc_cbm_own_of(s)->closure = NULL;
}

/* ---- an evaluation ---- */

bool brc_beam_closure_within(const brc_simulation *s, brc_buffer **rubs, brc_buffer **other, brc_buffer **bears)
{
    const beam_closure *f = closure_of(s);
    if (!acts(s) || f->leans) return false;
    *rubs = f->rubs, *other = f->other, *bears = f->bears;
    return true;
}

brc_status brc_beam_closure_force(brc_simulation *s, const brc_force_request *r)
{
    const beam_closure *f = closure_of(s);
    if (!acts(s) || !f->leans) return BRC_OK;
    return brc_pass_run_on(f->force, s->n_groups, r, NULL, NULL);
}

brc_status brc_beam_closure_energy(brc_simulation *s)
{
    return acts(s) ? brc_pass_run(closure_of(s)->energy, s->n_groups) : BRC_OK;
}
brc_status brc_beam_closure_virial(brc_simulation *s, brc_buffer *virial)
{
    return acts(s) ? BRC_RUN(closure_of(s)->virial, s->n_groups, {"virial", BRC_BUF(virial)}) : BRC_OK;
}

/* ---- a step ---- */

brc_status brc_beam_closure_move(brc_simulation *s)
{
    const beam_closure *f = closure_of(s);
    if (!acts(s) || (!f->leans && brc_fracture_moment(s) % every != 0)) return BRC_OK;
    return BRC_RUN(f->move, s->n_groups, {"step", BRC_INT((int32_t)brc_fracture_moment(s))},
                   {"clear", BRC_COEFF(BRC_BEAM_CLEAR)}, {"friction", BRC_COEFF(brc_scene_side_friction(s->scene))});
}

brc_status brc_beam_closure_begin(brc_simulation *s, int32_t moment, double half_kick)
{
    const beam_closure *f = closure_of(s);
    if (!f || brc_ahead_is_whole(s)) return BRC_OK;
    brc_buffer *open = NULL, *crack = NULL;
    brc_beam_softening_cracks(s, &open, &crack);
    return BRC_RUN(f->begin, s->n_groups, {"step", BRC_INT(moment)}, {"closure", BRC_INT(bears_now(s) ? 1 : 0)},
                   {"softens", BRC_INT(open != NULL)}, {"half_kick", BRC_STATE(half_kick)},
                   {"friction", BRC_COEFF(brc_scene_side_friction(s->scene))}, {"open", BRC_BUF(open)},
                   {"crack", BRC_BUF(crack)});
}

brc_status brc_beam_closure_friction(brc_simulation *s, double *out)
{
    const beam_closure *f = closure_of(s);
    *out = 0;
    return f && f->rubbed ? brc_vector_sum(s, f->rubbed, s->layout->n_rows, out) : BRC_OK;
}

/* ---- what stays ---- */

/* Groups with beams that bear follow from the entries. */
static brc_status find_rubs(brc_simulation *s, const beam_closure *f)
{
    const int64_t slice = s->layout->slice, n_entries = s->layout->n_slots * slice,
                  width = s->layout->n_rows / s->n_groups;
    BRC_LOCAL(s->context, n_entries, int32_t, bears, "broken beams");
    BRC_LOCAL(s->context, s->n_groups, int32_t, rubs, "broken beams");
    BRC_TRY(brc_buffer_read(f->bears, 0, bears, 4 * n_entries));
    for (int32_t block = 0; block < s->layout->n_slices; ++block)
        for (int64_t k = (int64_t)s->layout->slot_start[block] * slice;
             k < (int64_t)s->layout->slot_start[block + 1] * slice; ++k)
            if (bears[k])
                rubs[(block * slice + k % slice) / width] |=
                    1 << (k / slice - s->layout->slot_start[block] < CLOSURE_BITS - 1
                              ? k / slice - s->layout->slot_start[block]
                              : CLOSURE_BITS - 1);
    return brc_buffer_write(f->rubs, 0, rubs, 4 * (int64_t)s->n_groups);
}

brc_status brc_beam_closure_store_state(brc_simulation *s, brc_state_store *store)
{
    const beam_closure *f = closure_of(s);
    if (!f) return BRC_OK;
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_beam_closure_fields, .owner = f}));
    return store->loading ? find_rubs(s, f) : BRC_OK;
}
