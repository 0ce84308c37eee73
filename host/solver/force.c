/* One evaluation of the forces of a model: the order of the passes, nothing else (docs/notebook/theory.md T2 and T3,
 * docs/notebook/beams.md). */
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

/* The rings that each pass of dlsm goes over: list NULL, all elements. Where most cells are without bonds those with
 * bonds are all that is gone over. */
typedef struct dlsm_extent {
    const brc_ring_list *list;
    int gradient, stress, flux, force;
    bool whole_flux; /* of all elements all the same */
} dlsm_extent;

static dlsm_extent extent_of(const brc_simulation *s, const brc_force_request *r)
{
    if (!r->rings) return (dlsm_extent){.list = r->homogeneous ? NULL : brc_contact_bonded(s)};
    const bool rim = brc_rims_gain(s, r->rings); /* rings 2 and 3 are done otherwise */
    return (dlsm_extent){.list = &r->rings->around,
                         .gradient = 0,
                         .stress = 1,
                         .flux = rim ? 1 : 2,
                         .force = rim ? 1 : 3,
                         .whole_flux = r->rings->whole_force};
}

/* H and, where faces are held, their part of G. */
static brc_status dlsm_gradients(brc_simulation *s, const brc_force_request *r, const dlsm_extent *x)
{
    brc_held_faces *h = &s->loads.held;
    BRC_TRY(brc_pass_over(s, s->pass.gradient, s->pass.gradient_listed, x->list, x->gradient, r, NULL));
    if (!r->homogeneous) BRC_TRY(brc_softening_gradient(s, x->list, x->gradient));
    if (h->n_faces)
        BRC_TRY(BRC_RUN_ON(s->pass.held_gradient, h->n_elements, r, NULL,
                           {"value", BRC_BUF(r->homogeneous ? h->zero_value : h->value)}));
    return BRC_OK;
}

/* What held faces, tractions and contact add to Q. */
static brc_status dlsm_face_moments(brc_simulation *s, const brc_force_request *r)
{
    brc_held_faces *h = &s->loads.held;
    const bool touching = brc_contact_acts(s, r);
    if (!s->loads.on_faces && !touching) return BRC_OK;
    BRC_TRY(brc_buffer_fill_zero(s->held_moment));
    if (touching) {
        const brc_step_phase before = brc_phase_within(s, BRC_PHASE_PAIRS);
        BRC_TRY(brc_contact_moments(s, r));
        brc_phase_within(s, before);
    }
    if (h->n_faces)
        BRC_TRY(BRC_RUN_ON(s->pass.held_moment, h->n_elements, r, NULL,
                           {"value", BRC_BUF(r->homogeneous ? h->zero_value : h->value)}));
    if (r->homogeneous) return BRC_OK;
    const brc_stage *stage = brc_current_stage(s);
    for (int32_t i = 0; i < s->loads.n_tractions; ++i) {
        brc_traction_load *t = s->loads.tractions + i;
        const double factor = brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
        BRC_TRY(BRC_RUN_ON(s->pass.traction_moment, t->n, NULL, t, {"factor", BRC_COEFF(factor)}));
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
        BRC_TRY(BRC_RUN_ON(s->pass.held_force, h->n_elements, r, NULL,
                           {"value", BRC_BUF(r->homogeneous ? h->zero_value : h->value)},
                           {"reaction", BRC_BUF(reaction)}));
    }
    if (r->homogeneous) return BRC_OK;
    const brc_stage *stage = brc_current_stage(s);
    for (int32_t i = 0; i < s->loads.n_tractions; ++i) {
        brc_traction_load *t = s->loads.tractions + i;
        const double factor = brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
        BRC_TRY(BRC_RUN_ON(s->pass.traction_force, t->n, r, t, {"factor", BRC_STATE(factor)}));
        if (r->book != BRC_BOOK_NOTHING) t->last_factor = factor;
    }
    return BRC_OK;
}

/* H, P and B. */
static brc_status dlsm_fluxes(brc_simulation *s, const brc_force_request *r, const dlsm_extent *x)
{
    const brc_ring_list *flux_list = x->whole_flux ? NULL : x->list;
    BRC_TRY(dlsm_gradients(s, r, x));
    BRC_TRY(brc_closed_faces_press(s, r));
    if (r->displacement == s->displacement && !r->homogeneous) BRC_TRY(brc_contact_gradients(s));
    if (r->rings && brc_rims_energies_apart(s))
        BRC_TRY(brc_rims_stress(s, r));
    else
        BRC_TRY(brc_pass_over(s, s->pass.stress, s->pass.stress_listed, x->list, x->stress, r, NULL));
    BRC_TRY(dlsm_face_moments(s, r));
    const bool moments = s->loads.on_faces || brc_contact_acts(s, r);
    if (r->rings && brc_rims_gain(s, r->rings))
        BRC_TRY(brc_rims_flux(s, r, moments));
    else
        BRC_TRY(brc_pass_over(s, s->pass.flux, s->pass.flux_listed, flux_list, x->flux, r,
                              BRC_GIVEN({"face_loads", BRC_INT(moments ? 1 : 0)})));
    BRC_TRY(brc_closed_faces_flux(s, r, flux_list, x->flux));
    return r->homogeneous ? BRC_OK : brc_softening_flux(s, flux_list, x->flux);
}

