/* Contact in the course of a run: when to look for pairs, what they add to forces and energy. */
#include "contact_internal.h"
#include "../../../device/shares.h"
#include "../fracture/ahead.h"
#include "../fracture/breaking.h"
#include "../strikers/striker_contact.h"
#include "touching.h"
#include <math.h>
#include <string.h>

/* In static stages and modes surfaces know nothing of each other. */
static bool is_disabled(const brc_simulation *s)
{
    return brc_simulation_stage(s) >= 0 && brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC;
}

static brc_status make_passes(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const bool spheres = brc_has_spheres(s), pieces = c->n_pieces > 0;
    brc_contact_scopes in;
    brc_contact_scopes_make(s, &in);
    const brc_pass_wanted of_pairs[] = {{&c->pass.spheres, "contact_spheres", "whole dt n todo", !spheres},
                                        {&c->pass.cells, "contact_cells", "whole broke dt n todo", spheres},
                                        {&c->pass.gather_moments, "contact_gather_moments", "book", !c->affine},
                                        BRC_PASS(&c->pass.expose, "contact_expose", "broken")};
    BRC_TRY(BRC_PASSES_MAKE(s, &in.now, of_pairs));
    BRC_TRY(BRC_PASSES(s, &in.state,
                       {&c->pass.gather_turning, "contact_gather_turning", "sign kick book force torque", c->affine}));
    const brc_scope request = brc_scope_of_request(&in.now);
    BRC_TRY(BRC_PASSES(s, &request, {&c->pass.gather_forces, "contact_gather_forces", NULL, !c->affine}));
    const brc_scope parts = {
        .owner = "forces on strikers", .base = c, .tables = {&brc_contact_part_fields}, .outer = &in.now};
    const brc_pass_wanted of_parts[] = {
        {&c->pass.striker_parts, "contact_striker_parts", "n_blocks n_pairs n stride torque_at", !pieces},
        {&c->pass.striker_load, "contact_striker_load", "n_blocks", !pieces}};
    BRC_TRY(BRC_PASSES_MAKE(s, &parts, of_parts));
    const brc_scope criterion = brc_scope_of_criterion(s, &in.now), sums = brc_scope_of_sums(s, &criterion);
    return BRC_PASSES(s, &sums, {&c->pass.marked, "contact_marked", "step", !(spheres && s->fracture)});
}

static void tell_if_never(const brc_simulation *s)
{
    for (int32_t k = 0; k < s->scene->n_stages; ++k)
        if (s->scene->stages[k].solver == BRC_SOLVER_DYNAMIC) return;
    brc_log(s->context, BRC_LOG_WARNING,
            "contact acts in dynamic stages and the scene has none: surfaces%s pass through each other; make the stage "
            "`dynamic`",
            s->scene->n_strikers > 0 ? ", walls and strikers" : "");
}

brc_status brc_contact_create(brc_simulation *s)
{
    if (!s->scene->has_contact) return BRC_OK;
    tell_if_never(s);
    BRC_TRY(BRC_ALLOCATE(s->context, &s->contact, 1, "contact"));
    s->contact->affine = s->model->surface == BRC_SURFACE_AFFINE;
    s->contact->width = s->contact->affine ? 9 : 3;
    s->contact->pose = (int)s->model->surface;
    brc_contact_check_speed(s);
    BRC_TRY(brc_contact_setup(s));
    BRC_TRY(brc_contact_set_bearing(s));
    s->contact->is_linear = s->scene->contact.spheres == BRC_SPHERES_LINEAR;
    BRC_TRY(make_passes(s));
    BRC_TRY(brc_contact_shapes(s));
    BRC_TRY(brc_contact_rigid_create(s));
    return brc_contact_search_create(s);
}

void brc_contact_free(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    if (!c) return;
    brc_contact_fields_free(c);
    brc_buffer_free(&c->most_moved);
    if (c->bonded) brc_fields_free(&brc_bonded_list_fields, c->bonded);
    brc_memory_free(c->bonded);
    brc_rows_among_free(&c->listed);
    brc_contact_share_free(c);
    brc_memory_free(c->law_of);
    brc_memory_free(c);
    s->contact = NULL;
}

