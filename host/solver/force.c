/* One evaluation of the forces of a model: the order of the passes, nothing else (docs/notebook/theory.md T2 and T3, docs/notebook/beams.md). */
#include "beam_closure.h"
#include "beam_softening.h"
#include "cell_breaks_internal.h"
#include "cell_softening.h"
#include "closed_faces.h"
#include "contact.h"
#include "element_loads.h"
#include "fracture_internal.h"
#include "rims.h"
#include "strikers_internal.h"

/* Constants handed to kernels; with several materials the kernels gather them instead. */
static const brc_elastic *one_material(const brc_simulation *s) { return s->elastic + s->material_of_element[0]; }
static double beta(const brc_simulation *s) { return s->scene->model.compaction ? s->scene->model.beta : 0; }

static bool has_face_loads(const brc_simulation *s) { return s->loads.held.n_faces > 0 || s->loads.n_tractions > 0; }

/* The rings that each pass of dlsm goes over: list NULL, all elements. Where most cells are without bonds those with bonds are all that is gone over. */
typedef struct dlsm_extent {
    const brc_ring_list *list;
    int gradient, stress, flux, force;
    bool whole_flux; /* of all elements all the same */
} dlsm_extent;

static dlsm_extent extent_of(const brc_simulation *s, const brc_force_request *r)
{
    if (!r->rings) return (dlsm_extent){.list = r->homogeneous ? NULL : brc_contact_bonded(s)};
    const bool rim = brc_rims_gain(s, r->rings); /* rings 2 and 3 are done otherwise */
    return (dlsm_extent){.list = &r->rings->around, .gradient = 0, .stress = 1, .flux = rim ? 1 : 2, .force = rim ? 1 : 3, .whole_flux = r->rings->whole_force};
}

/* H and, where faces are held, their part of G. */
static brc_status dlsm_gradients(brc_simulation *s, const brc_force_request *r, const dlsm_extent *x)
{
    brc_held_faces *h = &s->loads.held;
    BRC_TRY(BRC_PASS(s, s->kernel.gradient, s->kernel.gradient_listed, x->list, x->gradient, BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                     BRC_BUF(s->area), BRC_BUF(r->displacement), BRC_BUF(s->inv_shape), BRC_BUF(s->gradient)));
    if (!r->homogeneous) BRC_TRY(brc_softening_gradient(s, x->list, x->gradient));
    if (h->n_faces)
        BRC_TRY(BRC_LAUNCH(s->kernel.held_gradient, h->n_elements, BRC_INT(h->n_elements), BRC_BUF(h->element),
                           BRC_BUF(h->place), BRC_BUF(h->face_start), BRC_BUF(h->area), BRC_BUF(h->arm), BRC_BUF(h->held),
                           BRC_BUF(r->homogeneous ? h->zero_value : h->value), BRC_BUF(r->displacement), BRC_BUF(s->gradient),
                           BRC_BUF(s->held_gradient)));
    return BRC_OK;
}

/* What held faces, tractions and contact add to Q. */
static brc_status dlsm_face_moments(brc_simulation *s, const brc_force_request *r)
{
    brc_held_faces *h = &s->loads.held;
    const bool touching = brc_contact_acts(s, r);
    if (!has_face_loads(s) && !touching) return BRC_OK;
    BRC_TRY(brc_buffer_fill_zero(s->held_moment));
    if (touching) {
        const brc_step_phase before = brc_phase_within(s, BRC_PHASE_PAIRS);
        BRC_TRY(brc_contact_moments(s, r));
        brc_phase_within(s, before);
    }
    if (h->n_faces)
        BRC_TRY(BRC_LAUNCH(s->kernel.held_moment, h->n_elements, BRC_INT(h->n_elements), BRC_BUF(h->element),
                           BRC_BUF(h->place), BRC_BUF(h->face_start), BRC_BUF(h->area), BRC_BUF(h->arm), BRC_BUF(h->held),
                           BRC_BUF(h->spring), BRC_BUF(r->homogeneous ? h->zero_value : h->value), BRC_BUF(r->displacement),
                           BRC_BUF(s->gradient), BRC_BUF(s->stress), BRC_BUF(s->held_moment)));
    if (r->homogeneous) return BRC_OK;
    const brc_stage *stage = brc_current_stage(s);
    for (int32_t i = 0; i < s->loads.n_tractions; ++i) {
        brc_traction_load *t = s->loads.tractions + i;
        const double factor = brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
        BRC_TRY(BRC_LAUNCH(s->kernel.traction_moment, t->n, BRC_INT(t->n), BRC_COEFF(factor), BRC_BUF(t->place),
                           BRC_BUF(t->moment), BRC_BUF(s->held_moment)));
    }
    return BRC_OK;
}

