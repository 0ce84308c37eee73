/* Forces and energies of dlsm: the order of its passes (docs/notebook/theory.md T2). */
#include "cell_softening.h"
#include "closed_faces.h"
#include "../../core/awake.h"
#include "../../effects/contact/contact.h"
#include "../../effects/loads/loads.h"
#include "dlsm_internal.h"
#include "rims.h"

/* The rings that each pass of dlsm goes over: list NULL, all elements. Where most cells are without bonds those with
 * bonds are all that is gone over. */
typedef struct extent {
    const brc_ring_list *list;
    int gradient, stress, flux, force;
    bool whole_flux;                  /* of all elements all the same */
    bool held_gradients, held_forces; /* the passes do these of the held faces too; of stresses moments and reactions */
} extent;

static extent extent_of(const brc_simulation *s, const brc_force_request *r)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    if (!r->rings) return (extent){.list = r->homogeneous ? NULL : brc_contact_bonded(s)};
    const bool rim = brc_rims_add(s, r->rings); /* rings 2 and 3 are done otherwise */
    return (extent){.list = brc_rings_around(r->rings),
                    .gradient = own->ring.gradient,
                    .stress = own->ring.stress,
                    .flux = rim ? 1 : own->ring.flux,
                    .force = rim ? 1 : own->ring.force,
                    .whole_flux = brc_rings_are_whole(r->rings)};
}

/* A body of more rows fills a GPU: registers that held faces take of every row are then worth more than launches. */
enum { MOST_ROWS_HELD = 1 << 18 };

/* Held faces: launches of their own in large bodies, where other things are added between, and over lists. */
static void hold_in_passes(const brc_simulation *s, const brc_force_request *r, extent *x)
{
    x->held_gradients = brc_loads_n_held_faces(s) > 0 && s->layout->n_rows <= MOST_ROWS_HELD && !r->homogeneous &&
                        !r->rings && !x->list && !brc_softening_acts(s) && brc_pass_may_do_more(s);
    x->held_forces = x->held_gradients && !brc_closed_faces_act(s, r);
}

/* H and, where faces are held, their part of G. */
static brc_status gradients(brc_simulation *s, const brc_force_request *r, const extent *x)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    if (x->held_gradients) return brc_pass_run_awake(s, own->gradient_held, s->n_groups, r, NULL);
    BRC_TRY(brc_pass_over(s, own->gradient, own->gradient_listed, x->list, x->gradient, r, NULL));
    if (!r->homogeneous) BRC_TRY(brc_softening_gradient(s, x->list, x->gradient));
    return brc_held_faces_run(s, own->held_gradient, r, false);
}

/* What held faces, tractions and contact add to Q. */
static brc_status face_moments(brc_simulation *s, const brc_force_request *r, const extent *x)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    const bool touching = brc_contact_acts(s, r);
    if (x->held_forces && !touching) return brc_traction_moments_run(s, own->traction_moment, r);
    if (!brc_loads_on_faces(s) && !touching) return BRC_OK;
    BRC_TRY(brc_buffer_fill_zero(brc_held_moment_of(s)));
    if (touching) {
        const brc_step_phase before = brc_phase_within(s, BRC_PHASE_PAIRS);
        BRC_TRY(brc_contact_moments(s, r));
        brc_phase_within(s, before);
    }
    BRC_TRY(brc_held_faces_run(s, own->held_moment, r, false));
    return r->homogeneous ? BRC_OK : brc_traction_moments_run(s, own->traction_moment, r);
}

/* Forces of held faces and tractions on their elements, and their work. */
static brc_status face_forces(brc_simulation *s, const brc_force_request *r, const extent *x)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    if (!x->held_forces) BRC_TRY(brc_held_faces_run(s, own->held_force, r, true));
    return r->homogeneous ? BRC_OK : brc_traction_forces_run(s, own->traction_force, r);
}

/* H, P and B. */
static brc_status fluxes(brc_simulation *s, const brc_force_request *r, const extent *x)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    const brc_ring_list *flux_list = x->whole_flux ? NULL : x->list;
    BRC_TRY(gradients(s, r, x));
    BRC_TRY(brc_closed_faces_press(s, r));
    if (r->displacement == brc_displacement_of(s) && !r->homogeneous) BRC_TRY(brc_contact_gradients(s));
    if (x->held_forces)
        BRC_TRY(brc_pass_run_awake(s, own->stress_held, s->n_groups, r, NULL));
    else if (r->rings && brc_rims_energies_apart(s))
        BRC_TRY(brc_rims_stress(s, r));
    else
        BRC_TRY(brc_pass_over(s, own->stress, own->stress_listed, x->list, x->stress, r, NULL));
    BRC_TRY(face_moments(s, r, x));
    const bool moments = brc_loads_on_faces(s) || brc_contact_acts(s, r);
    if (r->rings && brc_rims_add(s, r->rings))
        BRC_TRY(brc_rims_flux(s, r, moments));
    else
        BRC_TRY(brc_pass_over(s, r->finite ? own->flux : own->flux_linear, own->flux_listed, flux_list, x->flux, r,
                              BRC_GIVEN({"face_loads", BRC_INT(moments ? 1 : 0)})));
    BRC_TRY(brc_closed_faces_flux(s, r, flux_list, x->flux));
    return r->homogeneous ? BRC_OK : brc_softening_flux(s, flux_list, x->flux);
}

