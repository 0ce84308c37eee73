/* Model dlsm, shared by its files. */
#ifndef BRC_SOLVER_MODELS_DLSM_DLSM_H
#define BRC_SOLVER_MODELS_DLSM_DLSM_H

#include "../../effects/fracture/breaking.h"

/* What a run of it keeps. */
typedef struct brc_dlsm_own {
    brc_pass *gradient, *stress, *flux, *flux_linear, *force, *energy, *deformation, *face_displacement;
    brc_pass *gradient_listed, *stress_listed, *flux_listed, *force_listed, *energy_listed; /* only with fracture */
    brc_pass *held_gradient, *held_moment, *held_force, *traction_moment, *traction_force;
    brc_pass *gradient_held, *stress_held, *force_held, *screening_force_held; /* with the held faces; NULL: none is */
    brc_pass *screening_force, *screening_force_listed, *check, *ratio, *rebuild, *elastic, *bonds; /* breaks.c */
    brc_pass *rim_stress, *rim_inner_flux, *rim_flux, *rim_force;                                   /* rims.c */
    struct brc_softening_faces *softening; /* faces that open against cohesion (cell_softening.c); NULL: none does */
    struct brc_brittle_interfaces *interfaces; /* that break at once (brittle_interfaces.c); NULL: there are none */
    int32_t joined;                            /* 1: there are */
    brc_buffer *along;                         /* their normals (brittle_interfaces.cl); borrowed */
    struct brc_closed_faces *closed; /* sides of broken faces that bear on each other (closed_faces.c); NULL: none do */
    struct {
        int gradient, stress, flux, force;
    } ring; /* the last ring around broken bonds where each has other results (brc_passes_rings) */
} brc_dlsm_own;
static inline brc_dlsm_own *brc_dlsm_own_of(const brc_simulation *s)
{
    return s->of_model;
}

/* ---- passes.c ---- */
brc_status brc_dlsm_create(brc_simulation *s);
void brc_dlsm_free(brc_simulation *s);
brc_status brc_dlsm_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request);
brc_status brc_dlsm_make_face_passes(brc_simulation *s, const brc_face_scopes *in);

/* ---- force.c ---- */
brc_status brc_dlsm_evaluate(brc_simulation *s, const brc_force_request *r);
brc_status brc_dlsm_energies(brc_simulation *s, double *elastic, double *stabilisation);
/* The gradients of the state, by which its surfaces reach. */
brc_status brc_dlsm_refresh(brc_simulation *s);
/* Of the state only H, P and B, with which the forces of single bonds can be formed; books nothing. list (NULL: all
 * elements): B is wanted in its ring 0, so P in ring 1 and H, where the elements moved, in ring 2, else in ring 0. */
brc_status brc_dlsm_fluxes_of_state(brc_simulation *s, const brc_ring_list *list, bool moved);
/* Around breaks: as brc_model_breaking says. */
brc_status brc_dlsm_gradients_around(brc_simulation *s, const brc_force_request *r);
brc_status brc_dlsm_replace_around(brc_simulation *s, const brc_rings *rings);
brc_status brc_dlsm_energy_around(brc_simulation *s, const brc_rings *rings, bool found, double part[4]);

/* ---- breaks.c: as brc_model_breaking says ---- */
brc_status brc_dlsm_breaks_create(brc_simulation *s);
brc_status brc_dlsm_mark(brc_simulation *s, double share);
brc_status brc_dlsm_rebuild(brc_simulation *s);
brc_status brc_dlsm_ratio(brc_simulation *s, double *out);
brc_status brc_dlsm_branches(brc_simulation *s, brc_buffer **out);
/* The last pass of the full law, but for that after breaks, finds which elements may lose bonds: the next function in
 * its place, of the rings 0 to `ring` of a list, NULL: of all. */
bool brc_dlsm_screens(const brc_simulation *s);
brc_status brc_dlsm_screening_forces(brc_simulation *s, const brc_force_request *r, const brc_ring_list *list,
                                     int ring);

/* ---- cohesion.c ---- */
extern const brc_model_cohesion brc_dlsm_cohesion;

/* ---- geometry.c ---- */
brc_status brc_dlsm_upload(brc_simulation *s);

/* ---- observe.c: what is read of a state ---- */
brc_status brc_dlsm_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy);
brc_status brc_dlsm_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out);
int brc_dlsm_step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES]);

#endif
