/* Model dlsm-published: the published law, AGH19 (docs/notebook/theory.md T3). */
#include "../../effects/fracture/cell_breaks.h"
#include "../../effects/guard_cause.h"
#include "published_internal.h"

static const brc_model_breaking breaking = {.create = brc_published_breaks_create,
                                            .area_width = 1,
                                            .record = "cells_record_published",
                                            .branches = brc_published_branches,
                                            .mark = brc_published_mark,
                                            .rebuild = brc_published_rebuild,
                                            .ratio = brc_published_ratio,
                                            .replace_around = brc_published_replace_around,
                                            .energy_around = brc_published_energy_around};

/* Forces balance a total moment only together with rotations, so that displacements alone reach equilibrium to some
 * 1e-6 of the load (measured on cubes of 512 cells), not to rounding. */
static const brc_model_statics statics = {.linear = true,
                                          .least_tolerance = 1e-5,
                                          .soft = 1e-6,
                                          .blocks = brc_geometry_precondition_blocks,
                                          .torques = brc_published_torques};

static void explain_loss(const brc_simulation *s, char *text, size_t size)
{
    brc_text_append(
        text, size,
        "the published law has no energy and diverges after thousands of steps (docs/notebook/theory.md): "
        "use model dlsm, %stchamwa-wielgosz with a larger phi",
        s->scene->model.couple_modulus > 0 ? "or " : "a couple_modulus of 0.5 where strains or turns are large, or ");
}

extern const brc_bond_model brc_published;
const brc_bond_model brc_published = {
    .element = BRC_ELEMENT_CELL,
    .turns = true,
    .surface = BRC_SURFACE_RIGID,
    .effect = {{"published elasticity and element rotations (dlsm-published)", NULL}},
    .create = brc_published_create,
    .free = brc_published_free,
    .make_passes = brc_published_make_passes,
    .make_face_passes = brc_published_make_face_passes,
    .evaluate = brc_published_evaluate,
    .late_tractions = brc_published_tractions,
    .energies = brc_published_energies,
    .step_passes = brc_published_step_passes,
    .strain_stress = brc_published_strain_stress,
    .face_displacement = brc_published_face_displacement,
    .statics = &statics,
    .explain_loss = explain_loss,
    .upload = brc_published_upload,
    .create_fracture = brc_cell_breaks_create,
    .break_bonds = brc_cell_breaks_fail,
    .breaking = &breaking,
};
