#include "ahead.h"
#include "cell_breaks_internal.h"
#include "../contact/contact.h"
#include "../../../device/shares.h"
#include "../../core/rings.h"
#include "strengths.h"
#include "../strikers/striker_contact.h"
#include <math.h>

static const double never = 1e30; /* CELLS_NEVER of cells.cl */

/* ---- what is made once ---- */

/* Limits of the bonds, the smallest of each element, and where a bond's other half is stored. */
static brc_status upload_bonds(brc_simulation *s, const double *strength)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t n_entries = layout->n_slots * layout->slice;
    brc_cell_breaks *cells = s->fracture->cells;
    const uint8_t *const here = brc_buffer_slices_here(cells->limit); /* as of the others */
    BRC_LOCAL(s->context, n_entries, double, limit, "limits of bonds");
    BRC_LOCAL(s->context, n_entries, double, whole, "unbroken bonds");
    BRC_LOCAL(s->context, layout->n_rows, double, least, "smallest limits");
    BRC_LOCAL(s->context, n_entries, int32_t, twin, "twins");
    for (int32_t r = 0; r < layout->n_rows; ++r)
        least[r] = never;
    BRC_TRY(brc_layout_twins(s->context, layout, d, twin));
    for (int32_t slice = 0; slice < layout->n_slices; ++slice)
        for (int64_t k = (int64_t)layout->slot_start[slice] * layout->slice;
             (!here || here[slice]) && k < (int64_t)layout->slot_start[slice + 1] * layout->slice; ++k) {
            const int32_t h = layout->half_edge[k];
            const double value = h >= 0 ? strength[d->bond[h]] : 0;
            limit[k] = value > 0 ? value : never;
            whole[k] = h >= 0;
            if (h < 0) continue;
            double *own = &least[layout->row_of_element[d->neighbour[d->twin[h]]]];
            *own = fmin(*own, limit[k]);
        }
    BRC_TRY(brc_upload_coeff(s, cells->limit, limit, n_entries));
    BRC_TRY(brc_upload_coeff(s, cells->alive, whole, n_entries));
    BRC_TRY(brc_upload_coeff(s, cells->least, least, layout->n_rows));
    return brc_upload_int(cells->twin, twin, n_entries);
}

BRC_WANTED(breaks, w->scene->has_fracture &&brc_wants_cells(w))
BRC_WANTED(dlsm_by_bond, brc_wants_deforming(w) && !w->by_element)
BRC_WANTED(dlsm_by_element, brc_wants_deforming(w) && w->by_element)
BRC_WANTED(published_by_bond, brc_wants_rigid_cells(w) && !w->by_element)

#define AT(member) BRC_FIELD_AT(brc_cell_breaks, member)
static const brc_field_row rows[] = {
    BRC_PART_KEPT(limit, brc_each_entry, 1, COEFF, NULL, "limits of bonds", "Pa", "cells.limit", BRC_KEEP_BROKEN),
    BRC_PART_KEPT(alive, brc_each_entry, 1, COEFF, NULL, "unbroken bonds", "-", "cells.alive", BRC_KEEP_BROKEN),
    BRC_FIELD(twin, brc_each_entry, 1, INT, NULL, "twins", "-"),
    BRC_FIELD(mark, brc_each_entry, 1, INT, NULL, "marked bonds", "-"),
    BRC_FIELD(measure, brc_each_entry, 1, COEFF, NULL, "stresses of marked bonds", "Pa"),
    BRC_PART_KEPT(least, brc_each_row, 1, COEFF, NULL, "smallest limits", "Pa", "cells.least", BRC_KEEP_OWNERS),
    {"plane", brc_each_row, 1, BRC_FIELD_COEFF, brc_wants_deforming, AT(modulus), "moduli", "Pa", BRC_NOT_KEPT},
    BRC_FIELD(support, brc_each_row, 1, COEFF, NULL, "supports", "-"),
    BRC_FIELD(stiffest, brc_each_row, 1, COEFF, brc_wants_deforming, "supports", "1/m^2"),
    BRC_FIELD(changed, brc_each_row, 1, INT, NULL, "changed elements", "-"),
    BRC_FIELD(look, brc_each_group, 1, INT, dlsm_by_bond, "groups to look at", "-"),
    BRC_FIELD(weight, brc_each_row, 1, STATE, NULL, "weights of broken bonds", "-"),
    BRC_FIELD(found, brc_each_row, 1, STATE, NULL, "marks of elements", "-"),
    {"own_branch", brc_each_entry, 3, BRC_FIELD_COEFF, dlsm_by_element, AT(branch), "branches", "m", BRC_NOT_KEPT},
    BRC_PART_KEPT(spanned, brc_each_block, 6, COEFF, brc_wants_rigid_cells, "supports", "-", "cells.spanned",
                  BRC_KEEP_OWNERS),
    BRC_FIELD(bond_ratio, brc_each_row, 1, COEFF, published_by_bond, "ratios of bonds", "-"),
};
BRC_FIELD_TABLE(brc_cell_break_fields, "breaks of cells", BRC_LIFE_RUN, breaks, rows);

