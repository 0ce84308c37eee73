/* Model dlsm-published: the published law, AGH19 (docs/notebook/theory.md T3). */
#include "../model.h"

extern const brc_bond_model brc_published;
const brc_bond_model brc_published = {
    .element = BRC_ELEMENT_CELL,
    .turns = true,
    .surface = BRC_SURFACE_RIGID,
    .effect = {{"published elasticity and element rotations (dlsm-published)", NULL}},
};
