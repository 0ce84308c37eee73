/* How far two places of the bodies have moved apart: two sets, two elements, or the two sides of a crack. */
#ifndef BRC_OUTPUT_OPENING_H
#define BRC_OUTPUT_OPENING_H

#include "sensor_patch.h"
#include "../../scene/scene.h"

typedef struct brc_opening {
    double direction[3]; /* unit vector from side 0 to side 1 */
    bool of_points;
    int32_t element[2];       /* of points: the nearest ones */
    brc_sensor_patch side[2]; /* else */
} brc_opening;

/* BRC_BAD_INPUT: a set that is not there, sides between which nothing tells which way is apart, a crack without faces
 * near the place, two points with one nearest element. `out` is freed by brc_opening_free, also on failure. */
brc_status brc_opening_prepare(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                               const brc_sensor *sensor, brc_opening *out);
void brc_opening_free(brc_opening *opening);
/* Does it read displacements of elements? */
bool brc_opening_needs_elements(const brc_opening *opening);
/* value [m], positive when the sides are farther apart than as the scene starts; displacement: [n_elements][3], NULL
 * where it is not needed. */
brc_status brc_opening_read(brc_opening *opening, const brc_domain *domain, brc_simulation *simulation,
                            const double *displacement, double *value);

#endif