/* Forces of held faces and tractions on their elements, and their work. */
static brc_status dlsm_face_forces(brc_simulation *s, const brc_force_request *r)
{
    brc_held_faces *h = &s->loads.held;
    if (h->n_faces) {
        /* the linear operator must not disturb reactions and work: the former go to scratch */
        brc_buffer *reaction = r->homogeneous ? h->scratch : h->reaction;
        BRC_TRY(BRC_LAUNCH(s->kernel.held_force, h->n_elements, BRC_INT(h->n_elements), BRC_BUF(h->element),
                           BRC_BUF(h->face_start), BRC_BUF(h->area), BRC_BUF(h->arm), BRC_BUF(h->held), BRC_BUF(h->spring),
                           BRC_BUF(r->homogeneous ? h->zero_value : h->value), BRC_BUF(r->displacement),
                           BRC_BUF(s->gradient), BRC_BUF(s->stress), BRC_INT(r->book), BRC_BUF(r->force),
                           BRC_BUF(reaction), BRC_BUF(h->last), BRC_BUF(h->last_reaction), BRC_BUF(h->work)));
    }
    if (r->homogeneous) return BRC_OK;
    const brc_stage *stage = brc_current_stage(s);
    for (int32_t i = 0; i < s->loads.n_tractions; ++i) {
        brc_traction_load *t = s->loads.tractions + i;
        const double factor = brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
        BRC_TRY(BRC_LAUNCH(s->kernel.traction_force, t->n, BRC_INT(t->n), BRC_STATE(factor), BRC_BUF(t->element),
                           BRC_BUF(t->total), BRC_BUF(t->moment), BRC_BUF(r->displacement), BRC_BUF(s->gradient),
                           BRC_INT(r->book), BRC_STATE(t->last_factor), BRC_BUF(r->force), BRC_BUF(t->reach),
                           BRC_BUF(t->work)));
        if (r->book != BRC_BOOK_NOTHING) t->last_factor = factor;
    }
    return BRC_OK;
}

/* H, P and B. */
static brc_status dlsm_fluxes(brc_simulation *s, const brc_force_request *r, const dlsm_extent *x)
{
    const brc_elastic *m = one_material(s);
    const double one_plus_tau = 1 + s->scene->model.tau;
    const int finite = r->finite ? 1 : 0, face_loads = has_face_loads(s) ? 1 : 0;
    const brc_ring_list *flux_list = x->whole_flux ? NULL : x->list;
    BRC_TRY(dlsm_gradients(s, r, x));
    BRC_TRY(brc_closed_faces_press(s, r));
    if (r->displacement == s->displacement && !r->homogeneous) BRC_TRY(brc_contact_gradients(s));
    if (r->rings && brc_rims_energies_apart(s)) BRC_TRY(brc_rims_stress(s, r, has_face_loads(s)));
    else
        BRC_TRY(BRC_PASS(s, s->kernel.stress, s->kernel.stress_listed, x->list, x->stress, BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                         BRC_BUF(s->area), BRC_BUF(s->offset), BRC_BUF(s->gradient), BRC_BUF(s->inv_volume),
                         BRC_BUF(s->boundary), BRC_BUF(s->held_gradient), BRC_INT(face_loads), BRC_COEFF(m->lambda),
                         BRC_COEFF(m->mu), BRC_BUF(s->material), BRC_INT(finite), BRC_BUF(s->stress)));
    BRC_TRY(dlsm_face_moments(s, r));
    brc_arg args[] = {BRC_INT(0), BRC_INT(0), BRC_INT(0), BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                      BRC_BUF(s->area), BRC_BUF(s->offset), BRC_BUF(s->ratio), BRC_BUF(r->displacement),
                      BRC_BUF(s->gradient), BRC_BUF(s->stress), BRC_BUF(s->inv_shape), BRC_BUF(s->inv_volume),
                      BRC_BUF(s->boundary), BRC_BUF(s->held_moment), BRC_INT(face_loads || brc_contact_acts(s, r) ? 1 : 0), BRC_COEFF(m->k),
                      BRC_COEFF(m->ell), BRC_COEFF(beta(s)), BRC_COEFF(one_plus_tau), BRC_BUF(s->material),
                      BRC_BUF(s->modulus), BRC_BUF(s->ell_of), BRC_INT(finite), BRC_BUF(s->flux), BRC_BUF(s->bond_part),
                      BRC_INT(0), BRC_INT(0), BRC_INT(0)}; /* three free places before, for lists, and behind, for the rim */
    const int n_args = (int)(sizeof args / sizeof *args) - BRC_RIM_ARGS;
    if (r->rings && brc_rims_gain(s, r->rings)) BRC_TRY(brc_rims_flux(s, r->rings, n_args, args));
    else BRC_TRY(brc_pass_launch(s, s->kernel.flux, s->kernel.flux_listed, flux_list, x->flux, n_args, args));
    BRC_TRY(brc_closed_faces_flux(s, r, flux_list, x->flux));
    return r->homogeneous ? BRC_OK : brc_softening_flux(s, flux_list, x->flux);
}

