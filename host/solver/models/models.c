/* The models that are there, of models.def. */
#include "model.h"

#define BRC_BOND_MODEL(kind, descriptor) extern const brc_bond_model descriptor;
#include "models.def"
#undef BRC_BOND_MODEL

#define BRC_BOND_MODEL(kind, descriptor) [kind] = &descriptor,
static const brc_bond_model *const models[] = {
#include "models.def"
};
#undef BRC_BOND_MODEL

const brc_bond_model *brc_bond_model_of(brc_model_kind kind)
{
    return models[kind];
}

const brc_bond_model *const *brc_bond_models(int *n)
{
    *n = (int)(sizeof models / sizeof *models);
    return models;
}
