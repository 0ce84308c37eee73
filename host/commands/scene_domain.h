/* From what a scene asks to a domain: build or read each body, join them, name the sets. */
#ifndef BRC_COMMANDS_SCENE_DOMAIN_H
#define BRC_COMMANDS_SCENE_DOMAIN_H

#include "../../preprocess/domain/domain.h"
#include "../scene/scene.h"
#include "../solver/run/split.h"

/* What the builder is asked for one body, with the arrays it borrows. */
typedef struct brc_scene_request {
    brc_build_request build;
    brc_predicate *regions;
    double *fractions;
    brc_shape_part *parts;
} brc_scene_request;

/* The request of a body that has a shape and a fill; its files are found from the scene's folder. It borrows from the
 * scene; caller frees with brc_scene_request_free. */
brc_status brc_scene_request_make(brc_context *context, const brc_scene *scene, int32_t index, int n_threads,
                                  brc_scene_request *out);
void brc_scene_request_free(brc_scene_request *request);

/* The whole scene as one domain, whatever the bodies' models. Sets of the scene see all bodies where they stand; a body
 * read from a file keeps its own sets besides, unless the scene names one alike. n_threads: 0 as OpenMP decides. The
 * caller frees *out. */
brc_status brc_scene_domain_build(brc_context *context, const brc_scene *scene, int n_threads, brc_domain **out);
/* One domain for every part of the scene, out [n]: a set may be empty in some parts, not in all. BRC_BAD_INPUT also
 * where bodies of different parts overlap. The caller frees each of *out. */
brc_status brc_split_domains_build(brc_context *context, const brc_split *split, int n_threads, brc_together together,
                                   brc_domain **out);

#endif