/* ---- when to look ---- */

/* Cells that follow I + H are looked for when the next evaluation has found H. */
static brc_status search_soon(brc_simulation *s)
{
    s->contact->due = s->contact->affine;
    return s->contact->due ? BRC_OK : brc_contact_search(s);
}

brc_status brc_contact_gradients(brc_simulation *s)
{
    if (!s->contact) return BRC_OK;
    BRC_TRY(brc_contact_pose(s));
    if (!s->contact->due) return BRC_OK;
    s->contact->due = false;
    const brc_step_phase before = brc_phase_within(s, BRC_PHASE_SEARCH);
    BRC_TRY(brc_contact_search(s));
    brc_phase_within(s, before);
    return BRC_OK;
}

/* No pairs, whatever initial fields brought near before the stage. */
static brc_status disable(brc_simulation *s)
{
    brc_contact_list *l = &s->contact->now;
    s->contact->due = false;
    l->n_listed = l->n_pairs = l->n_with_pairs = 0;
    return brc_buffer_fill_zero(s->contact->stored);
}

brc_status brc_contact_restart(brc_simulation *s)
{
    if (!s->contact) return BRC_OK;
    if (is_disabled(s)) return disable(s);
    BRC_TRY(brc_contact_detach(s));
    return search_soon(s);
}

/* Bodies that stand in each other by less than is refused; of strikers a warning said so when they were made
 * (striker_check.c). */
static brc_status tell_of_overlap(brc_simulation *s, const brc_ledger *ledger)
{
    brc_touching now;
    if (brc_strikers_overlap(s) || !(ledger->contact > 0)) return BRC_OK;
    BRC_TRY(brc_simulation_touching(s, &now));
    if (now.penetration > brc_striker_warned_depth(s))
        brc_log(s->context, BRC_LOG_WARNING,
                "stage '%s': surfaces overlap as the scene starts, %.0f pairs by up to %.3g m, and hold %.3g J: they "
                "begin pressed together",
                brc_current_stage(s)->name, now.pairs, now.penetration, ledger->contact);
    return BRC_OK;
}

brc_status brc_contact_enable(brc_simulation *s, const brc_ledger *ledger)
{
    static const double little = 1e-6; /* of the elastic energy: what a thousandth of its strains can press together */
    if (!s->contact || brc_simulation_stage(s) < 0 || is_disabled(s)) return BRC_OK;
    if (brc_simulation_stage(s) == 0) return tell_of_overlap(s, ledger);
    const brc_stage *before = s->scene->stages + brc_simulation_stage(s) - 1;
    if (before->solver == BRC_SOLVER_DYNAMIC || !(ledger->contact > little * ledger->elastic)) return BRC_OK;
    return BRC_FAIL(s->context, BRC_BAD_INPUT,
                    "stage '%s': surfaces overlap as it begins and hold %.3g J, beside %.3g J of elastic energy: stage "
                    "'%s' knows no contact and pressed them into each other. Keep them apart by that "
                    "much, or come to rest in a dynamic stage with mass damping",
                    brc_current_stage(s)->name, ledger->contact, ledger->elastic, before->name);
}

BRC_READ(int64_t, brc_contact_next_probe, s->contact->due ? 0 : s->contact->quiet)

brc_status brc_contact_follow(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    bool due, past;
    if (!c) return BRC_OK;
    if (c->quiet > 0) {
        c->quiet -= 1;
        return BRC_OK;
    }
    if (brc_ahead_is_on(s)) return brc_contact_put_off_probe(s);
    BRC_TRY(brc_contact_probe(s, &due, &past));
    return due ? search_soon(s) : BRC_OK;
}

/* ---- forces ---- */

bool brc_contact_acts(const brc_simulation *s, const brc_force_request *r)
{
    return s->contact && !r->homogeneous && r->displacement == brc_displacement_of(s) && s->contact->now.n_pairs > 0;
}

/* No strikers: a buffer that no kernel touches. */