static brc_status dlsm_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const brc_elastic *m = one_material(s);
    const double one_plus_tau = 1 + s->scene->model.tau;
    const dlsm_extent x = extent_of(s, r);
    BRC_TRY(dlsm_fluxes(s, r, &x));
    const brc_ring_list *list = x.whole_flux ? NULL : x.list;
    if (!r->rings && !brc_pass_is_whole(s, list, x.force)) BRC_TRY(brc_buffer_fill_zero(r->force)); /* of cells without bonds */
    if (r->finite && !r->homogeneous && !r->rings && brc_cell_breaks_screens(s)) BRC_TRY(brc_cell_breaks_forces(s, r, list, x.force));
    else
        BRC_TRY(BRC_PASS(s, s->kernel.force, s->kernel.force_listed, list, x.force, BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                         BRC_BUF(s->area), BRC_BUF(s->ratio), BRC_BUF(r->displacement), BRC_BUF(s->flux),
                         BRC_BUF(s->bond_part), BRC_COEFF(m->k), BRC_COEFF(one_plus_tau), BRC_BUF(s->modulus),
                         BRC_BUF(r->force)));
    BRC_TRY(brc_closed_faces_force(s, r, list, x.force));
    if (!r->homogeneous) BRC_TRY(brc_softening_force(s, r->force));
    return dlsm_face_forces(s, r);
}

static brc_status published_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const brc_elastic *m = one_material(s);
    const int finite = r->finite ? 1 : 0;
    const brc_ring_list *list = r->rings && !r->rings->whole_force ? &r->rings->around : NULL;
    if (s->fracture) BRC_TRY(brc_published_breaks_strains(s, r));
    else
        BRC_TRY(BRC_LAUNCH(s->kernel.published_strain, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                           BRC_BUF(s->offset), BRC_BUF(s->area), BRC_INT(s->scene->model.area_weights ? 1 : 0), BRC_BUF(r->displacement),
                           BRC_BUF(r->orientation), BRC_BUF(s->inv_shape), BRC_INT(finite), BRC_BUF(s->gradient)));
    if (brc_cell_breaks_by_bond(s) && r->finite) return brc_published_breaks_force(s, r);
    return BRC_PASS(s, s->kernel.published_force, s->kernel.published_force_listed, list, 2, BRC_BUF(s->row_start),
                    BRC_BUF(s->neighbour), BRC_BUF(s->offset), BRC_BUF(s->area), BRC_BUF(r->displacement),
                    BRC_BUF(r->orientation), BRC_BUF(s->gradient), BRC_COEFF(m->lambda), BRC_COEFF(m->mu),
                    BRC_COEFF(m->young), BRC_COEFF(s->scene->model.rotation_stiffness), BRC_COEFF(s->scene->model.couple_modulus), BRC_BUF(s->lame_of),
                    BRC_INT(finite), BRC_BUF(r->force), BRC_BUF(r->torque));
}

