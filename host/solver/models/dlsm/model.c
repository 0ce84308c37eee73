/* Model dlsm: the conservative law (docs/notebook/theory.md T2). */
#include "../../effects/fracture/cell_breaks.h"
#include "../../effects/effect.h"
#include "brittle_interfaces.h"
#include "cell_softening.h"
#include "closed_faces.h"
#include "dlsm_internal.h"
#include "rims.h"

static bool compacts(const brc_scene *scene)
{
    return scene->model.compaction && scene->model.beta != 0;
}

static const brc_model_breaking breaking = {.create = brc_dlsm_breaks_create,
                                            .area_width = 3,
                                            .wide = true,
                                            .record = "cells_record",
                                            .branches = brc_dlsm_branches,
                                            .mark = brc_dlsm_mark,
                                            .rebuild = brc_dlsm_rebuild,
                                            .loosens = true,
                                            .places = brc_rims_may_add,
                                            .mark_beside = brc_brittle_interfaces_follow,
                                            .ratio = brc_dlsm_ratio,
                                            .gradients_around = brc_dlsm_gradients_around,
                                            .replace_around = brc_dlsm_replace_around,
                                            .energy_around = brc_dlsm_energy_around};

/* The linear law; without compaction and loads on faces what is left of it is the stabilisation. */
static const char *const smoothing[] = {"dlsm_gradient", "dlsm_flux_linear", "dlsm_force", NULL};
static const brc_model_statics statics = {.symmetric = true, .blocks = brc_geometry_precondition_blocks};

/* Friction of broken faces, and what closed ones hold. */
static brc_status energies(brc_simulation *s, const brc_occasion *now)
{
    double opened_rubbed, closed_rubbed, closed;
    BRC_TRY(brc_softening_friction(s, &opened_rubbed));
    BRC_TRY(brc_closed_faces_friction(s, &closed_rubbed));
    BRC_TRY(brc_closed_faces_stored(s, &closed));
    BRC_TRY(brc_vector_sums(s));
    now->ledger->friction += opened_rubbed + closed_rubbed;
    now->ledger->contact += closed;
    return BRC_OK;
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_RESTART, .plain = brc_closed_faces_restart},
                                    {.hook = BRC_HOOK_MOVED,
                                     .order = BRC_MOVED_BONDS,
                                     .phase = BRC_PHASE_FRACTURE,
                                     .plain = brc_softening_move,
                                     .due = brc_softening_is_on},
                                    {.hook = BRC_HOOK_LEDGER, .call = energies}};
static const brc_field_table *const fields[] = {&brc_softening_fields, &brc_open_list_fields, &brc_closed_face_fields,
                                                &brc_brittle_interface_fields, NULL};

extern const brc_bond_model brc_dlsm;
const brc_bond_model brc_dlsm = {
    .element = BRC_ELEMENT_CELL,
    .deforms = true,
    .surface = BRC_SURFACE_AFFINE,
    .effect = {{"conservative elasticity (dlsm)", NULL}, {"compaction", compacts}},
    .create = brc_dlsm_create,
    .free = brc_dlsm_free,
    .make_passes = brc_dlsm_make_passes,
    .make_face_passes = brc_dlsm_make_face_passes,
    .evaluate = brc_dlsm_evaluate,
    .energies = brc_dlsm_energies,
    .refresh = brc_dlsm_refresh,
    .fluxes_of_state = brc_dlsm_fluxes_of_state,
    .step_passes = brc_dlsm_step_passes,
    .strain_stress = brc_dlsm_strain_stress,
    .face_displacement = brc_dlsm_face_displacement,
    .statics = &statics,
    .smoothing = smoothing,
    .conserves = true,
    .upload = brc_dlsm_upload,
    .create_fracture = brc_cell_breaks_create,
    .break_bonds = brc_cell_breaks_fail,
    .breaking = &breaking,
    .cohesion = &brc_dlsm_cohesion,
    .fields = fields,
    BRC_HOOKED(hooked),
};
