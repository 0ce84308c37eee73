/* From what a scene asks to a domain: build or read each body, join them, name the sets. */
#ifndef BRC_COMMANDS_SCENE_DOMAIN_H
#define BRC_COMMANDS_SCENE_DOMAIN_H

#include "../../preprocess/domain.h"
#include "../scene/scene.h"

/* Sets of the scene see all bodies where they stand; a body read from a file keeps its own sets besides, unless the
 * scene names one alike. n_threads: 0 as OpenMP decides. The caller frees *out. */
brc_status brc_scene_domain_build(brc_context *context, const brc_scene *scene, int n_threads, brc_domain **out);

#endif