brc_status brc_force_turned_tractions(brc_simulation *s, const brc_force_request *r)
{
    const brc_stage *stage = brc_is_published(s) && s->loads.n_tractions > 0 ? brc_current_stage(s) : NULL;
    for (int32_t i = 0; stage && i < s->loads.n_tractions; ++i) {
        brc_traction_load *t = s->loads.tractions + i;
        const double factor = brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
        BRC_TRY(BRC_LAUNCH(s->kernel.traction_turned, t->n, BRC_INT(t->n), BRC_STATE(factor), BRC_BUF(t->element), BRC_BUF(t->total), BRC_BUF(t->moment),
                           BRC_BUF(r->displacement), BRC_BUF(r->orientation), BRC_INT(r->finite ? 1 : 0), BRC_INT(r->book), BRC_STATE(t->last_factor),
                           BRC_BUF(r->force), BRC_BUF(r->torque), BRC_BUF(t->reach), BRC_BUF(t->work)));
        if (r->book != BRC_BOOK_NOTHING) t->last_factor = factor;
    }
    return BRC_OK;
}

static brc_status beams_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const brc_beam *b = brc_beam_of_element(s, 0);
    if (s->fracture && r->finite) return brc_fracture_force(s, r);
    return BRC_LAUNCH(s->kernel.cbm_force, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                      BRC_BUF(s->offset), BRC_BUF(s->ratio), BRC_BUF(r->displacement),
                      BRC_BUF(r->orientation), BRC_COEFF(b->axial), BRC_COEFF(b->bend), BRC_COEFF(b->twist), BRC_BUF(s->beam_of),
                      BRC_INT(r->finite ? 1 : 0), BRC_BUF(r->force), BRC_BUF(r->torque));
}

brc_status brc_force_evaluate(brc_simulation *s, const brc_force_request *r)
{
    BRC_TRY(brc_is_beams(s) ? beams_evaluate(s, r) : brc_is_published(s) ? published_evaluate(s, r) : dlsm_evaluate(s, r));
    if (r->homogeneous) {
        BRC_TRY(brc_loads_zero_imposed(s, r->force));
        return brc_loads_zero_turned(s, r->torque);
    }
    if (brc_contact_acts(s, r)) {
        const brc_step_phase before = brc_phase_within(s, BRC_PHASE_PAIRS);
        BRC_TRY(brc_contact_forces(s, r));
        brc_phase_within(s, before);
    }
    if (s->scene->has_gravity) {
        const double *g = s->scene->gravity;
        BRC_TRY(BRC_LAUNCH(s->kernel.gravity, s->layout->n_rows, BRC_INT(s->layout->n_rows), BRC_STATE(g[0]), BRC_STATE(g[1]),
                           BRC_STATE(g[2]), BRC_BUF(s->weight), BRC_BUF(r->force)));
    }
    const brc_stage *stage = s->stage >= 0 ? brc_current_stage(s) : NULL;
    BRC_TRY(brc_pushes_apply(s, r));
    BRC_TRY(brc_force_turned_tractions(s, r));
    brc_force_request all = *r;
    if (r->rings && !r->rings->whole_force) { /* from here on forces are those of the whole body */
        const int last = brc_is_published(s) ? 2 : 3;
        if (brc_is_dlsm(s)) BRC_TRY(brc_rims_force(s, r->rings));
        BRC_TRY(brc_rings_replace(s, r->rings, brc_is_dlsm(s) && brc_rims_gain(s, r->rings) ? 1 : last, last));
        all.force = s->force, all.torque = s->torque;
        r = &all;
    }
    for (int32_t i = 0; i < s->loads.n_imposed; ++i) {
        brc_imposed_load *m = s->loads.imposed + i;
        const double rate = stage->solver == BRC_SOLVER_STATIC ? 0 : brc_load_rate(brc_imposed_of(stage, m), r->t);
        BRC_TRY(BRC_LAUNCH(s->kernel.impose_book, m->n, BRC_INT(m->n), BRC_STATE(rate), BRC_STATE(m->last_rate),
                           BRC_INT(r->book), BRC_BUF(m->element), BRC_BUF(m->component), BRC_BUF(m->direction),
                           BRC_BUF(s->mass), BRC_BUF(r->displacement), BRC_BUF(r->force), BRC_BUF(m->reaction),
                           BRC_BUF(m->last), BRC_BUF(m->last_reaction), BRC_BUF(m->work)));
        if (r->book != BRC_BOOK_NOTHING) m->last_rate = rate;
    }
    if (s->strikers) BRC_TRY(brc_strikers_book(s, r->book));
    return brc_turns_book(s, r);
}

