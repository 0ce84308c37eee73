/* The cube of 1 m that benches step: glass, free faces, noisy-grid cells or a packing with ten beams an element. */
#ifndef BRC_BENCH_CUBE_H
#define BRC_BENCH_CUBE_H

#include "../host/scene/scene.h"

/* A scene with what it points to: not to be copied. One dynamic stage without end, slightly strained and shaken so that
 * no number is zero. */
typedef struct brc_cube {
    brc_material material;
    brc_body body;
    brc_initial initial[2];
    brc_stage stage;
    brc_scene scene;
} brc_cube;

void brc_cube_make(brc_cube *cube, brc_model_kind model);
/* The model joins spheres, not cells. */
bool brc_cube_is_of_spheres(brc_model_kind model);
/* About `size` elements. *out is the caller's. */
brc_status brc_cube_build(brc_context *context, int64_t size, bool spheres, brc_domain **out);
/* A bar of 1 m along x and BRC_BAR_WIDTH square, packed as the cube. */
#define BRC_BAR_WIDTH 0.2 /* [m] */
brc_status brc_cube_build_bar(brc_context *context, int64_t size, brc_domain **out);

#endif
