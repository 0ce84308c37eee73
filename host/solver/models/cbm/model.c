/* Model cbm: spheres joined by beams, NAH19 (docs/notebook/beams.md). */
#include "../model.h"

extern const brc_bond_model brc_cbm;
const brc_bond_model brc_cbm = {
    .element = BRC_ELEMENT_SPHERE,
    .turns = true,
    .surface = BRC_SURFACE_SPHERE,
    .effect = {{"beams and element rotations (cbm)", NULL}},
};