brc_status brc_contact_pairs(brc_simulation *s, double dt, bool whole, bool broke)
{
    brc_contact_state *c = s->contact;
    const brc_contact_list *l = &c->now;
    const int32_t n = s->layout->n_rows;
    const brc_contact_items items = brc_contact_items_of(s, whole);
    const bool spheres = brc_has_spheres(s);
    brc_given given[] = {{"whole", BRC_INT(items.whole ? 1 : 0)},
                         {"dt", BRC_STATE(dt)},
                         {"n", BRC_INT(n)},
                         {"todo", BRC_BUF(items.todo)},
                         {"broke", BRC_INT(broke ? 1 : 0)},
                         {0}};
    if (spheres) given[4] = (brc_given){0};
    if (whole ? l->n_pairs > 0 : c->n_todo > 0) {
        brc_rows_among *const outer = brc_device_keep_among(s->device, items.among);
        const brc_status status =
            brc_pass_run_on(spheres ? c->pass.spheres : c->pass.cells, items.n, NULL, NULL, given);
        brc_device_keep_among(s->device, outer);
        BRC_TRY(status);
    }
    return brc_contact_bring_sent(s);
}

static brc_status gather_turning(brc_simulation *s, double sign, double kick, int book, brc_buffer *force,
                                 brc_buffer *torque)
{
    return brc_contact_run_gather(s, s->contact->pass.gather_turning, NULL,
                                  BRC_GIVEN({"sign", BRC_STATE(sign)}, {"kick", BRC_STATE(kick)},
                                            {"book", BRC_INT(book)}, {"force", BRC_BUF(force)},
                                            {"torque", BRC_BUF(torque)}));
}

/* Forces and torques of the elements on strikers. */
static brc_status load_strikers(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const brc_contact_list *l = &c->now;
    if (c->n_pieces == 0) return BRC_OK;
    const int32_t n = brc_simulation_n_strikers(s), n_blocks = (l->n_pairs + BRC_CONTACT_PAIRS - 1) / BRC_CONTACT_PAIRS;
    BRC_TRY(BRC_RUN(c->pass.striker_parts, n * n_blocks, {"n_blocks", BRC_INT(n_blocks)},
                    {"n_pairs", BRC_INT(l->n_pairs)}, {"n", BRC_INT(s->layout->n_rows)},
                    {"stride", BRC_INT(BRC_CONTACT_RESULT + 2 * c->width)},
                    {"torque_at", BRC_INT(BRC_CONTACT_RESULT + c->width)}));
    return BRC_RUN(c->pass.striker_load, n, {"n_blocks", BRC_INT(n_blocks)});
}

/* Around breaks the pairs that these may have changed, in sweeps of openings those of the cells that open, else all. */
static bool all_pairs(const brc_force_request *r)
{
    return !r->listed_pairs && !brc_request_list(r);
}

/* The step that the evaluation ends; 0: the state is evaluated again. */
static double step_of(const brc_simulation *s, const brc_force_request *r)
{
    return r->book == BRC_BOOK_WORK ? brc_simulation_time_step(s).value : 0;
}

brc_status brc_contact_moments(brc_simulation *s, const brc_force_request *r)
{
    brc_contact_state *c = s->contact;
    const int book = r->book == BRC_BOOK_WORK;
    BRC_TRY(brc_contact_pairs(s, step_of(s, r), all_pairs(r), r->rings != NULL));
    return brc_contact_run_gather(s, c->pass.gather_moments, NULL, BRC_GIVEN({"book", BRC_INT(book)}));
}

brc_status brc_contact_forces(brc_simulation *s, const brc_force_request *r)
{
    brc_contact_state *c = s->contact;
    if (c->affine)
        BRC_TRY(brc_contact_run_gather(s, c->pass.gather_forces, r, NULL));
    else {
        BRC_TRY(brc_contact_pairs(s, step_of(s, r), all_pairs(r), r->rings != NULL));
        BRC_TRY(gather_turning(s, 1, 0, r->book == BRC_BOOK_WORK, r->force, r->torque));
    }
    return load_strikers(s);
}

/* ---- breaks ---- */

