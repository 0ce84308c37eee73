/* A model of bonds: what its elements are and what forces act between them. One descriptor each, in a folder of its
 * own, and one line in models.def; the rest of the solver asks the descriptor and names no model. */
#ifndef BRC_SOLVER_MODELS_MODEL_H
#define BRC_SOLVER_MODELS_MODEL_H

#include "../../../preprocess/domain/domain.h"
#include "../../scene/scene.h"

/* How contact sees the surface of an element: as kernels number it (contact_body.h). */
typedef enum brc_surface { BRC_SURFACE_SPHERE, BRC_SURFACE_AFFINE, BRC_SURFACE_RIGID } brc_surface;

/* Something that `check` lists as in a run or left out of it; in NULL: with the model. */
typedef struct brc_model_effect {
    const char *name;
    bool (*in)(const brc_scene *scene);
} brc_model_effect;

typedef struct brc_bond_model {
    brc_element_kind element; /* that it takes */
    bool turns;               /* elements have rotations of their own */
    bool deforms;             /* elements have a displacement gradient, with which their faces and surfaces move */
    brc_surface surface;
    brc_model_effect effect[2]; /* name NULL: no more */
} brc_bond_model;

/* The descriptor of a kind. */
const brc_bond_model *brc_bond_model_of(brc_model_kind kind);
/* All of them; *n: how many. */
const brc_bond_model *const *brc_bond_models(int *n);

#endif
