/* The models that there are, and what checks of scenes, pictures and prices ask of one. */
#ifndef BRC_SCENE_MODEL_KINDS_H
#define BRC_SCENE_MODEL_KINDS_H

#include <stdbool.h>

#define BRC_MODEL(kind, name, word, meaning) kind,
typedef enum brc_model_kind {
#include "models.def"
    BRC_N_MODELS
} brc_model_kind;
#undef BRC_MODEL

typedef struct brc_model_traits {
    bool spheres;  /* elements are spheres joined by beams, which bodies are to have; else cells */
    bool deforms;  /* elements have a gradient of displacement, with which their faces move; else rotations */
    bool cohesion; /* faces of cells may open against one */
} brc_model_traits;
const brc_model_traits *brc_model_traits_of(brc_model_kind kind);
/* As in scenes. */
const char *brc_model_name(brc_model_kind kind);
/* Of samples that are made of beams, or of cells, whatever the model: the first in models.def. */
brc_model_kind brc_model_of_beams(void);
brc_model_kind brc_model_of_cells(void);

#endif
