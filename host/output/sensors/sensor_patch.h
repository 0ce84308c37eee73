/* Faces or elements whose displacements a sensor averages: a set, all elements, or one side of a crack. */
#ifndef BRC_OUTPUT_SENSOR_PATCH_H
#define BRC_OUTPUT_SENSOR_PATCH_H

#include "../../../preprocess/domain/domain.h"
#include "../../solver/simulation.h"

typedef struct brc_sensor_patch {
    int32_t set; /* index in the domain; -1: all elements, or the members are its own */
    bool faces;
    int64_t n;
    const int32_t *members;  /* NULL: all elements */
    int32_t *own;            /* the same where the patch owns them; NULL: they are borrowed from the set */
    double weight;           /* sum of areas [m^2] or volumes [m^3] */
    double mean_position[3]; /* [m] */
    double mean_normal[3];   /* faces: sum of the outward area vectors [m^2]; elements: 0 */
    double *u;               /* faces: [n][3] displacement now [m]; elements: NULL, they are in the field */
    double mean_u[3];        /* now [m] */
} brc_sensor_patch;

/* Of a set of the domain; -1: of all elements. BRC_BAD_INPUT when no element of it has a bond. */
brc_status brc_sensor_patch_of_set(brc_context *context, const brc_domain *domain, int32_t set, brc_sensor_patch *out);
/* Of free faces, n of them, ascending; takes `members` over, also on failure. */
brc_status brc_sensor_patch_of_faces(brc_context *context, const brc_domain *domain, int64_t n, int32_t *members,
                                     brc_sensor_patch *out);
void brc_sensor_patch_free(brc_sensor_patch *patch);
/* Place of member k and its weight in means: the face's area [m^2], the cell's volume [m^3], of spheres 1, or 0 without
 * a bond. */
const double *brc_sensor_patch_point(const brc_domain *domain, const brc_sensor_patch *patch, int64_t k,
                                     double *weight);
/* Displacement of member k; `displacement` [n_elements][3] is that of the elements. */
const double *brc_sensor_patch_displacement(const brc_sensor_patch *patch, const double *displacement, int64_t k);
/* Read the faces' displacements, and fill in mean_u. */
brc_status brc_sensor_patch_read(brc_sensor_patch *patch, const brc_domain *domain, brc_simulation *simulation,
                                 const double *displacement);

#endif