static brc_force_request request_of_state(brc_simulation *s, brc_booking book)
{
    const bool is_static = s->stage >= 0 && brc_current_stage(s)->solver == BRC_SOLVER_STATIC;
    return (brc_force_request){.displacement = s->displacement,
                               .force = s->force,
                               .orientation = s->orientation,
                               .torque = s->torque,
                               .finite = !s->scene->model.small_rotations,
                               .book = book,
                               .t = is_static ? s->load_factor : s->time};
}

brc_status brc_force_of_state(brc_simulation *s, brc_booking book)
{
    const brc_force_request request = request_of_state(s, book);
    return brc_force_evaluate(s, &request);
}

brc_status brc_force_gradients_around(brc_simulation *s, const brc_rings *rings)
{
    brc_force_request request = request_of_state(s, BRC_BOOK_NOTHING);
    request.rings = rings;
    const dlsm_extent x = extent_of(s, &request);
    return brc_is_dlsm(s) ? dlsm_gradients(s, &request, &x) : BRC_OK;
}

brc_status brc_force_around_breaks(brc_simulation *s, const brc_rings *rings)
{
    brc_force_request request = request_of_state(s, BRC_BOOK_START);
    request.rings = rings;
    if (!rings->whole_force) request.force = rings->force, request.torque = rings->torque;
    return brc_force_evaluate(s, &request);
}

brc_status brc_force_fluxes_of_state(brc_simulation *s, const brc_ring_list *list, bool moved)
{
    brc_force_request request = request_of_state(s, BRC_BOOK_NOTHING);
    request.listed_pairs = list != NULL;
    const dlsm_extent x = {.list = list, .gradient = moved ? 2 : 0, .stress = 1, .flux = 0};
    return dlsm_fluxes(s, &request, &x);
}

/* Energies of the elements of cells, s->elastic_energy and, of dlsm, s->stabilisation_energy; without those of held faces. */
static brc_status cell_energies(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const brc_elastic *m = one_material(s);
    if (brc_is_published(s)) {
        if (brc_pass_is_whole(s, list, ring))
            return BRC_LAUNCH(s->kernel.published_energy, s->layout->n_rows, BRC_INT(s->layout->n_rows), BRC_BUF(s->gradient), BRC_BUF(s->volume),
                              BRC_COEFF(m->lambda), BRC_COEFF(m->mu), BRC_BUF(s->lame_of), BRC_BUF(s->elastic_energy));
        return BRC_PASS(s, s->kernel.published_energy, s->kernel.published_energy_listed, list, ring, BRC_BUF(s->gradient), BRC_BUF(s->volume),
                        BRC_COEFF(m->lambda), BRC_COEFF(m->mu), BRC_BUF(s->lame_of), BRC_BUF(s->elastic_energy));
    }
    BRC_TRY(BRC_PASS(s, s->kernel.energy, s->kernel.energy_listed, list, ring, BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                     BRC_BUF(s->area), BRC_BUF(s->offset), BRC_BUF(s->ratio), BRC_BUF(s->displacement),
                     BRC_BUF(s->gradient), BRC_BUF(s->inv_volume), BRC_BUF(s->boundary),
                     BRC_BUF(s->held_gradient), BRC_INT(has_face_loads(s) ? 1 : 0), BRC_COEFF(m->lambda), BRC_COEFF(m->mu),
                     BRC_COEFF(m->k), BRC_COEFF(m->ell), BRC_COEFF(beta(s)), BRC_COEFF(1 + s->scene->model.tau),
                     BRC_BUF(s->material), BRC_BUF(s->modulus), BRC_BUF(s->ell_of), BRC_INT(s->scene->model.small_rotations ? 0 : 1),
                     BRC_BUF(s->elastic_energy), BRC_BUF(s->stabilisation_energy)));
    return brc_softening_energy(s);
}

brc_status brc_force_held_energy(brc_simulation *s, double *out)
{
    brc_held_faces *h = &s->loads.held;
    *out = 0;
    if (!h->n_faces) return BRC_OK;
    BRC_TRY(BRC_LAUNCH(s->kernel.held_energy, h->n_elements, BRC_INT(h->n_elements), BRC_BUF(h->element),
                       BRC_BUF(h->face_start), BRC_BUF(h->arm), BRC_BUF(h->held), BRC_BUF(h->spring), BRC_BUF(h->value),
                       BRC_BUF(s->displacement), BRC_BUF(s->gradient), BRC_BUF(h->energy)));
    return brc_vector_sum(s, h->energy, h->n_faces, out);
}

