/* Model dlsm-published: the published law, AGH19 (docs/notebook/theory.md T3). */
#include "published.h"

static const brc_model_breaking breaking = {.replace_around = brc_published_replace_around,
                                            .energy_around = brc_published_energy_around};

extern const brc_bond_model brc_published;
const brc_bond_model brc_published = {
    .element = BRC_ELEMENT_CELL,
    .turns = true,
    .surface = BRC_SURFACE_RIGID,
    .effect = {{"published elasticity and element rotations (dlsm-published)", NULL}},
    .make_passes = brc_published_make_passes,
    .make_face_passes = brc_published_make_face_passes,
    .evaluate = brc_published_evaluate,
    .late_tractions = brc_published_tractions,
    .energies = brc_published_energies,
    .floor_bytes = brc_published_floor_bytes,
    .strain_stress = brc_published_strain_stress,
    .face_displacement = brc_published_face_displacement,
    .breaking = &breaking,
};
