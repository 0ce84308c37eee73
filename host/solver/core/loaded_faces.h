/* The faces that a load per area, a traction or a pressure, acts on. */
#ifndef BRC_SOLVER_LOADED_FACES_H
#define BRC_SOLVER_LOADED_FACES_H

#include "../../../preprocess/domain/domain.h"
#include "../../scene/scene.h"

typedef struct brc_loaded_face {
    int32_t face;                /* of the free ones */
    double area[3], centroid[3]; /* of the part that is loaded: outward area vector [m^2], its middle [m] */
} brc_loaded_face;

/* Of a set that the scene asks for with a box or a half-space: every face that reaches inside, as far as it does
 * (preprocess/set_share.h), so that the total is that of the region and not of whole faces. Of all other sets (walls,
 * sets of a domain file, spheres and cylinders): the members, whole. In the order of faces; *out is the caller's
 * (brc_memory_free). */
brc_status brc_loaded_faces(brc_context *context, const brc_scene *scene, const brc_domain *domain, const brc_set *set,
                            brc_loaded_face **out, int64_t *n);

#endif
