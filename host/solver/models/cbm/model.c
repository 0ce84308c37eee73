/* Model cbm: spheres joined by beams, NAH19 (docs/notebook/beams.md). */
#include "cbm.h"

extern const brc_bond_model brc_cbm;
const brc_bond_model brc_cbm = {
    .element = BRC_ELEMENT_SPHERE,
    .turns = true,
    .surface = BRC_SURFACE_SPHERE,
    .effect = {{"beams and element rotations (cbm)", NULL}},
    .make_passes = brc_cbm_make_passes,
    .evaluate = brc_cbm_evaluate,
    .energies = brc_cbm_energies,
    .floor_bytes = brc_cbm_floor_bytes,
    .strain_stress = brc_cbm_strain_stress,
    .virial_stress = brc_beams_stress,
};