/* Did a beam break in this step? */
static brc_status beams_broke(brc_simulation *s, bool *out)
{
    double groups;
    *out = false;
    if (brc_ahead_is_on(s)) return BRC_OK;
    BRC_TRY(BRC_RUN(s->contact->pass.marked, s->n_groups, {"step", BRC_INT(brc_fracture_moment(s))}));
    BRC_TRY(brc_ahead_count(s, brc_kinetic_of(s), s->n_groups, &groups));
    *out = groups > 0;
    return BRC_OK;
}

/* Who is touched by the breaks of this step (rings.h); beams: who lost one. */
static brc_buffer *touched(const brc_simulation *s)
{
    brc_rings *rings = brc_cell_breaks_rings(s);
    return rings ? brc_rings_touched(rings) : s->contact->fresh;
}

brc_status brc_contact_expose(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    if (!s->fracture) return BRC_OK;
    return BRC_RUN(c->pass.expose, s->layout->n_rows, {"broken", BRC_BUF(brc_fracture_lost_bonds(s))});
}

/* What the breaks of this step change of the list. */
static brc_status list_breaks(brc_simulation *s)
{
    BRC_TRY(brc_contact_expose(s));
    BRC_TRY(brc_contact_detach(s));
    return brc_contact_list_more(s, touched(s));
}

brc_status brc_contact_settle(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    bool due, past;
    if (!c) return BRC_OK;
    BRC_TRY(brc_contact_pose(s));
    BRC_TRY(brc_contact_probe(s, &due, &past));
    return past || c->always_whole ? brc_contact_search_more(s, touched(s)) : BRC_OK;
}

brc_status brc_contact_broken(brc_simulation *s, double half_kick)
{
    brc_contact_state *c = s->contact;
    double before, after;
    bool any = true;
    if (!c) return BRC_OK;
    if (c->pass.marked) BRC_TRY(beams_broke(s, &any));
    if (!any) return BRC_OK;
    if (!c->pass.marked) return list_breaks(s); /* cells: the forces are evaluated next */
    const bool strikers = c->n_pieces > 0;
    BRC_TRY(brc_contact_stored(s, &before));
    if (strikers && half_kick > 0)
        BRC_TRY(brc_strikers_advance(s, half_kick, 0, 0, false)); /* the step closes with the load of before ... */
    if (c->now.n_pairs > 0) BRC_TRY(gather_turning(s, -1, half_kick, 0, brc_force_of(s), brc_torque_of(s)));
    BRC_TRY(list_breaks(s));
    BRC_TRY(brc_contact_settle(s));
    if (c->now.n_pairs > 0) {
        BRC_TRY(brc_contact_pairs(s, 0, false, true));
        BRC_TRY(gather_turning(s, 1, half_kick, 0, brc_force_of(s), brc_torque_of(s)));
        BRC_TRY(load_strikers(s));
    }
    if (strikers) BRC_TRY(brc_strikers_book(s, BRC_BOOK_START));
    if (strikers && half_kick > 0)
        BRC_TRY(
            brc_strikers_advance(s, -half_kick, 0, 0, false)); /* ... and the next one opens with what is there now */
    BRC_TRY(brc_contact_stored(s, &after));
    BRC_TRY(brc_vector_sums(s));
    c->energy_from_breaks += after - before;
    return BRC_OK;
}

/* ---- energy ---- */

brc_status brc_contact_stored(brc_simulation *s, double *out)
{
    *out = 0;
    return s->contact ? brc_vector_sum_later(s, s->contact->stored, s->layout->n_rows, out) : BRC_OK;
}

brc_status brc_contact_ledger(brc_simulation *s, brc_ledger *ledger)
{
    const int32_t n = s->layout->n_rows;
    if (!s->contact) return BRC_OK;
    double spin;
    BRC_TRY(brc_contact_stored(s, &ledger->contact));
    BRC_TRY(brc_vector_sums(s));
    BRC_TRY(brc_contact_spin_energy(s, &spin));
    ledger->kinetic += spin;
    BRC_TRY(brc_vector_sum(s, s->contact->lost_friction, n, &ledger->friction));
    BRC_TRY(brc_vector_sum(s, s->contact->lost_impact, n, &ledger->impact));
    ledger->fracture -= s->contact->energy_from_breaks; /* what a break leaves in the surfaces it did not take away */
    return BRC_OK;
}