static brc_status make_passes(brc_simulation *s, brc_cell_breaks *c)
{
    const brc_scope run = brc_scope_of_run(s);
    brc_cell_scopes of_state;
    const brc_scope *state = brc_cell_scopes_make(s, &run, &of_state);
    return BRC_PASSES(s, state, BRC_PASS(&c->break_pass, "cells_break", "step width"),
                      BRC_PASS(&c->share, "cells_share", "step per_weight list"));
}

/* Bonds that break at once take what their strength and length hold. */
static void tell_implied(brc_simulation *s, const brc_strengths *strengths)
{
    const brc_domain *d = s->domain;
    double sum = 0;
    int64_t n = 0;
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        if (strengths->energy[b] > 0 || !(strengths->tension[b] > 0)) continue;
        const int64_t h = d->bond_half_edge[b], i = d->neighbour[d->twin[h]], j = d->neighbour[h];
        double branch[3];
        for (int c = 0; c < 3; ++c)
            branch[c] = d->position[3 * j + c] - d->position[3 * i + c];
        sum += strengths->tension[b] * strengths->tension[b] *
               sqrt(branch[0] * branch[0] + branch[1] * branch[1] + branch[2] * branch[2]) /
               (s->elastic[s->material_of_element[i]].young + s->elastic[s->material_of_element[j]].young);
        ++n;
    }
    if (n == 0) return;
    s->fracture->implied_energy = sum / (double)n;
    brc_log(s->context, BRC_LOG_INFO,
            "fracture: bonds break at once; strength and cells imply a fracture energy of about sigma_f^2 L / (2 E) = "
            "%.3g J/m^2, which changes with the cells "
            "(`fracture_energy` of a strength gives one that does not)",
            s->fracture->implied_energy);
}

/* Faces that open, and closed ones. */
static brc_status create_cohesion(brc_simulation *s, const brc_strengths *strengths)
{
    if (!s->fracture->cells->by_element) tell_implied(s, strengths);
    const bool opens = s->model->cohesion && !s->fracture->cells->by_element;
    if (strengths->softens && !opens)
        return BRC_FAIL(
            s->context, BRC_BAD_INPUT,
            "fracture_energy: bonds soften with model dlsm and criterion bond-normal; here they break at once: use "
            "those, or remove it from the strengths and interfaces");
    return s->model->cohesion ? s->model->cohesion->create(s, strengths) : BRC_OK;
}

/* Arrays in the room of others. */
static brc_status share_room(brc_simulation *s, brc_cell_breaks *c)
{
    const int64_t bytes = s->wants.state_bytes;
    BRC_TRY(brc_buffer_create_scratch(c->measure, &c->delta));
    BRC_TRY(brc_buffer_create_scratch(c->found, &c->n_marked));
    brc_buffer_is_of(c->n_marked, BRC_OF_GROUPS, bytes, bytes);
    return BRC_OK;
}

brc_status brc_cell_breaks_create(brc_simulation *s)
{
    BRC_ENDS_WITH(brc_strengths_free) brc_strengths strengths = {0};
    BRC_TRY(BRC_ALLOCATE(s->context, &s->fracture->cells, 1, "fracture"));
    BRC_TRY(brc_fields_create(s->device, &brc_cell_break_fields, &s->wants, s->fracture->cells));
    BRC_TRY(share_room(s, s->fracture->cells));
    s->fracture->cells->by_element = !brc_scene_breaks_by_bond(s->scene, s->scene->model.kind);
    BRC_TRY(brc_strengths_create(s->context, s->scene, s->domain, s->material_of_element, &strengths));
    BRC_TRY(upload_bonds(s, strengths.tension));
    BRC_TRY(brc_rings_create(s, &s->fracture->cells->rings));
    BRC_TRY(make_passes(s, s->fracture->cells));
    BRC_TRY(s->model->breaking->create(s));
    if (s->fracture->cells->by_element) BRC_TRY(brc_cell_criteria_create(s));
    return create_cohesion(s, &strengths);
}

void brc_cell_breaks_free(brc_simulation *s)
{
    brc_cell_breaks *c = s->fracture->cells;
    if (!c) return;
    brc_rings_free(&c->rings);
    brc_buffer_free(&c->delta);
    brc_buffer_free(&c->n_marked);
    brc_fields_free(&brc_cell_break_fields, c);
    brc_memory_free(c);
    s->fracture->cells = NULL;
}

