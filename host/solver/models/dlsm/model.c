/* Model dlsm: the conservative law (docs/notebook/theory.md T2). */
#include "../model.h"

static bool compacts(const brc_scene *scene)
{
    return scene->model.compaction && scene->model.beta != 0;
}

extern const brc_bond_model brc_dlsm;
const brc_bond_model brc_dlsm = {
    .element = BRC_ELEMENT_CELL,
    .deforms = true,
    .surface = BRC_SURFACE_AFFINE,
    .effect = {{"conservative elasticity (dlsm)", NULL}, {"compaction", compacts}},
};
