/* The models that are there, of host/scene/models.def. */
#include "model.h"

#define BRC_MODEL(kind, name, word, meaning) extern const brc_bond_model brc_##word;
#include "../../scene/models.def"
#undef BRC_MODEL

#define BRC_MODEL(kind, name, word, meaning) [kind] = &brc_##word,
static const brc_bond_model *const models[] = {
#include "../../scene/models.def"
};
#undef BRC_MODEL

const brc_bond_model *brc_bond_model_of(brc_model_kind kind)
{
    return models[kind];
}

const brc_bond_model *const *brc_bond_models(int *n)
{
    *n = (int)(sizeof models / sizeof *models);
    return models;
}