/* ---- the step ---- */

static const brc_model_cohesion *cohesion_of(const brc_simulation *s)
{
    static const brc_model_cohesion none = {0};
    return s->model->cohesion ? s->model->cohesion : &none;
}
static brc_status ask(brc_simulation *s, brc_status (*what)(brc_simulation *))
{
    return what ? what(s) : BRC_OK;
}

BRC_READ(bool, brc_cell_breaks_by_bond, s->fracture && s->fracture->cells && !s->fracture->cells->by_element)

/* Bonds above a share of their limit are marked; *some: there are. *found: rings are counted already. */
static brc_status mark_bonds(brc_simulation *s, double share, bool *some, bool *found)
{
    brc_cell_breaks *c = s->fracture->cells;
    const bool by_element = c->by_element;
    double n;
    BRC_TRY(by_element ? brc_cell_criteria_mark(s) : s->model->breaking->mark(s, share));
    *found = brc_ahead_expects(s);
    if (*found) {
        BRC_TRY(brc_rings_find(s, c->rings, some));
        brc_ahead_known(s, *some);
        return BRC_OK;
    }
    BRC_TRY(brc_ahead_count(s, by_element ? c->found : c->n_marked, by_element ? s->layout->n_rows : s->n_groups, &n));
    *some = n > 0;
    return BRC_OK;
}

/* Energies around breaks that are summed later: brc_model_breaking.energy_around, and outside of elements. */
typedef struct energies {
    double part[4], held, touching, closed;
} energies;
static double around(const energies *e)
{
    return e->part[0] - e->part[1] + e->part[2] - e->part[3];
}
static double outside(const energies *e)
{
    return e->held + (e->touching + e->closed);
}

/* Whether bonds that are left to elements are marked. Where there are no surfaces to look for, the rings around what
 * broke come first, and are counted in the same breath. */
static brc_status count_left(brc_simulation *s, bool *left)
{
    const brc_model_breaking *const m = s->model->breaking;
    brc_rings *rings = s->fracture->cells->rings;
    *left = false;
    if (s->contact) return m->loosens ? brc_rings_find(s, rings, left) : BRC_OK;
    if (m->wide) BRC_TRY(brc_rings_spread(s, rings, 2, 3)); /* ring 1 is known from before the breaks */
    BRC_TRY(brc_rings_count(s, rings, left));
    return *left ? brc_rings_find(s, rings, left) : BRC_OK;
}

/* Marked bonds go, then the bonds of elements that the others no longer hold, until all that are left are held.
 * before: what the elements whose energy that changes held before, each looked at before a bond near it goes; but for
 * the last time in *earlier [J]. found: rings are counted already. */
static brc_status break_marked(brc_simulation *s, bool found, energies *before, double *earlier)
{
    brc_breaking *f = s->fracture;
    brc_cell_breaks *c = f->cells;
    bool left = true;
    *earlier = 0;
    if (!found) BRC_TRY(brc_rings_find(s, c->rings, &left));
    for (bool again = false; left || !again; again = true) {
        if (again) {
            BRC_TRY(brc_vector_sums(s));
            *earlier += around(before);
        }
        BRC_TRY(brc_rings_list_found(s, c->rings));
        BRC_TRY(s->model->breaking->energy_around(s, c->rings, true, before->part));
        BRC_TRY(ask(s, cohesion_of(s)->before_breaks));
        BRC_TRY(BRC_RUN(c->break_pass, s->n_groups, {"step", BRC_INT(brc_fracture_moment(s))},
                        {"width", BRC_INT(s->model->breaking->area_width)}));
        BRC_TRY(s->model->breaking->rebuild(s));
        BRC_TRY(count_left(s, &left));
    }
    return BRC_OK;
}

/* Velocities of rigid cells and of strikers, which are in no ring. */
static brc_status kick_others(brc_simulation *s, double by)
{
    if (by == 0) return BRC_OK;
    BRC_TRY(brc_contact_turn(s, by, 0, 0));
    return s->strikers ? brc_strikers_advance(s, by, 0, 0, false) : BRC_OK;
}

/* The rings around the bonds that broke. Pairs of surfaces that the breaks changed act on elements of ring 2 or make
 * them so: their fluxes change as those of ring 2 do, their energy does not. */