static brc_status dlsm_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const dlsm_extent x = extent_of(s, r);
    BRC_TRY(dlsm_fluxes(s, r, &x));
    const brc_ring_list *list = x.whole_flux ? NULL : x.list;
    if (!r->rings && !brc_pass_is_whole(s, list, x.force))
        BRC_TRY(brc_buffer_fill_zero(r->force)); /* of cells without bonds */
    if (r->finite && !r->homogeneous && !r->rings && brc_cell_breaks_screens(s))
        BRC_TRY(brc_cell_breaks_forces(s, r, list, x.force));
    else
        BRC_TRY(brc_pass_over(s, s->pass.force, s->pass.force_listed, list, x.force, r, NULL));
    BRC_TRY(brc_closed_faces_force(s, r, list, x.force));
    if (!r->homogeneous) BRC_TRY(brc_softening_force(s, r->force));
    return dlsm_face_forces(s, r);
}

static brc_status published_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const brc_ring_list *list = r->rings && !r->rings->whole_force ? &r->rings->around : NULL;
    if (s->fracture)
        BRC_TRY(brc_published_breaks_strains(s, r));
    else
        BRC_TRY(brc_pass_run_on(s->pass.published_strain, s->n_groups, r, NULL, NULL));
    if (brc_cell_breaks_by_bond(s) && r->finite) return brc_published_breaks_force(s, r);
    return brc_pass_over(s, s->pass.published_force, s->pass.published_force_listed, list, 2, r, NULL);
}

brc_status brc_force_turned_tractions(brc_simulation *s, const brc_force_request *r)
{
    const brc_stage *stage = brc_is_published(s) && s->loads.n_tractions > 0 ? brc_current_stage(s) : NULL;
    for (int32_t i = 0; stage && i < s->loads.n_tractions; ++i) {
        brc_traction_load *t = s->loads.tractions + i;
        const double factor = brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
        BRC_TRY(BRC_RUN_ON(s->pass.traction_turned, t->n, r, t, {"factor", BRC_STATE(factor)}));
        if (r->book != BRC_BOOK_NOTHING) t->last_factor = factor;
    }
    return BRC_OK;
}

static brc_status beams_evaluate(brc_simulation *s, const brc_force_request *r)
{
    if (s->fracture && r->finite) return brc_fracture_force(s, r);
    return brc_pass_run_on(s->pass.cbm_force, s->n_groups, r, NULL, NULL);
}

brc_status brc_force_evaluate(brc_simulation *s, const brc_force_request *r)
{
    BRC_TRY(brc_is_beams(s)       ? beams_evaluate(s, r)
            : brc_is_published(s) ? published_evaluate(s, r)
                                  : dlsm_evaluate(s, r));
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
        BRC_TRY(brc_pass_run_on(s->pass.gravity, s->layout->n_rows, r, NULL, NULL));
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
        BRC_TRY(BRC_RUN_ON(s->pass.impose_book, m->n, r, m, {"rate", BRC_STATE(rate)}));
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

/* Energies of the elements of cells, s->elastic_energy and, of dlsm, s->stabilisation_energy; without those of held
 * faces. */
static brc_status cell_energies(brc_simulation *s, const brc_ring_list *list, int ring)
{
    if (brc_is_published(s)) {
        if (brc_pass_is_whole(s, list, ring)) return brc_pass_run(s->pass.published_energy, s->layout->n_rows);
        return brc_pass_over(s, s->pass.published_energy, s->pass.published_energy_listed, list, ring, NULL, NULL);
    }
    BRC_TRY(brc_pass_over(s, s->pass.energy, s->pass.energy_listed, list, ring, NULL, NULL));
    return brc_softening_energy(s);
}

brc_status brc_force_held_energy(brc_simulation *s, double *out)
{
    brc_held_faces *h = &s->loads.held;
    *out = 0;
    if (!h->n_faces) return BRC_OK;
    BRC_TRY(brc_pass_run(s->pass.held_energy, h->n_elements));
    return brc_vector_sum(s, h->energy, h->n_faces, out);
}

/* V psi of dlsm's elements of a list ... */
static brc_status dlsm_elastic_around(brc_simulation *s, const brc_ring_list *list, int ring)
{
    return brc_pass_over(s, NULL, s->fracture->cells->elastic, list, ring, NULL, NULL);
}
/* ... and the energies of their bonds, each once. */
static brc_status dlsm_bonds_around(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const brc_cell_breaks *c = s->fracture->cells;
    return brc_pass_over(s, NULL, c->bonds, list, ring, NULL, NULL);
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
    BRC_TRY(brc_rings_sum(s, list, ring, s->elastic_energy, &part[0]));
    if (found) BRC_TRY(brc_rings_sum(s, list, 0, s->elastic_energy, &part[1])); /* counted when they were found */
    if (brc_is_dlsm(s))
        BRC_TRY(brc_rings_sum(s, list, apart ? ring_of_bonds : ring, s->stabilisation_energy, &part[2]));
    if (brc_is_dlsm(s) && found && !apart) BRC_TRY(brc_rings_sum(s, list, 0, s->stabilisation_energy, &part[3]));
    *out = part[0] - part[1] + part[2] - part[3];
    return BRC_OK;
}

brc_status brc_force_energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    const int32_t n = s->layout->n_rows;
    double held;
    *stabilisation = 0;
    if (brc_is_beams(s)) {
        BRC_TRY(brc_pass_run(s->pass.cbm_energy, s->n_groups));
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
