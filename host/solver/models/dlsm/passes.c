/* Passes of dlsm. */
#include "../../core/awake.h"
#include "dlsm_internal.h"

brc_status brc_dlsm_create(brc_simulation *s)
{
    return brc_memory_allocate(s->context, &s->of_model, 1, sizeof(brc_dlsm_own), "model dlsm");
}

void brc_dlsm_free(brc_simulation *s)
{
    brc_memory_free(s->of_model);
}

/* A broken bond has other rows of its two elements. */
static brc_status derive_rings(brc_simulation *s, brc_dlsm_own *p)
{
    const brc_pass *const passes[] = {p->gradient, p->stress, p->flux, p->force};
    int ring[4];
    BRC_TRY(brc_passes_rings(4, passes, "area inv_shape", ring));
    BRC_TRY(brc_awake_passes(s, 4, passes));
    p->ring.gradient = ring[0], p->ring.stress = ring[1], p->ring.flux = ring[2], p->ring.force = ring[3];
    return BRC_OK;
}

brc_status brc_dlsm_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    brc_dlsm_own *p = brc_dlsm_own_of(s);
    const bool whole = !s->scene->has_fracture;
    const brc_pass_wanted of_requests[] = {
        {&p->gradient, "dlsm_gradient", NULL, false},
        {&p->stress, "dlsm_stress", NULL, false},
        {&p->flux, "dlsm_flux_pass", "face_loads", false},
        {&p->flux_linear, "dlsm_flux_linear", "face_loads", false},
        {&p->force, "dlsm_force", NULL, false},
        {&p->gradient_listed, "dlsm_gradient_listed", BRC_LISTED, whole},
        {&p->stress_listed, "dlsm_stress_listed", BRC_LISTED, whole},
        {&p->flux_listed, "dlsm_flux_pass_listed", BRC_LISTED " face_loads", whole},
        {&p->force_listed, "dlsm_force_listed", BRC_LISTED, whole},
    };
    BRC_TRY(BRC_PASSES_MAKE(s, request, of_requests));
    BRC_TRY(derive_rings(s, p));
    const brc_pass_wanted of_state[] = {
        {&p->energy, "dlsm_energy", NULL, false},
        {&p->energy_listed, "dlsm_energy_listed", BRC_LISTED, whole},
        {&p->deformation, "dlsm_deformation", "face_loads deformation", false},
        {&p->face_displacement, "face_displacement", "element arm out", false},
    };
    return BRC_PASSES_MAKE(s, run, of_state);
}

brc_status brc_dlsm_make_face_passes(brc_simulation *s, const brc_face_scopes *in)
{
    brc_dlsm_own *p = brc_dlsm_own_of(s);
    BRC_TRY(BRC_PASSES(s, in->held, BRC_PASS(&p->held_gradient, "held_gradient_pass", "value"),
                       BRC_PASS(&p->held_moment, "held_moment_pass", "value"),
                       BRC_PASS(&p->held_force, "held_force_pass", "value reaction")));
    const bool none = !s->wants.face_loads;
    BRC_TRY(BRC_PASSES(s, in->held, {&p->gradient_held, "dlsm_gradient_held", NULL, none},
                       {&p->stress_held, "dlsm_stress_held", NULL, none},
                       {&p->force_held, "dlsm_force_held", NULL, none}));
    BRC_TRY(BRC_PASSES(s, in->held_state, BRC_PASS(in->energy, "held_energy", NULL)));
    BRC_TRY(BRC_PASSES(s, in->held_load, BRC_PASS(in->prescribe, "held_prescribe", "factor")));
    return BRC_PASSES(s, in->traction, BRC_PASS(&p->traction_moment, "traction_moment_pass", "factor"),
                      BRC_PASS(&p->traction_force, "traction_force_pass", "factor"));
}