brc_status brc_dlsm_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    extent x = extent_of(s, r);
    hold_in_passes(s, r, &x);
    BRC_TRY(fluxes(s, r, &x));
    const brc_ring_list *list = x.whole_flux ? NULL : x.list;
    const bool screens = !r->homogeneous && !r->rings && brc_dlsm_screens(s);
    if (!r->rings && !brc_pass_is_whole(s, list, x.force))
        BRC_TRY(brc_buffer_fill_zero(r->force)); /* of cells without bonds */
    if (x.held_forces)
        BRC_TRY(brc_pass_run_awake(s, screens ? own->screening_force_held : own->force_held, s->n_groups, r, NULL));
    else if (screens)
        BRC_TRY(brc_dlsm_screening_forces(s, r, list, x.force));
    else
        BRC_TRY(brc_pass_over(s, own->force, own->force_listed, list, x.force, r, NULL));
    BRC_TRY(brc_closed_faces_force(s, r, list, x.force));
    if (!r->homogeneous) BRC_TRY(brc_softening_force(s, r->force));
    return face_forces(s, r, &x);
}

brc_status brc_dlsm_gradients_around(brc_simulation *s, const brc_force_request *r)
{
    const extent x = extent_of(s, r);
    return gradients(s, r, &x);
}

brc_status brc_dlsm_fluxes_of_state(brc_simulation *s, const brc_ring_list *list, bool moved)
{
    brc_force_request request = brc_force_request_of_state(s, BRC_BOOK_NOTHING);
    request.listed_pairs = list != NULL;
    const extent x = {.list = list, .gradient = moved ? 2 : 0, .stress = 1, .flux = 0};
    return fluxes(s, &request, &x);
}

brc_status brc_dlsm_refresh(brc_simulation *s)
{
    return brc_dlsm_fluxes_of_state(s, NULL, true);
}

brc_status brc_dlsm_replace_around(brc_simulation *s, const brc_rings *rings)
{
    BRC_TRY(brc_rims_force(s, rings));
    return brc_rings_replace(s, rings, brc_rims_add(s, rings) ? 1 : 3, 3);
}

/* Energies of the elements, brc_elastic_energy_of(s) and brc_stabilisation_energy_of(s), without those of held faces.
 */
static brc_status element_energies(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    BRC_TRY(brc_pass_over(s, own->energy, own->energy_listed, list, ring, NULL, NULL));
    return brc_softening_energy(s);
}

/* V psi of elements of a list ... */
static brc_status elastic_around(brc_simulation *s, const brc_ring_list *list, int ring)
{
    return brc_pass_over(s, NULL, brc_dlsm_own_of(s)->elastic, list, ring, NULL, NULL);
}
/* ... and the energies of their bonds, each once. */
static brc_status bonds_around(brc_simulation *s, const brc_ring_list *list, int ring)
{
    return brc_pass_over(s, NULL, brc_dlsm_own_of(s)->bonds, list, ring, NULL, NULL);
}

/* Rings 0 and 1 have other strains, bonds of ring 0 alone other energies. */
brc_status brc_dlsm_energy_around(brc_simulation *s, const brc_rings *rings, bool found, double part[4])
{
    const brc_ring_list *list = brc_rings_around(rings);
    const bool apart = brc_rims_energies_apart(s);
    const int ring = found ? 2 : 1, ring_of_bonds = found ? 1 : 0;
    part[1] = part[3] = 0;
    if (!apart) BRC_TRY(element_energies(s, list, ring));
    if (apart && found) BRC_TRY(elastic_around(s, list, ring)); /* after breaks: with their stresses */
    if (apart) BRC_TRY(bonds_around(s, list, ring_of_bonds));
    BRC_TRY(brc_rings_sum(s, list, ring, brc_elastic_energy_of(s), &part[0]));
    if (found)
        BRC_TRY(brc_rings_sum(s, list, 0, brc_elastic_energy_of(s), &part[1])); /* counted when they were found */
    BRC_TRY(brc_rings_sum(s, list, apart ? ring_of_bonds : ring, brc_stabilisation_energy_of(s), &part[2]));
    if (!found || apart) return BRC_OK;
    return brc_rings_sum(s, list, 0, brc_stabilisation_energy_of(s), &part[3]);
}

brc_status brc_dlsm_energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    const int32_t n = s->layout->n_rows;
    double held;
    BRC_TRY(element_energies(s, NULL, 0));
    BRC_TRY(brc_vector_sum(s, brc_elastic_energy_of(s), n, elastic));
    BRC_TRY(brc_vector_sum(s, brc_stabilisation_energy_of(s), n, stabilisation));
    BRC_TRY(brc_force_held_energy(s, &held));
    BRC_TRY(brc_vector_sums(s));
    *stabilisation += held;
    return BRC_OK;
}