/* V psi of dlsm's elements of a list ... */
static brc_status dlsm_elastic_around(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const brc_elastic *m = one_material(s);
    return BRC_PASS(s, NULL, s->fracture->cells->elastic, list, ring, BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area), BRC_BUF(s->offset), BRC_BUF(s->gradient),
                    BRC_BUF(s->inv_volume), BRC_BUF(s->boundary), BRC_BUF(s->held_gradient), BRC_INT(has_face_loads(s) ? 1 : 0), BRC_COEFF(m->lambda), BRC_COEFF(m->mu),
                    BRC_BUF(s->material), BRC_INT(s->scene->model.small_rotations ? 0 : 1), BRC_BUF(s->elastic_energy));
}
/* ... and the energies of their bonds, each once. */
static brc_status dlsm_bonds_around(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const brc_elastic *m = one_material(s);
    const brc_cell_breaks *c = s->fracture->cells;
    return BRC_PASS(s, NULL, c->bonds, list, ring, BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area), BRC_BUF(s->ratio), BRC_BUF(s->displacement),
                    BRC_BUF(s->gradient), BRC_COEFF(m->k), BRC_COEFF(m->ell), BRC_COEFF(beta(s)), BRC_COEFF(1 + s->scene->model.tau), BRC_BUF(s->material), BRC_BUF(s->modulus),
                    BRC_BUF(s->ell_of), BRC_INT(s->scene->model.small_rotations ? 0 : 1), BRC_BUF(c->rings->touched), BRC_BUF(s->stabilisation_energy));
}

/* Rings 0 and 1 have other strains, bonds of ring 0 alone other energies. */
brc_status brc_force_energy_around(brc_simulation *s, const brc_rings *rings, bool found, double *out)
{
    const brc_ring_list *list = &rings->around;
    const bool apart = brc_rims_energies_apart(s);
    const int ring = found ? 2 : 1, ring_of_bonds = found ? 1 : 0;
    double part[4] = {0};
    if (!apart) BRC_TRY(cell_energies(s, list, ring));
    if (apart && found) BRC_TRY(dlsm_elastic_around(s, list, ring)); /* after breaks: with their stresses */
    if (apart) BRC_TRY(dlsm_bonds_around(s, list, ring_of_bonds));
    BRC_TRY(brc_rings_sum(s, rings, list, ring, s->elastic_energy, &part[0]));
    if (found) BRC_TRY(brc_rings_sum(s, rings, list, 0, s->elastic_energy, &part[1])); /* counted when they were found */
    if (brc_is_dlsm(s)) BRC_TRY(brc_rings_sum(s, rings, list, apart ? ring_of_bonds : ring, s->stabilisation_energy, &part[2]));
    if (brc_is_dlsm(s) && found && !apart) BRC_TRY(brc_rings_sum(s, rings, list, 0, s->stabilisation_energy, &part[3]));
    *out = part[0] - part[1] + part[2] - part[3];
    return BRC_OK;
}

brc_status brc_force_energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    const int32_t n = s->layout->n_rows;
    double held;
    *stabilisation = 0;
    if (brc_is_beams(s)) {
        const brc_beam *b = brc_beam_of_element(s, 0);
        BRC_TRY(BRC_LAUNCH(s->kernel.cbm_energy, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                           BRC_BUF(s->offset), BRC_BUF(s->ratio), BRC_BUF(s->displacement),
                           BRC_BUF(s->orientation), BRC_COEFF(b->axial), BRC_COEFF(b->bend), BRC_COEFF(b->twist), BRC_BUF(s->beam_of),
                           BRC_BUF(s->elastic_energy)));
        BRC_TRY(brc_beam_softening_energy(s));
        BRC_TRY(brc_beam_closure_energy(s));
        return brc_vector_sum(s, s->elastic_energy, n, elastic);
    }
    BRC_TRY(cell_energies(s, NULL, 0));
    BRC_TRY(brc_vector_sum(s, s->elastic_energy, n, elastic));
    if (brc_is_published(s)) return BRC_OK;
    BRC_TRY(brc_vector_sum(s, s->stabilisation_energy, n, stabilisation));
    BRC_TRY(brc_force_held_energy(s, &held));
    *stabilisation += held;
    return BRC_OK;
}
