/* The size of a sample of packed spheres, by its walls: there are no faces to measure. Along an axis it is the distance
 * of the mean positions of the spheres at two walls plus the mean diameter of all spheres as packed (NAH19;
 * docs/notebook/beams.md). Spheres without bonds count in no mean of a wall. Samples are aligned with the axes. */
#ifndef BRC_OUTPUT_SPHERE_BOX_H
#define BRC_OUTPUT_SPHERE_BOX_H

#include "../../../preprocess/domain/domain.h"

/* Has it any bonds as built? Those that broke since are counted as there. */
bool brc_sphere_is_bonded(const brc_domain *domain, int64_t element);
/* Members of an element set that have. */
int64_t brc_sphere_count_bonded(const brc_domain *domain, const brc_set *set);
/* Mean diameter of all spheres [m]. */
double brc_sphere_mean_diameter(const brc_domain *domain);
/* Distance between two element sets along an axis (0 x, 1 y, 2 z), a diameter added, with the sign of the distance
 * [m]. */
double brc_sphere_box_length(const brc_domain *domain, int32_t set, int32_t against, int axis);
/* Section that an end wall's set ("x-", "y+", "<part>_z-", also with "_layer") divides its load by [m^2]: of a box by
 * the sets of its other walls, of a cylinder by that of "side": pi R^2, R the mean distance of its spheres from the
 * line through the end wall's centre plus half a mean diameter. NAN where the name is not such a wall, or the others
 * are not there. */
double brc_sphere_box_section(const brc_domain *domain, int32_t set);

#endif