static brc_status find_rings(brc_simulation *s)
{
    brc_rings *rings = s->fracture->cells->rings;
    const bool wide = s->model->breaking->wide;
    if (s->contact) {
        const brc_step_phase phase = brc_phase_within(s, BRC_PHASE_SEARCH);
        BRC_TRY(brc_contact_broken(s, 0));
        BRC_TRY(brc_rings_list_touched(s, rings));
        if (s->model->breaking->gradients_around) {
            brc_force_request request = brc_force_request_of_state(s, BRC_BOOK_NOTHING);
            request.rings = rings;
            BRC_TRY(s->model->breaking->gradients_around(s, &request));
        }
        BRC_TRY(brc_contact_settle(s));
        brc_phase_within(s, phase);
    }
    if (s->contact && wide) BRC_TRY(brc_rings_spread(s, rings, 2, 2)); /* ring 1 is known from before the breaks */
    if (s->contact) BRC_TRY(brc_contact_spread(s, brc_rings_level(rings), 1 + 2));
    if (s->contact && wide) BRC_TRY(brc_rings_spread(s, rings, 3, 3));
    const bool places = s->model->breaking->places && s->model->breaking->places(s, rings);
    const brc_rings_closing how = places ? BRC_RINGS_PLACE : BRC_RINGS_KEEP;
    return s->contact ? brc_rings_close(s, rings, how, NULL) : brc_rings_list(s, rings, how);
}

/* Energy of held faces and of surfaces that touch [J]: of what breaks bonds change, the part that is not in
 * elements. */
static brc_status outside_energy(brc_simulation *s, energies *e)
{
    e->closed = 0;
    BRC_TRY(brc_force_held_energy(s, &e->held));
    BRC_TRY(brc_contact_stored(s, &e->touching));
    return cohesion_of(s)->stored ? cohesion_of(s)->stored(s, &e->closed) : BRC_OK;
}

static brc_status step(brc_simulation *s, double half_kick, double share)
{
    brc_breaking *f = s->fracture;
    brc_rings *rings = f->cells->rings;
    const brc_ring_list *list = brc_rings_around(rings);
    energies before, after;
    double ended, earlier, weight;
    bool some, found = false;
    const brc_model_cohesion *o = cohesion_of(s);
    if (o->is_on && o->is_on(s)) {
        BRC_TRY(o->step(s, share, &ended));
        some = ended > 0;
    } else {
        BRC_TRY(mark_bonds(s, share, &some, &found));
    }
    if (!some) return BRC_OK;
    /* The step closes with the force of the whole bonds, and the next one opens with that of those that are left:
     * velocities gain half a kick of the one and lose half a kick of the other, in the rings where they differ. */
    BRC_TRY(outside_energy(s, &before));
    BRC_TRY(kick_others(s, half_kick));
    BRC_TRY(brc_rings_begin(s, rings, half_kick));
    BRC_TRY(break_marked(s, found, &before, &earlier));
    if (f->cells->by_element) BRC_TRY(brc_cell_criteria_settle(s));
    BRC_TRY(ask(s, o->after_breaks));
    BRC_TRY(find_rings(s));
    BRC_TRY(brc_force_around_breaks(s, rings));
    if (o->change) BRC_TRY(o->change(s, brc_rings_are_whole(rings) ? 0 : half_kick));
    BRC_TRY(brc_rings_end(s, rings));
    BRC_TRY(kick_others(s, -half_kick));
    BRC_TRY(s->model->breaking->energy_around(s, rings, false, after.part));
    BRC_TRY(outside_energy(s, &after));
    BRC_TRY(brc_rings_sum(s, list, 0, f->cells->weight, &weight));
    BRC_TRY(ask(s, o->refresh));
    BRC_TRY(brc_vector_sums(s));
    if (!(weight > 0)) weight = 1; /* bonds without stress share nothing */
    const double released = earlier + around(&before) + outside(&before) - around(&after) - outside(&after);
    BRC_TRY(BRC_RUN(f->cells->share, list->n[0], {"step", BRC_INT(brc_fracture_moment(s))},
                    {"per_weight", BRC_STATE(released / weight)}, {"list", BRC_BUF(list->upto[0])}));
    BRC_TRY(brc_rings_forget(rings));
    if (o->settle) BRC_TRY(o->settle(s, list));
    return brc_contact_list_bonded(s);
}

brc_status brc_cell_breaks_step(brc_simulation *s, double half_kick, double share)
{
    const brc_status status = step(s, half_kick, share);
    if (status != BRC_OK) brc_vector_sums_forget(s);
    return status;
}

brc_status brc_cell_breaks_fail(brc_simulation *s, double half_kick)
{
    return brc_cell_breaks_step(s, half_kick, 1);
}

brc_status brc_cell_breaks_failure_ratio(brc_simulation *s, double *out)
{
    *out = 0;
    return s->fracture->cells->by_element ? brc_cell_criteria_ratio(s, out) : s->model->breaking->ratio(s, out);
}
