/* What a static stage leaves free to move as a whole, warned of before it runs: no elasticity answers loads that push
 * there. */
#ifndef BRC_SOLVER_FREE_BODIES_H
#define BRC_SOLVER_FREE_BODIES_H

#include "../../../preprocess/domain/domain.h"
#include "../../scene/scene.h"
#include "balance.h"

/* "along y and to turn about x": of motions, the pure translations and the turns about lines along the axes; those that
 * are neither are counted. Into `out`, which is returned. */
const char *brc_free_motions_text(const brc_free_motions *free, char *out, size_t room);
/* Log what the static stages of a scene of one model leave free, body by body and parts that no bond joins apart: a
 * warning where loads push there, with the cure; where none does, one line for information if all are asked for. And
 * a warning of dynamic stages whose forces press a body that nothing keeps from turning, where no contact may: forces
 * are dead, so that a turn grows. BRC_NO_MEMORY. */
brc_status brc_free_bodies_tell(brc_context *context, const brc_scene *scene, const brc_domain *domain, bool all);

#endif
